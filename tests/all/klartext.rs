//! HEIDENHAIN Klartext: the shared five-axis part posted once more in Klartext must have the same targets; programs of shops must be followed,
//! and where a run stops at a value that only the machine knows is a reviewed list.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
use crate::cli::tools::{str, text, trunnion, write};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn shared(path: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(path);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: {} is not there", path.display());
    None
}

/// How the part is written.
#[derive(Clone, Copy)]
struct Form {
    name: &'static str,
    /// Tool centre point control on.
    on: &'static str,
    comma: bool,
    plus: bool,
    /// LN with a tool vector in place of L with A and C.
    vectors: bool,
    /// Values by Q parameters.
    parameters: bool,
    numbers: bool,
    rapid: &'static str,
}

const PLAIN: Form = Form {
    name: "M128",
    on: "M128",
    comma: false,
    plus: true,
    vectors: false,
    parameters: false,
    numbers: true,
    rapid: "FMAX",
};

const FORMS: [Form; 6] = [
    PLAIN,
    Form {
        name: "M128 with a feed, decimal comma, no signs, no block numbers",
        on: "M128 F20000",
        comma: true,
        plus: false,
        numbers: false,
        rapid: "F MAX",
        ..PLAIN
    },
    Form {
        name: "TCPM",
        on: "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
        ..PLAIN
    },
    Form {
        name: "Q parameters",
        parameters: true,
        comma: true,
        ..PLAIN
    },
    Form {
        name: "LN with M128",
        vectors: true,
        ..PLAIN
    },
    Form {
        name: "LN with TCPM, decimal comma",
        on: "FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR REFPNT TIP-TIP",
        vectors: true,
        comma: true,
        plus: false,
        ..PLAIN
    },
];

impl Form {
    fn number(&self, written: &str) -> String {
        let sign = if written.starts_with('-') {
            "-"
        } else if self.plus {
            "+"
        } else {
            ""
        };
        let digits = written.trim_start_matches('-');
        let zero = if digits.starts_with('.') { "0" } else { "" };
        let number = format!("{sign}{zero}{digits}");
        if self.comma { number.replace('.', ",") } else { number }
    }

    /// The Siemens program in Klartext, up to the end of its tool centre point control.
    fn post(&self, siemens: &str) -> String {
        let mut out = String::new();
        let mut count = 0;
        let mut put = |block: &str| {
            let number = if self.numbers {
                format!("{count} ")
            } else {
                String::new()
            };
            writeln!(out, "{number}{block}").expect("memory");
            count += 1;
        };
        put("BEGIN PGM PART MM");
        let (mut motion, mut led, mut tool) = (String::new(), false, String::new());
        let mut angles = [0.0_f64; 2];
        for line in siemens.lines().filter(|line| !line.starts_with('%')) {
            let line = line.split(';').next().unwrap_or_default();
            let mut words = line.split_whitespace().filter(|word| !word.starts_with('N'));
            match words.clone().next() {
                Some("TRAORI") => {
                    put(self.on);
                    led = true;
                    continue;
                }
                Some("TRAFOOF") => break,
                _ => {}
            }
            let mut axes: Vec<(char, &str)> = Vec::new();
            let (mut feed, mut codes) = (String::new(), String::new());
            for (letter, value) in words
                .by_ref()
                .filter_map(|word| Some((word.chars().next()?, word.get(1..)?)))
                .filter(|word: &(char, &str)| word.1.parse::<f64>().is_ok())
            {
                match letter {
                    'G' if matches!(value, "0" | "1") => value.clone_into(&mut motion),
                    'X' | 'Y' | 'Z' => axes.push((letter, value)),
                    'A' | 'C' => {
                        angles[usize::from(letter == 'C')] = value.parse().expect("an angle");
                        axes.push((letter, value));
                    }
                    'F' => feed = format!(" F{}", self.number(value).trim_start_matches('+')),
                    'T' if value != "0" => value.clone_into(&mut tool),
                    'S' => put(&format!("TOOL CALL {tool} Z S{value}")),
                    'M' if value == "3" => codes.push_str(" M3"),
                    _ => {}
                }
            }
            if motion == "0" && !axes.is_empty() {
                feed = format!(" R0 {}", self.rapid);
            }
            if axes.is_empty() {
                if !feed.is_empty() || !codes.is_empty() {
                    put(&format!("L{feed}{codes}"));
                }
                continue;
            }
            let mut block = String::from(if self.vectors && led { "LN" } else { "L" });
            for (at, (letter, value)) in axes.iter().enumerate() {
                if self.vectors && led && matches!(letter, 'A' | 'C') {
                    continue;
                }
                if self.parameters {
                    put(&format!("Q{} = {}", at + 1, self.number(value)));
                    write!(block, " {letter}+Q{}", at + 1).expect("memory");
                } else {
                    write!(block, " {letter}{}", self.number(value)).expect("memory");
                }
            }
            if self.vectors && led {
                // the machine file: u = (sin A sin C, -sin A cos C, cos A)
                let [(sin_a, cos_a), (sin_c, cos_c)] =
                    angles.map(|angle| trunnion_geometry::math::sin_cos(angle.to_radians()));
                for (name, value) in [("TX", sin_a * sin_c), ("TY", -sin_a * cos_c), ("TZ", cos_a)] {
                    write!(block, " {name}{}", self.number(&format!("{value:.9}"))).expect("memory");
                }
            }
            put(&format!("{block}{feed}{codes}"));
        }
        put("L M30");
        put("END PGM PART MM");
        out
    }
}

