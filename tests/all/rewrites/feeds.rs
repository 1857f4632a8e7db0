//! `adapt-feed`: what the axes allow, computed here from their speeds alone; and what its claim must refuse.
use super::strategy_2::{certified, refused, run, settings, sinumerik};
use std::sync::LazyLock;
use trunnion::certify::{Claim, Outcome, certify, recheck};
use trunnion::check::{Assume, Settings};
use trunnion::interp::Setup;
use trunnion::machine::{self, FeedMeaning, Machine};
use trunnion::rewrite::{Attempt, Options};

/// mill-4axis-a (X Y Z and a table that turns about X), whose F is that of X Y Z.
fn mill() -> &'static Machine {
    static MILL: LazyLock<Machine> = LazyLock::new(|| {
        let mut machine = machine::builtin("mill-4axis-a").expect("built in").clone();
        machine.control.feed = Some(FeedMeaning::Xyz);
        machine
    });
    &MILL
}

fn on_mill(dialect: &str) -> Settings<'static> {
    let mut settings = settings(dialect, Setup::default());
    settings.machine = Some(mill());
    settings.assume = Assume::ALL;
    settings
}

fn adapt(text: &str, settings: &Settings<'_>, feed_mm_min: f64) -> Attempt {
    let options = Options {
        feed_mm_min,
        ..Options::default()
    };
    run("adapt-feed", text, settings, &options)
}

/// The highest speed of an axis: mm/min, or deg/min.
fn fastest(letter: u8) -> f64 {
    let machine = machine::builtin("mill-4axis-a").expect("built in");
    let axis = &machine.axes[machine.joint(letter).expect("an axis")];
    let per_second = axis.max_speed.expect("declared");
    60.0 * if letter < b'X' {
        per_second.to_degrees()
    } else {
        per_second
    }
}

/// Without tool centre point control the feed is that of X Y Z, and a turn of 90 deg over 1 mm limits it to (highest speed of A) / 90.
#[test]
fn only_the_block_that_an_axis_limits_is_slower() {
    let text = "G21 G90 G94 G17\nG0 X0 Y0 Z0 A0\nG1 X100 F2000\nX101 A90\nX200\nX300 F500\nX301 A91\nM30\n";
    let allowed = (fastest(b'A') / 90.0 + 1e-9).floor();
    assert!(allowed < 500.0);
    let (after, certificate) = certified(adapt(text, &on_mill("fanuc-30i"), 0.0));
    let expected = text
        .replace("X101 A90", &format!("X101 A90 F{allowed}"))
        .replace("X200\n", "X200 F2000\n");
    assert_eq!(after, expected);
    assert_eq!(certificate.motions.process_changed, 1);
    assert!(
        matches!(adapt(&after, &on_mill("fanuc-30i"), 0.0).outcome(), Ok(None)),
        "once is enough"
    );
    // inch: the same path, feeds in inch per minute with the digits that they need
    let inch = "G20 G90 G94 G17\nG0 X0 Y0 Z0 A0\nG1 X4 F80.\nX4.1 A90\nX8\nM30\n";
    let (after, _) = certified(adapt(inch, &on_mill("fanuc-30i"), 0.0));
    let word = |text: &str| {
        text.lines()
            .nth(3)
            .and_then(|line| line.split('F').nth(1)?.parse::<f64>().ok())
    };
    let limit = fastest(b'A') / 90.0 * 0.1;
    let written = word(&after).expect("an F word");
    assert!(written <= limit && written > 0.99 * limit, "{written} {limit}");
}

/// A small arc asks for acceleration: v^2/R. The feed falls to what X and Y have, the block after it gets its own back, and no higher feed is
/// proved.
#[test]
fn a_bend_is_limited_by_acceleration() {
    let machine = machine::builtin("mill-4axis-a").expect("built in");
    let most = |letter: u8| {
        machine.axes[machine.joint(letter).expect("an axis")]
            .max_acceleration
            .expect("declared")
    };
    let acceleration = most(b'X').min(most(b'Y'));
    let allowed = (60.0 * (acceleration * 0.05).sqrt() + 1e-9).floor();
    let text = "G21 G90 G94 G17\nG0 X0 Y0 Z0 A0\nG1 X10 F8000\nG2 X10.1 I0.05 J0\nG1 X20\nG2 X40 I10 J0\nM30\n";
    assert!(
        allowed < 8000.0 && 60.0 * (acceleration * 10.0).sqrt() > 8000.0,
        "{allowed}"
    );
    let (after, certificate) = certified(adapt(text, &on_mill("fanuc-30i"), 0.0));
    let expected = text
        .replace("I0.05 J0", &format!("I0.05 J0 F{allowed}"))
        .replace("G1 X20", "G1 X20 F8000");
    assert_eq!(after, expected);
    assert_eq!(certificate.motions.process_changed, 1);
    let settings = on_mill("fanuc-30i");
    let judge = |after: &str| {
        certify(
            text.as_bytes(),
            after.as_bytes(),
            settings.dialect,
            settings.machine.expect("a machine"),
            &settings.setup,
            &Claim::AdaptedFeed {
                tolerance_mm: 1e-6,
                tolerance_deg: 1e-6,
                asked_mm_min: 0.0,
            },
        )
    };
    let faster = after.replace(&format!("F{allowed}"), &format!("F{}", allowed + 2.0));
    for wrong in [faster, after.replace("G2 X40 I10 J0", "G2 X40 I10 J0 F7000")] {
        assert!(
            matches!(judge(&wrong), Outcome::Refuted(_)),
            "{wrong}: {:?}",
            judge(&wrong)
        );
    }
    // asked for 20000, a slow arc gets no more than the bend allows
    let slow = text.replace("F8000", "F50");
    let (after, _) = certified(adapt(&slow, &on_mill("fanuc-30i"), 20000.0));
    assert!(after.contains(&format!("I0.05 J0 F{allowed}")), "{after}");
}

