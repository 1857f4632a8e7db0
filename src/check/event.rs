//! One event, one finding: what several rules report of one block at the pole is put together, and so is what a rule reports that
//! follows from the finding of another one, and what one foreign line gives.
//!
//! A cause says what happens at the pole (an axis flips, the posture changes); the effects are what follows in its block or in those
//! that touch it (an axis overruns, the feed drops, the linear axes run a loop). The strongest cause of a block leads, takes the worst
//! level of all, and carries the others. What has another cure is no effect: the tip leaves its path without tool centre point
//! control. Findings with status unknown stay by themselves: what was not decided is never hidden in another finding.
use crate::suppress::has_code;
use crate::{Diagnostic, Report, Severity, Status, ValueKey};
use core::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::Write;
use trunnion_syntax::{BlockId, LineIndex, Program};

mod foreign;

/// What a rule's findings are of an event at the pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AtPole {
    /// What happens in a block there; of two causes the one with the higher number leads.
    Cause(u8),
    /// What is near the pole: it leads where no cause is there, and else follows from it.
    Nearness,
    /// What follows from it.
    Effect,
}

/// So many of the findings that an event carries are notes of the one that leads; the others are counted.
const NOTED: usize = 8;

/// The first and the last block of a finding.
type Span = (u32, u32);

/// Findings of one rule and one axis: their blocks, and their numbers in the list.
type Spans = Vec<(Span, usize)>;

/// Puts the findings of each event together, and counts anew.
pub(crate) fn group(program: &Program, report: &mut Report) {
    group_at_poles(program, report);
    group_consequences(program, report);
    foreign::group(program, report);
}

/// Findings that follow from those of another rule become part of them: the same axis, and no block outside theirs.
fn group_consequences(program: &Program, report: &mut Report) {
    let fails = |found: &Diagnostic| found.status == Status::Fail;
    let cause_of = |found: &Diagnostic| {
        crate::rule(found.rule)
            .and_then(|rule| rule.follows)
            .filter(|_| fails(found))
    };
    if !report.diagnostics.iter().any(|found| cause_of(found).is_some()) {
        return;
    }
    let blocks = Blocks(program);
    let lines = LineIndex::new(program.source());
    let mut causes: BTreeMap<(&str, Option<&str>), Spans> = BTreeMap::new();
    for (index, found) in report.diagnostics.iter().enumerate().filter(|(_, found)| fails(found)) {
        let of_rule = causes.entry((found.rule, limiting_axis(found)));
        of_rule.or_default().push((blocks.span(found), index));
    }
    for of_rule in causes.values_mut() {
        of_rule.sort_unstable();
    }
    let lead_of = |found: &Diagnostic| {
        let (first, last) = blocks.span(found);
        let of_rule = causes.get(&(cause_of(found)?, limiting_axis(found)))?;
        let after = of_rule.partition_point(|((begin, _), _)| *begin <= first);
        let (span, index) = of_rule[..after].last()?;
        (last <= span.1).then_some(*index)
    };
    let leads: Vec<Option<usize>> = report.diagnostics.iter().map(lead_of).collect();
    let mut found: Vec<Option<Diagnostic>> = report.diagnostics.drain(..).map(Some).collect();
    let mut parts: BTreeMap<usize, Vec<Diagnostic>> = BTreeMap::new();
    for (index, lead) in leads.into_iter().enumerate() {
        let Some(lead) = lead else { continue };
        parts.entry(lead).or_default().extend(found[index].take());
    }
    for (lead, parts) in parts {
        if let Some(lead) = &mut found[lead] {
            carry((program, &lines), lead, parts);
        }
    }
    report.diagnostics = found.into_iter().flatten().collect();
    report.summary.recount(&report.diagnostics);
}

/// The axis that a finding is about, if it names one.
fn limiting_axis(found: &Diagnostic) -> Option<&str> {
    found.values.iter().find_map(|(key, value)| match value {
        ValueKey::Text(axis) if *key == "limiting_axis" => Some(axis.as_ref()),
        _ => None,
    })
}

