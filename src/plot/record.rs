//! The record of a run for pictures: samples along the real path, block by block.
use crate::scale::counted;
use crate::unit::Unit;
use core::ops::Range;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::Feed;
use trunnion_machine::{AxisKind, BlockPath, Joints, Leg, Machine, block_duration_s, feed_limit, tip_deviation};

/// The machine at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Path length of the tip in the workpiece frame since the first known position, mm.
    pub way: f64,
    /// Time since then, s; not a number after a block whose time is not known.
    pub time: f64,
    /// Joints in chain order, mm or deg.
    pub joints: Joints,
    /// Tip in programmed coordinates, mm.
    pub tip: Vec3,
    /// Unit tool axis in the workpiece frame.
    pub axis: Vec3,
}

/// One block.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Line in the file, from 1.
    pub line: u32,
    /// Rapid; else feed.
    pub rapid: bool,
    /// Its samples in the record, both ends included.
    pub samples: Range<usize>,
    /// It starts where the block before ended.
    pub joined: bool,
    /// Deviation of the tip from the programmed segment, mm: largest sample and proven bound. `None`: not known, or not asked for.
    pub deviation: Option<[f64; 2]>,
    /// Programmed feed of the tip, and the highest at which no axis exceeds its speed, mm/min.
    pub feed: [Option<f64>; 2],
    /// `None` where no plan was added.
    pub planned: Option<PlannedFeed>,
}

/// How a block is planned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedFeed {
    /// Highest feed, mm/min.
    pub most: f64,
    /// Feed at its end, mm/min.
    pub end: f64,
    /// Length of its path, mm.
    pub length: f64,
    /// Duration, s.
    pub seconds: f64,
}

impl PlannedFeed {
    /// Its mean feed, mm/min.
    pub(crate) fn mean(&self) -> f64 {
        60.0 * self.length / self.seconds
    }

    /// Where its highest feed is reached and left, 0..=1 of the path, if it enters at this feed, mm/min, and changes it evenly: with the acceleration
    /// that makes its duration. L/v + ((v - v0)^2 + (v - v1)^2) / (2 a v) = t, from the same trapezoid as docs/kinematics.md#time.
    pub(crate) fn even(&self, entry: f64) -> [f64; 2] {
        let [top, before, after] = [self.most, entry, self.end].map(|feed| feed / 60.0);
        let late = self.seconds - self.length / top;
        let twice = ((top - before).powi(2) + (top - after).powi(2)) / (top * late);
        if !(late > 0.0 && twice > 0.0) {
            return [0.0, 1.0];
        }
        let [up, down] = [before, after].map(|end| (top * top - end * end) / twice / self.length);
        // several accelerations in one block: where the two changes meet
        let (up, down) = if up + down > 1.0 {
            (up / (up + down), down / (up + down))
        } else {
            (up, down)
        };
        [up, 1.0 - down]
    }
}

/// A notable block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Line of the block, from 1.
    pub line: u32,
    /// Why: the name of a rule.
    pub rule: &'static str,
    /// The axes that it is about.
    pub axes: AxisLetters,
}

/// Letters of axes; none: all axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct AxisLetters(u32);

impl AxisLetters {
    /// One letter, `A` to `Z`; of another character all axes.
    pub fn one(letter: char) -> Self {
        let place = u32::from(letter).wrapping_sub(u32::from('A'));
        Self(if place < 26 { 1 << place } else { 0 })
    }

    /// Those of either; all, where one is all.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(if self.0 == 0 || other.0 == 0 {
            0
        } else {
            self.0 | other.0
        })
    }

    /// Whether an axis is meant.
    pub fn hold(self, letter: char) -> bool {
        self.0 == 0 || self.0 & Self::one(letter).0 != 0
    }
}

/// A run.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Samples in the order of the run.
    pub samples: Vec<Sample>,
    /// Blocks in the order of the run.
    pub blocks: Vec<Block>,
    /// Motions that move something and are not drawn: their start or end on the machine is not known.
    pub unknown: usize,
    /// Their lines, in the order of the run, each once; no more than `NAMED_LINES` and one.
    pub unknown_lines: Vec<u32>,
    /// X is a radius: words of X are diameters.
    pub radius: bool,
    /// The first line whose block is drawn by its ends alone, because the record holds as many samples as are kept.
    pub coarse_from: Option<u32>,
    /// In what people read its lengths.
    pub unit: Unit,
}

