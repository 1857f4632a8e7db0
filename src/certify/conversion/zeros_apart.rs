//! Zero points that nobody declares are taken as 0, but not as the same place: a conversion of a program that uses several must also hold
//! where they are apart.
use super::{ConversionClaim, Part, Reading, Run, Terms, converted_on, read};
use crate::Outcome;
use std::sync::Arc;
use trunnion_interp::{UNNAMED_ZERO, WorkOffset};
use trunnion_syntax::Format;

/// Where a zero point that is not declared is put, mm: the distance in X, Y and Z for each further one, no sums of each other.
const APART_MM: [f64; 3] = [17.31, 29.47, 41.59];

/// The names of the zero points of a program, in the order in which its motions use them.
fn names(reading: &Reading) -> Vec<Arc<str>> {
    let mut names: Vec<Arc<str>> = Vec::new();
    let unnamed: Arc<str> = UNNAMED_ZERO.into();
    for posed in &reading.motions {
        let name = posed.work_offset.as_ref().unwrap_or(&unnamed);
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    names
}

/// Proves a conversion again with the zero points apart that nobody declares, if it has several zero points. The readings are those of the
/// runs.
///
/// # Errors
/// Unknown, where the conversion holds only because the zero points are taken as one place.
pub fn holds_with_zeros_apart(
    [before, after]: [(&Reading, &Run<'_>); 2],
    parts: &[Part],
    claim: &ConversionClaim,
    terms: &Terms<'_>,
) -> Result<(), Outcome> {
    let (was, is) = (names(before.0), names(after.0));
    let undeclared = |name: &&Arc<str>| before.1.setup.work_offset(name).is_none();
    // the first stays where it is: what depends on its place alone is an assumption that is listed
    let moved: Vec<&Arc<str>> = was.iter().skip(1).filter(undeclared).collect();
    if moved.is_empty() || was.len() != is.len() {
        return Ok(());
    }
    let mut setups = [before.1.setup.clone(), after.1.setup.clone()];
    for (at, (was, is)) in was.iter().zip(&is).enumerate().skip(1) {
        if !moved.contains(&was) {
            continue;
        }
        for (setup, name) in setups.iter_mut().zip([was, is]) {
            let far = |axis: usize| APART_MM.get(axis).map_or(0.0, |by| by * at as f64);
            setup.work_offsets.push(WorkOffset {
                name: name.to_string(),
                values: core::array::from_fn(far),
            });
        }
    }
    let run = |at: usize, run: &Run<'_>| {
        read(&Run {
            setup: &setups[at],
            ..*run
        })
    };
    let readings = [run(0, before.1), run(1, after.1)];
    let [was, is] = [before.1, after.1].map(|run| run.machine.filter(|_| run.dialect.lex.format != Format::Apt));
    let found = converted_on((&readings[0], was), (&readings[1], is), parts, claim, terms);
    let Err(outcome) = found else { return Ok(()) };
    let why = match outcome {
        Outcome::Refuted(witness) => witness.to_string(),
        Outcome::Unknown(gap) => gap.to_string(),
        Outcome::Proved(_) => String::new(),
    };
    let moved: Vec<&str> = moved.into_iter().map(|name| &**name).collect();
    Err(Outcome::unknown(format!(
        "it holds only for certain values of {}, which nobody declares: declare the zero points in [work_offsets], or program X, Y and Z after each \
         change of the zero point. With other values: {why}",
        moved.join(", ")
    )))
}
