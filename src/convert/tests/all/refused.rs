//! What cannot be converted is refused with its place and a way out.
use crate::support::{refusal, to};
use std::fmt::Write;
use trunnion_convert::Options;

fn refused(from: (&str, &str, &str), dialect: &str, machine: &str, options: &Options) -> (Option<(u32, u32)>, String) {
    let refused = refusal(to(from, dialect, machine, options));
    (refused.place, refused.message)
}

#[test]
fn programs_that_say_too_little_or_too_much() {
    let head = "UNITS/MM\nFEDRAT/500\nRAPID\nGOTO/0,0,10,0,0,1\n";
    let five = "mikron-ucp710";
    let no = Options::default();
    for (tail, dialect, machine, line, why) in [
        ("GOTO/1,0,0,0,0,-1\n", "sinumerik-840d", five, 5, "outside the travel"),
        (
            "GOTO/1,0,0,1,0,0\n",
            "fanuc-30i",
            "mill-3axis",
            5,
            "cannot point the tool",
        ),
        (
            "GOTO/1,0,0,1,0,0\n",
            "linuxcnc",
            "maho-600e",
            5,
            "the number of the tool",
        ),
        ("INSERT/G65 P9000\n", "sinumerik-840d", five, 5, "--insert-is-remark"),
        (
            "CYCLE/DRILL,DEPTH,5\nGOTO/1,1,0\n",
            "sinumerik-840d",
            five,
            5,
            "not modelled: ",
        ),
        ("CUTCOM/LEFT\nGOTO/1,1,0\n", "sinumerik-840d", five, 5, "cutter radius"),
        ("FROBNI/1\nGOTO/1,1,0\n", "sinumerik-840d", five, 5, "unknown record"),
        ("DWELL/1\n", "sinumerik-840d", five, 5, "DELAY"),
        ("AUXFUN/MANY\n", "sinumerik-840d", five, 5, "AUXFUN/MANY"),
        ("COOLNT/THRU\n", "sinumerik-840d", five, 5, "coolant-thru"),
        ("SPINDL/ON\n", "sinumerik-840d", five, 5, "unknown speed"),
        ("GOTO/1,1\n", "sinumerik-840d", five, 5, "not understood"),
    ] {
        let text = format!("{head}{tail}FINI\n");
        let (place, message) = refused((&text, "apt", ""), dialect, machine, &no);
        assert!(message.contains(why), "{tail}: {message}");
        if why != "the number of the tool" {
            assert_eq!(place.map(|(line, _)| line), Some(line), "{tail}: {message}");
        }
    }
}

#[test]
fn what_a_control_lacks_is_said_before_anything_is_read() {
    let text = "UNITS/MM\nFEDRAT/500\nGOTO/0,0,10,0,0,1\nFINI\n";
    let vectors = Options {
        orientation: trunnion_convert::OrientationWords::Vectors,
        ..Options::default()
    };
    let both = Options {
        tcp: false,
        ..vectors.clone()
    };
    for (dialect, options, why) in [
        ("iso-6983", &Options::default(), "--no-tcp"),
        ("grbl", &Options::default(), "--no-tcp"),
        ("haas-ngc", &vectors, "tool vectors"),
        ("linuxcnc", &vectors, "tool vectors"),
        ("sinumerik-840d", &both, "remove --no-tcp"),
    ] {
        let (_, message) = refused((text, "apt", ""), dialect, "mikron-ucp710", options);
        assert!(message.contains(why), "{dialect}: {message}");
    }
}

