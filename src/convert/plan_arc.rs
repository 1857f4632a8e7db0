//! Part of a motion's plan: its feed, and whether it stays an arc.
use crate::Refused;
use crate::plan::{Mode, Move, Planner, Shape};
use crate::sample::{Frame, PartEnd, joints, words};
use trunnion_certify::conversion::{Posed, Track, carried};
use trunnion_geometry::{arc::Arc, deg};
use trunnion_interp::Feed;

impl Planner<'_> {
    /// The feed as it is programmed, where it means the same in the output.
    pub(crate) fn plain_feed(&self, posed: &Posed) -> Result<Feed, Refused> {
        match posed.motion.feed {
            Feed::Unknown => {
                let message = "the feed of this cut is unknown: program one, or add --feed for an excerpt";
                Err(self.refuse(posed, message.to_owned()))
            }
            Feed::InverseTime(_) if !self.inverse_time => {
                let message = "the feed of this cut is inverse time (G93), which the target control does not have, and there is no path of known length to compute a feed per minute from";
                Err(self.refuse(posed, message.to_owned()))
            }
            Feed::PerRevolution(per_turn) if !self.per_revolution => match posed.motion.spindle_rpm {
                Some(rpm) => Ok(Feed::PerMinute(per_turn * rpm)),
                None => Err(self.refuse(
                    posed,
                    "a feed per revolution, and the spindle speed is unknown".to_owned(),
                )),
            },
            feed => Ok(feed),
        }
    }

    /// The feed of one of `count` equal parts by the time that the motion takes: inverse time, or mm/min where the control has none.
    pub(crate) fn timed(&self, posed: &Posed, way: f64, count: usize, end: &PartEnd) -> Result<Feed, Refused> {
        let turned = || {
            // a turn on the spot: F is in degrees (RS274/NGC)
            let before = posed.start?.axis;
            let angle = deg(trunnion_geometry::math::angle_between(&before, &end.axis));
            match posed.motion.feed {
                Feed::PerMinute(feed) if angle > 0.0 => Some(angle / feed * 60.0),
                _ => None,
            }
        };
        let seconds = posed.duration_s().or_else(turned).filter(|seconds| *seconds > 0.0);
        let Some(seconds) = seconds else {
            return Err(self.refuse(posed, "the duration of this cut is unknown".to_owned()));
        };
        let part = seconds / count as f64;
        let keeps_minutes = matches!(self.mode, Mode::Tip | Mode::TipRotary(_))
            && !matches!(posed.motion.feed, Feed::InverseTime(_))
            && way > 0.0;
        if self.inverse_time && !keeps_minutes {
            return Ok(Feed::InverseTime(60.0 / part));
        }
        if way > 0.0 && matches!(self.mode, Mode::Tip | Mode::TipRotary(_)) {
            return Ok(Feed::PerMinute(way / part * 60.0));
        }
        let message = "the target control has no inverse time feed, which this cut needs";
        Err(self.refuse(posed, message.to_owned()))
    }

    /// The motion as arcs of the output, where it is one there: about a principal axis, with equal radii, the tool axis still.
    pub(crate) fn arcs(
        &self,
        track: &Track<'_>,
        q: ([f64; 2], [f64; 2]),
        frame: &Frame,
        posed: &Posed,
    ) -> Option<Vec<Move>> {
        let arc = track.tip_arc().filter(|_| !self.options.lines_only)?;
        let still = (track.at(0.0).axis - track.at(1.0).axis).norm() < 1e-9
            && (0..=8).all(|i| (track.at(f64::from(i) / 8.0).axis - track.at(1.0).axis).norm() < 1e-9);
        if !still || (self.mode.machine().is_some() && q.0 != q.1) {
            return None;
        }
        let arc = match self.mode {
            Mode::Joints(machine) => carried(&arc, |tip| words(machine, &joints(machine, q.1, tip, frame)?, frame))?,
            Mode::Tip | Mode::TipRotary(_) => arc,
        };
        let flat = arc.height().abs() < 1e-6;
        let principal = (0..3).any(|axis| arc.normal[axis].abs() > 1.0 - 1e-12);
        let slope = (arc.radius_start - arc.radius_end).abs();
        let limit = 0.5
            * self
                .dialect
                .arc_limit_mm(arc.radius_start, self.options.units == crate::Units::Inch);
        if slope > limit || if self.apt { !flat } else { !principal } {
            return None;
        }
        let feed = self.plain_feed(posed).ok()?;
        let count = (arc.sweep.abs() / core::f64::consts::TAU - 1e-9).ceil().max(1.0) as usize;
        let feed = match feed {
            Feed::InverseTime(per_minute) => Feed::InverseTime(per_minute * count as f64),
            feed => feed,
        };
        let part = |index: usize| {
            let share = |index: usize| index as f64 / count as f64;
            let (start, end) = (arc.point_at(share(index)), arc.point_at(share(index + 1)));
            let centre = arc.centre + arc.normal * arc.normal.dot(&(start - arc.centre));
            Move {
                shape: Shape::Arc(Arc {
                    start,
                    end,
                    centre,
                    sweep: arc.sweep / count as f64,
                    ..arc
                }),
                xyz: end,
                q: q.1,
                axis: track.at(1.0).axis,
                feed,
            }
        };
        Some((0..count).map(part).collect())
    }
}
