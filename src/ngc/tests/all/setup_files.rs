//! INI files, tool tables and parameter files.
use trunnion_ngc::{Ini, Parameters, Setup, ToolTable};

#[test]
fn the_first_of_equal_keys_counts() {
    let ini = Ini::parse(b"# c\n[TRAJ]\nSPINDLES = 3\nSPINDLES = 2\n; x\n[RS274NGC]\nDISABLE_G92_PERSISTENCE=1\n");
    let setup = Setup {
        ini,
        ..Setup::default()
    };
    assert_eq!(
        (setup.spindles(), setup.g92_persists(), setup.random_tool_changer()),
        (3, false, false)
    );
}

#[test]
fn rows_of_a_tool_table_are_words_and_other_lines_are_told() {
    let (table, bad) = ToolTable::parse(b"T1 P7 Z-.5 D2 Q9 ;a\n; only a comment\nT2 K3\nfoo\nP9 Z1\n");
    assert_eq!(table.rows.len(), 2, "the P of the last line takes a row");
    let row = table.rows[0];
    assert_eq!(
        (row.number, row.pocket, row.offset[2], row.diameter, row.orientation),
        (1, 7, -0.5, 2.0, 9)
    );
    let lines: Vec<usize> = bad.iter().map(|bad| bad.line).collect();
    assert_eq!(lines, [3, 4, 5]);
}

/// Answers of rs274 to the same tables: `CHANGE_TOOL(row)`.
#[test]
fn each_pocket_word_of_a_tool_table_takes_a_row() {
    for (text, tool, row) in [
        ("T2 P2 Z1\nT7 P7 Z2\n", 7, 2),
        ("T2 P2 Z1\nT7 P7 Z2 P0.0\nT9 P9 Z3\n", 7, 3),
        ("T2 P2 Z1\nT7 P7 Z2 P0.0\nT9 P9 Z3 P0.0\n", 9, 5),
        ("P1 T2 Z1 P2 p3\nT7 P7 Z2\n", 2, 3),
        ("P2 P3\nT7 P7 Z2\n", 7, 3),
        ("K3 P2 P4 T2\nT7 P7 Z2\n", 7, 3),
        ("T2 Px P2\nT7 P7 Z2\n", 7, 2),
        ("T2 P2000 P1\nT7 P7 P-1 Z2\n", 7, 4),
        ("foo\nT5 P\nT7 P7 Z2\n", 7, 1),
    ] {
        let (table, _) = ToolTable::parse(text.as_bytes());
        let found = table.rows.iter().position(|entry| entry.number == tool);
        assert_eq!(found.map(|place| place + 1), Some(row), "{text}");
    }
}

/// Answers of rs274 to the same tables: the contents of row 0 as a run starts, `#5400` and `#5403`, and `CHANGE_TOOL(row)` of a tool.
#[test]
fn a_row_without_a_pocket_is_in_the_spindle() {
    for (text, first, tool, row) in [
        ("T1 P1 Z0.5\nT5 Z1.5\nT7 Z2.5\nT2 P2\n", (7, 2.5), 7, Some(0)),
        ("T1 P1 Z0.5\nT5 Z1.5\nT7 Z2.5\nT2 P2\n", (7, 2.5), 5, None),
        ("T1 P1 Z0.5\nT5 Z1.5\nT7 Z2.5\nT2 P2\n", (7, 2.5), 2, Some(2)),
        ("T5 Z1.5\nT5 P2 Z2\n", (5, 2.0), 5, Some(1)),
        ("T5 P2 Z2\nT5 Z1.5\n", (5, 1.5), 5, Some(1)),
        ("T1 P1 Z0.5\n", (0, 0.0), 1, Some(1)),
    ] {
        let setup = Setup {
            tools: ToolTable::parse(text.as_bytes()).0,
            ..Setup::default()
        };
        let source = format!("(debug,#5400 #5403)\nT{tool} M6\nM2\n");
        let listed = crate::listing::list_with(&source, &setup);
        let lines = listed.lines();
        let has = |line: String| assert!(lines.contains(&line), "{text}{line}: {lines:?}");
        has(format!("MESSAGE(\"{}.000000 {:.6}\")", first.0, first.1));
        match row {
            Some(row) => has(format!("CHANGE_TOOL({row})")),
            None => assert_eq!(listed.errors, ["Requested tool 5 not found in the tool table"]),
        }
    }
}

#[test]
fn a_parameter_file_is_in_order_and_in_range() {
    let parameters = Parameters::parse(b"5161\t1.5\nabc\n5220 2\n").unwrap();
    assert_eq!(parameters.values, [(5161, 1.5), (5220, 2.0)]);
    assert_eq!(parameters.text(), "5161\t1.500000\n5220\t2.000000\n");
    let order = Parameters::parse(b"5162 1\n5161 2\n").unwrap_err();
    assert_eq!((order.line, order.message.as_str()), (2, "Parameter file out of order"));
    let range = Parameters::parse(b"6000 1\n").unwrap_err();
    assert_eq!(
        (range.line, range.message.as_str()),
        (1, "Parameter number out of range")
    );
}

/// Answers of rs274 to the same INI files.
#[test]
fn an_ini_file_turns_m19_and_its_numbers_are_read_only() {
    let with = |ini: &str, source: &str| {
        let setup = Setup {
            ini: Ini::parse(ini.as_bytes()),
            ..Setup::default()
        };
        crate::listing::list_with(source, &setup)
    };
    for (offset, angles) in [
        ("90", ["100", "449", "90"]),
        ("-400.5", ["-390.5", "-41.5", "-400.5"]),
        ("90 ; x", ["10", "359", "0"]),
        ("1e2", ["110", "459", "100"]),
    ] {
        let listed = with(
            &format!("[RS274NGC]\nORIENT_OFFSET={offset}\n"),
            "M19 R10\nM19 R359 P1\nM19 P1\nM2\n",
        );
        let lines = listed.lines();
        for (angle, mode) in angles.iter().zip([0, 1, 1]) {
            let angle: f64 = angle.parse().expect("a number");
            let line = format!("ORIENT_SPINDLE(0, {angle:.4}, {mode})");
            assert!(lines.contains(&line), "{offset}: {line}: {lines:?}");
        }
    }
    let ini = "[TRAJ]\nSPINDLES=2\nNAME=abc\n";
    let listed = with(ini, "#<_ini[traj]spindles>=5\nM2\n");
    assert_eq!(
        listed.errors,
        ["Cannot assign to read-only parameter #<_ini[traj]spindles>"]
    );
    for free in ["#<_ini[traj]name>=5\nM2\n", "#<_ini[traj]nothing>=5\nM2\n"] {
        assert_eq!(with(ini, free).errors, [""; 0], "{free}");
    }
}
