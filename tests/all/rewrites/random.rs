//! Rewrites on random chains near the pole and on damaged programs.

use super::strategy_2::{ROWS, VECTORS, apt, ball, run, settings, sinumerik, smooth, turned, words};
use proptest::prelude::*;
use std::fmt::Write;
use trunnion::rewrite::{Options, Proved, rewrites};

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    /// A tool axis that wanders past the pole: what is proved keeps its promises, what is not is refused with a reason.
    #[test]
    fn random_chains_near_the_pole_keep_the_promise(
        path in prop::collection::vec((-1.9..1.9f64, -60.0..60.0f64), 3..12),
        tolerance in 0.01..0.3f64,
    ) {
        let mut rows = String::from("N1 G1 X0.00000 Y0.00000 Z50.00000 A4.500 C0.000\n");
        for (i, (a, c)) in path.iter().enumerate() {
            writeln!(rows, "N{} G1 X{:.5} Y{:.5} Z50.00000 A{a:.3} C{c:.3}", i + 2, 0.2 * i as f64 + 0.3, 0.1 * a).expect("a String takes all");
        }
        rows.push_str("N99 G1 X9.00000 Y0.00000 Z50.00000 A-4.500 C2.000\n");
        let settings = settings("sinumerik-840d", ball());
        match smooth(&sinumerik(&rows), &settings, tolerance).outcome() {
            Ok(Some(Proved { after, certificate, .. })) => {
                let (before, after) = (words(&rows), words(&String::from_utf8(after).expect("UTF-8")));
                prop_assert!(certificate.worst.axis_change_deg.value <= tolerance);
                let travel = |rows: &[[f64; 5]]| rows.windows(2).map(|w| (w[1][4] - w[0][4]).abs()).sum::<f64>();
                // another posture or turn is chosen where it is less steep, and may travel farther
                let chosen = before.iter().zip(&after).any(|(was, is)| was[3] != is[3] || (was[4] - is[4]).abs() > 180.0);
                prop_assert!(chosen || travel(&after) <= travel(&before) + 0.01);
                // the slope is what it makes small: over a long block a larger step may be less steep
                let length = |row: usize| (0..3).map(|axis| (before[row + 1][axis] - before[row][axis]).powi(2)).sum::<f64>().sqrt();
                let slope = |rows: &[[f64; 5]]| rows.windows(2).enumerate().map(|(row, w)| (w[1][4] - w[0][4]).abs() / length(row)).fold(0.0, f64::max);
                prop_assert!(slope(&after) <= slope(&before) + 0.01, "{} {}", slope(&after), slope(&before));
                for (was, is) in before.iter().zip(&after) {
                    prop_assert!(turned(was, is) <= tolerance + 1e-9);
                    // the other posture has the other sign
                    prop_assert_eq!(was[3].abs(), is[3].abs());
                }
            }
            Err(reason) => prop_assert!(!reason.is_empty()),
            Ok(None) => {}
        }
    }

    /// Damaged programs: no panic, and what is proved is proved again.
    #[test]
    fn damaged_programs_do_no_harm(cuts in prop::collection::vec((0..400usize, prop::char::range(' ', '~')), 1..6), apt_format in any::<bool>()) {
        let (text, dialect) = if apt_format { (apt(VECTORS), "apt") } else { (sinumerik(ROWS), "sinumerik-840d") };
        let mut bytes = text.into_bytes();
        for (at, with) in cuts {
            let at = at % bytes.len();
            bytes[at] = u8::try_from(with).expect("ASCII");
        }
        let text = String::from_utf8(bytes).expect("ASCII");
        let settings = settings(dialect, ball());
        for rewrite in rewrites() {
            match run(rewrite.name, &text, &settings, &Options::default()).outcome() {
                Err(reason) => prop_assert!(!reason.is_empty()),
                Ok(Some(Proved { after, .. })) => prop_assert_ne!(after, text.as_bytes()),
                Ok(None) => {}
            }
        }
    }
}
