//! The error of the trajectory surface: how far the real path deviates from the required surface, in three senses.
use crate::mesh::{Required, Uv};
use crate::search::{Climb, SAMPLES, Top, top};
use crate::sheet::Sheet;
use core::cell::Cell;
use trunnion_geometry::Vec3;
use trunnion_machine::{BlockPath, Leg, Machine, tip_deviation};
use trunnion_syntax::BlockId;

/// How to compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The tip should keep this distance from the surface, mm: the radius of a tool that cuts with its flank, or of a ball whose centre is
    /// programmed. 0: it runs on the surface.
    pub offset: f64,
    /// A feed block that starts or ends farther than this from the surface (less the offset) is taken as approach or retract and counted, mm.
    pub reach: f64,
    /// How near sample and bound of the largest error are brought, mm.
    pub close: f64,
    /// Samples per block that are kept for a picture; 0: none.
    pub spots: usize,
    /// How many boxes about triangles of the surface may be looked at to find the points nearest to the tip, in all blocks together, beyond a few hundred
    /// of their own: [`MOST_LOOKS`]. Those beyond a thousand for one point count sixteen times.
    pub looks: u64,
}

/// How many boxes are looked at, unless somebody says otherwise. Ordinary surfaces take about a hundred for each point; many triangles that are
/// equally near take all of them. When half of them is used up, bounds are no longer brought near to the samples; when all are, blocks that need more
/// are not judged.
pub const MOST_LOOKS: u64 = 400_000_000;

/// What each block may look at, whatever the others took.
const OWN_LOOKS: u64 = 500;

/// A largest error with its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Largest error at a sample, mm.
    pub sampled: f64,
    /// Proven: no larger one, mm.
    pub bound: f64,
    /// Block.
    pub block: BlockId,
    /// Share of the block, 0..=1.
    pub at: f64,
    /// Tool tip there, mm.
    pub point: Vec3,
    /// +1: the tip is on the side of the surface that the spindle is on (material is left), -1: on the other (it gouges); 0: no side.
    pub side: i8,
}

/// One sample for a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureSample {
    /// Running number of the judged block.
    pub leg: u32,
    /// Where the error is reported: the required point (same place) or the surface's nearest point, mm.
    pub place: Vec3,
    /// The tip, mm.
    pub tip: Vec3,
    /// Error, mm: from the same place where that is known, else from the surface.
    pub error: f64,
}

/// Everything found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Errors {
    /// Distance of the tip from the nearest point of the surface, less the offset.
    pub from_surface: Option<Found>,
    /// Distance of the tip from the point of the surface that belongs to the same share of the block: |S(u,v) - T(u,v)|. Only where both
    /// ends of the block lie on one sheet and no offset is asked for.
    pub same_place: Option<Found>,
    /// Distance of the tip from the programmed segment (the deviation of `trace`).
    pub from_segment: Option<Found>,
    /// Feed blocks that were judged.
    pub judged: u32,
    /// Feed blocks whose path is unknown.
    pub not_judged: u32,
    /// Feed blocks that start or end farther from the surface than [`Options::reach`].
    pub apart: u32,
    /// The first of them.
    pub first_apart: Option<BlockId>,
    /// How far, at most, the end of one of them is from the surface (less the offset), mm.
    pub farthest_apart: f64,
    /// The first that was not judged.
    pub first_not_judged: Option<BlockId>,
    /// Feed blocks with a known path that were not judged because [`Options::looks`] was used up.
    pub given_up: u32,
    /// The first of them.
    pub first_given_up: Option<BlockId>,
    /// The first block whose bound was not brought near to its samples because half of [`Options::looks`] was used up.
    pub first_loose: Option<BlockId>,
    /// Feed blocks with a same place.
    pub placed: u32,
    /// Samples for a picture.
    pub spots: Vec<PictureSample>,
}

/// Samples of all blocks of a run together. Where they are used up, bounds stay sound but are loose, and the verdict may be unknown.
const SAMPLES_OF_ALL: usize = 5_000_000;

/// Judges legs one by one.
pub struct Judge<'a> {
    required: &'a Required,
    machine: &'a Machine,
    options: Options,
    errors: Errors,
    /// Samples that all blocks together may still take beyond a few of their own.
    left: usize,
    /// Boxes that all blocks together may still look at.
    looks: u64,
}

impl<'a> Judge<'a> {
    /// Nothing judged yet.
    pub fn new(required: &'a Required, machine: &'a Machine, options: Options) -> Self {
        Self {
            required,
            machine,
            options,
            errors: Errors::default(),
            left: SAMPLES_OF_ALL,
            looks: options.looks,
        }
    }

