//! `diff` on the command line: what is told about programs that move the tool differently, and that text alone says nothing.

use super::tools::{FLIP, json, status, str, text, trunnion, write};
use std::fmt::Write;
use std::path::Path;
use tempfile::TempDir;

const BEFORE: &str = "G21 G90 G17 G94\nT1 M6\nS1000 M3\nN10 G0 X0 Y0 Z5\nN20 G1 Z-1 F100\nN30 X10\nN40 Y10\nN50 X0\nN60 G2 X10 Y10 I5 J0\nN70 G4 P1\nM1\n\
                      N80 G0 Z5\nM30\n";

fn differ(folder: &TempDir, before: &str, after: &str, more: &[&str]) -> (i32, String) {
    let (a, b) = (write(folder, "a.nc", before), write(folder, "b.nc", after));
    let fixed = ["diff", str(&a), str(&b), "--dialect", "iso-6983"];
    let output = trunnion(&[&fixed[..], more].concat());
    let shown = text(&output.stdout).replace(str(&a), "a.nc").replace(str(&b), "b.nc");
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    (status(&output), shown)
}

#[test]
fn text_alone_is_no_difference() {
    let folder = TempDir::new().expect("works");
    let after = BEFORE
        .to_lowercase()
        .replace(' ', "")
        .replace("n10", "(new)\n\nn5 ")
        .replace("x10", "x10.000")
        .replace("m3\n", "m03\n");
    assert_eq!(
        differ(&folder, BEFORE, &after, &[]),
        (
            0,
            "SAME 8 motions within 0.001 mm and 0.001 deg\na.nc -> b.nc\n".to_owned()
        )
    );
}

/// Neither length is declared: that another one is in effect is seen by its number.
#[test]
fn the_length_of_another_tool_is_a_difference() {
    let folder = TempDir::new().expect("works");
    let with = |number: u32| BEFORE.replace("N10 G0", &format!("N10 G43 H{number} G0"));
    let (code, shown) = differ(&folder, &with(1), &with(5), &[]);
    assert_eq!(code, 1);
    let told = "active tool length that of tool 1 -> that of tool 5";
    assert!(shown.contains(told), "{shown}");
}

/// What is not known of a motion is compared by its words: where a probe met, an arc from an unknown position.
#[test]
fn what_is_not_known_is_compared_by_its_words() {
    let folder = TempDir::new().expect("works");
    let differs = |dialect: &str, before: &str, after: &str| {
        let (a, b) = (write(&folder, "a.nc", before), write(&folder, "b.nc", after));
        let output = trunnion(&["diff", str(&a), str(&b), "--dialect", dialect]);
        let shown = text(&output.stdout);
        assert_eq!(shown.starts_with("SAME"), status(&output) == 0, "{shown}");
        !shown.starts_with("SAME")
    };
    for (dialect, text, [one, other]) in [
        ("linuxcnc", "G21 G90\nG1 X#? F100\nM2\n", ["5061", "5062"]),
        ("linuxcnc", "G21 G90\n#1=#[5060+?]\nG1 X#1 F100\nM2\n", ["1", "2"]),
        (
            "linuxcnc",
            "G21 G90\no100 sub\nG1 X#1 F100\no100 endsub\no100 call [#?]\nM2\n",
            ["5061", "5062"],
        ),
        ("fanuc-30i", "G21 G90\n#1=#?\nG1 X#1 F100\nM30\n", ["5061", "5062"]),
        ("fanuc-30i", "G21 G91\nG1 X? F100\nM30\n", ["5.", "6."]),
        (
            "fanuc-30i",
            "G21 G90\nG1 X5. F100\nG2 X9. Y? I2. J0.\nM30\n",
            ["0.", "1."],
        ),
        (
            "sinumerik-840d",
            "G71 G90 G54\nTRAORI\nG1 Z10 F100\nG18 G2 Z2 X-20 Y8 K? I-4\nM30\n",
            ["3", "4"],
        ),
    ] {
        assert!(
            differs(dialect, &text.replace('?', one), &text.replace('?', other)),
            "{text}"
        );
        assert!(
            !differs(dialect, &text.replace('?', one), &text.replace('?', one)),
            "{text}"
        );
    }
    // known values are compared as such, however they are written
    let known = "G21 G90\n#1=?\nG1 X#1 F100\nM2\n";
    assert!(!differs(
        "linuxcnc",
        &known.replace('?', "[2+3]"),
        &known.replace('?', "5")
    ));
}

#[test]
fn each_sort_of_difference_is_told() {
    let folder = TempDir::new().expect("works");
    let after = BEFORE
        .replace("N30 X10", "N30 X10.5")
        .replace("N40 Y10\n", "N40 Y10\nN45 X12 F200\n")
        .replace("I5 J0", "I5 J5")
        .replace("P1", "P2")
        .replace("M1\n", "")
        .replace("M3\n", "M3 M8\n");
    let (status, shown) = differ(&folder, BEFORE, &after, &[]);
    assert_eq!(status, 1);
    insta::assert_snapshot!("diff_pretty", shown);
    let (_, shown) = differ(&folder, BEFORE, &after, &["--format", "json"]);
    insta::assert_snapshot!("diff_json", shown);
}

