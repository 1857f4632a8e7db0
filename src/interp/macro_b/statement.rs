//! The words of macro statements.
use super::alarms::{Mistake, rejected};
use crate::reader::Reader;
use crate::{FaultKind, Refusal};
use trunnion_syntax::{Call, Item, TextRange};

/// The words of macro statements.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Statement {
    If,
    Then,
    Goto,
    While,
    Do,
    End,
}

pub(super) fn statement(name: &[u8]) -> Option<Statement> {
    let known: [(&[u8], Statement); 7] = [
        (b"IF", Statement::If),
        (b"THEN", Statement::Then),
        (b"GOTO", Statement::Goto),
        (b"WHILE", Statement::While),
        (b"WH", Statement::While),
        (b"DO", Statement::Do),
        (b"END", Statement::End),
    ];
    known
        .iter()
        .find(|(text, _)| name.eq_ignore_ascii_case(text))
        .map(|row| row.1)
}

/// So many items of a block are looked at for the IF of a THEN, and a THEN farther from its start, bytes, is not judged: the items before it are more.
const LOOKED_AT: usize = 200;
const NEAR: u32 = 200;

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// THEN belongs to the IF before it in its block (B-63944EN, custom macro: IF [condition] THEN).
    pub(super) fn then(&mut self, call: &Call) {
        let is_if = |item: Item| match item {
            Item::Call(before) => {
                let name = self.program.bytes(before.name);
                before.range.start < call.range.start && statement(name) == Some(Statement::If)
            }
            _ => false,
        };
        // a line may hold as many THEN as words
        let mut items = self.program.block(self.block).items().take(LOOKED_AT);
        if !items.any(is_if) && self.program.block(self.block).range().start + NEAR > call.range.start {
            let message = "THEN without IF before it in its block".to_owned();
            let kind = rejected(self.dialect, Mistake::Format, Refusal::Structure, message);
            (self.report)(call.range, kind);
        }
    }
}
