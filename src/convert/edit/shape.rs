//! A path that is shifted, scaled, mirrored or turned.
use super::edits::{Edits, Track, decimals_of, number_of, rounded, written};
use super::kinds::{Kind, Said, has_lengths};
use super::survey::survey;
use super::turn::Turn;
use super::{Part, Proposal, Shape, claim};
use crate::refuse::Refused;
use trunnion_dialect::{Action, Code, CodeKind, Dialect, Plane};
use trunnion_interp::{ImplicitDecimals, Setup};
use trunnion_syntax::{Address, Program, TextRange, Word};

const NOT_KNOWN: &str = "how its words move with the part is not known here";
pub(super) const LETTERS: [char; 3] = ['X', 'Y', 'Z'];

pub(super) fn propose(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    shape: Shape,
    decimals: Option<usize>,
    part: Option<Part>,
) -> Result<Proposal, Refused> {
    claim::possible(dialect, shape)?;
    let mut work = Work {
        program,
        dialect,
        setup,
        shape,
        part,
        least: decimals,
        decimals: 0,
        edits: Edits::default(),
        track: Track::default(),
        unit_mm: None,
        turn: Turn::default(),
        compensated: false,
        taps: false,
    };
    work.decimals = work.digits();
    let within = |block| part.is_none_or(|part| part.has(block));
    let ran = survey(program, dialect, setup, |here| {
        if within(here.block.id()) {
            work.block(&Said::read(here, dialect))
        } else {
            Ok(())
        }
    })?;
    if let Some(block) = program
        .blocks()
        .find(|block| within(block.id()) && !ran.has(block.id()) && has_lengths(block, dialect))
    {
        let message = "this block never runs, so where its words lead is not known";
        return Err(Refused::at(program, block.id(), message));
    }
    let Some(unit_mm) = work.unit_mm else {
        return Err(Refused::nothing("there are no coordinates"));
    };
    let change = work.change(unit_mm);
    let notes = work.notes();
    let edits = work.edits.sorted(program);
    if edits.is_empty() {
        return Err(Refused::nothing("no word of the program would change"));
    }
    Ok(Proposal { edits, change, notes })
}

pub(super) struct Work<'a> {
    pub(super) program: &'a Program,
    dialect: &'a Dialect,
    setup: &'a Setup,
    pub(super) shape: Shape,
    /// The blocks that are moved; all others stay.
    pub(super) part: Option<Part>,
    least: Option<usize>,
    pub(super) decimals: usize,
    pub(super) edits: Edits,
    pub(super) track: Track,
    unit_mm: Option<f64>,
    turn: Turn,
    pub(super) compensated: bool,
    pub(super) taps: bool,
}

/// Codes that leave the meaning of coordinates as it is, or give it back.
fn fine(code: &Code) -> bool {
    let action = code.action;
    action.keeps_place() && !matches!(action, Action::Polynomial | Action::ArcThroughPoint | Action::Pole)
        || matches!(
            action,
            Action::CompensationLeft
                | Action::CompensationRight
                | Action::ToolLengthOn
                | Action::ToolLengthOff
                | Action::TcpOn
                | Action::TcpVectorOn
                | Action::TcpOff
                | Action::MachineCoordinates
                | Action::WorkSystem
                | Action::WorkOffsetNone
                | Action::ToolChange
                | Action::FrameReset
                | Action::RotationOff
                | Action::ScalingOff
                | Action::MirrorOff
                | Action::PolarOff
                | Action::ReferenceReturn
                | Action::ReferenceReturnOther
                | Action::NoMotion
                | Action::Declaration
                | Action::TurningCycle
                | Action::FacingCycle
        )
        || action == Action::SubprogramCall && code.kind == CodeKind::M
}

/// The axis along the tool.
pub(super) fn along(plane: Plane) -> usize {
    match plane {
        Plane::Xy => 2,
        Plane::Zx => 1,
        Plane::Yz => 0,
    }
}

