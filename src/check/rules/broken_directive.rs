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
use trunnion_syntax::Program;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    for (range, directive) in overview.directives {
        match directive {
            Directive::Allow { rule, .. } if crate::rule(rule).is_none() => {
                let names = crate::rule_names();
                let hint = crate::did_you_mean(rule, &names, "");
                let near = trunnion_dialect::nearest(rule, names.iter().copied());
                let place = name_in(out.program(), *range, rule);
                out.report(place, format!("unknown rule `{rule}`{hint}"))
                    .help("`trunnion rules` lists all rules")
                    .replace_with_some(near.map(str::to_owned));
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

/// Where a comment has a name; all of it where it has none.
fn name_in(program: &Program, range: TextRange, name: &str) -> TextRange {
    let found = memchr::memmem::find(program.bytes(range), name.as_bytes());
    found.map_or(range, |at| {
        let start = range.start + at as u32;
        TextRange::new(start, start + name.len() as u32)
    })
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn the_nearest_rule_is_offered_in_place_of_the_name() {
        let text = "G21 G90\n(trunnion: allow pole-flop because the tool is out of the cut)\n;                ^^^^^^^^^ broken-directive: unknown rule `pole-flop`; did you mean `pole-flip`?\nM30\n";
        let report = assert_drawn("gcode iso-6983", text);
        let found = report.diagnostics.iter().find(|found| found.rule == "broken-directive");
        assert_eq!(found.and_then(|found| found.replacement.as_deref()), Some("pole-flip"));
    }
}
