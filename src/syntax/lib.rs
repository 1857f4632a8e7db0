//! Floor 0: text without meaning. Bytes become tokens, blocks and words, losslessly and for every input.
//!
//! It does not know what a letter means: dialects live one floor up. Parsing is total: it returns a [`Program`] and,
//! beside it, the problems as facts ([`SyntaxError`]); it never fails. The tokens concatenate to the source.
mod block;
mod edit;
mod error;
mod iso;
mod apt;
mod number;
mod options;
mod program;
mod table;
mod token;

pub use block::{Address, AptArg, Block, Call, Comment, Item, Items, Record, Value, Word};
pub use edit::{apply_edits, TextEdit};
pub use error::{SyntaxError, SyntaxErrorKind};
pub use number::Decimal;
pub use options::{Format, LexOptions};
pub use program::{BlockId, LineIndex, Program, parse};
pub use table::{TextRange, TokenId, TokenTable};
pub use token::TokenKind;
