//! `machine compare` and `machine import` from outside.
use super::tools::{json, status, str, text, trunnion, write};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The embedded machine's file with the pivot of A moved and without the rows that would contradict it.
fn planted(folder: &TempDir) -> std::path::PathBuf {
    let source = trunnion::machine::builtin_source("mikron-ucp710").expect("embedded");
    let axes = source.split("[[check]]").next().expect("a part");
    let moved = axes.replacen(
        "dir = [1, 0, 0]\npoint = [0, 0, 0]",
        "dir = [1, 0, 0]\npoint = [0, 0.05, 0]",
        1,
    );
    assert_ne!(moved, axes);
    write(folder, "measured.toml", &moved)
}

#[test]
fn a_planted_pivot_error_is_found_with_its_block() {
    let folder = TempDir::new().expect("works");
    let truth = planted(&folder);
    let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs/calibration/fixed-tip-sweep.mpf");
    let output = trunnion(&["machine", "compare", "mikron-ucp710", str(&truth), str(&program)]);
    let said = text(&output.stdout);
    assert_eq!(status(&output), 1, "{said}{}", text(&output.stderr));
    assert!(
        said.contains("axis A: point (0, 0, 0) versus (0, 0.05, 0) mm, 0.05 mm apart"),
        "{said}"
    );
    // 2 sin(45 deg) 0.05 mm at A90
    assert!(said.contains("tip off by up to 0.070711 mm"), "{said}");
    assert!(said.contains("fixed-tip-sweep.mpf:14, the worst of"), "{said}");
    assert!(said.contains("FAIL: the tip is off by more than 0.02 mm"), "{said}");
    // without a program, to the end of the travel: 2 sin(60 deg) 0.05 mm
    let output = trunnion(&["machine", "compare", "mikron-ucp710", str(&truth)]);
    let said = text(&output.stdout);
    assert!(
        status(&output) == 1 && said.contains("swept: tip off by up to 0.086603 mm"),
        "{said}"
    );
    let same = trunnion(&["machine", "compare", "mikron-ucp710", "mikron-ucp710", str(&program)]);
    assert_eq!(status(&same), 0, "{}", text(&same.stdout));
    assert!(
        text(&same.stdout).contains("PASS: the tip is off by at most 0 mm (proven); the tolerance is 0.02 mm"),
        "{}",
        text(&same.stdout)
    );
    let other = trunnion(&["machine", "compare", "mikron-ucp710", "ferrari-bc"]);
    assert!(
        status(&other) == 2 && text(&other.stderr).contains("different axes"),
        "{}",
        text(&other.stderr)
    );
}

/// The pivot of A 0.05 mm off costs up to 2 sin(60 deg) 0.05 = 0.0866 mm inside the travel: below that only a path that is known can pass.
#[test]
fn a_comparison_passes_only_where_it_is_proven() {
    let folder = TempDir::new().expect("works");
    let truth = planted(&folder);
    let compare = |tolerance: &str, program: Option<&str>| {
        let mut arguments = vec![
            "machine",
            "compare",
            "mikron-ucp710",
            str(&truth),
            "--tolerance-mm",
            tolerance,
        ];
        arguments.extend(program);
        let output = trunnion(&arguments);
        (
            status(&output),
            text(&output.stdout).lines().last().unwrap_or_default().to_owned(),
        )
    };
    let poses = compare("0.0867", None);
    assert_eq!(
        poses,
        (
            0,
            "PASS: the tip is off by at most 0.086603 mm (proven); the tolerance is 0.0867 mm".to_owned()
        )
    );
    // A turns by 30 deg: 2 sin(15 deg) 0.05 = 0.025882 mm, but the start of the first motion is unknown
    let text = "TRAORI\nG0 X0 Y0 Z50 A0 C0\nG1 X10 A30 F500\nG1 X0 A0\nM30\n";
    let program = write(&folder, "short.mpf", text);
    let (code, said) = compare("0.03", Some(str(&program)));
    assert!(
        code == 1
            && said.starts_with("UNKNOWN")
            && said.contains("1 motion compared at the end only: the start is unknown"),
        "{said}"
    );
    // what is not modelled is counted
    let lost = write(
        &folder,
        "lost.mpf",
        &text.replace("G1 X0 A0", "G1 X0 A=R5\nG1 X5 A0\nA10"),
    );
    let (code, said) = compare("0.03", Some(str(&lost)));
    assert!(
        code == 1 && said.contains("could not be compared: the end or the path is unknown"),
        "{said}"
    );
}

