//! Chains of lines at feed that may be put together, found in the text and in the run.
use crate::whole_feed::has_whole_feed;
use crate::{Options, Place, Proposal, Proposed};
use std::collections::HashSet;
use trunnion_certify::Claim;
use trunnion_check::Settings;
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;
use trunnion_interp::{
    ChainId, Fault, Feed, ModalState, Motion, MotionKind, Orientation, Sink, Swivel, may_return_to_numbers, run,
};
use trunnion_syntax::{Address, Block, BlockId, Item, Program, Value};

/// One line of a chain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// Its block.
    pub block: BlockId,
    /// Where it ends, programmed coordinates, mm.
    pub end: Vec3,
}

/// Lines one after the other with nothing between them: all but the first have no words but a number, G1, X Y Z and the feed that is in effect.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// Where it begins, mm.
    pub start: Vec3,
    /// Not empty.
    pub lines: Vec<Line>,
    /// The working plane.
    pub plane: Plane,
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// The block of the next motion, if that is a line at feed.
    pub next_line: Option<BlockId>,
}

impl Chain {
    /// The start of a line, or the end of the last one, mm.
    pub(crate) fn point(&self, index: usize) -> Vec3 {
        index.checked_sub(1).map_or(self.start, |before| self.lines[before].end)
    }

    /// All points.
    pub(crate) fn points(&self) -> Vec<Vec3> {
        (0..=self.lines.len()).map(|index| self.point(index)).collect()
    }

    /// The axes X Y Z that are at the same place at two points.
    pub(crate) fn still(&self, from: usize, to: usize) -> [bool; 3] {
        let (start, end) = (self.point(from), self.point(to));
        [0, 1, 2].map(|axis| start[axis] == end[axis])
    }
}

/// Why lines were left alone, most frequent reasons of a program first.
pub(crate) type Reasons = Vec<(&'static str, u32)>;

/// Why other lines were not looked at, for people.
fn left_alone(reasons: &Reasons) -> Option<String> {
    let texts: Vec<String> = reasons
        .iter()
        .take(3)
        .map(|(why, count)| format!("{count} lines ({why})"))
        .collect();
    (!texts.is_empty()).then(|| texts.join("; "))
}

/// The chains of a program.
#[derive(Debug)]
pub(crate) struct Chains {
    /// In the order of the text.
    pub chains: Vec<Chain>,
    /// Why other lines at feed are in no chain.
    pub reasons: Reasons,
}

impl Chains {
    /// Those of so many lines and more.
    pub(crate) fn of_at_least(&self, lines: usize) -> LongChains<'_> {
        LongChains {
            chains: self.chains.iter().filter(|chain| chain.lines.len() >= lines).collect(),
            reasons: &self.reasons,
        }
    }
}

/// The chains that are long enough for a rewrite.
pub(crate) struct LongChains<'a> {
    /// In the order of the text.
    pub chains: Vec<&'a Chain>,
    reasons: &'a Reasons,
}

impl LongChains<'_> {
    /// What a rewrite of chains proposes for these places, or why there is nothing; the summary gets why other lines were left alone.
    pub(crate) fn proposal(&self, places: Vec<Place>, mut summary: String, options: &Options) -> Proposed {
        let reasons = left_alone(self.reasons);
        if places.is_empty() {
            return match reasons {
                Some(why) if self.chains.is_empty() => Err(format!("there are no lines to put together: {why}").into()),
                _ => Ok(None),
            };
        }
        if let Some(why) = reasons {
            summary.push_str("; left alone: ");
            summary.push_str(&why);
        }
        Ok(Some(Proposal {
            places,
            claim: Claim::RefittedPath {
                tolerance_mm: options.tolerance_mm,
                source: options.source,
            },
            summary,
        }))
    }
}

/// One motion, as far as a chain needs it.
struct Seen {
    block: BlockId,
    ends: Result<(Vec3, Vec3), &'static str>,
    linear: bool,
    waits: bool,
    plane: Plane,
    unit_mm: f64,
    /// All that is in effect is as at the motion before.
    goes_on: bool,
}

impl Seen {
    /// A line at feed that stands for no curve.
    fn is_line(&self) -> bool {
        self.linear && self.ends != Err(CURVE)
    }

    /// A block of codes without coordinates (`G1 F500`): it needs no motion code, and begins no chain.
    fn is_code_alone(&self, program: &Program) -> bool {
        self.linear
            && self.ends.is_ok_and(|(start, end)| start == end)
            && program
                .block(self.block)
                .words()
                .all(|word| matches!(word.address, Address::Letter(b'N' | b'G' | b'F' | b'S' | b'M' | b'T')))
    }
}

