//! Machines of all kinds as targets: tool centre point control from the start, held axes, travels, LinuxCNC.
use crate::support::{machine, refusal, text, to};
use trunnion_certify::conversion::Assume;
use trunnion_convert::{Converted, Options, Refused, Source, Target, builtin_post, convert};
use trunnion_interp::{Setup, WorkOffset};

const PIECE: &str = include_str!("../../../../samples/programs/apt/small-piece.apt");

fn linuxcnc(name: &str, tcp: bool) -> Result<Converted, Refused> {
    let options = Options {
        tcp,
        ..Options::default()
    };
    to((PIECE, "apt", ""), "linuxcnc", name, &options)
}

/// The codes are those that the machine's file names, in their own sense.
#[test]
fn linuxcnc_leads_the_tip_by_the_codes_of_the_machine() {
    for (name, on, off) in [
        ("linuxcnc-xyzac-trt", "M428", "M429"),
        ("linuxcnc-xyzbc-trt-conventional", "M428", "M429"),
        ("linuxcnc-xyzab-tdr", "M428", "M429"),
        ("linuxcnc-xyzacb-trsrn", "M429", "M428"),
    ] {
        let written = text(linuxcnc(name, true));
        let lines: Vec<&str> = written.lines().collect();
        let place = |code: &str| lines.iter().position(|line| *line == code);
        let first = lines.iter().position(|line| line.starts_with("G0 "));
        let (on, off) = (place(on).expect("switched on"), place(off).expect("switched off"));
        assert!(Some(on) < first && first < Some(off), "{name}\n{written}");
    }
    insta::assert_snapshot!(text(linuxcnc("linuxcnc-xyzac-trt", true)));
}

/// The bridge mill leads the tip when a program begins: it is ended before the tool change, and for good without.
#[test]
fn a_machine_that_leads_the_tip_from_the_start() {
    let written = text(linuxcnc("linuxcnc-bridge-mill", true));
    let place = |text: &str| written.find(text).unwrap_or_else(|| panic!("no {text} in\n{written}"));
    assert!(
        place("\nM429\n") < place(" M6\n") && place(" M6\n") < place("\nM428\n"),
        "{written}"
    );
    let joints = text(linuxcnc("linuxcnc-bridge-mill", false));
    assert!(joints.contains("\nM429\n") && !joints.contains("M428"), "{joints}");
    // and back: the same points
    let back = to(
        (&joints, "linuxcnc", "linuxcnc-bridge-mill"),
        "apt",
        "",
        &Options::default(),
    )
    .expect("proved");
    assert!(back.proof.path_mm <= 0.01, "{:?}", back.proof);
}

/// Nothing ends it on this machine, so nothing is written, and joints cannot be.
#[test]
fn a_machine_that_always_leads_the_tip() {
    let written = text(linuxcnc("linuxcnc-max5", true));
    assert!(!written.contains("M428") && !written.contains("M429"), "{written}");
    let refused = refusal(linuxcnc("linuxcnc-max5", false));
    assert!(
        refused.message.contains("names no code that switches it off"),
        "{refused}"
    );
}

/// An axis that the kinematics are not solved for is told where it stands, once.
#[test]
fn axes_beyond_five_are_told_where_they_stand() {
    for (name, word) in [("linuxcnc-xyzacb-trsrn", " A0"), ("linuxcnc-bridge-mill", " W0")] {
        let written = text(linuxcnc(name, true));
        assert_eq!(written.matches(word).count(), 1, "{name}\n{written}");
    }
}

