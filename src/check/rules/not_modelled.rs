//! Trunnion recognises something but does not simulate it: everything that depends on it is unknown.
//!
//! # Why
//! A verdict must not rest on a guess. Where an expression, a cycle or a call is not evaluated, the positions that
//! depend on it are unknown until the program sets them again, and nothing is checked from them.
//!
//! # Example
//! ```gcode sinumerik-840d
//! N10 G0 X=R1+2
//! ;        ^^^^ not-modelled: not modelled: R1+2
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d
//! N10 G0 X12
//! ```
//!
//! # Guarantee
//! Sound: what is not modelled is reported, once per cause.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::prelude::*;
use trunnion_interp::Lacks;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind.lacks() == Some(Lacks::ReferencePoint) && !out.judges_machine() {
        // without a machine no rule asks where it is
        out.report(
            fault.range,
            "this move goes to a position of the machine that is not declared",
        )
        .note("positions after it are unknown until the program sets them again")
        .help("to check it, name the machine: --machine NAME or FILE, with reference_points in its [control]")
        .merge(Merge::once(0));
        return;
    }
    if let FaultKind::NotModelled { what } = &fault.kind {
        let (what, remedy) = divided(what);
        let near = out.near_code(what);
        let hint = near
            .as_ref()
            .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        // an editor can only replace what the place holds
        let meant = near.filter(|_| out.text(fault.range) == *what);
        let draft = out.report(fault.range, format!("not modelled: {}{hint}", short(what)))
            .replace_with_some(meant)
            .note("positions that depend on it are unknown until the program sets them again; nothing is checked from them")
            .unknown()
            .merge(Merge::once(hash(what)));
        draft.help(remedy.unwrap_or_else(|| BY_HAND.to_owned()));
    }
}

/// What to do where no setting helps.
const BY_HAND: &str = "look through what depends on it by hand, or try it on the machine without a part";

/// What is not modelled, and what to declare so that it is: `a cycle (declare [control] key)` says both.
fn divided(what: &str) -> (&str, Option<String>) {
    let Some(at) = what.find("declare [control]") else {
        return (what, None);
    };
    let (before, remedy) = what.split_at(at);
    let in_brackets = before.ends_with('(');
    let remedy = if in_brackets {
        remedy.strip_suffix(')').unwrap_or(remedy)
    } else {
        remedy
    };
    let remedy = format!("{remedy}, in trunnion.toml or in the machine file");
    (before.trim_end_matches([' ', ':', '(', ',']), Some(remedy))
}

/// A cause may quote the program: its first 100 characters, in one line.
fn short(what: &str) -> String {
    const MOST: usize = 100;
    let line = what.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &line[..end]),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::divided;
    use crate::Severity;

    #[test]
    fn what_to_declare_is_the_help() {
        let remedy = |key: &str| {
            Some(format!(
                "declare [control] {key}, in trunnion.toml or in the machine file"
            ))
        };
        assert_eq!(
            divided("G87: the direction (declare [control] bore_shift)"),
            ("G87: the direction", remedy("bore_shift"))
        );
        assert_eq!(
            divided("G71: one block: declare [control] roughing_retract (setting 73)"),
            ("G71: one block", remedy("roughing_retract (setting 73)"))
        );
        assert_eq!(divided("INSERT"), ("INSERT", None));
    }

    #[test]
    fn one_cause_is_told_once_with_its_count() {
        let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d", "G0 X=R1\nY0\nX=R1\nM30\n");
        let report = fixture.check().unwrap();
        let found: Vec<_> = report.diagnostics.iter().filter(|d| d.rule == "not-modelled").collect();
        assert_eq!((found.len(), found[0].count), (1, 2));
        assert_eq!(report.verdict(Severity::Error), crate::Verdict::Unknown);
    }
}