struct Collector {
    all: Vec<Seen>,
    last: Option<Motion>,
}

impl Sink for Collector {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.all.push(Seen {
            block: motion.block,
            ends: ends(motion, state),
            linear: motion.kind == MotionKind::Linear,
            waits: matches!(motion.kind, MotionKind::Dwell(_)),
            plane: state.coordinates.plane(),
            unit_mm: state.coordinates.unit_mm(),
            goes_on: self.last.is_some_and(|last| goes_on(&last, motion)),
        });
        self.last = Some(*motion);
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

/// Why a line that stands for a piece of a curve is left alone.
const CURVE: &str = "it is a curve already";

/// Both ends of a line that may be put together with others; else why not.
fn ends(motion: &Motion, state: &ModalState) -> Result<(Vec3, Vec3), &'static str> {
    if motion.kind != MotionKind::Linear {
        return Err("");
    }
    let stands =
        (3..9).all(|axis| motion.start.get(axis) == motion.end.get(axis) && motion.says_way & (1 << axis) == 0);
    let turned = matches!(motion.orientation, Orientation::Vector(start, end) if start != Some(end));
    if motion.slack_mm > 0.0 {
        Err(CURVE)
    } else if motion.chain != ChainId::MAIN {
        Err("it is in a called program")
    } else if state.coordinates.incremental() {
        Err("it is incremental (G91)")
    } else if state.coordinates.arc_centre_absolute() {
        Err("the centres of arcs are absolute (G90.1)")
    } else if state.compensation != 0 {
        Err("cutter radius compensation is on (G41, G42)")
    } else if matches!(motion.feed, Feed::InverseTime(_)) {
        Err("the feed is inverse time (G93)")
    } else if matches!(motion.feed, Feed::Unknown) || motion.spin.is_some() {
        Err("the feed or the spindle's speed is not known")
    } else if motion.tcp {
        Err("tool centre point control is on")
    } else if motion.machine_coordinates || motion.tilt.swivel != Swivel::No || motion.tilt.free != 0 {
        Err("it is programmed in machine coordinates or only turns the tool")
    } else if !stands || turned {
        Err("a rotary axis moves")
    } else {
        motion
            .start
            .xyz()
            .zip(motion.end.xyz())
            .ok_or("its position is unknown")
    }
}

/// Whether everything that is in effect is the same at both motions.
fn goes_on(last: &Motion, motion: &Motion) -> bool {
    let same = |a: f64, b: f64| a == b || a.is_nan() && b.is_nan();
    last.end == motion.start
        && last.feed == motion.feed
        && last.spindle_on == motion.spindle_on
        && last.spindle_rpm == motion.spindle_rpm
        && last.tcp == motion.tcp
        && last.tool == motion.tool
        && last.tilt == motion.tilt
        && same(last.tool_length_mm, motion.tool_length_mm)
        && last.zero.iter().zip(&motion.zero).all(|(a, b)| same(*a, *b))
}

/// What the text of a block allows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Text {
    /// Nothing but a number, G1, X Y Z, and F.
    Plain,
    /// The same with a comment: it may begin a chain.
    Commented,
    /// No word at all.
    Blank,
    /// A jump, or the return of a missing program, may lead to its number: it stays as it is.
    Numbered,
    /// Something else.
    Other,
}

fn text_of(block: &Block<'_>, numbers_count: bool) -> Text {
    let mut found = Text::Blank;
    for item in block.items() {
        match item {
            Item::Comment(_) => found = Text::Commented,
            Item::Word(word) => {
                let Value::Number(value) = word.value else {
                    return Text::Other;
                };
                match word.address {
                    Address::Letter(b'N') if numbers_count => return Text::Numbered,
                    Address::Letter(b'N' | b'X' | b'Y' | b'Z' | b'F') => {}
                    Address::Letter(b'G') if value.to_integer() == Some(1) => {}
                    _ => return Text::Other,
                }
                if found == Text::Blank {
                    found = Text::Plain;
                }
            }
            _ => return Text::Other,
        }
    }
    found
}

impl Text {
    /// Why the block is in no chain.
    fn refuses(self) -> Option<&'static str> {
        match self {
            Self::Numbered => Some("a jump or a return may lead to its number"),
            Self::Other => Some("its block has other words than a number, G1, X, Y, Z and F"),
            Self::Plain | Self::Commented | Self::Blank => None,
        }
    }
}

