//! From two runs to the list of differences. First pass: a key per motion, 16 bytes each, which are aligned. Second pass: the
//! motions of the stretches that differ are produced again and compared in numbers, so that the first pass may be coarse.
use crate::align::{Stretch, align};
use crate::event::{Body, Event};
use crate::keys::{Keys, Techs, keys, place_unknown};
use crate::match_up::match_up;
use crate::point::{Point, Tolerance};
use crate::run::Events;
use std::collections::{BTreeMap, HashMap};
use trunnion_interp::FaultKind;
use trunnion_same::{
    Claim, Difference, Input, Near, Steps, Stop, Verdict, are_two_controls, only_by_chance, run_alike, undeclared,
    unrelated, variables_differ,
};
use trunnion_syntax::BlockId;

/// This many motions are compared in detail; more are only counted.
const MOST_DETAILS: usize = 50_000;
/// So many different changes of feed, speed and the like are kept.
const MOST_TECHS: usize = 10_000;

/// One difference.
#[derive(Clone, Debug)]
pub enum Change {
    /// A motion ends at another position.
    Moved(Box<(BlockId, Point)>, Box<(BlockId, Point)>),
    /// Only in the first (`false`) or second (`true`) program.
    Only(bool, BlockId, Box<Body>),
}

/// A change of the modal state, with all motions that have it.
#[derive(Clone, Debug)]
pub struct TechChange {
    /// Name, before, after.
    pub parts: Vec<(String, String, String)>,
    /// First motion in both programs.
    pub first: (BlockId, BlockId),
    /// Last motion in both programs.
    pub last: (BlockId, BlockId),
    /// How many motions have it.
    pub count: u64,
}

/// Everything found.
pub struct Found {
    /// The verdict of the comparison.
    pub verdict: Verdict,
    /// Motions of each program.
    pub motions: [u64; 2],
    /// Motions that end at another position, and what only one of them has.
    pub changes: Vec<Change>,
    /// Other feeds, speeds and the like.
    pub techs: Vec<TechChange>,
    /// Motions and statements that differ and were not compared in detail.
    pub not_compared: u64,
    /// Motions whose changes of feed and the like are not listed.
    pub techs_not_listed: u64,
    /// Motions whose end is unknown in numbers: they are the same only as far as their words are.
    pub unknown: u64,
    /// The two have too little in common to be aligned.
    pub too_different: bool,
    /// Both were compared one by one, because they have the same number of motions and too many differences to be aligned.
    pub one_by_one: bool,
    /// Where the runs stopped before the end of their programs.
    pub stops: [Option<Stop>; 2],
    /// Place of each change in `techs`.
    places: HashMap<Parts, usize>,
}

/// Name, before, after of each part of a change.
type Parts = Vec<(String, String, String)>;

impl Found {
    fn new(verdict: Verdict) -> Self {
        Self {
            verdict,
            motions: [0; 2],
            changes: Vec::new(),
            techs: Vec::new(),
            not_compared: 0,
            techs_not_listed: 0,
            unknown: 0,
            too_different: false,
            one_by_one: false,
            stops: [None, None],
            places: HashMap::new(),
        }
    }
    /// Whether the programs are the same.
    pub fn same(&self) -> bool {
        self.verdict == Verdict::Same
    }
}

/// Two programs that are compared.
#[derive(Clone, Copy)]
pub struct Pair<'a> {
    /// Before.
    pub before: Input<'a>,
    /// After; with the machine of the first one.
    pub after: Input<'a>,
    /// They have the same settings, so that the comparison of `certify` may be used.
    pub one_setup: bool,
}

/// Compares two programs; with a machine, by joints.
pub fn compare(pair: &Pair<'_>, tolerance: Tolerance, path_only: bool) -> Found {
    let (before, after) = (pair.before, pair.after);
    let claim = Claim {
        mm: tolerance.mm,
        deg: tolerance.deg,
        path_only,
        cuts: true,
        ..Claim::STRICT
    };
    let mut near = Near {
        mm: tolerance.mm,
        deg: tolerance.deg,
    };
    let mut sides = [Steps::new(before), Steps::new(after)];
    for side in &mut sides {
        side.count_motions(place_unknown);
        side.watch_faults();
    }
    let [one, other] = &mut sides;
    let mut verdict = trunnion_same::compare(one, other, &claim, &mut near);
    // the bounds of a path say nothing about a program that is not followed to its end
    let to_their_ends = sides.iter().all(|steps| steps.stop().is_none());
    if matches!(verdict, Verdict::Unknown(_)) && to_their_ends && proved(pair, tolerance, path_only) {
        verdict = Verdict::Same;
    }
    if verdict == Verdict::Same {
        let unset: Vec<_> = sides.iter_mut().flat_map(undeclared).collect();
        verdict = by_chance(pair, &claim, &unset).map_or(verdict, Verdict::Unknown);
    }
    if verdict == Verdict::Same || only_cut_short(&verdict, &sides) {
        let mut found = Found::new(verdict);
        // what the comparison has not come to is counted too; nothing is run a second time
        for (side, steps) in sides.iter_mut().enumerate() {
            steps.for_each(drop);
            found.motions[side] = steps.counted()[0];
            found.stops[side] = steps.stop().cloned();
        }
        found.unknown = sides[0].counted()[1];
        return found;
    }
    list(pair, tolerance, verdict)
}