/// A cut that is slower than asked becomes as fast as asked, or as fast as the axes allow.
#[test]
fn what_crept_is_made_as_fast_as_asked() {
    let text = "G21 G90 G94 G17\nG0 X0 Y0 Z0 A0\nG1 X100 F50\nX101 A90\nX200\nM30\n";
    let allowed = (fastest(b'A') / 90.0 + 1e-9).floor();
    let (after, _) = certified(adapt(text, &on_mill("fanuc-30i"), 1500.0));
    assert_eq!(
        after,
        text.replace("F50", "F1500")
            .replace("A90", &format!("A90 F{allowed}"))
            .replace("X200\n", "X200 F1500\n")
    );
    // inverse time: 1 mm at 1500 mm/min would take 0.04 s, the turn of 90 deg takes longer
    let inverse = "G21 G90 G93 G17\nG0 X0 Y0 Z0 A0\nG1 X100 F15\nX101 A90 F2\nX201 A90 F2\nM30\n";
    let (after, _) = certified(adapt(inverse, &on_mill("linuxcnc"), 1500.0));
    let most = (fastest(b'A') / 90.0 + 1e-9).floor();
    assert_eq!(
        after,
        inverse.replace("A90 F2\nX201 A90 F2", &format!("A90 F{most}\nX201 A90 F15"))
    );
}

#[test]
fn feeds_that_no_number_of_the_text_says_are_refused() {
    let text = "G21 G90 G94 G17\n#1=2000\nG0 X0 Y0 Z0 A0\nG1 X100 F100\nG1 X101 A90 F#1\nM30\n";
    let reason = refused(adapt(text, &on_mill("fanuc-30i"), 0.0));
    assert!(
        reason.contains("line 5") && reason.contains("not a plain number"),
        "{reason}"
    );
    let text = "G21 G90 G95 G17\nG0 X0 Y0 Z0 A0 S100 M3\nG1 X100 F1\nX101 A90\nM30\n";
    assert!(
        matches!(adapt(text, &on_mill("fanuc-30i"), 0.0).outcome(), Ok(None)),
        "feed per revolution"
    );
}

/// What the claim promises is checked from the two texts.
#[test]
fn other_feeds_than_claimed_are_refuted() {
    let text = "G21 G90 G94 G17\nG0 X0 Y0 Z0 A0\nG1 X100 F2000\nX101 A90\nX200\nM30\n";
    let settings = on_mill("fanuc-30i");
    let machine = settings.machine.expect("a machine");
    let claim = |asked_mm_min| Claim::AdaptedFeed {
        tolerance_mm: 1e-6,
        tolerance_deg: 1e-6,
        asked_mm_min,
    };
    let judge = |after: &str, asked: f64| {
        certify(
            text.as_bytes(),
            after.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
            &claim(asked),
        )
    };
    let refuted = |after: &str, asked: f64, what: &str| match judge(after, asked) {
        Outcome::Refuted(witness) => assert!(witness.message.contains(what), "{witness}"),
        other => panic!("{after}: {other:?}"),
    };
    let good = text.replace("A90", "A90 F40").replace("X200", "X200 F2000");
    assert!(
        matches!(judge(&good, 0.0), Outcome::Proved(_)),
        "{:?}",
        judge(&good, 0.0)
    );
    refuted(&good.replace("F40", "F400"), 0.0, "the axes allow");
    refuted(&text.replace("F2000", "F2500"), 0.0, "is asked for");
    refuted(&text.replace("F2000", "F1500"), 0.0, "which the axes allow");
    refuted(&good.replace("X200 F2000", "X201 F2000"), 0.0, "");
    let other_speed = judge(&good.replace("X200 F2000", "X200 S5 F2000"), 0.0);
    assert!(!matches!(other_speed, Outcome::Proved(_)), "{other_speed:?}");
    let raised = good.replace("X100 F2000", "X100 F2500");
    assert!(matches!(judge(&raised, 2500.0), Outcome::Proved(_)));
    refuted(&raised, 2400.0, "is asked for");
    let Outcome::Proved(certificate) = judge(&good, 0.0) else {
        panic!("proved above")
    };
    let again = recheck(
        &certificate,
        text.as_bytes(),
        good.as_bytes(),
        settings.dialect,
        machine,
        &settings.setup,
    );
    assert!(matches!(again, Outcome::Proved(_)));
}

