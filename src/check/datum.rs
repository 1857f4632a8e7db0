//! What undeclared zero points and tool lengths leave open about the travel of the linear axes.
//!
//! A joint of a chain of linear axes is its word plus zero point and tool length, so that the span of the path is the same wherever its zero is:
//! what spans more than the travel fits no zero point, and what spans less fits a range of them. Where rotary axes turn the part or the
//! tool, linear joints are not judged.
mod fit;
mod listed;
mod name;
mod span;

use fit::Unclear;
pub(crate) use fit::{Fit, Missing, Open, Overrun};
pub use listed::assumptions;
pub(crate) use name::OffsetName;

use crate::keyed::Keyed;
use crate::place::names_axis;
use crate::view::InForce;
use span::{Basis, Span};
use std::collections::HashSet;
use trunnion_geometry::Vec3;
use trunnion_interp::{AxisLetter, ChainId, LengthOf, Motion, MotionKind, Undeclared};
use trunnion_machine::{AxisKind, Leg, Limits, MAX_AXES, Machine};
use trunnion_syntax::{BlockId, Program};

/// Joints that differ by no more are at the same position, mm.
const SAME_MM: f64 = 1e-9;

/// Undeclared values that are taken as zero, and the undeclared state at power-on that is taken as usual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Assume {
    /// `work-offset`.
    pub work_offset: bool,
    /// `tool-length`.
    pub tool_length: bool,
    /// `power-on`: what the control has at power-on is what its dialect says, else what it is delivered with.
    pub power_on: bool,
}

impl Assume {
    /// All that can be.
    pub const ALL: Self = Self {
        work_offset: true,
        tool_length: true,
        power_on: true,
    };

    /// The names of what can be assumed.
    pub const NAMES: [&'static str; 3] = ["work-offset", "tool-length", "power-on"];

    /// Adds what a name says; false where it is not among [`Self::NAMES`].
    pub fn add(&mut self, name: &str) -> bool {
        match name {
            "work-offset" => self.work_offset = true,
            "tool-length" => self.tool_length = true,
            "power-on" => self.power_on = true,
            _ => return false,
        }
        true
    }

    /// Which values of a motion are undeclared, and not assumed either.
    #[inline]
    pub fn leaves(self, undeclared: Undeclared) -> Undeclared {
        Undeclared {
            zero: if self.work_offset { 0 } else { undeclared.zero },
            length: undeclared.length && !self.tool_length,
            by_turret: if self.tool_length { 0 } else { undeclared.by_turret },
            beside: if self.tool_length && undeclared.by_radius {
                0
            } else {
                undeclared.beside
            },
            ..undeclared
        }
    }
}

/// A linear axis with travel limits.
#[derive(Clone, Copy)]
struct Limited {
    joint: usize,
    /// Bit of its letter in a position; 0 where it is no letter of a position.
    bit: u16,
    letter: u8,
    /// How far 1 mm of tool length moves it, mm.
    per_length: f64,
    travel: [f64; 2],
}

/// Spans of the linear axes while their zero is not declared.
pub(crate) struct Datum {
    axes: Vec<Limited>,
    /// No rotary axis: a joint is its word plus what is undeclared.
    is_linear: bool,
    assume: Assume,
    /// The present position of each joint, and what it depends on.
    anchors: [Option<(f64, Basis)>; MAX_AXES],
    spans: Keyed<(usize, Basis), Span>,
    overruns: Keyed<(u8, Missing), Overrun>,
    open: Keyed<Missing, Open>,
    /// What the last motion depended on, so that nothing is looked up twice.
    last: Option<(Undeclared, OffsetName, LengthOf)>,
    assumed: Keyed<Missing, ()>,
    /// A zero point was set at the position of the machine: no span is certain.
    mixed: bool,
}

impl Datum {
    pub(crate) fn new(machine: &Machine, assume: Assume) -> Self {
        let limited = |(joint, axis): (usize, &trunnion_machine::Axis)| match (axis.kind, axis.limits) {
            (AxisKind::Linear, Limits::Range(low, high)) => Some(Limited {
                joint,
                bit: AxisLetter::new(axis.letter).map_or(0, |letter| 1 << letter.0),
                letter: axis.letter,
                per_length: machine.per_length(joint),
                travel: [low, high],
            }),
            _ => None,
        };
        Self {
            axes: machine.axes.iter().enumerate().filter_map(limited).collect(),
            is_linear: machine.rotary.is_empty(),
            assume,
            anchors: [None; MAX_AXES],
            spans: Keyed::default(),
            overruns: Keyed::default(),
            open: Keyed::default(),
            last: None,
            assumed: Keyed::default(),
            mixed: false,
        }
    }

