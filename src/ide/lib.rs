//! Floor 7: what an editor shows and asks for, as plain data with byte offsets: names and where they stand, outline, completion,
//! signatures, folding, colours, hints.
//!
//! Everything follows from the dialect's table and the tree, so that a new dialect has all of it. It does no I/O and knows neither LSP
//! nor what the editor is.
mod calls;
mod complete;
mod fold;
mod format;
mod hints;
mod names;
mod outline;
mod rename;
mod select;
mod signature;
mod text;
mod times;
mod tokens;
mod toml_keys;

pub use calls::{CallSite, calls_of};
pub use complete::{Completion, CompletionKind, completions};
pub use fold::{Fold, folds};
pub use format::{format, style};
pub use hints::{Hint, HintKind, hints};
pub use names::{Kind, Names, Occurrence, Role, Scope, names};
pub use outline::{Node, NodeKind, outline};
pub use rename::{RenameError, check_new_name, rename};
pub use select::Selections;
pub use signature::{Signature, signature};
pub use times::operation_times;
pub use tokens::{TOKEN_TYPES, Token, tokens};
pub use toml_keys::{TomlFile, toml_at, toml_completions};
