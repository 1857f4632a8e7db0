//! The file contains no block that does anything.
//!
//! # Why
//! A broken transfer leaves a file that is empty, blank or filled with NUL bytes. Such a file contains no error,
//! but nothing was checked either.
//!
//! # Example
//! ```gcode
//! (the rest was lost)
//! ;^ empty-program: the file contains no block that does anything; was it transferred completely?
//! ```
//!
//! # Use instead
//! ```gcode
//! (a program)
//! N10 G0 X0 Y0
//! ```
//!
//! # Guarantee
//! Sound; reported once per file, at its first byte. Comments, `%`, labels, block numbers and program numbers do
//! nothing.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::prelude::*;
use crate::unreadable::is_utf16;
use trunnion_syntax::{Address, Block, Item};

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let unreadable = is_utf16(overview.program.source());
    if !unreadable && overview.program.blocks().any(|block| does_something(&block)) {
        return;
    }
    let first = u32::from(!overview.program.source().is_empty());
    out.report(
        TextRange::new(0, first),
        "the file contains no block that does anything; was it transferred completely?",
    )
    .note("there was nothing to check")
    .help("transfer the program again and compare the sizes")
    .unknown();
}

/// Whether a block has a word other than its own or the program's number, a name or a record.
fn does_something(block: &Block<'_>) -> bool {
    if block.record().is_some() || block.sentence().is_some() {
        return true;
    }
    let number = block.number();
    block.items().any(|item| match item {
        Item::Word(word) => Some(word.range) != number && !matches!(word.address, Address::Letter(b'N' | b'O')),
        Item::Call(_) => true,
        Item::Comment(_) | Item::Skip(..) | Item::Percent(_) | Item::Label(_) | Item::Other(_) => false,
    })
}

#[cfg(test)]
mod tests {
    use crate::Severity;
    use crate::Verdict;
    use crate::fixture::Fixture;

    fn found(info: &str, text: &str) -> (Verdict, usize) {
        let report = Fixture::parse(info, text).check().unwrap();
        let found = report.diagnostics.iter().filter(|d| d.rule == "empty-program").count();
        (report.verdict(Severity::Error), found)
    }

    #[test]
    fn nothing_is_never_a_pass() {
        for text in [
            "",
            "%",
            "%\n%\n",
            "\n\n \n",
            "%\nO1234\n%\n",
            "N10\nN20\n",
            "(only words)\n",
        ] {
            assert_eq!(found("gcode mill-3axis", text), (Verdict::Unknown, 1), "{text:?}");
        }
        for text in ["\0\0\0\0", "\0\0\n\0\n"] {
            let (verdict, count) = found("gcode mill-3axis", text);
            assert_eq!(count, 1, "{text:?}");
            assert_ne!(verdict, Verdict::Pass, "{text:?}");
        }
        assert_eq!(found("gcode apt mill-3axis", "$$ nothing\n"), (Verdict::Unknown, 1));
        assert_eq!(
            found("gcode sinumerik-840d mill-3axis", "%_N_A_MPF\n;a\n"),
            (Verdict::Unknown, 1)
        );
    }

    #[test]
    fn a_single_code_is_something() {
        for text in ["M30\n", "%\nO1\nN10 G0 X1\nM30\n%\n"] {
            assert_eq!(found("gcode mill-3axis", text), (Verdict::Pass, 0), "{text:?}");
        }
    }
}
