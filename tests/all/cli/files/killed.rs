//! A command that is killed at any moment, beside others, on a file that changes meanwhile, or where nothing can be written, leaves whole files.
use super::writers::{WRITERS, Writer, all_names, fill, finished, outputs, prepared, temporaries};
use super::{LOOSE, content, folder, names};
use crate::cli::tools::{status, str, text, trunnion, trunnion_in, write};
use std::{
    fs,
    os::unix::fs::PermissionsExt,
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

/// Kills of each command in CI; `TRUNNION_KILLS=200` is the long form.
fn kills() -> u32 {
    std::env::var("TRUNNION_KILLS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(6)
}

fn start(folder: &Path, arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("runs")
}

fn has_ending(name: &str, ending: &str) -> bool {
    Path::new(name).extension().is_some_and(|own| own == ending)
}

/// Lines of the large inputs: a run takes some hundredths of a second.
const LARGE: usize = 4000;

#[test]
fn a_killed_command_leaves_each_file_old_or_new() {
    for writer in WRITERS {
        let folder = prepared(LARGE);
        let old = outputs(writer, folder.path());
        let begun = std::time::Instant::now();
        let new = finished(writer, folder.path());
        let whole = begun.elapsed();
        assert_ne!(old, new, "{}", writer.name);
        let expected = all_names(folder.path());
        let runs = kills();
        for run in 0..runs {
            fill(folder.path(), LARGE);
            for (name, old) in writer.outputs.iter().zip(&old) {
                if old.is_none() {
                    let _ = fs::remove_file(folder.path().join(name));
                }
            }
            let mut child = start(folder.path(), &writer.arguments());
            // spread over the whole of a run
            let moment = whole.as_micros() as u64 * u64::from(run + 1) / u64::from(runs);
            std::thread::sleep(Duration::from_micros(moment));
            child.kill().expect("killed");
            child.wait().expect("ended");
            for (at, now) in outputs(writer, folder.path()).into_iter().enumerate() {
                let name = writer.outputs[at];
                assert!(
                    now == old[at] || now == new[at],
                    "{}, run {run}: {name} is in pieces",
                    writer.name
                );
            }
            let left = temporaries(folder.path());
            assert!(left <= 1, "{}, run {run}: {left} temporary files", writer.name);
        }
        fill(folder.path(), LARGE);
        for name in writer
            .outputs
            .iter()
            .filter(|name| !has_ending(name, "nc") && **name != "parameters")
        {
            let _ = fs::remove_file(folder.path().join(name));
        }
        assert_eq!(finished(writer, folder.path()), new, "{}", writer.name);
        assert_eq!(all_names(folder.path()), expected, "{}", writer.name);
    }
}

/// An entry of the cache is named after a digest of what it depends on, and begins with a digest of its text.
#[test]
fn a_killed_check_leaves_whole_entries_in_its_cache() {
    let folder = prepared(10);
    let cache = folder.path().join("cache");
    let arguments = ["check", "flip.nc", "--format", "json", "--cache", "cache"];
    let begun = std::time::Instant::now();
    let new = trunnion_in(folder.path(), &arguments).stdout;
    let whole = begun.elapsed();
    let [name] = &names(&cache)[..] else {
        panic!("one entry: {:?}", names(&cache));
    };
    let entry = fs::read(cache.join(name)).expect("readable");
    let runs = kills();
    for run in 0..runs {
        fs::remove_dir_all(&cache).expect("removed");
        let mut child = start(folder.path(), &arguments);
        std::thread::sleep(whole * (run + 1) / runs);
        child.kill().expect("killed");
        child.wait().expect("ended");
        let left = if cache.is_dir() { names(&cache) } else { Vec::new() };
        let (temporary, kept): (Vec<_>, Vec<_>) = left.iter().partition(|name| name.ends_with(".trunnion-tmp"));
        assert!(temporary.len() <= 1 && kept.len() <= 1, "run {run}: {left:?}");
        for own in kept {
            assert_eq!(
                (own, fs::read(cache.join(own)).expect("readable")),
                (name, entry.clone()),
                "run {run}"
            );
        }
        // the next run says the same, whatever was left, and cleans up
        assert_eq!(trunnion_in(folder.path(), &arguments).stdout, new, "run {run}");
        assert_eq!(&names(&cache)[..], std::slice::from_ref(name), "run {run}");
    }
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
    for writer in WRITERS {
        let folder = prepared(LARGE);
        let new = finished(writer, folder.path());
        fill(folder.path(), LARGE);
        let expected = all_names(folder.path());
        let children: Vec<Child> = (0..4).map(|_| start(folder.path(), &writer.arguments())).collect();
        for mut child in children {
            let status = child.wait().expect("ended").code();
            // done by another already, or refused because another was first
            assert!(matches!(status, Some(0..=2)), "{}: {status:?}", writer.name);
        }
        let now = outputs(writer, folder.path());
        // a backup may be that of a file which another process had already replaced
        let whole = writer
            .outputs
            .iter()
            .enumerate()
            .filter(|(_, name)| !has_ending(name, "bak"));
        for (at, name) in whole {
            assert_eq!(now[at], new[at], "{}: {name}", writer.name);
        }
        assert_eq!(all_names(folder.path()), expected, "{}", writer.name);
    }
}

#[test]
fn an_edit_that_is_saved_while_a_command_runs_stays() {
    for writer in WRITERS
        .iter()
        .filter(|writer| matches!(writer.name, "fmt" | "fix --write"))
    {
        let name = writer.outputs[0];
        let folder = prepared(LARGE);
        let path = folder.path().join(name);
        let edited = format!("(edited)\n{}", content(&path));
        for run in 0..5 {
            fill(folder.path(), LARGE);
            let mut child = start(folder.path(), &writer.arguments());
            std::thread::sleep(Duration::from_millis(3 * run));
            fs::write(&path, &edited).expect("written");
            child.wait().expect("ended");
            // it was refused, or it began after the edit
            let now = content(&path).to_uppercase();
            assert!(now.contains("(EDITED)"), "{}: the edit is lost", writer.name);
        }
    }
}

/// Runs a command in `bash`, which lets no file grow beyond `kilobytes`: a write past that ends the process by a signal, as a kill does.
fn ended_at(folder: &Path, kilobytes: usize, arguments: &[&str]) -> std::process::Output {
    Command::new("bash")
        .args([
            "-c",
            "ulimit -c 0; ulimit -f \"$1\"; shift; exec \"$0\" \"$@\"",
            env!("CARGO_BIN_EXE_trunnion"),
            &kilobytes.to_string(),
        ])
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .expect("bash runs")
}

#[test]
fn a_certificate_that_a_kill_left_beside_a_new_program_is_named() {
    let fix = ["fix flip.nc --rewrite smooth-pole --tolerance-deg", "0.05", "0.08"];
    let convert = ["convert piece.apt --to fanuc-30i --program-number", "1", "2"];
    for ([command, first, second], before) in [(fix, "flip.nc"), (convert, "piece.apt")] {
        let folder = prepared(10);
        let path = |name: &str| folder.path().join(name);
        let arguments = |value: &'static str| -> Vec<&str> {
            let outputs = ["-o", "new.nc", "--certificate", "proof.json"];
            command.split(' ').chain([value]).chain(outputs).collect()
        };
        let run = |value| {
            let output = trunnion_in(folder.path(), &arguments(value));
            assert_eq!(status(&output), 0, "{command} {value}: {}", text(&output.stderr));
            ["new.nc", "proof.json"].map(|name| content(&path(name)))
        };
        let certify = || {
            let output = trunnion_in(
                folder.path(),
                &["certify", before, "new.nc", "--certificate", "proof.json"],
            );
            (status(&output), text(&output.stdout))
        };
        let [program, certificate] = run(second);
        let [old_program, old_certificate] = run(first);
        assert_ne!(program, old_program, "{command}");
        // the certificate is longer than its program: the process ends at a byte between the first write and the end of the second
        let kilobytes = program.len().div_ceil(1024);
        assert!(certificate.len() > kilobytes * 1024, "{command}");
        let killed = ended_at(folder.path(), kilobytes, &arguments(second));
        assert_eq!(killed.status.code(), None, "{command}: {}", text(&killed.stderr));
        assert_eq!(content(&path("new.nc")), program, "{command}");
        assert_eq!(content(&path("proof.json")), old_certificate, "{command}");
        assert_eq!(temporaries(folder.path()), 1, "{command}");
        let (status, said) = certify();
        assert_eq!(status, 1, "{command}: {said}");
        for part in ["REFUTED", "made for another changed program", "run that command again"] {
            assert!(said.contains(part), "{command}: {said}");
        }
        // which makes both again, and removes what the kill left
        assert_eq!(run(second), [program, certificate], "{command}");
        assert_eq!(certify().0, 0, "{command}");
        assert_eq!(temporaries(folder.path()), 0, "{command}");
    }
}

/// What a command may do that cannot write: say so and leave everything as it was.
fn refused(writer: &Writer, folder: &Path, output: &std::process::Output, old: &[Option<String>], before: &[String]) {
    let said = text(&output.stderr);
    assert_eq!(status(output), 2, "{}: {said}", writer.name);
    assert!(said.contains("error:"), "{}: {said}", writer.name);
    assert_eq!(outputs(writer, folder), old, "{}: {said}", writer.name);
    assert_eq!(names(folder), before, "{}: {said}", writer.name);
}

#[test]
fn a_file_that_cannot_be_written_to_its_end_stays_as_it_was() {
    for writer in WRITERS {
        let folder = prepared(LARGE);
        let (old, before) = (outputs(writer, folder.path()), names(folder.path()));
        // no file may grow at all; without the trap the system would end the process
        let output = Command::new("bash")
            .args([
                "-c",
                "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\"",
                env!("CARGO_BIN_EXE_trunnion"),
            ])
            .args(writer.arguments())
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .expect("bash runs");
        refused(writer, folder.path(), &output, &old, &before);
    }
}

#[test]
fn a_folder_that_may_not_be_written_to_is_named() {
    for writer in WRITERS {
        let folder = prepared(10);
        let (old, before) = (outputs(writer, folder.path()), names(folder.path()));
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).expect("a mode");
        let is_obeyed = fs::write(folder.path().join("probe"), "").is_err();
        let output = is_obeyed.then(|| trunnion_in(folder.path(), &writer.arguments()));
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).expect("a mode");
        let Some(output) = output else {
            println!("skipped: this user may write to read-only folders");
            return;
        };
        refused(writer, folder.path(), &output, &old, &before);
    }
}

#[test]
fn a_full_disk_leaves_the_old_file() {
    // a file system of 200 KiB, where this process may mount one
    let folder = folder();
    let disk = folder.path().join("disk");
    fs::create_dir(&disk).expect("a folder");
    let mounted = Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=200k", "tmpfs", str(&disk)])
        .stderr(Stdio::null())
        .status();
    if !mounted.is_ok_and(|status| status.success()) {
        println!("skipped: this process may not mount a small file system");
        return;
    }
    let outcome = std::panic::catch_unwind(|| {
        for writer in WRITERS {
            fill(&disk, 2000);
            let rest = disk.join("rest");
            // what is left of it
            let mut size = 200_000;
            while fs::write(&rest, vec![0; size]).is_err() && size > 0 {
                size -= 4096;
            }
            let (old, before) = (outputs(writer, &disk), names(&disk));
            let output = trunnion_in(&disk, &writer.arguments());
            refused(writer, &disk, &output, &old, &before);
            fs::remove_file(rest).expect("removed");
        }
    });
    let _ = Command::new("umount").arg(&disk).status();
    assert!(outcome.is_ok());
}
