//! Importers: the INI files of LinuxCNC and Pocket NC beside the repository give the shipped machines; own FreeCAD machines; hostile files.
use crate::kinematics::selftest::SplitMix;
use crate::{Comparison, Machine, builtin, import_freecad, import_linuxcnc, load};
use std::fs;
use std::path::Path;

/// A file beside the repository, or a visible skip.
#[expect(clippy::print_stderr, reason = "a skipped test must be seen")]
fn shared(path: &str) -> Option<String> {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(path);
    let text = fs::read_to_string(&whole).ok();
    if text.is_none() {
        eprintln!("skipped: {path} is not beside the repository");
    }
    text
}

fn set(pins: &[(&str, f64)]) -> Vec<(String, f64)> {
    pins.iter().map(|(pin, value)| ((*pin).to_owned(), *value)).collect()
}

/// The imported machine does what the shipped one does, with the same travels and speeds.
fn assert_same(imported: &Machine, shipped: &str) {
    let shipped = builtin(shipped).expect("shipped");
    let comparison = Comparison::new(shipped, imported).expect("the same axes");
    let entries: Vec<String> = comparison
        .entries()
        .into_iter()
        .filter(|entry| !entry.contains(": side "))
        .collect();
    assert_eq!(entries, Vec::<String>::new(), "{}", shipped.id);
    let worst = comparison.random_poses(2000, 7).expect("poses");
    assert!(worst.tip_mm < 1e-9 && worst.axis < 1e-12, "{}: {worst:?}", shipped.id);
}

#[test]
fn the_tilting_tables_import_whole() {
    for (file, shipped) in [("xyzac-trt", "linuxcnc-xyzac-trt"), ("xyzbc-trt", "linuxcnc-xyzbc-trt")] {
        let Some(text) = shared(&format!("linuxcnc-5axis/{file}.ini")) else {
            return;
        };
        let imported = import_linuxcnc("test.ini", &text, &[]).expect("an INI file");
        let machine = load("imported", &imported.toml).unwrap_or_else(|error| panic!("{error}\n{}", imported.toml));
        assert_same(&machine, shipped);
        assert!(machine.control.tcp_declared && machine.control.family == "linuxcnc");
        // of the offsets nothing is open
        assert!(
            !imported.open.iter().any(|line| line.starts_with("pin ")),
            "{:?}",
            imported.open
        );
        // the other convention, from the command line
        let other = import_linuxcnc("test.ini", &text, &set(&[("conventional-directions", 1.0)])).expect("valid");
        assert_same(
            &load("other", &other.toml).expect("valid"),
            &format!("{shipped}-conventional"),
        );
    }
}

