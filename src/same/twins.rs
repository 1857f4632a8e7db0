//! Two programs with the same text: what is unknown in both is unknown for one reason, and is no difference between them.
use crate::exact::same_motion;
use crate::steps::{Input, Item, Steps};
use crate::verdict::{Difference, Verdict};
use trunnion_dialect::{Action, Role};
use trunnion_syntax::{Address, Format, Value};

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
            Err(Verdict::Unknown(_)) if matches!(self, Self::Text) && alike(was, is) => Ok(()),
            verdict => verdict,
        }
    }

    /// Whether runs that both stop before the end of their programs are the same after it, too.
    pub(crate) fn stopped(&self, before: &Steps<'_>, after: &Steps<'_>) -> Result<bool, Verdict> {
        let (Self::Text, Some(stop)) = (self, before.stop().filter(|stop| after.stop() == Some(stop))) else {
            return Ok(false);
        };
        let (old, new) = (before.input(), after.input());
        let mut setup = old.setup.clone();
        setup.library = new.setup.library.clone();
        let what = if setup != *new.setup {
            "tools, work offsets, variables or control parameters differ"
        } else if old.setup.library != new.setup.library && may_call(old) {
            "the programs that it may call lie in two places"
        } else {
            return Ok(true);
        };
        Err(Verdict::Unknown(Difference {
            before: Some(stop.block),
            after: Some(stop.block),
            what: format!("the run is not followed from here on ({}), and {what}", stop.why),
        }))
    }
}

/// Whether two things are exactly the same but for what is unknown in both.
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

/// Whether a text may call a program of another file.
pub fn may_call(input: &Input<'_>) -> bool {
    let (program, dialect) = (input.program, input.dialect);
    if program.options().format == Format::Apt {
        return false;
    }
    if dialect.quirks.rs274() {
        let text = program.source().to_ascii_uppercase();
        return [&b"CALL"[..], b"M98", b"M098"]
            .iter()
            .any(|word| text.windows(word.len()).any(|found| found == *word));
    }
    let calls = |action: Action| action == Action::SubprogramCall;
    program.blocks().any(|block| {
        block.items().any(|item| match item {
            trunnion_syntax::Item::Call(call) => {
                let code = dialect.name(&program.text(call.name));
                code.map_or(dialect.quirks.user_names(), |code| calls(code.action))
            }
            trunnion_syntax::Item::Word(word) => match (word.address, word.value) {
                (Address::Letter(letter), Value::Number(number)) => {
                    let tenths = (number.to_f64() * 10.0).round();
                    let code = match dialect.role(letter) {
                        _ if !(0.0..1e6).contains(&tenths) => return true,
                        Some(Role::G) => dialect.g(tenths as u32),
                        Some(Role::M) => dialect.m(tenths as u32),
                        // a Sinumerik calls L100 by its number
                        _ => return letter == b'L' && dialect.quirks.user_names(),
                    };
                    code.is_none_or(|code| calls(code.action))
                }
                // the number of a code is computed
                (Address::Letter(letter), _) => matches!(dialect.role(letter), Some(Role::G | Role::M)),
                _ => false,
            },
            _ => false,
        })
    })
}
