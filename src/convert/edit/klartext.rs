//! Edits of Klartext: the unit, and a path that is shifted, scaled or mirrored. Straight lines, arcs, corners and tool calls are understood; cycles and
//! other sentences are refused by name.
use super::edits::{Edits, Track, decimals_of, rounded, written};
use super::shape::along;
use super::survey::survey;
use super::{Change, Edit, Proposal, Shape};
use crate::refuse::Refused;
use trunnion_dialect::Dialect;
use trunnion_interp::{LengthUnit, Setup};
use trunnion_syntax::{Block, Program, TextRange, TokenKind};

/// F of a program in inch is in tenths of an inch a minute (HEIDENHAIN TNC 640 user's manuals 34059x, feed rate F): mm.
const INCH_FEED_MM: f64 = 2.54;

/// What a block says: its names, each with the number that follows it directly, and the token after it.
struct Sentence {
    words: Vec<(String, TextRange, Option<TextRange>, Option<TokenKind>)>,
}

impl Sentence {
    fn read(program: &Program, block: &Block<'_>) -> Self {
        let table = program.tokens();
        let tokens: Vec<_> = block.tokens().map(|id| (table.kind(id), table.range(id))).collect();
        let mut words = Vec::new();
        for (place, (kind, range)) in tokens.iter().enumerate() {
            if *kind == TokenKind::Name {
                let next = tokens.get(place + 1);
                let number = next.filter(|next| next.0 == TokenKind::Number).map(|next| next.1);
                words.push((
                    program.text(*range).to_ascii_uppercase(),
                    *range,
                    number,
                    next.map(|next| next.0),
                ));
            }
        }
        Self { words }
    }

    fn head(&self) -> &str {
        self.words.first().map_or("", |word| word.0.as_str())
    }

    fn is_path(&self) -> bool {
        matches!(self.head(), "L" | "C" | "CC" | "CR" | "CT" | "RND" | "CHF")
    }
}

struct Work<'a> {
    program: &'a Program,
    edit: Edit,
    decimals: usize,
    edits: Edits,
    track: Track,
    changed: bool,
    unit_mm: f64,
    feed_mm: f64,
}

pub(super) fn propose(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    edit: Edit,
    decimals: Option<usize>,
) -> Result<Proposal, Refused> {
    let usual = match edit {
        Edit::Unit(LengthUnit::Inch) => 4,
        Edit::Positions(_) | Edit::Shape(Shape::Rotate(..)) => {
            return Err(Refused::new(
                "Klartext is not edited in this way: a step is written with I before the axis (IX), a turn with cycle 10 or TRANS ROTATION",
            ));
        }
        _ => 3,
    };
    let exact = matches!(edit, Edit::Shape(Shape::Shift(_) | Shape::Mirror(_)));
    let mut work = Work {
        program,
        edit,
        decimals: if exact { 6 } else { decimals.unwrap_or(usual) },
        edits: Edits::default(),
        track: Track::default(),
        changed: false,
        unit_mm: 1.0,
        feed_mm: 1.0,
    };
    let ran = survey(program, dialect, setup, |here| {
        work.unit_mm = here.is.coordinates.unit_mm();
        work.feed_mm = here.is.feed.unit_mm();
        let plane = along(here.is.coordinates.plane());
        work.block(&here.block, plane)
    })?;
    // the last block names the unit too, and does not run after M30
    for block in program.blocks() {
        work.unit(&Sentence::read(program, &block))?;
    }
    if !work.changed {
        return Err(Refused::nothing("no word of the program would change"));
    }
    let unseen = |block: &Block<'_>| !ran.has(block.id()) && Sentence::read(program, block).is_path();
    if let Some(block) = program.blocks().find(unseen) {
        return Err(Refused::at(
            program,
            block.id(),
            "this block never runs, so where its words lead is not known",
        ));
    }
    let new_unit = match edit {
        Edit::Unit(unit) => unit.mm(),
        _ => work.unit_mm,
    };
    let end_mm = if exact {
        1e-6
    } else {
        new_unit * 0.5 * 10f64.powi(-(work.decimals as i32)) * 1.000_1 + 1e-9
    };
    let mut change = Change::nothing(end_mm, 10.0 * end_mm, 5.1e-6);
    let mut notes = Vec::new();
    match edit {
        Edit::Unit(_) => {
            change.other_unit = true;
            notes.push("lengths and radii in the tool table are not part of the program".to_owned());
        }
        Edit::Shape(Shape::Shift(by)) => change.shift = by.map(|by| by * work.unit_mm),
        Edit::Shape(Shape::Scale(factor)) => {
            for axis in 0..3 {
                change.linear[axis][axis] = factor;
            }
        }
        Edit::Shape(Shape::Mirror(axis)) => {
            change.linear[axis][axis] = -1.0;
            notes.push("climb milling becomes conventional milling, because the spindle turns as before".to_owned());
        }
        _ => {}
    }
    if !change.other_unit {
        notes.push("BLK FORM stays as it is; check the program again for travel, clamps and stock".to_owned());
    }
    Ok(Proposal {
        edits: work.edits.sorted(program),
        change,
        notes,
    })
}

