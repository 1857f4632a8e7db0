//! A test piece as a program: cutter locations in APT, or blocks for a machine and a dialect.
use super::joints::Place;
use super::{Plant, Style};
use crate::cli::failure::Failure;
use std::fmt::Write;
use trunnion_geometry::{Vec3, deg};
use trunnion_machine::{AxisKind, Machine, inverse};
use trunnion_pieces::{Kind, Move, Piece};

/// Length of the tool that the programs declare, mm, and of the wrong one that `--plant wrong-h` calls.
pub(super) const TOOL_LENGTH: f64 = 80.0;
const WRONG_LENGTH: f64 = 75.0;
const SPINDLE: u32 = 8000;

/// How a program is written.
pub(super) struct Form<'a> {
    pub(super) dialect: &'a str,
    pub(super) style: Style,
    pub(super) plant: Option<Plant>,
}

/// Cutter locations as an APT source: what every postprocessor reads.
pub(super) fn apt(piece: &Piece) -> String {
    let mut text = format!(
        "PARTNO TRUNNION {}\n$$ {}\nUNITS/MM\n",
        piece.name.to_uppercase(),
        piece.title
    );
    let cutter = if piece.tool.ball {
        format!("{},{}", number(piece.tool.diameter), number(0.5 * piece.tool.diameter))
    } else {
        number(piece.tool.diameter)
    };
    if piece.tool.diameter > 0.0 {
        let _ = writeln!(text, "CUTTER/{cutter}");
    }
    let _ = write!(
        text,
        "LOADTL/1\nSPINDL/RPM,{SPINDLE},CLW\nFEDRAT/{},MMPM\nMULTAX/ON\n",
        number(piece.feed_mm_min)
    );
    for step in &piece.moves {
        match step.kind {
            Kind::Rapid => text.push_str("RAPID\n"),
            Kind::Line => {}
            Kind::Arc { centre, normal } => {
                let _ = writeln!(text, "CIRCLE/{},{}", triple(&centre, 9), triple(&normal, 9));
            }
        }
        let _ = writeln!(text, "GOTO/{},{}", triple(&step.tip, 9), triple(&step.axis, 12));
    }
    text.push_str("MULTAX/OFF\nSPINDL/OFF\nFINI\n");
    text
}

/// Blocks for a machine: `places` are its joints at the end of each move.
pub(super) fn program(piece: &Piece, machine: &Machine, places: &[Place], form: &Form<'_>) -> Result<String, Failure> {
    let codes = Codes::of(form)?;
    let mut text = String::new();
    codes.head(piece, form, &mut text);
    let shift = per_length(machine);
    let mut feed = Some(number(piece.feed_mm_min * feed_scale(form.plant)));
    let mut before: Option<&Move> = None;
    let mut modal = "";
    for (step, place) in piece.moves.iter().zip(places) {
        let mut block = String::new();
        let code = code(step, before);
        if code != modal {
            block.push_str(code);
        }
        modal = code;
        match form.style {
            Style::Joints => joint_words(machine, place, &shift, codes.compensates, &mut block),
            Style::Words => {
                point_words(&step.tip, &mut block);
                rotary_words(machine, place, &mut block);
            }
            Style::Vectors => {
                point_words(&step.tip, &mut block);
                codes.vector(&step.axis, &mut block);
            }
        }
        if let (Kind::Arc { centre, .. }, Some(from)) = (step.kind, before) {
            let arm = centre - from.tip;
            let _ = write!(block, " I{} J{}", number(arm.x), number(arm.y));
        }
        if step.kind != Kind::Rapid
            && let Some(feed) = feed.take()
        {
            let _ = write!(block, " F{feed}");
        }
        text.push_str(block.trim_start());
        text.push('\n');
        before = Some(step);
    }
    text.push_str(&codes.tail);
    Ok(text)
}

fn feed_scale(plant: Option<Plant>) -> f64 {
    // the number of an inch program in a metric one
    if plant == Some(Plant::FeedUnit) {
        1.0 / 25.4
    } else {
        1.0
    }
}

