//! What a pass reads of a program before it runs.
use super::{Pass, ask};
use crate::view::Overview;
use crate::wake::Wake;
use trunnion_dialect::Foreign;
use trunnion_syntax::{Program, SyntaxErrorKind};

impl Pass<'_> {
    pub(crate) fn read_text(&mut self, program: &Program) {
        // the block whose comment ends too early: to its author the text after that end is still comment
        let mut nested = None;
        for error in program.errors() {
            let block = program.block_at(error.range.start).unwrap_or_default();
            if nested == Some(block) {
                continue;
            }
            nested = (error.kind == SyntaxErrorKind::NestedComment).then_some(block);
            let at = (Some(block), u64::from(block.0));
            ask(&self.rules, &mut self.reporter, at, |wake, out| {
                if let Wake::Text(rule) = wake {
                    rule(error, out);
                }
            });
        }
    }

    /// Reports that the file is not read: it is for an unsupported control, or is not a program.
    pub(crate) fn report_foreign(&mut self, foreign: Foreign) {
        ask(&self.rules, &mut self.reporter, (None, 0), |wake, out| {
            if let Wake::Foreign(rule) = wake {
                rule(&foreign, out);
            }
        });
    }

    /// Reports that the file is not text; false where the rules that report it are allowed.
    pub(crate) fn report_unreadable(&mut self) -> bool {
        ask(&self.rules, &mut self.reporter, (None, 0), |wake, out| {
            if let Wake::Unreadable(rule) = wake {
                rule(out);
            }
        });
        self.rules.iter().any(|rule| matches!(rule.wake, Wake::Unreadable(_)))
    }

    pub(crate) fn read_whole(&mut self, overview: &Overview<'_>) {
        let ported = self.ported;
        ask(&self.rules, &mut self.reporter, (None, 0), |wake, out| match wake {
            Wake::Program(rule) => rule(overview, out),
            Wake::Port(rule) if ported => rule(overview, out),
            _ => {}
        });
    }
}