impl Work<'_> {
    fn block(&mut self, block: &Block<'_>, along: usize) -> Result<(), Refused> {
        let said = Sentence::read(self.program, block);
        let is_unit = matches!(self.edit, Edit::Unit(_));
        match said.head() {
            "" | "M" | "LBL" | "STOP" | "BEGIN" | "END" => Ok(()),
            "CALL" if said.words.get(1).is_some_and(|word| word.0 == "LBL") => Ok(()),
            // another preset: the number of a row in a table
            "CYCL" if is_preset(self.program, block) => Ok(()),
            "BLK" if !is_unit => Ok(()),
            "BLK" => said.words.iter().skip(2).try_for_each(|word| match word.2 {
                Some(range) if matches!(word.0.as_str(), "X" | "Y" | "Z") => self.length(range),
                _ => Ok(()),
            }),
            "TOOL" => said
                .words
                .iter()
                .skip(2)
                .try_for_each(|word| match (word.0.as_str(), word.2) {
                    ("DL" | "DR" | "L" | "R", Some(range)) if is_unit => self.length(range),
                    ("F", Some(range)) if is_unit => self.feed(range),
                    _ => Ok(()),
                }),
            "L" | "C" | "CC" | "CR" | "CT" | "RND" | "CHF" => self.path(&said, along),
            head => {
                let message = format!("{head}: what its words are is not known here, so the program is not edited");
                Err(Refused::range(self.program, said.words[0].1, message))
            }
        }
    }

    /// MM or INCH of the first and the last block.
    fn unit(&mut self, said: &Sentence) -> Result<(), Refused> {
        let Edit::Unit(unit) = self.edit else { return Ok(()) };
        if !matches!(said.head(), "BEGIN" | "END") {
            return Ok(());
        }
        let (from, to) = match unit {
            LengthUnit::Inch => ("MM", "INCH"),
            LengthUnit::Millimetre => ("INCH", "MM"),
        };
        if let Some(word) = said.words.last().filter(|word| word.0 == from) {
            self.changed = true;
            self.edits.set(self.program, word.1, to)?;
        }
        Ok(())
    }

    fn path(&mut self, said: &Sentence, along: usize) -> Result<(), Refused> {
        let is_corner = matches!(said.head(), "RND" | "CHF");
        for (place, (name, range, number, next)) in said.words.iter().enumerate() {
            let axis = ["X", "Y", "Z"]
                .iter()
                .position(|axis| name.trim_start_matches('I') == *axis && name.len() <= 2);
            if let Some(axis) = axis {
                let Some(number) = *number else {
                    let message = format!("{name}: its value is computed, so it is not changed: write a number");
                    return Err(Refused::range(self.program, *range, message));
                };
                self.coordinate(*range, number, (axis, name.starts_with('I'), along))?;
                continue;
            }
            let signed = number.is_some_and(|range| self.program.text(range).starts_with(['+', '-']));
            match (name.as_str(), *number) {
                ("R", Some(number)) if is_corner || signed => self.length(number)?,
                ("CHF", Some(number)) if place == 0 => self.length(number)?,
                ("F", Some(number)) => self.feed(number)?,
                ("RL", None) => self.turned(*range, along, "RR")?,
                ("RR", None) => self.turned(*range, along, "RL")?,
                ("DR", None) if *next == Some(TokenKind::Plus) => {
                    self.turned(TextRange::new(range.end, range.end + 1), along, "-")?;
                }
                ("DR", None) if *next == Some(TokenKind::Minus) => {
                    self.turned(TextRange::new(range.end, range.end + 1), along, "+")?;
                }
                ("R" | "M", Some(_)) | ("FMAX" | "F" | "FAUTO" | "AUTO" | "MAX", None) => {}
                ("L" | "C" | "CC" | "CR" | "CT" | "RND" | "CHF", _) if place == 0 => {}
                _ => {
                    let text = self.program.text(number.map_or(*range, |number| range.cover(number)));
                    let message = format!("{text}: what this word is, is not known here, so the program is not edited");
                    return Err(Refused::range(self.program, *range, message));
                }
            }
        }
        Ok(())
    }

    /// The other direction in a mirror image.
    fn turned(&mut self, range: TextRange, along: usize, other: &str) -> Result<(), Refused> {
        match self.edit {
            Edit::Shape(Shape::Mirror(axis)) if axis != along => self.edits.set(self.program, range, other),
            _ => Ok(()),
        }
    }

    fn coordinate(
        &mut self,
        name: TextRange,
        range: TextRange,
        (axis, is_step, along): (usize, bool, usize),
    ) -> Result<(), Refused> {
        let (factor, add) = match self.edit {
            Edit::Unit(unit) => (self.unit_mm / unit.mm(), 0.0),
            Edit::Shape(Shape::Shift(by)) => (1.0, by[axis]),
            Edit::Shape(Shape::Scale(factor)) => (factor, 0.0),
            Edit::Shape(Shape::Mirror(mirrored)) if mirrored == axis && axis == along => {
                let message = "this axis is along the tool: mirrored, it would cut from the other side";
                return Err(Refused::range(self.program, name, message));
            }
            Edit::Shape(Shape::Mirror(mirrored)) if mirrored == axis => (-1.0, 0.0),
            _ => (1.0, 0.0),
        };
        let add = if is_step { 0.0 } else { add };
        let Some((old, value)) = self.number(range) else {
            return Ok(());
        };
        let new = value * factor + add;
        let decimals = self.decimals;
        let result = if is_step {
            self.track.step(axis, new, decimals)
        } else {
            self.track.absolute(axis, new, decimals)
        };
        if factor == 1.0 && add == 0.0 {
            return Ok(());
        }
        self.put(range, &old, result, new)
    }

    /// A length without a direction.
    fn length(&mut self, range: TextRange) -> Result<(), Refused> {
        let factor = match self.edit {
            Edit::Unit(unit) => self.unit_mm / unit.mm(),
            Edit::Shape(Shape::Scale(factor)) => factor,
            _ => 1.0,
        };
        let Some((old, value)) = self.number(range).filter(|_| factor != 1.0) else {
            return Ok(());
        };
        let new = value * factor;
        self.put(range, &old, new, new)
    }

    fn feed(&mut self, range: TextRange) -> Result<(), Refused> {
        let Edit::Unit(unit) = self.edit else { return Ok(()) };
        let target = match unit {
            LengthUnit::Inch => INCH_FEED_MM,
            LengthUnit::Millimetre => 1.0,
        };
        let factor = self.feed_mm / target;
        let Some((old, value)) = self.number(range).filter(|_| factor != 1.0) else {
            return Ok(());
        };
        let whole = (value * factor).abs().max(1e-9).log10().floor() as i32 + 1;
        let decimals = (6 - whole).clamp(0, 9) as usize;
        self.changed = true;
        let text = commas(&old, written(&old, value * factor, decimals, 0, false));
        self.edits.set(self.program, range, &text)
    }

    fn number(&self, range: TextRange) -> Option<(String, f64)> {
        let old = self.program.text(range).into_owned();
        let value = old.replace(',', ".").parse().ok()?;
        Some((old, value))
    }

    fn put(&mut self, range: TextRange, old: &str, result: f64, plain: f64) -> Result<(), Refused> {
        self.changed = true;
        let decimals = self.decimals;
        let exact = !matches!(self.edit, Edit::Unit(_));
        let keep = if exact { decimals_of(&old.replace(',', ".")) } else { 0 };
        // a radius or step keeps its sign, also a plus
        let write = |value: f64| {
            commas(
                old,
                written(&signed(old), rounded(value, decimals), decimals, keep, false),
            )
        };
        let (text, plain) = (write(result), write(plain));
        self.edits.put(self.program, range, text, plain)
    }
}

/// CYCL DEF 247: it activates a preset, and has no word but the number of that.
fn is_preset(program: &Program, block: &Block<'_>) -> bool {
    let text = program.text(block.range()).to_ascii_uppercase();
    let mut words = text.split_whitespace().skip_while(|word| *word != "DEF");
    words.nth(1) == Some("247")
}

/// A number that was written with a sign gets one.
fn signed(old: &str) -> String {
    match old.strip_prefix('-') {
        Some(rest) => format!("+{rest}"),
        None => old.to_owned(),
    }
}

/// With the comma of the old number in the place of the point.
fn commas(old: &str, new: String) -> String {
    if old.contains(',') { new.replace('.', ",") } else { new }
}