/// A Fanuc whose parameter decides whether F is the speed of X Y Z alone: no feed is proved there, and none is written.
#[test]
fn a_feed_whose_meaning_is_a_parameter_stays() {
    let text = "G21 G90 G94 G17\nG0 X0 Y0 Z0 A0\nG1 X100 F2000\nX101 A90\nX200\nM30\n";
    let mut settings = on_mill("fanuc-30i");
    settings.machine = machine::builtin("mill-4axis-a");
    let reason = refused(adapt(text, &settings, 0.0));
    assert!(reason.contains("[control] feed"), "{reason}");
    let after = text.replace("A90", "A90 F40").replace("X200", "X200 F2000");
    let claim = Claim::AdaptedFeed {
        tolerance_mm: 1e-6,
        tolerance_deg: 1e-6,
        asked_mm_min: 0.0,
    };
    let judge = |settings: &Settings<'_>| {
        let machine = settings.machine.expect("a machine");
        certify(
            text.as_bytes(),
            after.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
            &claim,
        )
    };
    assert!(
        matches!(judge(&settings), Outcome::Unknown(_)),
        "{:?}",
        judge(&settings)
    );
    settings.machine = Some(mill());
    assert!(matches!(judge(&settings), Outcome::Proved(_)), "{:?}", judge(&settings));
}

/// Under tool centre point control the linear axes follow the turning table, as far out as the work offset says.
#[test]
fn a_feed_that_rests_on_an_undeclared_offset_stays() {
    let rows = "N1 G1 X0 Y0 Z50 A10 C0 F2000\nN2 X0.1 A10 C40\n";
    let mut settings = settings("sinumerik-840d", Setup::default());
    settings.assume = Assume::default();
    let reason = refused(adapt(&sinumerik(rows), &settings, 0.0));
    assert!(reason.contains("--assume work-offset"), "{reason}");
    settings.assume = Assume::ALL;
    certified(adapt(&sinumerik(rows), &settings, 0.0));
}

/// The feed of a tap is the speed of the spindle times the pitch: neither lowered nor raised, and a certificate that frees feeds does not free it.
#[test]
fn taps_keep_their_pitch() {
    let start = "G21 G90 G94 G17 G54\nS10000 M3\nG0 X0. Y0. Z5.\n";
    let machine = machine::builtin("mill-3axis").expect("built in");
    for (dialect, tap) in [
        ("fanuc-30i", "M29 S10000\nG84 X50. Z-5. R1. F16000.\nX60.\nG80\n"),
        ("fanuc-30i", "G74 X50. Z-5. R1. F16000.\nG80\n"),
        ("fanuc-30i", "G63\nG1 Z-5. F16000.\nG64\n"),
        ("fanuc-30i", "G86 X50. Z-5. R1. F16000.\nG80\n"),
        ("haas-ngc", "G84 X50. Z-5. R1. F16000.\nG80\n"),
        (
            "sinumerik-840d",
            "MCALL CYCLE84(5,0,1,-5,,1,3,,1.6,0,5000,5000)\nX50.\nMCALL\n",
        ),
        ("linuxcnc", "G33.1 Z-5. K1.6\n"),
    ] {
        let mut settings = settings(dialect, Setup::default());
        settings.machine = Some(machine);
        settings.assume = Assume::ALL;
        let text = format!("{start}{tap}M30\n");
        for asked in [0.0, 30_000.0] {
            let found = adapt(&text, &settings, asked).outcome();
            assert!(matches!(found, Ok(None)), "{dialect} {asked}: {text}");
        }
        // a cut beside it is adapted all the same
        let beside = format!("{start}{tap}G1 X30. F16000.\nM30\n");
        let found = adapt(&beside, &settings, 0.0);
        let (after, _) = certified(found);
        assert_eq!(after, format!("{start}{tap}G1 X30. F15000.\nM30\n"));
        if tap.contains("F16000") {
            let changed = text.replace("F16000", "F15000");
            let claim = Claim::AdaptedFeed {
                tolerance_mm: 1e-6,
                tolerance_deg: 1e-6,
                asked_mm_min: 0.0,
            };
            let found = certify(
                text.as_bytes(),
                changed.as_bytes(),
                settings.dialect,
                machine,
                &settings.setup,
                &claim,
            );
            assert!(matches!(found, Outcome::Refuted(_)), "{dialect} {text} {found:?}");
        }
    }
}