#[test]
fn g_code_needs_what_it_does_not_say() {
    let no = Options::default();
    for (text, dialect, machine, place, why) in [
        (
            "G21 G90\nG0 X0 Y0 Z5\nG1 X1\nM30\n",
            "iso-6983",
            "",
            Some((3, 1)),
            "--feed",
        ),
        (
            "G0 X0 Y0 Z5\nG1 X1 A5 F100\nM30\n",
            "iso-6983",
            "",
            Some((2, 1)),
            "--machine",
        ),
        (
            "G0 X0 Y0 Z5\n/G1 X1 F100\nM30\n",
            "iso-6983",
            "",
            Some((2, 1)),
            "block delete",
        ),
        (
            "G0 X0 Y0 Z5\nM77\nM30\n",
            "sinumerik-840d",
            "",
            Some((2, 1)),
            "--drop M77",
        ),
        (
            "T=\"DRILL\" M6\nM30\n",
            "sinumerik-840d",
            "",
            Some((1, 1)),
            "without a number",
        ),
        (
            "G0 X0. Y0. Z5.\nG28 G91 Z0.\nG90 G1 X5. F100.\nM30\n",
            "fanuc-30i",
            "",
            Some((2, 1)),
            "",
        ),
    ] {
        let (found, message) = refused((text, dialect, machine), "apt", "", &no);
        assert!(message.contains(why), "{text}: {message}");
        assert_eq!(found, place, "{text}: {message}");
    }
    let (_, message) = refused(
        ("o100 sub\no100 endsub\nG0 X0 Y0 Z#5061\nM2\n", "linuxcnc", ""),
        "apt",
        "",
        &no,
    );
    assert!(
        message.contains("#5061, the position where the probe touched"),
        "{message}"
    );
}

#[test]
fn codes_are_dropped_only_when_told() {
    let text = "G0 X0 Y0 Z5\nM77\nG64\nM30\n";
    let drop = Options {
        drop: vec!["m77".to_owned()],
        ..Options::default()
    };
    let made = to((text, "sinumerik-840d", ""), "apt", "", &drop).expect("converted");
    let told: Vec<&str> = made.left_out.iter().map(|(what, _)| what.as_str()).collect();
    assert_eq!(told, ["M77", "G64"]);
    assert_eq!(made.left_out[0].1, 2);
}

/// C may turn by 400 deg in all: the circle about the part does not fit into it.
#[test]
fn a_forced_swap_is_refused_with_its_place_and_allowed_when_told() {
    let source = trunnion_machine::builtin_source("mikron-ucp710").expect("built in");
    let narrow = source
        .split("[[check]]")
        .next()
        .expect("a machine")
        .replace("limits = \"unbounded\"", "limits = [-200, 200]");
    let machine = trunnion_machine::load("narrow", &narrow).expect("valid");
    let mut text = String::from("UNITS/MM\nLOADTL/1\nFEDRAT/500,MMPM\nRAPID\nGOTO/50,0,0,0.5,0,0.866025404\n");
    for step in 1..=50 {
        let (sin, cos) = trunnion_geometry::math::sin_cos(f64::from(step) * 0.2);
        let _ = writeln!(
            text,
            "GOTO/{:.6},{:.6},0,{:.9},{:.9},0.866025404",
            50.0 * cos,
            50.0 * sin,
            0.5 * cos,
            0.5 * sin
        );
    }
    text.push_str("FINI\n");
    let setup = trunnion_interp::Setup::default();
    let source = trunnion_convert::Source {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin("apt").expect("built in"),
        machine: None,
        setup: &setup,
        assume: trunnion_certify::conversion::Assume::default(),
    };
    let target = trunnion_convert::Target::Code {
        post: trunnion_convert::builtin_post("sinumerik-840d").expect("built in"),
        machine: Some(&machine),
    };
    let refused = refusal(trunnion_convert::convert(&source, &target, &Options::default()));
    assert!(
        refused.message.contains("--allow-swap") && refused.place.is_some_and(|(line, _)| line > 20),
        "{refused}"
    );
    let allow = Options {
        allow_swap: true,
        ..Options::default()
    };
    let made = trunnion_convert::convert(&source, &target, &allow).expect("proved");
    assert_eq!(made.swaps.len(), 1, "ten rad need one way back: {:?}", made.swaps);
}

#[test]
fn a_head_without_tool_length_is_not_guessed() {
    let text = "UNITS/MM\nLOADTL/3\nFEDRAT/500\nRAPID\nGOTO/0,0,10,0,0,1\nGOTO/5,0,0,0.1,0,0.994987437\nFINI\n";
    let no_tcp = Options {
        tcp: false,
        ..Options::default()
    };
    let (place, message) = refused((text, "apt", ""), "linuxcnc", "ferrari-bc", &no_tcp);
    assert!(message.contains("length of tool 3") && place.is_some(), "{message}");
    let long = text.replace("LOADTL/3", "LOADTL/3,LENGTH,120");
    to((&long, "apt", ""), "linuxcnc", "ferrari-bc", &no_tcp).expect("proved");
}

