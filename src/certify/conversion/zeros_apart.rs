//! Zero points that nobody declares are taken as 0, but not as the same place: a conversion of a program that uses several must also hold
//! where they are apart.
use super::{ConversionClaim, Part, Reading, Run, Terms, converted_on, read};
use crate::Outcome;
use std::sync::Arc;
use trunnion_interp::{Setup, UNNAMED_ZERO, WorkOffset};
use trunnion_syntax::Format;

/// Where a zero point that is not declared is put, mm: the distance in X, Y and Z for each further one, no sums of each other.
const APART_MM: [f64; 3] = [17.31, 29.47, 41.59];

/// Coordinates that differ by less are the same, mm.
const SAME_MM: f64 = 1e-6;

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

/// A setup with the zero points apart that nobody declares: those that come after the first, and the first where another is declared. `None`: one
/// zero point, or all are declared. `shown`: the names that the program of this setup has for them.
fn apart(setup: &Setup, names: &[Arc<str>], declared: &dyn Fn(&str) -> bool, shown: &[Arc<str>]) -> Option<Setup> {
    let from = usize::from(!names.iter().any(|name| declared(name)));
    let mut setup = setup.clone();
    let mut is_apart = false;
    for (at, (name, shown)) in names.iter().zip(shown).enumerate().skip(from) {
        if !declared(name) {
            is_apart = true;
            setup.work_offsets.push(WorkOffset {
                name: shown.to_string(),
                values: core::array::from_fn(|axis| APART_MM.get(axis).map_or(0.0, |by| by * (at + 1) as f64)),
            });
        }
    }
    (is_apart && names.len() > 1).then_some(setup)
}

/// For each motion the axes, bits from X, that have not moved in a program's words since a change to a zero point that nobody declares: where
/// they are, only the machine knows. Empty: none.
pub fn left_behind(reading: &Reading, run: &Run<'_>) -> Vec<u16> {
    let names = names(reading);
    let declared = |name: &str| run.setup.work_offset(name).is_some();
    let Some(setup) = apart(run.setup, &names, &declared, &names) else {
        return Vec::new();
    };
    let other = read(&Run { setup: &setup, ..*run });
    let pairs = reading.motions.iter().zip(&other.motions);
    let bits = |(one, other): (&super::Posed, &super::Posed)| {
        let ends = [one, other].map(|posed| posed.motion.end.xyz());
        let [Some(one), Some(other)] = ends else { return 0 };
        (0..3)
            .filter(|axis| (one[*axis] - other[*axis]).abs() > SAME_MM)
            .map(|axis| 1 << axis)
            .sum()
    };
    pairs.map(bits).collect()
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
    let declared = |name: &str| before.1.setup.work_offset(name).is_some();
    if was.len() != is.len() {
        // which of them stand for each other is not known; where all are declared nothing depends on it
        let all_declared = was.iter().all(|name| declared(name));
        return if all_declared || was.len() < 2 {
            Ok(())
        } else {
            Err(Outcome::unknown(format!(
                "the original program uses {} zero points and the output {}, and not all are declared: declare them in [work_offsets]",
                was.len(),
                is.len()
            )))
        };
    }
    let setups = (
        apart(before.1.setup, &was, &declared, &was),
        apart(after.1.setup, &was, &declared, &is),
    );
    let (Some(one), Some(other)) = setups else {
        return Ok(());
    };
    let setups = [one, other];
    let run = |at: usize, run: &Run<'_>| {
        read(&Run {
            setup: &setups[at],
            ..*run
        })
    };
    let readings = [run(0, before.1), run(1, after.1)];
    let machines = [before.1, after.1].map(|run| run.machine.filter(|_| run.dialect.lex.format != Format::Apt));
    let found = converted_on(
        (&readings[0], machines[0]),
        (&readings[1], machines[1]),
        parts,
        claim,
        terms,
    );
    let Err(outcome) = found else { return Ok(()) };
    let why = match outcome {
        Outcome::Refuted(witness) => witness.to_string(),
        Outcome::Unknown(gap) => gap.to_string(),
        Outcome::Proved(_) => String::new(),
    };
    let moved: Vec<&str> = was.iter().map(|name| &**name).filter(|name| !declared(name)).collect();
    Err(Outcome::unknown(format!(
        "it holds only for certain values of {}, which nobody declares: declare the zero points in [work_offsets], or program X, Y and Z after each \
         change of the zero point. With other values: {why}",
        moved.join(", ")
    )))
}
