//! Proof of an edit: the program after makes the motions of the program before, written otherwise, or moved, turned, mirrored or scaled.
//!
//! Both texts are run from scratch. Where zero points or tool lengths are not declared, both are run a second time with values that are
//! unlike each other in their place, so that no equality comes from taking them as zero.
use crate::conversion::is_grave;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, FaultKind, Lacks, Setup, Tool, WorkOffset};
use trunnion_same::{Apart, Change, Input, Steps, Verdict, compare_changed};
use trunnion_syntax::{BlockId, Program};

/// Why an edit is not proved.
#[derive(Clone, Debug)]
pub enum Unproved {
    /// The programs differ, or it is unknown whether they do.
    Found {
        /// They differ; otherwise it is unknown.
        differs: bool,
        /// Block of the program before, where there is one.
        before: Option<BlockId>,
        /// One sentence.
        what: String,
    },
    /// A fault makes it unknown what a program does.
    Fault {
        /// It is in the program after.
        after: bool,
        /// What it is.
        fault: Box<Fault>,
    },
}

/// Whether a fault leaves open what the path is: the radius of a tool that is not declared does not, where both programs name the same path.
fn matters(fault: &Fault, change: &Change) -> bool {
    is_grave(&fault.kind)
        && match fault.kind.lacks() {
            Some(Lacks::ReferencePoint) => false,
            Some(Lacks::Radius(_)) => change.scales(),
            _ => true,
        }
}

/// Proves that `after` does what `before` does, but for `change`.
///
/// # Errors
/// The first difference, what is unknown, or a fault.
pub fn certify_change(
    [before, after]: [&Program; 2],
    dialect: &Dialect,
    setup: &Setup,
    change: &Change,
) -> Result<Apart, Unproved> {
    let mut setup = setup.clone();
    setup.limits = setup.limits.of_steps();
    let (apart, unset) = run([before, after], dialect, &setup, change)?;
    if !unset.is_empty() {
        let (_, _) = run([before, after], dialect, &with_values(&setup, &unset), change)?;
    }
    Ok(apart)
}

/// What nobody declares: faults of both runs.
fn run(
    programs: [&Program; 2],
    dialect: &Dialect,
    setup: &Setup,
    change: &Change,
) -> Result<(Apart, Vec<FaultKind>), Unproved> {
    let input = |program| Input {
        program,
        dialect,
        setup,
        machine: None,
    };
    let [mut old, mut new] = programs.map(|program| Steps::new(input(program)));
    old.watch_faults();
    new.watch_faults();
    let verdict = compare_changed(&mut old, &mut new, change);
    let mut unset = Vec::new();
    for (after, faults) in [(false, old.take_faults()), (true, new.take_faults())] {
        for fault in faults {
            if matters(&fault, change) {
                let fault = Box::new(fault);
                return Err(Unproved::Fault { after, fault });
            }
            if matches!(
                fault.kind,
                FaultKind::WorkOffsetUnset { .. } | FaultKind::ToolLengthUnset { .. }
            ) {
                unset.push(fault.kind);
            }
        }
    }
    match verdict {
        Ok(apart) => Ok((apart, unset)),
        Err(Verdict::Differs(found)) => Err(found_at(true, found)),
        Err(Verdict::Unknown(found)) => Err(found_at(false, found)),
        Err(Verdict::Same) => Err(Unproved::Found {
            differs: false,
            before: None,
            what: "the comparison ended early".to_owned(),
        }),
    }
}

fn found_at(differs: bool, found: trunnion_same::Difference) -> Unproved {
    Unproved::Found {
        differs,
        before: found.before,
        what: found.what,
    }
}

/// The setup with values in the place of those that nobody declares. They are unlike each other, and no sums of each other.
fn with_values(setup: &Setup, unset: &[FaultKind]) -> Setup {
    let mut setup = setup.clone();
    let mut seed = 0.0;
    let mut next = || {
        seed += 1.0;
        // multiples of the golden ratio are spread evenly
        100.0 * f64::fract(seed * 0.618_033_988_749_895) + 7.0
    };
    for kind in unset {
        match kind {
            FaultKind::WorkOffsetUnset { name } if setup.work_offset(name).is_none() => {
                let linear = [true, true, true, false, false, false, true, true, true];
                let values = linear.map(|linear| if linear { next() } else { 0.0 });
                let name = name.clone();
                setup.work_offsets.push(WorkOffset { name, values });
            }
            FaultKind::ToolLengthUnset { tool } => {
                let digits: String = tool.chars().filter(char::is_ascii_digit).collect();
                let Ok(number) = digits.parse::<u32>() else { continue };
                let length = Some(next());
                match setup.tools.iter_mut().find(|known| known.number == number) {
                    Some(known) => known.length_mm = known.length_mm.or(length),
                    None => setup.tools.push(Tool {
                        number,
                        shape: None,
                        diameter_mm: None,
                        length_mm: length,
                        holder_mm: None,
                    }),
                }
            }
            _ => {}
        }
    }
    setup
}
