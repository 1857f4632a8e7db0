//! The words of one ISO block, gathered in one pass into fixed places.
use crate::{AXIS_LETTERS, FaultKind, codes::Found};
use trunnion_dialect::{Action, Code, CodeKind, Dialect, Role};
use trunnion_syntax::{Address, Call, Decimal, Item, Program, SyntaxError, TextRange, Value, Word};

/// A number as it is meant, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) has_point: bool,
    pub(crate) range: TextRange,
}

/// What a word says.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) enum Said {
    /// There is no such word.
    #[default]
    Nothing,
    /// A number.
    Number(Number),
    /// A quoted name.
    Name(TextRange),
    /// Something that is not evaluated.
    Unread,
}

impl Said {
    pub(crate) fn number(self) -> Option<Number> {
        if let Self::Number(number) = self {
            Some(number)
        } else {
            None
        }
    }
    pub(crate) fn is_said(self) -> bool {
        !matches!(self, Self::Nothing)
    }
}

/// Values of numbered places with masks that say how each was written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Places<const N: usize> {
    pub(crate) values: [f64; N],
    /// A number is there.
    pub(crate) given: u16,
    /// A word is there, its value is not known.
    pub(crate) unread: u16,
    /// AC(): absolute whatever is modal.
    pub(crate) absolute: u16,
    /// IC(): incremental whatever is modal.
    pub(crate) incremental: u16,
    /// DC(): absolute, by the shorter way.
    pub(crate) shortest: u16,
    /// ACP(): absolute, turning positive.
    pub(crate) positive: u16,
    /// ACN(): absolute, turning negative.
    pub(crate) negative: u16,
    /// Written with a decimal point.
    pub(crate) point: u16,
}

impl<const N: usize> Default for Places<N> {
    fn default() -> Self {
        Self {
            values: [0.0; N],
            given: 0,
            unread: 0,
            absolute: 0,
            incremental: 0,
            shortest: 0,
            positive: 0,
            negative: 0,
            point: 0,
        }
    }
}

impl<const N: usize> Places<N> {
    pub(crate) fn any(&self) -> bool {
        self.given | self.unread != 0
    }
    pub(crate) fn get(&self, place: usize) -> Option<f64> {
        (self.given & (1 << place) != 0).then(|| self.values[place])
    }
    fn put(&mut self, place: usize, number: Number) {
        self.values[place] = number.value;
        self.given |= 1 << place;
        self.point |= u16::from(number.has_point) << place;
    }
}

/// The words of one block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Words {
    pub(crate) axes: Places<9>,
    pub(crate) centre: Places<3>,
    pub(crate) vector: Places<3>,
    pub(crate) radius: Said,
    pub(crate) turns: Said,
    pub(crate) feed: Said,
    pub(crate) speed: Said,
    pub(crate) tool: Said,
    pub(crate) length_offset: Said,
    pub(crate) edge: Said,
    /// P, the only parameter that a modelled code reads (dwell, turns of an arc).
    pub(crate) p: Said,
    /// The first word that is a coordinate, centre, radius or vector component.
    pub(crate) first: Option<TextRange>,
    /// A word with a letter beside N, O, G, M: distinguishes `TRANS X1` from `TRANS`.
    pub(crate) has_values: bool,
    /// A program number stands in the block.
    pub(crate) program_number: Option<TextRange>,
    /// The block declares names: nothing in it is a position.
    pub(crate) declares: bool,
    /// The block holds something that may move anything: a call, a jump, an unknown name.
    pub(crate) forgets_all: bool,
    /// A G code without meaning stands in the block.
    pub(crate) unknown_code: bool,
    /// `%` without a name.
    pub(crate) percent: Option<TextRange>,
    /// Any word, name or code at all.
    pub(crate) has_content: bool,
    /// Letters seen (A is bit 0).
    letters: u32,
}

/// A number, unless it is beyond what can be reckoned with.
fn number(decimal: Decimal, range: TextRange) -> Said {
    let value = decimal.to_f64();
    if value.abs() <= LARGEST {
        Said::Number(Number {
            value,
            has_point: decimal.has_point,
            range,
        })
    } else {
        Said::Unread
    }
}

/// No coordinate, feed or number of a tool is larger; squares and sums stay finite.
const LARGEST: f64 = 1e12;

/// Ten times the number of a code, where that is whole: G43.4 is 434.
fn tenths(decimal: Decimal) -> Option<u32> {
    let mut mantissa = decimal.mantissa.checked_mul(10)?;
    let mut scale = decimal.scale;
    while scale > 0 {
        if mantissa % 10 != 0 {
            return None;
        }
        mantissa /= 10;
        scale -= 1;
    }
    if scale < 0 {
        return None;
    }
    u32::try_from(mantissa).ok()
}

