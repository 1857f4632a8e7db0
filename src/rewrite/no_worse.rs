//! What a change must not make worse: the turns of the rotary axes, and what `check` says of the program.
use crate::Rewrite;
use crate::attempt::Failure;
use trunnion_certify::Certificate;
use trunnion_check::{Diagnostic, Report, Severity, Status};

/// No rotary axis turns farther in all, nor in a larger step (beyond the rounding of numbers).
pub(crate) fn no_worse_turns(certificate: &Certificate) -> Result<(), String> {
    for rotary in &certificate.rotary {
        let pairs = [
            ("largest step", rotary.step_before_deg, rotary.step_after_deg),
            ("travel", rotary.travel_before_deg, rotary.travel_after_deg),
        ];
        for (what, before, after) in pairs {
            if after > before * (1.0 + 1e-6) + 0.01 {
                return Err(format!(
                    "the {what} of {} would grow from {before:.3} to {after:.3} deg",
                    rotary.axis
                ));
            }
        }
    }
    Ok(())
}

fn is_error(found: &Diagnostic) -> bool {
    found.own_severity() == Severity::Error && found.status == Status::Fail
}

/// Errors of a rule, each block counted.
fn errors(report: &Report, rule: &str) -> u64 {
    let of_rule = report.findings().filter(|d| d.rule == rule && is_error(d));
    of_rule.map(|d| u64::from(d.count)).sum()
}

/// Errors of the rules that the rewrite fixes.
pub(crate) fn cured_errors(rewrite: &Rewrite, report: &Report) -> u64 {
    rewrite.cures.iter().map(|rule| errors(report, rule)).sum()
}

/// No rule reports more errors than before, except those that the rewrite fixes; these report none where they
/// reported none. No rule leaves more undecided, and the verdict is no worse.
pub(crate) fn no_worse_report(rewrite: &Rewrite, was: &Report, is: &Report) -> Result<(), Failure> {
    let at = |found: &Diagnostic| Some(found.range.start as usize);
    let more = |d: &&Diagnostic| !rewrite.cures.contains(&d.rule) && errors(is, d.rule) > errors(was, d.rule);
    if let Some(d) = is.findings().filter(|d| is_error(d)).find(more) {
        return Err(Failure {
            reason: format!("it would cause an error: {} ({})", d.message, d.rule),
            at: at(d),
        });
    }
    // what it fixes may move from block to block, but a program without such an error must not get one
    if cured_errors(rewrite, was) == 0 && cured_errors(rewrite, is) > 0 {
        let cured = |d: &&Diagnostic| rewrite.cures.contains(&d.rule) && errors(is, d.rule) > errors(was, d.rule);
        let found = is.findings().filter(|d| is_error(d)).find(cured);
        return Err(Failure {
            reason: format!(
                "it would cause an error where there was none ({})",
                found.map_or("", |d| d.rule)
            ),
            at: found.and_then(at),
        });
    }
    let undecided = |report: &Report, rule: &str| {
        let unknown = report
            .findings()
            .filter(|d| d.rule == rule && d.status == Status::Unknown);
        unknown.count()
    };
    let unknown = |d: &&Diagnostic| d.status == Status::Unknown;
    if let Some(d) = is
        .findings()
        .filter(unknown)
        .find(|d| undecided(is, d.rule) > undecided(was, d.rule))
    {
        return Err(Failure {
            reason: format!("less could be decided after it: {} ({})", d.message, d.rule),
            at: at(d),
        });
    }
    Ok(())
}
