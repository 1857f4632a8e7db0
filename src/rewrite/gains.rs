//! What a change gains: figures of a program before and after, of the whole and of each place.
use crate::edited::Edited;
use trunnion_check::Settings;
use trunnion_geometry::deg;
use trunnion_interp::{Fault, ModalState, Motion, MotionKind, Sink, run};
use trunnion_machine::{Follower, Leg, Machine, block_duration_s, feed_limit_tight, tip_deviation};
use trunnion_syntax::{BlockId, Program, TextEdit, TextRange};

/// Shortest path over which a slope is formed, mm.
const SHORTEST_MM: f64 = 1e-3;

/// Deviations up to this need no tighter bound, mm.
const TIGHT_MM: f64 = 5e-5;

/// A figure before and after; none where it is unknown or has no meaning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gain {
    /// Before.
    pub before: Option<f64>,
    /// After.
    pub after: Option<f64>,
}

/// Figures of a stretch of a program, before and after. Lengths mm, angles deg, feeds mm/min, times s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gains {
    /// The figures with their names, in the order of the contract.
    pub figures: [(&'static str, Gain); 9],
}

impl Gains {
    /// A figure by name: `deviation_mm`, `rotary_travel_deg`, `largest_step_deg`, `largest_slope_deg_mm`, `feed_limit_mm_min`,
    /// `time_s`, `length_mm`, `blocks`, `bytes`.
    pub fn get(&self, name: &str) -> Option<Gain> {
        self.figures
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, gain)| *gain)
    }
}

/// Figures of one stretch of one program.
#[derive(Clone, Copy, Debug)]
struct Figures {
    deviation_mm: f64,
    rotary_travel_deg: f64,
    largest_step_deg: f64,
    largest_slope_deg_mm: f64,
    feed_limit_mm_min: f64,
    /// None once a time is unknown.
    time_s: Option<f64>,
    length_mm: f64,
    /// A motion whose path is unknown: then nothing but blocks and bytes is known.
    unknown: bool,
}

impl Figures {
    const NONE: Self = Self {
        deviation_mm: 0.0,
        rotary_travel_deg: 0.0,
        largest_step_deg: 0.0,
        largest_slope_deg_mm: 0.0,
        feed_limit_mm_min: f64::INFINITY,
        time_s: Some(0.0),
        length_mm: 0.0,
        unknown: false,
    };

    fn add(&mut self, machine: &Machine, leg: &Leg) {
        if leg.start.is_none() && leg.end.is_ok() {
            return; // the first known position: where it comes from is the same unknown in both programs
        }
        let rests = matches!(leg.motion.kind, MotionKind::Dwell(_));
        self.unknown |= leg.end.is_err() && !rests;
        let time = match leg.motion.kind {
            MotionKind::Dwell(seconds) => seconds,
            _ => block_duration_s(machine, leg),
        };
        self.time_s = self.time_s.zip(time).map(|(sum, time)| sum + time);
        self.length_mm += leg.length;
        let steps = leg.rotary_change.map(deg);
        let step = steps[0].max(steps[1]);
        self.rotary_travel_deg += steps[0] + steps[1];
        self.largest_step_deg = self.largest_step_deg.max(step);
        if !leg.motion.is_feed() {
            return;
        }
        if step > 0.0 {
            self.largest_slope_deg_mm = self.largest_slope_deg_mm.max(step / leg.length.max(SHORTEST_MM));
        }
        if let Some(deviation) = tip_deviation(machine, leg, TIGHT_MM) {
            self.deviation_mm = self.deviation_mm.max(deviation.bound_mm);
        }
        if let Some(limit) = feed_limit_tight(machine, leg) {
            self.feed_limit_mm_min = self.feed_limit_mm_min.min(limit.feed_mm_min);
        }
    }

    fn list(&self, range: TextRange, blocks: u32) -> [Option<f64>; 9] {
        let known = |value: f64| (!self.unknown && value.is_finite()).then_some(value);
        [
            known(self.deviation_mm),
            known(self.rotary_travel_deg),
            known(self.largest_step_deg),
            known(self.largest_slope_deg_mm),
            known(self.feed_limit_mm_min),
            self.time_s.filter(|_| !self.unknown),
            known(self.length_mm),
            Some(f64::from(blocks)),
            Some(range.as_usize().len() as f64),
        ]
    }
}

const NAMES: [&str; 9] = [
    "deviation_mm",
    "rotary_travel_deg",
    "largest_step_deg",
    "largest_slope_deg_mm",
    "feed_limit_mm_min",
    "time_s",
    "length_mm",
    "blocks",
    "bytes",
];

/// Adds up the motions of a program, of the whole and of each place.
struct Tally<'m> {
    program: &'m Program,
    machine: &'m Machine,
    follower: Follower<'m>,
    places: &'m [TextRange],
    /// The place that the last motion was in, or the next one.
    at: usize,
    whole: Figures,
    of_places: Vec<Figures>,
}

impl Sink for Tally<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.follower.follow(motion);
        self.whole.add(self.machine, &leg);
        let start = self.program.block(motion.block).range().start;
        while self.places.get(self.at).is_some_and(|place| place.end <= start) {
            self.at += 1;
        }
        if self.places.get(self.at).is_some_and(|place| place.start <= start) {
            self.of_places[self.at].add(self.machine, &leg);
        }
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

/// Figures of the whole program, then of each of its places.
fn figures(
    program: &Program,
    settings: &Settings<'_>,
    machine: &Machine,
    places: &[TextRange],
) -> Vec<[Option<f64>; 9]> {
    let mut tally = Tally {
        program,
        machine,
        follower: Follower::new(machine),
        places,
        at: 0,
        whole: Figures::NONE,
        of_places: vec![Figures::NONE; places.len()],
    };
    run(program, settings.dialect, &settings.setup, &mut tally);
    let blocks = |range: TextRange| {
        let last = range.end.checked_sub(1).filter(|&last| range.start <= last);
        let ids = program
            .block_at(range.start)
            .zip(last.and_then(|last| program.block_at(last)));
        ids.map_or(0, |(first, last)| last.0 - first.0 + 1)
    };
    let text = TextRange::new(0, program.source().len() as u32);
    let whole = tally.whole.list(text, blocks(text));
    let of_places = tally.of_places.iter().zip(places);
    core::iter::once(whole)
        .chain(of_places.map(|(figures, &range)| figures.list(range, blocks(range))))
        .collect()
}

/// What the edits gain: in the whole program, and at each of its places (first and last block), which do not overlap and lie in the order of the
/// program. Both programs must run each block once and in the order of the text.
pub fn gains(
    [before, after]: [&Program; 2],
    edits: &[TextEdit],
    settings: &Settings<'_>,
    machine: &Machine,
    places: &[(BlockId, BlockId)],
) -> (Gains, Vec<Gains>) {
    let was: Vec<TextRange> = places
        .iter()
        .map(|&(first, last)| TextRange::new(before.block(first).range().start, before.block(last).range().end))
        .collect();
    let map = Edited::new(edits);
    let is: Vec<TextRange> = was.iter().map(|&range| map.after(range)).collect();
    let pairs = figures(before, settings, machine, &was)
        .into_iter()
        .zip(figures(after, settings, machine, &is));
    let mut all = pairs.map(|(was, is)| {
        let gain = |index: usize| {
            (
                NAMES[index],
                Gain {
                    before: was[index],
                    after: is[index],
                },
            )
        };
        Gains {
            figures: core::array::from_fn(gain),
        }
    });
    let whole = all.next().unwrap_or_default();
    (whole, all.collect())
}
