//! Roughing cycles of a lathe, with lists of motions made by hand. X is a diameter in the programs and a radius in the lists.
use crate::support::{faults, line, lines, run_bytes};
use trunnion_interp::{ControlData, RoughingEscape, Setup};

const A: &str = "fanuc-30i-lathe-a";

/// Motions and faults where the machine says that the tool leaves its cuts at the feed.
fn roughed(dialect: &str, source: &str, escape: RoughingEscape) -> (Vec<String>, usize) {
    let control = ControlData {
        roughing_escape: Some(escape),
        ..ControlData::default()
    };
    let setup = Setup {
        control,
        ..Setup::default()
    };
    let (_, log) = run_bytes(dialect, source.as_bytes(), &setup);
    for pair in log.motions.windows(2) {
        assert_eq!(pair[0].end, pair[1].start, "{source}");
    }
    (log.motions.iter().map(line).collect(), log.faults.len())
}

/// Kind, radius and Z of the motions of [`turned`].
const TURNED: [(char, f64, f64); 19] = [
    ('R', 25.0, 2.0),
    // the start moved by 0.5 (U1. is a diameter) and 0.5
    ('R', 25.5, 2.5),
    // 4 deep: the face at Z-30 + 0.5; off by 1 in both; back to the start line; in by 4 + 1
    ('R', 21.5, 2.5),
    ('L', 21.5, -29.5),
    ('L', 22.5, -28.5),
    ('R', 22.5, 2.5),
    // 8 deep: radius 17 of the contour is on its cone, which falls by 2 in Z for each mm of radius: Z-10 - 2 * 7
    ('R', 17.5, 2.5),
    ('L', 17.5, -23.5),
    ('L', 18.5, -22.5),
    ('R', 18.5, 2.5),
    // 12 deep: Z-10 - 2 * 3
    ('R', 13.5, 2.5),
    ('L', 13.5, -15.5),
    ('L', 14.5, -14.5),
    ('R', 14.5, 2.5),
    // 16 would be beyond 15: to the first point, and along the contour at the cycle's feed
    ('R', 10.5, 2.5),
    ('L', 10.5, -9.5),
    ('L', 20.5, -29.5),
    ('L', 26.5, -29.5),
    ('R', 25.0, 2.0),
];

/// The cycle of [`TURNED`], mirrored about the radius 40 or 0 and about Z0.
fn turned(x: impl Fn(f64) -> f64, sides: [f64; 2]) -> String {
    let [sx, sz] = sides;
    let [x50, x20, x40, x52] = [50.0, 20.0, 40.0, 52.0].map(x);
    format!(
        "G0 X{x50:?} Z{:?}\nG71 U4. R1.\nG71 P10 Q20 U{sx:?} W{:?} F.3\nN10 G0 X{x20:?}\nG1 Z{:?} F.1\nX{x40:?} Z{:?}\nN20 X{x52:?}\nM30\n",
        2.0 * sz,
        0.5 * sz,
        -10.0 * sz,
        -30.0 * sz
    )
}

fn written(motions: &[(char, f64, f64)], x: impl Fn(f64) -> f64, sz: f64) -> Vec<String> {
    let feed = |kind| if kind == 'R' { "" } else { " F0.3/rev" };
    let motion = |&(kind, radius, z): &(char, f64, f64)| format!("{kind} X{} Z{}{}", x(radius), z * sz, feed(kind));
    motions.iter().map(motion).collect()
}

#[test]
fn turning_outside_and_inside_towards_and_from_the_chuck() {
    for sz in [1.0, -1.0] {
        let outside = roughed(A, &turned(|x| x, [1.0, sz]), RoughingEscape::Feed);
        assert_eq!(outside, (written(&TURNED, |x| x, sz), 0));
        // the diameter d becomes 80 - d, so that the same cuts lie outside of it
        let inside = roughed(A, &turned(|x| 80.0 - x, [-1.0, sz]), RoughingEscape::Feed);
        assert_eq!(inside, (written(&TURNED, |x| 40.0 - x, sz), 0));
    }
}

