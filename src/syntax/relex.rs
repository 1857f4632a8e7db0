//! Parsing again after an edit: only the blocks that the edit can touch.
//!
//! A lexer that starts at a block start needs nothing from before it, and has forgotten everything when it has read a
//! line end. So the blocks around an edit are parsed as a text of their own, and fit between the rest, if the last of
//! them ends with a line end as before.
use crate::builder::Builder;
use crate::program::lex;
use crate::{BlockId, Program, SyntaxError, TextEdit, TextRange, TokenKind, TokenTable, apply_edits, parse};

impl Program {
    /// The program after `edits`, equal to a parse of the edited text. The edits must be sorted by start and must not
    /// overlap; `None` if they are not, or reach outside.
    pub fn relex(&self, edits: &[TextEdit]) -> Option<Self> {
        let source = apply_edits(&self.source, edits)?;
        let (Some(first), Some(last)) = (edits.first(), edits.last()) else {
            return Some(self.clone());
        };
        if source.len() >= u32::MAX as usize || self.source.len() >= u32::MAX as usize {
            return Some(parse(source, self.options));
        }
        // The byte before may be a carriage return whose line feed comes or goes.
        let (Some(from), Some(to)) = (
            self.block_at(first.range.start.saturating_sub(1)),
            self.block_at(last.range.end),
        ) else {
            return Some(parse(source, self.options));
        };
        let mut blocks = 1;
        loop {
            let next = (to.0 as usize + blocks).min(self.blocks.len());
            if let Some(lexed) = self.lexed(&source, from, next) {
                return Some(self.spliced(source, from, next, &lexed));
            }
            blocks *= 2;
        }
    }

    /// Bytes from the start of block `from` to the start of block `next` (or the end), before and after the edit.
    fn region(&self, source: &[u8], from: BlockId, next: usize) -> (TextRange, TextRange) {
        let start = self.tokens.start(self.blocks[from.0 as usize]);
        let end = self
            .blocks
            .get(next)
            .map_or(self.tokens.end, |&token| self.tokens.start(token));
        let behind = self.tokens.end - end;
        (
            TextRange::new(start, end),
            TextRange::new(start, source.len() as u32 - behind),
        )
    }

    /// The edited blocks from `from` to before `next`; `None` if they do not end with a line end of their own, so that
    /// what follows may be part of them.
    fn lexed(&self, source: &[u8], from: BlockId, next: usize) -> Option<Builder> {
        let (_, new) = self.region(source, from, next);
        let text = &source[new.as_usize()];
        let mut out = Builder::default();
        lex(text, self.options, new.start == 0, &mut out);
        let split = text.ends_with(b"\r") && source.get(new.end as usize) == Some(&b'\n');
        let closed = out.table.kinds.last() == Some(&TokenKind::Newline) && !split;
        (closed || next == self.blocks.len()).then_some(out)
    }

    /// The blocks from `from` to before `next` in their new form, joined with the others.
    fn spliced(&self, source: Vec<u8>, from: BlockId, next: usize, out: &Builder) -> Self {
        let (old, new) = self.region(&source, from, next);
        let first = self.blocks[from.0 as usize] as usize;
        let behind = self.blocks.get(next).map_or(self.tokens.len(), |&token| token as usize);

        let length = self.tokens.len();
        let room = first + out.table.len() + length - behind;
        let mut tokens = TokenTable::with_room(room);
        let moved = |start: u32| start - old.end + new.end;
        tokens.extend(&self.tokens, 0..first, 0);
        tokens.extend(&out.table, 0..out.table.len(), new.start);
        tokens.extend(&self.tokens, behind..length, new.end.wrapping_sub(old.end));
        tokens.end = source.len() as u32;

        let mut blocks = self.blocks[..from.0 as usize].to_vec();
        blocks.extend(out.blocks.iter().map(|token| token + first as u32));
        let shift = |token: u32| (token as usize - behind + first + out.table.len()) as u32;
        blocks.extend(
            self.blocks[next.min(self.blocks.len())..]
                .iter()
                .map(|&token| shift(token)),
        );

        let shifted = |error: &SyntaxError, by: &dyn Fn(u32) -> u32| SyntaxError {
            range: TextRange::new(by(error.range.start), by(error.range.end)),
            ..*error
        };
        let before = self
            .errors
            .iter()
            .filter(|error| error.range.start < old.start)
            .copied();
        let here = out.errors.iter().map(|error| shifted(error, &|at| at + new.start));
        let after = self.errors.iter().filter(|error| error.range.start >= old.end);
        let errors = before
            .chain(here)
            .chain(after.map(|error| shifted(error, &moved)))
            .collect();
        Self {
            source: std::sync::Arc::new(source),
            options: self.options,
            tokens,
            blocks,
            errors,
        }
    }
}
