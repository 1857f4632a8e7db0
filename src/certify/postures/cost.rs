//! What a sequence of postures is chosen by.
use serde::{Deserialize, Serialize};
use trunnion_geometry::deg;
use trunnion_machine::{Machine, Stance, joint_line_deviation};

/// The cost of a motion; a program costs the sum of its motions. Counted in billionths of the unit, so that sums are exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PostureCost {
    /// Travel of the rotary axes, deg: the root of the sum of squares of their steps.
    #[default]
    Travel,
    /// Time of the slowest rotary axis at its highest speed, s.
    Time,
    /// Largest distance of the tip from the straight line between its ends, mm; zero where the control guides the tip.
    Deviation,
}

impl PostureCost {
    /// The unit of its values.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Travel => "deg",
            Self::Time => "s",
            Self::Deviation => "mm",
        }
    }

    /// As it is written on the command line and in settings.
    pub fn name(self) -> &'static str {
        match self {
            Self::Travel => "travel",
            Self::Time => "time",
            Self::Deviation => "deviation",
        }
    }

    /// Cost of rotary steps (rad), in billionths; the deviation is that of [`deviation`]. A speed that the machine does not declare counts as
    /// endless: [`PostureCost::lacks`] names it before.
    pub(super) fn of_steps(self, machine: &Machine, steps: [f64; 2]) -> u64 {
        match self {
            Self::Travel => billionths(deg((steps[0] * steps[0] + steps[1] * steps[1]).sqrt())),
            Self::Time => {
                let axes = machine.rotary.iter().zip(steps);
                let times =
                    axes.map(|(&joint, step)| machine.axes[joint].max_speed.map_or(0.0, |speed| step.abs() / speed));
                billionths(times.fold(0.0, f64::max))
            }
            Self::Deviation => 0,
        }
    }

    /// The letter of a rotary axis whose speed this cost needs and the machine does not declare.
    pub fn lacks(self, machine: &Machine) -> Option<char> {
        let undeclared = |joint: &&usize| machine.axes[**joint].max_speed.is_none_or(|speed| speed <= 0.0);
        let joint = machine.rotary.iter().find(undeclared).filter(|_| self == Self::Time)?;
        Some(char::from(machine.axes[*joint].letter))
    }
}

/// Distance of the tip from the straight line between its ends while all joints run evenly from one stance to the other, billionths of a mm.
pub(super) fn deviation(machine: &Machine, from: &Stance, to: &Stance) -> u64 {
    billionths(joint_line_deviation(machine, from, to))
}

/// A value that is not negative in billionths, rounded; the largest number for what is not finite.
fn billionths(value: f64) -> u64 {
    // the cast saturates
    if value.is_nan() {
        u64::MAX
    } else {
        (value * 1e9).round() as u64
    }
}