fn with_zero(x: Option<f64>, options: &Options) -> Result<Converted, Refused> {
    let mut setup = Setup::default();
    if let Some(x) = x {
        let mut values = [0.0; 9];
        values[0] = x;
        setup.work_offsets.push(WorkOffset {
            name: "G54".to_owned(),
            values,
        });
    }
    let source = Source {
        text: b"UNITS/MM\nLOADTL/1\nSPINDL/5000,CLW\nFEDRAT/500\nRAPID\nGOTO/0,0,50,0,0,1\nGOTO/100,0,50,0,0,1\nGOTO/300,0,50,0,0,1\nFINI\n",
        dialect: trunnion_dialect::builtin("apt").expect("built in"),
        machine: None,
        setup: &setup,
        assume: Assume::default(),
    };
    let target = Target::Code {
        post: builtin_post("sinumerik-840d").expect("built in"),
        machine: machine("mikron-ucp710"),
    };
    convert(&source, &target, options)
}

/// X of the Mikron ends at 355 mm. From a declared zero the program is refused, from one that nobody declared it is told.
#[test]
fn the_travel_of_linear_axes_is_kept_or_told() {
    for tcp in [true, false] {
        let options = Options {
            tcp,
            ..Options::default()
        };
        let inside = with_zero(Some(54.0), &options).expect("inside");
        assert_eq!((inside.beyond, inside.travel_undecided), (vec![], vec![]));
        let refused = refusal(with_zero(Some(56.0), &options));
        assert!(
            refused
                .message
                .contains("X would go to 356.0000 mm, its limit is 355.0000 mm"),
            "{refused}"
        );
        assert_eq!(refused.place.map(|(line, _)| line), Some(8), "{refused}");
        assert!(with_zero(None, &options).expect("inside").beyond.is_empty());
    }
    // the same travel, told: no zero is declared
    let far = "UNITS/MM\nLOADTL/1\nSPINDL/5000,CLW\nFEDRAT/500\nRAPID\nGOTO/0,0,50,0,0,1\nGOTO/400,0,50,0,0,1\nFINI\n";
    let told = to((far, "apt", ""), "sinumerik-840d", "mikron-ucp710", &Options::default()).expect("told");
    assert_eq!(told.beyond.len(), 1);
    assert_eq!(
        (told.beyond[0].line, told.beyond[0].axis, told.beyond[0].value),
        (7, 'X', 400.0)
    );
}

/// Both ends are legal, and between them the table swings the tip's place beyond the travel.
#[test]
fn a_travel_that_is_left_inside_a_block_is_told() {
    // C turns by 60 deg about the machine zero with the tip at a radius of 400 mm: at both ends X is 346.4 mm, half way 400 mm
    let text = "TRAORI\nG54\nG0 X400 Y0 Z50 A0 C0\nM3 S1000\nG0 X346.41016 Y-200 A20 C-30\nG1 X346.41016 Y200 C30 F500\nTRAFOOF\nM30\n";
    let made = to(
        (text, "sinumerik-840d", "mikron-ucp710"),
        "sinumerik-840d",
        "mikron-ucp710",
        &Options::default(),
    )
    .expect("told");
    assert!(made.beyond.iter().any(|one| one.axis == 'X'), "{:?}", made.beyond);
}

