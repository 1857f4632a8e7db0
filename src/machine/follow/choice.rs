//! Which posture and winding of the rotary axes a control takes for a programmed tool vector, by the rule in
//! [`crate::follow::posture_rule`]; where the documentation leaves it open, which other posture it may take.
//!
//! At the pole the first rotary axis stays where it is. Windings are chosen inside the limits (and the ranges set in the control);
//! an endless axis takes the winding nearest the previous value. Before the first motion of the rotary axes they are assumed at zero; where
//! the program has lost them, the choice is open.
use crate::follow::allowed_windings::{Outside, excess, legal, no_winding, searched};
use crate::follow::posture_rule::{Branch, Candidate, Criterion, PostureRule, TIE, comparisons, precedence};
use crate::follow::reference::{Before, Reference};
use crate::follow::requests::Requested;
use crate::kinematics::windings::windings_in;
use crate::{Limits, Machine, NoStance, Open, OpenCause, Orientations, POLE_TOLERANCE, Side, Solution, orientations};
use core::cmp::Ordering;
use core::f64::consts::{PI, TAU};
use trunnion_geometry::Vec3;
use trunnion_interp::Posture;

/// Postures that differ by less than this in every rotary axis are not reported as a choice, rad: 5 deg (docs/kinematics.md#which-posture-a-control-takes).
const DIFFERENT: f64 = 5.0 * PI / 180.0;

/// A chosen posture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    pub(crate) q: [f64; 2],
    pub(crate) open: Option<Open>,
}

/// Rotary joints (rad, workpiece side first) for the unit tool axis `axis` in the workpiece frame, coming from the previous ones.
///
/// # Errors
/// [`NoStance::Unreachable`], or [`NoStance::OutsideLimits`] where every posture breaks a limit (the least bad one is named).
pub(crate) fn choose(machine: &Machine, axis: &Vec3, before: &Before) -> Result<Chosen, NoStance> {
    let postures = match orientations(machine, axis) {
        Orientations::Unreachable(off) => return Err(NoStance::Unreachable(off)),
        Orientations::Pole(q2) => {
            let asked = Requested::of(machine, before.wish);
            let q = legal(machine, [before.q[0], q2], before.q, &asked)
                .map_err(no_winding)?
                .0
                .q;
            return Ok(Chosen {
                q,
                open: stays_unknown(machine, q, before),
            });
        }
        Orientations::Postures(postures) => postures,
    };
    let mut found = Found::default();
    let mut worst: Option<(u8, Outside)> = None;
    let asked = Requested::of(machine, before.wish);
    let mut refused = None;
    for solution in &postures {
        match legal(machine, solution.q, before.q, &asked) {
            Ok((candidate, _)) if !asked.fits(&candidate.q) => refused = Some(candidate.q),
            Ok((candidate, half_turn)) => found.add(candidate, solution.branch, half_turn),
            Err(failed) => {
                if let (true, Ok((candidate, _))) = (
                    asked.narrows(),
                    legal(machine, solution.q, before.q, &Requested::default()),
                ) {
                    refused = Some(candidate.q);
                }
                if worst.as_ref().is_none_or(|w| excess(&failed.1) < excess(&w.1)) {
                    worst = Some(failed);
                }
            }
        }
    }
    if let (0, Some(q)) = (found.count, refused) {
        return Err(refusal(machine, &q));
    }
    if found.count == 0 {
        return Err(worst.map_or(NoStance::NotModelled, no_winding));
    }
    let (taken, cause) = found.decide(machine, before);
    let mut open = cause.and_then(|cause| {
        let other = found.items.get(1 - taken.min(1)).filter(|_| found.count > 1)?;
        let chosen = &found.items[taken];
        (chosen.candidate.differs(&other.candidate) > DIFFERENT).then_some(Open {
            cause,
            taken: chosen.candidate.q,
            other: other.candidate.q,
        })
    });
    let chosen = &found.items[taken];
    if open.is_none() && asked.unsaid {
        open = chosen.other_winding(machine, before, OpenCause::WordsNotDeclared);
    }
    if open.is_none() && before.reference == Reference::Lost {
        open = chosen.other_winding(machine, before, OpenCause::StartUnknown);
    }
    let rule = machine.control.branch.rule;
    if open.is_none() && rule != Some(PostureRule::Generic) {
        open = chosen
            .open_turn(before)
            .or_else(|| unfiltered(machine, &postures, before, chosen))
            .or_else(|| found.rule_conflict(taken, before));
    }
    Ok(Chosen {
        q: chosen.candidate.q,
        open,
    })
}

