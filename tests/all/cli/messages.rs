//! What people read: the words of messages, one finding for one cause, and a report that fits on a screen.
use super::tools::{json, str, text, trunnion, write};
use serde_json::Value;
use tempfile::TempDir;

/// The findings of a program in JSON.
fn found(folder: &TempDir, name: &str, program: &str, more: &[&str]) -> Vec<Value> {
    let file = write(folder, name, program);
    let output = json(&trunnion(&[&["check", "--format", "json", str(&file)], more].concat()));
    output["files"][0]["diagnostics"].as_array().expect("findings").clone()
}

fn of_rule<'v>(found: &'v [Value], rule: &str) -> Vec<&'v Value> {
    found.iter().filter(|found| found["rule"] == rule).collect()
}

const HEAD: &str = "%\nO0001\nG21 G17 G40 G49 G80 G90 G94 G54\nT1 M6\nM3 S1000\nG0 X0. Y0.\nG43 H1 Z50.\n";

/// The five messages that a review named.
#[test]
fn messages_name_what_is_wrong_and_what_was_meant() {
    let folder = TempDir::new().expect("works");
    let program = format!("{HEAD}G1 X5O. F100.\nG1 X[#1+2 F800.\nM30\n%\n");
    let findings = found(&folder, "a.nc", &program, &[]);
    let messages: Vec<&str> = findings.iter().filter_map(|found| found["message"].as_str()).collect();
    assert!(
        messages.contains(&"`X5O.` contains the letter O; did you mean `X50.`?"),
        "{messages:?}"
    );
    assert!(messages.contains(&"missing `]` before `F800.`"), "{messages:?}");
    // the letter O is the one cause: `X5` has no missing decimal point
    let of_line = |line: u64| findings.iter().filter(|found| found["line"] == line).count();
    assert_eq!((of_line(8), of_line(9)), (1, 1), "{messages:?}");

    let machine = trunnion(&["check", "--machine", "mikron-ucp71", str(&folder.path().join("a.nc"))]);
    let said = text(&machine.stderr);
    assert!(
        said.contains("unknown machine `mikron-ucp71`; did you mean `mikron-ucp710`?"),
        "{said}"
    );

    write(&folder, "trunnion.toml", "[tolerances]\ntip = \"0.02\"\n");
    let said = text(&trunnion(&["check", str(&folder.path().join("a.nc"))]).stderr);
    assert!(
        said.contains(
            "trunnion.toml:2:7: `tip` in [tolerances] must be a number (`path-deviation`: how far the tip may leave"
        ) && said.contains("mm): `tip = 0.02`"),
        "{said}"
    );

    let folder = TempDir::new().expect("works");
    let probe = "G21 G17 G90 G94 G54\nM3 S100\nG0 X0 Y0 Z50\nG0 Z#5063\nM2\n";
    let more = [
        "--machine",
        "mill-3axis",
        "--dialect",
        "linuxcnc",
        "--assume",
        "work-offset",
    ];
    let rapid = found(&folder, "a.ngc", probe, &more);
    let message = &of_rule(&rapid, "position-unknown")[0]["message"];
    assert_eq!(message, "end position of this rapid is unknown: Z is not determined");
}

/// The nearest name of a misspelt shape of a tool, as of machines, dialects, rules and keys.
#[test]
fn a_misspelt_word_of_the_settings_has_a_nearest_name() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.nc", "G0 X1.\nM30\n");
    for (settings, said) in [
        (
            "[[tool]]\nnumber = 1\nshape = \"bal\"\ndiameter = 5\n",
            "unknown tool shape `bal`; did you mean `ball`?",
        ),
        (
            "machine = \"mill-3axs\"\n",
            "unknown machine `mill-3axs`; did you mean `mill-3axis`?",
        ),
        (
            "dialect = \"sinumerik-840\"\n",
            "unknown dialect `sinumerik-840`; did you mean `sinumerik-840d`?",
        ),
        (
            "[rules]\npole-flop = \"allow\"\n",
            "unknown rule `pole-flop`; did you mean `pole-flip`?",
        ),
        (
            "[tolerance]\ntip = 0.1\n",
            "unknown key `tolerance`; did you mean `tolerances`?",
        ),
        (
            "assume = [\"tool-lenght\"]\n",
            "`tool-lenght` cannot be assumed; did you mean `tool-length`?",
        ),
    ] {
        write(&folder, "trunnion.toml", settings);
        let stderr = text(&trunnion(&["check", str(&file)]).stderr);
        assert!(stderr.contains(said), "{settings}: {stderr}");
    }
}

