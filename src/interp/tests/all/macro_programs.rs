//! The sample programs with macros, and programs in other files: motion by motion, reckoned by hand.
use crate::support::{Log, line, run_bytes};
use std::sync::Arc;
use trunnion_interp::{FaultKind, Files, Library, Limits, Loaded, Searched, Setup};

const FANUC: &str = "fanuc-30i";

fn sample(name: &str) -> Vec<String> {
    let file = format!("{}/../../samples/programs/macro/{name}", env!("CARGO_MANIFEST_DIR"));
    let source = std::fs::read(&file).expect("a sample");
    let (_, log) = run_bytes(FANUC, &source, &Setup::default());
    let wrong: Vec<_> = log
        .faults
        .iter()
        .filter(|fault| !matches!(fault.kind, FaultKind::WorkOffsetUnset { .. }))
        .collect();
    assert!(wrong.is_empty(), "{name}: {wrong:?}");
    // from the first move in the plane on
    let lines = log.motions.iter().map(line);
    lines.filter(|line| line.contains('X') && line.contains('Y')).collect()
}

#[test]
fn bolt_circle() {
    let mut expected = Vec::new();
    // 40 mm at 30, 90, 150, 210, 270, 330 deg
    for place in [
        "X34.641016 Y20",
        "X0 Y40",
        "X-34.641016 Y20",
        "X-34.641016 Y-20",
        "X0 Y-40",
        "X34.641016 Y-20",
    ] {
        let before = if expected.is_empty() { 50 } else { 2 };
        expected.push(format!("R {place} Z{before}"));
        expected.push(format!("R {place} Z2"));
        expected.push(format!("L {place} Z-12 F120"));
        expected.push(format!("R {place} Z2"));
    }
    expected.push("R X34.641016 Y-20 Z50".to_owned());
    assert_eq!(sample("bolt-circle.nc"), expected);
}

#[test]
fn helical_bore() {
    // the tool's centre runs on a radius of (50 - 16) / 2 = 17 mm; 4 mm a turn, the last turn is cut off at 10 mm
    assert_eq!(
        sample("helical-bore.nc"),
        [
            "R X0 Y0 Z50",
            "R X0 Y0 Z1",
            "L X17 Y0 Z1 F400",
            "A(0 0 1; 360) X17 Y0 Z-4 F300",
            "A(0 0 -4; 360) X17 Y0 Z-8 F300",
            "A(0 0 -8; 360) X17 Y0 Z-10 F300",
            "A(0 0 -10; 360) X17 Y0 Z-10 F300",
            "L X0 Y0 Z-10 F300",
            "R X0 Y0 Z50",
        ]
    );
}

/// One level of the pocket: down, round, back to the centre.
fn level(centre: [i32; 2], half: [i32; 2], depth: i32, feed: i32) -> Vec<String> {
    let ([x, y], [a, b]) = (centre, half);
    let corners = [
        (x + a, y),
        (x + a, y + b),
        (x - a, y + b),
        (x - a, y - b),
        (x + a, y - b),
        (x + a, y),
        (x, y),
    ];
    let mut lines = vec![format!("L X{x} Y{y} Z{depth} F{}", feed / 2)];
    lines.extend(corners.map(|(x, y)| format!("L X{x} Y{y} Z{depth} F{feed}")));
    lines
}

#[test]
fn pockets() {
    // 40 x 20 mm less the tool's 10 mm: 15 and 5 mm to either side; depth 4 in two levels
    let mut expected = vec!["R X20 Y15 Z50".to_owned(), "R X20 Y15 Z2".to_owned()];
    expected.extend(level([20, 15], [15, 5], -2, 600));
    expected.extend(level([20, 15], [15, 5], -4, 600));
    expected.push("R X20 Y15 Z2".to_owned());
    expected.push("R X80 Y15 Z2".to_owned());
    expected.push("R X80 Y15 Z2".to_owned());
    // depth 3: the second level is 1 mm
    expected.extend(level([80, 15], [10, 10], -2, 500));
    expected.extend(level([80, 15], [10, 10], -3, 500));
    expected.push("R X80 Y15 Z2".to_owned());
    expected.push("R X80 Y15 Z50".to_owned());
    assert_eq!(sample("pocket.nc"), expected);
}

#[test]
fn engraved_number() {
    let stroke = |from: [i32; 2], to: [i32; 2]| {
        [
            format!("R X{} Y{} Z1", from[0], from[1]),
            format!("L X{} Y{} Z-0.2 F100", from[0], from[1]),
            format!("L X{} Y{} Z-0.2 F200", to[0], to[1]),
        ]
    };
    let lift = |at: [i32; 2]| format!("R X{} Y{} Z1", at[0], at[1]);
    let cut = |to: [i32; 2]| format!("L X{} Y{} Z-0.2 F200", to[0], to[1]);
    let mut expected = Vec::new();
    // 1, 7, 4: 8 mm high, 6 mm apart from X5
    expected.extend(stroke([7, 0], [7, 8]));
    expected.push(lift([7, 8]));
    expected.extend(stroke([11, 0], [15, 8]));
    expected.push(cut([11, 8]));
    expected.push(lift([11, 8]));
    expected.extend(stroke([21, 0], [21, 8]));
    expected.push(cut([17, 4]));
    expected.push(cut([21, 4]));
    expected.push("R X21 Y4 Z10".to_owned());
    assert_eq!(sample("engrave.nc"), expected);
}