/// The rows of a trace, by column.
fn rows(program: &Path) -> Vec<BTreeMap<String, String>> {
    let output = trunnion(&["trace", str(program), "--machine", "mikron-ucp710"]);
    let all = text(&output.stdout);
    let mut lines = all.lines();
    let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let row = |line: &str| {
        names
            .iter()
            .copied()
            .map(str::to_owned)
            .zip(line.split(',').map(str::to_owned))
            .collect()
    };
    lines.map(row).collect()
}

/// Position and tool vector of the part, target by target, whatever words a post uses; the axes too where it gives them as angles. C winds up
/// to 86391 degrees.
#[test]
fn the_five_axis_part_in_klartext_has_the_targets_of_the_siemens_program() {
    let Some(siemens) = shared("four-controls/siemens/5X_Milling.mpf") else {
        return;
    };
    let source = std::fs::read_to_string(&siemens).expect("text");
    let folder = TempDir::new().expect("a folder");
    let wanted = rows(&siemens);
    for form in FORMS {
        let path = write(&folder, "part.h", &form.post(&source));
        let found = rows(&path);
        // the Siemens program goes to its reference point afterwards
        assert_eq!((wanted.len(), found.len()), (44_610, 44_608), "{}", form.name);
        let mut columns = vec!["motion", "tcp", "x_mm", "y_mm", "z_mm", "i", "j", "k", "feed_mm_min"];
        if !form.vectors {
            columns.extend(["joint_a", "joint_c", "joint_x", "joint_y", "joint_z"]);
        }
        let mut most = 0.0_f64;
        for (at, (wanted, found)) in wanted.iter().zip(&found).enumerate() {
            assert!(
                at < 2 || !found["x_mm"].is_empty(),
                "{}: target {at} is unknown",
                form.name
            );
            for column in &columns {
                let (one, other) = (&wanted[*column], &found[*column]);
                let near = one
                    .parse::<f64>()
                    .ok()
                    .zip(other.parse::<f64>().ok())
                    .is_some_and(|(one, other)| {
                        (one - other).abs() < if matches!(*column, "i" | "j" | "k") { 1e-5 } else { 1e-3 }
                    });
                assert!(
                    one == other || near,
                    "{}, target {at}, {column}: {one} {other}",
                    form.name
                );
            }
            most = most.max(found["joint_c"].parse().unwrap_or_default());
        }
        assert!(most > 86_391.0, "{}: C winds up to {most}", form.name);
    }
}

/// All Klartext programs from outside the repository.
fn programs() -> Option<Vec<PathBuf>> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            if path.is_dir() {
                walk(&path, found);
            } else if matches!(ending.as_deref(), Some("h" | "klartext")) {
                found.push(path);
            }
        }
    }
    let mut found = Vec::new();
    for folder in [
        "wild",
        "klartext",
        "controls/heidenhain",
        "apt/solidworks-cam",
        "four-controls/heidenhain",
    ] {
        walk(&shared(folder)?, &mut found);
    }
    found.sort();
    Some(found)
}

