//! Sinumerik and OSP: every `N100` of a block that is not the block's own number, the numbers behind GOTO, and texts that a cycle or a command may
//! read as jumps or contours.
use crate::references::{Reader, own_number};
use trunnion_syntax::{Address, Format, Item, TextRange, TokenKind};

/// Commands that show, write or compare their text: a number in it is no jump.
const SHOWS: [&str; 5] = ["MSG", "SETAL", "WRITE", "DIALOGON", "LOG"];

/// Commands with the number of a block behind them.
const JUMPS: [&[u8]; 6] = [b"GOTO", b"GOTOF", b"GOTOB", b"GOTOC", b"REPEAT", b"REPEATB"];

/// A word of letters and digits, with its place in the bytes.
struct Piece {
    from: usize,
    to: usize,
}

impl Reader<'_, '_> {
    /// What names blocks in a program without comments in parentheses, or of OSP.
    pub(crate) fn named(&mut self) {
        let is_osp = self.program.options().format == Format::Osp;
        if self.program.options().paren_comment && !is_osp {
            return;
        }
        let own = own_number(self.block).map_or(u32::MAX, |(range, _)| range.start);
        let table = self.program.tokens();
        let range = self.block.range();
        let mut code = self.program.bytes(range).to_ascii_uppercase();
        let mut texts = Vec::new();
        for id in self.block.tokens() {
            let token = table.range(id);
            let place = (token.start - range.start) as usize..((token.end.min(range.end)) - range.start) as usize;
            let is_text = table.kind(id) == TokenKind::Text;
            if is_text || matches!(table.kind(id), TokenKind::Comment | TokenKind::UnclosedComment) {
                code[place].fill(if is_text { b'"' } else { b' ' });
            }
            if is_text {
                texts.push(token);
            }
        }
        let pieces = pieces(&code);
        for (at, piece) in pieces.iter().enumerate() {
            let text = &code[piece.from..piece.to];
            let place = |from: usize, to: usize| TextRange::new(range.start + from as u32, range.start + to as u32);
            if let Some(digits) = number_length(text) {
                let digits = place(piece.from + 1, piece.from + 1 + digits);
                if digits.start != own {
                    self.names(digits, place(piece.from, piece.to), is_osp);
                }
            } else if JUMPS.contains(&text) && !is_osp {
                self.behind_jump(&code, (piece.to, pieces.get(at + 1)), &place);
            } else if text == b"RET" && !is_osp {
                self.behind_return(&code, pieces.get(at + 1), &place);
            }
        }
        if texts.is_empty() {
            return;
        }
        let shown = self.shown();
        for text in texts {
            // neither they nor the texts overlap
            let before = shown.partition_point(|item| item.start <= text.start);
            if before == 0 || shown[before - 1].end < text.end {
                self.inside_text(text);
            }
        }
    }

    /// `N100` behind the start of a block.
    fn names(&mut self, digits: TextRange, piece: TextRange, is_osp: bool) {
        let number = self.text(digits).parse().ok();
        let text = self.text(piece);
        if is_osp {
            let why = format!("`{text}` names a block by its text (N0123 is not N123), so the numbers stay");
            return self.unread(piece, number, why);
        }
        match number {
            Some(number) if digits.end == piece.end => self.refer(digits, number, false),
            _ => self.unread(
                piece,
                number,
                format!("`{text}` is not understood, and may name a block"),
            ),
        }
    }

    /// The number of a block without its letter, or a target that is computed.
    fn behind_jump(
        &mut self,
        code: &[u8],
        (from, next): (usize, Option<&Piece>),
        place: &impl Fn(usize, usize) -> TextRange,
    ) {
        let Some(at) = code[from..].iter().position(|byte| !byte.is_ascii_whitespace()) else {
            return;
        };
        let at = from + at;
        if matches!(code[at], b'"' | b'$' | b'<' | b'[' | b'(') {
            let what = "the target of this jump is computed: it is not known which block it refers to";
            return self.obstacle(place(from, at + 1), what.to_owned());
        }
        let at = if code[at] == b':' { at + 1 } else { at };
        let Some(next) = next.filter(|next| next.from == at) else {
            return;
        };
        let range = place(next.from, next.to);
        let known = |this: &Self| {
            this.found
                .references
                .iter()
                .rev()
                .take(64)
                .any(|one| one.digits == range)
        };
        if let Ok(number) = self.text(range).parse()
            && !known(self)
        {
            self.refer(range, number, false);
        }
    }

    /// `RET(100)`.
    fn behind_return(&mut self, code: &[u8], next: Option<&Piece>, place: &impl Fn(usize, usize) -> TextRange) {
        let Some(next) = next.filter(|next| code[next.from..next.to].iter().all(u8::is_ascii_digit)) else {
            return;
        };
        let range = place(next.from, next.to);
        let number = self.text(range).parse().ok();
        let why = format!(
            "RET with {} may lead to a block of the calling program",
            self.text(range)
        );
        self.unread(range, number, why);
    }

    /// Numbers of blocks in a text: `CYCLE95("N25:N35")`, `EXECSTRING("GOTOF N35")`.
    fn inside_text(&mut self, range: TextRange) {
        let text = self.program.bytes(range).to_ascii_uppercase();
        let pieces = pieces(&text);
        let written = self.text(range);
        for (at, piece) in pieces.iter().enumerate() {
            let word = &text[piece.from..piece.to];
            let behind_jump = at > 0 && JUMPS.contains(&&text[pieces[at - 1].from..pieces[at - 1].to]);
            let digits = match number_length(word) {
                Some(digits) => &word[1..=digits],
                None if behind_jump && word.iter().all(u8::is_ascii_digit) => word,
                None => continue,
            };
            let number = std::str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
            self.unread(
                range,
                number,
                format!("the text {written} may name a block by its number"),
            );
        }
        // `"N"<<R1`
        let last = pieces.last().is_some_and(|piece| &text[piece.from..piece.to] == b"N");
        let end = range.end as usize;
        let joined = self.program.source().get(end..).is_some_and(|rest| {
            let rest = rest
                .iter()
                .position(|byte| *byte != b' ')
                .map_or(&rest[..0], |at| &rest[at..]);
            rest.starts_with(b"<<")
        });
        if last && joined {
            self.unread(
                range,
                None,
                format!("the text that begins with {written} may name a block by its number"),
            );
        }
    }

    /// Where the texts of the block are messages, or names of tools.
    fn shown(&self) -> Vec<TextRange> {
        let shown = |item| match item {
            Item::Call(call) => {
                let name = self.text(call.name);
                let shows = SHOWS.iter().any(|shows| name.eq_ignore_ascii_case(shows));
                shows.then_some(call.range)
            }
            Item::Word(word) => {
                let is_tool = word.address == Address::Letter(b'T')
                    || matches!(word.address, Address::Named(name) if self.text(name).eq_ignore_ascii_case("T"));
                is_tool.then_some(word.range)
            }
            _ => None,
        };
        self.block.items().filter_map(shown).collect()
    }
}

/// The pieces of letters, digits and underscores.
fn pieces(text: &[u8]) -> Vec<Piece> {
    let inside = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(from) = text[at..].iter().position(inside).map(|from| at + from) {
        at = from + text[from..].iter().take_while(|byte| inside(byte)).count();
        found.push(Piece { from, to: at });
    }
    found
}

/// How many digits follow the N of `N100`; `None`: it is another word.
fn number_length(piece: &[u8]) -> Option<usize> {
    let digits = piece.strip_prefix(b"N")?;
    let length = digits.iter().take_while(|byte| byte.is_ascii_digit()).count();
    (length > 0).then_some(length)
}
