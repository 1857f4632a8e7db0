//! The windings of a posture inside the travel of the axes, the ranges that are set in the control, and what the program requests.
use crate::follow::posture_rule::{Candidate, TIE};
use crate::follow::requests::Requested;
use crate::kinematics::windings::windings_in;
use crate::{Limits, Machine, NoStance};
use core::f64::consts::TAU;

/// Why an angle has no winding inside the limits: the winding nearest to legal and the limit it breaks, rad.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outside {
    value: f64,
    limit: f64,
}

/// The winding of `q` inside limits that is nearest to `near`, rad; of two equally near the one nearer zero, of two equally near zero
/// the positive one. Also whether both directions of half a turn are legal.
pub(crate) fn legal_winding(limits: Limits, q: f64, near: f64) -> Result<(f64, bool), Outside> {
    match *windings_in(limits, q, near) {
        [] => Err(least_bad(limits, q)),
        [first, second, ..] => {
            let tie = (second - near).abs() < (first - near).abs() + TIE;
            let nearer_zero = first.abs() - second.abs();
            let takes_second = nearer_zero > TIE || (nearer_zero > -TIE && second > first);
            Ok((if tie && takes_second { second } else { first }, tie))
        }
        [first] => Ok((first, false)),
    }
}

/// The travel of a rotary axis, and, if a range is set in the control, what both have in common.
pub(crate) fn searched(machine: &Machine, joint: usize) -> Limits {
    let axis = &machine.axes[joint];
    let range = machine.control.branch.range.iter().find(|range| range.0 == axis.letter);
    match (range, axis.limits) {
        (None, limits) => limits,
        (Some(&(_, low, high)), Limits::Unbounded) => Limits::Range(low, high),
        (Some(&(_, low, high)), Limits::Range(least, most)) => Limits::Range(low.max(least), high.min(most)),
    }
}

/// The winding of `q` nearest to the limits, none of which is inside them.
fn least_bad(limits: Limits, q: f64) -> Outside {
    let Limits::Range(low, high) = limits else {
        return Outside { value: q, limit: q };
    };
    let below = q + TAU * ((high - q) / TAU).floor();
    let above = below + TAU;
    if low - below <= above - high {
        Outside {
            value: below,
            limit: low,
        }
    } else {
        Outside {
            value: above,
            limit: high,
        }
    }
}

pub(crate) fn excess(outside: &Outside) -> f64 {
    (outside.value - outside.limit).abs()
}

pub(crate) fn no_winding((axis, Outside { value, limit }): (u8, Outside)) -> NoStance {
    NoStance::OutsideLimits { axis, value, limit }
}

/// The posture `q` with its best legal windings, and the axis that can turn to it by half a turn in either direction; or the letter of the axis
/// that has no legal winding.
pub(crate) fn legal(
    machine: &Machine,
    mut q: [f64; 2],
    from: [f64; 2],
    asked: &Requested,
) -> Result<(Candidate, Option<usize>), (u8, Outside)> {
    let mut half_turn = None;
    for (index, rotary) in machine.constants.rotary().iter().enumerate().take(2) {
        let letter = machine.axes[rotary.joint].letter;
        let limits = asked.narrow(index, searched(machine, rotary.joint));
        let (value, either) = legal_winding(limits, q[index], from[index]).map_err(|outside| (letter, outside))?;
        q[index] = value;
        if either {
            half_turn = Some(index);
        }
    }
    Ok((Candidate::new(machine, q, from), half_turn))
}
