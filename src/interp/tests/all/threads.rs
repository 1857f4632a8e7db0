//! Threads of many passes, with depths worked out by hand. X is a diameter in the programs and a radius in the lists.
use crate::support::{faults, line, lines, number, run_bytes};
use trunnion_interp::Setup;

const A: &str = "fanuc-30i-lathe-a";

/// Height 1 and allowance 0.1; cuts of 0.4 times the roots of 1 to 5 (1, 1.414214, 1.732051, 2, 2.236068), and 0.9 instead of 0.979796;
/// two finishing passes.
const DEPTHS: [f64; 8] = [0.4, 0.565_685, 0.69282, 0.8, 0.894_427, 0.9, 1.0, 1.0];

/// A thread without flank and pull-out: radius of the root at the end `x`, of the start `x0`; the retract; taper; Z.
fn passes(x: f64, x0: f64, taper: f64, [z0, z]: [f64; 2], depths: &[f64]) -> Vec<String> {
    let out = (x0 - x).signum();
    let mut want = vec![format!("R X{x0} Z{z0}")];
    for depth in depths {
        let level = x + out * (1.0 - depth);
        want.push(format!("R X{} Z{z0}", number(level + taper)));
        // F counts along Z, which goes farther
        let feed = 1.5 * (taper * taper + (z - z0) * (z - z0)).sqrt() / (z - z0).abs();
        want.push(format!("L X{} Z{z} F{}/rev", number(level), number(feed)));
        want.push(format!("R X{x0} Z{z}"));
        want.push(format!("R X{x0} Z{z0}"));
    }
    want
}

#[test]
fn cuts_go_deeper_by_the_root_of_their_number() {
    let source = "G0 X35. Z5.\nG76 P020000 Q10 R.1\nG76 X30. Z-20. P1000 Q400 F1.5\nM30\n";
    assert_eq!(lines(A, source), passes(15.0, 17.5, 0.0, [5.0, -20.0], &DEPTHS));
    assert_eq!(faults(A, source), [""; 0]);
    // system C calls it G78; increments name the same end
    let c = source.replace("G76", "G78").replace("G0 X35.", "G90 G0 X35.");
    assert_eq!(lines("fanuc-30i-lathe-c", &c), lines(A, source));
    assert_eq!(lines(A, &source.replace("X30. Z-20.", "U-5. W-25.")), lines(A, source));
    // inside, and in the other direction
    let inside = source.replace("X35. Z5.", "X25. Z-25.").replace("Z-20.", "Z0.");
    assert_eq!(lines(A, &inside), passes(15.0, 12.5, 0.0, [-25.0, 0.0], &DEPTHS));
}

#[test]
fn no_cut_is_smaller_than_the_least() {
    // 0.8 - 0.69282 is still above 0.1, the next one would be 0.094427: 0.1 instead
    let source = "G0 X35. Z5.\nG76 P010000 Q100 R.1\nG76 X30. Z-20. P1000 Q400 F1.5\nM30\n";
    assert_eq!(
        lines(A, source),
        passes(15.0, 17.5, 0.0, [5.0, -20.0], &[0.4, 0.565_685, 0.69282, 0.8, 0.9, 1.0])
    );
    // from the second cut on: 0.3, then by 0.2
    let source = source.replace("Q100", "Q200").replace("Q400", "Q300");
    assert_eq!(
        lines(A, &source),
        passes(15.0, 17.5, 0.0, [5.0, -20.0], &[0.3, 0.5, 0.7, 0.9, 1.0])
    );
    // a first cut deeper than all of it
    let source = source.replace("Q300", "Q5000");
    assert_eq!(lines(A, &source), passes(15.0, 17.5, 0.0, [5.0, -20.0], &[0.9, 1.0]));
}

#[test]
fn a_taper_is_the_radius_at_the_beginning_less_that_at_the_end() {
    let source = "G0 X35. Z5.\nG76 P020000 Q10 R.1\nG76 X30. Z-20. R-1. P1000 Q400 F1.5\nM30\n";
    assert_eq!(lines(A, source), passes(15.0, 17.5, -1.0, [5.0, -20.0], &DEPTHS));
}

