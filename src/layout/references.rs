//! Where a program refers to its own block numbers: jumps, returns, local subprograms, contours of turning cycles. What cannot be
//! read as a number is reported, never guessed.
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Program, TextRange, TokenKind, Value};

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

/// The references to block numbers in a program.
#[derive(Default)]
pub(crate) struct Found {
    pub(crate) references: Vec<Reference>,
    pub(crate) obstacles: Vec<Obstacle>,
    /// Programs that are called by number.
    pub(crate) calls: Vec<Call>,
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

struct Reader<'r, 'p> {
    program: &'p Program,
    dialect: &'r Dialect,
    block: &'r Block<'p>,
    found: &'r mut Found,
}

impl Reader<'_, '_> {
    fn text(&self, range: TextRange) -> String {
        self.program.text(range).trim().to_owned()
    }

    fn obstacle(&mut self, range: TextRange, why: String) {
        self.found.obstacles.push(Obstacle { range, why });
    }

    fn refer(&mut self, digits: TextRange, number: i64, of_caller: bool) {
        self.found.references.push(Reference {
            block: self.block.id(),
            digits,
            number,
            of_caller,
        });
    }

    /// Jumps of Macro B and words next to M97, M98, M99 and turning cycles.
    fn items(&mut self) {
        let mut codes = Vec::new();
        let mut words = Vec::new();
        for item in self.block.items() {
            match item {
                Item::Word(word) => match (word.address, word.value) {
                    (Address::Letter(letter @ (b'G' | b'M')), Value::Number(number)) => {
                        codes.push((letter, number.to_integer().unwrap_or(-1)));
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
        let word = |letter: u8| words.iter().find(|(own, _)| *own == letter).map(|(_, word)| *word);
        if has((b'M', 99)) || has((b'M', 97)) {
            if let Some(p) = word(b'P') {
                self.target(p, has((b'M', 99)));
            }
        } else if turning && (self.dialect.quirks.diameter || word(b'Z').is_none() && word(b'R').is_none()) {
            // with Z or R it is a drilling cycle (G73), whose P and Q are a dwell and a depth
            if let (Some(p), Some(q)) = (word(b'P'), word(b'Q')) {
                self.target(p, false);
                self.target(q, false);
            }
        } else if has((b'M', 98)) || has((b'M', 198)) || has((b'G', 65)) || has((b'G', 66)) {
            self.call(word(b'P'));
            let names = word(b'H').or_else(|| word(b'Q').filter(|_| self.dialect.quirks.macro_b()));
            if let (Some(h), true) = (names, has((b'M', 98))) {
                let why = format!(
                    "`{}` in a block with M98 may name a block of the called program",
                    self.text(h.range)
                );
                self.obstacle(h.range, why);
            }
        }
    }

    /// Whether P and Q next to the code are blocks of a contour. On a Fanuc lathe the table decides: in system C G72 to G75 are what G70 to G73
    /// are in systems A and B.
    fn names_contour(&self, (letter, number): (u8, i64)) -> bool {
        if letter != b'G' {
            return false;
        }
        if !self.dialect.quirks.diameter {
            return (70..=73).contains(&number);
        }
        let code = u32::try_from(number)
            .ok()
            .and_then(|number| self.dialect.g(number.checked_mul(10)?));
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

    /// Sinumerik: every `N100` that is not the block's own number, and jumps whose target is computed.
    fn named(&mut self) {
        if self.program.options().paren_comment {
            return;
        }
        let own = own_number(self.block).map_or(u32::MAX, |(range, _)| range.start);
        let table = self.program.tokens();
        for id in self.block.tokens().filter(|&id| table.kind(id) == TokenKind::Word) {
            let range = table.range(id);
            let text = self.program.bytes(range);
            if (range.start..range.end).contains(&own) || !text[0].eq_ignore_ascii_case(&b'N') {
                continue;
            }
            let digits = TextRange::new(range.start + 1, range.end);
            if let Ok(number) = self.text(digits).parse() {
                self.refer(digits, number, false);
            }
        }
        for item in self.block.items() {
            if let Item::Call(call) = item {
                self.named_jump(call);
            }
        }
    }

    fn named_jump(&mut self, call: trunnion_syntax::Call) {
        let name = self.text(call.name).to_ascii_uppercase();
        if !matches!(name.as_str(), "GOTOF" | "GOTOB" | "GOTOC") {
            return;
        }
        let text = call.arguments.map(|range| self.text(range)).unwrap_or_default();
        if text.contains(['"', '$', '<', '[', '(']) {
            let why = format!(
                "the target of `{}` is computed: it is not known which block it refers to",
                self.text(call.range)
            );
            self.obstacle(call.range, why);
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
