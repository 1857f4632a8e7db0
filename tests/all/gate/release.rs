//! The release script ends as it should, and what it packs works alone: in an empty folder, for an account without any settings.
use crate::cli::tools::{str, text};
use std::{
    fs,
    os::unix::fs::{PermissionsExt, symlink},
    path::Path,
    process::{Command, Output},
};
use tempfile::TempDir;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A computer with the tools of every Linux, a toolchain that has built the program already, and nothing else.
struct Computer(TempDir);

impl Computer {
    fn new() -> Self {
        let computer = Self(TempDir::new().expect("a folder"));
        for folder in ["tools", "built/debug", "out"] {
            fs::create_dir_all(computer.0.path().join(folder)).expect("created");
        }
        let tools = "bash dirname sed head realpath rm mkdir cp tar gzip find sort sha256sum";
        for tool in tools.split(' ') {
            let found = std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default())
                .map(|folder| folder.join(tool))
                .find(|file| file.is_file())
                .unwrap_or_else(|| panic!("no {tool}"));
            symlink(found, computer.0.path().join("tools").join(tool)).expect("linked");
        }
        computer.tool("cargo", "exit 0");
        computer.tool(
            "rustc",
            "if [ \"$1\" = -vV ]; then echo 'host: here'; else echo /nowhere; fi",
        );
        let program = computer.0.path().join("built/debug/trunnion");
        fs::copy(env!("CARGO_BIN_EXE_trunnion"), program).expect("copied");
        computer
    }

    fn tool(&self, name: &str, script: &str) {
        let file = self.0.path().join("tools").join(name);
        fs::write(&file, format!("#!/usr/bin/env bash\n{script}\n")).expect("written");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).expect("allowed");
    }

    fn release(&self) -> Output {
        Command::new(self.0.path().join("tools/bash"))
            .arg(root().join("scripts/release.sh"))
            .arg(self.0.path().join("out"))
            .env_clear()
            .env("PATH", self.0.path().join("tools"))
            .env("CARGO_TARGET_DIR", self.0.path().join("built"))
            .env("PROFILE", "dev")
            .output()
            .expect("bash runs")
    }
}

#[test]
fn a_part_that_fails_fails_the_release_and_is_named() {
    let computer = Computer::new();
    let output = computer.release();
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    assert!(said.contains("Python wheel: maturin is not installed"), "{said}");
    assert!(said.contains("VS Code package: npm is not installed"), "{said}");

    // what belongs to other computers is listed, each part of it
    for target in [
        "x86_64-unknown-linux-gnu",
        "aarch64-apple-darwin",
        "x86_64-pc-windows-msvc",
    ] {
        let line = format!("binary, Python wheel and VS Code package for {target}: build them on such a computer");
        assert!(said.contains(&line), "{said}");
    }

    computer.tool("maturin", "exit 1");
    computer.tool("npm", "exit 1");
    let output = computer.release();
    let (said, failed) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(1), "{said}{failed}");
    assert!(failed.contains("FAILED:\n  Python wheel"), "{failed}");
    assert!(failed.contains("VS Code package: npm failed"), "{failed}");
    // the rest is built all the same
    assert!(
        said.contains("-here.tar.gz") && said.contains("documentation site"),
        "{said}"
    );
}

#[test]
fn the_packed_program_alone_says_on_all_samples_what_the_built_one_says() {
    let computer = Computer::new();
    let output = computer.release();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let name = format!("trunnion-{}-here", env!("CARGO_PKG_VERSION"));
    let empty = computer.0.path().join("empty");
    fs::create_dir(&empty).expect("created");
    let unpacked = Command::new("tar")
        .args([
            "-xzf",
            str(&computer.0.path().join("out").join(format!("{name}.tar.gz"))),
        ])
        .current_dir(&empty)
        .status();
    assert!(unpacked.expect("tar runs").success());
    let samples = root().join("samples");
    for machine in [None, Some("mikron-ucp710"), Some("mill-3axis"), Some("lathe-2axis")] {
        let check = |program: &Path, alone: bool| {
            let mut command = Command::new(program);
            command.args(["check", "--format", "json"]).arg(&samples);
            command.args(machine.into_iter().flat_map(|machine| ["--machine", machine]));
            if alone {
                command.env_clear().current_dir(&empty);
            }
            let output = command.output().expect("runs");
            assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
            text(&output.stdout)
        };
        let built = check(Path::new(env!("CARGO_BIN_EXE_trunnion")), false);
        let files: serde_json::Value = serde_json::from_str(&built).expect("JSON");
        assert!(files["files"].as_array().is_some_and(|all| all.len() > 25), "{built}");
        assert!(
            check(&empty.join(&name).join("trunnion"), true) == built,
            "on {machine:?}"
        );
    }
}
