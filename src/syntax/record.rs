//! APT records: the major word of a statement and its arguments.
use crate::error::SyntaxErrorKind;
use crate::expression::is_one_of;
use crate::scan::Scan;
use crate::sink::{Quiet, Sink};
use crate::{Decimal, Program, SyntaxError, TextRange, TokenId, TokenKind};

/// An argument of an APT record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AptArg {
    /// A number and its bytes.
    Number(Decimal, TextRange),
    /// A minor word or identifier.
    Word(TextRange),
    /// Anything else: a nested definition `(POINT/1,2)`, an operator, a quoted text, the text of a text record, a broken
    /// number. Code that reads coordinates must stop at it.
    Other(TextRange),
}

/// An APT record: major word and what follows the slash.
#[derive(Clone, Copy)]
pub struct Record<'p> {
    /// The program.
    pub program: &'p Program,
    /// The major word's bytes (`GOTO`, `TOOL PATH`, `END-OF-PATH`; of `P1 = POINT/1,2` it is `POINT`); compare case-insensitively.
    pub major: TextRange,
    /// Bytes of the statement, without comments and blanks around it.
    pub range: TextRange,
    first: TokenId,
    end: TokenId,
}

/// The tokens of a record: its first one, the major word's, and where the arguments start.
struct Head {
    first: TokenId,
    major: (TokenId, TokenId),
    arguments: TokenId,
}

/// Reports every problem of the statement that starts at token `first`.
pub(crate) fn check(scan: Scan<'_>, first: TokenId, errors: &mut Vec<SyntaxError>) {
    let before = errors.len();
    let Some(head) = head(&scan, first, errors) else { return };
    let mut arguments = Arguments::new(scan, head.arguments);
    let (mut numbers, mut others) = (0, 0);
    while let Some(argument) = arguments.step(errors) {
        match argument {
            AptArg::Number(..) => numbers += 1,
            _ => others += 1,
        }
    }
    let major = scan.span(head.major.0, head.major.1);
    // a point, optionally with a tool axis and a feed; an argument that is not a number may represent several
    if others == 0
        && errors.len() == before
        && !matches!(numbers, 3 | 4 | 6 | 7)
        && scan.bytes(major).eq_ignore_ascii_case(b"GOTO")
    {
        let range = scan.span(head.first, scan.trim(head.first, scan.end));
        errors.push(SyntaxError {
            kind: SyntaxErrorKind::BadRecord,
            range,
        });
    }
}

impl<'p> Record<'p> {
    /// Reads the statement that starts at token `first`.
    pub(crate) fn read(program: &'p Program, scan: Scan<'p>, first: TokenId) -> Option<Self> {
        let head = head(&scan, first, &mut Quiet)?;
        Some(Self {
            program,
            major: scan.span(head.major.0, head.major.1),
            range: scan.span(head.first, scan.trim(head.first, scan.end)),
            first: head.arguments,
            end: scan.end,
        })
    }

    /// Whether the major word is `major`, in upper or lower case.
    pub fn is(&self, major: &str) -> bool {
        self.program.source()[self.major.as_usize()].eq_ignore_ascii_case(major.as_bytes())
    }

    /// The arguments in order.
    pub fn args(&self) -> impl Iterator<Item = AptArg> + use<'p> {
        Arguments::new(self.program.scan(self.end), self.first)
    }
}

/// Where the tool is beside its drive surface; a motion word may follow after a comma (ISO 4342).
const SIDES: [&str; 3] = ["TLON", "TLLFT", "TLRGT"];

/// The next token from `at` on that is neither blank nor comment nor continuation.
fn significant(scan: &Scan<'_>, mut at: TokenId) -> TokenId {
    while matches!(
        scan.kind(at),
        TokenKind::Blank | TokenKind::Comment | TokenKind::UnclosedComment | TokenKind::Continuation
    ) {
        at += 1;
    }
    at
}

/// Finds the major word. `None`, and a report, if the statement has none; `None` alone if it is empty.
fn head(scan: &Scan<'_>, first: TokenId, sink: &mut impl Sink) -> Option<Head> {
    let mut first = significant(scan, first);
    if first >= scan.end || scan.kind(first) == TokenKind::Newline {
        return None;
    }
    // A statement label: `LAB1)`.
    let behind = significant(scan, first + 1);
    if matches!(scan.kind(first), TokenKind::Name | TokenKind::Number) && scan.kind(behind) == TokenKind::ParenClose {
        first = significant(scan, behind + 1);
        if scan.kind(first) == TokenKind::Newline {
            return None;
        }
    }
    if scan.kind(first) != TokenKind::Name {
        sink.report(SyntaxErrorKind::BadRecord, scan.range(first));
        return None;
    }
    // `TOOL PATH/..` and `END-OF-PATH` are one major word each.
    let mut end = first + 1;
    loop {
        let mut next = significant(scan, end);
        if scan.kind(next) == TokenKind::Minus {
            next = significant(scan, next + 1);
        }
        if scan.kind(next) != TokenKind::Name {
            break;
        }
        end = next + 1;
    }
    let mut major = (first, end);
    let mut next = significant(scan, end);
    if scan.kind(next) == TokenKind::Equals {
        let defined = significant(scan, next + 1);
        let slash = significant(scan, defined + 1);
        if scan.kind(defined) == TokenKind::Name && scan.kind(slash) == TokenKind::Slash {
            major = (defined, defined + 1);
            next = slash;
        }
    }
    match scan.kind(next) {
        TokenKind::Slash => next += 1,
        // `TLON,GOFWD/(CIRCLE/...)`: a word for the tool's side, then the motion.
        TokenKind::Comma
            if is_one_of(scan.bytes(scan.span(first, end)), &SIDES)
                && scan.kind(significant(scan, next + 1)) == TokenKind::Name =>
        {
            next = significant(scan, next + 1);
        }
        // Text words may do without the slash; a number may not.
        TokenKind::Number => sink.report(SyntaxErrorKind::BadRecord, scan.range(next)),
        _ => {}
    }
    Some(Head {
        first,
        major,
        arguments: next,
    })
}

