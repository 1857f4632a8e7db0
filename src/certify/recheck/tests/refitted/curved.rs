//! Lines that were put together into curves.
use super::{claim, prove_in, proved, refused};
use crate::recheck::recheck;
use crate::{Certificate, Claim, Outcome, RefitSource};
use std::fmt::Write;
use trunnion_interp::Setup;

fn prove_of(before: &str, after: &str, tolerance_mm: f64, source: RefitSource) -> Outcome {
    prove_in("sinumerik-840d", before, after, &claim(tolerance_mm, source))
}

fn prove(before: &str, after: &str, tolerance_mm: f64) -> Outcome {
    prove_of(before, after, tolerance_mm, RefitSource::Chords)
}

fn around(head: &str, rows: &str) -> String {
    format!("G71 G90 G94 G17 G54\nM3 S1000\n{head}G0 X0 Y0 Z0 A0 C0\nF500\n{rows}G1 Y20\nG0 Z50\nM30\n")
}

/// X = 20 p, Y = 12 p^2 - 8 p^3 in 40 lines.
fn lines() -> String {
    (1..=40).fold("G1\n".to_owned(), |mut rows, step| {
        let p = f64::from(step) / 40.0;
        writeln!(rows, "X{:.4} Y{:.4}", 20.0 * p, 12.0 * p * p - 8.0 * p * p * p).expect("a string");
        rows
    })
}

const CURVE: &str = "POLY X20 PO[Y]=(4,12,-8)\n";

#[test]
fn lines_become_a_polynomial_within_their_sag() {
    let (before, after) = (around("", &lines()), around("", CURVE));
    // the largest second derivative is 24 (by p) at p = 0: 24 / 8 / 40^2 along Y, as X runs evenly
    let sag = 24.0 / 8.0 / 1600.0;
    let certificate = proved(prove(&before, &after, 0.003));
    let found = certificate.worst.path_bound_mm.value;
    assert!(found > 0.95 * sag && found < 1.1 * sag, "{found} {sag}");
    assert!(refused(prove(&before, &after, 0.9 * sag)).contains("from the new path"));
    let points = proved(prove_of(&before, &after, 0.0002, RefitSource::Points));
    assert!(points.worst.point_shift_mm.value < 0.0001);
    let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let stored = Certificate::from_json(&certificate.to_json()).expect("JSON");
    let again = |before: &str| {
        recheck(
            &stored,
            before.as_bytes(),
            after.as_bytes(),
            dialect,
            machine,
            &Setup::default(),
        )
    };
    proved(again(&before));
    refused(again(&before.replace("X10.0000", "X10.0010")));
    // forged and sealed again: a finer tolerance, a smaller distance, one more line
    let forge = |change: &dyn Fn(&mut Certificate)| {
        let mut forged = certificate.clone();
        change(&mut forged);
        let forged = forged.sealed();
        recheck(
            &forged,
            before.as_bytes(),
            after.as_bytes(),
            dialect,
            machine,
            &Setup::default(),
        )
    };
    proved(forge(&|_| {}));
    refused(forge(&|forged| {
        forged.claim = Claim::RefittedPath {
            tolerance_mm: 0.9 * sag,
            source: RefitSource::Chords,
        };
    }));
    refused(forge(&|forged| forged.worst.path_bound_mm.value *= 0.99));
    refused(forge(&|forged| forged.motions.changed += 1));
    // the other way round, and a curve in the place of another
    proved(prove(&after, &before, 0.003));
    proved(prove(&after, &around("", "POLY X20 PO[Y]=(4,12.001,-8)\n"), 0.003));
    assert!(refused(prove(&after, &around("", "POLY X20 PO[Y]=(4,12.1,-8)\n"), 0.003)).contains("from the new path"));
    proved(prove(&after, &after, 0.003));
}

#[test]
fn what_else_differs_is_refused() {
    let before = around("", &lines());
    for (curve, why) in [
        ("POLY X20 PO[Y]=(4,-12,8)\n", "from the new path"),
        ("POLY X20 PO[Y]=(4.01,12,-8)\n", "from the new path"),
        ("POLY PO[X]=(20,-60) PO[Y]=(4,12,-8)\n", "from the new path"),
        ("POLY X20 PO[Y]=(4,12,-8) Z0.1\n", "from the new path"),
        ("POLY X20 PO[Y]=(4,12,-8) F600\n", "feed"),
        ("POLY X20 PO[Y]=(4,12,-8) S900\n", "speed"),
        ("M8\nPOLY X20 PO[Y]=(4,12,-8)\n", "coolant"),
        ("POLY X10 PO[Y]=(2,3,-1)\n", "from the new path"),
    ] {
        let found = refused(prove(&before, &around("", curve), 0.003));
        assert!(found.contains(why), "{curve}: {found}");
    }
    for head in ["G60\n", "G41 D1\n"] {
        let found = refused(prove(&around(head, &lines()), &around(head, CURVE), 0.003));
        assert!(found.starts_with("unknown"), "{head}: {found}");
    }
    // a path that goes back is not the curve, although no point of one is far from the other
    let back = before.replace("X12.0000 ", "X15.0000 Y3.375\nX8.0000 Y1.408\nX12.0000 ");
    assert!(refused(prove(&back, &around("", CURVE), 0.003)).contains("from the new path"));
}

/// The claim that the path is the same has no room for another curve near it.
#[test]
fn a_curve_is_not_the_lines_near_it() {
    let claim = Claim::SameToolPath {
        tolerance_mm: 0.001,
        tolerance_deg: 0.001,
    };
    let same = |before: &str, after: &str| prove_in("sinumerik-840d", before, after, &claim);
    let short = around("", "POLY X1 PO[Y]=(1,0.00001)\n");
    proved(same(&short, &short.replace("POLY X1", "POLY X1.0")));
    refused(same(&short, &around("", "G1 X1 Y1\n")));
    refused(same(&short, &around("", "POLY X1 PO[Y]=(1,0.00002)\n")));
}
