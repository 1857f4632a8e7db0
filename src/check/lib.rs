//! Floor 5: speaks. Reads text, motions and legs, and turns facts into diagnostics by rules, one rule a file.
//!
//! It does no I/O: texts come in, plain data goes out. It does not know terminals, JSON or LSP.
mod analysis;
pub mod config;
mod diagnostic;
pub mod fixture;
pub mod header;
mod place;
mod prelude;
mod rule;
mod rules;
mod runs;
mod session;
mod sink;
mod suppress;
mod time;
mod view;
mod words;

pub use analysis::{Report, Summary, Verdict, check};
pub use config::{Config, ConfigError, RuleLevel, Settings};
pub use diagnostic::{Diagnostic, Severity, Status, ValueKey};
pub use rule::{FaultRule, Guarantee, LegRule, Level, ProgramRule, Rule, TextRule};
pub use rules::{rule, rules};
pub use session::{BlockInfo, Session};
pub use sink::{Draft, Reporter};
pub use view::{LegView, Overview};
