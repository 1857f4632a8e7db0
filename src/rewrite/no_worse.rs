//! What a change must not make worse: the turns of the rotary axes, and what `check` says of the program.
use crate::Rewrite;
use crate::attempt::Failure;
use std::collections::BTreeMap;
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

/// Errors by rule, each block counted.
fn errors(report: &Report) -> BTreeMap<&str, u64> {
    let mut found = BTreeMap::new();
    for one in report.findings().filter(|found| is_error(found)) {
        *found.entry(one.rule).or_insert(0) += u64::from(one.count);
    }
    found
}

/// What is undecided, by rule.
fn undecided(report: &Report) -> BTreeMap<&str, u64> {
    let mut found = BTreeMap::new();
    for one in report.findings().filter(|found| found.status == Status::Unknown) {
        *found.entry(one.rule).or_insert(0) += 1;
    }
    found
}

/// Errors of the rules that the rewrite fixes.
pub(crate) fn cured_errors(rewrite: &Rewrite, report: &Report) -> u64 {
    let of_rule = report
        .findings()
        .filter(|found| rewrite.cures.contains(&found.rule) && is_error(found));
    of_rule.map(|found| u64::from(found.count)).sum()
}

/// Whether anything in a report can be worse than before: an error, or something that is undecided.
pub(crate) fn speaks_against(report: &Report) -> bool {
    let against = |found: &Diagnostic| is_error(found) || found.status == Status::Unknown;
    report.findings().any(against)
}

/// No rule reports more errors than before, except those that the rewrite fixes; these report none where they
/// reported none. No rule leaves more undecided, and the verdict is no worse.
pub(crate) fn no_worse_report(rewrite: &Rewrite, was: &Report, is: &Report) -> Result<(), Failure> {
    let at = |found: &Diagnostic| Some(found.range.start as usize);
    let all = [errors(was), errors(is)];
    let grows = |d: &&Diagnostic| all[1].get(d.rule) > all[0].get(d.rule);
    let more = |d: &&Diagnostic| !rewrite.cures.contains(&d.rule) && grows(d);
    if let Some(d) = is.findings().filter(|d| is_error(d)).find(more) {
        return Err(Failure {
            reason: format!("it would cause an error: {} ({})", d.message, d.rule),
            at: at(d),
        });
    }
    // what it fixes may move from block to block, but a program without such an error must not get one
    if cured_errors(rewrite, was) == 0 && cured_errors(rewrite, is) > 0 {
        let cured = |d: &&Diagnostic| rewrite.cures.contains(&d.rule) && grows(d);
        let found = is.findings().filter(|d| is_error(d)).find(cured);
        return Err(Failure {
            reason: format!(
                "it would cause an error where there was none ({})",
                found.map_or("", |d| d.rule)
            ),
            at: found.and_then(at),
        });
    }
    let open = [undecided(was), undecided(is)];
    let unknown = |d: &&Diagnostic| d.status == Status::Unknown;
    if let Some(d) = is
        .findings()
        .filter(unknown)
        .find(|d| open[1].get(d.rule) > open[0].get(d.rule))
    {
        return Err(Failure {
            reason: format!("less could be decided after it: {} ({})", d.message, d.rule),
            at: at(d),
        });
    }
    Ok(())
}
