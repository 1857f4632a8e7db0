//! `fmt` on the command line: files written, lists for CI, diffs, numbers, refusals, hostile files.

use super::tools::{status, str, text, trunnion, write};
use std::{
    fs,
    io::Write,
    process::{Command, Stdio},
};
use tempfile::TempDir;

const UNTIDY: &str = "%\no100 (bracket)\nn10g21g90  g17\n\n\n\nn20 t1m6;(not read)\nn30g0x0y0z 5.\nn40 g1z-1.f100   \nn50x10(edge)\nm30\n%\n";
const TIDY: &str = "%\nO100 (bracket)\nN10 G21 G90 G17\n\nN20 T1 M6 ;(not read)\nN30 G0 X0 Y0 Z5.\nN40 G1 Z-1. F100\nN50 X10 (edge)\nM30\n%\n";

#[test]
fn a_file_is_laid_out_in_place_and_then_left_alone() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.nc", UNTIDY);
    let iso = ["--dialect", "iso-6983"];
    let check = trunnion(&[&["fmt", "--check", str(&file)][..], &iso].concat());
    assert_eq!(
        (status(&check), text(&check.stdout)),
        (1, format!("{}\n", file.display()))
    );
    assert_eq!(
        fs::read_to_string(&file).expect("works"),
        UNTIDY,
        "--check writes nothing"
    );
    let stdout = trunnion(&[&["fmt", "--stdout", str(&file)][..], &iso].concat());
    assert_eq!((status(&stdout), text(&stdout.stdout)), (0, TIDY.to_owned()));
    let done = trunnion(&[&["fmt", str(&file)][..], &iso].concat());
    assert_eq!(
        (status(&done), text(&done.stdout), text(&done.stderr)),
        (0, String::new(), String::new())
    );
    assert_eq!(fs::read_to_string(&file).expect("works"), TIDY);
    let check = trunnion(&[&["fmt", "--check", str(&file)][..], &iso].concat());
    assert_eq!((status(&check), text(&check.stdout)), (0, String::new()));
    assert_eq!(
        fs::read_dir(folder.path()).expect("works").count(),
        1,
        "no temporary file stays behind"
    );
}

#[test]
fn a_diff_shows_the_lines_that_change() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.nc", UNTIDY);
    let output = trunnion(&["fmt", "--diff", str(&file), "--dialect", "iso-6983"]);
    assert_eq!(status(&output), 0);
    let name = str(&file).to_owned();
    insta::assert_snapshot!("fmt_diff", text(&output.stdout).replace(&name, "a.nc"));
    assert_eq!(fs::read_to_string(&file).expect("works"), UNTIDY);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(["fmt", "-", "--dialect", "iso-6983"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("runs");
    child
        .stdin
        .take()
        .expect("piped")
        .write_all(UNTIDY.as_bytes())
        .expect("works");
    assert_eq!(text(&child.wait_with_output().expect("works").stdout), TIDY);
}

#[test]
fn the_style_of_the_settings_is_taken_and_mistakes_have_their_place() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.nc", "g1x1(c)\n");
    write(
        &folder,
        "trunnion.toml",
        "dialect = \"iso-6983\"\n[format]\nleading_zeros = \"two\"\ncomment_column = 12\n",
    );
    assert_eq!(
        text(&trunnion(&["fmt", "--stdout", str(&file)]).stdout),
        "G01 X1     (c)\n"
    );
    for (settings, wrong) in [
        ("[format]\nindnt = 2\n", ":2:1: "),
        ("[format]\ncase = \"loud\"\n", ":2:8: "),
        ("[format]\nindent = -1\n", ":2:10: "),
    ] {
        let toml = write(&folder, "trunnion.toml", settings);
        let output = trunnion(&["fmt", str(&file)]);
        assert_eq!(status(&output), 2);
        let message = text(&output.stderr);
        assert!(
            message.starts_with(&format!("error: {}{wrong}", toml.display())),
            "{message}"
        );
    }
}