#[test]
fn nutating_heads_leave_their_offsets_open_until_they_are_given() {
    type Row = (&'static str, &'static str, [(&'static str, f64); 5]);
    let rows: [Row; 2] = [
        (
            "xyzacb-trsrn",
            "linuxcnc-xyzacb-trsrn",
            [
                ("nut-angle", 55.0),
                ("y-pivot", 50.0),
                ("z-pivot", 120.0),
                ("y-rot-axis", -1000.0),
                ("z-rot-axis", -2000.0),
            ],
        ),
        (
            "xyzbca-trsrn",
            "linuxcnc-xyzbca-trsrn",
            [
                ("nut-angle", 55.0),
                ("x-pivot", 50.0),
                ("z-pivot", 120.0),
                ("x-rot-axis", 1000.0),
                ("z-rot-axis", -2000.0),
            ],
        ),
    ];
    for (file, shipped, pins) in rows {
        let Some(text) = shared(&format!("linuxcnc-5axis/{file}.ini")) else {
            return;
        };
        let open = import_linuxcnc("test.ini", &text, &[]).expect("an INI file");
        for (pin, _) in pins {
            let start = format!("pin {pin}: its value comes from a panel");
            assert!(
                open.open.iter().any(|line| line.starts_with(&start)),
                "{pin}: {:?}",
                open.open
            );
        }
        let refused = load("open", &open.toml).expect_err("the chain is not known");
        assert!(refused.message.contains("unknown"), "{refused}");
        let mut given = set(&pins);
        given.extend(set(&[("x-offset", 0.0), ("y-offset", 0.0)]));
        let whole = import_linuxcnc("test.ini", &text, &given).expect("valid");
        assert_same(
            &load("whole", &whole.toml).unwrap_or_else(|error| panic!("{error}\n{}", whole.toml)),
            shipped,
        );
    }
}

#[test]
fn a_machine_of_trivial_kinematics_keeps_its_rotary_axes_open() {
    for (file, travel) in [("v2revP", [-50.8, 64.77]), ("v2revR", [-50.8254, 64.7954])] {
        let Some(text) = shared(&format!("pocketnc/{file}/PocketNC.ini")) else {
            return;
        };
        let imported = import_linuxcnc("PocketNC.ini", &text, &[]).expect("an INI file");
        let refused = load("open", &imported.toml).expect_err("nothing says where A and B are");
        assert!(
            refused.message.contains("`order` of this machine is unknown"),
            "{refused}"
        );
        for letter in ["A", "B"] {
            let start = format!("axis {letter}: side, dir, point, sign unknown");
            assert!(
                imported.open.iter().any(|line| line.starts_with(&start)),
                "{:?}",
                imported.open
            );
        }
        // filled in by hand: inches became mm
        let filled = imported.toml.replace("unknown = [\"order\"]\n", "").replace(
            "unknown = [\"side\", \"dir\", \"point\", \"sign\"]\n",
            "side = \"table\"\nsign = -1\n",
        );
        let (head, axes) = filled.split_once("[[axis]]\nletter = \"A\"").expect("A");
        let (a, rest) = axes.split_once("[[axis]]\nletter = \"B\"").expect("B");
        let (b, rest) = rest.split_once("[[axis]]\nletter = \"X\"").expect("X");
        let text =
            format!("{head}[[axis]]\nletter = \"B\"{b}[[axis]]\nletter = \"A\"{a}[[axis]]\nletter = \"X\"{rest}");
        let machine = load("filled", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let x = &machine.axes[machine.joint(b'X').expect("X")];
        let crate::Limits::Range(low, high) = x.limits else {
            panic!("no travel")
        };
        assert!(
            (low - travel[0]).abs() < 1e-9 && (high - travel[1]).abs() < 1e-9,
            "{low} {high}"
        );
        assert!((x.max_speed.expect("declared") - 25.4).abs() < 1e-9);
        if file == "v2revP" {
            assert_same(&machine, "pocketnc-v2revp");
        }
    }
}

/// An own small configuration; the bridge mill with a second Y joint, a pivot from a section, and nothing for W.
const BRIDGE: &str = "# own\n[EMC]\nMACHINE = small \"bridge\"\n[KINS]\nKINEMATICS = 5axiskins coordinates=xyzbcwy\n[MINE]\nPIVOT = 120\n[HAL]\nHALCMD = setp 5axiskins.pivot-length [MINE]PIVOT\n[TRAJ]\nCOORDINATES = XYZBCWY\nLINEAR_UNITS = inch\nANGULAR_UNITS = deg\n[AXIS_X]\nMIN_LIMIT = -10\nMAX_LIMIT = 10\nMAX_VELOCITY = 2\nMAX_ACCELERATION = 20\n[JOINT_0]\nMIN_LIMIT = -9\nMAX_LIMIT = 11\n";

#[test]
fn an_own_configuration() {
    let imported = import_linuxcnc("small.ini", BRIDGE, &[]).expect("an INI file");
    let machine = load("small", &imported.toml).unwrap_or_else(|error| panic!("{error}\n{}", imported.toml));
    assert_eq!(machine.name, "small \"bridge\"");
    let letters: String = machine.axes.iter().map(|axis| char::from(axis.letter)).collect();
    assert_eq!(letters, "XYZCBW");
    assert_eq!((machine.gantries[0].letter, machine.gantries[0].leader), (b'V', b'Y'));
    assert_eq!(machine.axes[3].point.z, 120.0);
    let crate::Limits::Range(low, high) = machine.axes[0].limits else {
        panic!("no travel")
    };
    assert!(
        (low + 9.0 * 25.4).abs() < 1e-9 && (high - 254.0).abs() < 1e-9,
        "{low} {high}"
    );
    assert!(
        imported
            .open
            .contains(&"axis W: MIN_LIMIT is missing and stays undeclared".to_owned())
    );
}

#[test]
fn what_is_wrong_with_an_ini_is_named_and_located() {
    for (from, to, at, message) in [
        (
            "5axiskins coordinates",
            "6axiskins coordinates",
            "6axiskins coordinates=xyzbcwy",
            "6axiskins\"; known modules: trivkins",
        ),
        ("LINEAR_UNITS = inch", "LINEAR_UNITS = ell", "ell", "not a known unit"),
        (
            "MIN_LIMIT = -10",
            "MIN_LIMIT = ten",
            "ten",
            "MIN_LIMIT = \"ten\" of [AXIS_X] is not a number",
        ),
        ("[TRAJ]", "[TRAJ", "[TRAJ", "closing bracket"),
        ("PIVOT = 120", "PIVOT 120", "PIVOT 120", "expected [SECTION]"),
        (
            "[MINE]PIVOT",
            "long",
            "setp 5axiskins.pivot-length long",
            "\"long\" is not a number",
        ),
    ] {
        let text = BRIDGE.replacen(from, to, 1);
        let error = import_linuxcnc("small.ini", &text, &[]).expect_err(message);
        assert!(error.message.contains(message), "{error}");
        assert_eq!(&text[error.span.clone().expect("a place")], at, "{error}");
    }
    let missing = import_linuxcnc("small.ini", "[TRAJ]\nCOORDINATES = XYZ\n", &[]).expect_err("no module");
    assert!(missing.message.contains("[KINS] KINEMATICS is missing"), "{missing}");
}

#[test]
fn a_message_quotes_the_beginning_of_a_long_text() {
    let long = "a".repeat(100_000);
    let kins = format!("[TRAJ]\nCOORDINATES = X Y Z\n[KINS]\nKINEMATICS = {long}\n");
    let fcm = format!("{{\"machine\": {{\"units\": \"metric\", \"axes\": {{\"X\": {{\"type\": \"{long}\"}}}}}}}}");
    let errors = [
        import_linuxcnc("m.ini", &long, &[]),
        import_linuxcnc("m.ini", &kins, &[]),
        import_freecad("m.fcm", &fcm),
    ];
    for (place, error) in errors.into_iter().enumerate() {
        let message = error.expect_err("refused").message;
        assert!(message.contains("aaa") && message.len() < 1000, "{place}: {message}");
    }
}

/// A FreeCAD machine of our own: C is mounted on A.
const FREECAD: &str = r#"{
  "freecad_version": "1.2.0",
  "machine": {
    "name": "Trunnion", "manufacturer": "Own", "units": "imperial",
    "axes": {
      "X": { "type": "linear", "role": "head_linear", "parent": null, "sequence": 0,
             "joint": { "origin": [0, 0, 0], "axis": [1, 0, 0] }, "limits": { "min": -10, "max": 10 }, "max_velocity": 600 },
      "Y": { "type": "linear", "role": "head_linear", "parent": "X", "joint": [[0, 1, 0], [0, 0, 0]],
             "limits": { "min": -5, "max": 5 }, "max_velocity": 600 },
      "Z": { "type": "linear", "role": "head_linear", "parent": "Y", "joint": [[0, 0, 0], [0, 0, 1]] },
      "A": { "type": "rotary", "role": "table_rotary", "parent": null, "joint": { "origin": [0, 0, -2], "axis": [1, 0, 0] },
             "limits": { "min": -110, "max": 20 }, "max_velocity": 3600, "solution_preference": "shortest", "allow_flip": true },
      "C": { "type": "rotary", "role": "table_rotary", "parent": "A", "joint": { "origin": [0, 0, 0], "axis": [0, 0, 2] },
             "limits": { "min": -360, "max": 360 }, "max_velocity": 7200 }
    },
    "toolheads": []
  },
  "version": 1
}
"#;

#[test]
fn a_freecad_machine_keeps_the_sense_of_its_rotary_axes_open() {
    let imported = import_freecad("own.fcm", FREECAD).expect("a machine");
    let refused = load("own", &imported.toml).expect_err("signs are not known");
    assert!(refused.message.contains("`sign` is unknown"), "{refused}");
    let filled = imported.toml.replace("unknown = [\"sign\"]", "sign = 1");
    let machine = load("own", &filled).unwrap_or_else(|error| panic!("{error}\n{filled}"));
    let letters: String = machine.axes.iter().map(|axis| char::from(axis.letter)).collect();
    assert_eq!(letters, "CAXYZ");
    assert_eq!(machine.name, "Own Trunnion");
    let (c, a, x) = (&machine.axes[0], &machine.axes[1], &machine.axes[2]);
    assert_eq!((c.direction.z, a.point.z), (1.0, -50.8));
    assert!((x.max_speed.expect("declared") - 254.0).abs() < 1e-9);
    assert!((trunnion_geometry::deg(a.max_speed.expect("declared")) - 60.0).abs() < 1e-9);
    assert_eq!(x.limits, crate::Limits::Range(-254.0, 254.0));
    assert_eq!(machine.axes[4].max_speed, None);
    assert!(imported.open.contains(&"axis Z: max_velocity not given".to_owned()));
    // what is not read is reported, above all a frame that would move everything
    assert!(
        imported
            .open
            .contains(&"axis A: not read: allow_flip, solution_preference".to_owned())
    );
    assert!(imported.open.contains(&"not read: toolheads".to_owned()));
    assert!(!imported.open.iter().any(|line| line.contains("frame")));
    let framed = FREECAD.replace("\"toolheads\": []", "\"base_frame\": [[0, 0, 5], [1, 0, 0], [0, 1, 0]]");
    let framed = import_freecad("own.fcm", &framed).expect("a machine");
    assert!(
        framed
            .open
            .iter()
            .any(|line| line.starts_with("base_frame is not read: positions and directions"))
    );
    // it is not known which rotary axis carries which
    let flat = FREECAD.replace("\"parent\": \"A\"", "\"parent\": null");
    let refused = load("flat", &import_freecad("own.fcm", &flat).expect("a machine").toml).expect_err("no order");
    assert!(refused.message.contains("`order`"), "{refused}");
}

#[test]
fn what_is_wrong_with_a_freecad_machine_is_named_and_located() {
    for (from, to, line, message) in [
        (
            "\"head_linear\", \"parent\": null",
            "\"tail\", \"parent\": null",
            6,
            "unknown role \"tail\"",
        ),
        (
            "\"type\": \"linear\", \"role\": \"head_linear\", \"parent\": \"X\"",
            "\"type\": \"round\", \"parent\": \"X\"",
            8,
            "type \"round\"",
        ),
        ("\"parent\": \"A\"", "\"parent\": \"Q\"", 13, "mounted on \"Q\""),
        (
            "\"max_velocity\": 7200",
            "\"max_velocity\": \"fast\"",
            14,
            "invalid type: string \"fast\"",
        ),
        (
            "\"axis\": [0, 0, 2]",
            "\"axis\": [0, 0, 0]",
            13,
            "its direction is zero",
        ),
        ("\"version\": 1", "\"version\" 1", 18, "expected `:`"),
    ] {
        let text = FREECAD.replacen(from, to, 1);
        assert_ne!(text, FREECAD, "{from}");
        let error = import_freecad("own.fcm", &text).expect_err(message);
        assert!(error.message.contains(message), "{error}");
        let at = error.span.clone().expect("a place").start;
        assert_eq!(text[..at].matches('\n').count() + 1, line, "{error}");
    }
    let unit = import_freecad("own.fcm", &FREECAD.replace("imperial", "ell")).expect_err("a unit");
    assert!(unit.message.contains("\"ell\""), "{unit}");
    let ring = FREECAD.replacen(
        "\"parent\": null, \"joint\": { \"origin\": [0, 0, -2]",
        "\"parent\": \"C\", \"joint\": { \"origin\": [0, 0, -2]",
        1,
    );
    assert!(
        import_freecad("own.fcm", &ring)
            .expect_err("a ring")
            .message
            .contains("mounted on itself")
    );
}

/// Cut, doubled and overwritten: an answer each time, and every place inside the file.
#[test]
fn hostile_files_never_panic() {
    let mut random = SplitMix(4);
    let pieces = [
        "[",
        "]",
        "=",
        "\"",
        "nan",
        "1e999",
        "{}",
        "HALCMD = net a b",
        "\n",
        "-",
        "\u{1F529}",
        "\\",
    ];
    for round in 0..2000 {
        let text = if round % 2 == 0 { BRIDGE } else { FREECAD };
        let mut place = || random.between(0.0, text.len() as f64) as usize;
        let (a, b) = (place(), place());
        let piece = pieces[place() % pieces.len()];
        let changed = match round % 3 {
            0 => format!("{}{piece}{}", &text[..a], &text[a..]),
            1 => format!("{}{}", &text[..a.min(b)], &text[a.max(b)..]),
            _ => format!("{}{}", &text[..a.max(b)], &text[a.min(b)..]),
        };
        let result = if round % 2 == 0 {
            import_linuxcnc("x", &changed, &[])
        } else {
            import_freecad("x", &changed)
        };
        match result {
            // what is written is TOML, complete or not
            Ok(imported) => {
                let _: toml::Table = imported
                    .toml
                    .parse()
                    .unwrap_or_else(|error| panic!("{error}\n{}", imported.toml));
                let _ = load("x", &imported.toml);
            }
            Err(error) => {
                if let Some(span) = error.span {
                    assert!(span.start <= span.end && span.end <= changed.len(), "{}", error.message);
                }
            }
        }
    }
}
