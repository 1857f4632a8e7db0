//! A finding while its rule words it.
use crate::diagnostic::Origin;
use crate::place::{axis_word, code_range, orientation_range};
use crate::runs::Merge;
use crate::view::LegView;
use crate::{Diagnostic, Severity, Status, ValueKey};
use trunnion_syntax::{BlockId, Program, TextRange};

/// See the module. Unless its rule says another place, it is shown at the code of its block.
pub(crate) struct Draft<'p> {
    program: &'p Program,
    block: BlockId,
    place: Option<TextRange>,
    diagnostic: Diagnostic,
    merge: Option<Merge>,
    /// How many motions it holds of, and the block of the last.
    spans: Option<(u32, BlockId)>,
}

/// The part of a range that the program has.
pub(crate) fn within(program: &Program, range: TextRange) -> TextRange {
    let end = program.source().len() as u32;
    let start = range.start.min(end);
    TextRange::new(start, range.end.clamp(start, end))
}

impl<'p> Draft<'p> {
    /// A finding of a rule, without words.
    pub(crate) fn new(
        program: &'p Program,
        block: BlockId,
        rule: &'static str,
        severity: Severity,
        origin: Origin,
    ) -> Self {
        let nowhere = TextRange::new(0, 0);
        Self {
            program,
            block,
            place: None,
            diagnostic: Diagnostic {
                rule,
                severity,
                status: Status::Fail,
                range: nowhere,
                block: None,
                message: String::new(),
                notes: Vec::new(),
                help: None,
                values: Vec::new(),
                fixes: Vec::new(),
                replacement: None,
                related: Vec::new(),
                count: 1,
                last: nowhere,
                also: Vec::new(),
                own_severity: None,
                origin,
            },
            merge: None,
            spans: None,
        }
    }

    /// The finding, how it is merged with others, and its block where its rule looked at one.
    pub(crate) fn finish(mut self) -> (Diagnostic, Option<Merge>) {
        let range = self.place.unwrap_or_else(|| code_range(self.program, self.block));
        self.diagnostic.range = within(self.program, range);
        self.diagnostic.last = self.diagnostic.range;
        if let Some((count, last)) = self.spans {
            self.diagnostic.count = count;
            self.diagnostic.last = code_range(self.program, last);
        }
        (self.diagnostic, self.merge)
    }

    /// The text that its place should have instead.
    pub(crate) fn replace_with(&mut self, text: String) -> &mut Self {
        self.diagnostic.replacement = Some(text);
        self
    }

    /// As [`Self::replace_with`], where such a text is known.
    pub(crate) fn replace_with_some(&mut self, text: Option<String>) -> &mut Self {
        self.diagnostic.replacement = text;
        self
    }

    /// How bad it is.
    pub(crate) fn own_severity(&self) -> Severity {
        self.diagnostic.severity
    }

    /// What it says so far.
    pub(crate) fn message(&self) -> &str {
        &self.diagnostic.message
    }

    /// It holds of so many motions, the last of them in this block.
    pub(crate) fn spans(&mut self, count: u32, last: BlockId) -> &mut Self {
        self.spans = Some((count, last));
        self
    }

    /// Shows it at these bytes.
    pub(crate) fn at(&mut self, range: TextRange) -> &mut Self {
        self.place = Some(range);
        self
    }

    /// Shows it at the word of an axis (upper case letter), see [`axis_word`].
    pub(crate) fn at_axis(&mut self, letter: u8) -> &mut Self {
        self.at(axis_word(self.program, self.block, letter))
    }

    /// Shows it at the words of the tool's orientation, see [`orientation_range`].
    pub(crate) fn at_orientation(&mut self) -> &mut Self {
        self.at(orientation_range(self.program, self.block))
    }

    /// What is wrong, in one sentence with numbers and units.
    pub(crate) fn say(&mut self, message: impl Into<String>) -> &mut Self {
        self.diagnostic.message = message.into();
        self
    }

