//! One event, one finding: what several rules report of one pass by the pole is put together.
//!
//! The causes say what happens at the pole (an axis flips, the posture changes); the effects are what follows in the same blocks or
//! in those that touch them (an axis overruns, the feed drops, the tip strays). The strongest cause leads, takes the worst level of
//! all, and carries the others. Findings with status unknown stay by themselves: what was not decided is never hidden in another
//! finding.
use crate::suppress::has_code;
use crate::{Diagnostic, Report, Severity, Status, ValueKey};
use core::cmp::Reverse;
use std::fmt::Write;
use trunnion_syntax::{BlockId, LineIndex, Program};

/// What a rule's findings are of an event at the pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AtPole {
    /// What happens there; of two equally bad causes the one with the higher number leads.
    Cause(u8),
    /// What follows from it.
    Effect,
}

/// So many of the findings that an event carries are notes of the one that leads; the others are counted.
const NOTED: usize = 8;

/// The first and the last block of a finding.
type Span = (u32, u32);

/// Puts the findings of each event together, and counts anew.
pub(crate) fn group(program: &Program, report: &mut Report) {
    let role = |found: &Diagnostic| match found.status {
        Status::Fail => crate::rule(found.rule).and_then(|rule| rule.at_pole),
        Status::Unknown => None,
    };
    let roles: Vec<Option<AtPole>> = report.diagnostics.iter().map(role).collect();
    if !roles.iter().any(|role| matches!(role, Some(AtPole::Cause(_)))) {
        return;
    }
    let blocks = Blocks(program);
    let lines = LineIndex::new(program.source());
    let spans: Vec<Span> = report.diagnostics.iter().map(|found| blocks.span(found)).collect();
    let events = events(&blocks, &roles, &spans);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); events.len()];
    for (index, role) in roles.iter().enumerate() {
        if role.is_some()
            && let Some(event) = blocks.event_of(&events, spans[index])
        {
            members[event].push(index);
        }
    }
    let mut found: Vec<Option<Diagnostic>> = report.diagnostics.drain(..).map(Some).collect();
    for members in members {
        let rank = |index: &usize| match (roles[*index], &found[*index]) {
            (Some(AtPole::Cause(rank)), Some(of)) => Some((of.severity, rank, turn(of), Reverse(*index))),
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

/// The spans of the events: causes in the same or in touching blocks are one.
fn events(blocks: &Blocks<'_>, roles: &[Option<AtPole>], spans: &[Span]) -> Vec<Span> {
    let is_cause = |index: &usize| matches!(roles[*index], Some(AtPole::Cause(_)));
    let mut causes: Vec<Span> = (0..roles.len()).filter(is_cause).map(|index| spans[index]).collect();
    causes.sort_unstable();
    let mut events: Vec<Span> = Vec::new();
    for (first, last) in causes {
        match events.last_mut() {
            Some(event) if blocks.touch(event.1, first) => event.1 = event.1.max(last),
            _ => events.push((first, last)),
        }
    }
    events
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
        lead.notes.push(format!("and {more} more findings at this pole"));
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
