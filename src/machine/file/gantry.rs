//! Axes that mirror another one: the second motor of a gantry. A motion must be possible for both, so the leader's travel and highest
//! speeds are what both allow.
use crate::file::raw::{RawAxis, Word};
use crate::file::validate::{Fault, letter};
use crate::{Axis, Gantry, Limits};
use core::ops::Range;

/// The mirroring axes of a file.
#[derive(Default)]
pub(crate) struct Rails {
    found: Vec<MirroredAxis>,
}

/// One axis that mirrors another one.
struct MirroredAxis {
    gantry: Gantry,
    axis: Axis,
    /// Where the file names the leader.
    span: Range<usize>,
    /// The file gives its sign; else it moves like its leader.
    signed: bool,
    /// The file gives its direction.
    directed: bool,
}

impl Rails {
    /// One more axis that follows `leader`.
    pub(crate) fn add(&mut self, axis: Axis, written: &RawAxis, leader: &Word) -> Result<(), Fault> {
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
        self.found.push(MirroredAxis {
            gantry,
            axis,
            span: leader.span(),
            signed: written.sign.is_some(),
            directed: written.dir.is_some(),
        });
        Ok(())
    }

    /// Gives each leader what both axes allow.
    pub(crate) fn bind(&self, axes: &mut [Axis]) -> Result<(), Fault> {
        for rail in &self.found {
            let (gantry, follower, span) = (&rail.gantry, &rail.axis, &rail.span);
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
            leader.limits = match (leader.limits, rail.limits_for(leader)) {
                (own, Limits::Unbounded) => own,
                (Limits::Unbounded, range) => {
                    leader.extra.limits_declared = true;
                    range
                }
                (Limits::Range(low, high), Limits::Range(min, max)) if low.max(min) < high.min(max) => {
                    Limits::Range(low.max(min), high.min(max))
                }
                _ => return fault("but no position is within the limits of both".to_owned()),
            };
            leader.max_speed = lower(leader.max_speed, follower.max_speed);
            leader.max_acceleration = lower(leader.max_acceleration, follower.max_acceleration);
        }
        Ok(())
    }

    /// The pairs.
    pub(crate) fn gantries(self) -> Vec<Gantry> {
        self.found.into_iter().map(|rail| rail.gantry).collect()
    }
}

impl MirroredAxis {
    /// The follower's limits in terms of its leader: both move one body, so if a positive value moves it in the opposite direction (sign times
    /// direction), the follower has the leader's value with the opposite sign.
    fn limits_for(&self, leader: &Axis) -> Limits {
        let turned = self.signed && self.axis.sign * leader.sign < 0.0;
        let opposite = self.directed && self.axis.direction.dot(&leader.direction) < 0.0;
        match self.axis.limits {
            Limits::Range(min, max) if turned != opposite => Limits::Range(-max, -min),
            limits => limits,
        }
    }
}

/// The lower of two limits; an undeclared one limits nothing.
fn lower(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}