#[test]
fn block_numbers_are_new_and_jumps_follow() {
    let folder = TempDir::new().expect("works");
    let file = write(
        &folder,
        "a.nc",
        "O1\nN1 #1=0\nN5 G1 X#1 F100\nIF [#1 LT 3] GOTO 5\nN7 M98 P2000\nN8 M30\n",
    );
    let fanuc = ["--dialect", "fanuc-30i"];
    let output = trunnion(&[&["fmt", "--renumber", "100,50", str(&file)][..], &fanuc].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    assert_eq!(
        fs::read_to_string(&file).expect("works"),
        "O1\nN100 #1=0\nN150 G1 X#1 F100\nIF [#1 LT 3] GOTO 150\nN200 M98 P2000\nN250 M30\n"
    );
    assert!(
        text(&output.stderr).contains("calls O2000, which is not in this file"),
        "{}",
        text(&output.stderr)
    );
    let computed = write(&folder, "b.nc", "O1\nn1 x1\nGOTO #1\nM30\n");
    let output = trunnion(&[&["fmt", "--renumber", "10", str(&computed)][..], &fanuc].concat());
    assert_eq!(status(&output), 2);
    let message = text(&output.stderr);
    assert!(
        message.contains("b.nc:3:1: block numbers are not changed: the target of `GOTO #1` is computed"),
        "{message}"
    );
    assert_eq!(
        fs::read_to_string(&computed).expect("works"),
        "O1\nn1 x1\nGOTO #1\nM30\n",
        "nothing is half done"
    );
    assert_eq!(status(&trunnion(&["fmt", "--renumber", "10,0", str(&file)])), 2);
    assert_eq!(status(&trunnion(&["fmt", "--renumber", "x", str(&file)])), 2);
}

#[test]
fn hostile_files_end_in_a_clear_answer() {
    let folder = TempDir::new().expect("works");
    let put = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("writable");
        path
    };
    let long = put("long.nc", &b"X1.5 ".repeat(2_000_000));
    let nul = put("nul.nc", b"\0\0%\ng1x1\n");
    let latin = put("latin.nc", b"(gr\xfc\xdfe)\ng1x1(\xe4)\n");
    let empty = put("empty.nc", b"");
    let deep = put(
        "deep.ngc",
        format!("x{}1{}\nm2\n", "[".repeat(100_000), "]".repeat(100_000)).as_bytes(),
    );
    let iso = ["--dialect", "iso-6983"];
    for path in [&long, &nul, &latin, &empty] {
        let output = trunnion(&[&["fmt", str(path)][..], &iso].concat());
        assert_eq!(status(&output), 0, "{}: {}", path.display(), text(&output.stderr));
    }
    assert_eq!(status(&trunnion(&["fmt", str(&deep)])), 0);
    assert_eq!(fs::read(&nul).expect("works"), b"\0\0%\nG1 X1\n");
    assert_eq!(fs::read(&latin).expect("works"), b"(gr\xfc\xdfe)\nG1 X1 (\xe4)\n");
    for command in ["fmt", "stats", "parse"] {
        let missing = trunnion(&[command, str(&folder.path().join("none.nc"))]);
        assert_eq!(status(&missing), 2, "{command}");
        assert!(
            text(&missing.stderr).contains("none.nc: there is no such file"),
            "{}",
            text(&missing.stderr)
        );
    }
    let sub = folder.path().join("sub");
    fs::create_dir(&sub).expect("works");
    let output = trunnion(&["fmt", str(&sub)]);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("no program in this directory"),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn several_files_are_counted() {
    let folder = TempDir::new().expect("works");
    write(&folder, "a.mpf", "g1x1\n");
    write(&folder, "b.mpf", "G1 X1\n");
    write(&folder, "c.mpf", "g1x1..\n");
    let output = trunnion(&["fmt", str(folder.path())]);
    assert_eq!(status(&output), 0);
    let told = text(&output.stderr);
    assert!(
        told.contains("c.mpf: 1 problem in the text; its line is not changed"),
        "{told}"
    );
    assert!(told.contains("1 changed, 2 unchanged"), "{told}");
}
