//! Where a program refers to its own block numbers: jumps, returns, local subprograms, contours of turning cycles. What cannot be
//! read as a number is reported, never guessed.
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::{Address, Block, BlockId, Decimal, Format, Item, Program, TextRange, TokenKind, Value};

/// A reference to a block number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Reference {
    /// The block that names it.
    pub(crate) block: BlockId,
    /// Bytes of the number alone.
    pub(crate) digits: TextRange,
    /// The number.
    pub(crate) number: i64,
    /// It is a block of the program that called this one (M99 P).
    pub(crate) of_caller: bool,
}

/// A program that is called by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call {
    /// The block that calls it.
    pub block: BlockId,
    /// Its number; -1 where that is not whole.
    pub number: i64,
    /// Bytes of the word that names it.
    pub range: TextRange,
}

/// Why block numbers cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Obstacle {
    /// The place that prevents it.
    pub range: TextRange,
    /// What it is, and why the numbers stay, as a message.
    pub why: String,
}

/// Turning cycles of a control for milling: P and Q are the first and the last block of the contour.
const CONTOURS_ON_MILLS: [(u8, i64); 4] = [(b'G', 707), (b'G', 717), (b'G', 727), (b'G', 737)];

/// Codes whose P is the number of a program, in tenths.
const CALLS: [(u8, i64); 5] = [(b'M', 980), (b'M', 1980), (b'G', 650), (b'G', 660), (b'G', 661)];

/// The number of a code in tenths; -1 where it has more digits.
fn tenths(number: Decimal) -> i64 {
    let tenths = number.to_f64() * 10.0;
    if tenths.fract() == 0.0 && (0.0..1e6).contains(&tenths) {
        tenths as i64
    } else {
        -1
    }
}

/// The references to block numbers in a program.
#[derive(Default)]
pub(crate) struct Found {
    pub(crate) references: Vec<Reference>,
    pub(crate) obstacles: Vec<Obstacle>,
    /// Places that may name a block and are not followed.
    pub(crate) unread: Vec<Unread>,
    /// Programs that are called by number.
    pub(crate) calls: Vec<Call>,
}

/// A place that may name a block in a way that is not followed.
pub(crate) struct Unread {
    /// The number; `None` where it is put together while the program runs.
    pub(crate) number: Option<i64>,
    /// The place, and why that is in the way.
    pub(crate) obstacle: Obstacle,
}

/// Reads one block.
pub(crate) fn read(block: &Block<'_>, dialect: &Dialect, found: &mut Found) {
    let mut reader = Reader {
        program: block.program(),
        dialect,
        block,
        found,
    };
    reader.items();
    reader.parameters();
    reader.named();
}

pub(crate) struct Reader<'r, 'p> {
    pub(crate) program: &'p Program,
    pub(crate) dialect: &'r Dialect,
    pub(crate) block: &'r Block<'p>,
    pub(crate) found: &'r mut Found,
}

impl Reader<'_, '_> {
    pub(crate) fn text(&self, range: TextRange) -> String {
        self.program.text(range).trim().to_owned()
    }

    pub(crate) fn obstacle(&mut self, range: TextRange, why: String) {
        self.found.obstacles.push(Obstacle { range, why });
    }

    pub(crate) fn unread(&mut self, range: TextRange, number: Option<i64>, why: String) {
        self.found.unread.push(Unread {
            number,
            obstacle: Obstacle { range, why },
        });
    }

    pub(crate) fn refer(&mut self, digits: TextRange, number: i64, of_caller: bool) {
        self.found.references.push(Reference {
            block: self.block.id(),
            digits,
            number,
            of_caller,
        });
    }

    /// Jumps of Macro B, and words next to M96 to M99 and turning cycles.
    fn items(&mut self) {
        let mut codes = Vec::new();
        let mut words = Vec::new();
        for item in self.block.items() {
            match item {
                Item::Word(word) => match (word.address, word.value) {
                    (Address::Letter(letter @ (b'G' | b'M')), Value::Number(number)) => {
                        codes.push((letter, tenths(number)));
                    }
                    (Address::Letter(letter), _) => words.push((letter, word)),
                    _ => {}
                },
                Item::Call(call) if self.program.options().format == Format::Osp => {
                    let name = self.text(call.name).to_ascii_uppercase();
                    if matches!(name.as_str(), "IF" | "GOTO") {
                        let why =
                            format!("`{name}` names a block by its text (N0123 is not N123), so the numbers stay");
                        self.obstacle(call.range, why);
                    }
                }
                Item::Call(call) if self.text(call.name).eq_ignore_ascii_case("GOTO") => {
                    self.jump(call.range, call.arguments);
                }
                _ => {}
            }
        }
        let has = |code| codes.contains(&code);
        let turning = codes.iter().any(|&code| self.names_contour(code));
        let on_path = codes.iter().any(|code| CONTOURS_ON_MILLS.contains(code));
        let word = |letter: u8| words.iter().find(|(own, _)| *own == letter).map(|(_, word)| *word);
        if has((b'M', 990)) || has((b'M', 970)) || self.jumps_on_input(&codes) {
            if let Some(p) = word(b'P') {
                self.target(p, has((b'M', 990)));
            }
        } else if on_path || turning && (self.dialect.quirks.diameter || word(b'Z').is_none() && word(b'R').is_none()) {
            // with Z or R it is a drilling cycle (G73), whose P and Q are a dwell and a depth
            if let (Some(p), Some(q)) = (word(b'P'), word(b'Q')) {
                self.target(p, false);
                self.target(q, false);
            }
        } else if CALLS.iter().any(|&code| has(code)) {
            self.call(word(b'P'));
            let names = word(b'H').or_else(|| word(b'Q').filter(|_| self.dialect.quirks.macro_b()));
            if let (Some(h), true) = (names, has((b'M', 980))) {
                let why = format!(
                    "`{}` in a block with M98 may name a block of the called program",
                    self.text(h.range)
                );
                self.obstacle(h.range, why);
            }
        } else if !turning && codes.iter().any(|&code| self.is_not_known(code)) {
            for word in [word(b'P'), word(b'Q')].into_iter().flatten() {
                self.may_name(word);
            }
        }
    }

