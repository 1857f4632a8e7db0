//! What the words of a block are: coordinates, steps, centres, radii, lengths, feeds.
use super::survey::Here;
use crate::refuse::Refused;
use trunnion_dialect::{Action, Code, Dialect, Role};
use trunnion_interp::AxisLetter;
use trunnion_syntax::{Address, Block, Item, Program, TextRange, Value, Word};

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A coordinate of X Y Z U V W, by its place among the axes.
    Axis(usize),
    /// A step along such an axis, whatever is modal.
    Step(usize),
    /// A coordinate or step of a rotary axis.
    Rotary,
    /// I, J, K of an arc: from its start, or from the zero point.
    Centre(usize),
    /// The radius of an arc.
    Radius,
    /// R of a drilling cycle: the level at which its feed begins.
    Level,
    /// A length that has no direction: the step of a drilling cycle, a rounded corner.
    Length,
    /// F.
    Feed,
    /// A component of a tool vector.
    Vector,
    /// A word of a mode of path control, which may be a tolerance.
    Tolerance,
    /// It has nothing to do with lengths.
    Plain,
    /// What it is, is not known here.
    Unknown,
}

/// A G or M code of a block.
pub(super) struct Coded<'d> {
    pub(super) code: &'d Code,
    pub(super) word: Word,
}

/// A block with its codes.
pub(super) struct Said<'a, 'd> {
    pub(super) here: &'a Here<'a>,
    pub(super) dialect: &'d Dialect,
    pub(super) codes: Vec<Coded<'d>>,
    /// Names that are codes: TRAORI, CYCLE81(...).
    pub(super) names: Vec<(&'d Code, TextRange, bool)>,
    /// Names that are no codes, and statements.
    pub(super) others: Vec<TextRange>,
}

impl<'a, 'd> Said<'a, 'd> {
    pub(super) fn read(here: &'a Here<'a>, dialect: &'d Dialect) -> Self {
        let program = here.block.program();
        let mut said = Self {
            here,
            dialect,
            codes: Vec::new(),
            names: Vec::new(),
            others: Vec::new(),
        };
        for item in here.block.items() {
            match item {
                Item::Word(word) => {
                    if let Some(code) = code_of(dialect, &word) {
                        said.codes.push(Coded { code, word });
                    }
                }
                Item::Call(call) => match dialect.name(&program.text(call.name)) {
                    Some(code) => {
                        let arguments = call
                            .arguments
                            .is_some_and(|range| !program.text(range).trim().is_empty());
                        said.names.push((code, call.range, arguments));
                    }
                    None => said.others.push(call.range),
                },
                Item::Other(range) => said.others.push(range),
                Item::Skip(..) | Item::Comment(_) | Item::Percent(_) | Item::Label(_) => {}
            }
        }
        said
    }

    pub(super) fn program(&self) -> &'a Program {
        self.here.block.program()
    }

    pub(super) fn has(&self, action: Action) -> bool {
        self.codes.iter().any(|coded| coded.code.action == action)
            || self.names.iter().any(|(code, ..)| code.action == action)
    }

