//! Proof of an edit: the program after makes the motions of the program before, written otherwise, or moved, turned, mirrored or scaled.
//!
//! Both texts are run from scratch, with stand-ins for the values that nobody declares ([`trunnion_same::with_stand_ins`]), so that no
//! equality comes from taking them as zero.
use crate::conversion::is_grave;
use crate::{Outcome, switch};
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, Lacks, Position, Setup};
use trunnion_same::{Apart, Change, Input, Steps, Verdict, compare_changed, undeclared, with_stand_ins};
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
    programs: [&Program; 2],
    dialect: &Dialect,
    setup: &Setup,
    change: &Change,
) -> Result<Apart, Unproved> {
    let mut setup = setup.clone();
    setup.limits = setup.limits.of_steps();
    if setup.control.block_delete.is_some() {
        return run(programs, dialect, &setup, change);
    }
    let switches = switch::switches(programs.map(Program::source), [dialect; 2]);
    let found = |what: String| Unproved::Found {
        differs: false,
        before: None,
        what,
    };
    if let Err(Outcome::Unknown(gap)) = switch::at_most_one(&switches) {
        return Err(found(gap.message));
    }
    if switches.is_empty() && setup.library.0.is_none() {
        return run(programs, dialect, &setup, change);
    }
    // a claim holds in both states of the switch
    setup.control.block_delete = Some(false);
    let mut apart = run(programs, dialect, &setup, change)?;
    setup.control.block_delete = Some(true);
    let skipped = run(programs, dialect, &setup, change).map_err(|why| match why {
        Unproved::Found { differs, before, what } => Unproved::Found {
            differs,
            before,
            what: format!("where blocks with / are skipped (whether they are is not declared: --block-delete), {what}"),
        },
        fault @ Unproved::Fault { .. } => fault,
    })?;
    apart.end_mm = apart.end_mm.max(skipped.end_mm);
    apart.feed_share = apart.feed_share.max(skipped.feed_share);
    Ok(apart)
}

/// The proof in one state of block delete.
fn run(programs: [&Program; 2], dialect: &Dialect, setup: &Setup, change: &Change) -> Result<Apart, Unproved> {
    let mut unset = Vec::new();
    for program in programs {
        let mut steps = Steps::new(input(program, dialect, setup));
        steps.watch_faults();
        while steps.next().is_some() {}
        unset.extend(undeclared(&mut steps));
    }
    let setup = with_levels(with_stand_ins(setup, &unset));
    let [mut old, mut new] = programs.map(|program| Steps::new(input(program, dialect, &setup)));
    old.watch_faults();
    new.watch_faults();
    let verdict = compare_changed(&mut old, &mut new, change);
    // an undeclared radius leaves open where the tool is: what differs after it may differ because of that alone
    let lacks_radius = |fault: &Fault| verdict.is_err() && matches!(fault.kind.lacks(), Some(Lacks::Radius(_)));
    for (after, faults) in [(false, old.take_faults()), (true, new.take_faults())] {
        let counts = |fault: &Fault| matters(fault, change) || lacks_radius(fault);
        if let Some(fault) = faults.into_iter().find(counts) {
            let fault = Box::new(fault);
            return Err(Unproved::Fault { after, fault });
        }
    }
    match verdict {
        Ok(apart) => Ok(apart),
        Err(Verdict::Differs(found)) => Err(found_at(true, found)),
        Err(Verdict::Unknown(found)) => Err(found_at(false, found)),
        Err(Verdict::Same) => Err(Unproved::Found {
            differs: false,
            before: None,
            what: "the comparison ended early".to_owned(),
        }),
    }
}

fn input<'a>(program: &'a Program, dialect: &'a Dialect, setup: &'a Setup) -> Input<'a> {
    Input {
        program,
        dialect,
        setup,
        machine: None,
    }
}

fn found_at(differs: bool, found: trunnion_same::Difference) -> Unproved {
    Unproved::Found {
        differs,
        before: found.before,
        what: found.what,
    }
}

/// Reference points and distances that a parameter of the control holds, unlike each other, where they are not declared.
fn with_levels(mut setup: Setup) -> Setup {
    let control = &mut setup.control;
    control.peck_clearance_mm = control.peck_clearance_mm.or(Some(0.731));
    control.chip_break_retract_mm = control.chip_break_retract_mm.or(Some(0.417));
    let place = |number: u32| Position {
        values: core::array::from_fn(|axis| {
            let linear = !(3..6).contains(&axis);
            if linear {
                f64::from(number) * 61.7 + axis as f64 * 13.3 + 211.9
            } else {
                0.0
            }
        }),
        known: 0b1_1111_1111,
    };
    if control.reference_points.is_empty() {
        control.reference_points = (0..4).map(place).collect();
    }
    // FP counts to 4: more need other machine data
    let fixed = control.fixed_points.take();
    control.fixed_points = Some(fixed.unwrap_or_else(|| (4..8).map(place).collect()));
    setup
}
