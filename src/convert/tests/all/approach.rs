//! Rapids before the tool's length is active keep it inactive, and modes of path control are carried over.
use crate::support::{machine, refusal, text, to};
use trunnion_certify::conversion::Assume;
use trunnion_convert::{Options, Source, Target, builtin_post, convert};
use trunnion_interp::{Setup, WorkOffset};

/// A Fanuc program whose tool 1 is `length` (a declaration or nothing) and approaches with these blocks.
fn approach(length: &str, blocks: &str) -> String {
    format!(
        "%\nO0001\n{length}G21 G90 G17 G54 G94\nT1 M6\nS1000 M3\n{blocks}\nG1 Z-1. F100.\nX20.\nG0 Z50.\nM5\nM30\n%\n"
    )
}

const DECLARED: &str = "(trunnion: tool 1 flat diameter 10 length 100)\n";

/// Where each line with a `Z` or `G43` comes.
fn heights(text: &str) -> Vec<String> {
    let words = |line: &str| -> String {
        let keep = |word: &&str| !word.starts_with('N') && !word.starts_with('F');
        line.split(' ').filter(keep).collect::<Vec<_>>().join(" ")
    };
    text.lines()
        .filter(|line| line.contains('Z') || line.contains("G43") || line.contains("G49 ") || line.ends_with("G49"))
        .filter(|line| !line.contains("G90"))
        .map(words)
        .collect()
}

/// `G43 H1 Z50` moves with the length of tool 1. Written before it, the same Z would plunge by the length.
#[test]
fn a_rapid_with_a_length_is_never_written_before_it() {
    for length in ["", DECLARED] {
        let program = approach(length, "G0 G43 H1 Z50.\nX0 Y0");
        for machine in ["", "mill-3axis"] {
            let made = text(to(
                (&program, "fanuc-30i", machine),
                "haas-ngc",
                machine,
                &Options::default(),
            ));
            assert_eq!(heights(&made)[0], "G0 G43 H1 Z50.", "{made}");
        }
    }
}

/// An undeclared length: what is programmed before G43 is written before G43, and after G49 after G49.
#[test]
fn rapids_without_an_undeclared_length_stay_without_it() {
    let program = approach("", "G0 X0 Y0 Z250.\nG43 H1 Z50.");
    let made = text(to(
        (&program, "fanuc-30i", "mill-3axis"),
        "haas-ngc",
        "mill-3axis",
        &Options::default(),
    ));
    assert_eq!(
        heights(&made)[..2],
        ["G0 X0. Y0. Z250.", "G0 G43 H1 X0. Y0. Z50."],
        "{made}"
    );
}

/// A declared length: the place of the tip is known, and Z is written for it.
#[test]
fn rapids_without_a_declared_length_keep_the_tip_in_place() {
    let program = approach(DECLARED, "G0 X0 Y0 Z250.\nG43 H1 Z50.");
    let made = text(to(
        (&program, "fanuc-30i", "mill-3axis"),
        "haas-ngc",
        "mill-3axis",
        &Options::default(),
    ));
    assert_eq!(heights(&made)[..2], ["G0 G43 H1 X0. Y0. Z150.", "Z50."], "{made}");
}

/// After a change of tool, the tip under G49 is that of the tool in the spindle, not of the length that was active before.
#[test]
fn a_length_of_the_last_tool_is_not_that_of_the_next() {
    let declared = format!("{DECLARED}(trunnion: tool 2 flat diameter 8 length 60)\n");
    let blocks = "G0 X0 Y0\nG43 H1 Z50.\nT2 M6\nM3\nG0 X1. Y1.\nG49 Z200.\nG43 H2 Z60.";
    let program = approach(&declared, blocks);
    let made = text(to(
        (&program, "fanuc-30i", "mill-3axis"),
        "haas-ngc",
        "mill-3axis",
        &Options::default(),
    ));
    // spindle at 200: the tip of tool 2 is at 140
    assert!(made.contains("Z140."), "{made}");
    assert!(!made.contains("Z100."), "{made}");
}

