//! What a rule can know about the legs before: how far the rotary axes turned in the last feed blocks, and the rapid motions since the last cut.
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{asin, rotate};
use trunnion_interp::{Clamps, MotionKind, Tool, Undeclared};
use trunnion_machine::{Joints, Leg, Machine, Stance};
use trunnion_syntax::BlockId;

/// Feed blocks in the window of `excess-rotary-travel`.
pub(crate) const WINDOW: usize = 10;

/// What is remembered about the legs up to the current one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Trail {
    window: Window,
    rapids: Rapids,
    state: State,
    /// Clamps of the rotary axes with the current leg.
    pub(crate) clamps: Clamps,
    /// Declared length of the tool in use with the current leg, mm.
    pub(crate) own_length_mm: Option<f64>,
    /// What is declared about the tool in use.
    pub(crate) tool: Option<Tool>,
    /// The undeclared values that the current leg depends on.
    pub(crate) undeclared: Undeclared,
}

/// What the last leg was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    /// Neither of the two below.
    #[default]
    Other,
    /// A rapid motion: the path continues.
    Rapid,
    /// The feed motion to which the rapid motions led.
    Arrived,
}

/// The last feed blocks.
#[derive(Clone, Copy, Debug, Default)]
struct Window {
    /// D1 + D2 of each, rad.
    turned: [f64; WINDOW],
    /// Chord between the tool axes at both ends of each.
    chord: [f64; WINDOW],
    next: usize,
    count: usize,
    /// This many of the last ones each turned no more than `ratio` times their chord.
    calm: usize,
    ratio: f64,
}

impl Window {
    #[inline]
    fn push(&mut self, turned: f64, chord: f64, ratio: f64) {
        let next = self.next.min(WINDOW - 1);
        self.turned[next] = turned;
        self.chord[next] = chord;
        self.next = if next + 1 == WINDOW { 0 } else { next + 1 };
        self.count = (self.count + 1).min(WINDOW);
        if turned * ROUNDED_UP <= ratio * chord && self.ratio == ratio {
            self.calm += 1;
        } else {
            self.calm = 0;
            self.ratio = ratio;
        }
    }
}

/// Rapid motions in a row.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rapids {
    /// How many.
    pub count: u32,
    /// Block of the first.
    pub first: BlockId,
    /// Travel of the linear axes across the tool, added up, mm.
    pub way_mm: f64,
    /// The direct distance across the tool from start to end, mm.
    pub direct_mm: f64,
    /// Turns of the rotary axes, added up, rad.
    pub turned: [f64; 2],
    /// Turns from start to end, rad.
    pub direct_turn: [f64; 2],
    tool: Option<u32>,
    net: Vec3,
    /// Where they start.
    pub from: Joints,
}

impl Trail {
    /// Takes the next leg, and the chord between the tool axes at both its ends where a rotary axis turns; then the rules look at it.
    #[inline]
    pub(crate) fn add(&mut self, machine: &Machine, leg: &Leg, chord: f64) {
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            *self = Self {
                clamps: self.clamps,
                own_length_mm: self.own_length_mm,
                tool: self.tool,
                undeclared: self.undeclared,
                ..Self::default()
            };
            return;
        };
        match leg.motion.kind {
            MotionKind::Rapid => self.rapid(machine, leg, start, end),
            MotionKind::Linear | MotionKind::Arc(_) => {
                self.state = if self.state == State::Rapid {
                    State::Arrived
                } else {
                    State::Other
                };
                if machine.constants.has_pair() {
                    self.feed(leg, chord, machine.tolerances.rotary_ratio);
                }
            }
            MotionKind::Dwell(_) | MotionKind::Unknown => self.state = State::Other,
        }
    }

    #[inline]
    fn feed(&mut self, leg: &Leg, chord: f64, ratio: f64) {
        let turned = leg.rotary_change[0] + leg.rotary_change[1];
        // without TCP a table that turns about the tool feeds the part under it
        if turned == 0.0 || chord < 1e-9 && !trunnion_machine::leads_tip(&leg.motion) {
            return self.window.push(0.0, 0.0, ratio);
        }
        self.window.push(turned, chord, ratio);
    }

    #[cold]
    fn rapid(&mut self, machine: &Machine, leg: &Leg, start: &Stance, end: &Stance) {
        if self.state != State::Rapid || self.rapids.tool != leg.motion.tool {
            self.rapids = Rapids {
                first: leg.motion.block,
                from: start.joints,
                tool: leg.motion.tool,
                ..Rapids::default()
            };
        }
        self.state = State::Rapid;
        let rapids = &mut self.rapids;
        rapids.count += 1;
        let mut way = Vec3::zeros();
        for linear in machine.constants.linear() {
            way += linear.motion * (end.joints[linear.joint] - start.joints[linear.joint]);
        }
        let tool = tool_in_machine(machine, end);
        rapids.net += way;
        rapids.way_mm += across(&way, &tool);
        rapids.direct_mm = across(&rapids.net, &tool);
        for (slot, rotary) in machine.constants.rotary().iter().enumerate().take(2) {
            rapids.turned[slot] += (end.joints[rotary.joint] - start.joints[rotary.joint]).abs();
            rapids.direct_turn[slot] = (end.joints[rotary.joint] - rapids.from[rotary.joint]).abs();
        }
    }

    /// Turn of the rotary axes and of the tool axis in the last ten feed blocks, rad, where the first is more than `ratio` times the
    /// second (which is at least `least`).
    pub(crate) fn excess_turn(&self, ratio: f64, least: f64) -> Option<(f64, f64)> {
        if !self.may_exceed(ratio, least) {
            return None;
        }
        let turned: f64 = self.window.turned.iter().sum();
        let chords: f64 = self.window.chord.iter().sum();
        // a chord is never longer than its arc
        if turned <= ratio * chords.max(least) {
            return None;
        }
        let angle = |chord: &f64| if *chord < 2.0 { 2.0 * asin(0.5 * chord) } else { PI };
        let tilted: f64 = self.window.chord.iter().map(angle).sum();
        (turned > ratio * tilted.max(least)).then_some((turned, tilted))
    }

    /// Whether [`Self::excess_turn`] may find anything: most windows are far from it, which sums in any order show.
    #[inline]
    pub(crate) fn may_exceed(&self, ratio: f64, least: f64) -> bool {
        let window = &self.window;
        // what holds for each holds for their sums
        if window.calm >= WINDOW && window.ratio == ratio {
            return false;
        }
        window.count >= WINDOW && any_sum(&window.turned) * ROUNDED_UP > ratio * any_sum(&window.chord).max(least)
    }

    /// The rapid motions that led to the current feed motion.
    pub(crate) fn rapids(&self) -> Option<&Rapids> {
        (self.state == State::Arrived).then_some(&self.rapids)
    }
}

