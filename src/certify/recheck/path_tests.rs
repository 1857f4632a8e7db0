//! The claim of the path alone.
use super::tests::{on, proved};
use crate::{Claim, Outcome};
use trunnion_interp::Setup;

pub(super) fn tool(number: u32, length: f64) -> trunnion_interp::Tool {
    trunnion_interp::Tool {
        number,
        shape: None,
        diameter_mm: None,
        length_mm: Some(length),
        holder_mm: None,
    }
}

/// The path is that of the tip: another active length is another path, and an undeclared length or zero point decides nothing.
#[test]
fn the_path_alone_is_that_of_the_tip() {
    let mut values = [0.0; 9];
    values[2] = -200.0;
    let mut setup = Setup {
        tools: vec![tool(2, 60.0), tool(3, 20.0), tool(6, 60.0)],
        ..Setup::default()
    };
    setup.work_offsets.push(trunnion_interp::WorkOffset {
        name: "G54".into(),
        values,
    });
    let path = Claim::SamePath {
        tolerance_mm: 0.01,
        tolerance_deg: 0.01,
    };
    let program = |length: &str| format!("G21 G90 G94\nT2 M6\n{length}G0 X0. Y0. Z50.\nG1 Z-1. F100.\nM30\n");
    let judge = |before: &str, after: &str| on("fanuc-30i", &program(before), &program(after), &path, &setup);
    for (before, after) in [("G54\nG43 H2\n", "G54\n"), ("G54\nG43 H2\n", "G54\nG43 H3\n")] {
        let Outcome::Refuted(witness) = judge(before, after) else {
            panic!("{before} {after} is not refuted")
        };
        assert!(witness.message.contains("the active tool length differs"), "{witness}");
    }
    for (before, after, why) in [
        ("G54\nG43 H2\n", "G54\nG43 H4\n", "undeclared"),
        ("G54\nG43 H5\n", "G54\nG43 H4\n", "undeclared"),
        ("G54\nG43 H2\n", "G55\nG43 H2\n", "a zero point is not declared"),
    ] {
        let Outcome::Unknown(gap) = judge(before, after) else {
            panic!("{before} {after} is decided")
        };
        assert!(gap.message.contains(why), "{gap}");
    }
    proved(judge("G54\nG43 H2\n", "G54\nG43 H6\n"));
    proved(judge("G54\nG43 H4\n", "G54\nG43 H4\n"));
    // a line and an arc may be near enough
    let [line, arc] = ["G1 X0.1 F100.\n", "G2 X0.1 R10. F100.\n"].map(|cut| format!("G54\nG17\nG0 X0. Y0. Z0.\n{cut}"));
    let Outcome::Unknown(gap) = judge(&line, &arc) else {
        panic!("a line and an arc are decided")
    };
    assert!(gap.message.contains("not judged"), "{gap}");
}
