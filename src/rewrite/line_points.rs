//! A line in pieces: where its points are, in the digits of the program.
use crate::Change;
use crate::slots::{Scheme, Styles};
use crate::style::NumberStyle;
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::Position;
use trunnion_machine::{Leg, Machine, Stance, inverse, tip_deviation};
use trunnion_syntax::{Decimal, Program};

/// Most pieces of one line.
const MOST_PIECES: usize = 10_000;

/// Share of the tolerance that is used: the rest is for rounding.
const SHARE: f64 = 0.95;

/// So often the deviation of pieces is halved to make them even.
const EVENING: usize = 6;

/// So often the length of a piece is guessed from its deviation before it is halved.
const GUESSES: usize = 6;

/// How long a piece may be, if one of this length deviates by this share of what is allowed: the deviation grows with the square of the length.
fn as_far(length: f64, ratio: f64) -> f64 {
    length / ratio.max(1e-6).sqrt()
}

/// A line that strays, and what its words depend on.
pub(crate) struct Line {
    pub(crate) leg: Leg,
    /// X Y Z and the two rotary axes as programmed at its end, mm and deg.
    pub(crate) words: [Option<f64>; 5],
    pub(crate) unit_mm: f64,
    pub(crate) incremental: bool,
    pub(crate) undeclared: bool,
}

/// Writes pieces of lines.
pub(crate) struct Writer<'a> {
    pub(crate) program: &'a Program,
    pub(crate) machine: &'a Machine,
    pub(crate) scheme: Scheme,
    pub(crate) styles: Styles,
    pub(crate) tolerance_mm: f64,
    /// What ends a line of the program.
    pub(crate) newline: &'static str,
}

/// The end of a piece: its words as text, and where they take the machine.
pub(crate) struct End {
    pub(crate) texts: [Option<String>; 5],
    pub(crate) stance: Stance,
    /// The share of the line at which its rotary axes are there, as they are written.
    pub(crate) share: f64,
}

pub(crate) fn refused(why: impl Into<String>) -> Change {
    Change::Refused(why.into())
}

/// X Y Z and the two rotary axes (as indices of axis letters) of a programmed position, mm and deg.
pub(crate) fn programmed(position: &Position, rotary: [Option<usize>; 2]) -> [Option<f64>; 5] {
    [Some(0), Some(1), Some(2), rotary[0], rotary[1]].map(|axis| position.get(axis?))
}

/// Where the tip is depends on what is not declared.
pub(crate) fn undeclared_path() -> Change {
    Change::Possible(
        "the path of the tip depends on work offset and tool length, which are not declared: declare them in trunnion.toml or take \
         them as zero with --assume work-offset,tool-length"
            .into(),
    )
}

