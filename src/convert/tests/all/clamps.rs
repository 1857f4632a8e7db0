//! Codes of clamps in what is written: `check` finds them right on the same machine.
use trunnion_certify::conversion::Assume;
use trunnion_check::{Settings, check};
use trunnion_convert::{Converted, Options, OrientationWords, Refused, Source, Target, builtin_post, convert};
use trunnion_interp::Setup;
use trunnion_machine::{Machine, builtin_source, load};

/// Three faces, one after the other, of which the last needs C alone to turn.
const INDEXED: &str = "\
PARTNO THREE FACES
UNITS/MM
MULTAX/ON
CUTTER/10,5
LOADTL/1,LENGTH,100
SPINDL/3000,RPM,CLW
RAPID
GOTO/0,0,80,0,0,1
RAPID
GOTO/0,0,2,0,0,1
FEDRAT/500,MMPM
GOTO/0,0,0,0,0,1
GOTO/20,0,0,0,0,1
GOTO/20,10,0,0,0,1
RAPID
GOTO/20,10,80,0,0,1
RAPID
GOTO/0,0,80,0.6,0,0.8
RAPID
GOTO/0,0,2,0.6,0,0.8
FEDRAT/500,MMPM
GOTO/0,0,0,0.6,0,0.8
GOTO/0,20,0,0.6,0,0.8
RAPID
GOTO/0,20,80,0.6,0,0.8
RAPID
GOTO/0,0,80,0,0.6,0.8
RAPID
GOTO/0,0,2,0,0.6,0.8
FEDRAT/500,MMPM
GOTO/0,0,0,0,0.6,0.8
GOTO/20,0,0,0,0.6,0.8
RAPID
GOTO/20,0,80,0,0.6,0.8
SPINDL/OFF
FINI
";

/// One pass in which both axes turn, then one in which neither does.
const TURNED: &str = "\
UNITS/MM
MULTAX/ON
CUTTER/10,5
LOADTL/1,LENGTH,100
SPINDL/3000,RPM,CLW
RAPID
GOTO/0,0,50,0.1,0,0.994987437
FEDRAT/500,MMPM
GOTO/0,0,0,0.1,0,0.994987437
GOTO/10,0,0,0.1,0.1,0.989949494
RAPID
GOTO/10,0,50,0.1,0.1,0.989949494
FEDRAT/500,MMPM
GOTO/10,0,0,0.1,0.1,0.989949494
FINI
";

const CODES: [&str; 2] = ["{ on = \"M10\", off = \"M11\" }", "{ on = \"M12\", off = \"M13\" }"];

/// A built-in machine with the keys at its axes A and C.
fn with_keys(name: &str, keys: [&str; 2]) -> Machine {
    let mut source = builtin_source(name).expect("built in").to_owned();
    for (letter, key) in ["A", "C"].into_iter().zip(keys) {
        let axis = format!("letter = \"{letter}\"\n");
        assert!(source.contains(&axis), "{name}");
        source = source.replacen(&axis, &format!("{axis}{key}\n"), 1);
    }
    load(name, &source).unwrap_or_else(|error| panic!("{}", error.message))
}

fn with_codes(name: &str, codes: [&str; 2]) -> Machine {
    let keys = codes.map(|codes| format!("clamp_codes = {codes}"));
    with_keys(name, [&keys[0], &keys[1]])
}

fn setup_of(machine: &Machine) -> Setup {
    let mut setup = Setup::default();
    Machine::tell(Some(machine), &mut setup.control);
    setup
}

fn written(
    text: &str,
    from: (&str, Option<&Machine>),
    dialect: &str,
    machine: &Machine,
    options: &Options,
) -> Converted {
    tried(text, from, dialect, machine, options).unwrap_or_else(|refused| panic!("{refused}"))
}

fn tried(
    text: &str,
    from: (&str, Option<&Machine>),
    dialect: &str,
    machine: &Machine,
    options: &Options,
) -> Result<Converted, Refused> {
    let setup = from.1.map(setup_of).unwrap_or_default();
    let source = Source {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin(from.0).expect("built in"),
        machine: from.1,
        setup: &setup,
        assume: Assume::default(),
    };
    let target = Target::Code {
        post: builtin_post(dialect).expect("built in"),
        machine: Some(machine),
    };
    convert(&source, &target, options)
}

/// CL data as text for a Haas that leads the tip.
fn haas(cl: &str, machine: &Machine) -> Converted {
    written(cl, ("apt", None), "haas-ngc", machine, &options(true, false))
}

/// What `check` says about clamps.
fn findings(text: &str, dialect: &str, machine: &Machine) -> Vec<String> {
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let settings = Settings::new(dialect, Some(machine), setup_of(machine));
    let found = check(&program, &settings).diagnostics.into_iter();
    let ours = found.filter(|found| ["clamped-axis-moves", "unknown-code", "rejected-block"].contains(&found.rule));
    ours.map(|found| found.message).collect()
}

fn options(tcp: bool, vectors: bool) -> Options {
    Options {
        tcp,
        orientation: if vectors {
            OrientationWords::Vectors
        } else {
            OrientationWords::Rotary
        },
        ..Options::default()
    }
}