/// At the pole the first rotary axis stays where it is. If that position is unknown, it may be half a turn off as well.
fn stays_unknown(machine: &Machine, q: [f64; 2], before: &Before) -> Option<Open> {
    if !before.lacks_start(machine.control.branch.rule) {
        return None;
    }
    let joint = machine.constants.rotary().first()?.joint;
    let elsewhere = match machine.axes[joint].limits {
        Limits::Range(low, high) if q[0] > 0.5 * (low + high) => low.max(q[0] - PI),
        Limits::Range(_, high) => high.min(q[0] + PI),
        Limits::Unbounded => q[0] + PI,
    };
    Some(Open {
        cause: OpenCause::StartUnknown,
        taken: q,
        other: [elsewhere, q[1]],
    })
}

/// Parameters 19741 to 19744 of a Fanuc set the range in which it looks for values. If these are not declared and the choice without the
/// axes' travel would differ, it is undecided which one is taken.
fn unfiltered(machine: &Machine, postures: &[Solution], before: &Before, chosen: &Item) -> Option<Open> {
    let branch = &machine.control.branch;
    if branch.rule != Some(PostureRule::Fanuc) || !branch.range.is_empty() || before.wish != Posture::ByRule {
        return None;
    }
    let mut free = Found::default();
    for solution in postures {
        let mut q = solution.q;
        for (value, near) in q.iter_mut().zip(before.q) {
            *value += TAU * ((near - *value) / TAU).round();
        }
        free.add(Candidate::new(machine, q, before.q), solution.branch, None);
    }
    let (taken, _) = free.decide(machine, before);
    let other = &free.items[taken].candidate;
    (chosen.candidate.differs(other) > DIFFERENT).then_some(Open {
        cause: OpenCause::RangeNotDeclared,
        taken: chosen.candidate.q,
        other: other.q,
    })
}

/// A legal posture.
#[derive(Clone, Copy, Debug)]
struct Item {
    candidate: Candidate,
    branch: i8,
    /// The rotary axis that can reach its value by half a turn in either direction.
    half_turn: Option<usize>,
}

/// No posture is the one that the program requests: the axis nearest the tool is named.
fn refusal(machine: &Machine, q: &[f64; 2]) -> NoStance {
    let rotary = machine.constants.rotary();
    let axis = rotary.last().map_or(b'?', |rotary| machine.axes[rotary.joint].letter);
    let value = q[rotary.len().saturating_sub(1).min(1)];
    NoStance::PostureRefused { axis, value }
}

impl Item {
    /// The same posture on another turn of an axis.
    fn other_winding(&self, machine: &Machine, before: &Before, cause: OpenCause) -> Option<Open> {
        let taken = self.candidate.q;
        machine
            .constants
            .rotary()
            .iter()
            .enumerate()
            .take(2)
            .find_map(|(index, rotary)| {
                let all = windings_in(searched(machine, rotary.joint), taken[index], before.q[index]);
                let value = *all.iter().find(|value| (*value - taken[index]).abs() > DIFFERENT)?;
                let mut other = taken;
                other[index] = value;
                Some(Open { cause, taken, other })
            })
    }

    fn open_turn(&self, before: &Before) -> Option<Open> {
        let axis = self.half_turn.filter(|_| before.is_known())?;
        let mut other = self.candidate.q;
        other[axis] = 2.0 * before.q[axis] - other[axis];
        Some(Open {
            cause: OpenCause::HalfTurn,
            taken: self.candidate.q,
            other,
        })
    }
}

