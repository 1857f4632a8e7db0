//! The state that two programs leave when they end.
use crate::Claim;
use crate::across::unless_own_words;
use crate::elsewhere::same_elsewhere;
use crate::item::Item;
use crate::process::{unlike, unlike_in_motions};
use crate::sentences::only_one;
use crate::steps::Steps;
use crate::twins::Twins;
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{FaultKind, same_number};

/// Why a run is not followed to the end of its program, where a fault means that.
pub(crate) fn ends(kind: &FaultKind) -> Option<String> {
    Some(match kind {
        FaultKind::EndlessLoop { proved: true, .. } => "it never ends: a loop returns to the same values".to_owned(),
        FaultKind::EndlessLoop { blocks, .. } => format!(
            "it does not end within {blocks} executed blocks; if it is only long, use --max-steps N or raise `steps` of [limits] in \
             trunnion.toml"
        ),
        FaultKind::NotDecided { what } => format!("what runs next depends on {what}"),
        FaultKind::Rejected { message, .. } => format!("the control refuses it: {message}"),
        _ => return None,
    })
}

impl Steps<'_> {
    /// Why the run ended in a block that does more than is kept, if it did.
    pub(crate) fn given_up(&self) -> Option<String> {
        let stop = self.stop().filter(|_| self.run.given_up);
        stop.map(|stop| stop.why.clone())
    }
}

/// The ends of both runs; `rest`: what only one of them does after the other has ended.
pub(crate) fn ended(
    before: &mut Steps<'_>,
    after: &mut Steps<'_>,
    rest: [Option<&Item>; 2],
    claim: &Claim,
    twins: &Twins,
) -> Result<(), Verdict> {
    let [a, b] = rest;
    if let Some(own) = a.or(b) {
        let verdict = only_one(a, b);
        return Err(if claim.across {
            unless_own_words(verdict, own, own)
        } else {
            verdict
        });
    }
    if twins.stopped(before, after)? {
        return Ok(());
    }
    stopped(before, after)?;
    same_elsewhere(before, after)?;
    match (claim.path_only, claim.across) {
        (true, _) => Ok(()),
        (false, true) => nothing_outlives(before, after),
        (false, false) => at_end(before, after),
    }
}

/// Both were followed to their ends.
pub(crate) fn stopped(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    for (which, steps) in [("original", before), ("changed", after)] {
        if let Some(stop) = steps.stop() {
            let block = Some(stop.block);
            return Err(Verdict::Unknown(Difference {
                before: block.filter(|_| which == "original"),
                after: block.filter(|_| which == "changed"),
                what: format!("the {which} program was not followed to its end: {}", stop.why),
            }));
        }
    }
    Ok(())
}

/// Whether a variable is one that cycles of Klartext use, from Q200 to Q1199 (TNC 640 user's manual, Q parameters): CYCL DEF sets them.
fn is_of_cycles(name: &str) -> bool {
    let number = name.strip_prefix('Q').and_then(|digits| digits.parse::<u32>().ok());
    number.is_some_and(|number| (200..1200).contains(&number))
}

/// Variables that outlive a program have other names on another control: whether what they hold is the same is not compared.
fn nothing_outlives(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    let all = before.stored().into_keys().chain(after.stored().into_keys());
    match all.into_iter().find(|name| !is_of_cycles(name)) {
        None => Ok(()),
        Some(name) => Err(Verdict::Unknown(Difference {
            before: None,
            after: None,
            what: format!(
                "{name} outlives the program, and which variable of the other control stands for it is not known"
            ),
        })),
    }
}

/// The state that both leave.
pub(crate) fn at_end(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    let nowhere = |what: String| {
        Err(Verdict::Differs(Difference {
            before: None,
            after: None,
            what,
        }))
    };
    let unknown = |what: String| {
        Err(Verdict::Unknown(Difference {
            before: None,
            after: None,
            what,
        }))
    };
    let (a, b) = (before.stored(), after.stored());
    for name in a.keys().chain(b.keys().filter(|name| !a.contains_key(*name))) {
        if a.get(name) != b.get(name) {
            let value = |value: Option<&trunnion_interp::Value>| match value {
                None | Some(trunnion_interp::Value::Nothing) => "nothing".to_owned(),
                Some(trunnion_interp::Value::Number(value)) => value.to_string(),
                Some(trunnion_interp::Value::Text(text)) => text.to_string(),
            };
            return nowhere(format!(
                "{name} outlives the program and holds {} and {}",
                value(a.get(name)),
                value(b.get(name))
            ));
        }
    }
    if before.leads_tip() != after.leads_tip() {
        return nowhere("tool centre point control is on at the end of only one of the programs".into());
    }
    if let Some((name, from, to)) = before.held().difference(&after.held(), true) {
        return nowhere(format!("{name} at the end differs: {from} and {to}"));
    }
    if let Some(found) = unlike(before.process(), after.process(), false) {
        let what = format!("{} at the end differs: {} and {}", found.key, found.from, found.to);
        return if found.is_unknown { unknown(what) } else { nowhere(what) };
    }
    if let Some(found) = unlike_in_motions(before.process(), after.process()) {
        return unknown(format!(
            "{} at the end differs, and it is unknown whether the control resets it: {} and {}",
            found.key, found.from, found.to
        ));
    }
    let (zero, other) = (before.state().zero.values(), after.state().zero.values());
    let same = |(a, b): (&f64, &f64)| same_number(*a, *b) || a.is_nan() && b.is_nan();
    if !zero.iter().zip(&other).all(same) {
        return unknown(
            "the zero point at the end differs, and it is unknown whether the control resets it".to_owned(),
        );
    }
    let (turned, other) = (before.interpreter.turned(), after.interpreter.turned());
    if turned.len() != other.len() || !turned.iter().zip(&other).all(same) {
        return unknown(
            "the coordinates at the end are turned, scaled, mirrored or polar in different ways, and it is unknown whether the control resets that"
                .to_owned(),
        );
    }
    Ok(())
}