/// Index of an axis letter, upper case, in [`AXIS_LETTERS`].
fn axis_index(letter: u8) -> Option<usize> {
    AXIS_LETTERS.iter().position(|&axis| axis == letter)
}

/// Reads one block: fills words and codes, reports what has no meaning.
pub(crate) struct Reader<'a, 'd, F: FnMut(TextRange, FaultKind)> {
    pub(crate) program: &'a Program,
    pub(crate) dialect: &'d Dialect,
    pub(crate) words: Words,
    pub(crate) codes: &'a mut Vec<Found<'d>>,
    pub(crate) report: F,
}

impl<'d, F: FnMut(TextRange, FaultKind)> Reader<'_, 'd, F> {
    /// Takes one item of the block.
    pub(crate) fn take(&mut self, item: Item) {
        if self.words.declares {
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
            Item::Comment(_) | Item::Skip(..) | Item::Label(_) => {}
        }
    }

    fn text(&self, range: TextRange) -> String {
        self.program.text(range).trim().to_owned()
    }

    fn not_modelled(&mut self, range: TextRange) {
        let what = self.text(range);
        (self.report)(range, FaultKind::NotModelled { what });
    }

    fn word(&mut self, word: &Word) {
        match word.address {
            Address::Letter(letter) => self.letter_word(letter, word),
            Address::Indexed(letter, index) => self.indexed_word(letter, index, word),
            Address::Named(name) => {
                let role = self
                    .program
                    .source()
                    .get(name.as_usize())
                    .and_then(|name| self.dialect.named_role(name));
                match role {
                    Some(role) => self.role_word(role, b' ', word),
                    None if self.dialect.quirks.user_names => self.words.has_values = true,
                    None => (self.report)(word.range, FaultKind::UnknownWord),
                }
            }
        }
    }

    fn letter_word(&mut self, letter: u8, word: &Word) {
        let Some(role) = self.dialect.role(letter) else {
            (self.report)(word.range, FaultKind::UnknownWord);
            return;
        };
        if !matches!(role, Role::G | Role::M) {
            let bit = 1u32.checked_shl(u32::from(letter.wrapping_sub(b'A'))).unwrap_or(0);
            if self.words.letters & bit != 0 {
                (self.report)(word.range, FaultKind::RepeatedWord);
            }
            self.words.letters |= bit;
        }
        self.role_word(role, letter, word);
    }

    /// `A3=`, `S2=`, `R1=`: first as a name of its own, then a further spindle, tool or function, else a variable.
    fn indexed_word(&mut self, letter: u8, index: u16, word: &Word) {
        let mut name = [0u8; 6];
        name[0] = letter;
        let mut digits = 1;
        let mut divisor = 10_000;
        while divisor > 0 {
            if index >= divisor || divisor == 1 {
                name[digits] = b'0' + (index / divisor % 10) as u8;
                digits += 1;
            }
            divisor /= 10;
        }
        if let Some(role) = self.dialect.named_role(&name[..digits]) {
            self.role_word(role, letter, word);
            return;
        }
        match self.dialect.role(letter) {
            Some(Role::Speed) => self.words.speed = Said::Unread,
            Some(Role::Tool) => self.words.tool = Said::Unread,
            Some(Role::ArcRadius | Role::Parameter | Role::Variable) => {
                self.words.has_values = true;
                return;
            }
            _ => {}
        }
        self.words.has_values = true;
        self.not_modelled(word.range);
    }

    fn role_word(&mut self, role: Role, letter: u8, word: &Word) {
        match role {
            Role::BlockNumber => return,
            Role::ProgramNumber => {
                self.words.program_number = Some(word.range);
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
                put(&mut self.words.centre, usize::from(letter.wrapping_sub(b'I') % 3), said);
            }
            Role::ToolVector => {
                self.first(word);
                let said = self.said_place(word);
                put(&mut self.words.vector, usize::from(letter.wrapping_sub(b'A') % 3), said);
            }
            Role::ArcRadius => {
                self.first(word);
                self.words.radius = self.said(word);
            }
            Role::ArcTurns => self.words.turns = self.said(word),
            Role::Feed => self.words.feed = self.said(word),
            Role::Speed => self.words.speed = self.said(word),
            Role::Tool => self.words.tool = self.said(word),
            Role::LengthOffset => self.words.length_offset = self.said(word),
            Role::EdgeOffset => self.words.edge = self.said(word),
            Role::Parameter if letter == b'P' => self.words.p = self.said(word),
            Role::NotModelled => {
                self.words.forgets_all = true;
                self.not_modelled(word.range);
            }
            // a variable moves nothing; where it is used, that place is reported
            _ => {}
        }
    }

    fn first(&mut self, word: &Word) {
        if self.words.first.is_none() {
            self.words.first = Some(word.range);
        }
    }

    /// A word that knows only numbers and names.
    fn said(&mut self, word: &Word) -> Said {
        match word.value {
            Value::Number(decimal) => number(decimal, word.range),
            Value::Text(range) => Said::Name(range),
            Value::Missing | Value::Bad => Said::Unread,
            Value::Expression(_) | Value::Call(..) => {
                self.not_modelled(word.value_range);
                Said::Unread
            }
        }
    }

    /// A word that also knows AC(), IC(), DC(), ACP(), ACN().
    fn said_place(&mut self, word: &Word) -> (Said, Reading) {
        if let Value::Call(name, decimal) = word.value {
            let name = self.program.source().get(name.as_usize()).unwrap_or_default();
            let reading = READINGS.iter().find(|(known, _)| name.eq_ignore_ascii_case(known));
            if let Some(&(_, reading)) = reading {
                return (number(decimal, word.range), reading);
            }
        }
        (self.said(word), Reading::Modal)
    }

    fn code_word(&mut self, kind: CodeKind, word: &Word) {
        let Value::Number(decimal) = word.value else {
            if matches!(word.value, Value::Expression(_) | Value::Call(..) | Value::Text(_)) {
                self.words.forgets_all = true;
                self.not_modelled(word.range);
            }
            return;
        };
        let tenths = tenths(decimal);
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
            return;
        }
        let machine_builder = tenths.is_some_and(|tenths| self.dialect.builder_may_own(kind, tenths));
        self.words.unknown_code |= kind == CodeKind::G;
        (self.report)(word.range, FaultKind::UnknownCode { machine_builder });
    }

    fn call(&mut self, call: &Call) {
        let Some(code) = self.name(call.name) else {
            if std::mem::replace(&mut self.words.forgets_all, true) {
                return;
            }
            let kind = if self.dialect.quirks.user_names {
                FaultKind::NotModelled {
                    what: self.text(call.range),
                }
            } else {
                FaultKind::UnknownCode { machine_builder: false }
            };
            (self.report)(call.range, kind);
            return;
        };
        if code.action == Action::Declaration {
            self.words.declares = true;
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
    }

    fn name(&self, range: TextRange) -> Option<&'d Code> {
        let name = std::str::from_utf8(self.program.source().get(range.as_usize())?).ok()?;
        self.dialect.name(name)
    }

    /// Text that is neither word nor name: an assignment or condition, unless the syntax has called it wrong already.
    fn other(&mut self, range: TextRange) {
        let overlaps = |error: &SyntaxError| error.range.start < range.end && range.start < error.range.end;
        let errors = self.program.errors();
        let from = errors.partition_point(|error| error.range.end <= range.start);
        if errors[from..].iter().take(4).any(overlaps) {
            return;
        }
        self.words.has_content = true;
        self.words.has_values = true;
        let source = self.program.source().get(range.as_usize()).unwrap_or_default();
        let assigns = source.first() == Some(&b'#') && source.contains(&b'=');
        if !assigns {
            self.words.forgets_all = true;
            self.not_modelled(range);
        }
    }
}

/// How a coordinate is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reading {
    Modal,
    Absolute,
    Incremental,
    Shortest,
    Positive,
    Negative,
}

const READINGS: [(&[u8], Reading); 5] = [
    (b"AC", Reading::Absolute),
    (b"IC", Reading::Incremental),
    (b"DC", Reading::Shortest),
    (b"ACP", Reading::Positive),
    (b"ACN", Reading::Negative),
];

fn put<const N: usize>(places: &mut Places<N>, place: usize, (said, reading): (Said, Reading)) {
    let bit = 1u16 << place;
    match said {
        Said::Number(number) => {
            places.put(place, number);
            match reading {
                Reading::Modal => {}
                Reading::Absolute => places.absolute |= bit,
                Reading::Incremental => places.incremental |= bit,
                Reading::Shortest => places.shortest |= bit,
                Reading::Positive => places.positive |= bit,
                Reading::Negative => places.negative |= bit,
            }
        }
        _ => places.unread |= bit,
    }
}