#[test]
fn what_is_written_passes_and_every_code_of_it_is_needed() {
    for (dialect, name, options) in [
        ("haas-ngc", "trunnion-3plus2", options(true, false)),
        ("fanuc-30i", "trunnion-3plus2", options(false, false)),
        ("fanuc-30i", "trunnion-3plus2", options(true, true)),
        ("sinumerik-840d", "trunnion-3plus2", options(true, true)),
        ("iso-6983", "trunnion-3plus2", options(false, false)),
        ("linuxcnc", "linuxcnc-xyzac-trt", options(true, false)),
        ("linuxcnc", "trunnion-3plus2", options(false, false)),
    ] {
        let machine = with_codes(name, CODES);
        let made = written(INDEXED, ("apt", None), dialect, &machine, &options);
        assert_eq!(made.clamps, [' '; 0], "{dialect}");
        assert_eq!(
            findings(&made.text, dialect, &machine),
            [""; 0],
            "{dialect}\n{}",
            made.text
        );
        let is_code = |line: &str, code: &str| line.split(' ').any(|word| word == code);
        let without = |code: &str| -> String {
            let lines = made.text.lines().filter(|line| !is_code(line, code));
            lines.flat_map(|line| [line, "\n"]).collect()
        };
        for code in ["M11", "M13"] {
            assert!(
                !findings(&without(code), dialect, &machine).is_empty(),
                "{dialect}: {code}"
            );
        }
        for code in ["M10", "M12"] {
            assert!(
                made.text.lines().any(|line| is_code(line, code)),
                "{dialect}: {code}\n{}",
                made.text
            );
        }
    }
}

#[test]
fn a_clamp_is_closed_for_the_cuts_in_which_its_axis_stands() {
    let machine = with_codes("trunnion-3plus2", CODES);
    insta::assert_snapshot!(haas(INDEXED, &machine).text);
}

#[test]
fn an_axis_that_turns_in_a_pass_is_open_through_all_of_it() {
    let machine = with_codes("mikron-ucp710", CODES);
    let made = haas(TURNED, &machine);
    let codes: Vec<&str> = made
        .text
        .lines()
        .filter_map(|line| {
            line.split(' ')
                .find(|word| ["M10", "M11", "M12", "M13", "G0", "G1"].contains(word))
        })
        .collect();
    assert_eq!(
        codes,
        ["M11", "M13", "G0", "G1", "G0", "M10", "M12", "G1"],
        "{}",
        made.text
    );
    assert_eq!(findings(&made.text, "haas-ngc", &machine), [""; 0]);
}

#[test]
fn codes_of_the_machine_before_are_written_anew() {
    let (old, new) = (
        with_codes(
            "trunnion-3plus2",
            ["{ on = \"M20\", off = \"M21\" }", "{ on = \"M22\", off = \"M23\" }"],
        ),
        with_codes("trunnion-3plus2", CODES),
    );
    let first = written(INDEXED, ("apt", None), "haas-ngc", &old, &options(false, false));
    assert!(first.text.contains("M22"), "{}", first.text);
    let from = ("haas-ngc", Some(&old));
    let second = written(&first.text, from, "haas-ngc", &new, &options(false, false));
    // a tool change of a Haas stops the spindle, which is written out
    let codes = |text: &str| -> Vec<String> {
        let blocks = text
            .lines()
            .map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest));
        let kept = blocks.filter(|block| !["M5", "M30"].contains(block));
        kept.map(str::to_owned).collect()
    };
    let renamed = first.text.replace("M2", "M1");
    assert_eq!(codes(&second.text), codes(&renamed));
    assert_eq!(second.left_out, []);
}

#[test]
fn codes_that_nobody_names_are_left_with_a_remark() {
    let cases = [
        (
            with_keys("trunnion-3plus2", ["", ""]),
            "the machine file does not name its codes",
        ),
        // coolant, to this control
        (
            with_codes(
                "trunnion-3plus2",
                ["{ on = \"M8\", off = \"M9\" }", "{ on = \"M8\", off = \"M9\" }"],
            ),
            "the target control has no such codes",
        ),
    ];
    for (machine, why) in cases {
        let made = haas(INDEXED, &machine);
        assert_eq!(made.clamps, ['C', 'A']);
        for letter in made.clamps {
            let remark = format!(
                "({letter} HAS A CLAMP. THIS PROGRAM DOES NOT OPERATE IT: {})",
                why.to_uppercase()
            );
            assert!(made.text.contains(&remark), "{}", made.text);
        }
        assert!(!made.text.contains("M8\n"), "{}", made.text);
    }
    let free = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    let made = haas(INDEXED, free);
    assert!(made.clamps.is_empty() && !made.text.contains("CLAMP"), "{}", made.text);
}

/// An axis that must stand still while cutting: a cut that would turn it is not written, in no form; a rapid may turn it.
#[test]
fn a_cut_that_turns_an_axis_which_must_stand_still_is_refused() {
    let still = "clamp = true";
    let with_clamp = format!("{still}\nclamp_codes = {}", CODES[0]);
    for (cl, keys, tcp, vectors, line) in [
        // A turns in the plunge, to no other orientation: line 10 turns C
        (TURNED, ["", still], true, false, Some(10)),
        (TURNED, ["", still], false, false, Some(10)),
        (TURNED, ["", still], true, true, Some(10)),
        (TURNED, [still, ""], true, false, Some(10)),
        (TURNED, [&with_clamp, ""], true, false, Some(10)),
        (TURNED, ["", ""], true, false, None),
        (INDEXED, [still, still], true, false, None),
        (INDEXED, [still, still], false, false, None),
    ] {
        let machine = with_keys("mikron-ucp710", keys);
        let dialect = if vectors { "fanuc-30i" } else { "haas-ngc" };
        let made = tried(cl, ("apt", None), dialect, &machine, &options(tcp, vectors));
        let refused = made.as_ref().err();
        assert_eq!(
            refused.and_then(|refused| refused.place).map(|(line, _)| line),
            line,
            "{keys:?}: {refused:?}"
        );
        match (refused, made.as_ref().ok()) {
            (Some(refused), _) => assert!(refused.message.contains("must stand still"), "{refused}"),
            (_, Some(made)) if keys != ["", ""] => assert_eq!(findings(&made.text, dialect, &machine), [""; 0]),
            _ => {}
        }
    }
}
