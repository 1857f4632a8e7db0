//! The planner: legs in, times out, in order.
mod emit;

use crate::corner::{Passage, Round, passage};
use crate::pieces::{Course, Taken, take};
use crate::{Bounds, Limit, PathControl, Piece, Run, Timed, s_curve};
use trunnion_dialect::RotaryFeed;
use trunnion_interp::{ChainId, Feed, MotionKind};
use trunnion_machine::{Leg, Machine, RapidPath, feed_is_ambiguous};
use trunnion_syntax::BlockId;

/// Plans a run of a program, leg by leg. Memory: what lies between two stops, and of long runs what is not settled yet.
pub struct Planner<'m> {
    machine: &'m Machine,
    rotary_feed: RotaryFeed,
    run: Run,
    /// Motions since the last stop, in order.
    open: Vec<Open>,
    /// The last motion with a path since the last stop.
    last: Option<Box<Course>>,
    motions: u32,
    /// So many motions since the last stop are worth a look at what is settled.
    enough: usize,
    /// The least of these.
    chunk: usize,
    /// For tests: every run with its plan.
    #[cfg(test)]
    pub(crate) seen: Vec<(Run, crate::Planned)>,
}

/// A motion whose pieces are not planned yet.
struct Open {
    timed: Timed,
    /// Its pieces.
    count: usize,
    /// Every axis that moves declares its acceleration.
    complete: bool,
    /// How long it runs at once with its neighbours, its own half, s.
    overlap: f64,
}

impl Open {
    fn still(timed: Timed) -> Self {
        Self {
            timed: Timed {
                seconds: [Some(0.0); 2],
                ..timed
            },
            count: 0,
            complete: true,
            overlap: 0.0,
        }
    }
}

/// Motions between two looks at what is settled.
const CHUNK: usize = 4096;

impl<'m> Planner<'m> {
    /// For a machine; `rotary_feed`: what F means on this control where rotary axes move.
    pub fn new(machine: &'m Machine, rotary_feed: RotaryFeed) -> Self {
        let planning = &machine.control.planning;
        Self {
            machine,
            rotary_feed,
            run: Run {
                pieces: Vec::new(),
                lookahead: planning.lookahead,
                filter: planning.filter_time.unwrap_or(0.0),
                long: emit::long(machine, CHUNK),
                begun: None,
            },
            open: Vec::new(),
            last: None,
            motions: 0,
            enough: CHUNK,
            chunk: CHUNK,
            #[cfg(test)]
            seen: Vec::new(),
        }
    }

    /// For tests: looks at what is settled after so many motions; a section of `long` motions is a long one.
    #[cfg(test)]
    pub(crate) fn plan_in_chunks(&mut self, chunk: usize, long: usize) {
        (self.chunk, self.enough) = (chunk, chunk);
        self.run.long = emit::long(self.machine, long);
    }

