//! A comment speaks to Trunnion, but cannot be followed.
//!
//! # Why
//! A comment that is meant to allow a rule, or to declare a tool, and is misspelt does nothing. An `allow` without a reason
//! does nothing either: who reads it later cannot tell whether it still holds.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 (trunnion: allow pole-flip)
//! ;         ^^^^^^^^^^^^^^^^^^^^^^^^^^^ broken-directive: `allow pole-flip` has no reason and is ignored
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X0 (trunnion: allow pole-flip because the tool is out of the cut)
//! ```
//!
//! # Guarantee
//! Sound for comments that begin with `trunnion:`.
//!
//! # Sources
//! Trunnion's interface, section 5.
use crate::prelude::*;
use trunnion_interp::Directive;

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Sound,
    level: Level::Program(check),
};

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    for (range, directive) in overview.directives {
        match directive {
            Directive::Allow { rule, .. } if crate::rule(rule).is_none() => {
                out.report(*range, format!("no rule is called `{rule}`"))
                    .help("`trunnion rules` lists them");
            }
            Directive::Allow { rule, reason } if reason.trim().is_empty() => {
                out.report(*range, format!("`allow {rule}` has no reason and is ignored"))
                    .help(format!("say why: allow {rule} because ..."));
            }
            Directive::Broken(what) => {
                out.report(*range, what.clone())
                    .help("write `allow RULE because REASON`, `tool NUMBER SHAPE diameter MM`, `dialect NAME` or `machine NAME`");
            }
            Directive::Allow { .. } | Directive::Tool(_) | Directive::Mode { .. } => {}
        }
    }
}
