//! `,R` and `,C`, RND, CHR and CHF: a corner between two straight motions rounded by an arc or cut off by a line (Fanuc: optional chamfering
//! and corner R; Sinumerik: chamfer and rounding).
mod words;
use crate::arc::plane_axes;
use crate::compensation::PendingMotion;
use crate::core::Report;
use crate::iso::Iso;
use crate::{Argument, Effect, FaultKind, Feed, Motion, MotionKind, Position, Refusal};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::{atan2, cos, tan};
use trunnion_syntax::{Address, Word};

/// A corner that needs the motion after it.
#[derive(Clone, Debug)]
struct Waiting {
    pending: PendingMotion,
    /// `R`, `C`, or `F`: a chamfer by the length of its face (CHF).
    letter: u8,
    /// mm; no number where it is not known.
    size: f64,
    /// FRC or FRCM of its block: the feed of the corner alone, in the unit of F.
    feed: Option<f64>,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Corners {
    /// The corner word of the current block: letter and mm.
    pub(crate) word: Option<(u8, f64)>,
    /// FRC of the current block, else FRCM.
    feed: Option<f64>,
    waiting: Option<Box<Waiting>>,
    /// Why the motion that now ends at a corner begins at an unknown point: the corner before it is not followed.
    lost: Option<String>,
}

impl Corners {
    /// The motion that waits for the one after it.
    pub(crate) fn pending(&mut self) -> Option<&mut PendingMotion> {
        self.waiting.as_mut().map(|waiting| &mut waiting.pending)
    }

    pub(crate) fn is_busy(&self) -> bool {
        self.word.is_some() || self.waiting.is_some()
    }
}

/// How far two motions in the plane are cut short at their corner, and the direction of each; `None` where they are no corner of lines.
pub(crate) struct Cut {
    axes: [usize; 3],
    first: Vec3,
    second: Vec3,
    turn: f64,
    pub(crate) by: f64,
    /// A lathe: no word moves the third axis.
    no_height: bool,
    /// The feed of the corner, where it is not that of the motion before.
    feed: Option<Feed>,
}

/// A position in the plane; an unknown height is taken as 0, like Y of a lathe that has none.
fn point(position: &Position, axes: [usize; 3]) -> Option<Vec3> {
    let mut point = Vec3::zeros();
    for axis in &axes[..2] {
        point[*axis] = position.get(*axis)?;
    }
    point[axes[2]] = position.get(axes[2]).unwrap_or(0.0);
    Some(point)
}

/// Whether both ends of a motion are known in the plane.
fn is_known(motion: &Motion, axes: [usize; 3]) -> bool {
    point(&motion.start, axes).is_some() && point(&motion.end, axes).is_some()
}

pub(crate) fn flat(motion: &Motion, axes: [usize; 3]) -> Option<Vec3> {
    let height = 1 << axes[2];
    if (motion.start.known ^ motion.end.known) & height != 0 {
        return None;
    }
    let mut way = point(&motion.end, axes)? - point(&motion.start, axes)?;
    let level = way[axes[2]].abs() <= 1e-9;
    way[axes[2]] = 0.0;
    (motion.kind == MotionKind::Linear && level && way.norm() > 1e-9).then_some(way)
}

/// Whether a motion runs along the plane's third axis alone.
fn is_vertical(motion: &Motion, axes: [usize; 3]) -> bool {
    let (Some(start), Some(end)) = (motion.start.xyz(), motion.end.xyz()) else {
        return false;
    };
    let way = end - start;
    matches!(motion.kind, MotionKind::Linear | MotionKind::Rapid)
        && way[axes[0]].abs() <= 1e-9
        && way[axes[1]].abs() <= 1e-9
        && way[axes[2]].abs() > 1e-9
}

impl Iso<'_> {
    /// Takes a motion of the block; what can be emitted is pushed to `on`.
    pub(crate) fn round_corner(&mut self, motion: &Motion, on: &mut Vec<PendingMotion>, report: &mut Report<'_>) {
        let mut pending = (*motion, self.core.state.clone());
        if let Some(waiting) = self.memory.corners.waiting.take() {
            self.cut_corner(*waiting, &mut pending, on, report);
        }
        let tolerant = self.core.dialect.quirks.declares_names();
        let feed = self.memory.corners.feed;
        match self.memory.corners.word.take() {
            Some((letter, size)) if motion.is_feed() || tolerant => {
                let waiting = Waiting {
                    pending,
                    letter,
                    size,
                    feed,
                };
                self.memory.corners.waiting = Some(Box::new(waiting));
            }
            word => {
                if word.is_some() {
                    self.no_corner("a corner word needs a feed motion", "corner-no-move", report);
                }
                on.push(pending);
            }
        }
    }