/// A thousand blocks with one cause are one finding with a count.
#[test]
fn one_cause_is_one_finding() {
    let many = |line: &dyn Fn(usize) -> String| -> String { (1..=40).map(line).collect() };
    let arcs = many(&|i| {
        if i.is_multiple_of(2) {
            "G2 X10. Y0. I0. J0.\n".to_owned()
        } else {
            "G2 X-10. Y0. I0. J0.\n".to_owned()
        }
    });
    let whole = many(&|i| format!("X{i} Y{i}\n"));
    let folder = TempDir::new().expect("works");
    for (name, rule, program) in [
        (
            "arcs.nc",
            "arc-radius-mismatch",
            format!("{HEAD}G1 X10. Y0. Z-1. F100.\n{arcs}M30\n%\n"),
        ),
        (
            "whole.nc",
            "ambiguous-implicit-decimal",
            format!("{HEAD}G1 Z-1. F100.\n{whole}M30\n%\n"),
        ),
        (
            "plane.mpf",
            "not-modelled",
            format!(
                "G71 G90 G94 G17\nT1 M6\nM3 S900\nG0 X0 Y0 Z5\n{}M30\n",
                many(&|_| "PUNCHACC\n".to_owned())
            ),
        ),
    ] {
        let findings = found(&folder, name, &program, &[]);
        let of = of_rule(&findings, rule);
        assert_eq!(of.len(), 1, "{name}: {findings:#?}");
        assert!(of[0]["count"].as_u64().expect("a count") >= 39, "{name}: {}", of[0]);
    }
}

/// What is printed and what is counted agree, and the worst are the ones that a limit leaves.
/// A word that is no number leaves an axis unknown: the word comes first, what follows from it after it.
#[test]
fn the_cause_comes_before_what_follows_from_it() {
    let folder = TempDir::new().expect("works");
    let program = "%\nO1\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z-0.4.\nG1 X10. F100.\nG2 X20. Y5,3 R20.\nM30\n%\n";
    let found = found(
        &folder,
        "a.nc",
        program,
        &["--dialect", "fanuc-30i", "--machine", "mill-3axis"],
    );
    let on = |line: u64| {
        let of = found.iter().filter(move |one| one["line"] == line);
        of.map(|one| one["rule"].as_str().expect("text")).collect::<Vec<_>>()
    };
    assert_eq!(on(6)[0], "bad-number", "{found:?}");
    assert!(
        on(6).contains(&"not-modelled") && on(6).contains(&"position-unknown"),
        "{found:?}"
    );
    assert_eq!(on(8)[0], "decimal-comma", "{found:?}");
    // the blocks stay in order
    assert!(found.is_sorted_by_key(|one| one["line"].as_u64()), "{found:?}");
}

/// Whoever programs in inch reads inches too, and learns that the settings are in mm. Numbers of the JSON stay mm.
#[test]
fn an_inch_program_has_its_lengths_in_inch() {
    let folder = TempDir::new().expect("works");
    let program = |unit: &str| {
        format!(
            "%\nO1\n{unit} G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z1.\nG1 X8. F10.\nX20.\nM30\n%\n"
        )
    };
    let on = ["--dialect", "fanuc-30i", "--machine", "mill-3axis"];
    let of = |unit: &str| found(&folder, "a.nc", &program(unit), &on);
    let inch = of("G20");
    let fits = of_rule(&inch, "axis-limit");
    let (message, help) = (&fits[0]["message"], fits[0]["help"].as_str().expect("text"));
    // the travel is -500 mm to 500 mm
    let wanted = "it fits with X -500 mm (-19.685 in) to -8 mm (-0.315 in)";
    assert!(message.as_str().expect("text").contains(wanted), "{message}");
    assert_eq!(fits[0]["values"]["fits_x_max_mm"], -8.0, "{fits:?}");
    assert!(
        help.contains("[work_offsets]") && help.ends_with("trunnion.toml is in mm, also for a program in inch"),
        "{help}"
    );
    for found in of("G21") {
        let said = format!("{found}");
        assert!(
            !said.contains(" in)") && !said.contains("also for a program in inch"),
            "{said}"
        );
    }
    let file = write(&folder, "b.nc", &program("G20"));
    let stats = text(&trunnion(&[&["stats", str(&file)][..], &on].concat()).stdout);
    assert!(stats.contains("508.000 mm (20 in)"), "{stats}");
}