impl Record {
    /// Samples of a block.
    pub fn of(&self, block: &Block) -> &[Sample] {
        &self.samples[block.samples.clone()]
    }
    /// What is not drawn, and in which lines: `2 motions not drawn: start or end not known (lines 4, 9)`.
    pub fn not_drawn(&self) -> Option<String> {
        let lines: Vec<String> = self
            .unknown_lines
            .iter()
            .take(NAMED_LINES)
            .map(ToString::to_string)
            .collect();
        let plural = if self.unknown_lines.len() == 1 { "" } else { "s" };
        let more = if self.unknown_lines.len() > NAMED_LINES {
            " and more"
        } else {
            ""
        };
        (self.unknown > 0).then(|| {
            format!(
                "{} not drawn: start or end not known (line{plural} {}{more})",
                counted(self.unknown, "motion"),
                lines.join(", ")
            )
        })
    }
    /// The name of an axis: with a note where X is a radius.
    pub(crate) fn axis_name(&self, letter: char) -> String {
        if self.radius && letter == 'X' {
            "X (radius)".to_owned()
        } else {
            letter.to_string()
        }
    }
    /// Travel at a sample, as it is shown.
    pub(crate) fn way(&self, sample: &Sample) -> f64 {
        self.unit.of_mm(sample.way)
    }
    /// Blocks by their lines.
    pub(crate) fn by_line(&self) -> ByLine<'_> {
        let mut order: Vec<(u32, u32)> = (0..).zip(&self.blocks).map(|(at, block)| (block.line, at)).collect();
        order.sort_unstable();
        ByLine { record: self, order }
    }
}

/// Blocks of a record by their lines.
pub(crate) struct ByLine<'r> {
    record: &'r Record,
    /// Line and place of each block, sorted.
    order: Vec<(u32, u32)>,
}

impl<'r> ByLine<'r> {
    /// The blocks of a line in the order of the run.
    pub(crate) fn of(&self, line: u32) -> impl Iterator<Item = &'r Block> {
        let first = self.order.partition_point(|(own, _)| *own < line);
        let own = self.order[first..].iter().take_while(move |(own, _)| *own == line);
        own.map(|(_, at)| &self.record.blocks[*at as usize])
    }
}

/// So many lines of motions that are not drawn are named.
const NAMED_LINES: usize = 3;

/// What is recorded of a block beside its samples: as much work as all the rest.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shows {
    /// Its deviation.
    pub deviation: bool,
    /// The highest feed that the axes allow.
    pub feed: bool,
}

/// Records legs.
pub struct Recorder<'m> {
    machine: &'m Machine,
    shows: Shows,
    record: Record,
    way: f64,
    time: f64,
    broken: bool,
}

/// Most samples of a block.
const MOST: f64 = 240.0;
/// Samples of a whole record, some hundred bytes each. Blocks after them are recorded by their ends.
const MOST_SAMPLES: usize = 400_000;
/// How far the tip may lie off the line between two samples, mm.
const NEAR: f64 = 0.02;
/// How far a rotary axis may turn between two samples, rad.
const TURN: f64 = 0.05;

/// The programmed feed of the tip, mm/min.
fn programmed(leg: &Leg) -> Option<f64> {
    match leg.motion.feed {
        _ if !leg.motion.is_feed() => None,
        Feed::PerMinute(feed) => Some(feed),
        Feed::PerRevolution(feed) => leg.motion.mean_rpm().map(|rpm| feed * rpm),
        Feed::InverseTime(per_minute) => (leg.length > 0.0).then_some(per_minute * leg.length),
        Feed::Unknown | Feed::Rapid => None,
    }
}

impl<'m> Recorder<'m> {
    /// Nothing recorded.
    pub fn new(machine: &'m Machine, shows: Shows) -> Self {
        Self {
            machine,
            shows,
            record: Record::default(),
            way: 0.0,
            time: 0.0,
            broken: true,
        }
    }