    /// Nothing follows the corner.
    pub(crate) fn end_corners(&mut self, on: &mut Vec<PendingMotion>, report: &mut Report<'_>) {
        self.memory.corners.word = None;
        if let Some(waiting) = self.memory.corners.waiting.take() {
            if !self.core.dialect.quirks.declares_names() {
                self.no_corner("no motion follows the corner", "corner-no-move", report);
            }
            on.push(waiting.pending);
        }
    }

    fn no_corner(&self, text: &str, mistake: &str, report: &mut Report<'_>) {
        let kind = FaultKind::Rejected {
            refusal: Refusal::Other,
            message: text.to_owned(),
            alarm: self.core.dialect.alarm(mistake).map(|alarm| alarm.number.clone()),
        };
        report.fault(report.whole(), kind);
    }

    fn cut_corner(
        &mut self,
        waiting: Waiting,
        next: &mut PendingMotion,
        on: &mut Vec<PendingMotion>,
        report: &mut Report<'_>,
    ) {
        let mut before = waiting.pending;
        let axes = plane_axes(before.1.coordinates.plane());
        let nowhere =
            [&before, &*next].map(|pending| matches!(pending.0.kind, MotionKind::Unknown | MotionKind::Arc(None)));
        let known = is_known(&before.0, axes) && is_known(&next.0, axes) && nowhere == [false; 2];
        let tolerant = self.core.dialect.quirks.declares_names();
        if tolerant && known && (is_vertical(&before.0, axes) || is_vertical(&next.0, axes)) {
            // no corner is made where a motion leaves the plane (Programming Manual, Fundamentals, chamfer and rounding)
            on.push(before);
            return;
        }
        let lost = self.memory.corners.lost.take();
        let arcs = matches!(before.0.kind, MotionKind::Arc(_)) || matches!(next.0.kind, MotionKind::Arc(_));
        let ways = flat(&before.0, axes).zip(flat(&next.0, axes));
        let lathe = self.core.radii && axes[2] == 1;
        let no_height = lathe && before.0.end.get(1).is_none() && next.0.end.get(1).is_none();
        let feeds = [(&before, waiting.feed), (&*next, self.memory.corners.feed)].map(corner_feed);
        let fed = !tolerant || feeds[0] == feeds[1];
        let feed = tolerant.then_some(if fed { feeds[0] } else { Feed::Unknown });
        let cut = ways.map(|(first, second)| Cut {
            no_height,
            feed,
            ..Cut::new(axes, first, second, waiting.letter, waiting.size)
        });
        let fits = cut.as_ref().zip(ways).map(|(cut, (first, second))| {
            cut.by >= 0.0 && cut.by <= first.norm() + 1e-9 && cut.by <= second.norm() + 1e-9
        });
        let unsettled = self.unsettled(&before.0, &next.0, report);
        let place = match fits {
            _ if waiting.size.is_nan() => Some("of an unknown size"),
            _ if self.memory.frames.scales() => Some("while the axes are scaled"),
            _ if before.0.zero != next.0.zero => Some("where the zero point changes between both blocks"),
            Some(true) if tolerant && unsettled.is_some() && cut.as_ref().is_some_and(|cut| cut.by > 1e-9) => unsettled,
            Some(false) if tolerant => Some("larger than their motions"),
            None if arcs => Some("at an arc"),
            None if !known => Some("from or to an unknown position"),
            None if tolerant => Some("at motions that are no lines in the plane"),
            _ => None,
        };
        if let Some(place) = place {
            // one corner that is not followed makes the ones after it unknown, too: that is one cause
            let what = match lost.filter(|_| !arcs && !known) {
                Some(what) => what,
                None => format!("rounded and chamfered corners {place}"),
            };
            self.memory.corners.lost = Some(what.clone());
            report.fault(report.whole(), FaultKind::NotModelled { what });
            if self.core.effects.wanted() {
                // its words are neither in the motions nor among those that are compared
                let size = Argument::number(format!("corner {}", char::from(waiting.letter)), waiting.size);
                let block = self.core.main_block(report.block);
                self.core.effects.add(block, Effect::Unmodelled(vec![size]));
            }
            for axis in &axes[..2] {
                before.0.end.forget(*axis);
                before.0.says_way |= 1 << *axis;
                next.0.start.forget(*axis);
            }
        } else if let (Some(cut), Some(true)) = (&cut, fits) {
            if !fed && cut.by > 1e-9 {
                self.unsettled_feed(feeds, report);
            }
            cut.apply(before, waiting.letter == b'R', next, on);
            return;
        } else if let (Some(cut), Some((first, second))) = (&cut, ways) {
            let text = format!(
                "the corner takes {:.3} mm of both motions, which are {:.3} mm and {:.3} mm long",
                cut.by,
                first.norm(),
                second.norm()
            );
            self.no_corner(&text, "corner-too-large", report);
        } else {
            let text = "a rounded or chamfered corner must be followed by a straight feed motion in the plane";
            self.no_corner(text, "corner-no-move", report);
        }
        on.push(before);
    }