#[test]
fn the_pull_out_is_unknown_from_where_it_begins() {
    // 10 tenths of 1.5 mm before Z-20; the taper of -1 over 25 mm is -0.06 there
    let source = "G0 X35. Z5.\nG76 P011000 Q10 R.1\nG76 X30. Z-20. R-1. P1000 Q900 F1.5\nG0 X40.\nM30\n";
    let want = [
        "R X17.5 Z5",
        "R X14.1 Z5",
        "L X15.04 Z-18.5 F1.5012/rev",
        "U X17.5 Z5",
        "R X14 Z5",
        "L X14.94 Z-18.5 F1.5012/rev",
        "U X17.5 Z5",
        "R X20 Z5",
    ];
    assert_eq!(lines(A, source), want);
    let told = faults(A, source);
    assert!(
        told.len() == 1 && told[0].contains("G76: the shape of its pull-out"),
        "{told:?}"
    );
}

#[test]
fn along_the_flank_the_beginning_of_a_cut_is_unknown() {
    let source = "G0 X35. Z5.\nG76 P010060 Q10 R.1\nG76 X30. Z-20. P1000 Q900 F1.5\nM30\n";
    let want = [
        "R X17.5 Z5",
        "R X15.1",
        "L X15.1 Z-20 F1.5/rev",
        "R X17.5 Z-20",
        "R X17.5 Z5",
        "R X15",
        "L X15 Z-20 F1.5/rev",
        "R X17.5 Z-20",
        "R X17.5 Z5",
    ];
    assert_eq!(lines(A, source), want);
    let told = faults(A, source);
    assert!(
        told.len() == 1 && told[0].contains("G76: where in Z its cuts start"),
        "{told:?}"
    );
    // on a taper neither the radius there, nor that where the pull-out begins
    let got = lines(
        A,
        &source
            .replace("X30. Z-20.", "X30. Z-20. R-1.")
            .replace("P010060", "P011060"),
    );
    assert_eq!(got[1..4], ["R -", "L Z-18.5", "U X17.5 Z5"]);
}

#[test]
fn threads_that_cannot_be_worked_out_say_why() {
    let first = "G76 P020000 Q100 R.1";
    let second = "G76 X30. Z-20. P1000 Q300 F1.5";
    for (first, second, why) in [
        ("", second, "without P in its first block"),
        ("G76 P0200.00 Q100 R.1", second, "without P in its first block"),
        ("G76 P-1 Q100 R.1", second, "without P in its first block"),
        ("G76 P020000 R.1", second, "without Q in its first block"),
        ("G76 P020000 Q#500 R.1", second, "without Q in its first block"),
        ("G76 P020000 Q100", second, "without R in its first block"),
        ("G76 P000000 Q100 R.1", second, "no finishing pass"),
        ("G76 P010045 Q100 R.1", second, "an angle other than"),
        (first, "G76 X30. Z-20. P1000 F1.5", "without its height"),
        (first, "G76 X30. Z-20. P0 Q300 F1.5", "without its height"),
        (first, "G76 X30. Z-20. P1000 Q0 F1.5", "without its height"),
        (first, "G76 X30. Z-20. P1000 Q300", "without its lead"),
        (first, "G76 X30. Z-20. P100 Q300 F1.5", "as large as its height"),
        (
            "G76 P010000 Q0 R.1",
            "G76 X30. Z-20. P1000 Q1 F1.5",
            "more than 10000 cuts",
        ),
        (
            "G76 P019900 Q100 R.1",
            "G76 X30. Z-20. P1000 Q300 F3.",
            "its pull-out is as long",
        ),
        (first, "G76 X34. Z-20. P1000 Q300 F1.5", "inside its thread"),
        (first, "G76 X34. Z-20. R-2. P1000 Q300 F1.5", "inside its thread"),
        (first, "G76 X30. Z-20. R2. P1000 Q300 F1.5", "inside its thread"),
        (first, "G76 X35. Z-20. P1000 Q300 F1.5", "inside its thread"),
        (first, "G76 X30. P1000 Q300 F1.5", "has no length"),
        (first, "G76 X30. Z#500 P1000 Q300 F1.5", "an unknown position"),
        (first, "G76 X30. Z-20. R#500 P1000 Q300 F1.5", "its taper"),
        (first, "G76 X30. Z-20. K1. D300 F1.5", "one block"),
    ] {
        let source = format!("G0 X35. Z5.\n{first}\n{second}\nG0 X40.\nM30\n");
        assert_eq!(lines(A, &source), ["R X17.5 Z5", "U X17.5 Z5", "R X20 Z5"], "{source}");
        let told = faults(A, &source);
        assert!(
            told.iter()
                .any(|told| told.contains("passes of G76: ") && told.contains(why)),
            "{source}{told:?}"
        );
    }
}