/// Past the pole at 0.1 deg: the cheap way changes the posture, but on the great circle that the machine file declares C turns half round.
#[test]
fn a_posture_that_no_great_circle_leads_to_is_refused() {
    let source = trunnion_machine::builtin_source("mikron-ucp710").expect("built in");
    let even = source.split("[[check]]").next().expect("a machine");
    let circle = even.replace("orientation = \"joint\"", "orientation = \"great-circle\"");
    let text = "UNITS/MM\nLOADTL/1\nFEDRAT/500,MMPM\nRAPID\nGOTO/50,0,0,0,-0.052335956,0.998629535\n\
        GOTO/40,0,0,0.0017453284,0.052306843,0.998629535\nFINI\n";
    let setup = trunnion_interp::Setup::default();
    let source = trunnion_convert::Source {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin("apt").expect("built in"),
        machine: None,
        setup: &setup,
        assume: trunnion_certify::conversion::Assume::default(),
    };
    let onto = |machine: &str, allow_swap: bool| {
        let machine = trunnion_machine::load("test", machine).expect("valid");
        let target = trunnion_convert::Target::Code {
            post: trunnion_convert::builtin_post("sinumerik-840d").expect("built in"),
            machine: Some(&machine),
        };
        let options = Options {
            allow_swap,
            ..Options::default()
        };
        trunnion_convert::convert(&source, &target, &options)
    };
    let refused = refusal(onto(&circle, false));
    assert!(refused.message.contains("great circle"), "{refused}");
    assert_eq!(refused.place.map(|(line, _)| line), Some(6));
    assert_eq!(onto(&circle, true).expect("told").swaps, [6]);
    assert_eq!(onto(even, false).expect("proved").swaps, [] as [u32; 0]);
}

/// A cut without the length of its tool, or with that of another one: to write it with the length of its own would lift the spindle by it. Without a
/// length at all it stays where it is: its Z is written for the declared length.
#[test]
fn a_length_that_was_not_in_force_is_not_switched_on() {
    let options = Options::default();
    let declared = "(trunnion: tool 1 ball diameter 10 length 80)\n(trunnion: tool 5 ball diameter 10 length 90)\n";
    // of undeclared lengths it is known whose they are
    for (head, code, is_refused) in [
        (declared, "", false),
        (declared, "G43 H5", true),
        (declared, "G43 H1", false),
        ("", "", true),
        ("", "G43 H5", true),
        ("", "G43 H1", false),
    ] {
        let text = format!(
            "{head}G21 G90 G94\nT1 M6\nS5000 M3\n{code}\n\
             G0 X1. Y4. Z41. A0. C0.\nG1 X26.9 F2000.\nM30\n"
        );
        let made = to(
            (&text, "fanuc-30i", "mikron-ucp710"),
            "fanuc-30i",
            "mikron-ucp710",
            &options,
        );
        match made {
            Ok(made) => {
                assert!(!is_refused, "{code}");
                let height = if code == "G43 H1" { "Z41." } else { "Z-39." };
                assert!(made.text.contains(height), "{code}: {}", made.text);
            }
            Err(refused) => assert!(
                is_refused && refused.message.contains("tool length"),
                "{head}{code}: {}",
                refused.message
            ),
        }
    }
}

/// A code that the conversion itself writes is not dropped, and a name that the program does not contain is a slip.
#[test]
fn a_drop_that_leaves_out_nothing_is_refused() {
    let text = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nS1000 M3\nG0 X0. Y0. Z50.\nG1 Z0. F100.\nM5\nM30\n%\n";
    for name in ["M3", "M123"] {
        let options = Options {
            drop: vec![name.to_owned()],
            ..Options::default()
        };
        let (_, message) = refused(
            (text, "fanuc-30i", "mill-3axis"),
            "sinumerik-840d",
            "mill-3axis",
            &options,
        );
        assert!(
            message.contains(&format!("`--drop {name}` leaves out nothing")),
            "{message}"
        );
    }
}