impl Writer<'_> {
    pub(crate) fn text(&self, index: usize, value: f64, unit_mm: f64) -> Option<String> {
        let value = if index < 3 { value / unit_mm } else { value };
        let style = self.styles[index]?;
        // points in between need the digits that posts write, also where the program has round numbers only
        let least = if index < 3 && unit_mm > 1.0 { 4 } else { 3 };
        let style = NumberStyle {
            decimals: style.decimals.max(least),
            ..style
        };
        Some(style.write(value, false))
    }

    /// As few ends as the tolerance needs, at the smallest deviation that this number allows: so no piece is much shorter than the others.
    pub(crate) fn even_ends(&self, line: &Line) -> Result<Vec<End>, Change> {
        let mut ends = self.ends(line, self.tolerance_mm, MOST_PIECES)?;
        let (mut low, mut high) = (0.0, self.tolerance_mm);
        for _ in 0..EVENING {
            let middle = 0.5 * (low + high);
            match self.ends(line, middle, ends.len()) {
                Ok(found) => (ends, high) = (found, middle),
                Err(_) => low = middle,
            }
        }
        Ok(ends)
    }

    /// The ends of all pieces but the last, each as far as the tolerance allows, mm.
    fn ends(&self, line: &Line, tolerance_mm: f64, most: usize) -> Result<Vec<End>, Change> {
        let unknown = || refused("a position is unknown");
        let (Some(start), Ok(end)) = (&line.leg.start, &line.leg.end) else {
            return Err(unknown());
        };
        let mut ends: Vec<End> = Vec::new();
        let (mut at, mut from) = (0.0, *start);
        let mut length = None;
        loop {
            let (fits, ratio) = self.near(line, (&from, at), (end, 1.0), tolerance_mm);
            if fits {
                return Ok(ends);
            }
            // pieces are about as long as the one before
            let first = length.unwrap_or_else(|| as_far(1.0 - at, ratio));
            let Some(candidate) = self.farthest(line, [start, end], (&from, at), first, tolerance_mm)? else {
                return Err(Change::Possible(format!(
                    "no point keeps the tip within {} mm with the digits of the program (--tolerance-mm)",
                    self.tolerance_mm
                )));
            };
            length = Some(candidate.share - at);
            (at, from) = (candidate.share, candidate.stance);
            ends.push(candidate);
            if ends.len() > most {
                return Err(Change::Possible(format!(
                    "it would take more than {MOST_PIECES} points (--tolerance-mm)"
                )));
            }
        }
    }

    /// The farthest end of a piece that begins at a share of the line, to a thousandth of what is left of it; `None`: none is near enough.
    /// `next`: where to look first.
    fn farthest(
        &self,
        line: &Line,
        ends: [&Stance; 2],
        (from, at): (&Stance, f64),
        mut next: f64,
        tolerance_mm: f64,
    ) -> Result<Option<End>, Change> {
        let left = 1.0 - at;
        let step = 1e-3 * left;
        let (mut low, mut high) = (0.0, left);
        let mut best = None;
        for look in 0.. {
            next = if look < GUESSES { next } else { 0.5 * (low + high) };
            next = next.clamp(low + 0.5 * step, high - 0.5 * step);
            let candidate = self.end(line, ends, at + next)?;
            let (fits, ratio) = self.near(line, (from, at), (&candidate.stance, candidate.share), tolerance_mm);
            // a share that is rounded to the digits of the program may be the end of the line, or beyond it
            if fits && candidate.share > at && candidate.share < 1.0 {
                (low, best) = (next, Some(candidate));
            } else {
                high = next;
            }
            if high - low <= step {
                break;
            }
            next = as_far(next, ratio);
        }
        Ok(best)
    }

    /// Whether a piece from one share of the line to another keeps the tip near the segment, as `certify` will judge it; and its deviation as a
    /// share of what is allowed.
    fn near(
        &self,
        line: &Line,
        (from, was): (&Stance, f64),
        (to, is): (&Stance, f64),
        tolerance_mm: f64,
    ) -> (bool, f64) {
        let never = (false, f64::INFINITY);
        let (Some(start), Ok(end)) = (&line.leg.start, &line.leg.end) else {
            return never;
        };
        let off = |stance: &Stance, share: f64| (stance.tip - (start.tip + (end.tip - start.tip) * share)).norm();
        let ends = off(from, was).max(off(to, is));
        let room = SHARE * tolerance_mm - ends;
        let mut piece = line.leg.clone();
        for (change, &joint) in piece.rotary_change.iter_mut().zip(&self.machine.rotary) {
            *change = (to.joints[joint] - from.joints[joint]).abs();
        }
        piece.start = Some(*from);
        piece.end = Ok(*to);
        match tip_deviation(self.machine, &piece, room.max(0.0)) {
            Some(found) if room > 0.0 => (found.bound_mm <= room, found.sampled_mm / room),
            _ => never,
        }
    }

    /// The end of a piece at a share of the line, in the digits of the program.
    fn end(&self, line: &Line, [start, end]: [&Stance; 2], share: f64) -> Result<End, Change> {
        let mut joints = end.joints;
        let mut texts: [Option<String>; 5] = Default::default();
        let parsed = |text: &str| Decimal::parse(text.as_bytes()).map(Decimal::to_f64);
        let never = |index: usize| {
            refused(format!(
                "the program never writes {} as a plain number",
                self.scheme.name(index)
            ))
        };
        for (index, &joint) in self.machine.rotary.iter().enumerate() {
            let turn = deg(end.joints[joint] - start.joints[joint]);
            if turn == 0.0 {
                continue;
            }
            let word = line.words[3 + index].ok_or_else(|| refused("a rotary position is unknown"))?;
            let text = self.text(3 + index, word + (share - 1.0) * turn, line.unit_mm);
            let text = text.ok_or_else(|| never(3 + index))?;
            let value = parsed(&text).ok_or_else(|| refused("a number has too many digits"))?;
            joints[joint] = end.joints[joint] + rad(value - word);
            texts[3 + index] = Some(text);
        }
        let (mut dot, mut square) = (0.0, 0.0);
        for &joint in &self.machine.rotary {
            let whole = end.joints[joint] - start.joints[joint];
            dot += whole * (joints[joint] - start.joints[joint]);
            square += whole * whole;
        }
        let share = if square > 0.0 { dot / square } else { share };
        let tip = start.tip + (end.tip - start.tip) * share;
        let zero: Vec3 = Vec3::new(
            line.leg.motion.zero[0],
            line.leg.motion.zero[1],
            line.leg.motion.zero[2],
        );
        inverse(self.machine, &mut joints, &(tip + zero), end.tool_length)
            .ok_or_else(|| refused("the linear axes cannot follow"))?;
        for (index, letter) in b"XYZ".iter().enumerate() {
            let Some(joint) = self.machine.joint(*letter) else {
                continue;
            };
            let word = line.words[index].ok_or_else(|| refused(format!("{} is unknown", char::from(*letter))))?;
            let value = word + joints[joint] - end.joints[joint];
            let text = self.text(index, value, line.unit_mm).ok_or_else(|| never(index))?;
            let value = parsed(&text).ok_or_else(|| refused("a number has too many digits"))? * line.unit_mm;
            joints[joint] = end.joints[joint] + value - word;
            texts[index] = Some(text);
        }
        Ok(End {
            texts,
            stance: Stance::at(self.machine, &joints, end.tool_length, &zero),
            share,
        })
    }
}
