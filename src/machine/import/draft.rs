//! A machine file before it is written: what is known about each axis, and what is not.
use super::Imported;
use std::fmt::Write;

/// One axis; what is `None` is not known.
#[derive(Clone, Debug, Default)]
pub(super) struct DraftAxis {
    pub(super) letter: char,
    pub(super) follow: Option<char>,
    pub(super) rotary: bool,
    /// `table` or `head`; of a linear axis it has no part in the motion.
    pub(super) side: Option<&'static str>,
    pub(super) dir: Option<[f64; 3]>,
    /// mm.
    pub(super) point: Option<[f64; 3]>,
    pub(super) sign: Option<i8>,
    /// deg.
    pub(super) hold: Option<f64>,
    /// mm or deg.
    pub(super) limits: Option<[f64; 2]>,
    /// mm/s or deg/s.
    pub(super) vmax: Option<f64>,
    /// mm/s^2 or deg/s^2.
    pub(super) amax: Option<f64>,
    pub(super) notes: Vec<String>,
}

/// The whole machine.
#[derive(Clone, Debug, Default)]
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) sources: Vec<String>,
    /// From workpiece to tool.
    pub(super) axes: Vec<DraftAxis>,
    pub(super) family: &'static str,
    /// The control keeps the tip on its path; orientation joint by joint.
    pub(super) tcp: bool,
    /// What is unknown about the machine as a whole (`order`).
    pub(super) unknown: Vec<&'static str>,
    pub(super) open: Vec<String>,
}

impl DraftAxis {
    /// A linear axis along the direction that its letter usually has.
    pub(super) fn linear(letter: char) -> Self {
        Self {
            letter,
            side: Some("head"),
            dir: Some(usual(letter)),
            sign: Some(1),
            notes: vec!["side assumed: it does not affect the motion".to_owned()],
            ..Self::default()
        }
    }
    /// A rotary axis about the direction that its letter usually has.
    pub(super) fn rotary(letter: char, side: &'static str, point: Option<[f64; 3]>, sign: Option<i8>) -> Self {
        Self {
            letter,
            rotary: true,
            side: Some(side),
            dir: Some(usual(letter)),
            point,
            sign,
            ..Self::default()
        }
    }
    /// A rotary axis of which only the letter is known.
    pub(super) fn unknown_rotary(letter: char) -> Self {
        Self {
            letter,
            rotary: true,
            ..Self::default()
        }
    }
    /// The unknown keys.
    fn unknown(&self) -> Vec<&'static str> {
        if self.follow.is_some() {
            return Vec::new();
        }
        let mut keys = Vec::new();
        let mut add = |missing: bool, key| {
            if missing {
                keys.push(key);
            }
        };
        add(self.side.is_none(), "side");
        add(self.dir.is_none(), "dir");
        add(self.rotary && self.point.is_none(), "point");
        add(self.sign.is_none(), "sign");
        keys
    }
}

/// The direction that ISO 841 gives a letter.
pub(super) fn usual(letter: char) -> [f64; 3] {
    match letter {
        'X' | 'U' | 'A' => [1.0, 0.0, 0.0],
        'Y' | 'V' | 'B' => [0.0, 1.0, 0.0],
        _ => [0.0, 0.0, 1.0],
    }
}