/// Whatever the numbers are, the passes end, and where they began; every motion joins on to the one before.
#[test]
fn hostile_numbers_come_to_an_end() {
    let numbers = ["0", "-300", "1", "300", "99999999", "1e9", "#500"];
    for least in numbers {
        for height in numbers {
            for first in numbers {
                for p in ["990000", "019980", "999999", "#500"] {
                    let source = format!(
                        "G0 X35. Z5.\nG76 P{p} Q{least} R.1\nG76 X30. Z-20. P{height} Q{first} F1.5\nG0 Z9.\nM30\n"
                    );
                    let (_, log) = run_bytes(A, source.as_bytes(), &Setup::default());
                    assert!(log.motions.len() < 100_000, "{source}");
                    assert_eq!(line(log.motions.last().expect("some")), "R X17.5 Z9", "{source}");
                    for pair in log.motions.windows(2) {
                        assert_eq!(pair[0].end, pair[1].start, "{source}");
                    }
                }
            }
        }
    }
}

/// One pass (G92) on a taper, left 1.2 leads of 1.5 mm before its end, after 23.2 of 25 mm; or reported as unknown.
#[test]
fn a_thread_of_one_pass_may_be_left_before_its_end() {
    use trunnion_interp::ControlData;
    let source = "G0 X30. Z5.\nG92 X24. Z-20. R-2.5 F1.5\nM30\n";
    let run = |thread_pull_out| {
        let control = ControlData {
            thread_pull_out,
            ..ControlData::default()
        };
        let setup = Setup {
            control,
            ..Setup::default()
        };
        let (_, log) = run_bytes(A, source.as_bytes(), &setup);
        let lines: Vec<String> = log.motions.iter().map(line).collect();
        (lines, format!("{:?}", log.faults))
    };
    let (lines, told) = run(Some(1.2));
    assert_eq!(
        lines,
        ["R X15 Z5", "R X9.5 Z5", "L X11.82 Z-18.2 F1.507481/rev", "U X15 Z5"]
    );
    assert!(told.contains("G92: the shape of its pull-out"), "{told}");
    let (whole, told) = run(Some(0.0));
    assert_eq!(whole[2..], ["L X12 Z-20 F1.507481/rev", "R X15 Z-20", "R X15 Z5"]);
    assert_eq!(told, "[]");
    let (unsaid, told) = run(None);
    assert_eq!(unsaid, whole);
    assert!(
        told.contains("G92: whether the tool pulls out before the end of the thread"),
        "{told}"
    );
}

/// F is the lead along the axis that goes farther.
#[test]
fn the_feed_of_a_taper_thread() {
    let source = "G97 S600 M3\nG0 X40. Z5.\nG32 Z-20. F2.\nX60. Z-30.\nX100. Z-35.\n";
    for dialect in ["fanuc-30i-lathe-a", "haas-lathe"] {
        let log = crate::support::run_text(dialect, source);
        let feeds: Vec<_> = log
            .motions
            .iter()
            .filter_map(|motion| match motion.feed {
                trunnion_interp::Feed::PerRevolution(feed) => Some(feed),
                _ => None,
            })
            .collect();
        // 10 mm of radius and 10 of Z; 20 of radius and 5 of Z
        let wanted = [2.0, 2.0 * 2.0_f64.sqrt(), 2.0 * 425.0_f64.sqrt() / 20.0];
        assert_eq!(feeds.len(), 3, "{dialect}: {feeds:?}");
        for (feed, wanted) in feeds.iter().zip(wanted) {
            assert!((feed - wanted).abs() < 1e-12, "{dialect}: {feeds:?}");
        }
    }
}