impl Work<'_> {
    /// Digits after the point of what is rounded.
    fn digits(&self) -> usize {
        let mut most = 3;
        for block in self.program.blocks() {
            for word in block.words() {
                if matches!(word.address, Address::Letter(b'X'..=b'Z'))
                    && let Some((_, range)) = number_of(self.program, &word)
                {
                    most = most.max(decimals_of(&self.program.text(range)));
                }
            }
        }
        let shift = match self.shape {
            Shape::Shift(by) => by.iter().map(|by| decimals_of(&by.to_string())).max().unwrap_or(0),
            _ => 0,
        };
        let exact = matches!(self.shape, Shape::Shift(_) | Shape::Mirror(_));
        let least = self.least.filter(|_| !exact).unwrap_or(0);
        if least > 0 { least } else { most.max(shift).min(9) }
    }

    fn block(&mut self, said: &Said<'_, '_>) -> Result<(), Refused> {
        let here = said.here;
        let words: Vec<(Word, Kind)> = said.words().collect();
        said.understood(
            |code| {
                fine(code)
                    || matches!(code.action, Action::PositionSet) && words.is_empty()
                    // the drilling cycles of LinuxCNC, which its own interpreter runs
                    || code.action == Action::CannedCycle && self.dialect.quirks.rs274() && code.id != "G87"
            },
            NOT_KNOWN,
        )?;
        self.codes(said)?;
        self.taps |= said.has(Action::TapCycle) || said.has(Action::TapLeftCycle);
        let moving = words
            .iter()
            .any(|(_, kind)| !matches!(kind, Kind::Feed | Kind::Plain | Kind::Tolerance));
        if !moving {
            return Ok(());
        }
        if here.turned {
            return said.refuse(
                words[0].0.range,
                "the coordinates are turned, scaled, mirrored or polar here: edit the program without that",
            );
        }
        let unit = here.is.coordinates.unit_mm();
        if *self.unit_mm.get_or_insert(unit) != unit {
            return said.refuse(
                words[0].0.range,
                "the program changes between mm and inch: write it in one unit first (--unit)",
            );
        }
        if said.has(Action::MachineCoordinates) {
            return Ok(());
        }
        if said.has(Action::ReferenceReturn) || said.has(Action::ReferenceReturnOther) {
            return self.on_the_way(said, &words);
        }
        let pecks = matches!(here.is.motion, Some(Action::PeckCycle | Action::ChipBreakCycle));
        // which of its own cycles runs, and with that clearance, LinuxCNC knows
        let pecks = pecks || said.drills() && self.dialect.quirks.rs274();
        if pecks && self.size() != 1.0 {
            return said.refuse(
                words[0].0.range,
                "the clearance of a peck cycle is a parameter of the control, which is not scaled",
            );
        }
        if let Shape::Rotate(axis, degrees) = self.shape {
            let mut turn = std::mem::take(&mut self.turn);
            let done = turn.block(self, said, &words, (axis, degrees));
            self.turn = turn;
            return done;
        }
        words.iter().try_for_each(|(word, kind)| self.word(said, word, *kind))
    }

    /// The intermediate point of a return to a reference point.
    fn on_the_way(&self, said: &Said<'_, '_>, words: &[(Word, Kind)]) -> Result<(), Refused> {
        for (word, kind) in words {
            let (Kind::Axis(axis) | Kind::Step(axis)) = *kind else {
                continue;
            };
            let stays = said.is_step(word, *kind)
                && (matches!(self.shape, Shape::Shift(_))
                    || number_of(self.program, word).is_some_and(|(value, _)| value == 0.0));
            if !stays && (axis > 2 || self.touches(axis)) {
                let message = "the intermediate point of a return to the reference point is not moved: write it as a step of 0 (G91 G28 Z0)";
                return said.refuse(word.range, message);
            }
        }
        Ok(())
    }

    fn touches(&self, axis: usize) -> bool {
        match self.shape {
            Shape::Shift(by) => by.get(axis).is_some_and(|by| *by != 0.0),
            Shape::Scale(factor) => factor != 1.0,
            Shape::Mirror(mirrored) => mirrored == axis,
            Shape::Rotate(about, _) => about != axis,
        }
    }

    /// Factor of lengths along an axis, and what is added to its positions.
    fn along(&self, axis: usize) -> (f64, f64) {
        match self.shape {
            Shape::Shift(by) => (1.0, by.get(axis).copied().unwrap_or(0.0)),
            Shape::Scale(factor) => (factor, 0.0),
            Shape::Mirror(mirrored) if mirrored == axis => (-1.0, 0.0),
            Shape::Mirror(_) | Shape::Rotate(..) => (1.0, 0.0),
        }
    }

    fn size(&self) -> f64 {
        match self.shape {
            Shape::Scale(factor) => factor,
            _ => 1.0,
        }
    }

    fn word(&mut self, said: &Said<'_, '_>, word: &Word, kind: Kind) -> Result<(), Refused> {
        let plane = said.here.is.coordinates.plane();
        let is_shift = matches!(self.shape, Shape::Shift(_));
        let (factor, add) = match kind {
            Kind::Feed | Kind::Plain | Kind::Tolerance => return Ok(()),
            Kind::Axis(axis) | Kind::Step(axis) if axis > 2 => {
                if is_shift {
                    return Ok(());
                }
                return said.refuse(
                    word.range,
                    "how a second linear axis moves with the part is not known here",
                );
            }
            Kind::Axis(axis) | Kind::Step(axis) => {
                let (factor, add) = self.along(axis);
                if said.is_step(word, kind) {
                    (factor, 0.0)
                } else {
                    (factor, add)
                }
            }
            Kind::Centre(axis) => {
                let (factor, add) = self.along(axis);
                (factor, if said.is_step(word, kind) { 0.0 } else { add })
            }
            Kind::Level => {
                let (factor, add) = self.along(along(plane));
                let step = said.here.is.coordinates.incremental();
                (factor, if step { 0.0 } else { add })
            }
            Kind::Radius | Kind::Length => (self.size(), 0.0),
            Kind::Rotary | Kind::Vector if is_shift => return Ok(()),
            Kind::Rotary => {
                return said.refuse(
                    word.range,
                    "rotary axes turn the part or the tool: such a program is only shifted",
                );
            }
            Kind::Vector => return said.refuse(word.range, "a program with tool vectors is only shifted"),
            Kind::Unknown => {
                let text = self.program.text(word.range);
                return said.refuse(word.range, format!("{text}: {NOT_KNOWN}"));
            }
        };
        if let Shape::Mirror(axis) = self.shape
            && axis == along(plane)
            && matches!(kind, Kind::Axis(named) | Kind::Step(named) if named == axis)
        {
            return said.refuse(
                word.range,
                format!(
                    "{} is along the tool: mirrored, it would cut from the other side",
                    LETTERS[axis]
                ),
            );
        }
        if factor == 1.0 && add == 0.0 {
            return Ok(());
        }
        let (value, range, point) = self.number(said, word)?;
        let old = self.program.text(range).into_owned();
        let decimals = self.decimals;
        let new = value * factor + add;
        let result = match kind {
            Kind::Axis(axis) | Kind::Step(axis) if said.is_step(word, kind) && !said.drills() => {
                self.track.step(axis, new, decimals)
            }
            Kind::Axis(axis) if !said.is_step(word, kind) => self.track.absolute(axis, new, decimals),
            _ => rounded(new, decimals),
        };
        let keep = decimals_of(&old);
        let plain = written(&old, rounded(new, decimals), decimals, keep, point);
        let text = written(&old, result, decimals, keep, point);
        self.edits.put(self.program, range, text, plain)
    }

    /// The value of a word in units of the program, the place of its number, and whether a whole number needs a point.
    pub(super) fn number(&self, said: &Said<'_, '_>, word: &Word) -> Result<(f64, TextRange, bool), Refused> {
        let Some((value, range)) = number_of(self.program, word) else {
            let text = self.program.text(word.range);
            return said.refuse(
                word.range,
                format!("{text}: its value is computed, so it is not moved: write a number"),
            );
        };
        let whole = !self.program.text(range).contains('.');
        let inch = said.here.is.coordinates.unit_mm() != 1.0;
        Ok(match self.setup.control.implicit_decimals {
            Some(ImplicitDecimals::LeastIncrement) if whole => {
                (value / if inch { 10_000.0 } else { 1000.0 }, range, true)
            }
            None if self.dialect.quirks.macro_b() => (value, range, true),
            _ => (value, range, self.program.text(range).ends_with('.')),
        })
    }

    /// G2 and G3, G41 and G42 change places in a mirror image.
    fn codes(&mut self, said: &Said<'_, '_>) -> Result<(), Refused> {
        self.compensated |= said.here.is.compensation != 0;
        let Shape::Mirror(axis) = self.shape else { return Ok(()) };
        if axis == along(said.here.is.coordinates.plane()) {
            return Ok(());
        }
        for coded in &said.codes {
            let other = match coded.code.id.as_str() {
                "G2" => "3",
                "G3" => "2",
                "G41" => "42",
                "G42" => "41",
                _ if matches!(
                    coded.code.action,
                    Action::ArcClockwise
                        | Action::ArcCounterClockwise
                        | Action::CompensationLeft
                        | Action::CompensationRight
                ) =>
                {
                    let message = format!("{}: the code of its mirror image is not known here", coded.code.id);
                    return said.refuse(coded.word.range, message);
                }
                _ => continue,
            };
            let old = self.program.text(coded.word.value_range);
            // G02 becomes G03
            let zeros = if old.starts_with('0') && other.len() == 1 {
                "0"
            } else {
                ""
            };
            self.edits
                .set(self.program, coded.word.value_range, &format!("{zeros}{other}"))?;
        }
        Ok(())
    }
}