    /// M96 P of a Haas jumps to block P while an input is off (Haas mill operator's manual 96-8000, M96).
    fn jumps_on_input(&self, codes: &[(u8, i64)]) -> bool {
        let code = codes.contains(&(b'M', 960)).then(|| self.dialect.m(960)).flatten();
        code.is_some_and(|code| code.action == Action::SubprogramCall)
    }

    /// Whether it is not known what the words of a code are.
    fn is_not_known(&self, (letter, tenths): (u8, i64)) -> bool {
        let Ok(tenths) = u32::try_from(tenths) else { return true };
        let code = if letter == b'G' {
            self.dialect.g(tenths)
        } else {
            self.dialect.m(tenths)
        };
        code.is_none_or(|code| matches!(code.action, Action::NotModelled | Action::SubprogramCall))
    }

    /// A whole P or Q next to such a code.
    fn may_name(&mut self, word: trunnion_syntax::Word) {
        let Value::Number(number) = word.value else { return };
        let Some(number) = number.to_integer().filter(|number| *number > 0) else {
            return;
        };
        let why = format!(
            "`{}` is next to a code that is not known here, and may name block N{number}",
            self.text(word.range)
        );
        self.unread(word.range, Some(number), why);
    }

    /// Whether P and Q next to the code are blocks of a contour. On a Fanuc lathe the table decides: in system C G72 to G75 are what G70 to G73
    /// are in systems A and B.
    fn names_contour(&self, (letter, tenths): (u8, i64)) -> bool {
        if letter != b'G' {
            return false;
        }
        if !self.dialect.quirks.diameter {
            return [700, 710, 720, 730].contains(&tenths);
        }
        let code = u32::try_from(tenths).ok().and_then(|tenths| self.dialect.g(tenths));
        code.is_some_and(|code| {
            matches!(
                code.action,
                Action::FinishCycle | Action::RoughTurnCycle | Action::RoughFaceCycle | Action::PatternRepeatCycle
            )
        })
    }

    fn call(&mut self, p: Option<trunnion_syntax::Word>) {
        if let Some(p) = p
            && let Value::Number(number) = p.value
        {
            let number = number.to_integer().unwrap_or(-1);
            self.found.calls.push(Call {
                block: self.block.id(),
                number,
                range: p.range,
            });
        }
    }

    /// The target of `GOTO 100`.
    fn jump(&mut self, range: TextRange, arguments: Option<TextRange>) {
        let text = arguments.map(|range| self.text(range)).unwrap_or_default();
        let named = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') && !text.contains('[');
        match (arguments, text.parse()) {
            (Some(digits), Ok(number)) => self.refer(digits, number, false),
            // a label or `N100` (Sinumerik), which are read by their words
            _ if named => {}
            _ => {
                let why = format!(
                    "the target of `{}` is computed: it is not known which block it refers to",
                    self.text(range)
                );
                self.obstacle(range, why);
            }
        }
    }

    /// A word whose value is a block number.
    fn target(&mut self, word: trunnion_syntax::Word, of_caller: bool) {
        let number = match word.value {
            Value::Number(number) => number.to_integer(),
            _ => None,
        };
        if let Some(number) = number {
            return self.refer(word.value_range, number, of_caller);
        }
        let text = self.text(word.range);
        let why = format!("the target `{text}` is computed: it is not known which block it refers to");
        self.obstacle(word.range, why);
    }

    /// Parameters that hold a block number: #4014 and #4114, the last N that ran.
    fn parameters(&mut self) {
        let table = self.program.tokens();
        let tokens = self.block.tokens();
        for id in tokens.clone().filter(|&id| table.kind(id) == TokenKind::Hash) {
            let next = (id + 1..tokens.end).find(|&next| table.kind(next) != TokenKind::Blank);
            let Some(next) = next else { continue };
            if table.kind(next) == TokenKind::Number && matches!(self.text(table.range(next)).as_str(), "4014" | "4114")
            {
                let range = table.range(id).cover(table.range(next));
                let why = format!(
                    "`{}` reads a block number, and it is unknown what the program does with it",
                    self.text(range)
                );
                self.obstacle(range, why);
            }
        }
    }
}

/// The block's own number: bytes of its digits, and its value where it is whole.
pub(crate) fn own_number(block: &Block<'_>) -> Option<(TextRange, Option<i64>)> {
    if block.program().options().format == Format::Apt {
        return None;
    }
    let range = block.number()?;
    let word = block.words().find(|word| word.range == range)?;
    let Value::Number(number) = word.value else { return None };
    Some((word.value_range, number.to_integer()))
}

/// The number of the program that begins in this block (`O1000`, `:1000`), or `Some(-1)` for a name (`%_N_SHAFT_MPF`).
pub(crate) fn begins_program(block: &Block<'_>) -> Option<i64> {
    let mut items = block.items().filter(|item| !matches!(item, Item::Comment(_)));
    match items.next()? {
        Item::Word(word) if word.address == Address::Letter(b'O') => match (word.value, items.next()) {
            // with a name after it, it is an O-word of RS274/NGC
            (_, Some(Item::Call(_))) => None,
            (Value::Number(number), _) => Some(number.to_integer().unwrap_or(-1)),
            _ => None,
        },
        Item::Percent(range) if range.end - range.start > 1 => Some(-1),
        _ => None,
    }
}
