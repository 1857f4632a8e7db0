//! Two programs with the same text: what is unknown in both is unknown for the same reason, and is not a difference between them.
use crate::exact::same_motion;
use crate::input::Input;
use crate::item::Item;
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use trunnion_syntax::Format;

/// Two runs of one text.
pub(crate) enum Twins {
    /// The texts or their dialects differ.
    No,
    /// With other tools, offsets or called programs: as far as these are used, they may make a difference.
    Text,
    /// With everything else the same too, so that nothing can differ.
    All,
}

impl Twins {
    pub(crate) fn of(before: &Input<'_>, after: &Input<'_>) -> Self {
        if before.program.source() != after.program.source() || !std::ptr::eq(before.dialect, after.dialect) {
            Self::No
        } else if before.setup == after.setup {
            Self::All
        } else {
            Self::Text
        }
    }

    /// The verdict on a pair of things that the programs do: undecided ones are the same where both are exactly alike.
    pub(crate) fn judge(&self, was: &Item, is: &Item, verdict: Result<(), Verdict>) -> Result<(), Verdict> {
        match verdict {
            Err(Verdict::Unknown(_)) if self.same_at(was, is) => Ok(()),
            verdict => verdict,
        }
    }

    fn same_at(&self, was: &Item, is: &Item) -> bool {
        match self {
            Self::No => false,
            Self::Text => alike(was, is),
            Self::All => true,
        }
    }

    /// Whether runs that both stop before the end of their programs are the same after it, too. Of two texts that only run alike, a run that a
    /// bound ends is not: what comes after it was never compared. The same text with the same of everything does the same, wherever it goes.
    pub(crate) fn stopped(&self, before: &Steps<'_>, after: &Steps<'_>) -> Result<bool, Verdict> {
        let both = before.stop().filter(|stop| after.stop() == Some(stop));
        let stop = match (self, both) {
            (Self::No, _) | (_, None) => return Ok(false),
            (Self::All, Some(_)) => return Ok(true),
            (Self::Text, Some(stop)) if stop.by_bound => return Ok(false),
            (Self::Text, Some(stop)) => stop,
        };
        let (old, new) = (before.input(), after.input());
        let mut setup = old.setup.clone();
        setup.library = new.setup.library.clone();
        let what = if setup != *new.setup {
            "tools, work offsets, variables or control parameters differ"
        } else if old.setup.library != new.setup.library && may_call(old) {
            "the programs that it may call come from different folders"
        } else {
            return Ok(true);
        };
        Err(Verdict::Unknown(Difference {
            before: Some(stop.block),
            after: Some(stop.block),
            what: format!("the run cannot be followed from here on ({}), and {what}", stop.why),
        }))
    }
}

/// Whether two items are exactly the same except for values that are unknown in both.
fn alike(was: &Item, is: &Item) -> bool {
    match (was, is) {
        (Item::Motion(was), Item::Motion(is)) => {
            same_motion(&was.motion, &is.motion) && was.held == is.held && was.process == is.process
        }
        (
            Item::Happens {
                sort, words, process, ..
            },
            Item::Happens {
                sort: other_sort,
                words: other_words,
                process: other_process,
                ..
            },
        ) => sort == other_sort && words == other_words && process == other_process,
        _ => false,
    }
}

/// Whether the setup of one program serves the other: tools, offsets, variables and parameters are the same, and so are called programs.
pub fn run_alike(before: &Input<'_>, after: &Input<'_>) -> bool {
    let mut setup = before.setup.clone();
    setup.library = after.setup.library.clone();
    let one_library = before.setup.library == after.setup.library || !may_call(before) && !may_call(after);
    setup == *after.setup && one_library
}

/// Whether a text may call a program of another file: it has the words of a call, or computes codes. A Sinumerik calls any name, an Okuma by CALL.
fn may_call(input: &Input<'_>) -> bool {
    let (program, quirks) = (input.program, &input.dialect.quirks);
    match program.options().format {
        Format::Apt => return false,
        // CALL PGM, SEL PGM and cycle 12
        Format::Klartext => return true,
        Format::Iso | Format::Osp => {}
    }
    let text: Vec<u8> = (program.source().iter())
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let words: &[&[u8]] = if quirks.rs274() {
        &[b"CALL", b"M98", b"M098"]
    } else {
        &[
            b"M98", b"M098", b"M198", b"G65", b"G065", b"G66", b"G066", b"M#", b"G#", b"M[", b"G[",
        ]
    };
    quirks.user_names()
        || words
            .iter()
            .any(|word| text.windows(word.len()).any(|found| found == *word))
}
