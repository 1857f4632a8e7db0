//! Names: what TRAORI, CYCLE800(..), IF [..], GOTO 100, LABEL: and CR=5 are.
use crate::expression::{is_function, is_one_of};
use crate::items::{Items, Stage};
use crate::sink::{Quiet, Sink};
use crate::{Address, Call, Item, TextRange, TokenId, TokenKind, Value, Word};

/// Names that take one operand without parentheses, even one that follows directly: `GOTO100`, `GOTOF LABEL`.
const JUMPS: [&str; 4] = ["GOTO", "GOTOF", "GOTOB", "GOTOC"];

/// Names that take a number, even one that follows directly: `DO1`.
pub(crate) const NUMBERED: [&str; 3] = ["DO", "END", "LBL"];

/// Names that take one expression: `IF R1>5`, `WHILE [#1 LT 2]`.
pub(crate) const CONDITIONS: [&str; 7] = ["IF", "ELSEIF", "WHILE", "UNTIL", "EVERY", "WHEN", "WHENEVER"];

/// Names that take the rest of the block: declarations, and loops with their own syntax.
const DECLARATIONS: [&str; 7] = ["DEF", "PROC", "EXTERN", "CASE", "FOR", "DEFINE", "REDEF"];

/// Words of OSP that begin like a name of a block or program.
const NO_LABELS: [&str; 3] = ["NCYL", "NOEX", "OMIT"];

