//! A folder: every program is checked, and what is left out is listed.
use super::{LOOSE, fifo, folder};
use crate::cli::tools::{json, status, str, text, trunnion, write};
use std::{ffi::OsStr, fs, os::unix::ffi::OsStrExt, os::unix::fs::symlink};

#[test]
fn nothing_in_a_folder_is_passed_over_in_silence() {
    let folder = folder();
    let programs = folder.path().join("programs");
    fs::create_dir_all(programs.join("sub/.hidden")).expect("folders");
    write(&folder, "outside.nc", LOOSE);
    write(&folder, "programs/a.nc", LOOSE);
    write(&folder, "programs/sub/b.MPF", "G0 X1\nM30\n");
    write(&folder, "programs/O1234", LOOSE);
    write(
        &folder,
        "programs/README",
        "This folder holds programs.\nThey are for the big mill.\n",
    );
    write(&folder, "programs/notes.txt", "call Jim\n");
    write(&folder, "programs/.gitignore", "old*\n");
    write(&folder, "programs/old.nc", LOOSE);
    write(&folder, "programs/sub/.hidden/c.nc", LOOSE);
    fs::write(programs.join(OsStr::from_bytes(b"\xff.nc")), LOOSE).expect("written");
    symlink("../outside.nc", programs.join("out.nc")).expect("a link");
    symlink("a.nc", programs.join("again.nc")).expect("a link");
    symlink(".", programs.join("sub/round")).expect("a link");
    symlink("nowhere", programs.join("broken.nc")).expect("a link");
    fifo(&programs.join("pipe.nc"));
    let output = trunnion(&["check", "--format", "json", "-v", str(&programs)]);
    let said = text(&output.stderr);
    let document = json(&output);
    assert_eq!(document["summary"]["files"], 4, "{document} {said}");
    for (name, why) in [
        ("README", "no extension"),
        ("notes.txt", "extension is not one of a program"),
        ("old.nc", ".gitignore"),
        (".hidden", "hidden"),
        ("out.nc", "a link to outside the folder"),
        ("again.nc", "in the list already"),
        ("round", "searched already"),
        ("broken.nc", "a broken link"),
        ("pipe.nc", "FIFO"),
    ] {
        assert!(
            said.lines().any(|line| line.contains(name) && line.contains(why)),
            "{name}: {said}"
        );
    }
    let output = trunnion(&["check", str(&programs)]);
    let said = text(&output.stderr);
    assert!(said.contains("9 files or folders were left out"), "{said}");
    let last = said.lines().last().unwrap_or_default();
    assert!(last.starts_with("4 files: "), "{said}");
}

#[test]
fn an_unreadable_file_of_a_folder_counts_as_not_checked() {
    let folder = folder();
    write(&folder, "a.nc", LOOSE);
    let large = fs::File::create(folder.path().join("b.nc")).expect("made");
    large.set_len(3_000_000).expect("sparse");
    let output = trunnion(&["check", "--max-file-mb", "1", str(folder.path())]);
    assert_eq!(status(&output), 2);
    let said = text(&output.stderr);
    assert!(said.contains("b.nc: is larger than 1 MB"), "{said}");
    assert!(said.contains("1 not checked"), "{said}");
    // who reads the JSON alone sees it, too
    let output = trunnion(&["check", "--max-file-mb", "1", "--format", "json", str(folder.path())]);
    assert_eq!(status(&output), 2);
    let document = json(&output);
    assert_eq!(document["files"].as_array().map(Vec::len), Some(1));
    let [left] = document["not_checked"].as_array().expect("a list").as_slice() else {
        panic!("{document}");
    };
    let place = left["place"].as_str().unwrap_or_default();
    let message = left["message"].as_str().unwrap_or_default();
    assert!(
        place.ends_with("b.nc") && message.contains("is larger than 1 MB"),
        "{left}"
    );
}