#[test]
fn the_escape_in_rapid_and_untold() {
    let source = turned(|x| x, [1.0, 1.0]);
    let (got, told) = roughed(A, &source, RoughingEscape::Rapid);
    assert_eq!((got[4].as_str(), told), ("R X22.5 Z-28.5", 0));
    // not declared: that short motion is unknown, its ends are not
    let got = lines(A, &source);
    assert_eq!(got[4..6], ["U X22.5 Z-28.5", "R X22.5 Z2.5"]);
    let told = faults(A, &source);
    assert!(
        told.len() == 1 && told[0].contains("(declare [control] roughing_escape)"),
        "{told:?}"
    );
    // no escape, no question
    let source = source.replace("R1.", "R0.");
    assert_eq!(faults(A, &source), [""; 0]);
    assert_eq!(
        lines(A, &source)[3..6],
        ["L X21.5 Z-29.5 F0.3/rev", "R X21.5 Z2.5", "R X17.5 Z2.5"]
    );
}

#[test]
fn systems_b_and_c_have_the_same_cycles() {
    let source = turned(|x| x, [1.0, 1.0]).replace("G0 X50", "G90 G0 X50");
    let want = written(&TURNED, |x| x, 1.0);
    assert_eq!(
        roughed("fanuc-30i-lathe-b", &source, RoughingEscape::Feed),
        (want.clone(), 0)
    );
    let source = source.replace("G71", "G73");
    assert_eq!(roughed("fanuc-30i-lathe-c", &source, RoughingEscape::Feed), (want, 0));
}

#[test]
fn facing() {
    // first block by G1: the tool goes in at the feed. Unmoved levels are Z-2, Z-6, Z-10; the cone goes from radius 20 at Z-13 to 10 at Z-3
    let source = "G0 X60. Z2.\nG72 W4. R1.\nG72 P10 Q20 U1. W.5 F.3\nN10 G1 Z-13.\nX40. F.1\nX20. Z-3.\nN20 Z3.\nM30\n";
    let want = [
        ('R', 30.0, 2.0),
        ('R', 30.5, 2.5),
        ('L', 30.5, -1.5),
        ('L', 10.5, -1.5),
        ('L', 11.5, -0.5),
        ('R', 30.5, -0.5),
        ('L', 30.5, -5.5),
        ('L', 13.5, -5.5),
        ('L', 14.5, -4.5),
        ('R', 30.5, -4.5),
        ('L', 30.5, -9.5),
        ('L', 17.5, -9.5),
        ('L', 18.5, -8.5),
        ('R', 30.5, -8.5),
        ('L', 30.5, -12.5),
        ('L', 20.5, -12.5),
        ('L', 10.5, -2.5),
        ('L', 10.5, 3.5),
        ('R', 30.0, 2.0),
    ];
    assert_eq!(
        roughed(A, source, RoughingEscape::Feed),
        (written(&want, |x| x, 1.0), 0)
    );
}

#[test]
fn cuts_end_at_arcs() {
    // radius 14 is 6 off the centre of the hollow arc (radius 20, Z-10): 8 along, Z-18; 4 off that of the other one (radius 10, Z-20):
    // the root of 84 along, Z-10.834849
    for (code, along, lifted) in [("G2", "-18", "-16"), ("G3", "-10.834849", "-8.834849")] {
        for y in ["", " Y0."] {
            let source = format!(
                "G0 X40. Z2.{y}\nG71 U6. R2.\nG71 P1 Q2 F.2\nN1 G0 X20.\nG1 Z-10.\nN2 {code} X40. Z-20. R10.\nM30\n"
            );
            let (got, told) = roughed(A, &source, RoughingEscape::Feed);
            let y = if y.is_empty() { "" } else { " Y0" };
            let want = [
                format!("R X14{y} Z2"),
                format!("L X14{y} Z{along} F0.2/rev"),
                format!("L X16{y} Z{lifted} F0.2/rev"),
                format!("R X16{y} Z2"),
                format!("R X10{y} Z2"),
            ];
            assert_eq!((&got[1..6], told), (&want[..], 0));
        }
    }
    // the path is known in the plane also where the program reads Y
    let source =
        "G0 X40. Z2.\nG71 U6. R2.\nG71 P1 Q2 F.2\nN1 G0 X20.\nG1 Z-10.\n#100=#5042\nN2 G2 X40. Z-20. R10.\nM30\n";
    let (got, told) = roughed(A, source, RoughingEscape::Feed);
    assert_eq!(
        (got[2].as_str(), got[7].as_str(), told),
        ("L X14 Z-18 F0.2/rev", "A(20 0 -10; -90) X20 Z-20 F0.2/rev", 0)
    );
}

