//! What new users stumbled over: names that nothing defines, one slip of the pen, variables of the settings, places in called programs.
use super::tools::{json, status, str, text, trunnion, trunnion_in, write};
use serde_json::Value;
use tempfile::TempDir;

/// The findings of a program in JSON, without the remark that no machine is named.
fn found(folder: &TempDir, name: &str, program: &str, more: &[&str]) -> Vec<Value> {
    let file = write(folder, name, program);
    let output = json(&trunnion(&[&["check", "--format", "json", str(&file)], more].concat()));
    let all = output["files"][0]["diagnostics"].as_array().expect("findings").clone();
    all.into_iter()
        .filter(|found| found["rule"] != "machine-unset")
        .collect()
}

fn messages(found: &[Value]) -> Vec<&str> {
    found.iter().filter_map(|found| found["message"].as_str()).collect()
}

const SINUMERIK: &str = "G17 G71 G90 G94 G54\nT1 D1 M6\nS1000 M3\nG0 X0 Y0 Z50\n";

/// A name that is no word of a Sinumerik may be a misspelt word or a program that is missing: both are said, and the verdict stays unknown.
#[test]
fn a_bare_name_is_a_misspelt_word_or_a_missing_program() {
    let folder = TempDir::new().expect("works");
    let dialect = ["--dialect", "sinumerik-840d"];
    for (line, message) in [
        (
            "SPUA",
            "`SPUA` is no code of sinumerik-840d, and no program SPUA.SPF or .MPF was found; did you mean `SUPA`?",
        ),
        (
            "POCKET_LEFT(5,\"a\")",
            "`POCKET_LEFT(5,\"a\")` is no code of sinumerik-840d, and no program POCKET_LEFT.SPF or .MPF was found",
        ),
        (
            "G0 Z60 TRAROI",
            "`TRAROI` is no code of sinumerik-840d, and no program TRAROI.SPF or .MPF was found; did you mean `TRAORI`?",
        ),
    ] {
        let all = found(&folder, "a.mpf", &format!("{SINUMERIK}{line}\nM30\n"), &dialect);
        let own: Vec<&Value> = all.iter().filter(|found| found["rule"] == "not-modelled").collect();
        assert_eq!(own.len(), 1, "{all:?}");
        assert_eq!(
            (own[0]["message"].as_str(), own[0]["status"].as_str()),
            (Some(message), Some("unknown"))
        );
        let help = own[0]["help"].to_string();
        assert!(help.contains("subprogram_path"), "{help}");
    }
    // the program is there: it is followed
    write(&folder, "SPUA.SPF", "G0 Z40\nM17\n");
    let all = found(&folder, "a.mpf", &format!("{SINUMERIK}SPUA\nM30\n"), &dialect);
    assert!(all.iter().all(|found| found["rule"] != "not-modelled"), "{all:?}");
    // an Okuma has no programs of a bare name
    let all = found(&folder, "a.min", "G0 X0 Z0\nKONTUR\nM30\n", &["--dialect", "okuma-osp"]);
    assert!(messages(&all).contains(&"`KONTUR` is no code of okuma-osp"), "{all:?}");
}

/// A letter O in the number behind `=` is one cause.
#[test]
fn a_letter_o_behind_an_equals_sign_is_one_finding() {
    let folder = TempDir::new().expect("works");
    for (line, message) in [
        (
            "G1 X10 F=200O",
            "`F=200O` contains the letter O; did you mean `F=2000`?",
        ),
        (
            "G1 X=1O Y=-2.O F500",
            "`X=1O` contains the letter O; did you mean `X=10`?",
        ),
        ("R5=3O", "`R5=3O` contains the letter O; did you mean `R5=30`?"),
    ] {
        let program = format!("{SINUMERIK}{line}\nG0 Z60\nM30\n");
        let all = found(&folder, "a.mpf", &program, &["--dialect", "sinumerik-840d"]);
        let here = all.into_iter().filter(|found| found["line"] == 5).collect::<Vec<_>>();
        let here = messages(&here);
        let slips = here.iter().filter(|said| said.contains("the letter O")).count();
        assert_eq!(here.len(), slips, "{line}: {here:?}");
        assert!(here.contains(&message), "{line}: {here:?}");
    }
}