/// G0, G1, G2, G3; arcs are programmed in the XY plane only, and only for pieces with a vertical tool.
fn code(step: &Move, before: Option<&Move>) -> &'static str {
    match step.kind {
        Kind::Rapid => "G0",
        Kind::Line => "G1",
        Kind::Arc { normal, .. } if before.is_some() && normal.z < 0.0 => "G2",
        Kind::Arc { .. } => "G3",
    }
}

/// What one mm of tool length adds to the linear joints.
fn per_length(machine: &Machine) -> [f64; trunnion_machine::MAX_AXES] {
    let solve = |length: f64| {
        let mut joints = [0.0; trunnion_machine::MAX_AXES];
        inverse(machine, &mut joints, &Vec3::zeros(), length).map(|()| joints)
    };
    match (solve(1.0), solve(0.0)) {
        (Some(with), Some(without)) => core::array::from_fn(|i| with[i] - without[i]),
        _ => [0.0; trunnion_machine::MAX_AXES],
    }
}

fn point_words(tip: &Vec3, block: &mut String) {
    for (letter, value) in ['X', 'Y', 'Z'].iter().zip(tip.iter()) {
        let _ = write!(block, " {letter}{}", number(*value));
    }
}

fn rotary_words(machine: &Machine, place: &Place, block: &mut String) {
    for &joint in &machine.rotary {
        let letter = char::from(machine.axes[joint].letter);
        let _ = write!(block, " {letter}{}", number(deg(place.joints[joint])));
    }
}

/// Machine words: the tool's length is taken off where the control adds it again.
fn joint_words(machine: &Machine, place: &Place, shift: &[f64], compensates: bool, block: &mut String) {
    let mut axes: Vec<usize> = machine.linear.iter().chain(&machine.rotary).copied().collect();
    axes.sort_by_key(|&joint| (machine.axes[joint].kind == AxisKind::Rotary, machine.axes[joint].letter));
    for joint in axes {
        let axis = &machine.axes[joint];
        let value = match axis.kind {
            AxisKind::Rotary => deg(place.joints[joint]),
            AxisKind::Linear if compensates => place.joints[joint] - shift[joint] * TOOL_LENGTH,
            AxisKind::Linear => place.joints[joint],
        };
        let _ = write!(block, " {}{}", char::from(axis.letter), number(value));
    }
}

/// The words of one dialect.
struct Codes {
    comment: (&'static str, &'static str),
    /// Before the first motion, behind the tool change.
    on: String,
    tail: String,
    /// The control adds the tool's length to machine words.
    compensates: bool,
    vectors: [&'static str; 3],
    first: &'static str,
    modes: &'static str,
}

impl Codes {
    fn of(form: &Form<'_>) -> Result<Self, Failure> {
        let tcp = form.style != Style::Joints && form.plant != Some(Plant::NoTcp);
        let h = if form.plant == Some(Plant::WrongH) { 2 } else { 1 };
        let plain = |first, modes, on: String, tail: &str| Self {
            comment: ("(", ")"),
            on,
            tail: tail.to_owned(),
            compensates: true,
            vectors: ["I", "J", "K"],
            first,
            modes,
        };
        match form.dialect {
            "fanuc-30i" => {
                let code = match (tcp, form.style) {
                    (false, _) => "G43",
                    (true, Style::Vectors) => "G43.5",
                    (true, _) => "G43.4",
                };
                Ok(plain(
                    "%\nO0001 ",
                    "G17 G21 G90 G94 G40",
                    format!("{code} H{h}"),
                    "G49\nM5\nM30\n%\n",
                ))
            }
            "haas-ngc" if form.style != Style::Vectors => {
                let code = if tcp { "G234" } else { "G43" };
                Ok(plain(
                    "%\nO00001 ",
                    "G17 G21 G90 G94 G40",
                    format!("{code} H{h}"),
                    "G49\nM5\nM30\n%\n",
                ))
            }
            "sinumerik-840d" => Ok(Self {
                comment: ("; ", ""),
                on: format!("D1{}", if tcp { "\nTRAORI" } else { "" }),
                tail: format!("{}M5\nM30\n", if tcp { "TRAFOOF\n" } else { "" }),
                vectors: ["A3=", "B3=", "C3="],
                ..plain("", "G17 G71 G90 G94 G40", String::new(), "")
            }),
            "linuxcnc" if form.style != Style::Vectors => {
                let (on, off) = if tcp { ("\nM428", "M429\n") } else { ("", "") };
                Ok(plain(
                    "%\n",
                    "G17 G21 G90 G94 G40 G64 P0.01",
                    format!("G43 H{h}{on}"),
                    &format!("{off}G49\nM5\nM2\n%\n"),
                ))
            }
            "iso-6983" if form.style == Style::Joints => Ok(plain(
                "%\n",
                "G17 G21 G90 G94 G40",
                format!("G43 H{h}"),
                "G49\nM5\nM30\n%\n",
            )),
            "grbl" if form.style == Style::Joints => {
                let mut codes = plain("", "G17 G21 G90 G94", String::new(), "M5\nM2\n");
                codes.compensates = false;
                Ok(codes)
            }
            other => Err(Failure::new(format!(
                "a test piece for `{other}` in the style `{}` cannot be written: words, vectors and joints exist for fanuc-30i \
                 and sinumerik-840d, words and joints for haas-ngc and linuxcnc, joints for iso-6983 and grbl",
                form.style.name()
            ))),
        }
    }

