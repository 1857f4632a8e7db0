//! The steps of CYCLE83 in the hole.
//!
//! Source: the text of the control's own cycle (version 6) and the Sinumerik 840D sl Programming Manual, Cycles. The numbers behind it are
//! those of the form without _GMODE, _DMODE and _AMODE; what these say about the steps is not sourced.
use super::called::{Given, HoleCall};
use super::hole::Plan;
use crate::core::Report;
use crate::iso::Iso;
use crate::{Feed, MotionKind};

/// More steps than this are not computed.
const MOST_STEPS: usize = 10_000;
/// mm, against rounding.
const TINY: f64 = 1e-9;
/// How far chip breaking lifts the tool where _VRT is zero, mm.
const LIFT: f64 = 1.0;
/// How far above the last depth rapid ends where _DIS1 is zero, mm, for holes up to the depth [`SHALLOW`].
const ABOVE: f64 = 0.6;
const SHALLOW: f64 = 30.0;
/// For deeper ones it is this part of the depth, and no more than [`MOST_ABOVE`], mm.
const PART_ABOVE: f64 = 1.0 / 50.0;
const MOST_ABOVE: f64 = 7.0;

/// What a call says about its steps; lengths in mm.
#[derive(Clone, Debug, PartialEq)]
struct Pecks {
    /// Depths below the surface, the last is the bottom.
    depths: Vec<f64>,
    /// Share of the feed in the first step.
    first_feed: Option<f64>,
    /// The tool leaves the hole after each step, and comes back in rapid to this distance above the last depth.
    clears: Option<f64>,
    /// It breaks the chip by this lift.
    lift: f64,
}

impl Pecks {
    /// An error: a number that selects another meaning, or is not known, and how many steps were computed before that was seen.
    fn of(call: &HoleCall, unit: f64) -> Result<Self, usize> {
        let number = |place: usize| call.number(place).or_zero().ok_or(0_usize);
        let [_, begin, bottom] = call.levels().ok_or(0_usize)?;
        let surface = number(1)?;
        let total = (surface - bottom) * unit;
        let first = match (number(5)?, number(6)?) {
            (_, below) if matches!(call.number(5), Given::Nothing) => below.abs(),
            (depth, 0.0) => surface - depth,
            (0.0, below) => below.abs(),
            (depth, below) if (surface - depth - below.abs()).abs() <= TINY => below.abs(),
            _ => return Err(0),
        };
        let depths = depths(
            total,
            first * unit,
            number(7)? * unit_of(number(7)?, unit),
            number(13)? * unit,
        )?;
        let metric = unit == 1.0;
        let first_feed = number(10)?;
        let (lift, above) = (number(14)?.abs() * unit, number(16)?.abs() * unit);
        let clears = match number(11)? {
            0.0 => None,
            1.0 if above > 0.0 => Some(above),
            1.0 if metric && (begin - bottom) <= SHALLOW => Some(ABOVE),
            // between both, the sources do not say whether the clearance belongs to the depth
            1.0 if metric && total > SHALLOW => Some((total * PART_ABOVE).min(MOST_ABOVE)),
            _ => return Err(depths.len()),
        };
        let lift = match lift {
            0.0 if clears.is_none() && !metric => return Err(depths.len()),
            0.0 => LIFT,
            lift => lift,
        };
        Ok(Self {
            depths,
            first_feed: (first_feed > 0.0 && first_feed <= 1.0).then_some(first_feed),
            clears,
            lift,
        })
    }
}

/// DAM is a length where it is positive, a factor where it is negative.
fn unit_of(degression: f64, unit: f64) -> f64 {
    if degression > 0.0 { unit } else { 1.0 }
}

/// Depths after each step, mm below the surface. `degression` is DAM: by how much each step is less than the one before; negative: its
/// factor; 0: steps stay. `least` is _MDEP. An error: no step, too many, or the sources do not say how the rest is divided; it counts the steps
/// that were computed.
fn depths(total: f64, first: f64, degression: f64, least: f64) -> Result<Vec<f64>, usize> {
    if !(first > TINY && total > TINY) {
        return Err(0);
    }
    let least = if degression == 0.0 { first } else { least.abs() };
    let (factor, smallest) = match degression {
        0.0 => (1.0, least),
        amount if amount > 0.0 => (1.0, amount),
        factor => (-factor, least),
    };
    let (mut done, mut step, mut halved) = (first.min(total), first, false);
    let mut depths = vec![done];
    while total - done > TINY {
        let left = total - done;
        let mut next = (step * factor - degression.max(0.0)).max(smallest);
        let rest = left - next;
        if rest <= TINY || halved {
            // of what is halved the second half is the last step
            next = left;
        } else if rest < smallest - TINY {
            if degression > 0.0 && left > 2.0 * degression + TINY {
                next = left - degression;
            } else {
                next = left / 2.0;
                halved = true;
            }
        }
        if next <= TINY || depths.len() >= MOST_STEPS {
            return Err(depths.len());
        }
        done = if rest <= TINY { total } else { done + next };
        step = next;
        depths.push(done);
    }
    Ok(depths)
}