    /// Records a leg that ends at a line.
    pub fn leg(&mut self, leg: &Leg, line: u32) {
        if matches!(leg.motion.kind, trunnion_interp::MotionKind::Dwell(_)) {
            self.time += block_duration_s(self.machine, leg).unwrap_or(f64::NAN);
            return;
        }
        self.record.radius |= leg.motion.radii;
        let Some(way) = BlockPath::new(self.machine, leg) else {
            self.record.unknown += 1;
            let lines = &mut self.record.unknown_lines;
            if lines.len() <= NAMED_LINES && !lines.contains(&line) {
                lines.push(line);
            }
            self.broken = true;
            return;
        };
        let turn = leg.rotary_change[0].max(leg.rotary_change[1]);
        let pieces = (way.tip_bend() / (8.0 * NEAR))
            .sqrt()
            .max(turn / TURN)
            .ceil()
            .clamp(1.0, MOST) as usize;
        let pieces = if self.record.samples.len() + pieces < MOST_SAMPLES {
            pieces
        } else {
            self.record.coarse_from.get_or_insert(line);
            1
        };
        let duration = block_duration_s(self.machine, leg).unwrap_or(f64::NAN);
        let first = self.record.samples.len();
        let mut before = None;
        for i in 0..=pieces {
            let t = i as f64 / pieces as f64;
            let moment = way.at(t);
            if let Some(before) = before {
                self.way += (moment.tip - before as Vec3).norm();
            }
            before = Some(moment.tip);
            let mut joints = moment.joints;
            for (value, axis) in joints.iter_mut().zip(&self.machine.axes) {
                if axis.kind == AxisKind::Rotary {
                    *value = deg(*value);
                }
            }
            self.record.samples.push(Sample {
                way: self.way,
                time: self.time + duration * t,
                joints,
                tip: moment.tip,
                axis: moment.axis,
            });
        }
        self.time += duration;
        let limit = self.shows.feed.then(|| feed_limit(self.machine, leg)).flatten();
        let limit = limit.map(|limit| limit.feed_mm_min);
        let deviation = self
            .shows
            .deviation
            .then(|| tip_deviation(self.machine, leg, 1e-4))
            .flatten();
        self.record.blocks.push(Block {
            line,
            rapid: !leg.motion.is_feed(),
            samples: first..self.record.samples.len(),
            joined: !self.broken,
            deviation: deviation.map(|found| [found.sampled_mm, found.bound_mm]),
            feed: [programmed(leg), limit.filter(|limit| limit.is_finite())],
            planned: None,
        });
        self.broken = false;
    }

    /// What was recorded.
    pub fn finish(self) -> Record {
        self.record
    }
}

#[cfg(test)]
mod tests {
    use super::{AxisLetters, Block, Record};

    #[test]
    fn no_letters_are_all_axes() {
        let [x, c] = ['X', 'C'].map(AxisLetters::one);
        assert!(x.hold('X') && !x.hold('C'));
        assert!(x.and(c).hold('X') && x.and(c).hold('C') && !x.and(c).hold('Z'));
        for all in [
            AxisLetters::default(),
            x.and(AxisLetters::default()),
            AxisLetters::one('?'),
        ] {
            assert!(all.hold('X') && all.hold('Z'));
        }
    }

    /// A mark looks up its own blocks: all marks together see no more of them than there are, however many lines are marked.
    #[test]
    fn the_marks_of_a_run_see_each_block_once() {
        let block = |line| Block {
            line,
            rapid: false,
            samples: 0..0,
            joined: true,
            deviation: None,
            feed: [None; 2],
            planned: None,
        };
        let record = Record {
            blocks: (0..6000).map(|at| block(at % 3000)).collect(),
            ..Record::default()
        };
        let lines = record.by_line();
        let seen: Vec<u32> = (0..3001)
            .flat_map(|line| lines.of(line))
            .map(|block| block.line)
            .collect();
        assert_eq!(seen, (0..6000).map(|at| at / 2).collect::<Vec<u32>>());
    }
}
