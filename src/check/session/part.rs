//! A part of a program, checked before the whole is: what an editor shows, from the beginning or from a check-point on.
//!
//! The run goes block after block. It ends where the rest of the program decides how it goes on: at a jump, a loop or a call. Findings of
//! the program as a whole are not among those of a part, and a part has no verdict.
use super::{CheckPoint, Order, Session};
use crate::config::Scope;
use crate::pass::Pass;
use crate::suppress::Suppressions;
use crate::{Settings, event};
use core::ops::Range;
use trunnion_interp::{Interpreter, directives};
use trunnion_syntax::{BlockId, Format, Program};

impl Session {
    /// The block from which a program with the same text before `edited` can be run again, for its blocks from `wanted` on: that of the last
    /// check-point that is before both. `None` where the run did not go block after block up to there.
    pub fn restart(&self, edited: BlockId, wanted: BlockId) -> Option<BlockId> {
        let before = edited.min(wanted);
        let point = self.check_point(before)?;
        Some(BlockId(point.executed as u32))
    }

    fn check_point(&self, before: BlockId) -> Option<&CheckPoint> {
        if !matches!(self.order, Order::Straight(_)) {
            return None;
        }
        let after = self
            .check_points
            .partition_point(|point| point.executed <= u64::from(before.0));
        let usable = |point: &&CheckPoint| point.interpreter.may_continue_elsewhere();
        self.check_points[..after].iter().rev().find(usable)
    }

    /// Checks the blocks of `wanted` before the whole. `program` begins as the whole does, or has empty blocks before `from`, where
    /// the earlier session of the whole continues ([`Session::restart`]); it should go on a little behind what is wanted. What is found
    /// once in the program, and links to other places, are then not among the findings.
    ///
    /// The result describes blocks from `from` to the end of the run. Its report has findings and no verdict.
    pub fn of_part(
        program: &Program,
        settings: &Settings<'_>,
        from: Option<(&Self, BlockId)>,
        wanted: Range<u32>,
    ) -> Self {
        let point = from.and_then(|(session, from)| session.check_point(from));
        let comments = directives(program);
        let mut suppressions = Suppressions::new(program, &comments);
        if let Some((session, _)) = from {
            suppressions.allow_everywhere(&session.allowed);
        }
        let mut pass = Pass::new(program, settings, &suppressions);
        pass.only_part(point.map(|point| &point.pass));
        if settings.foreign.is_none() {
            pass.read_text(program);
        }
        let mut interpreter = point.map_or_else(|| settings.interpreter(), |point| point.interpreter.clone());
        let first = point.map_or(0, |point| point.executed as u32);
        let start = CheckPoint {
            executed: u64::from(first),
            interpreter: interpreter.clone(),
            pass: pass.memory(),
        };
        // the last block may go on behind the part
        let end = (program.block_count() as u32).saturating_sub(1).max(first);
        let runs = settings.foreign.is_none()
            && settings.scope() >= Scope::Motion
            && !(point.is_none() && interpreter.reads_whole(program));
        let ran = if runs {
            run(program, &mut interpreter, &mut pass, first..end)
        } else {
            first
        };
        let mut report = pass.finish_part();
        event::group(program, &mut report);
        report.diagnostics.retain_mut(|found| {
            let block = |at| program.block_at(at).unwrap_or_default().0;
            // a comment that goes on to the end of the part may end behind it
            let inside = wanted.contains(&block(found.range.start))
                && block(found.range.end.max(1) - 1) + 1 < program.block_count() as u32;
            if point.is_some() {
                found.related.clear();
            }
            inside && (point.is_none() || found.is_of_place())
        });
        let diagnostics = core::mem::take(&mut report.diagnostics);
        report.summary.recount(&diagnostics);
        report.diagnostics = diagnostics;
        Self {
            report,
            check_points: vec![start],
            order: Order::Part(u64::from(first), u64::from(ran)),
            allowed: suppressions.of_program(),
        }
    }

    /// Whether it describes a block.
    pub fn reaches(&self, block: BlockId) -> bool {
        self.order.of(block).is_some()
    }
}

/// Runs blocks one after the other; the number of the block at which that ended.
fn run(program: &Program, interpreter: &mut Interpreter<'static>, pass: &mut Pass<'_>, blocks: Range<u32>) -> u32 {
    let linuxcnc = program.options().format == Format::Iso && interpreter.is_linuxcnc();
    for block in blocks.clone() {
        if linuxcnc && has_o_word(program, BlockId(block)) {
            return block;
        }
        if interpreter.advance(program, pass) != Some(BlockId(block)) || pass.has_left_part() {
            return block;
        }
        pass.ran(BlockId(block));
        if interpreter.follows_flow() {
            return block + 1;
        }
    }
    blocks.end
}

/// Whether a line of LinuxCNC may have an O-word: it decides which lines run.
fn has_o_word(program: &Program, block: BlockId) -> bool {
    let text = program.bytes(program.block(block).range());
    text.iter()
        .find(|byte| !matches!(byte, b'N' | b'n' | b'/' | b'.' | b'0'..=b'9') && !byte.is_ascii_whitespace())
        .is_some_and(|byte| matches!(byte, b'O' | b'o'))
}

#[cfg(test)]
mod tests;