    fn head(&self, piece: &Piece, form: &Form<'_>, text: &mut String) {
        let (open, close) = self.comment;
        // round brackets and semicolons would end the comment
        let title: String = piece.title.chars().filter(|c| !"();".contains(*c)).collect();
        let _ = writeln!(text, "{}{open}{title}{close}", self.first);
        let shape = if piece.tool.ball { "ball" } else { "flat" };
        let mut declare = |number: u32, length: f64| {
            let size = if piece.tool.diameter > 0.0 {
                format!("{shape} diameter {} ", self::number(piece.tool.diameter))
            } else {
                String::new()
            };
            let _ = writeln!(
                text,
                "{open}trunnion: tool {number} {size}length {}{close}",
                self::number(length)
            );
        };
        if self.compensates {
            declare(1, TOOL_LENGTH);
            if form.plant == Some(Plant::WrongH) {
                declare(2, WRONG_LENGTH);
            }
        }
        let offset = if form.plant == Some(Plant::ShiftG54) {
            "G55"
        } else {
            "G54"
        };
        let _ = writeln!(text, "{} {offset}\nT1 M6\nS{SPINDLE} M3", self.modes);
        if !self.on.is_empty() {
            let _ = writeln!(text, "{}", self.on);
        }
    }

    fn vector(&self, axis: &Vec3, block: &mut String) {
        for (word, value) in self.vectors.iter().zip(axis.iter()) {
            let _ = write!(block, " {word}{}", fixed(*value, 9));
        }
    }
}

/// A number with at most six decimals: finer than a control resolves, so that rates between short blocks keep their digits.
fn number(value: f64) -> String {
    fixed(value, 6)
}

/// A number with at most `places` and at least one decimal.
fn fixed(value: f64, places: usize) -> String {
    let mut text = format!("{value:.places$}");
    while text.ends_with('0') && !text.ends_with(".0") {
        text.pop();
    }
    if text == "-0.0" { "0.0".to_owned() } else { text }
}

fn triple(v: &Vec3, places: usize) -> String {
    format!("{},{},{}", fixed(v.x, places), fixed(v.y, places), fixed(v.z, places))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_keep_their_point() {
        assert_eq!(
            [10.0, -0.000_000_1, 1.25, -3.125_000_4].map(number),
            ["10.0", "0.0", "1.25", "-3.125"]
        );
        assert_eq!(fixed(0.123_456_789, 9), "0.123456789");
    }
}
