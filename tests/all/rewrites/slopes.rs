//! smooth-pole where the slope, the posture, a vector on the pole or the programmed point decide.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
use super::smoothing::near;
use super::strategy_2::{
    ROWS, apt, ball, certified, largest_c_step, refused, settings, sinumerik, smooth, tool, words,
};
use trunnion::interp::{Setup, ToolShape};

/// The slope counts, not the largest step: over a long block the table may turn far at a low slope.
#[test]
fn the_slope_falls_while_the_largest_step_grows() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/reference/longlink.mpf");
    let Ok(before) = std::fs::read_to_string(&path) else {
        println!("skipped: {} is not there", path.display());
        return;
    };
    let (after, certificate) = certified(smooth(&before, &settings("sinumerik-840d", Setup::default()), 0.2));
    let rows = |text: &str| -> Vec<(f64, f64)> {
        let word = |line: &str, letter: char| {
            let word = line.split(' ').find(|word| word.starts_with(letter))?;
            word[1..].parse::<f64>().ok()
        };
        text.lines()
            .filter_map(|line| word(line, 'X').zip(word(line, 'C')))
            .collect()
    };
    let slope = |text: &str| {
        let lengths = rows(&before);
        let steps = rows(text)
            .windows(2)
            .zip(lengths.windows(2))
            .map(|(c, x)| ((c[1].1 - c[0].1) / (x[1].0 - x[0].0)).abs())
            .collect::<Vec<_>>();
        steps.into_iter().filter(|slope| slope.is_finite()).fold(0.0, f64::max)
    };
    assert!(
        near(slope(&before), 50.0, 1e-6) && slope(&after) <= 5.9,
        "{}\n{after}",
        slope(&after)
    );
    assert!(certificate.rotary[0].step_after_deg > 30.0, "{:?}", certificate.rotary);
    // 120 deg/s of C at the steepest place
    assert!(120.0 / slope(&after) * 60.0 >= 1220.0);
}

/// The pole row of strategy 3 as a tool vector says no azimuth; turned by less than the tolerance it does.
#[test]
fn a_vector_at_the_pole_is_given_an_azimuth() {
    let rows = "GOTO / -28.38438, -1.87481, 59.89895, 0.008487,-0.025460, 0.999640
GOTO / -28.38993, -1.04297, 59.96875, 0.004678,-0.014034, 0.999891
GOTO / -28.39244, 0.00000, 60.00000, 0.000000, 0.000000, 1.000000
GOTO / -28.38990, 1.05008, 59.96832, 0.004678, 0.014034, 0.999891
GOTO / -28.38432, 1.88127, 59.89825, 0.008487, 0.025460, 0.999640
";
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs/guide-vane/strategy-3.apt");
    let settings = settings("apt", ball());
    for text in [apt(rows), std::fs::read_to_string(path).expect("the sample is there")] {
        let (after, certificate) = certified(smooth(&text, &settings, 0.1));
        // 23.35 deg over blocks of 1.043 and 1.051 mm: the least slope is 11.15 deg/mm, and the larger step 11.715 deg. The independent
        // number, 11.67 deg, is the least largest step: half of the turn in each block. Evenness may cost 0.3 % of slope.
        assert!(
            near(certificate.rotary[0].step_after_deg, 11.715, 0.04),
            "{:?}\n{after}",
            certificate.rotary
        );
        assert!(!after.contains("0.000000, 0.000000, 1.000000"), "{after}");
        assert!(certificate.worst.point_shift_mm.value < 2e-5);
    }
}

/// A change of posture within half the tolerance of the pole, together with the tube, takes the whole swing away.
#[test]
fn the_posture_changes_where_the_azimuth_is_free() {
    let rows = "N1 G0 X0.00000 Y0.00000 Z50.00000 A3.000 C10.000
N2 G1 X0.30000 Y0.00000 Z50.00000 A1.500 C10.000
N3 G1 X0.60000 Y0.00000 Z50.00000 A0.030 C100.000
N4 G1 X0.90000 Y0.00000 Z50.00000 A1.500 C190.000
N5 G1 X1.20000 Y0.00000 Z50.00000 A3.000 C190.000
";
    let settings = settings("sinumerik-840d", ball());
    let rows_of = |text: &str| words(&text.replace(" G0 ", " G1 "));
    for frame in ["", "N6 G0 Z100.00000\nN7 G0 X5.00000 A10.000 C200.000\n"] {
        let text = sinumerik(&format!("{rows}{frame}"));
        let (after, certificate) = certified(smooth(&text, &settings, 0.1));
        let only: String = after
            .split_inclusive('\n')
            .filter(|line| line.contains('A') && line.contains(" Y"))
            .collect();
        assert!(largest_c_step(&rows_of(&only)) < 0.01, "{after}");
        assert!(rows_of(&only)[4][3] < 0.0 || rows_of(&only)[0][3] < 0.0, "{after}");
        assert!(certificate.worst.axis_change_deg.value <= 0.1);
        // what follows still says where it goes
        assert_eq!(
            after.lines().rfind(|line| line.starts_with("N7")),
            text.lines().rfind(|line| line.starts_with("N7"))
        );
    }
}