/// The legal postures, two at most.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    items: [Item; 2],
    count: usize,
}

impl Default for Item {
    fn default() -> Self {
        Self {
            candidate: Candidate::NOWHERE,
            branch: 0,
            half_turn: None,
        }
    }
}

impl Found {
    fn add(&mut self, candidate: Candidate, branch: i8, half_turn: Option<usize>) {
        if let Some(slot) = self.items.get_mut(self.count) {
            *slot = Item {
                candidate,
                branch,
                half_turn,
            };
            self.count += 1;
        }
    }

    /// On a great circle away from the pole the posture cannot change; if the control's rule takes the other one, its documentation does
    /// not say which of the two it ignores.
    fn rule_conflict(&self, taken: usize, before: &Before) -> Option<Open> {
        let (chosen, other) = (self.items.get(taken)?, self.items.get(1 - taken.min(1))?);
        let stays = before.continuous && before.is_known() && before.sign != 0 && other.branch == before.sign;
        (self.count > 1 && stays && chosen.branch != before.sign).then_some(Open {
            cause: OpenCause::GreatCircle,
            taken: chosen.candidate.q,
            other: other.candidate.q,
        })
    }

    /// The index of the posture that is taken, and why another might be.
    fn decide(&self, machine: &Machine, before: &Before) -> (usize, Option<OpenCause>) {
        if self.count < 2 {
            return (0, None);
        }
        let branch = &machine.control.branch;
        let generic = || self.compare(machine, PostureRule::Generic, &[]).1;
        if matches!(before.wish, Posture::Lower | Posture::Higher) {
            return self.by_direction(machine, before.wish);
        }
        if Requested::of(machine, before.wish).unsaid {
            return (generic(), Some(OpenCause::WordsNotDeclared));
        }
        let Some(rule) = branch.rule else {
            let same = self.items.iter().position(|item| item.branch == before.sign);
            return match same {
                Some(index) if before.continuous && before.is_known() && before.sign != 0 => (index, None),
                _ => (generic(), Some(OpenCause::RuleNotDeclared)),
            };
        };
        if before.lacks_start(Some(rule)) {
            return (generic(), Some(OpenCause::StartUnknown));
        }
        if !branch.order.is_empty() {
            let (order, index) = self.compare(machine, rule, &branch.order);
            return (index, (order == Ordering::Equal).then_some(OpenCause::Tie));
        }
        match rule {
            PostureRule::Generic => (generic(), None),
            PostureRule::Fanuc => {
                let (order, index) = self.compare(machine, rule, &[]);
                (index, (order == Ordering::Equal).then_some(OpenCause::Tie))
            }
            PostureRule::Shortest => self.shortest(generic()),
            PostureRule::Heidenhain => {
                // of equal moves the manual's example has the axis nearest the tool above zero
                let [first, second] = self.items.map(|item| item.candidate.q[1]);
                self.shortest(usize::from(second > first))
            }
            PostureRule::Mitsubishi => self.passing(machine, branch, before),
        }
    }

    /// The lexicographically smaller one, the first at a full tie.
    fn compare(&self, machine: &Machine, rule: PostureRule, order: &[Criterion]) -> (Ordering, usize) {
        let (own, modulo) = comparisons(rule);
        let order = if order.is_empty() { own } else { order };
        let [first, second] = &self.items;
        let axes = precedence(machine, rule);
        let found = first.candidate.compare(&second.candidate, order, axes, modulo);
        (found, usize::from(found == Ordering::Greater))
    }

    /// The one whose moves are both no larger.
    fn shortest(&self, otherwise: usize) -> (usize, Option<OpenCause>) {
        let [first, second] = self.items.map(|item| item.candidate.moves);
        let no_larger = |a: [f64; 2], b: [f64; 2]| a[0] <= b[0] + TIE && a[1] <= b[1] + TIE;
        match (no_larger(first, second), no_larger(second, first)) {
            (true, false) => (0, None),
            (false, true) => (1, None),
            _ => (otherwise, Some(OpenCause::Tie)),
        }
    }

