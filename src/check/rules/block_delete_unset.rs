//! Blocks begin with `/`, and it is not declared whether the control skips them.
//!
//! # Why
//! A switch on the operator panel decides whether such blocks run. A program can be safe in one state of the switch
//! and cause a crash in the other. Where the state is not declared, both are judged: all of these blocks run, and
//! all are skipped. Several switches (`/1`, `/2`) have more combinations than these two; the mixed ones stay
//! unknown.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 Y0
//! /N20 G0 X100
//! ;^ block-delete-unset: 1 block begins with /, but the state of the block delete switch is not declared: checked once with the block run, and once with it skipped
//! ```
//!
//! # Use instead
//! Declare the state in `trunnion.toml`: `[control] block_delete = true` (skipped) or `false` (run), or with
//! `--block-delete on|off`.
//!
//! # Guarantee
//! Sound; reported once per program.
//!
//! # Sources
//! * ISO 6983-1:2009, block delete.
//! * FANUC Series 30i B-64484EN: optional block skip, levels 1 to 9.
use crate::prelude::*;
use trunnion_interp::{deleted_levels, slash};
use trunnion_syntax::{Block, Item};

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let declared = overview.settings.setup.control.block_delete.is_some();
    if declared || memchr::memchr(b'/', overview.program.source()).is_none() {
        return;
    }
    let dialect = overview.settings.dialect;
    let (levels, count) = deleted_levels(overview.program, dialect);
    let slashes = || {
        let blocks = overview.program.blocks();
        blocks.filter_map(|block| Some((slash(&block, dialect)?.1, is_first(&block))))
    };
    let Some((first, _)) = slashes().next() else {
        return;
    };
    let all_begin = slashes().all(|(_, first)| first);
    let (begin, them, it) = match (count, all_begin) {
        (1, true) => ("block begins with /,", "the block", "it"),
        (_, true) => ("blocks begin with /,", "them", "them"),
        (1, false) => ("block contains a /,", "what follows it", "it"),
        (_, false) => ("blocks begin with or contain a /,", "what follows it", "it"),
    };
    let text = format!(
        "{count} {begin} but the state of the block delete switch is not declared: checked once with {them} run, and once with {it} skipped"
    );
    let draft = out.report(first, text);
    draft.help("declare it: [control] block_delete = true or false in trunnion.toml, or --block-delete on or off");
    if levels.len() > 1 {
        let names: Vec<String> = levels.iter().map(|level| format!("/{level}")).collect();
        draft.note(format!(
            "{} are separate switches: their mixed states are not judged",
            names.join(" ")
        ));
        draft.unknown();
    }
}

/// Whether the block begins with its `/`.
fn is_first(block: &Block<'_>) -> bool {
    matches!(block.items().next(), Some(Item::Skip(..)))
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;
    use crate::{Report, Severity};

    fn report(text: &str) -> Report {
        Fixture::parse("gcode", text).check().unwrap()
    }

    #[test]
    fn both_states_are_judged() {
        // skipped, no feed is known for the cut; run, the arc has no centre
        let found = report("N10 G0 X0 Y0 Z0\n/N20 G2 X5 F100\nN30 G1 X7\nM30\n");
        let note = |rule: &str| {
            let found = found.diagnostics.iter().find(|d| d.rule == rule);
            found.and_then(|d| d.notes.last()).map(String::as_str)
        };
        assert_eq!(note("missing-feed"), Some("only if the blocks with / are skipped"));
        assert_eq!(note("arc-centre-missing"), Some("only if the blocks with / run"));
        assert_eq!(found.summary.errors, 2);
        let own = found.diagnostics.iter().find(|d| d.rule == "block-delete-unset");
        assert_eq!(
            own.map(|d| (d.severity, d.status)),
            Some((Severity::Info, crate::Status::Fail))
        );
    }

    #[test]
    fn a_slash_inside_a_block_deletes_its_rest_where_the_control_knows_that() {
        let text = "N10 G0 X0. Y0. Z0.\nN20 G1 X7. /2 F100.\nN30 /G2 X5.\nM30\n";
        let found = Fixture::parse("gcode fanuc-30i", text).check().unwrap();
        let one = |rule: &str| found.diagnostics.iter().find(|d| d.rule == rule).unwrap();
        assert!(
            one("missing-feed")
                .notes
                .iter()
                .any(|note| note.contains("are skipped"))
        );
        assert!(
            one("arc-centre-missing")
                .notes
                .iter()
                .any(|note| note.contains("with / run"))
        );
        let own = one("block-delete-unset");
        assert!(
            own.message.starts_with("2 blocks begin with or contain a /, but"),
            "{}",
            own.message
        );
        assert_eq!(own.status, crate::Status::Unknown, "two switches");
        assert!(found.diagnostics.iter().all(|d| d.rule != "not-modelled"));
        // if it is not declared that the control knows it, nothing is guessed
        let found = report(text);
        assert_eq!(found.diagnostics.iter().filter(|d| d.rule == "not-modelled").count(), 2);
    }

    #[test]
    fn several_switches_stay_unknown() {
        let found = report("N10 G0 X0 Y0 Z0\n/1 G0 X5\n/2 G0 X7\nM30\n");
        let own = found.diagnostics.iter().find(|d| d.rule == "block-delete-unset");
        assert_eq!(own.map(|d| d.status), Some(crate::Status::Unknown));
    }

    #[test]
    fn a_division_and_a_comment_are_no_block_delete() {
        for text in ["N10 G0 X0 Y0 Z0\n/\n/ (nothing)\nM30\n", "N10 G0 X0 (a/b)\nM30\n"] {
            assert!(
                report(text).diagnostics.iter().all(|d| d.rule != "block-delete-unset"),
                "{text}"
            );
        }
    }
}
