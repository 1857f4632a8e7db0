//! Whether the output program stays inside the travel of its machine, and keeps axes still that must not move while cutting.
use crate::Refused;
use crate::job::{Event, Job};
use crate::plan::Out;
use trunnion_certify::conversion::{Part, Reading};
use trunnion_geometry::deg;
use trunnion_interp::Setup;
use trunnion_machine::{AxisKind, Excess, Leg, Machine, NO_TURN, limit_excess, rotary_turns};
use trunnion_syntax::BlockId;

/// Coordinates that differ by less are the same, mm.
const SAME_MM: f64 = 1e-7;

/// A coordinate is a number of the output within this part of its last digit.
const ON_GRID: f64 = 1e-6;

/// An axis that would leave its travel.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    /// Line of the original program.
    pub line: u32,
    /// Letter of the axis.
    pub axis: char,
    /// Where it would go, mm or deg.
    pub value: f64,
    /// Its limit, mm or deg.
    pub limit: f64,
    /// `mm` or `deg`.
    pub unit: &'static str,
    /// Inside the block, between two ends that are legal.
    pub inside: bool,
}

impl core::fmt::Display for Beyond {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let where_ = if self.inside { " inside the block" } else { "" };
        write!(
            f,
            "{} would go to {:.4} {}{where_}, its limit is {:.4} {}",
            self.axis, self.value, self.unit, self.limit, self.unit
        )
    }
}

/// What leaves the travel, and where that is unknown: motions of the original program.
#[derive(Default)]
pub(crate) struct Travel {
    /// Each limit once: where it is broken first, the worst value, and where that is.
    beyond: Vec<(usize, Excess, usize)>,
    undecided: Vec<usize>,
    /// The first cut that turns an axis which must stand still while cutting: the motion, letter of the axis, by how much, rad; `None`:
    /// whether it does is not known.
    turned: Option<(usize, char, Option<f64>)>,
}

/// Checks every motion of the converted program.
pub(crate) fn travel(after: &Reading, parts: &[Part], machine: Option<&Machine>) -> Travel {
    let mut travel = Travel::default();
    let Some(machine) = machine else { return travel };
    let (mut was, mut is) = (0, 0);
    let mut found = Vec::new();
    for part in parts {
        let (before, count) = match part {
            Part::Moves(count) => (1, *count as usize),
            Part::Words => (1, 1),
            Part::Left => (1, 0),
            Part::Added(count) => (0, *count as usize),
        };
        for posed in &after.motions[is..is + count] {
            let Some(leg) = &posed.leg else { continue };
            if travel.turned.is_none() && posed.motion.is_feed() {
                travel.turned = held_axis_turns(machine, leg).map(|(axis, turn)| (was, axis, turn));
            }
            found.clear();
            let decided = limit_excess(machine, leg, &mut found);
            let decided = decided && !found.iter().any(|excess| excess.if_together);
            if !decided && travel.undecided.last() != Some(&was) {
                travel.undecided.push(was);
            }
            for excess in found.iter().filter(|excess| !excess.if_together) {
                travel.add(was, *excess);
            }
        }
        was += before;
        is += count;
    }
    travel
}

/// An axis with `clamp = true` that the motion turns: its letter, and by how much, rad; `None` where its path from one known position to
/// another is unknown.
fn held_axis_turns(machine: &Machine, leg: &Leg) -> Option<(char, Option<f64>)> {
    let turns = rotary_turns(machine, leg);
    let lost = turns.is_none() && leg.start.is_some() && leg.end.is_ok();
    let mut at_least = machine.rotary.iter().zip(turns.unwrap_or(leg.rotary_change));
    at_least.find_map(|(&joint, turn)| {
        let axis = &machine.axes[joint];
        let turn = (turn > NO_TURN).then_some(turn);
        (axis.extra.clamp && (lost || turn.is_some())).then_some((char::from(axis.letter), turn))
    })
}

impl Travel {
    fn add(&mut self, was: usize, excess: Excess) {
        let off = |one: &Excess| (one.value - one.limit).abs();
        let same = |known: &&mut (usize, Excess, usize)| known.1.axis == excess.axis && known.1.limit == excess.limit;
        match self.beyond.iter_mut().find(same) {
            Some(known) if off(&known.1) >= off(&excess) => {}
            Some(known) => (known.1, known.2) = (excess, was),
            None => self.beyond.push((was, excess, was)),
        }
    }