    /// Judges a leg; rapids and dwells cut nothing and are skipped. `is_tip`: the point that the control guides is the tool's tip.
    pub fn leg(&mut self, leg: &Leg, is_tip: bool) {
        if !leg.motion.is_feed() {
            return;
        }
        let block = leg.motion.block;
        let Some(way) = BlockPath::new(self.machine, leg).filter(|_| is_tip) else {
            return self.not_judged(block);
        };
        let left = Cell::new(self.looks.saturating_add(OWN_LOOKS));
        self.measure(leg, &way, &left);
        self.looks = self.looks.min(left.get());
    }

    /// Judges a leg whose path is known; `left`: how many boxes may be looked at.
    fn measure(&mut self, leg: &Leg, way: &BlockPath<'_>, left: &Cell<u64>) {
        let block = leg.motion.block;
        let (required, options) = (self.required, self.options);
        let near = FromSurface {
            way,
            required,
            offset: options.offset,
            left,
            reserve: options.looks / 2,
        };
        let ends = near.sample(0.0).1.max(near.sample(1.0).1);
        if left.get() == 0 {
            return self.give_up(block);
        }
        if !ends.is_finite() {
            return self.not_judged(block);
        }
        if ends > options.reach {
            self.errors.apart += 1;
            self.errors.first_apart.get_or_insert(block);
            self.errors.farthest_apart = self.errors.farthest_apart.max(ends);
            return;
        }
        let reached = |known: &Option<Found>| known.as_ref().map_or(0.0, |found| found.sampled);
        let pieces = first_pieces(way);
        let known = reached(&self.errors.from_surface);
        let found = top(&near, pieces, self.most(), known, options.close);
        self.left = self.left.saturating_sub(found.samples);
        let found = Found {
            bound: found.bound + required.off + leg.motion.slack_mm,
            ..self.found(block, way, found, Some(left))
        };
        let same = SamePlace::new(way, required, left).filter(|_| options.offset == 0.0);
        let spots = self.spots(&near, same.as_ref());
        // what was found of a part of the block says nothing about the rest
        if left.get() == 0 {
            return self.give_up(block);
        }
        if near.is_spent() {
            self.errors.first_loose.get_or_insert(block);
        }
        self.errors.judged += 1;
        self.errors.spots.extend(spots);
        keep(&mut self.errors.from_surface, found);

        if let Some(same) = &same {
            self.errors.placed += 1;
            let known = reached(&self.errors.same_place);
            let found = top(same, pieces, self.most(), known, options.close);
            self.left = self.left.saturating_sub(found.samples);
            let found = Found {
                bound: found.bound + leg.motion.slack_mm,
                ..self.found(block, way, found, None)
            };
            keep(&mut self.errors.same_place, found);
        }
        if let Some(deviation) = tip_deviation(self.machine, leg, 0.0) {
            let found = Top {
                sampled: deviation.sampled_mm,
                at: deviation.at,
                bound: deviation.bound_mm,
                samples: 0,
            };
            let found = self.found(block, way, found, None);
            keep(&mut self.errors.from_segment, found);
        }
    }

    /// The path of this block is not known.
    fn not_judged(&mut self, block: BlockId) {
        self.errors.not_judged += 1;
        self.errors.first_not_judged.get_or_insert(block);
    }

    /// Nothing more may be looked at: this block is not judged.
    fn give_up(&mut self, block: BlockId) {
        self.errors.given_up += 1;
        self.errors.first_given_up.get_or_insert(block);
    }

    /// Samples that the next block may take.
    fn most(&self) -> usize {
        self.left.min(SAMPLES)
    }

    /// Samples for a picture.
    fn spots(&self, near: &FromSurface<'_>, same: Option<&SamePlace<'_>>) -> Vec<PictureSample> {
        let count = self.options.spots;
        let spot = |i: usize| {
            let t = i as f64 / count as f64;
            let tip = near.way.at(t).tip;
            let (place, error) = match same {
                Some(same) => {
                    let place = same.place(t);
                    (place, (tip - place).norm())
                }
                None => (self.required.nearest_within(&tip, near.left)?.point, near.sample(t).1),
            };
            let leg = self.errors.judged;
            Some(PictureSample { leg, place, tip, error })
        };
        let all = if count > 0 { 0..count + 1 } else { 0..0 };
        all.map_while(spot).collect()
    }

    /// What was found.
    pub fn finish(self) -> Errors {
        self.errors
    }