    /// The blocks before and after a corner give it different feeds. Which counts is machine data (SINUMERIK 828D Programming Manual,
    /// Fundamentals, 07/2010, p. 282).
    fn unsettled_feed(&mut self, feeds: [Feed; 2], report: &mut Report<'_>) {
        let what = "the feed of a chamfer or rounding: bit 0 of machine data 20201 decides whether F and FRC of the block before it or \
                    after it count; write the same FRC in both blocks"
            .to_owned();
        report.fault(report.whole(), FaultKind::NotModelled { what });
        if self.core.effects.wanted() {
            let said = feeds.map(|feed| match feed {
                Feed::PerMinute(feed) => Argument::number("feed of a corner", feed),
                Feed::PerRevolution(feed) => Argument::number("feed of a corner per revolution", feed),
                Feed::InverseTime(_) | Feed::Rapid | Feed::Unknown => Argument::code("feed of a corner"),
            });
            let block = self.core.main_block(report.block);
            self.core.effects.add(block, Effect::Unmodelled(said.into()));
        }
    }

    /// Why machine data decide about a corner: how many blocks may be between its two blocks (20200 CHFRND_MAXNUM_DUMMY_BLOCKS), or which of
    /// them gives it its settings, where it matters (20201 CHFRND_MODE_MASK).
    fn unsettled(&self, before: &Motion, next: &Motion, report: &Report<'_>) -> Option<&'static str> {
        let words = report.program.block(report.block);
        let plain = |word: &Word| match word.address {
            Address::Letter(letter) => matches!(letter, b'N' | b'G' | b'X' | b'Y' | b'Z' | b'F' | b'I' | b'J' | b'K'),
            Address::Indexed(..) | Address::Named(_) => true,
        };
        if next.block.0 != before.block.0 + 1 {
            return Some("with a block between its motions: machine data 20200 says how many there may be");
        }
        let is_plain = !self.memory.own.path.sets_rounding() && words.words().all(|word| plain(&word));
        (!is_plain).then_some("whose settings are those of another block")
    }
}

/// The feed of a corner as one of its blocks gives it: FRC, FRCM, or F.
fn corner_feed((pending, own): (&PendingMotion, Option<f64>)) -> Feed {
    let (motion, state) = pending;
    match (own, motion.feed) {
        (None, feed) => feed,
        (Some(feed), Feed::PerMinute(_)) if feed.is_finite() => Feed::PerMinute(feed * state.feed.unit_mm()),
        (Some(feed), Feed::PerRevolution(_)) if feed.is_finite() => Feed::PerRevolution(feed * state.feed.unit_mm()),
        _ => Feed::Unknown,
    }
}

impl Cut {
    pub(crate) fn new(axes: [usize; 3], first: Vec3, second: Vec3, letter: u8, size: f64) -> Self {
        let mut normal = Vec3::zeros();
        normal[axes[2]] = 1.0;
        let turn = atan2(normal.dot(&first.cross(&second)), first.dot(&second));
        let by = match letter {
            b'R' => size * tan(0.5 * turn.abs()),
            b'F' => 0.5 * size / cos(0.5 * turn),
            _ => size,
        };
        Self {
            axes,
            first: first.normalize(),
            second: second.normalize(),
            turn,
            by,
            no_height: false,
            feed: None,
        }
    }
    pub(crate) fn apply(
        &self,
        mut before: PendingMotion,
        round: bool,
        next: &mut PendingMotion,
        on: &mut Vec<PendingMotion>,
    ) {
        let corner = point(&before.0.end, self.axes);
        let Some(corner) = corner.filter(|_| self.by > 1e-9 && self.turn.abs() > 1e-12) else {
            on.push(before);
            return;
        };
        let whole = before.0.end.xyz().is_some() || self.no_height;
        let (from, to) = (corner - self.first * self.by, corner + self.second * self.by);
        for axis in &self.axes[..2] {
            before.0.end.set(*axis, from[*axis]);
            next.0.start.set(*axis, to[*axis]);
        }
        let mut link = before.clone();
        on.push(before);
        link.0.start = link.0.end;
        link.0.end = next.0.start;
        link.0.feed = self.feed.unwrap_or(link.0.feed);
        link.0.kind = if round {
            let mut normal = Vec3::zeros();
            normal[self.axes[2]] = 1.0;
            let radius = self.by / tan(0.5 * self.turn.abs());
            let inward = normal.cross(&self.first) * self.turn.signum();
            // without its height the arc is valid only in its plane
            MotionKind::Arc(whole.then_some(Arc {
                start: from,
                end: to,
                centre: from + inward * radius,
                normal,
                sweep: self.turn,
                radius_start: radius,
                radius_end: radius,
            }))
        } else {
            MotionKind::Linear
        };
        on.push(link);
    }
}