#[test]
fn depth_and_escape_stay_for_both_cycles() {
    // the second cycle takes 3 and 1 of the first one: levels Z-1 and Z-4 of 5
    let source = "G0 X20. Z2.\nG71 U3. R1.\nG71 P1 Q2 F.2\nN1 G0 X10.\nG1 Z-10.\nN2 X20.\nG72 P3 Q4\nN3 G0 Z-3.\nG1 X4.\nN4 Z2.\nM30\n";
    let (got, told) = roughed(A, source, RoughingEscape::Feed);
    let cuts: Vec<_> = got.iter().filter(|motion| motion.starts_with("L X2 Z-1")).collect();
    assert_eq!((cuts.len(), told), (1, 0), "{got:?}");
    // only the escape is programmed again
    let source = source.replace("G72 P3", "G72 R.5\nG72 P3");
    let (got, _) = roughed(A, &source, RoughingEscape::Feed);
    assert!(got.contains(&"L X2.5 Z-0.5 F0.2/rev".to_owned()), "{got:?}");
}

/// A cut that the contour does not meet is not known; the tool is known again at the next one.
#[test]
fn cuts_above_the_end_of_the_contour() {
    // the contour ends at radius 8: the levels 9.5 and 8.5 lie above it, 7.5 and 6.5 do not
    let source = "G0 X21. Z2.\nG71 U1. R0.\nG71 P1 Q2 F.2\nN1 G0 X12.\nG1 Z-10.\nN2 X16.\nG0 Z5.\nM30\n";
    let want = [
        "R X10.5 Z2",
        "U X7.5 Z2",
        "L X7.5 Z-10 F0.2/rev",
        "R X7.5 Z2",
        "R X6.5 Z2",
        "L X6.5 Z-10 F0.2/rev",
        "R X6.5 Z2",
        "R X6 Z2",
        "L X6 Z-10 F0.2/rev",
        "L X8 Z-10 F0.2/rev",
        "R X10.5 Z2",
        "R X10.5 Z5",
    ];
    assert_eq!(lines(A, source), want);
    let told = faults(A, source);
    assert!(
        told.len() == 1 && told[0].contains("cuts that miss its contour"),
        "{told:?}"
    );
}

#[test]
fn cuts_shorter_than_the_escape() {
    // from Z2 the face at Z1.5 leaves cuts of half a millimetre, the escape is 1: only the run along the contour is known
    let source = "G0 X20. Z2.\nG71 U3. R1.\nG71 P1 Q2 F.2\nN1 G0 X10.\nG1 Z1.5\nN2 X30.\nM30\n";
    let want = [
        "R X10 Z2",
        "U X5 Z2",
        "L X5 Z1.5 F0.2/rev",
        "L X15 Z1.5 F0.2/rev",
        "R X10 Z2",
    ];
    assert_eq!(lines(A, source), want);
    // a cut of just that length is known
    let (got, told) = roughed(A, &source.replace("R1.", "R.5"), RoughingEscape::Feed);
    assert_eq!(
        (got[1..4].join(", ").as_str(), told),
        ("R X7 Z2, L X7 Z1.5 F0.2/rev, L X7.5 Z2 F0.2/rev", 0)
    );
}

#[test]
fn a_level_along_a_shoulder() {
    // radius 8 is a level and a cylinder: whether that cut ends at Z-5 or Z-10 is undocumented; the others are known
    let source = "G0 X20. Z2.\nG71 U1. R0.\nG71 P1 Q2 F.2\nN1 G0 X14.\nG1 Z-5.\nX16.\nZ-10.\nN2 X20.\nM30\n";
    let want = [
        "R X10 Z2",
        "R X9 Z2",
        "L X9 Z-10 F0.2/rev",
        "R X9 Z2",
        "U X7 Z2",
        "L X7 Z-5 F0.2/rev",
        "L X8 Z-5 F0.2/rev",
        "L X8 Z-10 F0.2/rev",
        "L X10 Z-10 F0.2/rev",
        "R X10 Z2",
    ];
    assert_eq!(lines(A, source), want);
    assert_eq!(faults(A, source).len(), 1);
}
