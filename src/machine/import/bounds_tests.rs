//! INI files with more of something than any machine has.
use crate::import_linuxcnc;

fn ini(coordinates: &str, arguments: &str, more: &str) -> String {
    format!(
        "[KINS]\nKINEMATICS = trivkins {arguments}\n[TRAJ]\nCOORDINATES = {coordinates}\nLINEAR_UNITS = mm\nANGULAR_UNITS = deg\n{more}"
    )
}

/// The letters of joints that cannot exist were compared with one another.
#[test]
fn there_are_no_more_letters_than_joints() {
    let open = |text: &str| import_linuxcnc("m.ini", text, &[]).map(|imported| imported.open);
    assert!(open(&ini("XYYZ", "", "")).is_ok());
    assert!(open(&ini("XYZABCUVWXYZABCU", "", "")).is_ok());
    for (text, at) in [
        (ini("XYZABCUVWXYZABCUV", "", ""), "XYZABCUVWXYZABCUV"),
        (
            ini("XYZ", "coordinates=xyzabcuvwxyzabcuv", ""),
            "trivkins coordinates=xyzabcuvwxyzabcuv",
        ),
    ] {
        let error = open(&text).expect_err("too many");
        assert!(error.message.contains("has 17 letters"), "{error}");
        assert!(error.message.contains("at most 16 joints"), "{error}");
        assert_eq!(text[error.span.expect("a place")].trim(), at);
    }
    let error = open(&ini(&"X Y Z ".repeat(1_000_000), "", "")).expect_err("too many");
    assert!(
        error.message.starts_with("[TRAJ] COORDINATES has 3000000 letters"),
        "{error}"
    );
    let error = open(&ini("XYZ", &format!("coordinates={}", "xyz".repeat(1_000_000)), "")).expect_err("too many");
    assert!(error.message.starts_with("coordinates= has 3000000 letters"), "{error}");
    let error = open(&ini("XYZ", "coordinates=xyq", "")).expect_err("no axis");
    assert!(error.message.starts_with("coordinates= must name the axes"), "{error}");
}

#[test]
fn files_that_are_not_read_are_named_up_to_ten() {
    let includes = |count: usize| {
        let text = ini("XYZ", "", &"#INCLUDE other.inc\n".repeat(count));
        let open = import_linuxcnc("m.ini", &text, &[]).expect("an INI file").open;
        let told = open.into_iter().filter(|line| line.starts_with("#INCLUDE"));
        told.collect::<Vec<_>>()
    };
    assert_eq!(includes(10).len(), 10);
    let told = includes(300_000);
    assert_eq!(told.len(), 11);
    assert_eq!(
        told[10],
        "#INCLUDE: 299990 more lines, not read; their contents are missing here"
    );
}

/// The whole file was one line, and what it says was not found.
#[test]
fn a_line_that_ends_in_cr_alone_is_refused_by_name() {
    let sound = ini("XYZ", "", "");
    assert!(import_linuxcnc("m.ini", &sound.replace('\n', "\r\n"), &[]).is_ok());
    let text = sound.replace('\n', "\r");
    let error = import_linuxcnc("m.ini", &text, &[]).expect_err("refused");
    assert!(error.message.contains("CR alone"), "{error}");
    assert_eq!(error.span, Some(6..7));
    let text = sound.replacen("XYZ\n", "XYZ\r", 1);
    assert!(import_linuxcnc("m.ini", &text, &[]).is_err());
}