/// Whether a block switches exact stop on or off.
fn exact_stop(block: &Block<'_>) -> Option<bool> {
    let mut found = None;
    for word in block.words() {
        if let (Address::Letter(b'G'), Value::Number(value)) = (word.address, word.value) {
            let tenths = (value.to_f64() * 10.0).round() as i64;
            match tenths {
                600 | 610 | 611 => found = Some(true),
                620 | 630 | 640..=649 | 6410..=6459 => found = Some(false),
                _ => {}
            }
        }
    }
    found
}

/// Whether the words of X Y Z are where the motion ends: no frame, mirror or scale is between them.
fn is_literal(block: &Block<'_>, end: &Vec3, unit_mm: f64) -> bool {
    block.words().all(|word| match (word.address, word.value) {
        (Address::Letter(letter @ b'X'..=b'Z'), Value::Number(value)) => {
            let at = end[usize::from(letter - b'X')];
            (value.to_f64() * unit_mm - at).abs() <= 1e-9 * (1.0 + at.abs())
        }
        _ => true,
    })
}

fn count_reason(reasons: &mut Reasons, why: &'static str) {
    match reasons.iter_mut().find(|(known, _)| *known == why) {
        Some((_, count)) => *count += 1,
        None => reasons.push((why, 1)),
    }
}

/// The chains of a program; `named`: blocks that keep their words, because a jump may lead there.
pub(crate) fn chains(program: &Program, settings: &Settings<'_>, named: &HashSet<BlockId>) -> Chains {
    let mut collector = Collector {
        all: Vec::new(),
        last: None,
    };
    run(program, settings.dialect, &settings.setup, &mut collector);
    let seen = collector.all;
    let numbers_count = may_return_to_numbers(program, settings.dialect, &settings.setup).is_some();
    let mut found = Chains {
        chains: Vec::new(),
        reasons: Vec::new(),
    };
    let waits = |seen: &Seen| seen.waits || seen.is_code_alone(program);
    let mut open: Option<Chain> = None;
    let (mut at, mut moving, mut stops, mut whole) = (0, 0, false, false);
    let mut close = |open: &mut Option<Chain>, next: Option<&Seen>| {
        if let Some(mut chain) = open.take() {
            chain.next_line = next.filter(|next| next.is_line()).map(|next| next.block);
            found.chains.push(chain);
        }
    };
    for block in program.blocks() {
        let motions = seen[at..].iter().take_while(|seen| seen.block == block.id()).count();
        // the next motion that does not wait, looked for once
        moving = moving.max(at + motions);
        while seen.get(moving).is_some_and(&waits) {
            moving += 1;
        }
        let next = seen.get(moving);
        let text = text_of(&block, numbers_count || named.contains(&block.id()));
        if text.refuses().is_some()
            && let Some(on) = exact_stop(&block)
        {
            stops = on;
        }
        if seen[at..at + motions].iter().all(waits) {
            at += motions;
            if motions > 0 || text != Text::Blank {
                close(&mut open, next);
            }
            continue;
        }
        let one = &seen[at];
        at += motions;
        let why = match &one.ends {
            _ if motions > 1 && one.ends != Err(CURVE) => Some("a block makes several motions"),
            Err(why) => Some(*why),
            Ok(_) if stops => Some("exact stop is on (G61, G60): each block ends with a stop"),
            Ok(_) if text.refuses().is_some() => text.refuses(),
            Ok((_, end)) if !is_literal(&block, end, one.unit_mm) => {
                Some("the words are not the position: a frame, a scale or a diameter is active")
            }
            Ok(_) => None,
        };
        if let Some(why) = why {
            close(&mut open, seen[at - motions..].iter().find(|seen| !waits(seen)));
            if one.linear && !why.is_empty() {
                count_reason(&mut found.reasons, why);
            }
            continue;
        }
        let Ok((start, end)) = one.ends else { continue };
        let line = Line { block: block.id(), end };
        let alone = core::mem::replace(&mut whole, has_whole_feed(&block, settings.dialect)) || whole;
        let joins = one.goes_on && !alone && text == Text::Plain;
        match &mut open {
            Some(chain) if joins && chain.plane == one.plane => chain.lines.push(line),
            _ => {
                close(&mut open, Some(one));
                open = Some(Chain {
                    start,
                    lines: vec![line],
                    plane: one.plane,
                    unit_mm: one.unit_mm,
                    next_line: None,
                });
            }
        }
    }
    close(&mut open, None);
    found.reasons.sort_by_key(|(_, count)| core::cmp::Reverse(*count));
    found
}
