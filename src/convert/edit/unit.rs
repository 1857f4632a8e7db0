//! Lengths and feeds in another unit.
use super::edits::{Edits, Track, number_of, rounded, written};
use super::kinds::{Kind, Said, code_of, has_lengths};
use super::survey::survey;
use super::{Change, Proposal};
use crate::refuse::Refused;
use trunnion_dialect::{Action, Code, CodeKind, Dialect};
use trunnion_interp::{FeedMode, ImplicitDecimals, LengthUnit, Setup};
use trunnion_syntax::{Program, TextRange, Word};

/// Digits in all of a feed that is rounded.
const FEED_DIGITS: usize = 6;
/// By which part such a feed is off at most: half of the last of six digits.
const FEED_SHARE: f64 = 5.1e-6;

const NOT_KNOWN: &str = "which of its numbers are lengths is not known here, so its unit cannot be changed";

pub(super) fn propose(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    unit: LengthUnit,
    decimals: Option<usize>,
) -> Result<Proposal, Refused> {
    let mut work = Work {
        program,
        dialect,
        setup,
        unit,
        decimals: decimals.unwrap_or(if unit == LengthUnit::Inch { 4 } else { 3 }),
        edits: Edits::default(),
        track: Track::default(),
        said: false,
        silent: None,
        lengths: false,
        changed: false,
        feed_stays: feed_stays(program, dialect)?,
    };
    let ran = survey(program, dialect, setup, |here| work.block(&Said::read(here, dialect)))?;
    if !work.changed {
        if let Some(at) = work.silent {
            return Err(Refused::range(program, at, work.no_code()));
        }
        if !work.lengths {
            return Err(Refused::nothing("the program has no lengths and no feeds"));
        }
        let name = name(unit);
        return Err(Refused::nothing(format!("the program is in {name} already")));
    }
    if let Some(block) = program
        .blocks()
        .find(|block| !ran.has(block.id()) && has_lengths(block, dialect))
    {
        let message = "this block never runs, so the unit of its lengths is not known";
        return Err(Refused::at(program, block.id(), message));
    }
    let end_mm = unit.mm() * 0.5 * 10f64.powi(-(work.decimals as i32)) * 1.000_1 + 1e-9;
    let mut change = Change::nothing(end_mm, 10.0 * end_mm, FEED_SHARE);
    change.other_unit = true;
    Ok(Proposal {
        edits: work.edits.sorted(program),
        change,
        notes: vec![format!(
            "the program leaves the control in {}; tool lengths, radii and work offsets that the control holds are not part of the program",
            name(unit)
        )],
    })
}

fn name(unit: LengthUnit) -> &'static str {
    match unit {
        LengthUnit::Millimetre => "mm",
        LengthUnit::Inch => "inch",
    }
}

struct Work<'a> {
    program: &'a Program,
    dialect: &'a Dialect,
    setup: &'a Setup,
    unit: LengthUnit,
    decimals: usize,
    edits: Edits,
    track: Track,
    /// The program has named the unit.
    said: bool,
    /// The first length for which neither the program nor the settings say the unit.
    silent: Option<TextRange>,
    /// The program has lengths, or codes that name a unit.
    lengths: bool,
    changed: bool,
    /// F is in mm in both units.
    feed_stays: bool,
}

fn is_unit(action: Action) -> bool {
    matches!(action, Action::Inch | Action::InchLengthsOnly | Action::Metric)
}

/// Codes whose words are understood.
fn fine(code: &Code) -> bool {
    let action = code.action;
    is_unit(action)
        || action.keeps_place() && !matches!(action, Action::Polynomial | Action::ArcThroughPoint | Action::Pole | Action::ConstantSurfaceSpeed)
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
                | Action::ProgrammableShift
                | Action::LocalShift
                | Action::PositionSet
                | Action::PositionPreset
                | Action::RotationOn
                | Action::RotationOff
                | Action::ScalingOff
                | Action::MirrorOn
                | Action::MirrorOff
                | Action::PolarOff
                | Action::DataEntry
                | Action::DataEntryEnd
                | Action::ReferenceCheck
                | Action::ReferenceReturn
                | Action::ReferenceReturnOther
                | Action::ReferenceFrom
                | Action::NoMotion
                | Action::Declaration
                | Action::TurningCycle
                | Action::FacingCycle
                | Action::ConstantSpindleSpeed
        )
        // with arguments their words are unknown
        || action == Action::SubprogramCall && code.kind == CodeKind::M
}

