//! `certify` reads each program with the settings of its own folder, as `diff` does.
use super::tools::{status, text, trunnion_in};
use std::fs;
use tempfile::TempDir;

const PROGRAM: &str =
    "%\nO1\nG21 G17 G90 G94 G54\nT1 M6\nS1000 M3\nG0 G43 H1 X0. Y0. Z50.\nG1 X10. F100.\nM5\nM30\n%\n";
const SETTINGS: &str = "[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n[[tool]]\nnumber = 1\nlength = 80\n";

/// `a` has settings in the folder above it, `b` its own.
fn folders(own: &str) -> TempDir {
    let folder = TempDir::new().expect("works");
    for name in ["a", "b"] {
        fs::create_dir(folder.path().join(name)).expect("works");
        fs::write(folder.path().join(name).join("main.nc"), PROGRAM).expect("works");
    }
    fs::write(folder.path().join("trunnion.toml"), SETTINGS).expect("works");
    fs::write(folder.path().join("b/trunnion.toml"), own).expect("works");
    folder
}

fn certify(folder: &TempDir, more: &[&str]) -> (i32, String) {
    let arguments = [
        "certify",
        "a/main.nc",
        "b/main.nc",
        "--dialect",
        "fanuc-30i",
        "--machine",
        "mill-3axis",
    ];
    let output = trunnion_in(folder.path(), &[&arguments[..], more].concat());
    (status(&output), text(&output.stdout))
}

#[test]
fn other_settings_are_named_and_prove_nothing() {
    let (code, said) = certify(&folders(SETTINGS), &[]);
    assert!(code == 0 && said.starts_with("PROVED"), "{said}");
    for (own, name) in [
        (SETTINGS.replace("length = 80", "length = 60"), "tool 1"),
        (SETTINGS.replace("X = 0", "X = 100"), "work offset G54"),
        (String::new(), "work offset G54, tool 1"),
        (format!("{SETTINGS}[variables]\n\"#500\" = 1\n"), "numbered variables"),
    ] {
        let (code, said) = certify(&folders(&own), &[]);
        assert!(
            code == 1 && said.starts_with("UNKNOWN") && said.contains(name),
            "{name}: {said}"
        );
    }
}
