//! What expressions of Sinumerik and of Okuma's user task have in common: operands with infix operators between them, read to postfix code
//! without recursion. Blanks end names, brackets group and hold indices and arguments. [`Rules`] says what differs.
use crate::code::{Binary, Code, Formula, Op, Step, Unary};
use crate::{FormulaError, FormulaErrorKind as Kind, Name};
use trunnion_syntax::TextRange;

/// What is open or needs its second operand.
pub(crate) enum Waiting {
    Binary(Binary, u8),
    Unary(Unary),
    Group,
    /// `R[`
    Index,
    /// `FIELD[`
    Field(Name),
    One(Unary),
    /// A function of two arguments; whether the second is being read.
    Two(Binary, bool),
    /// BOUND: three arguments; how many commas are read.
    Bound(u8),
}

/// What one language decides.
pub(crate) trait Rules: Default {
    /// The sign that opens a group and the arguments of a function, and the one that closes it.
    const GROUP: [u8; 2];

    /// Passes over what may stand between two tokens.
    fn blanks(reader: &mut Reader<'_, Self>);

    /// Reads an operand that is no number, sign or group, or what precedes one; whether it was a whole operand.
    fn operand(reader: &mut Reader<'_, Self>, first: u8) -> Result<bool, Kind>;

    /// Reads the number at the cursor.
    fn number(reader: &mut Reader<'_, Self>) -> Result<(), Kind>;

    /// The operator at the cursor, its rank and its length.
    fn binary(reader: &Reader<'_, Self>) -> Option<(Binary, u8, usize)>;

    /// A bracket opens.
    fn open(&mut self) {}

    /// A bracket closes, or the second argument of a function begins.
    fn close(&mut self) {}

    /// An operator is read inside the innermost bracket.
    fn joined(&mut self, _binary: Binary, _rank: u8) {}

    /// Whether the order of the operators inside the innermost bracket is stated by a source.
    fn settled(&self) -> bool {
        true
    }
}

pub(crate) struct Reader<'s, R> {
    text: &'s [u8],
    at: u32,
    /// One past the last byte that belongs to the expression.
    end: u32,
    steps: Vec<Step>,
    waiting: Vec<Waiting>,
    /// How many values are kept at once, and the most.
    height: usize,
    depth: usize,
    /// A bracket that opens before this byte holds one index: brackets inside each other are looked through once.
    one_index_to: u32,
    rules: R,
}

/// What follows an operand.
enum NextToken {
    /// An operator: an operand must follow.
    Operand,
    /// The end of a bracket, which is an operand as a whole.
    Closed,
    /// Nothing that belongs to the expression.
    End,
}

/// Reads the expression that begins at the start of `range`, as far as it extends: the formula, and one past its last byte.
///
/// # Errors
/// The text is no expression.
pub(crate) fn read<R: Rules>(source: &[u8], range: TextRange) -> Result<(Formula, u32), FormulaError> {
    let end = range.end.min(u32::try_from(source.len()).unwrap_or(u32::MAX));
    let start = range.start.min(end);
    let mut reader = Reader {
        text: &source[start as usize..end as usize],
        at: 0,
        end: 0,
        steps: Vec::new(),
        waiting: Vec::new(),
        height: 0,
        depth: 0,
        one_index_to: 0,
        rules: R::default(),
    };
    match reader.run() {
        Ok(()) => {
            let formula = Formula {
                range: TextRange::new(start, start + reader.end),
                code: Code::Steps {
                    steps: reader.steps,
                    depth: reader.depth,
                },
            };
            Ok((formula, start + reader.end))
        }
        Err(kind) => {
            let at = (start + reader.at).min(end);
            Err(FormulaError {
                range: TextRange::new(at, (at + 1).min(end)),
                kind,
            })
        }
    }
}

impl<'s, R: Rules> Reader<'s, R> {
    pub(crate) fn rest(&self) -> &'s [u8] {
        &self.text[self.at as usize..]
    }

    pub(crate) fn peek(&self) -> Option<u8> {
        self.rest().first().copied()
    }

    /// The byte before the cursor.
    pub(crate) fn before(&self) -> Option<u8> {
        (self.at as usize).checked_sub(1).map(|at| self.text[at])
    }

    /// Passes over bytes that belong to the expression only if something follows.
    pub(crate) fn skip(&mut self, bytes: usize) {
        self.at += bytes as u32;
    }

    pub(crate) fn take(&mut self, bytes: usize) {
        self.skip(bytes);
        self.end = self.at;
    }

    /// Back to the end of what was taken last.
    pub(crate) fn back(&mut self) {
        self.at = self.end;
    }

    /// One more value.
    pub(crate) fn push(&mut self, op: Op) {
        self.height += 1;
        self.depth = self.depth.max(self.height);
        self.step(op);
    }

    fn step(&mut self, op: Op) {
        let range = TextRange::new(0, self.end);
        self.steps.push(Step { op, range });
    }

    /// A variable or text that is queried by `name`.
    pub(crate) fn named(&mut self, name: &str) {
        self.push(Op::Named(Name::new(name)));
    }

    /// An operator before its operand.
    pub(crate) fn prefix(&mut self, unary: Unary) {
        self.waiting.push(Waiting::Unary(unary));
    }

    /// Takes the bracket at the cursor, which opens what `waiting` says.
    pub(crate) fn open(&mut self, waiting: Waiting) {
        self.take(1);
        self.waiting.push(waiting);
        self.rules.open();
    }

    fn run(&mut self) -> Result<(), Kind> {
        loop {
            R::blanks(self);
            if !self.operand()? {
                continue;
            }
            loop {
                while let Some(&Waiting::Unary(unary)) = self.waiting.last() {
                    self.waiting.pop();
                    self.step(Op::Unary(unary));
                }
                R::blanks(self);
                match self.operator()? {
                    NextToken::Operand => break,
                    NextToken::Closed => {}
                    NextToken::End => return Ok(()),
                }
            }
        }
    }

    /// Reads a sign, NOT, an opening bracket or a whole operand; whether it was a whole operand.
    fn operand(&mut self) -> Result<bool, Kind> {
        match self.peek().ok_or(Kind::MissingValue)? {
            byte if byte == R::GROUP[0] => self.open(Waiting::Group),
            b'+' => self.take(1),
            b'-' => {
                self.take(1);
                self.prefix(Unary::Negate);
            }
            b'0'..=b'9' | b'.' => return R::number(self).map(|()| true),
            byte => return R::operand(self, byte),
        }
        Ok(false)
    }

    /// What follows a whole operand.
    fn operator(&mut self) -> Result<NextToken, Kind> {
        match self.peek() {
            Some(byte) if byte == R::GROUP[1] || byte == b']' => return self.close(byte),
            Some(b',') if matches!(self.innermost(), Some(Waiting::Two(_, false) | Waiting::Bound(0 | 1))) => {
                self.settle();
                self.rules.close();
                self.rules.open();
                self.take(1);
                match self.waiting.last_mut() {
                    Some(Waiting::Two(_, second)) => *second = true,
                    Some(Waiting::Bound(commas)) => *commas += 1,
                    _ => {}
                }
                return Ok(NextToken::Operand);
            }
            _ => {}
        }
        let Some((binary, rank, length)) = R::binary(self) else {
            if self.innermost().is_some() {
                return Err(Kind::UnclosedBracket);
            }
            self.settle();
            return Ok(NextToken::End);
        };
        self.rules.joined(binary, rank);
        self.reduce(rank);
        self.take(length);
        self.waiting.push(Waiting::Binary(binary, rank));
        Ok(NextToken::Operand)
    }

    /// The innermost bracket that is open.
    fn innermost(&self) -> Option<&Waiting> {
        let bracket = |waiting: &&Waiting| !matches!(waiting, Waiting::Binary(..));
        self.waiting.iter().rev().find(bracket)
    }

    /// Emits the operators inside the innermost bracket that bind at least as strongly as `rank`.
    fn reduce(&mut self, rank: u8) {
        while let Some(&Waiting::Binary(binary, own)) = self.waiting.last()
            && own >= rank
        {
            self.waiting.pop();
            self.height -= 1;
            let range = TextRange::new(0, self.end);
            Step::push_binary(&mut self.steps, binary, range);
        }
    }

    /// Emits all of them; the value is unknown where their order is.
    fn settle(&mut self) {
        self.reduce(0);
        if !self.rules.settled() {
            self.step(Op::Unary(Unary::Unsettled));
        }
    }

    fn close(&mut self, sign: u8) -> Result<NextToken, Kind> {
        self.settle();
        let group = sign == R::GROUP[1];
        let step = match self.waiting.last() {
            // the bracket belongs to the text around the expression
            None => return Ok(NextToken::End),
            Some(Waiting::Group) if group => None,
            Some(Waiting::Index) if sign == b']' => Some(Op::ReadAt),
            Some(Waiting::Field(name)) if sign == b']' => Some(Op::NamedAt(name.clone())),
            Some(&Waiting::One(unary)) if group => Some(Op::Unary(unary)),
            Some(&Waiting::Two(binary, true)) if group => {
                self.height -= 1;
                Some(Op::Binary(binary))
            }
            Some(Waiting::Bound(2)) if group => {
                self.height -= 2;
                Some(Op::Bound)
            }
            Some(Waiting::Two(_, false) | Waiting::Bound(_)) if group => return Err(Kind::MissingComma),
            _ => return Err(Kind::UnclosedBracket),
        };
        self.waiting.pop();
        self.rules.close();
        self.take(1);
        if let Some(op) = step {
            self.step(op);
        }
        Ok(NextToken::Closed)
    }

    /// Whether the bracket at the cursor holds one expression, which is no text.
    pub(crate) fn has_one_index(&mut self) -> bool {
        if self.at < self.one_index_to {
            return true;
        }
        let inside = self.rest().split(|&byte| byte == b']').next().unwrap_or_default();
        let one = !inside.iter().any(|byte| matches!(byte, b',' | b'"'));
        if one {
            self.one_index_to = self.at + inside.len() as u32;
        }
        one
    }

    /// Takes the bracket at the cursor with its contents. It stands for `name` and the bracket, which has no known value.
    pub(crate) fn bracket_of(&mut self, name: &str, [open, close]: [u8; 2]) -> Result<(), Kind> {
        let mut deep = 0usize;
        let mut quoted = false;
        for (at, &byte) in self.rest().iter().enumerate() {
            quoted ^= byte == b'"';
            if byte == open && !quoted {
                deep += 1;
            } else if byte == close && !quoted {
                deep -= 1;
                if deep == 0 {
                    self.take(at + 1);
                    self.named(&format!("{name}{}", char::from(open)));
                    return Ok(());
                }
            }
        }
        Err(Kind::UnclosedBracket)
    }
}

/// The operator that the word at the cursor names, its rank and its length.
pub(crate) fn operator_word(word: &[u8], known: &[(&[u8], Binary, u8)]) -> Option<(Binary, u8, usize)> {
    let &(_, binary, rank) = known.iter().find(|(name, ..)| word.eq_ignore_ascii_case(name))?;
    Some((binary, rank, word.len()))
}
