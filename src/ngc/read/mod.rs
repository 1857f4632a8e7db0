//! From the bytes of a line to words, and from words to values: what the control accepts and refuses, in the order in which it does.
mod codes;
mod comments;
mod evaluate;
mod line;
mod plain;
mod problems;
mod recovery;

pub(crate) use comments::flaw as comment_flaw;
#[cfg(test)]
mod tests;

pub(crate) use evaluate::{apply, errors, evaluate};
pub(crate) use line::Line;
pub(crate) use plain::plain;
pub(crate) use problems::{G_UNKNOWN, UNDECIDED, formula as formula_error, is_not_defined};