    /// Moves coordinates that only their rounding to the digits of the output (`step` mm) takes beyond a limit to the next value on the other side; whether there
    /// were any.
    pub(crate) fn draw_in(&self, outs: &mut [Out], machine: Option<&Machine>, step: f64) -> bool {
        let mut changed = false;
        for (_, excess, worst) in &self.beyond {
            let letter = machine
                .and_then(|machine| machine.axes.get(excess.axis))
                .map(|axis| axis.letter);
            let Some(axis) = (0..3).find(|axis| letter == Some(b"XYZ"[*axis])) else {
                continue;
            };
            if (excess.value - excess.limit).abs() > 0.51 * step {
                continue;
            }
            let values: Vec<f64> = match outs.get(*worst) {
                Some(Out::Moves(moves)) => moves.iter().map(|one| one.xyz[axis]).collect(),
                _ => Vec::new(),
            };
            let moves = outs.iter_mut().filter_map(|out| match out {
                Out::Moves(moves) => Some(moves),
                _ => None,
            });
            for one in moves.flatten() {
                let value = one.xyz[axis];
                let (count, nearest) = (value / step, (value / step).round());
                // what is on the grid was not rounded
                if (count - nearest).abs() > ON_GRID && values.iter().any(|known| (known - value).abs() < SAME_MM) {
                    one.xyz[axis] = step * if nearest > count { count.floor() } else { count.ceil() };
                    changed = true;
                }
            }
        }
        changed
    }

    /// The findings in words and numbers, and the lines where the travel is not decided. Where the zero points are declared, a program
    /// that leaves the travel is refused: it could never run. So is one that turns an axis in a cut which must stand still there.
    ///
    /// # Errors
    /// See above.
    pub(crate) fn judge(
        &self,
        reading: &Reading,
        machine: Option<&Machine>,
        zeros_declared: bool,
        line: impl Fn(BlockId) -> u32,
    ) -> Result<(Vec<Beyond>, Vec<u32>), Refused> {
        // what is added before the first motion, or after the last, is listed there
        let block = |was: usize| {
            let motion = reading.motions.get(was).or(reading.motions.last());
            motion.map(|posed| posed.motion.block).unwrap_or_default()
        };
        if let Some((was, axis, turn)) = self.turned {
            let what = turn.map_or_else(
                || format!("how far this cut would turn {axis} is unknown"),
                |turn| format!("this cut would turn {axis} by {:.3} deg", deg(turn)),
            );
            let message = format!(
                "{what}, but the machine file of {} says clamp = true at {axis}: it must stand still while cutting. Cut with a fixed tool \
                 axis, position {axis} in rapid motions, or use a machine that can cut while this axis turns",
                machine.map_or("", |machine| machine.id.as_str())
            );
            return Err(Refused::at(&reading.program, block(was), message));
        }
        let mut all = Vec::new();
        for (was, excess, _) in &self.beyond {
            let Some(axis) = machine.and_then(|machine| machine.axes.get(excess.axis)) else {
                continue;
            };
            let (unit, plain): (_, fn(f64) -> f64) = match axis.kind {
                AxisKind::Linear => ("mm", |value| value),
                AxisKind::Rotary => ("deg", deg),
            };
            let beyond = Beyond {
                line: line(block(*was)),
                axis: char::from(axis.letter),
                value: plain(excess.value),
                limit: plain(excess.limit),
                unit,
                inside: excess.inside,
            };
            if zeros_declared {
                let message = format!("the program would leave the travel of the machine: {beyond}");
                return Err(Refused::at(&reading.program, block(*was), message));
            }
            all.push(beyond);
        }
        let undecided = self.undecided.iter().map(|was| line(block(*was))).collect();
        Ok((all, undecided))
    }
}

/// Whether every work offset that the converted program names is declared, so that the joints are right.
pub(crate) fn zeros_declared(job: &Job, setup: &Setup, work_offset: &str) -> bool {
    let declared = |name: &str| {
        setup
            .work_offsets
            .iter()
            .any(|offset| offset.name.eq_ignore_ascii_case(name))
    };
    let mut named = job.events.iter().filter_map(|placed| match &placed.event {
        Event::WorkOffset(name) => Some(name.as_str()),
        _ => None,
    });
    let first = named.next().unwrap_or(work_offset);
    declared(first) && named.all(declared)
}
