//! A folder: every program is checked, and what is left out is listed.
use super::{LOOSE, fifo, folder};
use crate::bounds::measure;
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

/// What this program wrote itself is no file that was left out, and a baseline that is not used is named.
#[test]
fn baselines_caches_and_reports_are_known() {
    let folder = folder();
    let programs = folder.path().join("programs");
    fs::create_dir_all(&programs).expect("a folder");
    write(&folder, "programs/a.nc", LOOSE);
    let (baseline, cache) = (programs.join("baseline.json"), programs.join("kept"));
    let report = programs.join("report.json");
    trunnion(&["check", str(&programs), "--write-baseline", str(&baseline)]);
    trunnion(&["check", str(&programs), "--cache", str(&cache)]);
    trunnion(&["check", str(&programs), "--format", "json", "-o", str(&report)]);
    assert!(baseline.is_file() && report.is_file() && cache.read_dir().expect("a cache").count() > 0);
    let said = text(&trunnion(&["check", str(&programs)]).stderr);
    assert!(!said.contains("left out"), "{said}");
    assert!(
        said.contains("baseline.json: a baseline, which is not used; --baseline"),
        "{said}"
    );
    let said = text(&trunnion(&["check", str(&programs), "--baseline", str(&baseline)]).stderr);
    assert!(!said.contains("left out") && !said.contains("not used"), "{said}");
    // other JSON is
    write(&folder, "programs/other.json", "{\"schema\": \"mine/1\"}\n");
    let said = text(&trunnion(&["check", str(&programs), "-v"]).stderr);
    assert!(
        said.contains("other.json: left out") && !said.contains("baseline.json: left out"),
        "{said}"
    );
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
    // the JSON names it, too
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

/// Programs of several controls, with findings, faults of the file system and machines between them.
fn many(folder: &tempfile::TempDir, files: usize) {
    for file in 0..files {
        let place = format!("lot-{}/part-{file}", file % 7);
        fs::create_dir_all(folder.path().join(&place).parent().expect("a folder")).expect("made");
        let (extension, body) = [
            (
                "nc",
                "(trunnion: machine mikron-ucp710)\nG21 G90 G17 G54\nG43.4 H1\nG1 X1. A10. C20. F100.\nC400.\nM30\n",
            ),
            ("mpf", "G90 G71 G54\nTRAORI\nG1 X=R1 A3=0 B3=0 C3=1 F100\nM30\n"),
            (
                "ngc",
                "G21 G90\no1 while [#1 LT 3]\nG1 X#1 F100\n#1 = [#1 + 1]\no1 endwhile\nM2\n",
            ),
            ("apt", "PARTNO X\nGOTO/1,2,3\nFINI\n"),
        ][file % 4];
        write(folder, &format!("{place}.{extension}"), body);
    }
}

#[test]
fn any_number_of_threads_says_the_same() {
    let folder = folder();
    many(&folder, 150);
    fs::write(folder.path().join("lot-3/large.nc"), vec![b'\n'; 1_000_001]).expect("written");
    for format in ["json", "short", "pretty"] {
        let on = |threads: &str| {
            let output = std::process::Command::new(env!("CARGO_BIN_EXE_trunnion"))
                .args(["check", "-v", "--max-file-mb", "1", "--format", format, "."])
                .current_dir(folder.path())
                .env("RAYON_NUM_THREADS", threads)
                .output()
                .expect("runs");
            assert_eq!(status(&output), 2, "one file is too large");
            (text(&output.stdout), text(&output.stderr))
        };
        let one = on("1");
        assert!(one.0.contains("part-149") || one.1.contains("part-149"), "{}", one.1);
        for threads in ["2", "7"] {
            assert_eq!(on(threads), one, "{format} on {threads} threads");
        }
    }
}

/// A folder is checked in pieces: what is held does not grow with the number of its files, and few of them are open at once.
#[cfg(target_os = "linux")]
#[test]
fn a_large_folder_takes_no_more_memory_and_few_open_files() {
    const FEW: usize = 200;
    const MANY: usize = 3000;
    let peak = |files: usize| {
        let folder = folder();
        many(&folder, files);
        let command = ["check", "--format", "json", "."].map(String::from);
        let measured = measure::run(folder.path(), &command, Vec::new(), std::time::Duration::from_mins(5));
        assert_eq!(measured.status, Some(1), "{}", measured.said);
        assert!(measured.is_json());
        (measured.bytes, folder)
    };
    let (few, _) = peak(FEW);
    let (most, folder) = peak(MANY);
    // a path and its place in the list of each file
    let each = most.saturating_sub(few) / (MANY - FEW) as u64;
    assert!(each < 1000, "{each} bytes a file");
    let output = std::process::Command::new("sh")
        .args([
            "-c",
            "ulimit -n 32; \"$0\" check --format short .",
            env!("CARGO_BIN_EXE_trunnion"),
        ])
        .current_dir(folder.path())
        .output()
        .expect("runs");
    let last = text(&output.stderr);
    assert!(
        last.lines()
            .last()
            .is_some_and(|line| line.starts_with("3000 files: ") && !line.contains("not checked")),
        "{last}"
    );
}