fn group_at_poles(program: &Program, report: &mut Report) {
    let role = |found: &Diagnostic| match found.status {
        Status::Fail => crate::rule(found.rule).and_then(|rule| rule.at_pole),
        Status::Unknown => None,
    };
    let roles: Vec<Option<AtPole>> = report.diagnostics.iter().map(role).collect();
    if roles.iter().flatten().all(|role| *role == AtPole::Effect) {
        return;
    }
    let blocks = Blocks(program);
    let lines = LineIndex::new(program.source());
    let spans: Vec<Span> = report.diagnostics.iter().map(|found| blocks.span(found)).collect();
    let roles = &roles;
    let of = |wanted: fn(AtPole) -> bool| (0..roles.len()).filter(move |index| roles[*index].is_some_and(wanted));
    let mut events: Vec<Span> = of(|role| matches!(role, AtPole::Cause(_)))
        .map(|index| spans[index])
        .collect();
    events.sort_unstable();
    events.dedup();
    let alone = of(|role| role == AtPole::Nearness).map(|index| spans[index]);
    let alone: Vec<Span> = alone.filter(|span| blocks.event_of(&events, *span).is_none()).collect();
    events.extend(alone);
    events.sort_unstable();
    events.dedup();
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); events.len()];
    for index in of(|_| true) {
        if let Some(event) = blocks.event_of(&events, spans[index]) {
            members[event].push(index);
        }
    }
    let mut found: Vec<Option<Diagnostic>> = report.diagnostics.drain(..).map(Some).collect();
    for members in members {
        let rank = |index: &usize| match (roles[*index], &found[*index]) {
            (Some(AtPole::Cause(rank)), Some(of)) => Some((rank, of.severity, turn(of), Reverse(*index))),
            (Some(AtPole::Nearness), Some(of)) => Some((0, of.severity, turn(of), Reverse(*index))),
            _ => None,
        };
        let lead = members.iter().copied().filter(|index| rank(index).is_some());
        let lead = lead.max_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(core::cmp::Ordering::Equal));
        let Some(lead) = lead else { continue };
        let others = members.iter().filter(|index| **index != lead);
        let others: Vec<Diagnostic> = others.filter_map(|index| found[*index].take()).collect();
        if let Some(lead) = &mut found[lead] {
            carry((program, &lines), lead, others);
        }
    }
    report.diagnostics = found.into_iter().flatten().collect();
    report.summary.recount(&report.diagnostics);
}

/// How far an axis turns in a finding, deg.
fn turn(found: &Diagnostic) -> f64 {
    let turn = found.values.iter().find(|(key, _)| *key == "rotary_change_deg");
    match turn {
        Some((_, ValueKey::Number(turn))) => *turn,
        _ => 0.0,
    }
}

/// Makes the others part of the finding that leads.
fn carry(place: (&Program, &LineIndex), lead: &mut Diagnostic, mut others: Vec<Diagnostic>) {
    others.sort_by_key(|found| (Reverse(found.severity), found.range));
    lead.own_severity = Some(lead.severity);
    for (index, found) in others.iter_mut().enumerate() {
        lead.severity = lead.severity.max(found.severity);
        for fix in &found.fixes {
            if !lead.fixes.contains(fix) {
                lead.fixes.push(fix);
            }
        }
        if index < NOTED {
            lead.notes.push(note(place, lead, found));
        }
    }
    if let Some(more @ 1..) = others.len().checked_sub(NOTED) {
        lead.notes.push(format!("and {more} more findings in these blocks"));
    }
    lead.also = others;
}

/// A finding as a note of another one.
fn note((program, lines): (&Program, &LineIndex), lead: &Diagnostic, found: &Diagnostic) -> String {
    let level = match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info => "info",
    };
    let mut note = format!("{level}[{}]: {}", found.rule, found.message);
    let block = |of: &Diagnostic| program.block_at(of.range.start);
    if block(found) != block(lead) {
        let (line, _) = lines.line_column(program.source(), found.range.start);
        // writing into a String cannot fail
        let _ = if let Some(number) = &found.block {
            write!(note, " (in block {number})")
        } else {
            write!(note, " (on line {line})")
        };
    }
    note
}

/// The blocks of a program, of which those without code do not count.
struct Blocks<'p>(&'p Program);

impl Blocks<'_> {
    fn span(&self, found: &Diagnostic) -> Span {
        let block = |at| self.0.block_at(at).unwrap_or_default().0;
        let first = block(found.range.start);
        (first, block(found.last.start).max(first))
    }

    /// Whether a block is not after the one that follows `last`.
    fn touch(&self, last: u32, first: u32) -> bool {
        first <= last || !(last + 1..first).any(|between| has_code(self.0, BlockId(between)))
    }

    /// The event whose blocks, or those that touch them, hold a whole span.
    fn event_of(&self, events: &[Span], (first, last): Span) -> Option<usize> {
        let after = events.partition_point(|event| event.0 <= first);
        // the one that it is in or follows comes before the one that it leads to
        let near = [after.checked_sub(1), Some(after)];
        near.into_iter().flatten().find(|index| {
            events.get(*index).is_some_and(|event| {
                self.touch(event.1, first) && self.touch(last, event.0) && self.touch(event.1, last)
            })
        })
    }
}

#[cfg(test)]
mod tests;
