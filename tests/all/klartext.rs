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
        let sign = if written.starts_with('-') { "-" } else if self.plus { "+" } else { "" };
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
            let number = if self.numbers { format!("{count} ") } else { String::new() };
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
            for (letter, value) in words.by_ref().filter_map(|word| Some((word.chars().next()?, word.get(1..)?))) {
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
                let [(sin_a, cos_a), (sin_c, cos_c)] = angles.map(|angle| angle.to_radians().sin_cos());
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
    let row = |line: &str| names.iter().copied().map(str::to_owned).zip(line.split(',').map(str::to_owned)).collect();
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
            assert!(at < 2 || !found["x_mm"].is_empty(), "{}: target {at} is unknown", form.name);
            for column in &columns {
                let (one, other) = (&wanted[*column], &found[*column]);
                let near = one.parse::<f64>().ok().zip(other.parse::<f64>().ok()).is_some_and(|(one, other)| {
                    (one - other).abs() < if matches!(*column, "i" | "j" | "k") { 1e-5 } else { 1e-3 }
                });
                assert!(one == other || near, "{}, target {at}, {column}: {one} {other}", form.name);
            }
            most = most.max(found["joint_c"].parse().unwrap_or_default());
        }
        assert!(most > 86_391.0, "{}: C winds up to {most}", form.name);
    }
}
