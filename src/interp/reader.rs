//! Reads the items of one ISO block in one pass, with the meaning that the dialect gives to letters and names.
use crate::codes::Found;
use crate::macro_b::Macros;
use crate::own::Own;
use crate::values::{number, tenths};
use crate::words::{WordValue, Words, put};
use crate::{AXIS_LETTERS, AllClampCodes, Clamps, FaultKind};
use trunnion_dialect::{Action, Code, CodeKind, Dialect, Role};
use trunnion_syntax::{Address, BlockId, Call, Decimal, Item, Program, SyntaxError, TextRange, Value, Word};

/// No coordinate, feed or tool number may be larger; squares and sums stay finite.
pub(crate) const LARGEST: f64 = 1e12;

/// Index in [`AXIS_LETTERS`] of each letter from A; `NO_AXIS` where it is none.
const AXES: [u8; 26] = {
    let mut axes = [NO_AXIS; 26];
    let mut axis = 0;
    while axis < AXIS_LETTERS.len() {
        axes[(AXIS_LETTERS[axis] - b'A') as usize] = axis as u8;
        axis += 1;
    }
    axes
};
const NO_AXIS: u8 = u8::MAX;

/// Index of an axis letter, upper case, in [`AXIS_LETTERS`].
fn axis_index(letter: u8) -> Option<usize> {
    AXES.get(usize::from(letter.wrapping_sub(b'A')))
        .filter(|&&axis| axis != NO_AXIS)
        .map(|&axis| usize::from(axis))
}

/// A name without the axis of `DIAMONA[X]`.
pub(crate) fn without_index(name: &str) -> &str {
    name.split('[').next().unwrap_or_default().trim_end()
}

/// Reads one block: fills words and codes, reports what has no meaning.
pub(crate) struct Reader<'a, 'd, F: FnMut(TextRange, FaultKind)> {
    pub(crate) program: &'a Program,
    pub(crate) dialect: &'d Dialect,
    pub(crate) block: BlockId,
    pub(crate) words: &'a mut Words,
    pub(crate) codes: &'a mut Vec<Found<'d>>,
    /// The switch for block delete, where its state is known.
    pub(crate) delete: Option<bool>,
    /// The clamps, and their codes.
    pub(crate) clamps: (&'a mut Clamps, &'a AllClampCodes),
    /// Variables and flow, in dialects that have macros.
    pub(crate) macros: Option<Macros<'a>>,
    /// Variables of a Sinumerik program.
    pub(crate) own: Option<&'a mut Own>,
    pub(crate) report: F,
}