#[test]
fn tolerances_decide_what_is_the_same() {
    let folder = TempDir::new().expect("works");
    let after = BEFORE
        .replace("N30 X10", "N30 X10.0015")
        .replace("N40 Y10", "N40 Y9.9999");
    assert_eq!(differ(&folder, BEFORE, &after, &[]).0, 1);
    assert_eq!(differ(&folder, BEFORE, &after, &["--tolerance-mm", "0.01"]).0, 0);
    // on both sides of the border of a grid of 0.001 mm, and no farther apart than 0.0002 mm
    let (a, b) = (
        BEFORE.replace("X10\n", "X10.0004\n"),
        BEFORE.replace("X10\n", "X10.0006\n"),
    );
    assert_eq!(differ(&folder, &a, &b, &[]).0, 0);
    assert_eq!(differ(&folder, &a, &b, &["--tolerance-mm", "0"]).0, 1);
    let bad = trunnion(&["diff", "a", "b", "--tolerance-mm", "nan"]);
    assert_eq!(status(&bad), 2);
}

#[test]
fn what_is_not_modelled_is_compared_by_its_words() {
    let folder = TempDir::new().expect("works");
    let program = |macros: &str| format!("G21 G90\nG0 X0 Y0 Z0\n{macros}\nM30\n");
    assert_eq!(
        differ(&folder, &program("G65 P9010 A1"), &program("g65  p9010 a1 (call)"), &[]).0,
        0
    );
    let (status, shown) = differ(&folder, &program("G65 P9010 A1"), &program("G65 P9010 A2"), &[]);
    assert_eq!(status, 1, "{shown}");
    assert!(shown.contains("G65P9010A1") && shown.contains("G65P9010A2"), "{shown}");
}

#[test]
fn a_longer_approach_hides_no_motion_that_is_a_little_off() {
    let folder = TempDir::new().expect("works");
    let program = |approach: &str, x: &str| {
        format!("G21 G90\nS1000 M3\n{approach}\nG1 Z-1 F100\nG1 X{x} Y0.5\nG1 X20 Y1.5\nM30\n")
    };
    let (status, shown) = differ(
        &folder,
        &program("G0 X0 Y0 Z2", "10"),
        &program("G0 X-30 Y-30 Z80\nG0 X-5 Y-5\nG0 X0 Y0\nG0 Z2", "10.01"),
        &[],
    );
    assert_eq!(status, 1, "{shown}");
    assert!(shown.contains("linear X 10 -> 10.01 mm"), "{shown}");
    assert!(!shown.contains("linear ->") && !shown.contains("rapid ->"), "{shown}");
    assert_eq!(shown.matches(" added ").count(), 3, "{shown}");
}

#[test]
fn with_a_machine_joints_are_compared() {
    let folder = TempDir::new().expect("works");
    let (a, b) = (
        write(&folder, "a.nc", FLIP),
        write(&folder, "b.nc", &FLIP.replace("C52.595", "C50.595")),
    );
    let both = [
        "diff",
        str(&a),
        str(&b),
        "--dialect",
        "fanuc-30i",
        "--machine",
        "mikron-ucp710",
    ];
    let output = trunnion(&both);
    assert_eq!(status(&output), 1);
    let shown = text(&output.stdout);
    assert!(
        shown.contains("on mikron-ucp710; coordinates are the positions of its axes"),
        "{shown}"
    );
    assert!(shown.contains("C 52.595 -> 50.595 deg"), "{shown}");
    assert!(shown.contains("DIFFERENT") && shown.contains("1 moved"), "{shown}");
}

#[test]
fn long_programs_with_few_differences_are_aligned_and_unlike_ones_are_said_to_be() {
    let folder = TempDir::new().expect("works");
    let mut long = String::from("G21 G90 G94 F100\nG0 X0 Y0 Z0\n");
    for i in 0..60_000 {
        let _ = writeln!(long, "G1 X{}.{:03} Y{}", i % 97, i % 1000, i % 89);
    }
    long.push_str("M30\n");
    let mut lines: Vec<&str> = long.lines().collect();
    lines.remove(50_000);
    lines.insert(1_000, "G1 X500 Y500");
    let (status, shown) = differ(&folder, &long, &(lines.join("\n") + "\n"), &["--format", "json"]);
    assert_eq!(status, 1);
    let summary: serde_json::Value = serde_json::from_str(&shown).expect("JSON");
    assert_eq!(summary["summary"]["removed"], 1);
    assert_eq!(summary["summary"]["added"], 1);
    assert_eq!(summary["summary"]["moved"], 0);
    assert_eq!(summary["summary"]["too_different"], false);
    let (status, shown) = differ(
        &folder,
        &long,
        &long
            .replace('X', "U")
            .replace("Y8", "Y9")
            .replacen("G1 U5", "G0 Z5\nG1 U5", 9),
        &[],
    );
    assert_eq!(status, 1);
    assert!(shown.contains("too little in common"), "{}", &shown[..300]);
}

