//! Running the built `trunnion` in tests.
#![allow(dead_code, reason = "each test file uses its part")]
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};
use tempfile::TempDir;

/// The published rows around the pole as a Fanuc program, ball tool declared.
pub(crate) const FLIP: &str = "\
(trunnion: tool 1 ball diameter 10)
G17 G90 G21 G94
T1 M6
S12000 M3
G43.4 H1
G1 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 F2000
X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822
X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086
X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
M5
M30
";

pub(crate) fn trunnion(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(arguments)
        .output()
        .expect("runs")
}

/// Runs in a folder, with relative names.
pub(crate) fn trunnion_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("runs")
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

pub(crate) fn status(output: &Output) -> i32 {
    output.status.code().expect("not killed")
}

pub(crate) fn write(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).expect("writable");
    path
}

pub(crate) fn str(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

pub(crate) fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", text(&output.stdout)))
}

/// All findings of a file of the JSON document: those of the list, each followed by those that it leads.
pub(crate) fn all_findings(file: &Value) -> Vec<&Value> {
    let leads = file["diagnostics"].as_array().expect("a list").iter();
    leads
        .flat_map(|lead| std::iter::once(lead).chain(lead["also"].as_array().into_iter().flatten()))
        .collect()
}