/// Where X Y Z are the centre of the ball, they stay.
#[test]
fn programs_of_the_centre_keep_their_points() {
    let settings = settings("sinumerik-840d", ball());
    let options = trunnion::rewrite::Options {
        tolerance_deg: 0.08,
        point: trunnion::rewrite::ProgrammedPoint::Centre,
        ..Default::default()
    };
    let (after, certificate) = certified(super::strategy_2::run(
        "smooth-pole",
        &sinumerik(ROWS),
        &settings,
        &options,
    ));
    assert_eq!(certificate.worst.point_shift_mm.value, 0.0);
    assert!(near(largest_c_step(&words(&after)), 1.146, 0.002));
    for (was, is) in words(ROWS).iter().zip(words(&after)) {
        assert_eq!(was[..4], is[..4]);
    }
    assert!(certificate.summary().contains("declared to be the ball's centre"));
    let flat = super::strategy_2::run(
        "smooth-pole",
        &sinumerik(ROWS),
        &super::strategy_2::settings("sinumerik-840d", tool(ToolShape::Flat)),
        &options,
    );
    assert!(refused(flat).contains("not a ball"));
}

/// Whole turns in one motion are meant as they are; arcs too.
#[test]
fn whole_turns_and_arcs_are_left_alone_by_name() {
    let settings = settings("sinumerik-840d", ball());
    let turns = ROWS.replace("A0.081 C52.595", "A0.081 C452.595");
    let reason = refused(smooth(&sinumerik(&turns), &settings, 0.08));
    assert!(reason.contains("more than a whole turn"), "{reason}");
    let arc = ROWS.replace(
        "N2930 G1 X-28.38709 Y-1.53565 Z59.93222",
        "N2930 G2 X-28.38709 Y-1.53565 I0 J10",
    );
    let reason = smooth(&sinumerik(&arc), &settings, 0.08).reasons().expect("a reason");
    assert!(reason.contains("arc"), "{reason}");
}

/// What was turned is recorded, and a further run subtracts it: runs do not add up.
#[test]
fn a_further_run_counts_what_was_turned_before() {
    let fanuc = "%\nO1\nT1 M6\nG43.4 H1\nS8000 M3\nF2000\n";
    for (dialect, text, comment) in [
        ("sinumerik-840d", sinumerik(ROWS), "; trunnion: turned 0.05"),
        ("apt", apt(super::strategy_2::VECTORS), "$$ trunnion: turned 0.05"),
        (
            "fanuc-30i",
            format!("{fanuc}{ROWS}M30\n%\n").replace("A-0.79 ", "A-0.790 "),
            "(trunnion: turned 0.05)",
        ),
    ] {
        let settings = settings(dialect, ball());
        let (once, first) = certified(smooth(&text, &settings, 0.05));
        assert_eq!(once.matches(comment).count(), 1, "{once}");
        let reason = smooth(&once, &settings, 0.05).reasons().expect("a reason");
        assert!(reason.contains("already turned by up to 0.05 deg"), "{reason}");
        let (twice, second) = certified(smooth(&once, &settings, 0.08));
        assert!(second.worst.axis_change_deg.value <= 0.03 + 1e-9, "{:?}", second.worst);
        assert!(second.rotary[0].step_after_deg < first.rotary[0].step_after_deg - 5.0);
        assert_eq!(twice.matches(&comment.replace("0.05", "0.08")).count(), 1, "{twice}");
        assert!(!twice.contains("turned 0.05"), "{twice}");
        // who takes the comment away takes the promise away
        certified(smooth(&once.replace(comment, ""), &settings, 0.05));
    }
}