/// The modes mean the same under other codes.
#[test]
fn modes_of_path_control_are_written_in_the_words_of_the_target() {
    let program = approach(DECLARED, "G64\nG0 X0 Y0\nG43 H1 Z50.\nG61\nG1 X1. F100.\nG64");
    for (dialect, stop) in [
        ("fanuc-30i", "G61"),
        ("haas-ngc", "G61"),
        ("sinumerik-840d", "G60"),
        ("linuxcnc", "G61.1"),
    ] {
        let made = text(to((&program, "fanuc-30i", ""), dialect, "", &Options::default()));
        let modes: Vec<&str> = made
            .lines()
            .map(|line| line.split(' ').next_back().unwrap_or_default())
            .filter(|word| *word == stop || *word == "G64")
            .collect();
        assert_eq!(modes, ["G64", stop, "G64"], "{dialect}:\n{made}");
    }
}

/// What has no counterpart is refused by name; a permission that the target does not need is left out, and listed.
#[test]
fn exact_stop_is_never_lost() {
    let program = approach(DECLARED, "G64\nG0 X0 Y0\nG43 H1 Z50.\nG61");
    for dialect in ["grbl", "apt"] {
        let refused = refusal(to((&program, "fanuc-30i", ""), dialect, "", &Options::default()));
        assert!(refused.message.contains("`--drop G61`"), "{dialect}: {refused}");
    }
    let program = approach(DECLARED, "G64\nG0 X0 Y0\nG43 H1 Z50.");
    let made = to((&program, "fanuc-30i", ""), "grbl", "", &Options::default());
    let made = made.unwrap_or_else(|refused| panic!("{refused}"));
    assert_eq!(made.left_out.first().map(|(name, _)| name.as_str()), Some("G64"));
    // LinuxCNC's exact path stops nowhere on a straight line: a Fanuc has no such mode
    let program = "G21 G90 G17 G54 G94\nT1 M6\nS1000 M3\nG61\nG0 X0 Y0\nG43 H1 Z50\nG1 Z-1 F100\nM2\n";
    let refused = refusal(to((program, "linuxcnc", ""), "fanuc-30i", "", &Options::default()));
    assert!(refused.message.contains("`--drop G61`"), "{refused}");
}

/// A retract in machine coordinates goes where it went, whatever the program adds to the zero point; where the zero point is not declared, it is left out.
#[test]
fn machine_coordinates_ignore_what_the_program_shifts() {
    let program = "; trunnion: tool 1 flat diameter 10 length 100\nG710 G17 G90 G94 G54\nT1 M6\nD1\nS1000 M3\nG0 X0 Y0 Z50\nG1 Z-1 F100\n\
                   G0 Z50\nATRANS Z3\nG0 SUPA Z250 D0\nM5\nM30\n";
    let made = |setup: &Setup| {
        let source = Source {
            text: program.as_bytes(),
            dialect: trunnion_dialect::builtin("sinumerik-840d").expect("built in"),
            machine: machine("mill-3axis"),
            setup,
            assume: Assume::default(),
        };
        let target = Target::Code {
            post: builtin_post("fanuc-30i").expect("built in"),
            machine: machine("mill-3axis"),
        };
        convert(&source, &target, &Options::default()).unwrap_or_else(|refused| panic!("{refused}"))
    };
    let mut declared = Setup::default();
    let mut values = [0.0; 9];
    values[2] = 20.0;
    declared.work_offsets.push(WorkOffset {
        name: "G54".into(),
        values,
    });
    // spindle at 250, zero point at 20, length 100
    let text = made(&declared).text;
    assert!(text.contains("Z130."), "{text}");
    let open = made(&Setup::default());
    assert_eq!(
        (open.proof.left_out, open.text.contains("Z150.")),
        (1, false),
        "{}",
        open.text
    );
}
