//! `edit`: what is printed and written, exit statuses, and real programs: each is edited and proved, or refused with a reason.
use super::tools::{status, str, text, trunnion, write};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

const PART: &str =
    "%\nO1 (PART)\nN1 G21 G90 G17\nN2 G54 M3 S1000\nN3 G0 X10. Y20. Z5.\nN4 G1 Z-1. F100.\nN5 X30.\nN6 M30\n%\n";

#[test]
fn an_edit_is_printed_or_written_whole() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "part.nc", PART);
    let shift = ["edit", str(&file), "--dialect", "fanuc-30i", "--shift", "X=1.5,Z=-2"];
    let output = trunnion(&shift);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let diff = text(&output.stdout);
    assert!(diff.contains("-N3 G0 X10. Y20. Z5.\n-N4 G1 Z-1. F100.\n"), "{diff}");
    assert!(diff.contains("+N3 G0 X11.5 Y20. Z3.\n+N4 G1 Z-3. F100.\n"), "{diff}");
    assert!(text(&output.stderr).contains("proved by running both programs: 3 motions compared"));
    assert_eq!(fs::read_to_string(&file).expect("there"), PART, "a diff writes nothing");

    let out = folder.path().join("out.nc");
    let output = trunnion(&[&shift[..], &["-o", str(&out)]].concat());
    assert_eq!((status(&output), text(&output.stdout).as_str()), (0, ""));
    let moved = PART
        .replace("X10.", "X11.5")
        .replace("Z5.", "Z3.")
        .replace("Z-1.", "Z-3.")
        .replace("X30.", "X31.5");
    assert_eq!(fs::read_to_string(&out).expect("there"), moved);

    let output = trunnion(&[&shift[..], &["--write", "--backup", "-q"]].concat());
    assert_eq!((status(&output), text(&output.stderr).as_str()), (0, ""));
    assert_eq!(fs::read_to_string(&file).expect("there"), moved);
    let backup = folder.path().join("part.nc.bak");
    assert_eq!(fs::read_to_string(backup).expect("there"), PART);
}

#[test]
fn a_refused_edit_writes_nothing_and_says_where_and_why() {
    let folder = TempDir::new().expect("works");
    let program = PART.replace("N5 X30.", "N5 X#1");
    let file = write(&folder, "part.nc", &program);
    let out = folder.path().join("out.nc");
    let base = ["edit", str(&file), "--dialect", "fanuc-30i"];
    let output = trunnion(&[&base[..], &["--shift", "X=1", "-o", str(&out)]].concat());
    assert_eq!(status(&output), 1);
    assert!(
        text(&output.stderr).contains("part.nc:7:4: refused: X#1"),
        "{}",
        text(&output.stderr)
    );
    assert!(!out.exists());
    for (wrong, part) in [
        (&["--shift", "X"][..], "has no `=`"),
        (&["--shift", "X=1,X=2"], "twice"),
        (&["--mirror", "A"], "not X, Y or Z"),
        (&["--shift", "X=1", "--scale", "2"], "cannot be used with"),
        (&[], "required"),
        (&["--scale", "2", "-o", str(&file)], "also an input"),
    ] {
        let output = trunnion(&[&base[..], wrong].concat());
        assert_eq!(status(&output), 2, "{wrong:?}");
        assert!(
            text(&output.stderr).contains(part),
            "{wrong:?}: {}",
            text(&output.stderr)
        );
    }
    assert_eq!(fs::read_to_string(&file).expect("there"), program);
}

/// All files below a folder that are no lists.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, found);
        } else if fs::metadata(&path).is_ok_and(|data| data.len() < 300_000) {
            found.push(path);
        }
    }
}

#[test]
fn real_programs_are_edited_and_proved_or_refused_with_a_reason() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/wild");
    if !folder.is_dir() {
        println!("skipped: {} is not there", folder.display());
        return;
    }
    let mut all = Vec::new();
    files(&folder, &mut all);
    all.sort();
    // a sample, or all of them
    let step = if std::env::var_os("TRUNNION_EDITS_ALL").is_some() {
        1
    } else {
        23
    };
    let edits: [&[&str]; 7] = [
        &["--unit", "inch"],
        &["--unit", "mm"],
        &["--positions", "incremental"],
        &["--shift", "X=1.25,Y=-2,Z=0.5"],
        &["--scale", "1.01"],
        &["--mirror", "X"],
        &["--rotate", "Z=30"],
    ];
    let mut proved = 0;
    let mut counts: BTreeMap<&str, [u32; 3]> = BTreeMap::new();
    let mut reasons: BTreeMap<String, u32> = BTreeMap::new();
    for (index, file) in all.iter().enumerate().step_by(step) {
        for (turn, edit) in edits.iter().enumerate() {
            if step > 1 && (index + turn) % 2 == 1 {
                continue;
            }
            let output = trunnion(&[&["edit", str(file)][..], edit].concat());
            let said = text(&output.stderr);
            let count = counts.entry(edit[0]).or_default();
            match status(&output) {
                0 => {
                    count[0] += 1;
                    let is_proved = said.contains("proved by running both programs");
                    let name = file.display();
                    assert!(is_proved || said.contains("nothing to do"), "{name}: {said}");
                    assert_eq!(!output.stdout.is_empty(), is_proved, "{name}");
                    proved += u32::from(is_proved);
                }
                1 => {
                    count[1] += 1;
                    assert!(
                        output.stdout.is_empty() && said.contains("refused: "),
                        "{}: {said}",
                        file.display()
                    );
                    let reason = said.split("refused: ").nth(1).unwrap_or_default();
                    *reasons.entry(reason.chars().take(70).collect()).or_default() += 1;
                }
                2 => {
                    count[2] += 1;
                    assert!(said.starts_with("error: "), "{}: {said}", file.display());
                }
                other => panic!("{}: status {other}: {said}", file.display()),
            }
        }
    }
    println!("edit: {proved} proved; done, refused, not read: {counts:?}");
    let mut common: Vec<_> = reasons.into_iter().collect();
    common.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    common
        .iter()
        .take(40)
        .for_each(|(reason, count)| println!("{count:5} {reason}"));
    assert!(proved > 0, "{counts:?}");
}