/// What `[variables]` declares is known in the programs of its control, and a finding says what to write there.
#[test]
fn a_declared_variable_is_known_in_its_language() {
    for (name, dialect, declared, program) in [
        (
            "a.mpf",
            "sinumerik-840d",
            "R1 = 12.5",
            format!("{SINUMERIK}G0 X=R1\nM30\n"),
        ),
        (
            "a.h",
            "heidenhain-klartext",
            "Q5 = 12.5",
            "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S900\n2 L X+Q5 Y+0 Z+50 R0 FMAX M3\n3 M30\n4 END PGM A MM\n".to_owned(),
        ),
        (
            "a.h",
            "heidenhain-klartext",
            "QR5 = 12.5",
            "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S900\n2 L X+QR5 Y+0 Z+50 R0 FMAX M3\n3 M30\n4 END PGM A MM\n".to_owned(),
        ),
        (
            "a.min",
            "okuma-osp",
            "VC1 = 12.5",
            "G15 H1\nG0 X=VC1 Y0 Z50\nM2\n".to_owned(),
        ),
        (
            "a.nc",
            "fanuc-30i",
            "\"#500\" = 12.5",
            "%\nO1\nG21 G17 G90 G94 G54\nG0 X#500 Y0. Z50.\nM30\n%\n".to_owned(),
        ),
    ] {
        let folder = TempDir::new().expect("works");
        let more = ["--dialect", dialect];
        let ends = || {
            let file = write(&folder, name, &program);
            let machine = ["--machine", "mill-3axis", "--assume", "work-offset,tool-length"];
            text(&trunnion(&[&["trace", str(&file), "--dialect", dialect][..], &machine].concat()).stdout)
        };
        let without = found(&folder, name, &program, &more);
        let asked = without
            .iter()
            .any(|found| found["help"].to_string().replace('\\', "").contains(declared));
        assert!(asked, "{name} {declared}: {without:?}");
        assert!(!ends().contains("12.5"), "{name}: {}", ends());
        write(&folder, "trunnion.toml", &format!("[variables]\n{declared}\n"));
        let with = found(&folder, name, &program, &more);
        assert!(with.len() < without.len(), "{name} {declared}: {with:?}");
        assert!(
            with.iter()
                .all(|found| found["status"] != "unknown" || !found["message"].to_string().contains("not modelled")),
            "{with:?}"
        );
        assert!(ends().contains("12.5"), "{name}: {}", ends());
    }
    // a global name of LinuxCNC: an error without a value
    let folder = TempDir::new().expect("works");
    let program = "G21 G17 G90 G94 G54\nG0 X#<_depth> Y0 Z50\nM2\n";
    let without = found(&folder, "a.ngc", program, &["--dialect", "linuxcnc"]);
    assert!(without.iter().any(|found| found["severity"] == "error"), "{without:?}");
    write(&folder, "trunnion.toml", "[variables]\n\"#<_Depth>\" = 12.5\n");
    let with = found(&folder, "a.ngc", program, &["--dialect", "linuxcnc"]);
    assert!(with.iter().all(|found| found["severity"] != "error"), "{with:?}");
}

/// A finding about a line of a called program shows that line, in every language, also where the kind of finding has no text for it.
#[test]
fn a_finding_in_a_called_program_shows_its_line() {
    for (dialect, main, sub, line) in [
        (
            "heidenhain-klartext",
            (
                "MAIN.H",
                "0 BEGIN PGM MAIN MM\n1 TOOL CALL 1 Z S900\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CALL PGM SUB\n4 M30\n5 END PGM MAIN MM\n",
            ),
            ("SUB.H", "0 BEGIN PGM SUB MM\n1 L X+10 R0\n2 END PGM SUB MM\n"),
            "SUB.H line 2: 1 L X+10 R0",
        ),
        (
            "heidenhain-klartext",
            (
                "MAIN.H",
                "0 BEGIN PGM MAIN MM\n1 TOOL CALL 1 Z S900\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CALL PGM 100.H\n4 M30\n5 END PGM MAIN MM\n",
            ),
            ("100.h", "0 BEGIN PGM 100 MM\n1 L X+10 R0\n2 END PGM 100 MM\n"),
            "100.h line 2: 1 L X+10 R0",
        ),
        (
            "fanuc-30i",
            (
                "O1.nc",
                "%\nO1\nG21 G17 G90 G94 G54\nM3 S900\nG0 X0. Y0. Z5.\nM98 P2\nM30\n%\n",
            ),
            ("O0002.nc", "O2\nG1 X9.\nM99\n"),
            "O0002.nc line 2: G1 X9.",
        ),
        (
            "sinumerik-840d",
            ("a.mpf", "G17 G71 G90 G94 G54\nS900 M3\nG0 X0 Y0 Z5\nSUB\nM30\n"),
            ("SUB.SPF", "G1 X9\nM17\n"),
            "SUB.SPF line 1: G1 X9",
        ),
    ] {
        let folder = TempDir::new().expect("works");
        write(&folder, sub.0, sub.1);
        let all = found(&folder, main.0, main.1, &["--dialect", dialect]);
        let feed = all
            .iter()
            .find(|found| found["rule"] == "missing-feed")
            .unwrap_or_else(|| panic!("{all:?}"));
        let notes = feed["notes"].as_array().expect("notes");
        let placed = notes
            .iter()
            .filter_map(Value::as_str)
            .any(|note| note.starts_with("in ") && note.ends_with(line));
        assert!(placed, "{dialect}: {feed}");
    }
}

