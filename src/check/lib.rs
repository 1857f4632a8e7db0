//! Floor 5: speaks. Reads text, motions and legs, and turns facts into diagnostics by rules, one rule a file.
//!
//! It does no I/O: texts come in, plain data goes out. It does not know terminals, JSON or LSP.
pub mod config;
mod diagnostic;
mod analysis;
mod prelude;
mod rule;
mod rules;
mod session;
mod sink;
mod suppress;

pub use analysis::{Report, Summary, Verdict, check};
pub use diagnostic::{Diagnostic, Severity, Status, ValueKey};
pub use rule::{Guarantee, Level, Rule};
pub use rules::{rule, rules};
pub use session::{BlockInfo, Session};
pub use config::{Config, ConfigError, RuleLevel, Settings};