/// Whether coordinates come from Q parameters, or nothing moves without values of the control: a macro.
fn is_macro(source: &str) -> bool {
    let lines = source.lines().map(|line| line.split(';').next().unwrap_or_default());
    lines.clone().any(|line| {
        line.contains("SYSREAD")
            || line.contains("CALL PGM")
            || line.split_whitespace().any(|word| {
                let mut letters = word.trim_start_matches('I').chars();
                matches!(letters.next(), Some('X' | 'Y' | 'Z'))
                    && letters.as_str().trim_start_matches(['+', '-']).starts_with('Q')
            })
    }) || !lines
        .clone()
        .any(|line| line.split_whitespace().any(|word| word == "L"))
}

/// Errors, the control (macros, one program of 75000 motions, and one with `nan` are counted apart), known ends of the tip, and by name everything that stops a run or leaves a value open. The list next to this file was
/// read and each line is a value of the machine, or something no source states.
#[test]
fn programs_of_shops_are_followed() {
    let Some(paths) = programs() else { return };
    assert!(paths.len() >= 40, "{}", paths.len());
    let mut arguments = vec!["check", "--format", "json", "-q", "--assume", "work-offset,tool-length"];
    arguments.extend(paths.iter().map(|path| str(path)));
    let document: Value = serde_json::from_slice(&trunnion(&arguments).stdout).expect("JSON");
    let (mut blocks, mut errors, mut motions, mut known) = (0, 0, 0, 0);
    let mut causes: BTreeSet<String> = BTreeSet::new();
    let mut table = String::new();
    let root = shared("").expect("there").canonicalize().expect("a folder");
    for file in document["files"].as_array().expect("files") {
        let path = Path::new(file["path"].as_str().expect("a path"));
        assert_eq!(file["dialect"], "heidenhain-klartext", "{}", path.display());
        let source = String::from_utf8_lossy(&std::fs::read(path).expect("readable")).into_owned();
        let number = |name: &str| file["coverage"][name].as_u64().expect("a number");
        let findings = file["diagnostics"].as_array().expect("findings");
        errors += findings.iter().filter(|found| found["severity"] == "error").count() as u64;
        blocks += number("blocks");
        let has_values = !source.contains("nan");
        let counts = has_values && !is_macro(&source) && number("motions") < 50_000;
        let short = path.canonicalize().expect("there");
        let short = short.strip_prefix(&root).expect("below").display().to_string();
        writeln!(
            table,
            "{} {}/{} {short}",
            if counts { "counts" } else { "apart" },
            number("motions_known"),
            number("motions")
        )
        .expect("memory");
        if counts {
            motions += number("motions");
            known += number("motions_known");
        }
        for found in findings
            .iter()
            .filter(|found| matches!(found["rule"].as_str(), Some("not-modelled" | "not-decided")))
        {
            let message = found["message"].as_str().expect("a message");
            let message = message
                .split(" in /")
                .next()
                .expect("a part")
                .split(" in ..")
                .next()
                .expect("a part");
            let message = message
                .split(" (")
                .next()
                .expect("a part")
                .trim_start_matches("not modelled: ");
            // without the parameter that is read into, and the index
            let message = match message.split_once(" = ID") {
                Some((_, what)) => format!("FN 18: SYSREAD ID{}", what.split(" IDX").next().expect("a part")),
                None => message.to_owned(),
            };
            causes.insert(message);
        }
    }
    println!("{table}{errors} errors in {blocks} blocks; {known} of {motions} motions with literal coordinates known");
    assert!(errors * 200 <= blocks, "{errors} errors in {blocks} blocks");
    assert!(known * 10 >= motions * 9, "{known} of {motions}\n{table}");
    let reviewed = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/klartext/unknown.txt");
    let reviewed = std::fs::read_to_string(reviewed).expect("the list");
    let reviewed: BTreeSet<&str> = reviewed.lines().filter(|line| !line.starts_with("# ")).collect();
    let found: BTreeSet<&str> = causes.iter().map(String::as_str).collect();
    let new: Vec<_> = found.difference(&reviewed).collect();
    let gone: Vec<_> = reviewed.difference(&found).collect();
    assert!(
        new.is_empty() && gone.is_empty(),
        "not reviewed: {new:#?}\nnot found any more: {gone:#?}"
    );
}
