//! Which dialect is found for a file.
use crate::{Detected, builtin, detect, is_program_file_name, program_extensions};
use std::path::{Path, PathBuf};

pub(super) fn named(name: Option<&str>, text: &str, family: Option<&str>) -> (String, String) {
    let Detected { dialect, reason, .. } = detect(name, text.as_bytes(), family);
    (dialect.name.clone(), reason)
}

pub(super) fn content(text: &str) -> (String, String) {
    named(None, text, None)
}

fn is(found: &(String, String), dialect: &str, reason: &str) {
    assert_eq!((found.0.as_str(), found.1.as_str()), (dialect, reason));
}

#[test]
fn a_modeline_wins() {
    let said = "modeline comment in the program";
    is(
        &named(Some("a.mpf"), "%\n(trunnion: dialect fanuc-30i)\n", Some("linuxcnc")),
        "fanuc-30i",
        said,
    );
    is(&content("; Trunnion:  dialect  LinuxCNC\r\nG0"), "linuxcnc", said);
    is(
        &content("N10 G0 X1 ;trunnion:dialect sinumerik-840d"),
        "sinumerik-840d",
        said,
    );
    is(&content("$$ trunnion: dialect apt\n"), "apt", said);
    let late = format!("{}; trunnion: dialect apt\n", "\n".repeat(10));
    assert_eq!(content(&late).0, "iso-6983", "line 11 is too late");
    assert_eq!(content(&late[1..]).0, "apt");
    for unknown in [
        "(trunnion: dialect klartext)",
        "(trunnion: dialect)",
        "(trunnion: dialectapt)",
        "(trunnion: tool 1 ball diameter 10)",
    ] {
        assert_eq!(
            named(Some("a.ngc"), unknown, None).1,
            "file extension .ngc",
            "{unknown}"
        );
    }
}

#[test]
fn then_the_extension() {
    for (name, dialect) in [
        ("A.MPF", "sinumerik-840d"),
        ("dir.nc/sub.spf", "sinumerik-840d"),
        ("x.arc", "sinumerik-840d"),
        ("x.Ngc", "linuxcnc"),
        ("x.apt", "apt"),
        ("x.cls", "apt"),
        ("x.ncl", "apt"),
        ("x.ncl.1", "apt"),
        ("C:\\jobs\\x.ncl.18", "apt"),
        ("x.cldata", "apt"),
        ("x.cl", "apt"),
    ] {
        assert_eq!(named(Some(name), "G0 X1", Some("fanuc-30i")).0, dialect, "{name}");
    }
}

#[test]
fn then_the_content_then_the_machine() {
    for name in ["a.nc", "a.tap", "a.txt", "a.gcode", "a", "a.", "", "a.7", "a.unheard"] {
        let name = Some(name);
        let family = "the machine's control family sinumerik-840d";
        is(&named(name, "G0 X1", Some("sinumerik-840d")), "sinumerik-840d", family);
        is(
            &named(name, "G43.4 H1", Some("sinumerik-840d")),
            "fanuc-30i",
            "content: G43.4 on line 1",
        );
        is(
            &named(name, "G0 X1", Some("generic")),
            "iso-6983",
            "nothing in the file points to a particular control",
        );
        is(
            &named(name, "G0 X1", None),
            "iso-6983",
            "nothing in the file points to a particular control",
        );
    }
}