    /// Takes the next leg.
    #[inline]
    pub(crate) fn add(&mut self, leg: &Leg, in_force: &InForce, program: &Program) {
        if self.is_linear || leg.motion.undeclared.any() || self.last.is_some() {
            self.add_open(leg, in_force, program);
        }
    }

    fn add_open(&mut self, leg: &Leg, in_force: &InForce, program: &Program) {
        let motion = &leg.motion;
        let undeclared = self.assume.leaves(motion.undeclared);
        let own = (motion.undeclared, in_force.offset, in_force.length_of);
        if self.last != Some(own) {
            self.last = Some(own);
            self.note_assumed(motion.undeclared, in_force);
            if !self.is_linear && undeclared.any() && leg.known_joints.1 != 0 {
                self.note_open(undeclared, in_force, motion);
            }
        }
        if self.is_linear {
            self.span(leg, undeclared, in_force, program);
        }
    }

    fn note_assumed(&mut self, undeclared: Undeclared, in_force: &InForce) {
        let offset = (undeclared.zero != 0 && self.assume.work_offset).then_some(Missing::Offset(in_force.offset));
        let length = (undeclared.length && self.assume.tool_length).then_some(Missing::Length(in_force.length_of));
        for missing in offset.into_iter().chain(length) {
            self.assumed.insert(missing, ());
        }
    }

    fn note_open(&mut self, undeclared: Undeclared, in_force: &InForce, motion: &Motion) {
        let linear = self.axes.iter().fold(0, |mask, axis| mask | axis.bit);
        let offset = (undeclared.zero & linear != 0).then_some(Missing::Offset(in_force.offset));
        let length = undeclared.length.then_some(Missing::Length(in_force.length_of));
        for missing in offset.into_iter().chain(length).map(Missing::reported) {
            self.open.entry(missing, || Open {
                missing,
                block: motion.block,
                chain: motion.chain,
                fits: Vec::new(),
            });
        }
    }

    /// Where the joints of a leg are, each with what it depends on.
    fn span(&mut self, leg: &Leg, undeclared: Undeclared, in_force: &InForce, program: &Program) {
        if undeclared.set_here && undeclared.any() {
            // the shift is relative to the position of the machine, which may be known without the offset
            self.mixed = true;
            self.note_open(undeclared, in_force, &leg.motion);
        }
        let (joints, known) = (&leg.known_joints.0, leg.known_joints.1);
        let place = (leg.motion.block, leg.motion.chain);
        for index in 0..self.axes.len() {
            let axis = self.axes[index];
            if known & (1 << axis.joint) == 0 {
                self.anchors[axis.joint] = None;
                continue;
            }
            let shifted = if undeclared.by_turret == 0 {
                axis.per_length != 0.0
            } else {
                undeclared.by_turret & axis.bit != 0
            };
            let mut basis = Basis {
                offset: (undeclared.zero & axis.bit != 0).then_some(in_force.offset),
                length: (undeclared.length && shifted).then_some(in_force.length_of),
            };
            let end = joints[axis.joint];
            if undeclared.beside & axis.bit != 0 {
                self.anchors[axis.joint] = Some((end, basis));
                if let Some(span) = self.span_of(axis, basis, place) {
                    span.beside = true;
                }
                continue;
            }
            if self.anchors[axis.joint].is_none() && stands(&leg.motion, axis.bit) {
                // a tool change has left it there, in coordinates of the machine
                let of_machine = Basis {
                    offset: None,
                    length: None,
                };
                let named = names_axis(program, leg.motion.block, axis.letter);
                if leg.motion.chain != ChainId::MAIN {
                    self.may_reach(axis, basis, [end, end], place);
                }
                if leg.motion.chain != ChainId::MAIN || !named {
                    self.anchors[axis.joint] = Some((end, of_machine));
                    continue;
                }
            }
            match self.anchors[axis.joint].replace((end, basis)) {
                // an increment starts from where the axis was
                Some((_, before)) if leg.motion.says_way & axis.bit != 0 => {
                    self.anchors[axis.joint] = Some((end, before));
                    basis = before;
                    self.reach(axis, basis, [end, end], place);
                }
                Some((at, before)) if (at - end).abs() <= SAME_MM && before != basis => {
                    self.anchors[axis.joint] = Some((at, before));
                    // its word names the position where it already seems to be, or the block does not name it
                    if leg.motion.chain != ChainId::MAIN || names_axis(program, leg.motion.block, axis.letter) {
                        self.may_reach(axis, basis, [end, end], place);
                    }
                }
                _ => self.reach(axis, basis, [end, end], place),
            }
            if let MotionKind::Arc(Some(arc)) = &leg.motion.kind
                && axis.bit.trailing_zeros() < 3
            {
                let mut direction = Vec3::zeros();
                direction[axis.bit.trailing_zeros() as usize] = 1.0;
                let (low, high) = arc.extent(&direction);
                let shift = end - leg.motion.end.values[axis.bit.trailing_zeros() as usize];
                self.reach(axis, basis, [low + shift, high + shift], place);
            }
        }
    }

