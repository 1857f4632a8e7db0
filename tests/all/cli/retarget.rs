//! `fix --rewrite retarget`: the last of several rewrites writes the program for another control, proved.
use super::tools::{json, status, str, text, trunnion, write};
use std::fs;
use tempfile::TempDir;

/// A ring of short lines that `fit-arcs` makes an arc of.
const PART: &str = "O1\nG21 G90 G94 G17 G54\nG0 X2. Y0. Z5. S8000 M3\nG1 Z0. F500\nX1.9973 Y0.1047\nX1.9890 Y0.2091\nX1.9754 Y0.3129\n\
                    X1.9563 Y0.4158\nX1.9319 Y0.5176\nX1.9021 Y0.6180\nY5.\nG0 Z5.\nM30\n";
const ON: [&str; 4] = ["--dialect", "fanuc-30i", "--machine", "mill-3axis"];

#[test]
fn without_a_target_it_says_what_is_missing() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "part.nc", PART);
    let fix = |more: &[&str]| trunnion(&[&["fix", str(&file)][..], &ON, more].concat());
    let output = fix(&["--rewrite", "retarget"]);
    assert_eq!(status(&output), 1);
    let said = text(&output.stderr);
    assert!(
        said.contains("--to DIALECT") && said.contains("--to-machine NAME"),
        "{said}"
    );
    // `all` means all that need no target
    let said = text(&fix(&["--rewrite", "all"]).stderr);
    assert!(!said.contains("retarget"), "{said}");
    let output = fix(&["--rewrite", "renumber", "--to", "linuxcnc"]);
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("add --rewrite retarget"));
    for refused in [
        &["--rewrite", "retarget", "--to", "linuxcnc", "--write"][..],
        &["--rewrite", "retarget", "--to", "linuxcnc", "--lines", "3-4"],
        &[
            "--rewrite",
            "renumber,retarget",
            "--to",
            "linuxcnc",
            "--certificate",
            "proof.json",
        ],
        &["--rewrite", "retarget", "--to", "linxcnc"],
    ] {
        assert_eq!(status(&fix(refused)), 2, "{refused:?}");
    }
    assert_eq!(fs::read_to_string(&file).expect("works"), PART, "nothing is written");
}

#[test]
fn it_writes_what_the_rewrites_before_it_leave() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "part.nc", PART);
    let (after, proof) = (folder.path().join("part.mpf"), folder.path().join("proof.json"));
    let fix = |more: &[&str]| trunnion(&[&["fix", str(&file)][..], &ON, more].concat());
    let target = ["--to", "sinumerik-840d", "-o", str(&after)];
    let output = fix(&[&["--rewrite", "fit-arcs,retarget"][..], &target].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let program = fs::read_to_string(&after).expect("works");
    assert!(
        program.contains("G3 X1.9021 Y0.618 I") && program.contains("G710"),
        "{program}"
    );

    let output = fix(&[&["--rewrite", "retarget", "--certificate", str(&proof)][..], &target].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let certify = [
        &["certify", str(&file), str(&after), "--certificate", str(&proof)][..],
        &ON,
    ]
    .concat();
    let output = trunnion(&certify);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    assert!(text(&output.stdout).starts_with("PROVED"), "{}", text(&output.stdout));
    // another program than the proved one
    let program = fs::read_to_string(&after).expect("works");
    write(&folder, "part.mpf", &program.replace("Y5", "Y6"));
    assert_eq!(status(&trunnion(&certify)), 1);
}

#[test]
fn a_refusal_changes_nothing_and_names_the_place() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "part.nc", &PART.replace("G0 Z5.\n", "G0 Z5.\nM19 R30.\n"));
    let after = folder.path().join("part.mpf");
    let target = [
        "--rewrite",
        "retarget",
        "--to",
        "grbl",
        "-o",
        str(&after),
        "--format",
        "json",
    ];
    let output = trunnion(&[&["fix", str(&file)][..], &ON, &target].concat());
    assert_eq!(status(&output), 1, "{}", text(&output.stderr));
    let document = json(&output);
    assert_eq!(document["rewrites"][0]["state"], "refused");
    assert_eq!(document["changed"], false);
    let reason = document["places"][0]["reason"].as_str().expect("a reason");
    assert!(reason.starts_with("line 13, column"), "{reason}");
}
