//! Faulty twins of test pieces: a check, a comparison or a trace finds what was planted; what cannot be made is refused.
use super::pieces::{MACHINE, column, findings, sample, trace};
use super::tools::{status, str, text, trunnion};
use std::collections::BTreeSet;
use tempfile::TempDir;

#[test]
fn planted_faults_are_found() {
    let folder = TempDir::new().expect("works");
    let cone = [
        "cone",
        "--segments",
        "360",
        "--feed",
        "100",
        "--machine",
        MACHINE,
        "--dialect",
        "fanuc-30i",
    ];
    let good = sample(&folder, "good.nc", &cone);
    let planted = |fault: &str| {
        sample(
            &folder,
            &format!("{fault}.nc"),
            &[&cone[..], &["--plant", fault]].concat(),
        )
    };
    let clean = findings(&good, MACHINE);
    let new =
        |fault: &str| -> BTreeSet<String> { findings(&planted(fault), MACHINE).difference(&clean).cloned().collect() };
    assert!(new("swap").contains("branch-swap"), "{:?}", new("swap"));
    assert!(new("limit").contains("axis-limit"), "{:?}", new("limit"));
    assert!(new("no-tcp").contains("path-deviation"), "{:?}", new("no-tcp"));
    // these move the tool elsewhere: no rule can know where it should be, a comparison can
    for fault in ["wrong-sign", "wrong-h", "feed-unit"] {
        let output = trunnion(&["diff", str(&good), str(&planted(fault)), "--machine", MACHINE]);
        assert_eq!(status(&output), 1, "{fault}: {}", text(&output.stdout));
    }
    let config = folder.path().join("trunnion.toml");
    std::fs::write(
        &config,
        "[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\nG55 = { X = 5, Y = 0, Z = 0 }\n",
    )
    .expect("writable");
    let output = trunnion(&["diff", str(&good), str(&planted("shift-g54")), "--machine", MACHINE]);
    assert_eq!(status(&output), 1, "{}", text(&output.stdout));
}

/// A machine whose tilting axis is 0.05 mm off: programs in axis positions that hold the tip still on the true machine move it there.
#[test]
fn a_pivot_that_is_off_moves_the_fixed_tip() {
    let folder = TempDir::new().expect("works");
    let faulty = sample(
        &folder,
        "off.toml",
        &["fixed-tip", "--machine", MACHINE, "--plant", "pivot"],
    );
    let file = sample(
        &folder,
        "still.mpf",
        &["fixed-tip", "--tilt", "30", "--machine", MACHINE, "--style", "joints"],
    );
    let spread = |machine: &str| -> f64 {
        let rows = trace(&file, machine);
        let still = |name: &str| {
            let values = &column(&rows, name)[1..];
            values.iter().fold(f64::MIN, |h, v| h.max(*v)) - values.iter().fold(f64::MAX, |l, v| l.min(*v))
        };
        ["x_mm", "y_mm", "z_mm"].map(still).into_iter().fold(0.0, f64::max)
    };
    assert!(spread(MACHINE) < 1e-5, "{}", spread(MACHINE));
    // C turns the error round: twice 0.05 sin(30 deg)
    let moved = spread(str(&faulty));
    assert!((moved - 0.05).abs() < 1e-3, "{moved}");
}

#[test]
fn what_cannot_be_made_is_refused_with_a_reason() {
    for (arguments, word) in [
        (&["sample", "cone", "--waves", "2"][..], "--waves"),
        (&["sample", "cone", "--half-angle", "0"], "half angle"),
        (&["sample", "cone", "--machine", "mill-3axis"], "rotary axes"),
        (&["sample", "cone", "--plant", "swap"], "needs a machine"),
        (&["sample", "cone", "--machine", MACHINE, "--dialect", "grbl"], "grbl"),
        (
            &[
                "sample",
                "cone",
                "--machine",
                MACHINE,
                "--style",
                "vectors",
                "--plant",
                "swap",
            ],
            "vectors",
        ),
        (
            &[
                "sample",
                "cone",
                "--half-angle",
                "70",
                "--tilt",
                "60",
                "--machine",
                MACHINE,
            ],
            "half angle + tilt",
        ),
        (&["sample", "saddle", "--answers"], "closed-form"),
    ] {
        let output = trunnion(arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(
            text(&output.stderr).contains(word),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
    }
}