/// Where two programs are the same only because of values that nobody declares.
fn by_chance(pair: &Pair<'_>, claim: &Claim, unset: &[FaultKind]) -> Option<Difference> {
    if pair.before.program.source() == pair.after.program.source() {
        return None;
    }
    let dialects = [pair.before.dialect, pair.after.dialect];
    let setups = [pair.before, pair.after].map(|input| unrelated(input.setup, dialects, unset));
    let [Some(before), Some(after)] = &setups else {
        return None;
    };
    let mut sides =
        [(pair.before, before), (pair.after, after)].map(|(input, setup)| Steps::new(Input { setup, ..input }));
    let [one, other] = &mut sides;
    let [mm, deg] = [claim.mm, claim.deg];
    match trunnion_same::compare(one, other, claim, &mut Near { mm, deg }) {
        Verdict::Unknown(found) if !are_two_controls(dialects) && !variables_differ(&found.what) => None,
        Verdict::Differs(found) | Verdict::Unknown(found) => Some(Difference {
            what: only_by_chance(unset),
            ..found
        }),
        Verdict::Same => None,
    }
}

/// Whether the runs were the same up to where a bound ended one of them: then there is nothing to list.
fn only_cut_short(verdict: &Verdict, sides: &[Steps<'_>; 2]) -> bool {
    let Verdict::Unknown(found) = verdict else {
        return false;
    };
    let named = |stop: &Stop| stop.by_bound && found.what.ends_with(&stop.why);
    sides.iter().all(Steps::is_over) && sides.iter().any(|steps| steps.stop().is_some_and(named))
}

/// Lists what differs in two programs that are not the same; `verdict`: what a comparison has found, which is not made again.
pub fn list(pair: &Pair<'_>, tolerance: Tolerance, verdict: Verdict) -> Found {
    let (before, after) = (pair.before, pair.after);
    let mut found = Found::new(verdict);
    let mut techs = Techs::default();
    let a = keys(before, tolerance, &mut techs, (0, &mut found));
    let b = keys(after, tolerance, &mut techs, (1, &mut found));
    let stretches = match align(&a.hashes, &b.hashes) {
        Some(stretches) => stretches,
        None if a.hashes.len() == b.hashes.len() => {
            found.one_by_one = true;
            return one_by_one(pair, tolerance, [&a, &b], found);
        }
        None => {
            found.too_different = true;
            let head = a.hashes.iter().zip(&b.hashes).take_while(|(x, y)| x == y).count();
            let tail = a.hashes[head..]
                .iter()
                .rev()
                .zip(b.hashes[head..].iter().rev())
                .take_while(|(x, y)| x == y)
                .count();
            let most = MOST_DETAILS / 100;
            let (more, other) = (a.hashes.len() - head - tail, b.hashes.len() - head - tail);
            found.not_compared = (more.saturating_sub(most)).max(other.saturating_sub(most)) as u64;
            vec![
                Stretch::Same(0, 0, head),
                Stretch::Different(head, more.min(most), head, other.min(most)),
            ]
        }
    };
    same_stretches(&a, &b, &techs, &stretches, &mut found);
    details(pair, tolerance, &stretches, &mut found);
    found
}

/// Where ends and shapes do not decide, the bounds between the ends may: a tool vector against rotary words.
fn proved(pair: &Pair<'_>, tolerance: Tolerance, path_only: bool) -> bool {
    let Some(machine) = pair.before.machine.filter(|_| pair.one_setup) else {
        return false;
    };
    if !run_alike(&pair.before, &pair.after) {
        return false;
    }
    let (tolerance_mm, tolerance_deg) = (tolerance.mm, tolerance.deg);
    let claim = if path_only {
        trunnion_certify::Claim::SamePath {
            tolerance_mm,
            tolerance_deg,
        }
    } else {
        trunnion_certify::Claim::SameToolPath {
            tolerance_mm,
            tolerance_deg,
        }
    };
    let outcome = trunnion_certify::certify_with_libraries(
        [pair.before.program.source(), pair.after.program.source()],
        [pair.before.dialect, pair.after.dialect],
        machine,
        (pair.before.setup, &pair.after.setup.library),
        &claim,
    );
    matches!(outcome, trunnion_certify::Outcome::Proved(_))
}

/// The modal state of motions that end at the same position.
fn same_stretches(a: &Keys, b: &Keys, techs: &Techs, stretches: &[Stretch], found: &mut Found) {
    let mut groups: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for stretch in stretches {
        let Stretch::Same(x, y, length) = *stretch else {
            continue;
        };
        for (at, other) in (x..x + length).zip(y..y + length) {
            let pair = (a.techs[at], b.techs[other]);
            if pair.0 == pair.1 || pair.0 == u32::MAX || pair.1 == u32::MAX {
                continue;
            }
            let blocks = (BlockId(a.blocks[at]), BlockId(b.blocks[other]));
            if let Some(&known) = groups.get(&pair) {
                found.techs[known].add(blocks);
                continue;
            }
            let parts = techs.list[pair.0 as usize].differences(&techs.list[pair.1 as usize]);
            if let Some(place) = found.note(parts, blocks) {
                groups.insert(pair, place);
            }
        }
    }
}

impl TechChange {
    fn add(&mut self, blocks: (BlockId, BlockId)) {
        self.count += 1;
        self.first = self.first.min(blocks);
        self.last = self.last.max(blocks);
    }
}

impl Found {
    /// Records that a motion has another feed or the like; its place in the list.
    fn note(&mut self, parts: Parts, blocks: (BlockId, BlockId)) -> Option<usize> {
        if parts.is_empty() {
            return None;
        }
        // the same change in motions of other tools is one change
        if let Some(&place) = self.places.get(&parts) {
            self.techs[place].add(blocks);
            return Some(place);
        }
        if self.techs.len() >= MOST_TECHS {
            self.techs_not_listed += 1;
            return None;
        }
        self.places.insert(parts.clone(), self.techs.len());
        self.techs.push(TechChange {
            parts,
            first: blocks,
            last: blocks,
            count: 1,
        });
        Some(self.techs.len() - 1)
    }

    /// Compares two events at the same place.
    fn pair(&mut self, a: Event, b: Event, tolerance: Tolerance) {
        match (a.body, b.body) {
            (Body::Motion(from, tech), Body::Motion(to, other)) => {
                if !from.same(&to, tolerance) {
                    self.changes
                        .push(Change::Moved(Box::new((a.block, from)), Box::new((b.block, to))));
                }
                let parts = tech.differences(&other);
                if from.way.name() == to.way.name() {
                    self.note(parts, (a.block, b.block));
                }
            }
            (Body::Statement(x), Body::Statement(y)) if x == y => {}
            (x, y) => {
                self.only(false, a.block, x);
                self.only(true, b.block, y);
            }
        }
    }

    fn only(&mut self, after: bool, block: BlockId, body: Body) {
        self.changes.push(Change::Only(after, block, Box::new(body)));
    }
}

/// The second pass: makes the events of the stretches that differ again.
fn details(pair: &Pair<'_>, tolerance: Tolerance, stretches: &[Stretch], found: &mut Found) {
    let mut sides = [Skipping::new(pair.before), Skipping::new(pair.after)];
    let mut compared = 0;
    for stretch in stretches {
        let Stretch::Different(x, more, y, other) = *stretch else {
            continue;
        };
        if compared + more + other > MOST_DETAILS {
            found.not_compared += more.max(other) as u64;
            continue;
        }
        compared += more + other;
        let (left, right) = (sides[0].take(x, more), sides[1].take(y, other));
        let matched = match_up(&left, &right);
        let (mut a, mut b) = (left.into_iter(), right.into_iter());
        for (one, two) in matched {
            match (one.and_then(|_| a.next()), two.and_then(|_| b.next())) {
                (Some(a), Some(b)) => found.pair(a, b, tolerance),
                (Some(a), None) => found.only(false, a.block, a.body),
                (None, Some(b)) => found.only(true, b.block, b.body),
                (None, None) => {}
            }
        }
    }
}

/// A run from which stretches are taken in order.
struct Skipping<'a> {
    events: Events<'a>,
    next: usize,
}

impl<'a> Skipping<'a> {
    fn new(input: Input<'a>) -> Self {
        Self {
            events: Events::new(input),
            next: 0,
        }
    }

    fn take(&mut self, from: usize, count: usize) -> Vec<Event> {
        if count == 0 {
            return Vec::new();
        }
        let skipped = from - self.next;
        self.next = from + count;
        self.events.by_ref().skip(skipped).take(count).collect()
    }
}

/// Compares event by event until [`MOST_DETAILS`] are listed; how many more differ, the keys of the first pass say, so that programs that
/// differ everywhere are not run to their end a second time.
fn one_by_one(pair: &Pair<'_>, tolerance: Tolerance, [a, b]: [&Keys; 2], mut found: Found) -> Found {
    let mut compared = 0;
    let mut events = Events::new(pair.before).zip(Events::new(pair.after));
    while found.changes.len() < MOST_DETAILS
        && let Some((before, after)) = events.next()
    {
        found.pair(before, after, tolerance);
        compared += 1;
    }
    let rest = a.hashes[compared..].iter().zip(&b.hashes[compared..]);
    found.not_compared += rest.filter(|(before, after)| before != after).count() as u64;
    found
}
