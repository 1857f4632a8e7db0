//! How commands are used: the same options everywhere, wrong arguments, help, what is not made in a format.
use super::tools::{json, status, str, text, trunnion, write};
use tempfile::TempDir;

const PART: &str = "G17 G71 G90 G94 G54\nT1 D1 M6\nS1000 M3\nG0 X0 Y0 Z5\nG1 X10 F500\nG1 Y10\nM30\n";

/// `--lines` takes the same forms wherever it is.
#[test]
fn lines_are_named_the_same_way_everywhere() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.mpf", PART);
    let surface = write(
        &folder,
        "part.toml",
        "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 5], [20, 0, 5]], [[0, 20, 5], [20, 20, 5]]]\n",
    );
    let picture = folder.path().join("a.svg");
    let common = ["--machine", "mill-3axis", "--assume", "work-offset,tool-length"];
    let commands: [&[&str]; 3] = [
        &["plot", str(&file), "--kind", "path", "-o", str(&picture)],
        &["fix", str(&file), "--rewrite", "fit-arcs"],
        &["surface", str(&file), "--required", str(&surface)],
    ];
    for command in commands {
        for (lines, is_right) in [
            ("6", true),
            ("5-6", true),
            ("6-5", false),
            ("0", false),
            ("5-", false),
            ("x", false),
        ] {
            let output = trunnion(&[command, &common, &["--lines", lines]].concat());
            let said = text(&output.stderr);
            let refused = said.contains("write a line, or the first and the last with `-` between them: 12 or 12-40");
            assert_eq!(refused, !is_right, "{command:?} --lines {lines}: {said}");
        }
        let help = text(&trunnion(&["help", command[0]]).stdout);
        assert!(help.contains("--lines <FIRST[-LAST]>"), "{help}");
    }
}

/// A wrong declaration of the control is named where the text shows another one, and a text that is no program is called that.
#[test]
fn a_wrong_dialect_is_named() {
    let folder = TempDir::new().expect("works");
    let fanuc = "%\nO0002 (SECOND)\nG21 G17 G40 G49 G80 G90\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z10.\nG1 Z-1. F100.\nM30\n%\n";
    let file = write(&folder, "second.nc", fanuc);
    let looks = "read as sinumerik-840d (named by the user; the text looks like fanuc-30i: ";
    let said = text(&trunnion(&["check", str(&file), "--dialect", "sinumerik-840d"]).stderr);
    assert!(said.contains(looks) && said.contains(" on line "), "{said}");
    let said = text(&trunnion(&["check", str(&file), "--dialect", "haas-ngc"]).stderr);
    assert!(!said.contains("looks like"), "{said}");
    write(&folder, "trunnion.toml", "dialect = \"sinumerik-840d\"\n");
    let document = json(&trunnion(&["check", str(&file), "--format", "json"]));
    let reason = document["files"][0]["dialect_reason"].as_str().expect("text");
    assert!(
        reason.starts_with("trunnion.toml; the text looks like fanuc-30i: "),
        "{reason}"
    );
    let prose = "Read this first.\nThe programs of this folder cut the clamp of job 12.\nRun them in the order of their names, please.\n\
                 The first one cuts the pocket on the upper side.\n";
    let file = write(&folder, "notes.nc", prose);
    let document = json(&trunnion(&["check", str(&file), "--format", "json"]));
    let found = document["files"][0]["diagnostics"].as_array().expect("a list");
    let rules: Vec<_> = found.iter().map(|one| one["rule"].as_str().expect("text")).collect();
    assert_eq!(rules, ["not-a-program"]);
    assert_eq!(document["files"][0]["verdict"], "unknown");
}

/// The name of a maker leads to the dialect.
#[test]
fn the_name_of_a_maker_leads_to_the_dialect() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.mpf", PART);
    for (name, hint) in [
        ("siemens", "did you mean `sinumerik-840d`?"),
        ("heidenhain", "did you mean `heidenhain-klartext`?"),
        ("mach3", "there is no dialect for Mach3"),
    ] {
        let output = trunnion(&["check", str(&file), "--dialect", name]);
        assert_eq!(status(&output), 2);
        assert!(text(&output.stderr).contains(hint), "{}", text(&output.stderr));
    }
}

