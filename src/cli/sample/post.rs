//! A test piece as a program: cutter locations in APT, or blocks for a machine and a dialect.
use super::joints::Place;
use super::{Plant, Style};
use crate::cli::failure::Failure;
use std::fmt::Write;
use trunnion_convert::{Post, builtin_post};
use trunnion_geometry::{Vec3, deg};
use trunnion_machine::{AxisKind, Machine, inverse};
use trunnion_pieces::{Kind, Move, Piece};

/// Length of the tool that the programs declare, mm, and of the wrong one that `--plant wrong-h` selects.
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
    let codes = Codes::of(form, machine)?;
    let mut text = String::new();
    codes.head(piece, &mut text)?;
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
    codes.tail(&mut text)?;
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

/// The words of one dialect: those of its post, which `convert` writes with too.
struct Codes<'a> {
    post: &'static Post,
    machine: &'a Machine,
    form: &'a Form<'a>,
    /// The control adds the tool's length to machine words.
    compensates: bool,
}

impl<'a> Codes<'a> {
    fn of(form: &'a Form<'_>, machine: &'a Machine) -> Result<Self, Failure> {
        let post = builtin_post(form.dialect);
        let post = post.filter(|post| match form.style {
            Style::Joints => true,
            Style::Words => post.fill("tcp-words-on", |_| Some(String::new())).is_some(),
            Style::Vectors => post.fill("vector", |_| Some(String::new())).is_some(),
        });
        let Some(post) = post else {
            return Err(Failure::new(format!(
                "a test piece for `{}` cannot be written in the style `{}`: words, vectors and joints exist for fanuc-30i \
                 and sinumerik-840d, words and joints for haas-ngc and linuxcnc, joints for iso-6983 and grbl",
                form.dialect,
                form.style.name()
            )));
        };
        if form.plant == Some(Plant::WrongH) && !post.numbers_its_lengths() {
            return Err(Failure::new(format!(
                "--plant wrong-h: a program for `{}` does not call the length by a separate number",
                form.dialect
            )));
        }
        Ok(Self {
            post,
            machine,
            form,
            compensates: form.dialect != "grbl",
        })
    }

    /// Whether the blocks are written for tool centre point control.
    fn leads_tip(&self) -> bool {
        self.form.style != Style::Joints
    }

    /// Appends the filled-in template of the post.
    fn say(&self, key: &str, text: &mut String, value: impl Fn(&str) -> Option<String>) -> Result<(), Failure> {
        let filled = self.post.fill(key, value).unwrap_or_else(|| Ok(String::new()));
        let filled = filled.map_err(|name| {
            Failure::new(format!(
                "the post for {} needs {{{name}}} for `{key}`",
                self.form.dialect
            ))
        })?;
        for line in filled.lines().map(str::trim).filter(|line| !line.is_empty()) {
            text.push_str(line);
            text.push('\n');
        }
        Ok(())
    }

    fn comment(&self, words: &str) -> String {
        // round brackets and semicolons would end the comment
        let words: String = words.chars().filter(|c| !"();".contains(*c)).collect();
        let filled = self
            .post
            .fill("comment", |name| (name == "text").then(|| words.clone()));
        filled.and_then(Result::ok).unwrap_or_default()
    }

    fn head(&self, piece: &Piece, text: &mut String) -> Result<(), Failure> {
        let code = |key: &str| self.post.fill(key, |_| None).and_then(Result::ok);
        let mut tools = Vec::new();
        if self.compensates {
            tools.push(self.declaration(piece, 1, TOOL_LENGTH));
            if self.form.plant == Some(Plant::WrongH) {
                tools.push(self.declaration(piece, 2, WRONG_LENGTH));
            }
        }
        self.say("header", text, |name| match name {
            "title" => Some(self.comment(&piece.title)),
            "tools" => Some(tools.join("\n")),
            "units" => code("units-mm"),
            "feed_mode" => code("feed-per-minute"),
            "number" => Some("0001".to_owned()),
            "program" => Some(piece.name.to_owned()),
            "machine" => Some(self.machine.name.clone()),
            _ => None,
        })?;
        let shifted = self.form.plant == Some(Plant::ShiftG54);
        self.say("work-offset", text, |_| {
            Some(if shifted { "G55" } else { "G54" }.to_owned())
        })?;
        self.say("tool-change", text, |_| Some("1".to_owned()))?;
        self.say("spindle-clockwise", text, |_| Some(SPINDLE.to_string()))?;
        let on = match (self.leads_tip(), self.form.style) {
            _ if self.form.plant == Some(Plant::NoTcp) => "length-on",
            (false, _) => "length-on",
            (true, Style::Vectors) => "tcp-vectors-on",
            (true, _) => "tcp-words-on",
        };
        let tool = if self.form.plant == Some(Plant::WrongH) {
            "2"
        } else {
            "1"
        };
        self.say(on, text, |name| match name {
            "tool" => Some(tool.to_owned()),
            "tcp_on" => self.post.tcp_code(Some(self.machine), true),
            _ => None,
        })
    }

    fn tail(&self, text: &mut String) -> Result<(), Failure> {
        if self.leads_tip() && self.form.plant != Some(Plant::NoTcp) {
            self.say("tcp-off", text, |_| self.post.tcp_code(Some(self.machine), false))?;
        }
        self.say("spindle-stop", text, |_| None)?;
        self.say("footer", text, |_| Some(String::new()))
    }

    fn declaration(&self, piece: &Piece, tool: u32, length: f64) -> String {
        let shape = if piece.tool.ball { "ball" } else { "flat" };
        let size = if piece.tool.diameter > 0.0 {
            format!("{shape} diameter {} ", number(piece.tool.diameter))
        } else {
            String::new()
        };
        self.comment(&format!("trunnion: tool {tool} {size}length {}", number(length)))
    }

    fn vector(&self, axis: &Vec3, block: &mut String) {
        let words = self.post.fill("vector", |name| match name {
            "i" => Some(fixed(axis.x, 9)),
            "j" => Some(fixed(axis.y, 9)),
            "k" => Some(fixed(axis.z, 9)),
            _ => None,
        });
        let _ = write!(block, " {}", words.and_then(Result::ok).unwrap_or_default());
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