#[test]
fn signs_in_the_content() {
    is(&content("%_N_PART_MPF\n"), "sinumerik-840d", "content: %_N_ on line 1");
    is(
        &content("G0 X1\nTRAORI\n"),
        "sinumerik-840d",
        "content: TRAORI on line 2",
    );
    is(
        &content("R1=5\nX=R1\n"),
        "sinumerik-840d",
        "content: a word with `=` on line 1",
    );
    is(
        &content("; roughing\nG1 X1 ; cut\n"),
        "iso-6983",
        "nothing in the file points to a particular control",
    );
    is(
        &content("G1 X1 (CIRCLE DIAMOND) ; TRAORI\nM5(R1=2)\n"),
        "iso-6983",
        "nothing in the file points to a particular control",
    );
    is(
        &content("N10G54G710DIAMON\n"),
        "sinumerik-840d",
        "content: G710 on line 1",
    );
    is(
        &content("%\nO0001 (PART)\nG0 X1\n"),
        "fanuc-30i",
        "content: a program number O on line 2",
    );
    is(
        &content("#1=5\nWHILE[#1 LT 9]DO1\nEND1\n"),
        "fanuc-30i",
        "content: custom macro on line 2",
    );
    is(&content("o100 sub\n"), "linuxcnc", "content: an O-word on line 1");
    is(
        &content("o<move> call [1]\n"),
        "linuxcnc",
        "content: an O-word on line 1",
    );
    is(&content("G0 X#<x>\n"), "linuxcnc", "content: #< on line 1");
    is(
        &content("; note\no1 if [#1 GT 0]\n"),
        "linuxcnc",
        "content: an O-word on line 2",
    );
    is(
        &content("PARTNO / A\nGOTO / 1,2,3\n"),
        "apt",
        "content: PARTNO on line 1",
    );
    is(&content("$$ remark\n"), "apt", "content: a `$$` comment on line 1");
    is(
        &content("(TRAORI and R1=5)\nG0 X1\n"),
        "iso-6983",
        "nothing in the file points to a particular control",
    );
    is(
        &content("/* Start */\nN0G5M3\n"),
        "iso-6983",
        "nothing in the file points to a particular control",
    );
    is(
        &content(""),
        "iso-6983",
        "nothing in the file points to a particular control",
    );
    is(
        &content("N10 GOTO 20\n"),
        "iso-6983",
        "nothing in the file points to a particular control",
    );
}

#[test]
fn signs_of_haas_grbl_and_lathes() {
    is(
        &content("%\nO00010\nG00 G90 G154 P3 X0\n"),
        "haas-ngc",
        "content: G154 on line 3",
    );
    is(&content("G187 P3 E0.01\n"), "haas-ngc", "content: G187 on line 1");
    is(&content("M97 P1000 L3\n"), "haas-ngc", "content: M97 on line 1");
    is(
        &content("G13 I1.0 K5. Q1.0 F30. D1\n"),
        "haas-ngc",
        "content: a circular pocket G12 or G13 on line 1",
    );
    is(&content("$H\nG0 X1\n"), "grbl", "content: $H on line 1");
    is(&content("$X (unlock)\n"), "grbl", "content: $X on line 1");
    is(
        &content("%\nO0001\nG50 S2000\nG96 S180 M3\n"),
        "fanuc-30i-lathe-a",
        "content: G50 S on line 3",
    );
    is(
        &content("G28 U0. W0.\n"),
        "fanuc-30i-lathe-a",
        "content: G28 U or W on line 1",
    );
    is(
        &content("G71 U2. R0.5\nG71 P10 Q20 U0.4 W0.1 F0.25\n"),
        "fanuc-30i-lathe-a",
        "content: the turning cycle G71 on line 1",
    );
    // a comment that names the Fanuc outweighs a habit of a Haas, and not a code of a Haas
    let named = "%\nO12345 (MACHINE: FANUC 0I)\nG0 X1. Y2.\n";
    assert_eq!(content(named).0, "fanuc-30i");
    assert_eq!(content(&named.replace("G0 X1.", "G154 P3 G0 X1.")).0, "haas-ngc");
    // a mill's codes are no signs of a lathe
    assert_eq!(
        content("%\nO0001\nG91 G28 X0. Y0.\nG73 X1. Z-3. R1. Q1. F100.\n").0,
        "fanuc-30i"
    );
    assert_eq!(content("G71\nG54 G0 X1\n").0, "iso-6983");
}

#[test]
fn klartext_is_told_by_its_blocks() {
    for text in [
        "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 FMAX\n2 END PGM A MM\n",
        "FN 18: SYSREAD Q1 = ID20 NR1\nLBL 1\nL X+5 FMAX\n",
    ] {
        let detected = detect(None, text.as_bytes(), None);
        assert_eq!(
            (detected.dialect.name.as_str(), detected.foreign),
            ("heidenhain-klartext", None),
            "{text}"
        );
    }
}

