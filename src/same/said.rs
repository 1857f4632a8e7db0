//! What a block says of a motion whose end, feed or time is not known: the numbers of the motion are not the place, and two that are not known need not be
//! equal (decision 0029). Then the words of both blocks must be the same.
use crate::item::Step;
use crate::steps::Steps;
use std::fmt::Write as _;
use std::sync::Arc;
use trunnion_dialect::{Action, Role};
use trunnion_interp::{
    AXIS_LETTERS, AxisLetter, ChainId, Feed, FeedMode, ModalState, Motion, MotionKind, Swivel, canonical_text,
};
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Value, Word};

/// X, Y and Z.
const LINEAR: u16 = 7;
/// All axes.
const ALL: u16 = 0x1ff;

/// Between what a block says and the values that are not known.
const ENDS: char = '\n';

/// The reason where two blocks say the same of variables, which hold different values.
const VARIABLES_DIFFER: &str = "where it ends or how fast is unknown, and the variables in it hold different values";

/// Whether a comparison is undecided for that reason: where the same programs were the same with other values of what nobody declares, these
/// values decide.
pub fn variables_differ(why: &str) -> bool {
    why.contains(VARIABLES_DIFFER)
}

/// Why two blocks may do different things where the result is not known; `None` where they say the same.
pub(crate) fn unlike(before: &Step, after: &Step) -> Option<String> {
    let [was, is] = [before, after].map(|step| step.said.as_deref());
    if was == is {
        return None;
    }
    let same_text = before.with_variables.is_some() && before.with_variables == after.with_variables;
    let words = [was, is].map(|said| said.and_then(|said| said.split(ENDS).next()));
    let what = if words[0] == words[1] {
        "where both end is unknown, and it depends on other blocks that differ".to_owned()
    } else {
        let [was, is] = words.map(|words| words.map_or("nothing unknown".to_owned(), |words| format!("`{words}`")));
        if same_text {
            format!("{VARIABLES_DIFFER}: {was} and {is}")
        } else {
            format!("where it ends or how fast is unknown, and the blocks say different things: {was} and {is}")
        }
    };
    Some(what)
}

/// What a motion leaves open.
struct Lost {
    /// Axes without a known end, bits as in `Position::known`.
    axes: u16,
    /// X, Y or Z is one of them.
    linear: bool,
    feed: bool,
    /// What it is, is not known: it says everything.
    kind: bool,
    /// Its centre is known.
    arc: bool,
}

/// The words of a block, as far as its motion does not say them.
#[derive(Default)]
struct Said {
    words: Vec<String>,
    /// One of them counts in the unit of the program.
    in_units: bool,
    /// One of them has no known result.
    counts: bool,
    /// The words are wanted, not only whether one of them counts: for most motions none does, and writing them takes longer than running the block.
    wanted: bool,
}