impl Work<'_> {
    fn block(&mut self, said: &Said<'_, '_>) -> Result<(), Refused> {
        self.codes(said)?;
        let here = said.here;
        let factor = here.is.coordinates.unit_mm() / self.unit.mm();
        let mut first: Option<TextRange> = None;
        let (mut lengths, mut unknown) = (false, None);
        for (word, kind) in said.words() {
            first = first.or(Some(word.range));
            match kind {
                Kind::Unknown | Kind::Tolerance => unknown = unknown.or(Some(word)),
                Kind::Rotary | Kind::Vector | Kind::Plain => {}
                Kind::Feed if here.is.feed.mode() == FeedMode::InverseTime => {}
                _ => lengths = true,
            }
        }
        if !lengths && unknown.is_none() {
            return Ok(());
        }
        self.lengths |= lengths;
        if lengths && !self.said && !here.is.coordinates.unit_programmed() {
            self.silent = self.silent.or(first);
        }
        if factor == 1.0 && here.is.feed.unit_mm() == self.unit.mm() {
            return self.words(said, factor);
        }
        self.changed = true;
        said.understood(fine, NOT_KNOWN)?;
        if let Some(word) = unknown.filter(|word| !self.is_angle(said, word)) {
            let text = self.program.text(word.range);
            return said.refuse(word.range, format!("{text}: {NOT_KNOWN}"));
        }
        self.name_unit(said, first)?;
        self.words(said, factor)
    }

    /// R of G68 is an angle.
    fn is_angle(&self, said: &Said<'_, '_>, word: &Word) -> bool {
        said.has(Action::RotationOn) && self.program.text(word.range).starts_with(['R', 'r'])
    }

    /// Writes the other code in the place of each that names a unit.
    fn codes(&mut self, said: &Said<'_, '_>) -> Result<(), Refused> {
        for coded in said.codes.iter().filter(|coded| is_unit(coded.code.action)) {
            let is_inch = coded.code.action != Action::Metric;
            (self.said, self.lengths) = (true, true);
            if is_inch == (self.unit == LengthUnit::Inch) {
                continue;
            }
            let pair = match coded.code.id.as_str() {
                "G20" => "G21",
                "G21" => "G20",
                "G70" => "G71",
                "G71" => "G70",
                "G700" => "G710",
                "G710" => "G700",
                other => {
                    let message = format!("{other}: the code of the other unit is not known here");
                    return said.refuse(coded.word.range, message);
                }
            };
            let known = self.dialect.codes().iter().find(|code| code.id == pair);
            if !known.is_some_and(|code| is_unit(code.action)) {
                let message = format!("this control has no {pair}: its unit is set in another way");
                return said.refuse(coded.word.range, message);
            }
            self.changed = true;
            self.edits.set(self.program, coded.word.value_range, &pair[1..])?;
        }
        Ok(())
    }

    /// A program that relies on the unit of the control has to name the new one before its first length.
    fn name_unit(&mut self, said: &Said<'_, '_>, first: Option<TextRange>) -> Result<(), Refused> {
        if std::mem::replace(&mut self.said, true) {
            return Ok(());
        }
        let at = first.unwrap_or(said.here.block.range());
        if !said.here.is.coordinates.unit_programmed() {
            return said.refuse(at, self.no_code());
        }
        let wanted = |code: &&Code| match self.unit {
            LengthUnit::Inch => code.action == Action::Inch,
            LengthUnit::Millimetre => code.action == Action::Metric && code.id != "G71",
        };
        let Some(code) = self.dialect.codes().iter().find(wanted) else {
            return said.refuse(at, "this control has no code for the other unit");
        };
        let start = said
            .here
            .block
            .words()
            .next()
            .filter(|word| Some(word.range) != said.here.block.number());
        let start = match (start, said.here.block.number()) {
            (Some(word), _) => word.range.start,
            (None, Some(number)) => {
                let rest = said.here.block.words().find(|word| word.range.start >= number.end);
                rest.map_or(at.start, |word| word.range.start)
            }
            (None, None) => at.start,
        };
        self.edits
            .set(self.program, TextRange::new(start, start), &format!("{} ", code.id))
    }

    /// Why a length without a unit stays.
    fn no_code(&self) -> String {
        let codes = self.dialect.codes().iter().filter(|code| is_unit(code.action));
        let codes: Vec<&str> = codes.map(|code| code.id.as_str()).collect();
        let write = if codes.is_empty() {
            String::new()
        } else {
            format!("write {} at the start, or ", codes.join(" or "))
        };
        format!("no code says in which unit this is: {write}declare `units` in [control] of trunnion.toml")
    }

    fn words(&mut self, said: &Said<'_, '_>, factor: f64) -> Result<(), Refused> {
        for (word, kind) in said.words() {
            let is_feed = kind == Kind::Feed;
            let factor = match kind {
                Kind::Rotary | Kind::Vector | Kind::Plain | Kind::Tolerance | Kind::Unknown => continue,
                Kind::Feed if said.here.is.feed.mode() == FeedMode::InverseTime => continue,
                // F of G70 of a Sinumerik stays in mm
                Kind::Feed => self.feed_factor(said),
                _ => factor,
            };
            if factor == 1.0 && is_feed {
                continue;
            }
            let Some((value, range)) = number_of(self.program, &word) else {
                if factor == 1.0 {
                    continue;
                }
                let text = self.program.text(word.range);
                let message = format!("{text}: its value is computed, so its unit cannot be changed: write a number");
                return said.refuse(word.range, message);
            };
            let old = self.program.text(range).into_owned();
            let whole = !old.contains('.');
            let least = self.setup.control.implicit_decimals == Some(ImplicitDecimals::LeastIncrement) && whole;
            let value = if least {
                value / increments(said, is_feed)
            } else {
                value
            };
            let new = value * factor;
            let point =
                least || old.ends_with('.') || self.setup.control.implicit_decimals.is_none() && self.needs_point();
            if is_feed {
                let text = feed(&old, new, point);
                self.edits.set(self.program, range, &text)?;
                continue;
            }
            let result = match kind {
                Kind::Axis(axis) | Kind::Step(axis) if said.is_step(&word, kind) && !said.drills() => {
                    self.track.step(axis, new, self.decimals)
                }
                Kind::Axis(axis) | Kind::Step(axis) if !said.is_step(&word, kind) => {
                    self.track.absolute(axis, new, self.decimals)
                }
                // a shorter step might need one more to the same depth
                Kind::Length if said.drills() => up(new, self.decimals),
                _ => rounded(new, self.decimals),
            };
            if factor == 1.0 {
                continue;
            }
            let plain = match kind {
                Kind::Axis(_) | Kind::Step(_) => rounded(new, self.decimals),
                _ => result,
            };
            let plain = written(&old, plain, self.decimals, 0, point);
            let text = written(&old, result, self.decimals, 0, point);
            self.edits.put(self.program, range, text, plain)?;
        }
        Ok(())
    }

    /// Whether the control may read a number without a point in least increments.
    fn needs_point(&self) -> bool {
        self.dialect.quirks.macro_b()
    }

    fn feed_factor(&self, said: &Said<'_, '_>) -> f64 {
        if self.feed_stays {
            return 1.0;
        }
        said.here.is.feed.unit_mm() / self.unit.mm()
    }
}