    /// The next leg, and what the program says about the corner at its start. Times of earlier legs may come out.
    pub fn leg(&mut self, leg: &Leg, control: PathControl, out: &mut impl FnMut(Timed)) {
        let timed = self.open(leg);
        if matches!(leg.motion.kind, MotionKind::Dwell(_)) {
            self.end(control);
        }
        match leg.motion.kind {
            MotionKind::Dwell(seconds) => {
                return self.emit_alone(
                    Timed {
                        limit: Limit::Wait,
                        ..timed
                    },
                    [seconds; 2],
                    out,
                );
            }
            _ if leg.start.is_none() && leg.end.is_ok() && !matches!(leg.motion.kind, MotionKind::Unknown) => {
                return self.emit_alone(
                    Timed {
                        from_nowhere: true,
                        ..timed
                    },
                    [Some(0.0); 2],
                    out,
                );
            }
            _ if feed_is_ambiguous(self.machine, self.rotary_feed, leg) => {
                return self.emit_alone(timed, [None; 2], out);
            }
            _ => {}
        }
        if leg.motion.feed == Feed::Rapid && self.machine.control.rapid != RapidPath::Synchronous {
            let mut time = self.dogleg(leg);
            if self.machine.control.rapid == RapidPath::Undeclared {
                // it may be the slower one, in which all axes arrive together
                time.0[1] = time.0[1].and_then(|own| Some(own.max(self.together(leg, timed.motion)?)));
            }
            return self.emit_alone(
                time.1.map_or(timed, |reached| Timed {
                    reached: Some(reached),
                    ..timed
                }),
                time.0,
                out,
            );
        }
        let first = self.run.pieces.len();
        let mut course = match take(self.machine, leg, timed.motion, &mut self.run.pieces) {
            Taken::Course(course) => course,
            Taken::Still => {
                self.open.push(Open::still(timed));
                return;
            }
            Taken::Unknown => return self.emit_alone(timed, [None; 2], out),
        };
        let passage = self.passage(&course, control);
        self.lose(&mut course, &passage, first);
        if passage.speed == [0.0; 2] {
            self.complete(first, passage.overlap, out);
        } else if let Some(round) = passage.round {
            self.round(&mut course, &round, first);
        } else if let Some(piece) = self.run.pieces.get_mut(first) {
            piece.entry = passage.speed;
        }
        let minute = |speed: f64| speed.is_finite().then_some(speed * 60.0);
        let timed = Timed {
            length: course.length,
            turns_only: course.turns_only,
            feed: minute(course.feed),
            block_time_feed: course.block_time.and_then(minute),
            bend_feed: course.bend.map(|(speed, joint)| (speed * 60.0, joint)),
            ..timed
        };
        self.open.push(Open {
            timed,
            count: course.count,
            complete: course.complete,
            overlap: 0.5 * passage.overlap,
        });
        self.last = Some(course);
        self.settle(out);
    }

    /// A stop: what came before the pieces from `first` on is complete.
    fn complete(&mut self, first: usize, overlap: f64, out: &mut impl FnMut(Timed)) {
        let own = self.run.pieces.split_off(first);
        if let Some(open) = self.open.last_mut() {
            open.overlap += 0.5 * overlap;
        }
        self.flush(out);
        self.run.pieces = own;
    }

    /// The machine stands still for a time: a tool change, an M code. Counts as a motion of its own.
    pub fn wait(&mut self, block: BlockId, seconds: Option<f64>, out: &mut impl FnMut(Timed)) {
        let timed = Timed {
            limit: Limit::Wait,
            ..Timed::at(block, ChainId::MAIN, self.motions)
        };
        self.emit_alone(timed, [seconds; 2], out);
    }

    /// The end: the machine stops.
    pub fn finish(&mut self, out: &mut impl FnMut(Timed)) {
        self.flush(out);
    }

    /// A motion of which nothing is known yet.
    fn open(&mut self, leg: &Leg) -> Timed {
        let motion = &leg.motion;
        let timed = Timed {
            engaged: motion.is_feed() && motion.spindle_on == Some(true),
            ..Timed::at(motion.block, motion.chain, self.motions)
        };
        self.motions += 1;
        timed
    }

    /// How the corner at the start of a course is passed.
    fn passage(&self, course: &Course, control: PathControl) -> Passage {
        let Some(last) = self.last.as_ref().filter(|last| last.turns_only == course.turns_only) else {
            return Passage::STOP;
        };
        passage(self.machine, control, [&last.side(1), &course.side(0)])
    }

    /// Nothing follows the last leg but a stop; what the program says about its end.
    pub fn end(&mut self, control: PathControl) {
        let passage = crate::linuxcnc::end(self.machine, control);
        if let Some(last) = &mut self.last {
            let from = self.run.pieces.len().saturating_sub(last.count);
            last.lose(&passage, &mut self.run.pieces[from..]);
        }
    }

    /// Takes what the corner takes of the acceleration of both legs.
    fn lose(&mut self, course: &mut Course, passage: &Passage, first: usize) {
        let (before, own) = self.run.pieces.split_at_mut(first);
        if let Some(last) = &mut self.last {
            let from = before.len().saturating_sub(last.count);
            last.lose(passage, &mut before[from..]);
        }
        course.lose(passage, own);
    }