    /// `sided`: where the side of the surface is asked for, how many boxes may be looked at.
    fn found(&self, block: BlockId, way: &BlockPath<'_>, top: Top, sided: Option<&Cell<u64>>) -> Found {
        let moment = way.at(top.at);
        let near = sided.and_then(|left| self.required.nearest_within(&moment.tip, left));
        let above = near.map_or(0.0, |near| (moment.tip - near.point).dot(&moment.axis));
        let side = if above > 1e-9 {
            1
        } else if above < -1e-9 {
            -1
        } else {
            0
        };
        Found {
            sampled: top.sampled,
            bound: top.bound,
            block,
            at: top.at,
            point: moment.tip,
            side,
        }
    }
}

/// Keeps the largest sample with its place, and the largest bound of all.
fn keep(known: &mut Option<Found>, found: Found) {
    match known {
        Some(known) if known.sampled >= found.sampled => known.bound = known.bound.max(found.bound),
        Some(known) => {
            let bound = known.bound.max(found.bound);
            *known = Found { bound, ..found };
        }
        None => *known = Some(found),
    }
}

/// As many pieces as keep the tip within a hundredth of a millimetre of the chords, at most 64.
fn first_pieces(way: &BlockPath<'_>) -> usize {
    (way.tip_bend() / (8.0 * 0.01)).sqrt().ceil().clamp(1.0, 64.0) as usize
}

/// Distance from the nearest point of the surface, less the offset: it changes no faster than the tip moves, and between two moments the
/// tip is within Q h2 / 8 of its chord (docs/kinematics.md#between-the-ends-of-a-block).
struct FromSurface<'a> {
    way: &'a BlockPath<'a>,
    required: &'a Required,
    offset: f64,
    /// How many boxes may still be looked at.
    left: &'a Cell<u64>,
    /// So many are kept for the first samples of other blocks.
    reserve: u64,
}

impl Climb for FromSurface<'_> {
    type Sample = Vec3;
    fn sample(&self, t: f64) -> (Vec3, f64) {
        let tip = self.way.at(t).tip;
        let near = self.required.nearest_within(&tip, self.left);
        (
            tip,
            near.map_or(f64::INFINITY, |near| (near.distance - self.offset).abs()),
        )
    }
    fn way(&self, from: &Vec3, to: &Vec3, h: f64) -> (f64, f64) {
        ((to - from).norm(), self.way.tip_bend() * h * h * 0.125)
    }
    fn is_spent(&self) -> bool {
        self.left.get() <= self.reserve
    }
}

/// Distance from the point of the sheet whose parameters run evenly from the block's start to its end.
struct SamePlace<'a> {
    way: &'a BlockPath<'a>,
    sheet: &'a Sheet,
    from: Uv,
    to: Uv,
    /// mm of sheet per block, at most.
    slope: f64,
}

/// Ends this near are taken as on the surface, mm (in addition to the error of the triangles).
const ON: f64 = 0.01;

impl<'a> SamePlace<'a> {
    fn new(way: &'a BlockPath<'a>, required: &'a Required, left: &Cell<u64>) -> Option<Self> {
        if required.sheets().is_empty() {
            return None;
        }
        let [start, end] = [0.0, 1.0].map(|t| required.nearest_within(&way.at(t).tip, left));
        let (start, end) = (start?, end?);
        if start.distance.max(end.distance) > ON + required.off {
            return None;
        }
        let (from, to) = (start.uv?, end.uv?);
        if from.sheet != to.sheet {
            return None;
        }
        let sheet = &required.sheets()[from.sheet];
        let (by_u, by_v) = sheet.slopes();
        Some(Self {
            way,
            sheet,
            from,
            to,
            slope: by_u * (to.u - from.u).abs() + by_v * (to.v - from.v).abs(),
        })
    }

    fn place(&self, t: f64) -> Vec3 {
        let mix = |a: f64, b: f64| a + (b - a) * t;
        self.sheet
            .point(mix(self.from.u, self.to.u), mix(self.from.v, self.to.v))
    }
}

impl Climb for SamePlace<'_> {
    type Sample = Vec3;
    fn sample(&self, t: f64) -> (Vec3, f64) {
        let tip = self.way.at(t).tip;
        (tip, (tip - self.place(t)).norm())
    }
    fn way(&self, from: &Vec3, to: &Vec3, h: f64) -> (f64, f64) {
        ((to - from).norm() + self.slope * h, self.way.tip_bend() * h * h * 0.125)
    }
}