/// Settings and machine files: the table, the key, what it must be, and a line that is right, with the place in the file.
#[test]
fn a_wrong_key_or_value_gets_a_line_that_is_right() {
    let folder = TempDir::new().expect("works");
    write(&folder, "a.nc", "G0 X1.\nM30\n");
    for (settings, said) in [
        (
            "# tools\n[[tool]]\ndiameter = 6\n",
            "trunnion.toml:2:1: [[tool]] lacks `number` (Number of the tool, each once): add `number = 1`",
        ),
        (
            "[work_offsets]\nG54 = [0, 0, -3.5]\n",
            "trunnion.toml:2:7: `G54` in [work_offsets] must be a table: `G54 = { X = 0, Y = 0, Z = -3.5 }`",
        ),
        (
            "[limits]\n\ntip = 0.1\n",
            "trunnion.toml:3:1: unknown key `tip` in [limits]: it belongs in [tolerances]",
        ),
        (
            "[work_offsets]\nG54 = { X = 0 }\n\n[work_offsets]\nG55 = { X = 0 }\n",
            "trunnion.toml:4:2: `work_offsets` is declared twice: keep one of them, with all that belongs to it",
        ),
        (
            "[work_offsets]\nG54 = { X = 0 }\nG54 = { X = 1 }\n",
            "trunnion.toml:3:1: `G54` is declared twice",
        ),
        (
            "dialect = \"sinumerik-840d\"\n[variables]\n\"#500\" = 1\n",
            "trunnion.toml:3:1: `#500` is no variable of sinumerik-840d that can be declared: write `R1 = 12.5`",
        ),
    ] {
        write(&folder, "trunnion.toml", settings);
        let output = trunnion_in(folder.path(), &["check", "a.nc"]);
        assert_eq!(status(&output), 2, "{settings}");
        assert!(
            text(&output.stderr).contains(said),
            "{settings}: {}",
            text(&output.stderr)
        );
    }
    std::fs::remove_file(folder.path().join("trunnion.toml")).expect("there");
    for (machine, said) in [
        (
            "name = \"x\"\n",
            "lacks `schema` (Version of this format: \"ncmachine/1\"): add `schema = \"ncmachine/1\"`",
        ),
        (
            "schema = \"ncmachine/1\"\n[[axis]]\nsign = 1\n",
            "m.toml:2:1: [[axis]] lacks `letter` (Upper-case letter: X Y Z A B C U V W, each once): add `letter = \"X\"`",
        ),
        (
            "schema = \"ncmachine/1\"\n[[axis]]\nletter = \"X\"\nsign = 1\ndyn = { vmax = \"500\" }\n",
            "m.toml:5:16: `vmax` in [[axis]] dyn must be a number (Highest speed, mm/s or deg/s): `vmax = 500`",
        ),
    ] {
        write(&folder, "m.toml", machine);
        let output = trunnion_in(folder.path(), &["check", "a.nc", "--machine", "m.toml"]);
        assert!(
            text(&output.stderr).contains(said),
            "{machine}: {}",
            text(&output.stderr)
        );
    }
}