/// The chord between the tool axes at both ends of a leg, 0 where no rotary axis turns or one is not known.
#[inline]
pub(crate) fn axes_chord(leg: &Leg) -> f64 {
    match (&leg.start, &leg.end) {
        (Some(start), Ok(end)) if leg.rotary_change[0] + leg.rotary_change[1] != 0.0 => (end.axis - start.axis).norm(),
        _ => 0.0,
    }
}

/// More than the difference between sums of the same numbers in different orders can be.
const ROUNDED_UP: f64 = 1.0 + 1e-9;

/// The sum in the order that is fastest.
#[inline]
fn any_sum(values: &[f64; WINDOW]) -> f64 {
    let [a, b, c, d, e, f, g, h, i, j] = values;
    ((a + b) + (c + d)) + ((e + f) + (g + h)) + (i + j)
}

/// The part of a move perpendicular to the tool, mm.
fn across(way: &Vec3, tool: &Vec3) -> f64 {
    (way - tool * tool.dot(way)).norm()
}

/// The tool axis in the frame in which the linear axes run: turned by the rotary axes between them and the tool.
fn tool_in_machine(machine: &Machine, stance: &Stance) -> Vec3 {
    let constants = &machine.constants;
    let behind = constants
        .linear()
        .iter()
        .map(|linear| linear.segment)
        .max()
        .unwrap_or(0);
    let mut tool = machine.tool_axis;
    for rotary in constants.rotary().iter().skip(behind).rev() {
        tool = rotate(&rotary.direction, rotary.sign * stance.joints[rotary.joint], &tool);
    }
    tool
}

#[cfg(test)]
mod tests {
    use super::{WINDOW, Window};
    use crate::trail::Trail;
    use proptest::prelude::*;

    proptest! {
        /// If the exact sums are too large, the first look finds it, whatever led there.
        #[test]
        fn a_look_at_each_block_rules_out_no_more_than_the_sums(
            blocks in proptest::collection::vec((0.0..2.0, prop_oneof![Just(0.0), 0.05..1.0], any::<bool>()), 0..60),
            least in 0.0..0.1,
        ) {
            let mut trail = Trail::default();
            let ratio = 20.0;
            for (size, chord, calm) in blocks {
                // most are calm, a few just so
                let turned = if calm { chord * ratio * (size * 0.5) } else { chord * ratio * (0.9 + 0.1 * size) + size };
                trail.window.push(turned, chord, ratio);
                prop_assert!(trail.may_exceed(ratio, least) || trail.excess_turn(ratio, least).is_none());
                let window = &trail.window;
                let turned: f64 = window.turned.iter().sum();
                let chords: f64 = window.chord.iter().sum();
                prop_assert!(trail.may_exceed(ratio, least) || window.count < WINDOW || turned <= ratio * chords.max(least));
                prop_assert_eq!(trail.may_exceed(2.0 * ratio, least), {
                    let other = Trail { window: Window { calm: 0, ..*window }, ..trail };
                    other.may_exceed(2.0 * ratio, least)
                });
            }
        }
    }
}
