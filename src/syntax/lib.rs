//! Floor 0: text without meaning. Bytes become tokens, blocks and words, losslessly and for every input.
//!
//! It does not know what a letter means: dialects are one floor up. Parsing is total: it returns a [`Program`] and
//! the problems as facts ([`SyntaxError`]); it never fails. The tokens concatenate to the source.
mod apt;
mod block;
mod builder;
mod comment;
mod digits;
mod edit;
mod error;
mod expression;
mod halves;
mod iso;
mod items;
mod klartext;
mod length;
mod line_starts;
mod lines;
mod names;
mod number;
mod options;
mod part;
mod plain;
mod program;
mod record;
mod scan;
mod sink;
mod starts;
mod straight;
mod stray;
mod table;
mod token;

pub use block::{Address, Block, Call, Comment, Item, Value, Word};
pub use edit::{TextEdit, apply_edits};
pub use error::{SyntaxError, SyntaxErrorKind};
pub use halves::parse_on;
pub use items::Items;
pub use klartext::Sentence;
pub use line_starts::{line_starts, line_starts_after};
pub use lines::LineIndex;
pub use number::Decimal;
pub use options::{Format, LexOptions};
pub use part::parse_after;
pub use program::{BlockId, Program, parse};
pub use record::{AptArg, Record};
pub use table::{TextRange, TokenId, TokenTable};
pub use token::TokenKind;