/// Files in memory.
struct Folder(Vec<(&'static str, &'static str)>);

impl Files for Folder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let found = self.0.iter().find(|file| file.0 == name);
        found
            .map(|file| Loaded {
                path: format!("lib/{}", file.0),
                bytes: file.1.as_bytes().into(),
            })
            .ok_or_else(|| vec!["lib".into()])
    }
}

fn with_files(source: &str, files: &[(&'static str, &'static str)]) -> Log {
    let setup = Setup {
        library: Library(Some(Arc::new(Folder(files.to_vec())))),
        ..Setup::default()
    };
    run_bytes(FANUC, source.as_bytes(), &setup).1
}

#[test]
fn a_program_in_another_file_runs_and_its_motions_stand_at_the_call() {
    let files = [
        ("O1000.nc", "%\nO1000(SUB)\nG91G0X1.\nM98P2000\nM99\n%\n"),
        ("2000", "G0Y2.\nG4X1.\nG888\nM99\n"),
    ];
    let log = with_files("G90G0X0.Y0.\nM98P1000L2\nG90X9.\nM30\n", &files);
    let got: Vec<_> = log.motions.iter().map(line).collect();
    assert_eq!(
        got,
        [
            "R X0 Y0", "R X1 Y0", "R X1 Y2", "D1 X1 Y2", "R X2 Y2", "R X2 Y4", "D1 X2 Y4", "R X9 Y4"
        ]
    );
    let blocks: Vec<_> = log.motions.iter().map(|motion| motion.block.0).collect();
    assert_eq!(blocks, [0, 1, 1, 1, 1, 1, 1, 2]);
    assert_eq!(log.faults.len(), 1, "{:?}", log.faults);
    assert!(matches!(&log.faults[0].kind, FaultKind::NotModelled { what } if what.contains("lib/2000, line 3")));
}

/// A file without a number is the program of its name; one that begins with another number is not.
#[test]
fn a_file_of_another_number_is_not_the_program() {
    for (text, found) in [
        ("G0X5.\nM99\n", true),
        ("%\nO0005\nG0X5.\nM99\n%\n", true),
        ("%\nO0007\nG0X5.\nM99\n%\n", false),
    ] {
        let log = with_files("G0X1.\nM98P5\nM30\n", &[("5.nc", text)]);
        assert_eq!(log.motions.len() == 2, found, "{text}");
        let missing = |searched: &[Searched]| searched[0].folder == "lib/5.nc";
        let told = log
            .faults
            .iter()
            .any(|fault| matches!(&fault.kind, FaultKind::MissingSubprogram { searched, .. } if missing(searched)));
        assert_eq!(told, !found, "{text}: {:?}", log.faults);
    }
}

#[test]
fn a_program_that_is_nowhere_names_the_folders() {
    let log = with_files("G0X1.Y1.\nM98P77\nX2.\nM30\n", &[]);
    assert_eq!(
        log.faults[0].kind,
        FaultKind::MissingSubprogram {
            name: "O0077".to_owned(),
            searched: vec!["lib".into()],
            alarm: None,
            caller: None,
        }
    );
    let got: Vec<_> = log.motions.iter().map(line).collect();
    assert_eq!(got, ["R X1 Y1", "R X2"], "what it did to Y is not known");
}

#[test]
fn a_file_without_m99_ends_the_run() {
    let log = with_files("M98P1\nG0X5.\nM30\n", &[("O0001", "%\nO1\nG0X1.\n%\n")]);
    assert_eq!(log.motions.len(), 1);
    assert!(matches!(&log.faults[0].kind, FaultKind::Rejected { alarm: Some(alarm), .. } if alarm == "PS5010"));
}

#[test]
fn hostile_programs_end() {
    let few = Setup {
        limits: Limits {
            blocks: 100_000,
            ..Limits::default()
        },
        ..Setup::default()
    };
    let deep = format!("#1={}1{}\n", "[".repeat(100_000), "]".repeat(100_000));
    let condition = format!("IF[{}1]GOTO5\n", "#".repeat(100_000));
    let jumps = "N1GOTO1\n".repeat(2000);
    let loops = "WHILE[1]DO1\nEND1\n".repeat(2000);
    let opens = "DO1\nDO2\nDO3\n".repeat(2000);
    let doubling = "M98P2L9999\nM30\nO2\nM98P3L9999\nM99\nO3\nM98P4L9999\nM99\nO4\nM99\n".to_owned();
    let macros = "G65P2L9999A1.\nM30\nO2\nG65P3L9999\nM99\nO3\n#1=#1+1\nM99\n".to_owned();
    let modal = "G66P2\nG0X1.\nM30\nO2\nG66P2\nG0X2.\nM99\n".to_owned();
    let odd = "#=1\n#[=1\n##=\n#1=#\nIF\nWHILE\nDO\nEND\nGOTO\nG65\nM98P-1\nM98P1.5\nG66P#\nO\nN\n<>\nM99P\nGOTO1E9\n"
        .to_owned();
    for source in [deep, condition, jumps, loops, opens, doubling, macros, modal, odd] {
        let (program, log) = run_bytes(FANUC, source.as_bytes(), &few);
        for fault in &log.faults {
            let block = program.block(fault.block).range();
            let inside = block.start <= fault.range.start && fault.range.end <= block.end;
            assert!(inside, "{fault:?} in {block:?}");
        }
        assert!(!log.faults.is_empty(), "{}", &source[..source.len().min(40)]);
    }
}
