//! Floor 6: reports. Reads text, motions and legs, and turns facts into diagnostics by rules, one rule per file.
//!
//! It does no I/O: texts come in, plain data goes out. It does not know terminals, JSON or LSP.
#![allow(
    rustdoc::invalid_codeblock_attributes,
    reason = "after the word `gcode`, the examples of rules name dialect and machine for the test that runs them"
)]
mod again;
mod analysis;
mod apart;
mod assumed;
#[cfg(test)]
mod axis_overspeed_tests;
mod both;
mod caller;
#[cfg(test)]
mod clamp_tests;
pub mod config;
mod coverage;
mod cuts;
mod datum;
mod diagnostic;
mod elsewhere;
mod event;
mod facts;
mod finding;
pub mod fixture;
pub mod header;
mod inch;
mod keyed;
mod look;
mod nearest;
mod open;
mod pace;
mod pass;
mod place;
mod porting;
mod prelude;
mod program_bounds;
mod report;
mod rule;
mod rules;
mod runs;
mod session;
mod sink;
mod slip;
mod start;
mod suppress;
mod told;
mod trail;
mod unread;
mod unreadable;
mod view;
mod visited;
mod waiting;
mod wake;
mod words;

pub use analysis::{check, check_objections, check_on};
pub use config::{Config, ConfigError, RuleLevel, Scope, Settings};
pub use coverage::{Coverage, GivenUp, NotJudged, NotRun, NotRunReason};
pub use datum::{Assume, assumptions};
pub use diagnostic::{Diagnostic, Severity, Status, ValueKey};
pub use inch::with_inches;
pub use report::{Report, Summary, Verdict};
pub use rule::{Guarantee, Rule};
pub use rules::{rule, rule_names, rules};
pub use session::{BlockInfo, Session, Variables};
pub use trunnion_dialect::{did_you_mean, or_known};