#[test]
fn a_laid_out_program_is_the_same() {
    let impeller = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/linuxcnc-5axis/impeller-7bl-xyzac.ngc");
    let Ok(source) = std::fs::read_to_string(&impeller) else {
        println!("skipped: {} is absent", impeller.display());
        return;
    };
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "impeller.ngc", &source);
    assert_eq!(status(&trunnion(&["fmt", "-q", str(&file)])), 0);
    assert_ne!(std::fs::read_to_string(&file).expect("works"), source);
    let output = trunnion(&["diff", str(&impeller), str(&file), "--format", "json"]);
    assert_eq!(status(&output), 0);
    assert_eq!(json(&output)["same"], true);
}

/// G code and the CL data made from it: only the language differs. Another end is found across the languages too.
#[test]
fn a_program_and_its_cl_data_are_the_same() {
    let folder = TempDir::new().expect("works");
    let program = "G17 G54 G71 G90 G94\nT1 D1 M6\nS8000 M3\nM8\nTRAORI\nG0 X0 Y0 Z50 A3=0 B3=0 C3=1\nG1 Z5 F1000\n\
                   X10 Y0 Z5 A3=0 B3=-0.1 C3=1\nX20 Y5 Z6 A3=0.1 B3=-0.1 C3=1\nG0 Z50\nM9\nM5\nTRAFOOF\nM30\n";
    let a = write(&folder, "a.mpf", program);
    let machine = ["--machine", "mikron-ucp710"];
    let made = trunnion(&[&["convert", str(&a), "--to", "apt"], &machine[..]].concat());
    assert_eq!(status(&made), 0, "{}", text(&made.stderr));
    for (cl, same) in [
        (text(&made.stdout), true),
        (text(&made.stdout).replace("GOTO/20,5,6", "GOTO/20,5,7"), false),
        (text(&made.stdout).replace("SPINDL/8000", "SPINDL/7000"), false),
    ] {
        let b = write(&folder, "b.apt", &cl);
        for (command, word) in [("diff", "SAME"), ("certify", "PROVED")] {
            let output = trunnion(&[&[command, str(&a), str(&b)], &machine[..]].concat());
            assert_eq!(text(&output.stdout).starts_with(word), same, "{}", text(&output.stdout));
            assert_eq!(status(&output), i32::from(!same));
        }
    }
}

/// The run ends undecided before a call: which program is called is not known to be the same in both folders.
#[test]
fn the_same_text_beside_another_called_program_is_not_the_same_where_the_run_stops() {
    let folder = TempDir::new().expect("works");
    let program =
        |call: &str| format!("O1\nG21 G90 G94\nG0 X0. Y0. Z0.\nIF[#500 EQ 1]GOTO 10\n{call}\nN10 G1 X5. F100.\nM30\n");
    let diff = |call: &str, called: [&str; 2]| {
        let sides = ["a", "b"].map(|side| {
            let place = folder.path().join(side);
            std::fs::create_dir_all(&place).expect("works");
            place
        });
        for (side, called) in sides.iter().zip(called) {
            std::fs::write(side.join("x.nc"), program(call)).expect("works");
            std::fs::write(side.join("O0100.nc"), format!("O0100\nG1 X{called} F100.\nM99\n")).expect("works");
        }
        let files = sides.map(|side| side.join("x.nc"));
        let output = trunnion(&["diff", str(&files[0]), str(&files[1]), "--dialect", "fanuc-30i"]);
        text(&output.stdout)
    };
    let undecided = diff("M98 P100", ["1.", "2."]);
    assert!(
        undecided.starts_with("UNKNOWN") && undecided.contains("may call"),
        "{undecided}"
    );
    // nothing is called
    assert!(diff("X3.", ["1.", "2."]).starts_with("SAME"));
}

#[test]
fn what_nobody_declared_is_listed_where_joints_are_compared() {
    let folder = TempDir::new().expect("works");
    let program = "G21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG0 G43 H1 X0 Y0 Z5\nG1 Z-1 F100\nX10\nM30\n";
    let (a, b) = (
        write(&folder, "a.nc", program),
        write(&folder, "b.nc", &program.replace("S1000 M3", "M3 S1000")),
    );
    let rest = ["--dialect", "fanuc-30i", "--machine", "mill-3axis"];
    let of = |command: &str, more: &[&str]| {
        let output = trunnion(&[&[command, str(&a), str(&b)], &rest[..], more].concat());
        assert_eq!(status(&output), 0, "{}", text(&output.stdout));
        output
    };
    let both = "assuming G54 = 0 (not declared), the length of tool 1 = 0 (not declared)\n";
    for command in ["certify", "diff"] {
        assert!(text(&of(command, &[]).stdout).contains(both), "{command}");
    }
    let listed = json(&of("diff", &["--format", "json"]))["assumptions"].clone();
    assert_eq!(
        listed,
        serde_json::json!(["G54 = 0 (not declared)", "the length of tool 1 = 0 (not declared)"])
    );
    write(
        &folder,
        "trunnion.toml",
        "[[tool]]\nnumber = 1\nlength = 80.0\n[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n",
    );
    for command in ["certify", "diff"] {
        assert!(!text(&of(command, &[]).stdout).contains("assuming"), "{command}");
    }
}
