//! Axes that mirror another one: the second motor of a gantry. A motion must suit both, so the leader's travel and highest speeds are
//! what both allow.
use crate::raw::Word;
use crate::validate::{Fault, letter};
use crate::{Axis, Gantry, Limits};
use core::ops::Range;

/// The mirroring axes of a file.
#[derive(Default)]
pub(crate) struct Rails {
    found: Vec<(Gantry, Axis, Range<usize>)>,
}

impl Rails {
    /// One more axis that follows `leader`.
    pub(crate) fn add(&mut self, axis: Axis, leader: &Word) -> Result<(), Fault> {
        let named = letter(leader)?;
        if named == axis.letter {
            let message = format!("axis {} cannot follow itself", char::from(named));
            return Err(Fault {
                message,
                span: leader.span(),
            });
        }
        let gantry = Gantry {
            letter: axis.letter,
            leader: named,
        };
        self.found.push((gantry, axis, leader.span()));
        Ok(())
    }

    /// Gives each leader what both axes allow.
    pub(crate) fn bind(&self, axes: &mut [Axis]) -> Result<(), Fault> {
        for (gantry, follower, span) in &self.found {
            let fault = |text: String| {
                let message = format!(
                    "axis {} follows {}, {text}",
                    char::from(gantry.letter),
                    char::from(gantry.leader)
                );
                Err(Fault {
                    message,
                    span: span.clone(),
                })
            };
            let Some(leader) = axes.iter_mut().find(|axis| axis.letter == gantry.leader) else {
                return fault("which is not an axis of this machine".to_owned());
            };
            if leader.kind != follower.kind {
                return fault("but one of them is linear and the other rotary".to_owned());
            }
            leader.limits = match (leader.limits, mirrored(follower)) {
                (own, Limits::Unbounded) => own,
                (Limits::Unbounded, range) => {
                    leader.extra.limits_declared = true;
                    range
                }
                (Limits::Range(low, high), Limits::Range(min, max)) if low.max(min) < high.min(max) => {
                    Limits::Range(low.max(min), high.min(max))
                }
                _ => return fault("but no position is inside the limits of both".to_owned()),
            };
            leader.max_speed = lower(leader.max_speed, follower.max_speed);
            leader.max_acceleration = lower(leader.max_acceleration, follower.max_acceleration);
        }
        Ok(())
    }

    /// The pairs.
    pub(crate) fn gantries(self) -> Vec<Gantry> {
        self.found.into_iter().map(|(gantry, ..)| gantry).collect()
    }
}

/// The follower's limits in terms of its leader: with sign -1 it runs the other way.
fn mirrored(follower: &Axis) -> Limits {
    match follower.limits {
        Limits::Range(min, max) if follower.sign < 0.0 => Limits::Range(-max, -min),
        limits => limits,
    }
}

/// The lower of two limits; an undeclared one limits nothing.
fn lower(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}
