//! How deeply a block is nested in subprograms, loops and conditions, by their words: RS274/NGC `o100 while`, Macro B `WHILE [..] DO1`,
//! Sinumerik `IF`, `FOR`, `LOOP`. Structures that do not fit together change nothing: this is layout, not a verdict.
use trunnion_syntax::{Address, Block, Item, Program, TextRange};

/// Deeper bodies are indented no further.
const DEEPEST: usize = 12;

/// What opened a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Sub,
    While,
    Do,
    If,
    Repeat,
    For,
    Loop,
}

/// What a block does to the nesting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    Open(Kind),
    /// `else`: belongs to the line that opened, and its body continues.
    Middle(Kind),
    Close(Kind),
    /// `o1 while` closes `o1 do`, and opens a loop if none is open.
    While,
    /// A new program: nothing of the last one is still open.
    Restart,
}

/// The bodies that are open.
#[derive(Clone, Debug, Default)]
pub(crate) struct Nesting {
    open: Vec<(Kind, Box<[u8]>)>,
}

/// How deeply each block is nested: lines that open or close a body are as deep as the lines around it.
pub fn depths(program: &Program) -> Vec<u8> {
    let mut nesting = Nesting::default();
    program.blocks().map(|block| nesting.depth(&block) as u8).collect()
}

impl Nesting {
    /// The depth of a block; what it opens applies from the next one.
    pub(crate) fn depth(&mut self, block: &Block<'_>) -> usize {
        let Some((step, label)) = step(block) else {
            return self.now();
        };
        match step {
            Step::Open(kind) => self.opened(kind, label),
            Step::Middle(kind) => self.now() - usize::from(self.fits(kind, &label)),
            Step::Close(kind) => {
                if self.fits(kind, &label) {
                    self.open.pop();
                }
                self.now()
            }
            Step::While if self.fits(Kind::Do, &label) => {
                self.open.pop();
                self.now()
            }
            Step::While => self.opened(Kind::While, label),
            Step::Restart => {
                self.open.clear();
                0
            }
        }
    }

    fn now(&self) -> usize {
        self.open.len().min(DEEPEST)
    }

    fn opened(&mut self, kind: Kind, label: Box<[u8]>) -> usize {
        let depth = self.now();
        self.open.push((kind, label));
        depth
    }

    fn fits(&self, kind: Kind, label: &[u8]) -> bool {
        self.open
            .last()
            .is_some_and(|(open, name)| *open == kind && **name == *label)
    }
}

/// The text of a range without blanks, lower case.
fn folded(program: &Program, range: TextRange) -> Box<[u8]> {
    let bytes = program.bytes(range).iter();
    bytes
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_lowercase)
        .collect()
}

/// What a block does, and with which label.
fn step(block: &Block<'_>) -> Option<(Step, Box<[u8]>)> {
    let program = block.program();
    let mut items = block
        .items()
        .filter(|item| !matches!(item, Item::Comment(_) | Item::Skip(..)));
    let mut first = items.next()?;
    if let Item::Word(word) = first
        && word.address == Address::Letter(b'N')
    {
        first = items.next()?;
    }
    match first {
        Item::Word(word) if word.address == Address::Letter(b'O') => {
            let label = folded(program, word.value_range);
            match items.next() {
                Some(Item::Call(call)) => Some((labelled(&folded(program, call.name))?, label)),
                _ => Some((Step::Restart, label)),
            }
        }
        Item::Percent(_) => Some((Step::Restart, Box::default())),
        Item::Call(call) => {
            let name = folded(program, call.name);
            let rest: Vec<Item> = items.collect();
            unlabelled(program, &name, call.arguments, &rest)
        }
        _ => None,
    }
}

/// O-words of RS274/NGC.
fn labelled(name: &[u8]) -> Option<Step> {
    Some(match name {
        b"sub" => Step::Open(Kind::Sub),
        b"endsub" => Step::Close(Kind::Sub),
        b"while" => Step::While,
        b"endwhile" => Step::Close(Kind::While),
        b"do" => Step::Open(Kind::Do),
        b"if" => Step::Open(Kind::If),
        b"elseif" | b"else" => Step::Middle(Kind::If),
        b"endif" => Step::Close(Kind::If),
        b"repeat" => Step::Open(Kind::Repeat),
        b"endrepeat" => Step::Close(Kind::Repeat),
        _ => return None,
    })
}

/// Macro B, whose loops have a number after DO and END, and Sinumerik, whose words are written alone.
fn unlabelled(
    program: &Program,
    name: &[u8],
    arguments: Option<TextRange>,
    rest: &[Item],
) -> Option<(Step, Box<[u8]>)> {
    let called = |wanted: &[&[u8]]| {
        rest.iter().find_map(|item| match item {
            Item::Call(call) => wanted.contains(&&*folded(program, call.name)).then_some(*call),
            _ => None,
        })
    };
    let number = |arguments: Option<TextRange>| arguments.map(|range| folded(program, range));
    let plain = |step| Some((step, Box::default()));
    match name {
        b"do" => Some((Step::Open(Kind::Do), number(arguments)?)),
        b"end" => Some((Step::Close(Kind::Do), number(arguments)?)),
        b"while" => match called(&[b"do"]) {
            Some(call) => Some((Step::Open(Kind::Do), number(call.arguments)?)),
            None => plain(Step::Open(Kind::While)),
        },
        b"endwhile" => plain(Step::Close(Kind::While)),
        b"if" if called(&[b"goto", b"gotof", b"gotob", b"gotoc", b"gotos", b"then"]).is_none() && rest.is_empty() => {
            plain(Step::Open(Kind::If))
        }
        b"else" | b"elseif" if rest.is_empty() => plain(Step::Middle(Kind::If)),
        b"endif" => plain(Step::Close(Kind::If)),
        b"for" => plain(Step::Open(Kind::For)),
        b"endfor" => plain(Step::Close(Kind::For)),
        b"loop" if rest.is_empty() => plain(Step::Open(Kind::Loop)),
        b"endloop" => plain(Step::Close(Kind::Loop)),
        b"repeat" if rest.is_empty() && arguments.is_none() => plain(Step::Open(Kind::Repeat)),
        b"until" => plain(Step::Close(Kind::Repeat)),
        _ => None,
    }
}
