//! One random part, written in Klartext, Sinumerik, Fanuc and Okuma: the same motions from every control.
//!
//! A part is a tree of lines, arcs in three planes, helices, holes, loops, subprograms, datum shifts and tilted planes. `TRUNNION_PARTS=10000`
//! compares that many.
mod numbers;
mod part;
mod written;

use crate::support::{Log, fault_line, run_bytes};
use part::{Part, Random};
use trunnion_geometry::Vec3;
use trunnion_interp::{ControlData, Feed, Motion, MotionKind, Setup, WorkOffset};
use written::{ALL, Control};

/// mm: positions, centres and feeds (mm/min) that differ by less are the same; words have seven decimals.
const SAME: f64 = 1e-6;

/// What a motion does, in coordinates of the part.
#[derive(Clone, Debug)]
struct Step {
    kind: char,
    start: Option<Vec3>,
    end: Vec3,
    /// Centre and sweep in degrees.
    arc: Option<(Vec3, f64)>,
    feed: f64,
}

impl Step {
    fn of(motion: &Motion) -> Result<Self, String> {
        let zero = Vec3::from_fn(|axis, _| motion.zero[axis]);
        let end = motion.end.xyz().ok_or("an end that is not known")? + zero;
        let (kind, arc) = match motion.kind {
            MotionKind::Rapid => ('R', None),
            MotionKind::Linear => ('L', None),
            MotionKind::Arc(Some(arc)) => ('A', Some((arc.centre + zero, arc.sweep.to_degrees()))),
            MotionKind::Dwell(Some(seconds)) => return Ok(Self::dwell(seconds, end)),
            _ => return Err(format!("a motion that is not known: {motion:?}")),
        };
        let feed = match (motion.feed, motion.spindle_rpm) {
            (Feed::PerMinute(feed), _) => feed,
            (Feed::PerRevolution(feed), Some(rpm)) => feed * rpm,
            _ => 0.0,
        };
        Ok(Self {
            kind,
            start: motion.start.xyz().map(|start| start + zero),
            end,
            arc,
            feed: if kind == 'R' { 0.0 } else { feed },
        })
    }
    fn dwell(seconds: f64, end: Vec3) -> Self {
        Self {
            kind: 'D',
            start: Some(end),
            end,
            arc: None,
            feed: seconds,
        }
    }
    fn is_same(&self, other: &Self) -> bool {
        let arcs = match (&self.arc, &other.arc) {
            (None, None) => true,
            (Some(one), Some(two)) => (one.0 - two.0).norm() < SAME && (one.1 - two.1).abs() < 1e-5,
            _ => false,
        };
        self.kind == other.kind && (self.end - other.end).norm() < SAME && (self.feed - other.feed).abs() < SAME && arcs
    }
    /// Whether it only goes on straight ahead.
    fn continues(&self, before: &Self) -> bool {
        let straight = matches!(self.kind, 'R' | 'L') && self.kind == before.kind && self.feed == before.feed;
        let (Some(from), Some(middle)) = (before.start, self.start) else {
            return false;
        };
        let (one, two) = (middle - from, self.end - middle);
        straight && one.cross(&two).norm() <= SAME * (one.norm() + two.norm()) && one.dot(&two) > 0.0
    }
}

/// The steps of a program, without those that move nothing, straight ones put together.
fn steps(control: Control, text: &str) -> Result<Vec<Step>, String> {
    let (program, log): (_, Log) = run_bytes(control.dialect(), text.as_bytes(), &setup());
    let told: Vec<String> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    if !told.is_empty() {
        return Err(told.join("\n"));
    }
    let mut steps: Vec<Step> = Vec::new();
    for motion in &log.motions {
        let step = Step::of(motion)?;
        let still = step.arc.is_none() && step.kind != 'D';
        if still && step.start.is_some_and(|start| (start - step.end).norm() < SAME) {
            continue;
        }
        match steps.last_mut() {
            Some(last) if step.continues(last) => last.end = step.end,
            _ => steps.push(step),
        }
    }
    Ok(steps)
}

fn setup() -> Setup {
    let mut setup = Setup {
        control: ControlData {
            peck_clearance_mm: Some(part::PECK_CLEARANCE),
            ..ControlData::default()
        },
        ..Setup::default()
    };
    // an Okuma shifts by a work system, and so do the others under a tilted plane
    for (index, values) in part::SHIFTS.iter().enumerate() {
        let mut all = [0.0; 9];
        all[..3].copy_from_slice(values);
        for name in [format!("G15 H{}", index + 1), format!("G{}", 54 + index)] {
            setup.work_offsets.push(WorkOffset { name, values: all });
        }
    }
    setup.tools.push(trunnion_interp::Tool {
        number: 1,
        shape: None,
        diameter_mm: Some(8.0),
        length_mm: Some(0.0),
        holder_mm: None,
    });
    setup
}

fn compare(seed: u64) -> usize {
    let mut random = Random::new(seed);
    let part = Part::random(&mut random, seed.is_multiple_of(3));
    let controls: Vec<Control> = ALL
        .into_iter()
        .filter(|control| *control != Control::Okuma || !part.tilts())
        .collect();
    let written: Vec<(Control, String)> = controls
        .iter()
        .map(|control| (*control, control.write(&part)))
        .collect();
    let run = |(control, text): &(Control, String)| {
        steps(*control, text).unwrap_or_else(|why| panic!("part {seed}, {control:?}: {why}\n{text}"))
    };
    let first = run(&written[0]);
    assert!(!first.is_empty(), "part {seed} moves nothing");
    for other in &written[1..] {
        let found = run(other);
        let same = first
            .iter()
            .zip(&found)
            .take_while(|(one, two)| one.is_same(two))
            .count();
        assert!(
            same == first.len() && same == found.len(),
            "part {seed}: step {same} of {} and {}:\n{:?}: {:#?}\n{:?}: {:#?}\n{}\n{}",
            first.len(),
            found.len(),
            written[0].0,
            first.get(same),
            other.0,
            found.get(same),
            written[0].1,
            other.1
        );
    }
    first.len()
}

#[test]
fn a_random_part_is_the_same_on_every_control() {
    let count: u64 = std::env::var("TRUNNION_PARTS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(200);
    let steps: usize = (1..=count).map(compare).sum();
    eprintln!("{count} parts, {steps} steps");
    assert!(steps as u64 > 10 * count);
}