/// Iterator over the arguments of a record.
struct Arguments<'p> {
    scan: Scan<'p>,
    at: TokenId,
    /// The separator or operator in front, if no argument stands between.
    separator: Option<TokenKind>,
    /// Whether any argument was read.
    any: bool,
}

impl<'p> Arguments<'p> {
    fn new(scan: Scan<'p>, at: TokenId) -> Self {
        Self {
            scan,
            at,
            separator: Some(TokenKind::Slash),
            any: false,
        }
    }

    /// The next argument; problems go to `sink`.
    fn step(&mut self, sink: &mut impl Sink) -> Option<AptArg> {
        loop {
            let at = significant(&self.scan, self.at);
            if at >= self.scan.end {
                return self.finish(at, sink);
            }
            self.at = at + 1;
            match self.scan.kind(at) {
                TokenKind::Newline => return self.finish(at, sink),
                TokenKind::Comma => {
                    if self.separator.is_some() {
                        sink.report(SyntaxErrorKind::BadRecord, self.scan.range(at));
                    }
                    self.separator = Some(TokenKind::Comma);
                }
                TokenKind::Slash if self.separator.is_some() => {
                    sink.report(SyntaxErrorKind::BadRecord, self.scan.range(at));
                }
                _ => {
                    let separated = self.separator.take().is_some();
                    self.any = true;
                    return Some(self.argument(at, separated, sink));
                }
            }
        }
    }

    /// A comma with nothing after it is reported.
    fn finish(&mut self, at: TokenId, sink: &mut impl Sink) -> Option<AptArg> {
        self.at = at;
        if self.any && self.separator == Some(TokenKind::Comma) {
            let mut comma = at;
            while comma > 0 && self.scan.kind(comma - 1) != TokenKind::Comma {
                comma -= 1;
            }
            sink.report(SyntaxErrorKind::BadRecord, self.scan.range(comma.saturating_sub(1)));
        }
        self.separator = None;
        None
    }

    fn argument(&mut self, at: TokenId, separated: bool, sink: &mut impl Sink) -> AptArg {
        let scan = self.scan;
        let range = scan.range(at);
        match scan.kind(at) {
            TokenKind::Name => AptArg::Word(range),
            TokenKind::Number => {
                if !separated && !self.behind_operator(at) {
                    sink.report(SyntaxErrorKind::BadRecord, range);
                    return AptArg::Other(range);
                }
                if let Some(number) = number(scan.bytes(range)) {
                    AptArg::Number(number, range)
                } else {
                    sink.report(SyntaxErrorKind::BadNumber, range);
                    AptArg::Other(range)
                }
            }
            TokenKind::ParenOpen | TokenKind::BracketOpen => {
                let end = scan.group(at, sink);
                self.at = end;
                AptArg::Other(scan.span(at, end))
            }
            TokenKind::ParenClose | TokenKind::BracketClose => {
                sink.report(SyntaxErrorKind::UnbalancedBracket, range);
                AptArg::Other(range)
            }
            TokenKind::Unknown => {
                while scan.kind(self.at) == TokenKind::Unknown {
                    self.at += 1;
                }
                let range = scan.span(at, self.at);
                sink.report(SyntaxErrorKind::UnexpectedCharacter, range);
                AptArg::Other(range)
            }
            _ => AptArg::Other(range),
        }
    }

    /// Whether an operator precedes token `at`: `X=5`, `2*3`, `(A) 1` of an arithmetic IF.
    fn behind_operator(&self, at: TokenId) -> bool {
        let before = (0..at).rev().map(|id| self.scan.kind(id));
        let mut before = before.skip_while(|kind| matches!(kind, TokenKind::Blank | TokenKind::Continuation));
        !matches!(before.next(), Some(TokenKind::Number | TokenKind::Name))
    }
}

impl Iterator for Arguments<'_> {
    type Item = AptArg;

    fn next(&mut self) -> Option<AptArg> {
        self.step(&mut Quiet)
    }
}

/// A number, with blanks after its sign if need be.
#[inline]
fn number(bytes: &[u8]) -> Option<Decimal> {
    match Decimal::parse_short(bytes) {
        Some(number) => Some(number),
        None => rare_number(bytes),
    }
}

/// With an exponent, many digits or blanks.
#[cold]
fn rare_number(bytes: &[u8]) -> Option<Decimal> {
    if let Some(number) = Decimal::parse(bytes) {
        return Some(number);
    }
    let digits = bytes.get(1..)?.trim_ascii_start();
    if digits.len() + 1 == bytes.len()
        || !digits
            .first()
            .is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.')
    {
        return None;
    }
    let number = Decimal::parse(digits)?;
    Some(if bytes[0] == b'-' {
        Decimal {
            mantissa: -number.mantissa,
            ..number
        }
    } else {
        number
    })
}
