//! Two programs of which the second makes the motions of the first elsewhere: shifted, turned, mirrored, scaled, or written in another unit or with
//! other words. Each motion of the first is moved exactly, and then both are compared as any two programs are.
mod left_alone;

use crate::Claim;
use crate::change::{Change, in_machine_coordinates, is_motion, names_rotary};
use crate::compare::{held, next};
use crate::ending::{at_end, stopped};
use crate::happens::happens;
use crate::item::{Item, Step};
use crate::judge::Judge;
use crate::near::Near;
use crate::numbers;
use crate::process::Process;
use crate::sentences::only_one;
use crate::steps::Steps;
use crate::unit::{other_unit_event, other_unit_settings, unit_of_stores};
use crate::verdict::{Difference, Verdict};
use trunnion_dialect::{Action, Plane};
use trunnion_geometry::Vec3;
use trunnion_interp::{AXIS_LETTERS, ChainId, Feed, Motion, MotionKind, Tilt, same_number};

/// What a comparison has found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Apart {
    /// Motions that were compared.
    pub motions: u64,
    /// The largest distance of an end, mm along an axis.
    pub end_mm: f64,
    /// The largest part by which a feed differs.
    pub feed_share: f64,
}

/// Where an axis stands in both programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stands {
    /// Where that is, is unknown, or is the same in both (machine coordinates, a reference point).
    Open,
    /// In the program after where the change puts it.
    Moved,
}

/// Runs both programs to their ends, or to the first difference.
///
/// # Errors
/// The first difference, or what cannot be decided.
pub fn compare_changed(before: &mut Steps<'_>, after: &mut Steps<'_>, change: &Change) -> Result<Apart, Verdict> {
    numbers::alike(before, after)?;
    let claim = Claim {
        mm: change.end_mm,
        deg: 1e-9,
        // compared here
        frees_feed: true,
        ..Claim::STRICT
    };
    let mut walk = Walk {
        change,
        stands: [Stands::Open; 3],
        names_rotary: names_rotary(before.input()),
        turns_parts: before.input().dialect.quirks.diameter,
        y_seen: false,
        along: before.input().setup.length_along(),
        drills: false,
        last: None,
        apart: Apart::default(),
    };
    loop {
        let (was, is) = (next(before, &claim), next(after, &claim));
        if change.other_unit
            && let Some(item) = &was
        {
            other_unit_settings(item, before.state())?;
        }
        match (was, is) {
            (None, None) => break,
            (Some(Item::Motion(was)), Some(Item::Motion(is))) => {
                walk.drills = before.state().motion.is_some_and(Action::is_hole_cycle);
                walk.pair(&was, &is, &claim)?;
            }
            (Some(mut was @ Item::Happens { .. }), Some(is @ Item::Happens { .. })) => {
                if let Item::Happens { process, block, .. } = &mut was
                    && change.moves(*block)
                    && change.mirrors(before.state().coordinates.plane())
                {
                    *process = Process::on_other_side(process);
                }
                let linuxcnc = before.input().dialect.quirks.rs274();
                let same = change.other_unit && other_unit_event(&was, &is, (change.end_mm, !linuxcnc))?;
                if !same {
                    happens(&was, &is, &claim)?;
                }
                walk.forget_places(&was);
            }
            (was, is) => return Err(only_one(was.as_ref(), is.as_ref())),
        }
    }
    stopped(before, after)?;
    at_end(before, after)?;
    if change.other_unit {
        unit_of_stores(&before.stored())?;
    }
    Ok(walk.apart)
}

struct Walk<'c> {
    change: &'c Change,
    stands: [Stands; 3],
    /// The program before names a rotary axis.
    names_rotary: bool,
    /// It is the program of a lathe.
    turns_parts: bool,
    /// Y has moved, or was somewhere else than on the axis of the spindle.
    y_seen: bool,
    /// The direction in which a tool length shifts, while the plane is XY.
    along: [f64; 3],
    /// A drilling cycle is active: its steps add up several words.
    drills: bool,
    /// The motion before.
    last: Option<Step>,
    apart: Apart,
}

fn place(was: &Motion, is: &Motion, what: impl Into<String>) -> Difference {
    Difference {
        before: Some(was.block),
        after: Some(is.block),
        what: what.into(),
    }
}

fn letter(axis: usize) -> char {
    char::from(AXIS_LETTERS[axis])
}

const UNKNOWN_PLACE: &str = "is unknown, or comes from machine coordinates or a reference point: it cannot be moved with the part; position the axis by a rapid first";