/// A share of a feed.
fn part(feed: Feed, share: Option<f64>) -> Feed {
    match (feed, share) {
        (Feed::PerMinute(feed), Some(share)) => Feed::PerMinute(feed * share),
        (Feed::PerRevolution(feed), Some(share)) => Feed::PerRevolution(feed * share),
        _ => Feed::Unknown,
    }
}

impl Iso<'_> {
    /// CYCLE83 from the level above the surface to the bottom, with its dwells; whether its numbers are understood.
    pub(super) fn deep_steps(&mut self, call: &HoleCall, plan: &Plan, report: &mut Report<'_>) -> bool {
        let unit = self.core.state.coordinates.unit_mm();
        if self.is_full() {
            return false;
        }
        let pecks = match Pecks::of(call, unit) {
            Ok(pecks) => pecks,
            Err(computed) => {
                self.cycle_motions.add_in_vain(computed as u64);
                return false;
            }
        };
        let Some(surface) = call.number(1).or_zero().map(|surface| surface * unit) else {
            return false;
        };
        let last = pecks.depths.len() - 1;
        for (at, depth) in pecks.depths.iter().enumerate() {
            if self.is_full() {
                return false;
            }
            let to = if at == last { plan.bottom } else { surface - depth };
            let down = Plan {
                feed: if at == 0 {
                    part(plan.feed, pecks.first_feed)
                } else {
                    plan.feed
                },
                ..*plan
            };
            self.down(&down, MotionKind::Linear, Some(to), report);
            if at == last {
                break;
            }
            self.wait_at_bottom(call.number(8), report);
            match pecks.clears {
                Some(above) => {
                    self.down(plan, MotionKind::Rapid, plan.r, report);
                    self.wait_at_bottom(call.number(9), report);
                    self.down(plan, MotionKind::Rapid, Some(to + above), report);
                }
                None => self.down(plan, MotionKind::Rapid, Some(to + pecks.lift), report),
            }
        }
        let at_bottom = match call.number(15) {
            given if given.or_zero() == Some(0.0) => call.number(8),
            given => given,
        };
        self.wait_at_bottom(at_bottom, report);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_STEPS, depths};

    #[test]
    fn steps_are_divided_as_the_cycle_does() {
        let near = |found: Result<Vec<f64>, usize>, wanted: &[f64]| {
            let found = found.expect("known");
            assert_eq!(found.len(), wanted.len(), "{found:?}");
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-9, "{found}, not {wanted}");
            }
        };
        // an amount: 5, then 3, then 2 each
        near(
            depths(20.0, 5.0, 2.0, 0.0),
            &[5.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0],
        );
        // less than the amount would be left: to the amount above the bottom, or in halves
        near(depths(11.5, 6.0, 1.0, 0.0), &[6.0, 10.5, 11.5]);
        near(depths(7.5, 4.0, 2.0, 0.0), &[4.0, 5.75, 7.5]);
        // a factor, and the least step
        near(depths(10.0, 4.0, -0.5, 1.5), &[4.0, 6.0, 7.5, 8.75, 10.0]);
        near(depths(4.887, 2.0, -1.0, 2.0), &[2.0, 3.4435, 4.887]);
        // a rest smaller than the least step: both halves of what is left
        near(depths(20.0, 10.0, -0.8, 3.0), &[10.0, 15.0, 20.0]);
        // steps that stay
        near(depths(15.0, 5.0, 0.0, 0.0), &[5.0, 10.0, 15.0]);
        near(depths(3.0, 5.0, 0.0, 0.0), &[3.0]);
        for (first, degression) in [(0.0, 1.0), (f64::NAN, 1.0), (1.0, -1e-6)] {
            assert!(depths(10.0, first, degression, 0.0).is_err(), "{first} {degression}");
        }
        assert_eq!(depths(100.0, 0.005, 0.0, 0.0), Err(MOST_STEPS));
    }
}
