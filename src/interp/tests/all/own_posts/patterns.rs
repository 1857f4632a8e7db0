//! Patterns of holes in Klartext: PATTERN DEF, and cycles 220 and 221.
use crate::support::{faults, run_text};

/// What PATTERN DEF has no source for: other forms, increments, a level of its own, a pattern that is not there.
#[test]
fn patterns_that_stay_unknown_by_name() {
    for pattern in [
        "PATTERN DEF ROW1 (X+10 Y+10 D+5 NUM3 ROT+0 Z+0)\n",
        "PATTERN DEF POS1 (X+10 IY+10 Z+0)\n",
        "PATTERN DEF POS1 (X+10 Y+10 Z+5)\n",
        "PATTERN DEF POS1 (X+10 Z+0)\n",
        "PATTERN DEF POS1 (X+10 Y+10 Z+0\n",
        "PATTERN DEF\n",
        "",
    ] {
        let text = format!(
            "BEGIN PGM A MM\nTOOL CALL 1 Z S100\nM3\nL X+0 Y+0 Z+50 FMAX\nCYCL DEF 201 A Q200=2 Q201=-5 Q206=100 Q211=0 Q208=100 Q203=+0 Q204=10\n{pattern}CYCL CALL PAT FMAX\nEND PGM A MM\n"
        );
        let told = faults("heidenhain-klartext", &text);
        assert!(
            told.iter().any(|fault| fault.contains("CYCL CALL PAT: the points")),
            "{pattern}{told:?}"
        );
        assert!(
            pattern.is_empty() || told.iter().any(|fault| fault.contains("PATTERN DEF")),
            "{pattern}{told:?}"
        );
    }
}

/// The places of cycles 220 and 221 that a program visits.
fn visited(pattern: &str) -> Vec<[f64; 3]> {
    let text = format!(
        "BEGIN PGM A MM\nTOOL CALL 1 Z S100\nM3\nL X+0 Y+0 Z+50 FMAX\nCYCL DEF 201 A Q200=2 Q201=-5 Q206=100 Q211=0 Q208=100 Q203=+0 Q204=10\n{pattern} Q200=2 Q203=+0 Q204=10\nEND PGM A MM\n"
    );
    let motions = run_text("heidenhain-klartext", &text).motions;
    let down = motions
        .iter()
        .filter(|motion| motion.is_feed() && motion.end.get(2) == Some(-5.0));
    down.filter_map(|motion| Some(motion.end.xyz()?.into())).collect()
}

#[test]
fn patterns_of_holes_on_a_circle_and_a_line() {
    let near = |found: &[[f64; 3]], wanted: &[[f64; 2]]| {
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        for (one, two) in found.iter().zip(wanted) {
            assert!(
                (one[0] - two[0]).abs() < 1e-9 && (one[1] - two[1]).abs() < 1e-9,
                "{found:?}"
            );
        }
    };
    let circle = "CYCL DEF 220 POLAR Q216=+10 Q217=+20 Q244=60";
    let round = [[40.0, 20.0], [10.0, 50.0], [-20.0, 20.0], [10.0, -10.0]];
    near(&visited(&format!("{circle} Q245=+0 Q246=+360 Q247=+0 Q241=4")), &round);
    // the last angle does not count where a step is given
    near(&visited(&format!("{circle} Q245=+0 Q246=+10 Q247=+90 Q241=4")), &round);
    let half = [[40.0, 20.0], [10.0, 50.0], [-20.0, 20.0]];
    near(&visited(&format!("{circle} Q245=+0 Q246=+180 Q247=+0 Q241=3")), &half);
    let back = [[10.0, 50.0], [40.0, 20.0], [10.0, -10.0]];
    near(&visited(&format!("{circle} Q245=+90 Q246=-90 Q247=+0 Q241=3")), &back);
    let line = "CYCL DEF 221 LINE Q225=+5 Q226=+6 Q237=+10 Q238=+8 Q242=3 Q243=1 Q224=+90";
    near(&visited(line), &[[5.0, 6.0], [5.0, 16.0], [5.0, 26.0]]);
    // several lines, another clearance than that of the cycle, no angle to divide, no count
    for pattern in [
        line.replace("Q243=1", "Q243=2"),
        format!("{line} Q200=3"),
        format!("{circle} Q245=+0 Q246=+0 Q247=+0 Q241=4"),
        format!("{circle} Q245=+0 Q246=+360 Q247=+0 Q241=2.5"),
        format!("{circle} Q245=+0 Q246=+360 Q247=+0"),
    ] {
        assert_eq!(visited(&pattern), [[0.0; 3]; 0], "{pattern}");
    }
}