impl Steps<'_> {
    /// What the block of a motion says, where the motion does not: `None` where everything that the block says is known.
    fn said(&self, motion: &Motion) -> Option<Arc<str>> {
        let diameter = self.input.dialect.quirks.diameter;
        let axes = !motion.end.known & ALL;
        let lost = Lost {
            axes,
            // a lathe of two axes never names Y
            linear: axes & LINEAR & if diameter { !2 } else { !0 } != 0,
            feed: motion.is_feed() && motion.feed == Feed::Unknown,
            kind: matches!(
                motion.kind,
                MotionKind::Unknown | MotionKind::Arc(None) | MotionKind::Dwell(None)
            ),
            arc: matches!(motion.kind, MotionKind::Arc(Some(_))),
        };
        // the block of a motion in another file is that of the call: what moved is not in it
        let elsewhere = || self.calls_of(motion).last().is_some_and(|frame| frame.is_place);
        let turns = motion.tilt.swivel != Swivel::No;
        if axes == 0 && !lost.feed && !lost.kind || turns && !lost.kind || motion.chain != ChainId::MAIN && elsewhere()
        {
            return None;
        }
        // F of a thread whose lead changes: the feed is not known, but what it begins with is
        let begins_with = self.state().feed.value().filter(|_| lost.feed);
        let mut counts = Said {
            counts: begins_with.is_some(),
            ..Said::default()
        };
        if !lost.kind {
            self.collect(motion, &lost, &mut counts);
            if !counts.counts {
                return None;
            }
        }
        let mut said = Said {
            wanted: true,
            ..Said::default()
        };
        self.collect(motion, &lost, &mut said);
        if let Some(feed) = begins_with {
            said.words.push(format!("modal F{feed}"));
        }
        Some(said.told(motion, self.state()))
    }

    /// What the block of a motion says.
    pub(crate) fn say(&self, step: &mut Step) {
        step.said = self.said(&step.motion);
        step.with_variables = self.with_variables(step);
    }

    /// The text of the block of a motion of which not everything is known, where variables are in it.
    fn with_variables(&self, step: &Step) -> Option<Arc<str>> {
        step.said.as_ref()?;
        let program = self.input.program;
        let text = canonical_text(&program.text(program.block(step.motion.block).range()));
        text.contains(['#', '=', 'R', 'Q', 'V']).then(|| text.into())
    }

    /// The words of the block of a motion.
    fn collect(&self, motion: &Motion, lost: &Lost, said: &mut Said) {
        let program = self.input.program;
        let block = program.block(motion.block);
        match program.options().format {
            Format::Iso | Format::Osp => self.words_of(&block, lost, said),
            Format::Klartext => self.sentence_of(&block, lost, said),
            Format::Apt => said.whole(|| self.text(&program.text(block.range())), lost.linear),
        }
    }

    /// A text with its known values, in one spelling.
    fn text(&self, text: &str) -> String {
        if self.input.dialect.quirks.declares_names() {
            // what is between parentheses are arguments
            let text = text.replace('(', "[").replace(')', "]");
            return self.interpreter.resolved_text(&canonical_text(&text));
        }
        self.interpreter.resolved_text(&canonical_text(text))
    }

    fn words_of(&self, block: &Block<'_>, lost: &Lost, said: &mut Said) {
        let (program, dialect) = (self.input.program, self.input.dialect);
        for item in block.items() {
            match item {
                Item::Word(word) => self.word(&word, lost, said),
                Item::Call(call) => {
                    let modal = dialect
                        .name(&program.text(call.name))
                        .is_some_and(|code| code.group.is_some());
                    if !modal || call.arguments.is_some() {
                        said.whole(|| self.text(&program.text(call.range)), lost.linear);
                    }
                }
                Item::Other(range) => said.whole(|| self.text(&program.text(range)), lost.linear),
                Item::Comment(_) | Item::Skip(..) | Item::Percent(_) | Item::Label(_) => {}
            }
        }
    }

    /// A word along X, Y, Z, U, V or W in mm, so that inches say the same; in a cycle of holes also Q, R, I and J, which are lengths there.
    /// `None`: it is no plain number, or no such word.
    fn in_mm(&self, letter: u8, word: &Word) -> Option<String> {
        let axis = AxisLetter::new(letter).filter(|axis| !(3..6).contains(&axis.0));
        // J of a tap counts how many times faster it goes out
        let taps = matches!(self.state().motion, Some(Action::TapCycle | Action::TapLeftCycle));
        let in_hole = self.in_hole() && (matches!(letter, b'Q' | b'R') || matches!(letter, b'I' | b'J') && !taps);
        if axis.is_none() && !in_hole {
            return None;
        }
        let Value::Number(number) = word.value else { return None };
        // without a decimal point a parameter of the control may decide what it means
        let text = self.input.program.text(word.value_range);
        let mm = number.to_f64() * self.state().coordinates.unit_mm();
        if mm != 0.0 && !text.contains('.') {
            return None;
        }
        // inches have more digits than a word
        let mm = (mm * 1e9).round() / 1e9 + 0.0;
        Some(format!("{}{mm}", char::from(letter)))
    }

    /// F of a cycle of holes in mm; `None`: it is no plain number, or counts otherwise.
    fn feed_in_mm(&self, letter: u8, word: &Word) -> Option<String> {
        let Value::Number(number) = word.value else { return None };
        let feed = &self.state().feed;
        if letter != b'F' || !self.in_hole() || feed.mode() == FeedMode::InverseTime {
            return None;
        }
        let mm = (number.to_f64() * feed.unit_mm() * 1e9).round() / 1e9;
        Some(format!("F{mm}"))
    }

    /// Whether a cycle of holes runs.
    fn in_hole(&self) -> bool {
        self.state().motion.is_some_and(Action::is_hole_cycle)
    }

    fn word(&self, word: &Word, lost: &Lost, said: &mut Said) {
        let (program, dialect) = (self.input.program, self.input.dialect);
        let text = || self.text(&program.text(word.range));
        let Address::Letter(letter) = word.address else {
            return said.whole(text, lost.linear);
        };
        let letter = letter.to_ascii_uppercase();
        match dialect.role(letter) {
            Some(Role::G) => {
                let tenths = match word.value {
                    Value::Number(number) => (number.to_f64() * 10.0).round(),
                    _ => -1.0,
                };
                let code = (0.0..1e6).contains(&tenths).then_some(tenths as u32);
                // what is modal is compared as it is in effect
                if code
                    .and_then(|code| dialect.g(code))
                    .is_none_or(|code| code.group.is_none())
                {
                    said.add(text);
                }
                return;
            }
            Some(Role::M) => return,
            _ => {}
        }
        match letter {
            b'H' if !dialect.quirks.diameter => {}
            b'F' | b'E' if lost.feed || lost.kind => match self.feed_in_mm(letter, word) {
                Some(plain) => {
                    said.counts |= lost.feed;
                    said.add(|| plain);
                }
                None => said.whole(text, lost.feed),
            },
            b'N' | b'O' | b'S' | b'T' | b'D' | b'F' | b'E' => {}
            _ => {
                // increments of a lathe
                let axis = match (letter, dialect.quirks.diameter) {
                    (b'U', true) => b'X',
                    (b'W', true) => b'Z',
                    (b'H', true) => b'C',
                    (letter, _) => letter,
                };
                let counts = match AxisLetter::new(axis) {
                    Some(axis) => lost.axes & (1 << axis.0) != 0,
                    None => lost.linear && !lost.arc,
                };
                // the increments of a lathe, and the time of a dwell, stay as they are written
                said.counts |= counts;
                if !said.wanted {
                    return;
                }
                let is_read = !lost.kind || self.in_hole();
                match self.in_mm(letter, word).filter(|_| axis == letter && is_read) {
                    Some(plain) => said.words.push(plain),
                    None => said.whole(text, counts),
                }
            }
        }
    }

    fn sentence_of(&self, block: &Block<'_>, lost: &Lost, said: &mut Said) {
        let Some(sentence) = block.sentence() else { return };
        let text = String::from_utf8_lossy(&sentence.text()).to_ascii_uppercase();
        // the corner that follows cuts off the end
        let mut blocks = (block.id().0 + 1..block.program().block_count() as u32).map(BlockId);
        let next = blocks.find_map(|id| block.program().block(id).sentence());
        let corner = next.map(|next| String::from_utf8_lossy(&next.text()).to_ascii_uppercase());
        if let Some(corner) = corner.filter(|text| text.starts_with("RND") || text.starts_with("CHF")) {
            said.whole(|| self.text(&corner), lost.linear);
        }
        let mut words = text.split_whitespace();
        if words.next() != Some("L") {
            return said.whole(|| self.text(&text), lost.linear || lost.feed);
        }
        for word in words {
            let bare = word.strip_prefix('I').unwrap_or(word);
            let is_value = |byte: &u8| byte.is_ascii_digit() || b"+-.,Q".contains(byte);
            let named = bare.as_bytes().get(1).is_some_and(is_value);
            let axis = bare.bytes().next().and_then(AxisLetter::new).filter(|_| named);
            match axis {
                Some(axis) => said.whole(|| self.text(word), lost.axes & (1 << axis.0) != 0),
                None if word.starts_with('F') && lost.feed => said.whole(|| self.text(word), true),
                None if word.starts_with('F') => {}
                None if matches!(word, "R0" | "RL" | "RR" | "AUTO" | "MAX")
                    || word.starts_with('M') && word != "M91" => {}
                None => said.whole(|| self.text(word), lost.linear),
            }
        }
    }
}

impl Said {
    /// Adds a word.
    fn add(&mut self, text: impl FnOnce() -> String) {
        if self.wanted {
            self.words.push(text());
        }
    }

    /// Adds something that counts in the unit of the program; `counts`: its result is not known.
    fn whole(&mut self, text: impl FnOnce() -> String, counts: bool) {
        self.in_units = true;
        self.counts |= counts;
        self.add(text);
    }

    /// In one order, with what the numbers are. Where a corner has cut off the end, or a cycle has several levels, the unknown values still differ by as much
    /// as the places do.
    fn told(mut self, motion: &Motion, state: &ModalState) -> Arc<str> {
        self.words.sort();
        let coordinates = &state.coordinates;
        let mut told = self.words.join(" ");
        if coordinates.incremental() {
            told.push_str(" (incremental)");
        }
        if coordinates.unit_mm() != 1.0 && self.in_units {
            told.push_str(" (inch)");
        }
        told.push(ENDS);
        for axis in (0..3).filter(|axis| motion.end.known & (1 << axis) == 0) {
            let value = motion.end.values[axis];
            if value != 0.0 && !value.is_nan() {
                let _ = write!(told, "{}{value:.6}", char::from(AXIS_LETTERS[axis]));
            }
        }
        told.into()
    }
}