    /// The words that are no codes, with what they are.
    pub(super) fn words(&self) -> impl Iterator<Item = (Word, Kind)> + '_ {
        let all = self.here.block.words().map(|word| (word, self.kind(&word)));
        all.filter(|(_, kind)| *kind != Kind::Plain)
    }

    /// Whether the block begins or repeats a drilling cycle.
    pub(super) fn drills(&self) -> bool {
        let cycle = |motion: Action| motion.is_hole_cycle() || motion == Action::CannedCycle;
        self.here.is.motion.is_some_and(cycle)
    }

    /// Whether the block turns on an arc.
    fn arc(&self) -> bool {
        matches!(
            self.here.is.motion,
            Some(Action::ArcClockwise | Action::ArcCounterClockwise)
        ) || self.has(Action::ArcClockwise)
            || self.has(Action::ArcCounterClockwise)
    }

    fn kind(&self, word: &Word) -> Kind {
        let letter = match word.address {
            Address::Letter(letter) => letter,
            Address::Named(range) => return self.named(&self.program().text(range)),
            Address::Indexed(letter, number) => {
                let name = format!("{}{number}", char::from(letter));
                return match self.dialect.named_role(name.as_bytes()) {
                    Some(Role::ToolVector) => Kind::Vector,
                    Some(Role::Speed | Role::M | Role::Variable) => Kind::Plain,
                    None if self.dialect.role(letter) == Some(Role::Variable) => Kind::Plain,
                    Some(_) | None => Kind::Unknown,
                };
            }
        };
        let axis = AxisLetter::new(letter).map(|axis| usize::from(axis.0));
        match self.dialect.role(letter) {
            Some(Role::Axis | Role::Increment | Role::Feed)
                if self.has(Action::Dwell) && !self.dialect.quirks.rs274() =>
            {
                // in such a block of LinuxCNC the axes move
                Kind::Plain
            }
            Some(Role::Axis) => match axis {
                Some(axis) if (3..6).contains(&axis) => Kind::Rotary,
                Some(axis) => Kind::Axis(axis),
                None => Kind::Unknown,
            },
            Some(Role::Increment) => match letter {
                b'U' => Kind::Step(0),
                b'V' => Kind::Step(1),
                b'W' => Kind::Step(2),
                _ => Kind::Rotary,
            },
            Some(Role::ArcCentre) if self.here.is.tool_axis.vectors() => Kind::Vector,
            Some(Role::ArcCentre) if self.arc() => Kind::Centre(usize::from(letter.wrapping_sub(b'I')).min(2)),
            Some(Role::ArcRadius) if self.has(Action::RotationOn) => Kind::Unknown,
            Some(Role::ArcRadius) if self.drills() => Kind::Level,
            Some(Role::ArcRadius) if self.arc() => Kind::Radius,
            Some(Role::ArcRadius) if self.has(Action::DataEntry) && !self.dialect.quirks.rs274() => Kind::Length,
            Some(Role::Feed) => Kind::Feed,
            Some(Role::Parameter) => self.parameter(letter),
            Some(Role::ToolVector) => Kind::Vector,
            Some(
                Role::ArcCentre
                | Role::ArcRadius
                | Role::PathWord
                | Role::NotModelled
                | Role::NotFollowed
                | Role::Variable,
            )
            | None => Kind::Unknown,
            Some(_) => Kind::Plain,
        }
    }

    /// P, Q, L, K and the like.
    fn parameter(&self, letter: u8) -> Kind {
        let numbers = [
            Action::Dwell,
            Action::WorkOffset,
            Action::ReferenceReturnOther,
            Action::DataEntry,
            Action::ReferenceReturn,
            Action::SpindleClockwise,
            Action::SpindleCounterClockwise,
            Action::SpindleStop,
        ];
        match letter {
            b'P' | b'L' if numbers.iter().any(|action| self.has(*action)) => Kind::Plain,
            b'P' | b'L' | b'K' if self.drills() => Kind::Plain,
            b'Q' if self.drills() => Kind::Length,
            // the number of an offset; under G41.1 a diameter
            b'D' => {
                let diameter = |coded: &Coded<'_>| matches!(coded.code.id.as_str(), "G41.1" | "G42.1");
                if self.codes.iter().any(diameter) {
                    Kind::Unknown
                } else {
                    Kind::Plain
                }
            }
            _ if self.calls() => Kind::Plain,
            _ if self.has(Action::PathMode) => Kind::Tolerance,
            _ => Kind::Unknown,
        }
    }

    /// Whether the block calls a subprogram by its number and gives it no arguments.
    fn calls(&self) -> bool {
        let plain = |coded: &Coded<'_>| coded.code.action == Action::SubprogramCall && coded.code.id.starts_with('M');
        self.codes.iter().any(plain)
    }

    /// Words with names: CR=, `,R`.
    fn named(&self, name: &str) -> Kind {
        let name: String = name.chars().filter(|c| !c.is_whitespace()).collect();
        let name = name.to_ascii_uppercase();
        match (name.as_str(), self.dialect.named_role(name.as_bytes())) {
            (",R" | ",C", _) | ("RND" | "CHF" | "CHR", Some(Role::PathWord)) => Kind::Length,
            // an assignment: where the variable is used, its value is not rewritten
            (_, Some(Role::Variable)) => Kind::Plain,
            _ if name.starts_with('#') => Kind::Plain,
            (_, Some(Role::ArcRadius)) => Kind::Radius,
            (_, Some(Role::ArcTurns)) => Kind::Plain,
            (_, Some(Role::ToolVector)) => Kind::Vector,
            _ => Kind::Unknown,
        }
    }

    /// A refusal at a word.
    pub(super) fn refuse<T>(&self, range: TextRange, message: impl Into<String>) -> Result<T, Refused> {
        Err(Refused::range(self.program(), range, message))
    }

    /// The first code that is not among those that an edit understands.
    pub(super) fn understood(&self, fine: impl Fn(&Code) -> bool, why: &str) -> Result<(), Refused> {
        if let Some(coded) = self.codes.iter().find(|coded| !fine(coded.code)) {
            return self.refuse(coded.word.range, format!("{}: {why}", coded.code.id));
        }
        let arguments = |(code, _, given): &&(&Code, TextRange, bool)| {
            let plain = matches!(code.action, Action::NoMotion | Action::Declaration | Action::PathMode);
            // jumps, conditions and calls: the run follows them
            code.action != Action::SubprogramCall && (!fine(code) || *given && !plain)
        };
        if let Some((code, range, _)) = self.names.iter().find(arguments) {
            return self.refuse(*range, format!("{}: {why}", code.id));
        }
        Ok(())
    }

    /// Whether a coordinate is a step, or a centre is written from the start of the arc.
    pub(super) fn is_step(&self, word: &Word, kind: Kind) -> bool {
        let called = match word.value {
            Value::Call(name, _) => Some(self.program().text(name).to_ascii_uppercase()),
            _ => None,
        };
        match (kind, called.as_deref()) {
            (Kind::Step(_), _) | (_, Some("IC")) => true,
            (_, Some(_)) => false,
            (Kind::Centre(_), None) => !self.here.is.coordinates.arc_centre_absolute(),
            (_, None) => self.here.is.coordinates.incremental(),
        }
    }
}

/// The code of a G or M word.
pub(super) fn code_of<'d>(dialect: &'d Dialect, word: &Word) -> Option<&'d Code> {
    let Address::Letter(letter) = word.address else {
        return None;
    };
    let Value::Number(number) = word.value else { return None };
    let tenths = (number.to_f64() * 10.0).round();
    if !(0.0..1e5).contains(&tenths) {
        return None;
    }
    match dialect.role(letter) {
        Some(Role::G) => dialect.g(tenths as u32),
        Some(Role::M) => dialect.m(tenths as u32),
        _ => None,
    }
}

/// Whether a block that never ran has words that an edit would have to change.
pub(super) fn has_lengths(block: &Block<'_>, dialect: &Dialect) -> bool {
    block.words().any(|word| match word.address {
        Address::Letter(letter) => matches!(
            dialect.role(letter),
            Some(Role::Axis | Role::Increment | Role::ArcCentre | Role::ArcRadius | Role::Feed)
        ),
        Address::Named(name) => !block.program().text(name).starts_with('#'),
        Address::Indexed(letter, _) => dialect.role(letter) != Some(Role::Variable),
    })
}