impl<'d, F: FnMut(TextRange, FaultKind)> Reader<'_, 'd, F> {
    /// Takes one item of the block.
    #[inline]
    pub(crate) fn take(&mut self, item: Item) {
        if self.words.rest_deleted.is_some() {
            return;
        }
        if let Item::Word(word) = &item
            && let (Address::Letter(letter), Value::Number(decimal)) = (word.address, word.value)
            && self.plain_axis(letter, decimal, word)
        {
            return;
        }
        self.take_other(item);
    }

    /// The most frequent word, an axis with a number, on a short path; false for other words.
    #[inline]
    fn plain_axis(&mut self, letter: u8, decimal: Decimal, word: &Word) -> bool {
        let Some(axis) = axis_index(letter) else { return false };
        let value = decimal.to_f64();
        let given = self.words.axes.given | self.words.axes.unread;
        let plain = given & (1 << axis) == 0 && !self.words.declares && value.abs() <= LARGEST;
        if !plain || self.dialect.role(letter) != Some(Role::Axis) {
            return false;
        }
        self.words.has_content = true;
        self.words.has_values = true;
        self.words.letters |= 1 << (letter - b'A');
        self.words.axes.values[axis] = value;
        self.words.axes.given |= 1 << axis;
        self.words.axes.point |= u16::from(decimal.has_point) << axis;
        self.first(word);
        true
    }

    fn take_other(&mut self, item: Item) {
        if self.words.declares {
            if let Item::Other(range) = item {
                self.program_name_of_macro(range);
            }
            return;
        }
        match item {
            Item::Word(word) => {
                self.words.has_content = true;
                self.word(&word);
            }
            Item::Call(call) => {
                self.words.has_content = true;
                self.call(&call);
            }
            Item::Percent(range) => {
                if range.end - range.start <= 1 {
                    self.words.percent = Some(range);
                }
            }
            Item::Other(range) => self.other(range),
            Item::Label(range) => self.task_label(range),
            Item::Comment(_) | Item::Skip(..) => {}
        }
    }

    pub(crate) fn text(&self, range: TextRange) -> String {
        self.program.text(range).trim().to_owned()
    }

    pub(crate) fn not_modelled(&mut self, range: TextRange) {
        let what = self.text(range);
        (self.report)(range, FaultKind::NotModelled { what });
    }

    fn word(&mut self, word: &Word) {
        match word.address {
            Address::Letter(letter) => self.letter_word(letter, word),
            Address::Indexed(letter, index) => self.indexed_word(letter, index, word),
            Address::Named(name) => self.named_word(name, word),
        }
    }

    fn letter_word(&mut self, letter: u8, word: &Word) {
        let Some(role) = self.dialect.role(letter) else {
            (self.report)(word.range, FaultKind::UnknownWord);
            return;
        };
        if role != Role::Axis && self.declared_word(&[letter], word) {
            return;
        }
        if !matches!(role, Role::G | Role::M) {
            let bit = 1u32.checked_shl(u32::from(letter.wrapping_sub(b'A'))).unwrap_or(0);
            if self.words.letters & bit != 0 {
                (self.report)(word.range, FaultKind::RepeatedWord);
            }
            self.words.letters |= bit;
        }
        self.role_word(role, letter, word);
    }

    /// Whether another word than a block number is before a place in its block: a program number is no such word.
    fn is_within_a_block(&self, range: TextRange) -> bool {
        let block = self.program.block(self.block);
        let before = block.words().find(|word| word.address != Address::Letter(b'N'));
        before.is_some_and(|word| word.range.start < range.start)
    }

    pub(crate) fn role_word(&mut self, role: Role, letter: u8, word: &Word) {
        match role {
            Role::BlockNumber => return self.block_number(word),
            Role::ProgramNumber => {
                let is_slip = matches!(word.value, Value::Bad | Value::Missing);
                if !is_slip && self.is_within_a_block(word.range) {
                    self.words.forgets_all = true;
                    return (self.report)(word.range, FaultKind::UnknownWord);
                }
                self.words.program_number = Some(word.range).filter(|_| !is_slip);
                return;
            }
            Role::G => return self.code_word(CodeKind::G, word),
            Role::M => return self.code_word(CodeKind::M, word),
            _ => self.words.has_values = true,
        }
        match role {
            Role::Axis => {
                if let Some(axis) = axis_index(letter) {
                    self.first(word);
                    let said = self.said_place(word);
                    put(&mut self.words.axes, axis, said);
                } else {
                    (self.report)(word.range, FaultKind::UnknownWord);
                }
            }
            Role::ArcCentre => {
                self.first(word);
                let said = self.said_place(word);
                self.words.by_letter.keep(letter, said.0);
                put(&mut self.words.centre, usize::from(letter.wrapping_sub(b'I') % 3), said);
            }
            Role::ToolVector => {
                self.first(word);
                let said = self.said_place(word);
                put(&mut self.words.vector, usize::from(letter.wrapping_sub(b'A') % 3), said);
            }
            Role::ArcRadius => {
                self.first(word);
                self.words.radius = self.kept(letter, word);
            }
            Role::PostureStatus => self.words.posture.status = Some((self.bits(word), word.range)),
            Role::PostureTurn => self.words.posture.turn = Some((self.bits(word), word.range)),
            Role::ArcTurns => self.words.turns = self.kept(letter, word),
            Role::Feed => self.words.feed = self.kept(letter, word),
            Role::FeedOverride => self.words.feed_share = self.kept(letter, word),
            Role::RapidOverride => self.words.rapid_share = self.kept(letter, word),
            Role::Speed => self.words.speed = self.kept(letter, word),
            Role::Tool => self.words.tool = self.kept(letter, word),
            Role::LengthOffset => self.words.length_offset = self.kept(letter, word),
            Role::EdgeOffset => self.words.edge = self.kept(letter, word),
            Role::FixedPoint => self.words.p = self.kept(letter, word),
            Role::Parameter if letter == b'P' => self.words.p = self.kept(letter, word),
            // the others must not be read: what is not evaluated is not reported
            Role::Parameter | Role::Increment => {
                let said = match word.value {
                    Value::Number(decimal) => number(decimal, word.range),
                    Value::Expression(range) => self.macro_value(word, range),
                    _ => WordValue::Unread,
                };
                self.words.by_letter.keep(letter, said);
            }
            Role::PathWord => self.path_word(word),
            Role::NotModelled if self.sinumerik_number(letter, word) || self.orientation_angle(letter, word) => {}
            Role::NotModelled => {
                self.words.forgets_all = true;
                self.not_modelled(word.range);
            }
            // a variable moves nothing; where it is used, that place is reported
            _ => {}
        }
    }

    pub(crate) fn first(&mut self, word: &Word) {
        self.words.first.get_or_insert(word.range);
    }

    fn code_word(&mut self, kind: CodeKind, word: &Word) {
        self.point_of_code(kind, word);
        let tenths = match word.value {
            Value::Number(decimal) => tenths(decimal),
            Value::Expression(range) if self.macros.is_some() => match self.macro_code(word, range) {
                Some(tenths) => Some(tenths),
                None => return self.unread_code(kind),
            },
            Value::Expression(_) | Value::Call(..) | Value::Text(_) => {
                self.words.forgets_all = true;
                self.unread_code(kind);
                return self.not_modelled(word.range);
            }
            Value::Missing | Value::Bad => return,
        };
        if self.macros.is_some() && tenths.is_some_and(|tenths| self.takes_flow_code(kind, tenths, word.range)) {
            return;
        }
        let (clamps, codes) = &mut self.clamps;
        let clamps_axis = kind == CodeKind::M && tenths.is_some_and(|tenths| clamps.hear(codes, tenths));
        let code = tenths.and_then(|tenths| match kind {
            CodeKind::M => self.dialect.m(tenths),
            _ => self.dialect.g(tenths),
        });
        if let Some(code) = code {
            self.codes.push(Found {
                code,
                range: word.range,
                with_arguments: false,
            });
            return self.flow_is_lost(code);
        }
        if clamps_axis {
            // the machine file has declared its effect
            return;
        }
        let machine_builder = tenths.is_some_and(|tenths| self.dialect.builder_may_own(kind, tenths));
        self.words.unknown_code |= kind == CodeKind::G;
        self.words.builder_code |= machine_builder;
        self.words.writes_system |= kind == CodeKind::G && self.dialect.quirks.user_task(); // it may turn the coordinates
        (self.report)(word.range, FaultKind::UnknownCode { machine_builder });
    }

    fn unread_code(&mut self, kind: CodeKind) {
        if kind == CodeKind::M {
            self.clamps.0.hear_unread(self.clamps.1);
        }
    }

    fn call(&mut self, call: &Call) {
        if self.macro_statement(call) || self.sinumerik_name(call) || self.task_name(call) {
            return;
        }
        let Some(code) = self.name(call.name) else {
            if std::mem::replace(&mut self.words.forgets_all, true) {
                return;
            }
            let kind = if self.dialect.quirks.user_names() {
                FaultKind::name_lacks(&self.text(call.range), false)
            } else {
                FaultKind::UnknownCode { machine_builder: false }
            };
            (self.report)(call.range, kind);
            return;
        };
        if code.action == Action::Declaration {
            self.words.declares = true;
            self.own_declaration(code, call.range);
        }
        let with_arguments = call.arguments.is_some_and(|inner| {
            self.program
                .source()
                .get(inner.as_usize())
                .is_some_and(|text| text.iter().any(|b| !b.is_ascii_whitespace()))
        });
        self.codes.push(Found {
            code,
            range: call.range,
            with_arguments,
        });
        self.flow_is_lost(code);
    }

    fn name(&self, range: TextRange) -> Option<&'d Code> {
        let name = std::str::from_utf8(self.program.source().get(range.as_usize())?).ok()?;
        self.dialect.name(without_index(name))
    }

    /// Text that is neither word nor name: an assignment or condition, unless the syntax has reported it already.
    fn other(&mut self, range: TextRange) {
        let overlaps = |error: &SyntaxError| error.range.start < range.end && range.start < error.range.end;
        let errors = self.program.errors();
        let from = errors.partition_point(|error| error.range.end <= range.start);
        if errors[from..].iter().take(4).any(overlaps) {
            return;
        }
        let source = self.program.source().get(range.as_usize()).unwrap_or_default();
        if source.first() == Some(&b'/') && self.dialect.quirks.delete_rest {
            self.words.rest_deleted = (self.delete == Some(true)).then_some(range);
            return;
        }
        self.words.has_content = true;
        self.words.has_values = true;
        if source.first() == Some(&b'<') {
            return self.program_name(range);
        }
        let assigns = source.first() == Some(&b'#') && source.contains(&b'=');
        if assigns {
            let name = source.split(|byte| *byte == b'=').next().unwrap_or_default();
            self.system_word(name, range);
        } else {
            self.words.forgets_all = true;
            self.not_modelled(range);
        }
    }
}