    fn span_of(&mut self, axis: Limited, basis: Basis, place: (BlockId, ChainId)) -> Option<&mut Span> {
        if basis.is_declared() {
            return None;
        }
        let new = || Span::new(axis.joint, basis, place);
        Some(self.spans.entry((axis.joint, basis), new))
    }

    fn reach(&mut self, axis: Limited, basis: Basis, [low, high]: [f64; 2], place: (BlockId, ChainId)) {
        let [from, to] = axis.travel;
        let Some(span) = self.span_of(axis, basis, place) else {
            return;
        };
        if span.certain.includes(low) && span.certain.includes(high) {
            return;
        }
        span.certain.add(low, high);
        span.possible.add(low, high);
        let width = span.certain.width();
        let worst = span.worst;
        span.worst = worst.max(width);
        if width <= to - from + trunnion_machine::LIMIT_SLACK || width <= worst {
            return;
        }
        let overrun = Overrun {
            missing: basis.missing(),
            block: place.0,
            chain: place.1,
            letter: axis.letter,
            span_mm: width,
            travel_mm: to - from,
        };
        let key = (overrun.letter, overrun.missing);
        self.overruns.entry(key, || overrun).span_mm = width;
    }

    fn may_reach(&mut self, axis: Limited, basis: Basis, [low, high]: [f64; 2], place: (BlockId, ChainId)) {
        if let Some(span) = self.span_of(axis, basis, place) {
            span.possible.add(low, high);
        }
    }

    /// What does not fit wherever the zero is.
    pub(crate) fn overruns(&self) -> impl Iterator<Item = &Overrun> {
        self.overruns.values().filter(|_| !self.mixed)
    }

    /// What was taken as zero because the settings say so.
    pub(crate) fn assumed(&self) -> impl Iterator<Item = &Missing> {
        self.assumed.keys()
    }

    /// What is left open, each cause once; with the ranges that fit on a chain of linear axes. A cause with something that does not fit at
    /// all is not open.
    pub(crate) fn open(&self) -> Vec<Open> {
        let mut open = self.open.clone();
        let overrun: HashSet<Missing> = self.overruns().map(|overrun| overrun.missing).collect();
        for span in self.spans.values() {
            let missing = span.basis.missing();
            if overrun.contains(&missing) {
                continue;
            }
            let Some(axis) = self.axes.iter().find(|axis| axis.joint == span.joint) else {
                continue;
            };
            let reported = missing.reported();
            let entry = open.entry(reported, || Open {
                missing: reported,
                block: span.place.0,
                chain: span.place.1,
                fits: Vec::new(),
            });
            entry.fits.push(Fit {
                letter: axis.letter,
                with_length: span.basis.offset.and(span.basis.length),
                range: match span.possible.room(axis.travel) {
                    _ if span.beside => Err(Unclear::Radius),
                    Some(range) if !self.mixed => Ok(range),
                    _ => Err(Unclear::Motions),
                },
            });
        }
        open.into_values()
    }
}

/// Whether an axis is where it was before a motion.
fn stands(motion: &Motion, bit: u16) -> bool {
    let axis = bit.trailing_zeros() as usize;
    let at = (bit != 0).then(|| motion.start.get(axis)).flatten();
    at.is_some() && at == motion.end.get(axis)
}

#[cfg(test)]
mod tests;