    /// Why it matters, or more numbers.
    pub(crate) fn note(&mut self, note: impl Into<String>) -> &mut Self {
        self.diagnostic.notes.push(note.into());
        self
    }

    /// What to do.
    pub(crate) fn help(&mut self, help: impl Into<String>) -> &mut Self {
        self.diagnostic.help = Some(help.into());
        self
    }

    /// A number of the message; the key ends in its unit.
    pub(crate) fn value(&mut self, key: &'static str, value: f64) -> &mut Self {
        self.diagnostic.values.push((key, ValueKey::Number(value)));
        self
    }

    /// A text of the message, such as an axis letter.
    pub(crate) fn value_text(&mut self, key: &'static str, value: impl Into<String>) -> &mut Self {
        self.diagnostic.values.push((key, ValueKey::Text(value.into())));
        self
    }

    /// Another severity than the rule's own.
    pub(crate) fn severity(&mut self, severity: Severity) -> &mut Self {
        self.diagnostic.severity = severity;
        self
    }

    /// The rule could not decide; the message says what is missing.
    pub(crate) fn unknown(&mut self) -> &mut Self {
        self.diagnostic.status = Status::Unknown;
        self.diagnostic.severity = Severity::Info;
        self
    }

    fn fix(&mut self, rewrite: &'static str) -> &mut Self {
        self.diagnostic.fixes.push(rewrite);
        self
    }

    /// The rewrite that guides a path around the pole, where it passes near it and no limit forces the change of posture.
    pub(crate) fn fix_pole(&mut self, view: &LegView<'_>) -> &mut Self {
        if view.near_pole() && view.forced_swap().is_none() {
            self.fix("smooth-pole");
        }
        self
    }

    /// The rewrite that leads rapid motions past the declared obstacles.
    pub(crate) fn fix_rapid(&mut self, view: &LegView<'_>) -> &mut Self {
        if !view.machine.obstacles.only_parts() {
            self.fix("reroute-rapid");
        }
        self
    }

    /// The rewrite that takes whole turns away, where an axis turns far.
    pub(crate) fn fix_turns(&mut self, view: &LegView<'_>) -> &mut Self {
        if view.turns_far() {
            self.fix("unwind-rotary");
        }
        self
    }

    /// The rewrite that writes the feed that the axes allow.
    pub(crate) fn fix_feed(&mut self) -> &mut Self {
        self.fix("adapt-feed")
    }

    /// The rewrite that puts points into a line, where the control does not guide the tip.
    pub(crate) fn fix_points(&mut self, view: &LegView<'_>) -> &mut Self {
        let plain = view.motion().kind == trunnion_interp::MotionKind::Linear && !view.motion().tcp;
        if plain && matches!(view.motion().orientation, trunnion_interp::Orientation::Words) {
            self.fix("insert-points");
        }
        self
    }

    /// The rewrite that chooses other postures and turns, where they are programmed and the machine has them.
    pub(crate) fn fix_posture(&mut self, view: &LegView<'_>) -> &mut Self {
        let vector = matches!(view.motion().orientation, trunnion_interp::Orientation::Vector(..));
        if view.machine.rotary.len() == 2 && !vector && view.motion().is_feed() && view.forced_swap().is_none() {
            self.fix("switch-angles");
        }
        self
    }

    /// The rewrite that turns the machine over away from the part.
    pub(crate) fn fix_retract(&mut self, view: &LegView<'_>) -> &mut Self {
        let vector = matches!(view.motion().orientation, trunnion_interp::Orientation::Vector(..));
        if view.machine.rotary.len() == 2 && !vector && view.motion().kind == trunnion_interp::MotionKind::Linear {
            self.fix("insert-retract");
        }
        self
    }

    /// Another place of interest.
    pub(crate) fn related(&mut self, range: TextRange, message: impl Into<String>) -> &mut Self {
        self.diagnostic.related.push((range, message.into()));
        self
    }

    /// How it is put together with others of its rule.
    pub(crate) fn merge(&mut self, merge: Merge) -> &mut Self {
        self.merge = Some(merge);
        self
    }
}