    /// Mitsubishi's passing types. Type 1 looks at the sign of the axis nearer the tool, which tilts; type 2 at the move of the other.
    fn passing(&self, machine: &Machine, branch: &Branch, before: &Before) -> (usize, Option<OpenCause>) {
        let cone = machine.control.pole_cone.unwrap_or(0.0);
        // at the pole itself there is no sign to keep
        let at_pole = before.sign == 0 || before.pole_angle < cone.max(POLE_TOLERANCE);
        let tilt = |index: usize| self.items[index].candidate.q[1];
        let signed = |negative: bool| {
            let fits = |index: &usize| (tilt(*index) < -TIE) == negative;
            let mut both = (0..2).filter(fits);
            match (both.next(), both.next()) {
                (Some(only), None) => (only, None),
                _ => (0, Some(OpenCause::Tie)),
            }
        };
        let first_type = if at_pole {
            let joint = machine.constants.rotary().get(1).map(|rotary| rotary.joint);
            match joint.map(|joint| machine.axes[joint].limits) {
                Some(Limits::Range(low, high)) if (high + low).abs() > TIE => signed(high + low < 0.0),
                _ => signed(true),
            }
        } else {
            signed(before.q[1] < 0.0)
        };
        let moves = [0, 1].map(|index| self.items[index].candidate.moves[0]);
        let second_type = if (moves[0] - moves[1]).abs() <= TIE {
            (0, Some(OpenCause::Tie))
        } else {
            (usize::from(moves[1] < moves[0]), None)
        };
        match branch.passing_type {
            Some(1) => first_type,
            Some(_) => second_type,
            None if first_type == second_type => first_type,
            None => (first_type.0, Some(OpenCause::PassingTypeNotDeclared)),
        }
    }

    /// The lower or higher value of the axis to which a preferred direction refers.
    fn by_direction(&self, machine: &Machine, wish: Posture) -> (usize, Option<OpenCause>) {
        let axis = direction_axis(machine);
        let [first, second] = self.items.map(|item| item.candidate.q[axis]);
        if (first - second).abs() <= TIE {
            return (0, Some(OpenCause::Direction));
        }
        let lower = usize::from(second < first);
        (if wish == Posture::Lower { lower } else { 1 - lower }, None)
    }
}

/// The letter of the axis to which a preferred direction is taken to refer, on a machine with two rotary axes.
pub fn direction_letter(machine: &Machine) -> Option<u8> {
    let rotary = machine.constants.rotary();
    let axis = rotary.get(direction_axis(machine)).filter(|_| rotary.len() == 2)?;
    Some(machine.axes[axis.joint].letter)
}

/// The axis to which a preferred direction refers (CYCLE800, `_DIR`: rotary axis 1 of the swivel data; G53.1 P of LinuxCNC: the primary
/// axis): the one nearer the machine's bed on a table or in a head, the head's on a machine with one axis on each side.
fn direction_axis(machine: &Machine) -> usize {
    let side = |index: usize| {
        let rotary = machine.constants.rotary().get(index);
        rotary.map(|rotary| machine.axes[rotary.joint].side)
    };
    usize::from(!(side(0) == Some(Side::Head) && side(1) == Some(Side::Head)))
}

/// Sum of the rotary moves, rad, of the cheapest move from `from` to the tool axis `axis` in the posture with the sign `branch`, limits
/// aside: the least travel of docs/kinematics.md#change-of-posture. A swap that a limit forces is still a swap. `None`: no such posture.
pub(crate) fn cheapest_in_posture(machine: &Machine, axis: &Vec3, branch: i8, from: [f64; 2]) -> Option<f64> {
    let Orientations::Postures(postures) = orientations(machine, axis) else {
        return None;
    };
    let same: &Solution = postures.iter().find(|solution| solution.branch == branch)?;
    let moves = |index: usize| {
        let off = same.q[index] - from[index];
        (off - TAU * (off / TAU).round()).abs()
    };
    Some(moves(0) + moves(1))
}

#[cfg(test)]
mod tests;
