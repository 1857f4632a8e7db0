//! A comment addresses Trunnion but cannot be carried out.
//!
//! # Why
//! A misspelt comment that should allow a rule or declare a tool has no effect. An `allow` without a reason has no
//! effect either: a later reader could not tell whether it still applies.
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
//! * docs/contract.md#comments-that-trunnion-reads
use crate::prelude::*;
use trunnion_interp::Directive;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    for (range, directive) in overview.directives {
        match directive {
            Directive::Allow { rule, .. } if crate::rule(rule).is_none() => {
                let hint = crate::did_you_mean(rule, &crate::rule_names(), "");
                out.report(*range, format!("unknown rule `{rule}`{hint}"))
                    .help("`trunnion rules` lists all rules");
            }
            Directive::Allow { rule, reason } if reason.trim().is_empty() => {
                out.report(*range, format!("`allow {rule}` has no reason and is ignored"))
                    .help(format!("give the reason: allow {rule} because ..."));
            }
            Directive::Broken(what) => {
                out.report(*range, what.clone())
                    .help("write `allow RULE because REASON`, `tool NUMBER SHAPE diameter MM`, `dialect NAME` or `machine NAME`");
            }
            // what is wrong with an obstacle is said where the program is opened
            Directive::Allow { .. }
            | Directive::Tool(_)
            | Directive::Turned(_)
            | Directive::Obstacle(_)
            | Directive::Mode { .. } => {}
        }
    }
}
