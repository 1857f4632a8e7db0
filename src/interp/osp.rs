//! The user task of Okuma's OSP: variables with names, IF, GOTO, CALL, RTS, MODIN.
//!
//! Sources: NC-PB/gEdit, syntax-okuma.md (restates the OSP-P200L and P300 manuals: blocks, names, variables, calls); programs of several shops
//! (`IF [A NE EMPTY]`). What no source states is not decided: a label that occurs twice, the visibility of a caller's variables, MODIN inside MODIN.
mod call;
mod index;
mod statement;
mod variables;
mod words;

pub(crate) use call::{Level, With};
pub(crate) use index::{files, index};
pub(crate) use variables::{Task, is_common, is_of_control, why_unknown};

/// Statements of the flow.
const STATEMENTS: [&[u8]; 6] = [b"IF", b"GOTO", b"CALL", b"RTS", b"MODIN", b"MODOUT"];

/// Whether a name begins a statement of the flow.
fn is_statement(name: &[u8]) -> bool {
    STATEMENTS.iter().any(|known| name.eq_ignore_ascii_case(known))
}