    /// Lays an arc in place of the corner at the start of a course: a piece of its own.
    fn round(&mut self, course: &mut Course, round: &Round, first: usize) {
        let Some([before, after]) = first
            .checked_sub(1)
            .and_then(|last| self.run.pieces.get_mut(last..=first))
            .and_then(|pieces| <&mut [Piece; 2]>::try_from(pieces).ok())
        else {
            return;
        };
        // legs of several pieces bend anyway: the arc stays within those at the corner
        let depth = round.depth.min(0.9 * before.length).min(0.9 * after.length);
        before.length -= depth;
        after.length -= depth;
        let arc = Piece {
            length: round.length * depth / round.depth,
            optimistic: Bounds {
                cap: round.free,
                by: Limit::Corner,
                acceleration: round.acceleration,
            },
            planned: Bounds {
                cap: round.cap * (depth / round.depth).sqrt(),
                by: Limit::Corner,
                acceleration: round.along,
            },
            bends: true,
            ..*after
        };
        self.run.pieces.insert(first, arc);
        course.count += 1;
    }

    /// A rapid in which each axis runs at its own speed, from stop to stop: optimistic and planned time, s, and the speed of the tip, mm/min.
    fn dogleg(&self, leg: &Leg) -> ([Option<f64>; 2], Option<f64>) {
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            return ([None; 2], None);
        };
        let (mut optimistic, mut planned, mut known) = (0.0_f64, 0.0_f64, true);
        for (joint, axis) in self.machine.axes.iter().enumerate() {
            let way = (end.joints[joint] - start.joints[joint]).abs();
            if way < 1e-12 {
                continue;
            }
            let Some(speed) = axis.max_speed else {
                return ([None; 2], None);
            };
            let acceleration = axis.max_acceleration.unwrap_or(f64::INFINITY);
            known &= axis.max_acceleration.is_some();
            optimistic = optimistic.max(s_curve(way, speed, acceleration, f64::INFINITY).0);
            planned = planned.max(s_curve(way, speed, acceleration, axis.extra.max_jerk.unwrap_or(f64::INFINITY)).0);
        }
        let planned = if planned > 0.0 { planned + self.run.filter } else { 0.0 };
        let reached = (optimistic > 0.0).then(|| leg.length / optimistic * 60.0);
        ([Some(optimistic), known.then_some(planned)], reached)
    }

    /// A rapid in which all axes arrive together, from stop to stop: planned time, s.
    fn together(&self, leg: &Leg, motion: u32) -> Option<f64> {
        let mut run = Run {
            pieces: Vec::new(),
            begun: None,
            ..self.run
        };
        match take(self.machine, leg, motion, &mut run.pieces) {
            Taken::Course(course) if course.complete => {
                Some(run.plan().seconds.iter().map(|[planned, _]| planned).sum())
            }
            Taken::Still => Some(0.0),
            _ => None,
        }
    }

    /// A motion from stop to stop.
    fn emit_alone(&mut self, timed: Timed, seconds: [Option<f64>; 2], out: &mut impl FnMut(Timed)) {
        self.flush(out);
        let stop = Some(0.0);
        out(Timed {
            seconds,
            lowest: stop,
            leaves: stop,
            ..timed
        });
    }
}

impl Timed {
    /// A motion of which nothing is known yet.
    pub fn at(block: BlockId, chain: ChainId, motion: u32) -> Self {
        Self {
            block,
            chain,
            motion,
            seconds: [None; 2],
            from_nowhere: false,
            length: 0.0,
            turns_only: false,
            feed: None,
            reached: None,
            lowest: None,
            leaves: None,
            limit: Limit::Stop,
            below: 0.0,
            crawl: crate::timed::Crawl::default(),
            block_time_feed: None,
            bend_feed: None,
            engaged: false,
        }
    }
}