impl Walk<'_> {
    fn pair(&mut self, before: &Step, after: &Step, claim: &Claim) -> Result<(), Verdict> {
        let (was, is) = (&before.motion, &after.motion);
        let unknown = |what: &str| Err(Verdict::Unknown(place(was, is, what)));
        if was.kind == MotionKind::Unknown || is.kind == MotionKind::Unknown || was.kind == MotionKind::Arc(None) {
            return unknown("a motion is not modelled");
        }
        self.apart.motions += 1;
        if self.change.is_nothing() {
            held(before, after, claim)?;
            self.feeds(was, is)?;
            self.ends(was, was, is, 0b111)?;
            return self.inside(before, after);
        }
        if was.tilt != Tilt::default() || is.tilt != Tilt::default() {
            return unknown("a tilted working plane is active: its coordinates are not moved");
        }
        if !self.change.moves(was.block) {
            return self.left_alone(before, after, claim);
        }
        self.rotary(was, is)?;
        self.new_zero(before);
        self.lost(was);
        let moved = self.change.moved(before);
        held(&moved, after, claim)?;
        self.feeds(was, is)?;
        if in_machine_coordinates(before) || !is_motion(was) {
            self.not_moved(was, is)?;
            self.last = Some(before.clone());
            return if is_motion(was) { rest(was, is) } else { Ok(()) };
        }
        let cut = was.is_feed();
        self.y_seen |= [was, is].iter().any(|motion| goes(motion, 1));
        for group in self.change.groups() {
            let affected = group.iter().any(|axis| self.change.touches(*axis));
            let started = group.iter().all(|axis| self.stands[*axis] == Stands::Moved);
            let known = group
                .iter()
                .all(|axis| was.end.known & is.end.known & (1 << *axis) != 0);
            let goes = group.iter().any(|axis| goes(was, *axis) || goes(is, *axis));
            let lost = group.iter().any(|axis| was.end.known & (1 << *axis) == 0);
            if !affected {
                let bits = group.iter().fold(0, |all, axis| all | 1 << *axis);
                self.ends(was, &moved.motion, is, bits)?;
                continue;
            }
            let names: Vec<String> = group.iter().map(|axis| letter(*axis).to_string()).collect();
            let names = names.join(" or ");
            if cut && !started && group == [1] && self.lacks_y(was, is) {
                continue;
            }
            if cut && !started {
                return unknown(&format!("where this cut begins in {names} {UNKNOWN_PLACE}"));
            }
            if !goes && !started {
                continue;
            }
            if lost || !known {
                let says = group
                    .iter()
                    .any(|axis| (was.says_way | is.says_way) & (1 << *axis) != 0);
                if says || started || goes {
                    return unknown(&format!("where this motion ends in {names} {UNKNOWN_PLACE}"));
                }
                continue;
            }
            let bits = group.iter().fold(0, |all, axis| all | 1 << *axis);
            self.ends(was, &moved.motion, is, bits)?;
            for axis in &group {
                self.stands[*axis] = Stands::Moved;
            }
        }
        rest(was, is)?;
        self.last = Some(before.clone());
        self.inside(&moved, after)
    }

    /// Whether Y is where a turned part has it: on a lathe of two axes, at the axis of the spindle.
    fn lacks_y(&self, was: &Motion, is: &Motion) -> bool {
        let positions = [&was.start, &was.end, &is.start, &is.end];
        let named = |position: &&trunnion_interp::Position| position.known & 2 != 0 && position.values[1] != 0.0;
        self.turns_parts && !self.y_seen && !positions.iter().any(named) && (was.says_way | is.says_way) & 2 == 0
    }

    /// The coordinates of X, Y and Z at the end, those in `bits`.
    fn ends(&mut self, was: &Motion, moved: &Motion, is: &Motion, bits: u16) -> Result<(), Verdict> {
        let is_end = &is.end;
        for axis in (0..3).filter(|axis| bits & (1 << axis) != 0) {
            let known = (was.end.known & (1 << axis) != 0, is_end.known & (1 << axis) != 0);
            if known == (false, false) {
                continue;
            }
            if known.0 != known.1 {
                let what = format!("the end of {} is known in only one of the programs", letter(axis));
                return Err(Verdict::Unknown(place(was, is, what)));
            }
            let off = (moved.end.values[axis] - is_end.values[axis]).abs();
            let most = if self.drills {
                self.change.arc_mm
            } else {
                self.change.end_mm
            };
            if off.is_nan() || off > most {
                let what = format!(
                    "{} ends at {} mm, and not at {} mm",
                    letter(axis),
                    is_end.values[axis],
                    moved.end.values[axis]
                );
                return Err(Verdict::Differs(place(was, is, what)));
            }
            self.apart.end_mm = self.apart.end_mm.max(off);
        }
        Ok(())
    }

    /// Arcs, rotary axes, tool vectors and zero points, as two programs are compared.
    fn inside(&self, before: &Step, after: &Step) -> Result<(), Verdict> {
        // where an axis is not moved with the part, its end was compared before
        let mut before = before.clone();
        for axis in 0..3 {
            if self.change.touches(axis) && self.stands[axis] == Stands::Open {
                before.motion.end.values[axis] = after.motion.end.values[axis];
            }
        }
        self.near(&before, after)
    }

    fn near(&self, before: &Step, after: &Step) -> Result<(), Verdict> {
        let mm = if self.drills || matches!(before.motion.kind, MotionKind::Arc(_)) {
            self.change.arc_mm
        } else {
            self.change.end_mm
        };
        Near { mm, deg: 1e-9 }.pair(before, after)
    }

    /// Feeds, apart from their rounding.
    fn feeds(&mut self, was: &Motion, is: &Motion) -> Result<(), Verdict> {
        if !was.is_feed() {
            return Ok(());
        }
        let off = match (was.feed, is.feed) {
            (Feed::PerMinute(a), Feed::PerMinute(b)) | (Feed::PerRevolution(a), Feed::PerRevolution(b)) => {
                (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE)
            }
            (Feed::InverseTime(a), Feed::InverseTime(b)) if same_number(a, b) => 0.0,
            (Feed::Unknown, Feed::Unknown) | (Feed::Rapid, Feed::Rapid) => 0.0,
            _ => f64::INFINITY,
        };
        if off.is_nan() || off > self.change.feed_share {
            let what = format!(
                "the feed differs: {} and {}",
                crate::motions::feed(was.feed),
                crate::motions::feed(is.feed)
            );
            return Err(Verdict::Differs(place(was, is, what)));
        }
        self.apart.feed_share = self.apart.feed_share.max(off);
        let (spin, other) = (was.spin, is.spin);
        let same = |a: f64, b: f64| (a - b).abs() <= self.change.feed_share * a.abs().max(b.abs());
        match (spin, other) {
            _ if !self.change.is_nothing() => Ok(()),
            (Some(a), Some(b)) if same(a.mean_rpm, b.mean_rpm) && same(a.most_rpm, b.most_rpm) => Ok(()),
            (None, None) => Ok(()),
            _ => Err(Verdict::Differs(place(was, is, "the spindle speed under G96 differs"))),
        }
    }

    /// Rotary axes that are turned: X, Y and Z are the part's only under tool centre point control, and only a shift leaves the tool axis as it is.
    fn rotary(&self, was: &Motion, is: &Motion) -> Result<(), Verdict> {
        let turned = (3..6).any(|axis| {
            [&was.start, &was.end]
                .iter()
                .any(|position| position.known & (1 << axis) != 0 && position.values[axis] != 0.0)
        });
        let open = was.says_way & !was.end.known & 0b11_1000 != 0;
        if !turned && (!open || !self.names_rotary && was.chain == ChainId::MAIN) {
            return Ok(());
        }
        let what = if !self.change.is_shift() {
            "rotary axes turn the part or the tool: only a shift is proved for such a program"
        } else if !was.tcp && !was.machine_coordinates && is_motion(was) {
            "rotary axes are turned without tool centre point control: a shift of the words is no shift of the part"
        } else {
            return Ok(());
        };
        Err(Verdict::Unknown(place(was, is, what)))
    }

    /// After a change of the zero point or of the tool's length both programs must position the axes again.
    fn new_zero(&mut self, before: &Step) {
        let Some(last) = &self.last else { return };
        let bits = |motion: &Motion| motion.zero.map(f64::to_bits);
        let other = bits(&last.motion) != bits(&before.motion)
            || last.held.work_offset != before.held.work_offset
            || last.motion.undeclared.set_here != before.motion.undeclared.set_here;
        let length = last.held.length_of != before.held.length_of
            || !same_number(last.motion.tool_length_mm, before.motion.tool_length_mm);
        let usual = before.held.plane == Plane::Xy && last.held.plane == Plane::Xy;
        if other || length && !usual {
            self.stands = [Stands::Open; 3];
        } else if length && !self.change.keeps(self.along) {
            // the axes along which a length shifts the program before, or the one after
            let turned = self.change.direction(&Vec3::from(self.along));
            for (axis, stands) in self.stands.iter_mut().enumerate() {
                if self.along[axis] != 0.0 || turned[axis] != 0.0 {
                    *stands = Stands::Open;
                }
            }
        }
    }

    /// An axis whose position has become unknown between two motions (a tool change) has to be positioned again.
    fn lost(&mut self, was: &Motion) {
        for (axis, stands) in self.stands.iter_mut().enumerate() {
            if was.start.known & (1 << axis) == 0 {
                *stands = Stands::Open;
            }
        }
    }

    /// What is not modelled may have moved the axes.
    fn forget_places(&mut self, item: &Item) {
        if matches!(
            item,
            Item::Happens {
                sort: crate::item::Sort::Unmodelled,
                ..
            }
        ) {
            self.stands = [Stands::Open; 3];
        }
    }
}

/// The axes other than X, Y and Z.
fn rest(was: &Motion, is: &Motion) -> Result<(), Verdict> {
    for axis in 3..9 {
        let differs = (was.end.known ^ is.end.known) & (1 << axis) != 0
            || was.end.known & (1 << axis) != 0 && !same_number(was.end.values[axis], is.end.values[axis]);
        if differs {
            let what = format!("the end of {} differs", letter(axis));
            return Err(Verdict::Differs(place(was, is, what)));
        }
    }
    Ok(())
}

/// Whether a motion moves an axis, as far as that is known.
fn goes(motion: &Motion, axis: usize) -> bool {
    let bit = 1 << axis;
    match (motion.start.known & bit != 0, motion.end.known & bit != 0) {
        (true, true) => motion.start.values[axis] != motion.end.values[axis],
        (false, true) | (true, false) => true,
        (false, false) => motion.says_way & bit != 0,
    }
}
