//! The gate in front of the machine: formats for CI, the baseline, schemas, the recipes, and the report page.
#![allow(clippy::print_stdout, reason = "a skipped test says so")]

mod annotations;
mod arguments;
mod baseline;
mod formats;
mod people;
mod python;
mod recipes;
mod release;
mod schemas;
mod tutorials;

use super::cli::tools::{FLIP, str, write};
use std::{path::PathBuf, process::Output};
use tempfile::TempDir;

/// A folder with one bad and one good program for a three-axis mill.
fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    write(&folder, "bad.nc", BAD);
    write(&folder, "good.nc", GOOD);
    write(
        &folder,
        "trunnion.toml",
        "machine = \"mill-3axis\"\ndialect = \"fanuc-30i\"\nassume = [\"work-offset\", \"tool-length\"]\n",
    );
    folder
}

const GOOD: &str = "%\nO1\nN10 G17 G21 G90 G94 G40 G49 G80\nN20 T1 M6\nN30 G54 G0 X0. Y0.\nN40 G43 H1 Z-10.\nN50 S3000 M3\nN60 G1 X10. F200.\nN70 M5\nN80 M30\n%\n";
/// Two mistakes: a cut without feed, a cut with the spindle off.
const BAD: &str = "%\nO2\nN10 G17 G21 G90 G94 G40 G49 G80\nN20 T1 M6\nN30 G54 G0 X0. Y0.\nN40 G43 H1 Z-10.\nN50 G1 X10.\nN60 G1 X20. F200.\nN70 M5\nN80 M30\n%\n";

fn check(folder: &TempDir, arguments: &[&str]) -> Output {
    let mut all = vec!["check"];
    all.extend(arguments);
    super::cli::tools::trunnion_in(folder.path(), &all)
}

/// The published rows around the pole, in a folder of their own.
fn flip(folder: &TempDir) -> PathBuf {
    write(folder, "flip.nc", FLIP)
}

/// Arguments that check the published rows.
fn on_mikron(file: &std::path::Path) -> Vec<&str> {
    vec![str(file), "--machine", "mikron-ucp710", "--dialect", "fanuc-30i"]
}