#[test]
fn a_contradicting_row_refuses_the_file_with_its_place() {
    let folder = TempDir::new().expect("works");
    let source = trunnion::machine::builtin_source("mikron-ucp710").expect("embedded");
    let (head, a) = source.split_once("letter = \"A\"").expect("A");
    let file = write(
        &folder,
        "ours.toml",
        &format!("{head}letter = \"A\"{}", a.replacen("sign = 1", "sign = -1", 1)),
    );
    let output = trunnion(&["machine", "show", str(&file)]);
    let said = text(&output.stderr);
    assert_eq!(status(&output), 2, "{said}");
    assert!(
        said.contains("ours.toml:") && said.contains("if the row is right, check sign"),
        "{said}"
    );
}

#[test]
fn an_ini_becomes_a_machine_file_that_says_what_is_open() {
    let folder = TempDir::new().expect("works");
    let text_of = "[KINS]\nKINEMATICS = xyzac-trt-kins\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = mm\nANGULAR_UNITS = deg\n[HAL]\nHALCMD = setp xyzac-trt-kins.y-offset 20\n";
    let ini = write(&folder, "own.ini", text_of);
    let made = folder.path().join("own.toml");
    let output = trunnion(&["machine", "import", str(&ini), "-o", str(&made), "--set", "z-offset=10"]);
    let said = text(&output.stderr);
    assert_eq!(status(&output), 0, "{said}");
    assert!(
        said.contains("open: pin x-rot-point: nothing in this file sets it; 0, the module's default, is assumed"),
        "{said}"
    );
    assert!(
        said.contains("open: axis X: MIN_LIMIT is missing and stays undeclared"),
        "{said}"
    );
    assert!(
        fs::read_to_string(&made)
            .expect("written")
            .contains("point = [0, 20, 10]")
    );
    assert_eq!(
        status(&trunnion(&["machine", "check", str(&made), "--poses", "500"])),
        0
    );
    let trivial = write(
        &folder,
        "trivial.ini",
        &text_of.replace("xyzac-trt-kins\n", "trivkins\n"),
    );
    let output = trunnion(&["machine", "import", str(&trivial)]);
    assert_eq!(status(&output), 1, "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("the machine file is not complete"),
        "{}",
        text(&output.stderr)
    );
    let broken = write(
        &folder,
        "broken.ini",
        "[KINS]\nKINEMATICS = notkins\n[TRAJ]\nCOORDINATES = XYZ\n",
    );
    let output = trunnion(&["machine", "import", str(&broken)]);
    let said = text(&output.stderr);
    assert!(
        status(&output) == 2 && said.contains("broken.ini:2:14") && said.contains("unknown"),
        "{said}"
    );
}

/// Two tools with declared lengths on a machine that declares where a tool change leaves its axes: nothing is unknown.
#[test]
fn a_program_with_two_tools_passes_where_everything_is_declared() {
    let folder = TempDir::new().expect("works");
    let program = "%
O1000
G21 G17 G40 G49 G80 G90 G94
T1 M6
G54 G0 X0. Y0. S3000 M3
G43 H1 Z50.
G1 Z-2. F200.
X50.
G0 Z50.
M5
G91 G28 Z0.
G90
T2 M6
G54 G0 X10. Y10. S3000 M3
G43 H2 Z50.
G1 Z-3. F200.
Y50.
G0 Z50.
M5
G91 G28 Z0.
G28 X0. Y0.
M30
%
";
    let file = write(&folder, "two.nc", program);
    let settings = "[work_offsets]\nG54 = { X = -300, Y = -200, Z = -300 }\n[[tool]]\nnumber = 1\nlength = 100\n[[tool]]\nnumber = 2\nlength = 120\n";
    write(&folder, "trunnion.toml", settings);
    let check = |machine: &str| {
        let output = trunnion(&["check", str(&file), "--machine", machine, "--format", "json"]);
        json(&output)["files"][0].clone()
    };
    for machine in ["mill-3axis", "gantry-mill"] {
        let found = check(machine);
        assert_eq!(found["verdict"], "pass", "{machine}: {}", found["diagnostics"]);
    }
    // a machine that does not declare it leaves X Y Z unknown
    let open = write(
        &folder,
        "open.toml",
        &std::fs::read_to_string("samples/machines/mill-3axis.toml")
            .expect("there")
            .replace("tool_change = { Z = 300 }\n", ""),
    );
    let found = check(str(&open));
    assert_eq!(found["verdict"], "unknown", "{}", found["diagnostics"]);
    assert_eq!(found["diagnostics"][0]["rule"], "position-unknown");
}