/// Y leans by atan(3/4) towards Z: 8 mm of the tip along Y are 10 mm of Y and -6 mm of Z, which F counts. The way along X is what it is.
#[test]
fn f_counts_along_axes_that_stand_askew() {
    let source = trunnion_machine::builtin_source("mill-3axis").expect("built in");
    let source = source.split("[[check]]").next().expect("a first part");
    let source = source.replacen("dir = [0, 1, 0]", "dir = [0, 0.8, 0.6]", 1);
    let askew = trunnion_machine::load("askew", &source).unwrap_or_else(|error| panic!("{}", error.message));
    let cl = "UNITS/MM\nRAPID\nGOTO/0,0,5\nFEDRAT/600,MMPM\nGOTO/0,0,0\nGOTO/20,0,0\nGOTO/20,8,0\nGOTO/20,0,0\nFINI\n";
    let options = Options {
        tcp: false,
        ..Options::default()
    };
    let run = |text: &str, from: (&str, Option<&trunnion_machine::Machine>), target: &Target<'_>| {
        let source = Source {
            text: text.as_bytes(),
            dialect: trunnion_dialect::builtin(from.0).expect("built in"),
            machine: from.1,
            setup: &Setup::default(),
            assume: Assume::default(),
        };
        convert(&source, target, &options).unwrap_or_else(|refused| panic!("{refused}"))
    };
    let to_askew = Target::Code {
        post: builtin_post("fanuc-30i").expect("built in"),
        machine: Some(&askew),
    };
    let feeds = |text: &str| -> Vec<f64> {
        let words = text.split_ascii_whitespace().filter_map(|word| word.strip_prefix('F'));
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let made = run(cl, ("apt", None), &to_askew);
    // root(10^2 + 6^2) / 8 of 600
    let stretched = 600.0 * 136f64.sqrt() / 8.0;
    let found = feeds(&made.text);
    assert!(
        found.len() == 2 && found[0] == 600.0 && (found[1] - stretched).abs() < 0.01,
        "{found:?}\n{}",
        made.text
    );
    // the same machine again: the same numbers; CL data again: what the tip does
    let again = run(&made.text, ("fanuc-30i", Some(&askew)), &to_askew);
    let same = feeds(&again.text);
    assert!(
        same.len() == 2 && (same[1] - found[1]).abs() < 0.01,
        "{same:?}\n{}",
        again.text
    );
    let back = run(&made.text, ("fanuc-30i", Some(&askew)), &Target::Apt).text;
    let back: Vec<f64> = back
        .lines()
        .filter_map(|line| line.strip_prefix("FEDRAT/")?.split(',').next()?.parse().ok())
        .collect();
    assert!(
        !back.is_empty() && back.iter().all(|feed| (feed - 600.0).abs() < 0.05),
        "{back:?}"
    );
}

/// Half a circle of X and Y of radius 10 at F600 takes 3.14159 s, whatever the tip runs meanwhile on axes that stand askew.
#[test]
fn an_arc_of_axes_that_stand_askew_takes_as_long_as_it_did() {
    let source = trunnion_machine::builtin_source("mill-3axis").expect("built in");
    let source = source.split("[[check]]").next().expect("a first part");
    let source = source.replacen("dir = [0, 1, 0]", "dir = [0, 0.8, 0.6]", 1);
    let askew = trunnion_machine::load("askew", &source).unwrap_or_else(|error| panic!("{}", error.message));
    let source = Source {
        text: b"G21 G17 G90 G94\nG0 X0. Y0. Z0.\nG2 X0. Y20. J10. F600.\nM30\n",
        dialect: trunnion_dialect::builtin("fanuc-30i").expect("built in"),
        machine: Some(&askew),
        setup: &Setup::default(),
        assume: Assume::default(),
    };
    let made = convert(&source, &Target::Apt, &Options::default()).unwrap_or_else(|refused| panic!("{refused}"));
    let (mut feed, mut seconds, mut before) = (f64::NAN, 0.0, None::<Vec<f64>>);
    for line in made.text.lines() {
        let numbers = |rest: &str| -> Vec<f64> { rest.split(',').filter_map(|number| number.parse().ok()).collect() };
        if let Some(rest) = line.strip_prefix("FEDRAT/") {
            feed = numbers(rest)[0];
        } else if let Some(rest) = line.strip_prefix("GOTO/") {
            let here = numbers(rest);
            if let Some(before) = before.filter(|_| feed.is_finite()) {
                let way = here
                    .iter()
                    .zip(&before)
                    .take(3)
                    .map(|(a, b)| (a - b) * (a - b))
                    .sum::<f64>()
                    .sqrt();
                seconds += way / feed * 60.0;
            }
            before = Some(here);
        }
    }
    assert!(
        (seconds / core::f64::consts::PI - 1.0).abs() < 1e-3,
        "{seconds}\n{}",
        made.text
    );
}