#[test]
fn program_numbers_of_all_lengths() {
    for number in ["O1", "O12", "O0100", "O12345678", ":1234", "O<NAME>"] {
        assert_eq!(
            content(&format!("%\n{number}\nG0 X1.\nM30\n")).0,
            "fanuc-30i",
            "{number}"
        );
    }
    assert_eq!(content("%\nO01001\nG0 X1.\nM30\n").0, "haas-ngc");
    // a hint tells brands apart, nothing else
    assert_eq!(content("G53 G0 Z0.\nG53 G0 X0.\nG1 X5 F9\n").0, "iso-6983");
    assert_eq!(content("O1031\nG53 G0 Z0.\nG53 G0 X0.\n").0, "haas-ngc");
    let no_digits = content("%\nO100\nN G21 G90\nN M3 S100\nN G0 X1. Y1.\nN G1 X2. F100.\nN M30\n%\n");
    assert_eq!(no_digits.0, "fanuc-30i");
    assert_eq!(content("G21\rO1234\rM30\r").1, "content: a program number O on line 2");
}

#[test]
fn names_of_program_files() {
    for name in ["a.nc", "a.MPF", "b.ngc", "c.apt", "c.ncl.3", "a.h"] {
        assert!(is_program_file_name(name), "{name}");
    }
    for name in ["a.txt", "a.md", "nc", "", ".", "a.toml", "a.hpp"] {
        assert!(!is_program_file_name(name), "{name}");
    }
    assert!(program_extensions().contains(&"tap"));
}

proptest::proptest! {
    #[test]
    fn any_bytes_have_a_dialect(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..300), name in "\\PC{0,12}") {
        let found = detect(Some(&name), &bytes, None);
        proptest::prop_assert!(builtin(&found.dialect.name).is_some() && !found.reason.is_empty());
    }
}

fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files_below(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// Real programs of known origin.
#[test]
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn programs_of_known_origin() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    if !data.is_dir() {
        eprintln!("skipped: no test data at {}", data.display());
        return;
    }
    let folders = [
        ("sinumerik", "sinumerik-840d"),
        ("four-controls/siemens", "sinumerik-840d"),
        ("four-controls/fanuc", "fanuc-30i"),
        ("linuxcnc-interp", "linuxcnc"),
        ("linuxcnc-5axis", "linuxcnc"),
        ("macro", "linuxcnc"),
        ("apt", "apt"),
        ("guide-vane-2006", "by-name"),
        ("five-axis-pairs", "by-name"),
        ("pocket-1999", "iso-6983"),
    ];
    let (mut seen, mut right, mut wrong) = (0, 0, Vec::new());
    for (folder, dialect) in folders {
        let mut files = Vec::new();
        files_below(&data.join(folder), &mut files);
        for path in files {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
            if !is_program_file_name(&name) {
                continue;
            }
            let expected = match (extension.to_str().unwrap(), dialect) {
                ("mpf" | "spf", _) => "sinumerik-840d",
                ("h", _) => "heidenhain-klartext",
                ("apt", "by-name") => "apt",
                (_, "by-name") => "fanuc-30i",
                (_, other) => other,
            };
            let text = std::fs::read(&path).unwrap();
            let found = detect(Some(&name), &text, None);
            assert_eq!(found.dialect.name, expected, "{} by {}", path.display(), found.reason);
            // by content alone; a program that shows no sign of its control is no error
            let alone = detect(None, &text, None);
            let silent = alone.reason == "nothing in the file points to a particular control";
            if alone.dialect.name == expected {
                right += 1;
            } else if !silent {
                wrong.push(format!("{} by {}", path.display(), alone.reason));
            }
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen} files");
    eprintln!(
        "by content alone: {right} of {seen} right, {} wrong: {wrong:#?}",
        wrong.len()
    );
}

/// G110 and G111 are work offsets of a Haas, and poles of a Sinumerik, which has AP= and RP= after them.
#[test]
fn poles_are_those_of_a_sinumerik() {
    let poles = "G17 G90 G54 G71\nG0 X0 Y0 Z50\nG111 X10 Y10\nG1 AP=30 RP=20 F100\nG110 X5 Y0\nG1 AP=30 RP=20\nM30\n";
    for name in [None, Some("a.mpf")] {
        assert_eq!(named(name, poles, None).0, "sinumerik-840d");
    }
    assert_eq!(content("%\nO1\nG110 X0. Y0.\nG111 X0. Y0.\nM30\n").0, "haas-ngc");
}
