//! Turning cycles of one pass (G90, G94 and G92 of system A): in, cut, out, back to the start.
//!
//! A thread may be left before its end: parameter 5130 says how many leads before (Fanuc Series 30i operator's manual, lathe system, threading
//! cycle), and the sources show only in pictures how the tool retracts there.
use super::Stored;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, MotionKind, Position};
use trunnion_dialect::Action;
use trunnion_syntax::TextRange;

const X: usize = 0;
const Z: usize = 2;

impl Iso<'_> {
    /// Runs the current pass with the changes of the block. X is a radius here; R is the difference of radii (or of Z when facing).
    pub(crate) fn pass_cycle(&mut self, words: &Words, report: &mut Report<'_>) {
        let position = self.core.state.position;
        let start = self.memory.frames.programmed(&position);
        self.keep_pass(words);
        let [x, z, taper] = self.memory.cycle.pass;
        let taper = if taper == Stored::Nothing {
            Some(0.0)
        } else {
            taper.from(Some(0.0))
        };
        let ends = (
            x.from(start.get(X)),
            z.from(start.get(Z)),
            taper,
            start.get(X),
            start.get(Z),
        );
        let (Some(x), Some(z), Some(taper), Some(x_start), Some(z_start)) = ends else {
            let why = if words.centre.any() {
                "with I, J or K: whether they are its taper (write it with R)"
            } else {
                "from or to an unknown position"
            };
            let what = format!("{} {why}", self.memory.cycle.id);
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            let mut motion = self.unknown_motion(words, report);
            motion.end.known &= !crate::core::LINEAR;
            self.core.forget_linear();
            self.memory.out.push(motion);
            return;
        };
        let threading = self.core.state.motion == Some(Action::ThreadingCycle);
        let feed = if threading {
            self.lead(words, report)
        } else {
            self.feed_of(MotionKind::Linear, words, report)
        };
        let (before, after) = if self.core.state.motion == Some(Action::FacingCycle) {
            ((x_start, z + taper), (x, z_start))
        } else {
            ((x + taper, z_start), (x_start, z))
        };
        // a thread is left in rapid
        let out = if threading {
            MotionKind::Rapid
        } else {
            MotionKind::Linear
        };
        let mut corners = vec![
            (before, MotionKind::Rapid),
            ((x, z), MotionKind::Linear),
            (after, out),
            ((x_start, z_start), MotionKind::Rapid),
        ];
        if threading {
            self.pull_out(&mut corners, feed, report);
        }
        for (to, kind) in corners {
            let position = self.core.state.position;
            let before = self.memory.frames.programmed(&position);
            let mut place = before;
            place.set(X, to.0);
            place.set(Z, to.1);
            let feed = match kind {
                MotionKind::Rapid => Feed::Rapid,
                MotionKind::Unknown => Feed::Unknown,
                _ if threading => self.along_thread(feed, [&before, &place]),
                _ => feed,
            };
            self.goes(kind, place, feed, report);
        }
    }

    /// The changes of the block to the current pass.
    fn keep_pass(&mut self, words: &Words) {
        for (slot, axis) in [(0, X), (1, Z)] {
            let bit = 1 << axis;
            if words.axes.unread & bit != 0 {
                self.memory.cycle.pass[slot] = Stored::Unknown;
            } else if let Some(value) = self.axis_value(words, axis) {
                let incremental = words.axes.incremental & bit != 0
                    || (self.core.state.coordinates.incremental() && words.axes.absolute & bit == 0);
                self.memory.cycle.pass[slot] = if incremental {
                    Stored::By(value)
                } else {
                    Stored::At(value)
                };
            }
        }
        if words.radius.is_given() {
            let taper = words
                .radius
                .number()
                .map(|number| number.value * self.core.state.coordinates.unit_mm());
            self.memory.cycle.pass[2] = taper.map_or(Stored::Unknown, Stored::By);
        }
        // a Haas lathe takes I and K for tapers, and so did older controls of Fanuc; no source at hand says more
        if words.centre.any() {
            self.memory.cycle.pass[2] = Stored::Unknown;
        }
    }

    /// What happens to the corners of a thread that is left before its end. If that is not declared, they stay, and that is reported.
    fn pull_out(&self, corners: &mut Vec<((f64, f64), MotionKind)>, lead: Feed, report: &mut Report<'_>) {
        if self.memory.thread_chamfer_off {
            return;
        }
        let (Some(leads), Feed::PerRevolution(lead)) = (self.core.setup.control.thread_pull_out, lead) else {
            let why =
                "whether the tool pulls out before the end of the thread (declare [control] thread_pull_out, in leads)";
            return self.report_not_modelled(why, report);
        };
        let [((x0, z0), _), ((x, z), _), _, (start, _)] = corners[..] else {
            return;
        };
        if leads == 0.0 {
            return;
        }
        let share = (leads * lead / (z - z0).abs()).min(1.0);
        *corners = vec![
            corners[0],
            ((x + (x0 - x) * share, z + (z0 - z) * share), MotionKind::Linear),
            (start, MotionKind::Unknown),
        ];
        self.report_not_modelled(
            "the shape of its pull-out (parameter 5131), and the return after it",
            report,
        );
    }

    /// The feed of a motion, which a thread takes from its lead.
    pub(crate) fn feed_along(
        &mut self,
        kind: MotionKind,
        words: &Words,
        ends: [&Position; 2],
        report: &mut Report<'_>,
    ) -> Feed {
        match self.core.state.motion {
            Some(Action::Thread) => {
                let lead = self.lead(words, report);
                self.along_thread(lead, ends)
            }
            Some(Action::VariableThread) => {
                // the lead changes along the path
                let what = "a thread of variable lead: its feed".to_owned();
                report.fault(TextRange::default(), FaultKind::NotModelled { what });
                self.feed_of(kind, words, report);
                Feed::Unknown
            }
            _ => {
                let feed = self.feed_of(kind, words, report);
                self.turning_feed(kind, feed, words, ends)
            }
        }
    }

    /// The feed along the path of a thread of a lathe, whose lead counts along the axis that goes farther (Haas lathe operator's manual, G32: the
    /// larger of the two leads is F).
    pub(super) fn along_thread(&self, lead: Feed, [start, end]: [&Position; 2]) -> Feed {
        let goes = |axis: usize| Some((end.get(axis)? - start.get(axis)?).abs());
        if !self.core.dialect.quirks.diameter {
            return lead;
        }
        match (lead, goes(X), goes(Z)) {
            (_, Some(0.0), _) | (_, _, Some(0.0)) => lead,
            (Feed::PerRevolution(lead), Some(x), Some(z)) => {
                Feed::PerRevolution(lead * (x * x + z * z).sqrt() / x.max(z))
            }
            (Feed::PerRevolution(_), ..) => Feed::Unknown,
            (feed, ..) => feed,
        }
    }

    /// The lead of a thread: F of the block or the one before, mm per turn.
    pub(crate) fn lead(&mut self, words: &Words, report: &mut Report<'_>) -> Feed {
        match self.feed_of(MotionKind::Linear, words, report) {
            Feed::PerMinute(lead) | Feed::PerRevolution(lead) => Feed::PerRevolution(lead),
            feed => feed,
        }
    }
}
