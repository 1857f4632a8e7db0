//! Two things that programs do apart from motions.
use crate::Claim;
use crate::across::same_words;
use crate::item::{Item, Sort};
use crate::process::{shown, stops, unlike, unlike_in_motions};
use crate::sentences::at;
use crate::verdict::Verdict;
use trunnion_interp::{Argument, Value};

/// Whether they are the same, with everything that is in effect.
pub(crate) fn happens(was: &Item, is: &Item, claim: &Claim) -> Result<(), Verdict> {
    let (
        Item::Happens {
            sort,
            words,
            process,
            around,
            ..
        },
        Item::Happens {
            sort: other_sort,
            words: other_words,
            process: other_process,
            around: other_around,
            ..
        },
    ) = (was, is)
    else {
        return Ok(());
    };
    let place = |what: String| at(Some(was), Some(is), what);
    if sort != other_sort || words != other_words {
        return other_words_than(was, is, claim);
    }
    if claim.path_only {
        return Ok(());
    }
    if claim.across {
        return same_words(*sort, words, [process, other_process]).map_err(|what| Verdict::Unknown(place(what)));
    }
    if let (Some(was), Some(is)) = (around, other_around) {
        let mut pairs = was.situations.iter().zip(&is.situations);
        let found = pairs.find_map(|(was, is)| was.difference(is, !claim.frees_feed));
        let found = found.map(|(name, from, to)| (name.to_owned(), from, to));
        let set = || unlike(&was.process, &is.process, false).map(|found| (found.key, found.from, found.to));
        if let Some((name, from, to)) = found.or_else(set) {
            return Err(Verdict::Unknown(place(format!(
                "{name} differs at `{}`, whose effect is not modelled: {from} and {to}",
                shown(words)
            ))));
        }
    }
    if let Some(found) = unlike(process, other_process, false) {
        let what = format!(
            "{} differs at `{}`: {} and {}",
            found.key,
            shown(words),
            found.from,
            found.to
        );
        return Err(if found.is_unknown {
            Verdict::Unknown(place(what))
        } else {
            Verdict::Differs(place(what))
        });
    }
    if let Some(found) = unlike_in_motions(process, other_process)
        && (*sort == Sort::Unmodelled || words.iter().any(names_place))
    {
        return Err(Verdict::Unknown(place(format!(
            "{} differs at `{}`, which may read it: {} and {}",
            found.key,
            shown(words),
            found.from,
            found.to
        ))));
    }
    if stops(words) && process.message() != other_process.message() {
        return Err(Verdict::Unknown(place(format!(
            "the operator message at the stop differs: {} and {}",
            shown(process.message()),
            shown(other_process.message())
        ))));
    }
    Ok(())
}

/// Two that say different things.
fn other_words_than(was: &Item, is: &Item, claim: &Claim) -> Result<(), Verdict> {
    let (
        Item::Happens { sort, words, .. },
        Item::Happens {
            sort: other_sort,
            words: other_words,
            ..
        },
    ) = (was, is)
    else {
        return Ok(());
    };
    let place = |what: String| at(Some(was), Some(is), what);
    // each language ends its programs with its own words
    if *sort == Sort::End && *other_sort == Sort::End && claim.across {
        return Ok(());
    }
    let what = format!("one does `{}`, the other `{}`", shown(words), shown(other_words));
    if (*sort == Sort::Switch) != (*other_sort == Sort::Switch) {
        return Err(Verdict::Unknown(place(format!(
            "{what}: the machine left the spindle in a state that is not known"
        ))));
    }
    Err(if *sort == Sort::Unmodelled || *other_sort == Sort::Unmodelled {
        Verdict::Unknown(place(format!(
            "{what}: their effect is not modelled, and the words differ"
        )))
    } else {
        Verdict::Differs(place(what))
    })
}

/// Whether a word may give a coordinate or a speed.
fn names_place(word: &Argument) -> bool {
    !matches!(word.value, Value::Nothing) && !word.name.starts_with(['M', 'T', 'S', 'H', 'D', 'P'])
}
