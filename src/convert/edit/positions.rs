//! Absolute or incremental words: G90 or G91.
//!
//! A step is the difference of two absolute positions as they are written, so that rounding does not add up. What names a place by itself stays absolute:
//! the first position of an axis, drilling cycles, rotary axes, returns to a reference point, machine coordinates.
use super::edits::{Edits, decimals_of, number_of, rounded, written};
use super::kinds::{Kind, Said, has_lengths};
use super::survey::{Here, survey};
use super::{Change, Part, Positions, Proposal};
use crate::refuse::Refused;
use trunnion_dialect::{Action, Dialect};
use trunnion_interp::{ImplicitDecimals, Setup};
use trunnion_syntax::{Program, TextRange, Value, Word};

/// Digits that a computed number has at most.
const MOST_DECIMALS: usize = 6;

pub(super) fn propose(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    wanted: Positions,
    part: Option<Part>,
) -> Result<Proposal, Refused> {
    let code = |action: Action| dialect.codes().iter().any(|code| code.action == action);
    if !code(Action::Absolute) || !code(Action::Incremental) {
        return Err(Refused::new(
            "this control has no G90 and G91 for positions: it writes steps with letters of their own (U, W)",
        ));
    }
    let mut work = Work {
        program,
        dialect,
        setup,
        wanted,
        part,
        edits: Edits::default(),
        incremental: None,
        known: 0,
        last: None,
        changed: false,
        kept: false,
        unit_mm: 1.0,
    };
    let ran = survey(program, dialect, setup, |here| work.block(&Said::read(here, dialect)))?;
    if !work.changed {
        let name = match wanted {
            Positions::Absolute => "absolute",
            Positions::Incremental => "incremental",
        };
        return Err(Refused::nothing(format!("what may be {name} is so already")));
    }
    if let Some(block) = program.blocks().find(|block| {
        part.is_none_or(|part| part.has(block.id())) && !ran.has(block.id()) && has_lengths(block, dialect)
    }) {
        let message = "this block never runs, so where it starts is not known";
        return Err(Refused::at(program, block.id(), message));
    }
    let kept = "the first position of each axis, drilling cycles, rotary axes, machine coordinates and returns to a reference point stay as they are";
    Ok(Proposal {
        notes: work.kept.then(|| kept.to_owned()).into_iter().collect(),
        edits: work.edits.sorted(program),
        change: Change::nothing(1e-6, 1e-6, 1e-9),
    })
}

struct Work<'a> {
    program: &'a Program,
    dialect: &'a Dialect,
    setup: &'a Setup,
    wanted: Positions,
    /// The blocks that are written otherwise; all others keep their words.
    part: Option<Part>,
    edits: Edits,
    /// What the program after has in effect.
    incremental: Option<bool>,
    /// Axes whose positions are known without what nobody declares.
    known: u16,
    /// Zero point, tool length: what moves the coordinates.
    last: Option<Frame>,
    changed: bool,
    kept: bool,
    unit_mm: f64,
}

#[derive(PartialEq)]
struct Frame {
    offset: Option<String>,
    zero: [u64; 9],
    set_here: bool,
    length: (Option<u64>, trunnion_interp::LengthOf),
    tcp: bool,
    turned: bool,
    unit: u64,
}

impl Frame {
    fn of(here: &Here<'_>) -> Self {
        let state = here.is;
        Self {
            offset: state.zero.offset().map(str::to_owned),
            zero: state.zero.values().map(f64::to_bits),
            set_here: state.zero.is_set_here(),
            length: (state.length.mm().map(f64::to_bits), state.length.of()),
            tcp: state.tool_axis.tcp(),
            turned: here.turned,
            unit: state.coordinates.unit_mm().to_bits(),
        }
    }
}

/// Codes after which an axis is where the program has put it.
fn keeps_place(action: Action) -> bool {
    action.keeps_place()
        || matches!(
            action,
            Action::CompensationLeft
                | Action::CompensationRight
                | Action::NoMotion
                | Action::Declaration
                | Action::FrameReset
                | Action::RotationOff
                | Action::ScalingOff
                | Action::MirrorOff
                | Action::PolarOff
                | Action::ToolLengthOn
                | Action::ToolLengthOff
                | Action::WorkSystem
        )
}

