//! The motions of a hole cycle at one point.
//!
//! CL data leave them to the post-processor. What every post does is taken: across at the higher of the present level and the clearance,
//! down in rapid to the clearance, in at the feed, a time at the bottom, out, and in rapid to where the tool returns to.
use crate::apt::Apt;
use crate::apt::cycle::{Back, Hole, Out, Pecks, Stay};
use crate::core::{ROTARY, Report};
use crate::{FaultKind, Feed, Motion, MotionKind, Orientation, Position};
use trunnion_geometry::Vec3;
use trunnion_syntax::TextRange;

/// Steps of one hole.
const MOST: usize = 10_000;
/// Levels that differ by less are one, mm.
const SAME_LEVEL: f64 = 1e-9;

/// What stays the same for the motions at one point.
struct At {
    point: Vec3,
    axis: Vec3,
    feed: Feed,
}

impl At {
    fn above(&self, height: f64) -> Vec3 {
        self.point + self.axis * height
    }
}

impl Apt<'_> {
    /// All motions of the cycle at a point; the tool is along the vector of the orientation.
    pub(crate) fn drill(&mut self, hole: &Hole, point: Vec3, orientation: Orientation, report: &mut Report<'_>) {
        let Orientation::Vector(_, axis) = orientation else {
            let motion = self.unknown_goto(orientation, report);
            return self.more.push(motion);
        };
        if let Some(what) = self.cycle_motions.over(self.core.setup.limits.blocks) {
            report.fault(TextRange::default(), FaultKind::NotModelled { what });
            let motion = self.unknown_goto(orientation, report);
            return self.more.push(motion);
        }
        self.core.state.orientation = orientation;
        self.first_vector = Some(orientation);
        let feed = match hole.feed {
            Some(feed) => feed,
            None => self.core.feed(MotionKind::Linear, TextRange::default, report),
        };
        let at = At { point, axis, feed };
        let before = self.core.state.position.xyz();
        let level = before.map(|from| (from - point).dot(&axis));
        match level {
            Some(level) if level > hole.clear + SAME_LEVEL => {
                self.drill_to(MotionKind::Rapid, Some(at.above(level)), &at, report);
            }
            Some(level) if level < hole.clear - SAME_LEVEL => {
                let up = before.map(|from| from + axis * (hole.clear - level));
                self.drill_to(MotionKind::Rapid, up, &at, report);
            }
            _ => {}
        }
        self.drill_to(MotionKind::Rapid, Some(at.above(hole.clear)), &at, report);
        match hole.pecks {
            Pecks::None => self.drill_to(MotionKind::Linear, Some(at.above(-hole.depth)), &at, report),
            Pecks::Deep(..) | Pecks::Chip(..) => self.pecks(hole, &at, report),
        }
        if let Some(stay) = hole.stay {
            self.stay(stay, report);
        }
        self.leave(hole, &at, level, report);
    }

    fn leave(&mut self, hole: &Hole, at: &At, level: Option<f64>, report: &mut Report<'_>) {
        let back = match hole.back {
            Back::To(height) => Some(height),
            Back::Before => level,
            Back::Plane => None,
        };
        let out = match hole.out {
            Out::Rapid => MotionKind::Rapid,
            Out::Feed | Out::Tap => MotionKind::Linear,
            Out::Open => MotionKind::Unknown,
        };
        let clear = at.above(hole.clear);
        if out != MotionKind::Rapid {
            self.drill_to(out, Some(clear), at, report);
        }
        let back = back.map(|height| at.above(height));
        if out == MotionKind::Rapid || back != Some(clear) {
            self.drill_to(MotionKind::Rapid, back, at, report);
        }
        if back.is_none() && !self.kept.cycle_said {
            let what = "CYCLE: where the tool goes back to: the record does not name the plane (RETURN,0), or the level before it is not known";
            self.say_once(what, report);
        }
        if hole.out == Out::Open {
            self.say_once("CYCLE/BORE: whether the tool goes back at the feed or in rapid", report);
        }
    }

    /// Steps to the bottom.
    fn pecks(&mut self, hole: &Hole, at: &At, report: &mut Report<'_>) {
        let (first, step, deep) = match hole.pecks {
            Pecks::Deep(first, step) => (first, step, true),
            Pecks::Chip(first, step) => (first, step, false),
            Pecks::None => return,
        };
        let control = &self.core.setup.control;
        let near = if deep {
            control.peck_clearance_mm
        } else {
            control.chip_break_retract_mm
        };
        // the first step begins at the clearance
        let mut bottom = hole.clear - first;
        for _ in 0..MOST {
            if bottom <= -hole.depth + SAME_LEVEL {
                return self.drill_to(MotionKind::Linear, Some(at.above(-hole.depth)), at, report);
            }
            self.drill_to(MotionKind::Linear, Some(at.above(bottom)), at, report);
            if deep {
                self.drill_to(MotionKind::Rapid, Some(at.above(hole.clear)), at, report);
            }
            self.drill_to(MotionKind::Rapid, near.map(|near| at.above(bottom + near)), at, report);
            if near.is_none() {
                let what = if deep {
                    "CYCLE/DEEP: where the rapid back into the hole ends (declare [control] peck_clearance)"
                } else {
                    "CYCLE/BRKCHP: how far the tool goes back to break the chip (declare [control] chip_break_retract)"
                };
                self.say_once(what, report);
            }
            bottom -= step;
        }
        self.say_once("CYCLE with more than 10000 steps", report);
        self.drill_to(MotionKind::Unknown, Some(at.above(-hole.depth)), at, report);
    }

    fn say_once(&mut self, what: &str, report: &mut Report<'_>) {
        if !std::mem::replace(&mut self.kept.cycle_said, true) {
            report.fault(TextRange::default(), FaultKind::NotModelled { what: what.to_owned() });
        }
    }

    fn stay(&mut self, stay: Stay, report: &Report<'_>) {
        let seconds = match stay {
            Stay::Seconds(seconds) => Some(seconds),
            Stay::Turns(turns) => {
                let rpm = self.core.state.spindle.rpm().filter(|&rpm| rpm > 0.0);
                rpm.map(|rpm| turns / rpm * 60.0)
            }
        };
        let position = self.core.state.position;
        let orientation = self.core.held_orientation();
        let kind = MotionKind::Dwell(seconds);
        let motion = self
            .core
            .new_motion(kind, position, position, orientation, Feed::Unknown, report);
        self.more.push(motion);
    }

    /// One motion; `None`: along the tool axis to an unknown level.
    fn drill_to(&mut self, kind: MotionKind, target: Option<Vec3>, at: &At, report: &Report<'_>) {
        let start = self.core.state.position;
        let mut end = match target {
            Some(target) => self.at(target),
            None => Position {
                known: start.known & !crate::core::LINEAR,
                ..start
            },
        };
        end.known &= !ROTARY;
        if start.xyz().is_some() && start.xyz() == end.xyz() {
            return;
        }
        self.core.state.position = end;
        let feed = match kind {
            MotionKind::Rapid => Feed::Rapid,
            MotionKind::Unknown => Feed::Unknown,
            _ => at.feed,
        };
        let orientation = self.first_vector.take().unwrap_or_else(|| self.core.held_orientation());
        let motion: Motion = self.core.motion_in_frame(kind, [start, end], orientation, feed, report);
        self.cycle_motions.add();
        self.more.push(motion);
    }
}
