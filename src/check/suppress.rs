//! Comments that allow a rule: `(trunnion: allow pole-flip because the tool is out of the cut)`.
//!
//! On a line of its own it applies to the whole program, next to words to its block. Without a reason it does nothing and
//! `broken-directive` says so.
use core::cell::Cell;
use trunnion_interp::Directive;
use trunnion_syntax::{BlockId, Program, TextRange};

/// One comment that allows a rule.
struct Allowed {
    rule: String,
    /// Bytes of the comment.
    range: TextRange,
    /// It has silenced something.
    used: Cell<bool>,
}

/// What the program's comments allow.
#[derive(Default)]
pub(crate) struct Suppressions {
    everywhere: Vec<Allowed>,
    /// Sorted by block.
    in_block: Vec<(BlockId, Allowed)>,
}

impl Suppressions {
    pub(crate) fn new(program: &Program, directives: &[(TextRange, Directive)]) -> Self {
        let mut found = Self::default();
        for (range, directive) in directives {
            let Directive::Allow { rule, reason } = directive else {
                continue;
            };
            if reason.trim().is_empty() {
                continue;
            }
            let allowed = Allowed {
                rule: rule.clone(),
                range: *range,
                used: Cell::new(false),
            };
            match program.block_at(range.start) {
                Some(block) if has_code(program, block) => found.in_block.push((block, allowed)),
                _ => found.everywhere.push(allowed),
            }
        }
        found.in_block.sort_by_key(|(block, _)| *block);
        found
    }

    /// The rules that are allowed in the whole program.
    pub(crate) fn of_program(&self) -> Vec<String> {
        self.everywhere.iter().map(|entry| entry.rule.clone()).collect()
    }

    /// Allows rules in the whole program that a comment elsewhere in it allows.
    pub(crate) fn allow_everywhere(&mut self, rules: &[String]) {
        self.everywhere.extend(rules.iter().map(|rule| Allowed {
            rule: rule.clone(),
            range: TextRange::default(),
            used: Cell::new(false),
        }));
    }

    /// Whether findings of `rule` in `block` are allowed; the caller has such a finding.
    #[inline]
    pub(crate) fn allows(&self, rule: &str, block: BlockId) -> bool {
        let none = self.in_block.is_empty() && self.everywhere.is_empty();
        !none && self.some_allows(rule, block)
    }

    fn some_allows(&self, rule: &str, block: BlockId) -> bool {
        let from = self.in_block.partition_point(|(at, _)| *at < block);
        let here = self.in_block[from..].iter().take_while(|(at, _)| *at == block);
        let mut allowed = false;
        // the narrower comment is used first
        for entry in here.map(|(_, entry)| entry).chain(&self.everywhere) {
            if entry.rule == rule && !allowed {
                entry.used.set(true);
                allowed = true;
            }
        }
        allowed
    }

    /// Comments that have silenced nothing, of rules that `looked_for` says were looked for.
    pub(crate) fn unused(&self, was_checked: &dyn Fn(&str) -> bool) -> Vec<(TextRange, &str)> {
        let all = self
            .everywhere
            .iter()
            .chain(self.in_block.iter().map(|(_, entry)| entry));
        let unused = all.filter(|entry| !entry.used.get() && was_checked(&entry.rule));
        unused.map(|entry| (entry.range, entry.rule.as_str())).collect()
    }
}

/// Whether a block has more than comments and the `%` that frames a tape.
#[inline]
pub(crate) fn has_code(program: &Program, block: BlockId) -> bool {
    program.block(block).has_code()
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    #[test]
    fn beside_words_it_holds_for_its_block() {
        assert_drawn(
            "gcode",
            "G0 X0 X1 (trunnion: allow repeated-word because the first is a marker)\nG0 X0 X1\n;     ^^ repeated-word: \n",
        );
    }

    #[test]
    fn on_its_own_line_it_holds_for_the_program() {
        assert_drawn(
            "gcode",
            "G0 X0 X1\n(trunnion: allow repeated-word because this control takes the last)\nG0 X0 X1\n",
        );
    }

    #[test]
    fn without_a_reason_it_does_nothing() {
        let report = Fixture::parse("gcode", "(trunnion: allow repeated-word)\nG0 X0 X1\n")
            .check()
            .unwrap();
        let found: Vec<&str> = report.diagnostics.iter().map(|found| found.rule).collect();
        assert_eq!(found, ["broken-directive", "repeated-word"]);
    }

    #[test]
    fn it_does_not_reach_back_to_blocks_before() {
        assert_drawn(
            "gcode",
            "G0 X0 X1\n;     ^^ repeated-word: \nG0 X0 X1 (trunnion: allow repeated-word because the first is a marker)\n",
        );
    }
}