/// A line that the program does not have, and a file that is no surface.
#[test]
fn a_line_past_the_end_and_a_wrong_kind_of_file_are_named() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.mpf", PART);
    let machine = ["--machine", "mill-3axis"];
    for line in ["0", "8", "999"] {
        let output = trunnion(&[&["servo", str(&file), "--kv", "20", "--at", line][..], &machine].concat());
        assert_eq!(status(&output), 2);
        let said = text(&output.stderr);
        assert!(
            said.contains(&format!("--at {line}: ")) && said.contains("has the lines 1 to 7"),
            "{said}"
        );
    }
    let output = trunnion(
        &[
            &["servo", str(&file), "--kv", "20", "--acc", "1000", "--at", "7"][..],
            &machine,
        ]
        .concat(),
    );
    assert!(text(&output.stderr).contains("no motion with a known path starts in this line"));
    let output = trunnion(&[&["surface", str(&file), "--required", str(&file)][..], &machine].concat());
    assert_eq!(status(&output), 2);
    let said = text(&output.stderr);
    assert!(
        said.contains("ends in .toml or .json, or an STL") && said.contains("a program has no such surface"),
        "{said}"
    );
}

/// The help of a command that reads no program is about that command.
#[test]
fn help_lists_the_options_of_all_commands_only_where_they_mean_something() {
    for command in [
        &["machine", "list"][..],
        &["machine", "show"],
        &["machine", "check"],
        &["machine", "import"],
        &["explain"],
        &["rules"],
        &["schema"],
        &["completions"],
        &["man"],
        &["lsp"],
    ] {
        let own = text(&trunnion(&[command, &["--help"]].concat()).stdout);
        let by_help = text(&trunnion(&[&["help"], command].concat()).stdout);
        for help in [own, by_help] {
            assert!(
                !help.contains("--max-file-mb") && !help.contains("--port-to"),
                "{command:?}: {help}"
            );
            assert!(
                help.contains("`trunnion help check` lists the options"),
                "{command:?}: {help}"
            );
        }
    }
    for command in [&["check"][..], &["machine", "compare"], &["stats"]] {
        let help = text(&trunnion(&[&["help"], command].concat()).stdout);
        assert!(
            help.contains("--max-file-mb") && help.contains("--port-to"),
            "{command:?}: {help}"
        );
    }
    // they are still taken
    assert_eq!(
        status(&trunnion(&["machine", "list", "--quiet", "--color", "never"])),
        0
    );
}

/// Rewrites that are not made in Klartext are one line for the program, with what each would have to write.
#[test]
fn rewrites_that_klartext_refuses_are_one_line() {
    let folder = TempDir::new().expect("works");
    let program = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S900\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 L X+10 Y+0 R0 F500\n4 L X+10 Y+5\n5 L X+10 Y+10\n6 M30\n7 END PGM A MM\n";
    let file = write(&folder, "a.h", program);
    let arguments = ["fix", str(&file), "--machine", "mill-3axis", "--rewrite"];
    let output = trunnion(&[&arguments[..], &["all"]].concat());
    let said = text(&output.stderr);
    let lines: Vec<&str> = said.lines().filter(|line| line.contains("Klartext")).collect();
    assert_eq!(
        lines
            .iter()
            .filter(|line| line.contains("not made in Klartext"))
            .count(),
        1,
        "{said}"
    );
    for part in [
        "fit-arcs (G2 and G3 with I, J and K)",
        "adapt-feed (F words of blocks)",
        "smooth-pole (",
    ] {
        assert_eq!(said.matches(part).count(), 1, "{said}");
    }
    let all = json(&trunnion(
        &[&arguments[..], &["fit-arcs,adapt-feed", "--format", "json"]].concat(),
    ));
    let reasons = all.to_string();
    assert!(
        reasons.contains("it reads and writes F words of blocks, and only in G code"),
        "{reasons}"
    );
    assert_eq!(status(&output), 1);
}