impl Draft {
    /// The file and what is missing.
    pub(super) fn finish(mut self) -> Imported {
        for axis in &self.axes {
            let keys = axis.unknown();
            if !keys.is_empty() {
                self.open.push(format!(
                    "axis {}: {} unknown; the file does not load until they are filled in",
                    axis.letter,
                    keys.join(", ")
                ));
            }
        }
        for key in &self.unknown {
            self.open.push(format!(
                "{key}: unknown; the file does not load until this is corrected"
            ));
        }
        let mut text = String::new();
        for line in &self.open {
            line_of(&mut text, &format!("# open: {line}"));
        }
        line_of(
            &mut text,
            "# Compare every axis with the machine (`trunnion machine show`), then add [[check]] rows with measured poses.",
        );
        line_of(&mut text, "schema = \"ncmachine/1\"");
        line_of(&mut text, &format!("name = {}", quoted(&self.name)));
        line_of(&mut text, "units = { length = \"mm\", angle = \"deg\", time = \"s\" }");
        if !self.unknown.is_empty() {
            let keys: Vec<String> = self.unknown.iter().map(|key| quoted(key)).collect();
            line_of(&mut text, &format!("unknown = [{}]", keys.join(", ")));
        }
        line_of(&mut text, "sources = [");
        for source in &self.sources {
            line_of(&mut text, &format!("  {},", quoted(source)));
        }
        line_of(
            &mut text,
            "]\n\n[spindle]\ntool_axis = [0, 0, 1]\ngauge_point = [0, 0, 0]",
        );
        for axis in &self.axes {
            text.push('\n');
            axis.write(&mut text);
        }
        line_of(&mut text, "\n[control]");
        line_of(&mut text, &format!("family = {}", quoted(self.family)));
        if self.tcp {
            line_of(
                &mut text,
                "tcp = { path = \"tip-linear\", orientation = \"joint\", feed = \"tip\" }",
            );
        }
        Imported {
            toml: text,
            open: self.open,
        }
    }
}

impl DraftAxis {
    fn write(&self, text: &mut String) {
        line_of(text, "[[axis]]");
        line_of(text, &format!("letter = \"{}\"", self.letter));
        if let Some(leader) = self.follow {
            line_of(text, &format!("follow = \"{leader}\""));
        }
        line_of(
            text,
            &format!("kind = \"{}\"", if self.rotary { "rotary" } else { "linear" }),
        );
        if let Some(side) = self.side {
            line_of(text, &format!("side = \"{side}\""));
        }
        if let Some(dir) = self.dir {
            line_of(text, &format!("dir = {}", vector(dir)));
        }
        if let (true, Some(point)) = (self.rotary, self.point) {
            line_of(text, &format!("point = {}", vector(point)));
        }
        if let Some(sign) = self.sign {
            line_of(text, &format!("sign = {sign}"));
        }
        let keys: Vec<String> = self.unknown().iter().map(|key| quoted(key)).collect();
        if !keys.is_empty() {
            line_of(text, &format!("unknown = [{}]", keys.join(", ")));
        }
        if let Some(value) = self.hold {
            line_of(text, &format!("hold = {}", plain(value)));
        }
        if let Some([low, high]) = self.limits {
            line_of(text, &format!("limits = [{}, {}]", plain(low), plain(high)));
        }
        let limits = [("vmax", self.vmax), ("amax", self.amax)];
        let limits: Vec<String> = limits
            .iter()
            .filter_map(|(key, value)| Some(format!("{key} = {}", plain((*value)?))))
            .collect();
        if !limits.is_empty() {
            line_of(text, &format!("dyn = {{ {} }}", limits.join(", ")));
        }
        if !self.notes.is_empty() {
            line_of(text, &format!("note = {}", quoted(&self.notes.join("; "))));
        }
    }
}

fn line_of(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// A TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => {
                // writing to a String cannot fail
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A number as TOML reads it back, bit for bit, without digits that only binary fractions have.
fn plain(value: f64) -> String {
    let short = format!("{value:.9}");
    let short = short.trim_end_matches('0').trim_end_matches('.');
    let text = if short
        .parse::<f64>()
        .is_ok_and(|back| (back - value).abs() <= 1e-12 * value.abs())
    {
        short.to_owned()
    } else {
        format!("{value}")
    };
    if text == "-0" { "0".to_owned() } else { text }
}

fn vector(v: [f64; 3]) -> String {
    format!("[{}, {}, {}]", plain(v[0]), plain(v[1]), plain(v[2]))
}
