//! The five published rows of guide-vane strategy 2 (machine words and tool vectors) with a header and footer, and what tests do
//! with them.
#![allow(dead_code, reason = "each test file uses its part")]
use trunnion::check::Settings;
use trunnion::geometry::{Vec3, deg, math, rad};
use trunnion::interp::{Setup, Tool, ToolShape};
use trunnion::rewrite::{Attempt, Options, attempt, rewrite};
use trunnion::{certify::Certificate, dialect, machine, syntax};

/// The rows as machine words.
pub(crate) const ROWS: &str = "N2910 G1 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358
N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822
N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086
N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
";

/// The rows as tool vectors.
pub(crate) const VECTORS: &str = "GOTO / -28.38197, -2.14469, 59.86773, 0.002087,-0.035573, 0.999365
GOTO / -28.38474, -1.84041, 59.90263, 0.001538,-0.018231, 0.999833
GOTO / -28.38709, -1.53565, 59.93222, 0.001071,-0.000819, 0.999999
GOTO / -28.38873, -1.28023, 59.95290, 0.000744, 0.013799, 0.999905
GOTO / -28.39015, -1.01049, 59.97066, 0.000462, 0.029251, 0.999572
";

/// A Sinumerik program round `rows`.
pub(crate) fn sinumerik(rows: &str) -> String {
    format!("; guide vane\nTRAORI\nS8000 M3\nF2000\n{rows}TRAFOOF\nM30\n")
}

/// An APT program round `rows`.
pub(crate) fn apt(rows: &str) -> String {
    format!("PARTNO GUIDE VANE\nMULTAX/ON\nSPINDL/8000,CLW\nFEDRAT/2000,MMPM\n{rows}FINI\n")
}

/// A ball of 10 mm diameter, whatever its number.
pub(crate) fn ball() -> Setup {
    tool(ToolShape::Ball)
}

/// A tool of 10 mm diameter, whatever its number.
pub(crate) fn tool(shape: ToolShape) -> Setup {
    Setup {
        tools: vec![Tool {
            number: 0,
            shape: Some(shape),
            diameter_mm: Some(10.0),
            length_mm: None,
        }],
        work_offsets: Vec::new(),
        ..Setup::default()
    }
}

/// Settings for mikron-ucp710.
pub(crate) fn settings(dialect: &str, setup: Setup) -> Settings<'static> {
    let dialect = dialect::builtin(dialect).expect("a built-in dialect");
    Settings::new(dialect, machine::builtin("mikron-ucp710"), setup)
}

/// Runs a rewrite.
pub(crate) fn run(name: &str, text: &str, settings: &Settings<'_>, options: &Options) -> Attempt {
    let program = syntax::parse(text.as_bytes().to_vec(), settings.dialect.lex);
    attempt(
        rewrite(name).expect("a rewrite of that name"),
        &program,
        settings,
        options,
    )
}

/// Runs smooth-pole with this tolerance.
pub(crate) fn smooth(text: &str, settings: &Settings<'_>, tolerance_deg: f64) -> Attempt {
    run(
        "smooth-pole",
        text,
        settings,
        &Options {
            tolerance_deg,
            ..Options::default()
        },
    )
}

/// The text after and the certificate of a rewrite that must succeed.
pub(crate) fn certified(attempt: Attempt) -> (String, Certificate) {
    match attempt.outcome() {
        Ok(Some(proved)) => (
            String::from_utf8(proved.after).expect("text stays UTF-8"),
            *proved.certificate,
        ),
        other => panic!("not certified: {other:?}"),
    }
}

/// The reason of a rewrite that must be refused.
pub(crate) fn refused(attempt: Attempt) -> String {
    attempt.outcome().expect_err("refused")
}

/// Numbers of the words X Y Z A C of each row.
pub(crate) fn words(text: &str) -> Vec<[f64; 5]> {
    let rows = text.lines().filter(|line| line.contains(" G1 "));
    rows.map(|line| {
        "XYZAC"
            .bytes()
            .map(|letter| {
                let word = line
                    .split_whitespace()
                    .find(|word| word.as_bytes()[0] == letter)
                    .expect("all words are there");
                word[1..].parse().expect("a number")
            })
            .collect::<Vec<f64>>()
            .try_into()
            .expect("five words")
    })
    .collect()
}

/// Tool axis of the Mikron for A and C in deg.
pub(crate) fn axis(a: f64, c: f64) -> Vec3 {
    let ((sin_a, cos_a), (sin_c, cos_c)) = (math::sin_cos(rad(a)), math::sin_cos(rad(c)));
    Vec3::new(sin_a * sin_c, -sin_a * cos_c, cos_a)
}

/// Angle between the tool axes of two rows, deg.
pub(crate) fn turned(was: &[f64; 5], is: &[f64; 5]) -> f64 {
    deg(math::angle_between(&axis(was[3], was[4]), &axis(is[3], is[4])))
}

/// Largest step of C between rows, deg.
pub(crate) fn largest_c_step(rows: &[[f64; 5]]) -> f64 {
    rows.windows(2)
        .map(|pair| (pair[1][4] - pair[0][4]).abs())
        .fold(0.0, f64::max)
}