/// Whether the program chooses its unit by G70 and G71 of a Sinumerik, which leave F in mm (interface: G700 and G710 scale both).
fn feed_stays(program: &Program, dialect: &Dialect) -> Result<bool, Refused> {
    if !dialect
        .codes()
        .iter()
        .any(|code| code.action == Action::InchLengthsOnly)
    {
        return Ok(false);
    }
    let (mut lengths, mut both) = (None, None);
    for block in program.blocks() {
        for word in block.words() {
            let Some(code) = code_of(dialect, &word).filter(|code| is_unit(code.action)) else {
                continue;
            };
            match code.id.as_str() {
                "G70" | "G71" => lengths = lengths.or(Some(word)),
                _ => both = both.or(Some(word)),
            }
        }
    }
    match (lengths, both) {
        (Some(_), Some(word)) => Err(Refused::range(
            program,
            word.range,
            "the program uses G70 or G71 and G700 or G710: use one pair, so that F has one meaning",
        )),
        (lengths, None) => Ok(lengths.is_some()),
        (None, Some(_)) => Ok(false),
    }
}

/// In how many least increments a unit is divided.
fn increments(said: &Said<'_, '_>, is_feed: bool) -> f64 {
    let inch = said.here.is.coordinates.unit_mm() != 1.0;
    match (is_feed, said.here.is.feed.mode(), inch) {
        (true, FeedMode::PerMinute, false) | (true, FeedMode::InverseTime, _) => 1.0,
        (true, FeedMode::PerMinute, true) | (true, FeedMode::PerRevolution, false) => 100.0,
        (true, FeedMode::PerRevolution, true) | (false, _, true) => 10_000.0,
        (false, _, false) => 1000.0,
    }
}

/// A positive length rounded up.
fn up(value: f64, decimals: usize) -> f64 {
    let near = rounded(value, decimals);
    let step = 10f64.powi(-(decimals as i32));
    if near < value - 1e-9 * step {
        rounded(near + step, decimals)
    } else {
        near
    }
}

/// A feed with six digits in all, or exactly where that takes fewer.
fn feed(old: &str, value: f64, point: bool) -> String {
    let whole = value.abs().max(1e-9).log10().floor() as i32 + 1;
    let decimals = (FEED_DIGITS as i32 - whole).clamp(0, 9) as usize;
    written(old, value, decimals, 0, point)
}