impl Work<'_> {
    fn block(&mut self, said: &Said<'_, '_>) -> Result<(), Refused> {
        let here = said.here;
        let frame = Frame::of(here);
        if self.last.as_ref() != Some(&frame) {
            self.known = 0;
        }
        self.last = Some(frame);
        self.unit_mm = here.is.coordinates.unit_mm();
        let words: Vec<(Word, Kind)> = said
            .words()
            .filter(|(word, kind)| is_position(said, word, *kind))
            .collect();
        let stays = self.stays(said, &words)?;
        let before = self.incremental.unwrap_or(here.was.coordinates.incremental());
        let says = said.has(Action::Absolute) || said.has(Action::Incremental);
        let mode = match (words.is_empty(), stays) {
            // it names no position: what it says counts for the next
            (true, _) if says => here.is.coordinates.incremental(),
            (true, _) => before,
            (false, true) => here.is.coordinates.incremental(),
            (false, false) => self.wanted == Positions::Incremental,
        };
        self.write_mode(said, mode, before, &words)?;
        if !words.is_empty() && !stays && mode != here.is.coordinates.incremental() {
            self.rewrite(said, &words, mode)?;
        }
        self.kept |= stays && !words.is_empty() && self.part.is_none_or(|part| part.has(here.block.id()));
        self.learn(said, &words, mode);
        Ok(())
    }

    /// Whether the words of a block stay as they are.
    fn stays(&self, said: &Said<'_, '_>, words: &[(Word, Kind)]) -> Result<bool, Refused> {
        let here = said.here;
        let is_step = here.is.coordinates.incremental();
        let outside = self.part.is_some_and(|part| !part.has(here.block.id()));
        if outside || is_step == (self.wanted == Positions::Incremental) {
            return Ok(true);
        }
        let special = |action: Action| {
            matches!(
                action,
                Action::MachineCoordinates
                    | Action::ReferenceCheck
                    | Action::ReferenceReturn
                    | Action::ReferenceReturnOther
                    | Action::ReferenceFrom
                    | Action::DataEntry
                    | Action::PositionSet
                    | Action::LocalShift
                    | Action::ProgrammableShift
                    | Action::ProgrammableFrame
                    | Action::Dwell
                    | Action::ToolLengthOn
                    | Action::ToolLengthOff
            )
        };
        let understood = said.codes.iter().all(|coded| keeps_place(coded.code.action))
            && said.names.is_empty()
            && said.others.is_empty();
        let places = said.codes.iter().any(|coded| special(coded.code.action));
        let odd = words.iter().any(|(_, kind)| matches!(kind, Kind::Rotary | Kind::Level));
        let axes = words.iter().filter_map(|(_, kind)| match kind {
            Kind::Axis(axis) => Some(1u16 << axis),
            _ => None,
        });
        let named = axes.fold(0, |all, bit| all | bit);
        let open = named & !self.known != 0;
        let stays = places || odd || said.drills() || open || here.turned || !understood;
        if stays && is_step && !places && !words.is_empty() {
            let why = if said.drills() {
                "a drilling cycle with steps is not rewritten"
            } else if odd {
                "a step of a rotary axis is not rewritten: which way it turns to a position depends on the machine"
            } else if here.turned {
                "the coordinates are turned, scaled, mirrored or polar"
            } else if open {
                "where this step begins is unknown: program the axis absolutely first"
            } else {
                "this block does more than move the axes"
            };
            return said.refuse(words[0].0.range, why);
        }
        Ok(stays)
    }

    /// G90 or G91 where the program after needs it.
    fn write_mode(
        &mut self,
        said: &Said<'_, '_>,
        mode: bool,
        before: bool,
        words: &[(Word, Kind)],
    ) -> Result<(), Refused> {
        let code = if mode { "91" } else { "90" };
        let own = said
            .codes
            .iter()
            .filter(|coded| matches!(coded.code.action, Action::Absolute | Action::Incremental));
        let mut found = false;
        for coded in own {
            found = true;
            let is_step = coded.code.action == Action::Incremental;
            if is_step != mode {
                self.edits.set(self.program, coded.word.value_range, code)?;
                self.changed = true;
            }
        }
        self.incremental = Some(mode);
        if found || mode == before {
            return Ok(());
        }
        let Some((word, _)) = words.first() else { return Ok(()) };
        let at = word.range.start;
        self.changed = true;
        self.edits.set(
            self.program,
            TextRange::new(at, at),
            &format!("G{code}{}", blank(self.program, at)),
        )
    }

    /// Writes the positions of a block as steps, or its steps as positions.
    fn rewrite(&mut self, said: &Said<'_, '_>, words: &[(Word, Kind)], mode: bool) -> Result<(), Refused> {
        let here = said.here;
        self.changed = true;
        for (word, kind) in words {
            let Kind::Axis(axis) = *kind else { continue };
            let Some((_, range)) = number_of(self.program, word) else {
                let text = self.program.text(word.range);
                return said.refuse(
                    word.range,
                    format!("{text}: its value is computed, so it stays: write a number"),
                );
            };
            let (Some(from), Some(to)) = (here.was.position.get(axis), here.is.position.get(axis)) else {
                return said.refuse(word.range, "where this axis is, is unknown");
            };
            let size = self.size(axis);
            let exact = if mode { (to - from) / size } else { to / size };
            let old = self.program.text(range).into_owned();
            let mut decimals = decimals_of(&old);
            while decimals < MOST_DECIMALS && (rounded(exact, decimals) - exact).abs() > 1e-9 {
                decimals += 1;
            }
            if (rounded(exact, decimals) - exact).abs() > 5e-8 {
                return said.refuse(word.range, "this position has more digits than can be written");
            }
            let point = match self.setup.control.implicit_decimals {
                Some(ImplicitDecimals::LeastIncrement) => true,
                None if self.dialect.quirks.macro_b() => true,
                _ => old.ends_with('.'),
            };
            let text = written(&old, exact, decimals, decimals_of(&old), point);
            self.edits.set(self.program, range, &text)?;
        }
        Ok(())
    }

    /// mm of a unit of a word: a diameter counts twice.
    fn size(&self, axis: usize) -> f64 {
        if self.dialect.quirks.diameter && axis == 0 {
            self.unit_mm * 0.5
        } else {
            self.unit_mm
        }
    }

    /// Which axes are where the program has put them.
    fn learn(&mut self, said: &Said<'_, '_>, words: &[(Word, Kind)], mode: bool) {
        let here = said.here;
        let safe = said.codes.iter().all(|coded| keeps_place(coded.code.action))
            && said.names.is_empty()
            && said.others.is_empty();
        if !safe || said.drills() {
            self.known = 0;
            return;
        }
        for (word, kind) in words {
            let Kind::Axis(axis) = *kind else { continue };
            let absolute = !said.here.is.coordinates.incremental() || !mode;
            let number = number_of(self.program, word).is_some();
            if absolute && number && here.is.position.get(axis).is_some() {
                self.known |= 1 << axis;
            }
        }
    }
}

/// A coordinate that G90 and G91 concern.
fn is_position(said: &Said<'_, '_>, word: &Word, kind: Kind) -> bool {
    match kind {
        Kind::Axis(_) | Kind::Rotary => !matches!(word.value, Value::Call(..)),
        Kind::Level => said.drills(),
        _ => false,
    }
}

/// The blank that separates words at a place.
fn blank(program: &Program, at: u32) -> &'static str {
    let source = program.source();
    let before = (at as usize).checked_sub(1).and_then(|at| source.get(at));
    match before {
        Some(b' ' | b'\t' | b'\n' | b'\r') | None => " ",
        Some(_) => "",
    }
}
