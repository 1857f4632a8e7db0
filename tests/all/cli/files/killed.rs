//! A command that is killed at any moment, beside others, or on a file that changes meanwhile leaves whole files.
use super::{LOOSE, content, folder, names};
use crate::cli::tools::{status, str, text, trunnion, write};
use std::{
    fmt::Write,
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

/// Kills of each command in CI; `TRUNNION_KILLS=200` is the long form.
fn kills() -> u32 {
    std::env::var("TRUNNION_KILLS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(12)
}

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("runs")
}

/// A program large enough that a run takes some hundredths of a second.
fn large() -> String {
    let mut program = String::from("%\nO1\nG21G90G17G54\nT1M6\nS1000M3\nG1Z-1F100\n");
    for i in 0..4000 {
        let _ = writeln!(program, "X{}Y{}", i % 300, i % 170);
    }
    program.push_str("M30\n%\n");
    program
}

fn is_temporary(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".trunnion-tmp")
}

#[test]
fn a_killed_fmt_leaves_the_old_file_or_the_new_one() {
    let old = large();
    let folder = folder();
    let path = write(&folder, "p.nc", &old);
    let begun = std::time::Instant::now();
    assert_eq!(status(&trunnion(&["fmt", str(&path)])), 0);
    let whole = begun.elapsed();
    let new = content(&path);
    assert_ne!(new, old);
    let runs = kills();
    for run in 0..runs {
        std::fs::write(&path, &old).expect("written");
        let mut child = start(&["fmt", str(&path)]);
        // spread over the whole of a run
        std::thread::sleep(Duration::from_micros(
            whole.as_micros() as u64 * u64::from(run + 1) / u64::from(runs),
        ));
        child.kill().expect("killed");
        child.wait().expect("ended");
        let now = content(&path);
        assert!(now == old || now == new, "run {run}: {} bytes", now.len());
        let left = names(folder.path())
            .into_iter()
            .filter(|name| is_temporary(name))
            .count();
        assert!(left <= 1, "run {run}: {left} temporary files");
    }
    assert_eq!(status(&trunnion(&["fmt", str(&path)])), 0);
    assert_eq!((content(&path), names(folder.path())), (new, vec!["p.nc".to_owned()]));
}

#[test]
fn a_run_that_has_nothing_to_write_removes_what_a_killed_one_left() {
    let folder = folder();
    let path = write(&folder, "p.nc", LOOSE);
    assert_eq!(status(&trunnion(&["fmt", str(&path)])), 0);
    write(&folder, ".p.nc.abcdefgh.trunnion-tmp", "half of a pro");
    assert_eq!(status(&trunnion(&["fmt", str(&path)])), 0);
    assert_eq!(names(folder.path()), ["p.nc"]);
}

#[test]
fn four_processes_on_one_file_leave_it_whole() {
    let old = large();
    let folder = folder();
    let path = write(&folder, "p.nc", &old);
    let children: Vec<Child> = (0..4).map(|_| start(&["fmt", str(&path)])).collect();
    for mut child in children {
        let status = child.wait().expect("ended").code();
        // done by another already, or refused because another was first
        assert!(matches!(status, Some(0 | 2)), "{status:?}");
    }
    let now = content(&path);
    assert_eq!(status(&trunnion(&["fmt", "--check", str(&path)])), 0);
    assert_ne!(now, old);
    assert_eq!(names(folder.path()), ["p.nc"]);
}

#[test]
fn an_edit_that_is_saved_while_fmt_runs_stays() {
    let old = large();
    let folder = folder();
    let path = write(&folder, "p.nc", &old);
    let edited = format!("(edited)\n{old}");
    for _ in 0..5 {
        std::fs::write(&path, &old).expect("written");
        let mut child = start(&["fmt", str(&path)]);
        std::thread::sleep(Duration::from_millis(5));
        std::fs::write(&path, &edited).expect("written");
        child.wait().expect("ended");
        // fmt was refused, or it began after the edit
        let now = content(&path);
        assert!(now.contains("(edited)") || now.contains("(EDITED)"), "the edit is lost");
    }
}

#[test]
fn a_full_disk_leaves_the_old_file() {
    // a file system of 64 KiB, where this process may mount one
    let folder = folder();
    let disk = folder.path().join("disk");
    std::fs::create_dir(&disk).expect("a folder");
    let mounted = Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=64k", "tmpfs", str(&disk)])
        .stderr(Stdio::null())
        .status();
    if !mounted.is_ok_and(|status| status.success()) {
        println!("skipped: this process may not mount a small file system");
        return;
    }
    let outcome = std::panic::catch_unwind(|| on_a_full_disk(&disk));
    let _ = Command::new("umount").arg(&disk).status();
    assert!(outcome.is_ok());
}

fn on_a_full_disk(disk: &Path) {
    let path = disk.join("p.nc");
    let old = large();
    std::fs::write(&path, &old).expect("there is room for one");
    let output = trunnion(&["fmt", str(&path)]);
    assert_eq!(status(&output), 2, "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("was not changed"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(content(&path), old);
    assert_eq!(names(disk), ["p.nc"]);
}