impl Items<'_> {
    /// After the name of an OSP block or program at `at`, with its letter `N` or `O`: `NLOOP`, `OPART`.
    pub(crate) fn osp_name(&self, at: TokenId) -> Option<TokenId> {
        let scan = self.scan;
        let end = scan.name_end(at);
        let text = scan.bytes(scan.span(at, end));
        let named = scan.is_osp() && matches!(text[0], b'N' | b'n' | b'O' | b'o');
        (named && !is_one_of(text, &NO_LABELS) && !scan.assigns(scan.skip_blank(end))).then_some(end)
    }

    /// A name: label, assignment, jump, condition, declaration or call.
    pub(crate) fn name(&mut self, at: TokenId, stage: Stage, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let text = scan.text(at);
        if let Some(item) = self.keyword(at, text, sink) {
            return item;
        }
        let end = scan.name_end(at);
        let next = scan.skip_blank(end);
        if scan.kind(next) == TokenKind::Colon && stage <= Stage::Numbered {
            return self.label(at, next + 1);
        }
        if scan.assigns(next) {
            return self.assignment(at, Address::Named(scan.span(at, end)), next, sink);
        }
        if is_one_of(text, &DECLARATIONS) {
            let stop = scan.trim(next, scan.end);
            return self.call(at, end, next, (stop > next).then_some(stop));
        }
        match scan.kind(next) {
            TokenKind::BracketOpen => self.bracketed(at, end, next, sink),
            TokenKind::ParenOpen => {
                let stop = scan.group(next, sink);
                let closed = stop > next + 1 && scan.kind(stop - 1) == TokenKind::ParenClose;
                let inner = TextRange::new(scan.range(next).end, scan.span(next, stop - u32::from(closed)).end);
                self.at = stop;
                Item::Call(Call {
                    name: scan.span(at, end),
                    arguments: Some(inner),
                    range: scan.span(at, stop),
                })
            }
            TokenKind::Text => {
                let stop = self.joined_text(next, sink);
                self.call(at, end, next, stop)
            }
            TokenKind::Number => self.call(at, end, next, Some(next + 1)),
            _ => self.call(at, end, next, None),
        }
    }

    /// Whether it is the call of a subprogram with a number, and with arguments where parentheses are not comments: `L140(1)`.
    pub(crate) fn is_numbered_call(&self, at: TokenId) -> bool {
        let scan = self.scan;
        let [b'L' | b'l', number @ ..] = scan.text(at) else {
            return false;
        };
        scan.kind(scan.skip_blank(at + 1)) == TokenKind::ParenOpen
            && !number.is_empty()
            && number.iter().all(u8::is_ascii_digit)
    }

    /// Whether brackets after a name are those of an element of an array: where parentheses are not comments, as on a SINUMERIK.
    fn has_elements(&self) -> bool {
        !self.scan.options.paren_comment
    }

    /// The assignment to an element of an array whose name is a letter with a number: `H2[1]=5`.
    pub(crate) fn numbered_element(&mut self, at: TokenId, sink: &mut impl Sink) -> Option<Item> {
        let scan = self.scan;
        let open = scan.skip_blank(at + 1);
        let named = scan.text(at)[1..].iter().all(u8::is_ascii_digit);
        if scan.kind(open) != TokenKind::BracketOpen || !named || !self.has_elements() {
            return None;
        }
        // problems inside the brackets are reported where the assignment is read
        let stop = scan.group(open, &mut Quiet);
        let equals = scan.skip_blank(stop);
        if !scan.assigns(equals) {
            return None;
        }
        scan.group(open, sink);
        self.stage = Stage::Inside;
        Some(self.assignment(at, Address::Named(scan.span(at, stop)), equals, sink))
    }

    /// A jump or a condition: names that end where their letters end, whatever follows directly.
    fn keyword(&mut self, at: TokenId, text: &[u8], sink: &mut impl Sink) -> Option<Item> {
        let scan = self.scan;
        let next = scan.skip_blank(at + 1);
        let behind = if scan.kind(next) == TokenKind::Number {
            scan.skip_blank(next + 1)
        } else {
            next
        };
        if scan.assigns(behind) || scan.kind(behind) == TokenKind::Colon {
            // `LBL1:` and `DO1=5` are names like others.
            return None;
        }
        let stop = if is_one_of(text, &JUMPS) {
            match scan.kind(next) {
                TokenKind::ParenOpen => None,
                TokenKind::Text => self.joined_text(next, sink),
                _ => match scan.operand(next, &mut Quiet) {
                    // a name that holds a text: `GOTOF PLACE<<R1`
                    Some(end) if self.has_elements() && scan.joins(scan.skip_blank(end)) => {
                        self.joined_text(next, sink)
                    }
                    _ => scan.operand(next, sink),
                },
            }
        } else if is_one_of(text, &NUMBERED) {
            (scan.kind(next) == TokenKind::Number).then_some(next + 1)
        } else if is_one_of(text, &CONDITIONS) {
            scan.expression(at + 1, scan.range(at), sink)
        } else {
            return None;
        };
        Some(self.call(at, at + 1, next, stop))
    }

    /// After the text at `at`, with what is joined to it: `"PART_"<<R1`.
    fn joined_text(&self, at: TokenId, sink: &mut impl Sink) -> Option<TokenId> {
        self.scan.expression(at, self.scan.range(at), sink)
    }

    /// The call of the name `at..end`, whose arguments, if any, are the tokens from `first` to before `stop`.
    fn call(&mut self, at: TokenId, end: TokenId, first: TokenId, stop: Option<TokenId>) -> Item {
        self.at = stop.unwrap_or(end);
        let arguments = stop.map(|stop| self.scan.span(first, stop));
        Item::Call(Call {
            name: self.scan.span(at, end),
            arguments,
            range: self.scan.span(at, self.at),
        })
    }

    /// A name with brackets: an element that is assigned (`A[1]=5`), a letter with a function directly after it (`XSIN[30]`),
    /// or a name with arguments (`call [1] [2]`).
    fn bracketed(&mut self, at: TokenId, end: TokenId, open: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let text = scan.bytes(scan.span(at, end));
        let mut stop = scan.group(open, sink);
        let equals = scan.skip_blank(stop);
        if scan.assigns(equals) {
            return self.assignment(at, Address::Named(scan.span(at, stop)), equals, sink);
        }
        if is_function(&text[1..]) && !is_function(text) {
            self.at = stop;
            let range = scan.span(at, stop);
            let value_range = TextRange::new(range.start + 1, range.end);
            let address = Address::Letter(text[0].to_ascii_uppercase());
            return Item::Word(Word {
                address,
                value: Value::Expression(value_range),
                range,
                value_range,
            });
        }
        while scan.kind(scan.skip_blank(stop)) == TokenKind::BracketOpen {
            stop = scan.group(scan.skip_blank(stop), sink);
        }
        self.call(at, end, open, Some(stop))
    }
}