#[test]
fn the_worst_are_shown_first_and_counted_as_printed() {
    let folder = TempDir::new().expect("works");
    // each code is a cause of its own
    let bad = (0..30)
        .map(|i| format!("G1 X{i}. Q{i}\nM{}\nG{}\n", 700 + i, 800 + i))
        .collect::<Vec<_>>()
        .concat();
    let file = write(
        &folder,
        "a.nc",
        &format!("{HEAD}F100.\n{bad}N9 G1 X1.\nN8 X2\nM30\n%\n"),
    );
    let all = text(&trunnion(&["check", "--format", "short", "--limit", "0", str(&file)]).stdout);
    let json = json(&trunnion(&["check", "--format", "json", str(&file)]));
    for (word, key) in [
        ("error", "errors"),
        ("warning", "warnings"),
        ("info", "infos"),
        ("unknown", "unknown"),
    ] {
        let printed = all.lines().filter(|line| line.contains(&format!(": {word}["))).count();
        assert_eq!(json["summary"][key], printed, "{word}: {all}");
    }
    let errors = json["summary"]["errors"].as_u64().expect("a number") as usize;
    assert!(errors >= 2, "{all}");
    let few = text(&trunnion(&["check", "--format", "short", "--limit", "2", str(&file)]).stdout);
    let shown: Vec<&str> = few.lines().filter(|line| line.contains('[')).collect();
    assert!(
        shown.len() == 2 && shown.iter().all(|line| line.contains(": error[")),
        "{few}"
    );
    // by default the report of a file fits on a screen, and says how to see the rest
    let pretty = text(&trunnion(&["check", "--format", "pretty", str(&file)]).stdout);
    assert!(
        pretty.lines().count() <= 40 && pretty.contains("--limit 0 shows them all"),
        "{pretty}"
    );
    assert!(pretty.contains("error["), "{pretty}");
}

/// LinuxCNC reads `if` without an O-word as the letter I.
#[test]
fn a_keyword_without_its_o_word_is_named() {
    let folder = TempDir::new().expect("works");
    let program = "G21 G17 G90 G94\nM3 S100\nif [#1 LT 0]\nG0 X1\nendif\nM2\n";
    let findings = found(&folder, "a.ngc", program, &["--dialect", "linuxcnc"]);
    let message = "`if` needs an O-word before it: write `o100 if`, with the same number at its other parts";
    assert!(
        findings
            .iter()
            .any(|found| found["message"] == message && found["line"] == 3),
        "{findings:#?}"
    );
}

/// A file that only defines subprograms is looked at, and never passes: its arguments come from a caller.
#[test]
fn a_file_of_definitions_is_entered_and_never_passes() {
    let folder = TempDir::new().expect("works");
    for (program, motions, other) in [
        (
            "o<slot> sub\nG0 X#1 Y#2\nG1 Z[0-#3] F#4\nG1 X[#1+10]\no<slot> endsub\n",
            3,
            &[][..],
        ),
        ("%\no<home> sub\nG53 G0 Z0\no<home> endsub\n%\n", 1, &[]),
        // what the caller may have defined, and where its subprograms are, is unknown
        (
            "o<a> sub\nG0 Z#<_z_clear>\nG1 Z0 F#<_my_feed>\no<b> call\no<a> endsub\nM2\n",
            2,
            &["missing-subprogram"],
        ),
        (
            "o<a> sub\nG0 Z5\no1 if [#1 GT 0]\nG0 Z9\no1 endif\no<a> endsub\nM2\n",
            1,
            &["not-decided"],
        ),
        // mistakes are found
        (
            "o<a> sub\nG0 Z5\nG1 X[1/0] F9\no<a> endsub\nM2\n",
            1,
            &["bad-expression"],
        ),
    ] {
        let file = write(&folder, "a.ngc", program);
        let output = json(&trunnion(&[
            "check",
            "--format",
            "json",
            "--dialect",
            "linuxcnc",
            str(&file),
        ]));
        let file = &output["files"][0];
        assert_eq!(file["coverage"]["motions"], motions, "{program} {file:#}");
        let known = ["machine-unset", "units-unset"];
        let rules: Vec<&str> = file["diagnostics"]
            .as_array()
            .expect("findings")
            .iter()
            .filter_map(|found| found["rule"].as_str())
            .collect();
        let rules: Vec<&str> = rules.into_iter().filter(|rule| !known.contains(rule)).collect();
        assert_eq!(rules, [&["not-modelled"][..], other].concat(), "{program} {file:#}");
        let wrong = other.contains(&"bad-expression");
        assert_eq!(file["verdict"], if wrong { "fail" } else { "unknown" }, "{program}");
    }
}
