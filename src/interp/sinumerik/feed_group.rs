//! FGROUP and FGREF: along which axes F is measured. The other axes of a block follow in the same time.
//!
//! F is a speed along the axes of FGROUP. A rotary axis among them counts with its path on the circle of radius FGREF, by default 1 mm per
//! degree; FGROUP() takes the setting of the machine back, by which F is that of X, Y and Z. A block whose F is not that of X, Y and Z gets the
//! time that follows, as G93 states it. Sources: SINUMERIK, Function Manual, Basic Machine, 08/2005, K2, p. 2-12; Programming Manual,
//! Fundamentals, 11/2006, p. 271; SINUMERIK ONE, NC programming, 12/2019, pp. 105 to 112.
use crate::codes::Found;
use crate::core::{LINEAR, ROTARY, Report};
use crate::iso::Iso;
use crate::reader::Reader;
use crate::{AXIS_LETTERS, Argument, Effect, FaultKind, Feed, Motion, MotionKind, Orientation};
use core::f64::consts::PI;
use trunnion_dialect::Action;
use trunnion_geometry::arc::Arc;
use trunnion_syntax::{TextRange, Word};

/// The radius of a rotary axis without FGREF, mm: a degree counts as 1 mm.
const DEGREE_AS_MM: f64 = 180.0 / PI;

/// The axes along which F is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Measured {
    /// The setting of the machine: X, Y and Z.
    #[default]
    Machine,
    /// These, bits as in [`crate::Position::known`].
    Axes(u16),
    /// FGROUP names something that is no axis letter.
    Unknown,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct FeedGroup {
    measured: Measured,
    /// FGREF by axis, mm; NaN: written, and not known. `None`: the default.
    radius_mm: [Option<f64>; 9],
    /// FGREF of the current block as it is written, and its axis; `None`: of something else.
    written: Vec<(Option<usize>, Option<f64>)>,
    /// Why F of a motion is not known, until it is reported.
    open: Option<&'static str>,
    /// It was reported since the last FGROUP or FGREF.
    is_reported: bool,
}

impl FeedGroup {
    /// Whether F may be measured along other axes than X, Y and Z.
    pub(crate) fn acts(&self) -> bool {
        self.measured != Measured::Machine || self.radius_mm != [None; 9]
    }

    /// What the program has set, for comparisons.
    pub(crate) fn data(&self) -> Vec<Argument> {
        let axes = match self.measured {
            Measured::Machine => None,
            Measured::Axes(axes) => Some(f64::from(axes)),
            Measured::Unknown => Some(f64::NAN),
        };
        let radii = self.radius_mm.iter().zip(AXIS_LETTERS);
        let radii = radii.filter_map(|(radius, letter)| Some((format!("FGREF {}", char::from(letter)), (*radius)?)));
        axes.map(|axes| ("FGROUP".to_owned(), axes))
            .into_iter()
            .chain(radii)
            .map(|(name, value)| Argument::number(name, value))
            .collect()
    }

    /// Why F was not known in a motion; once.
    pub(crate) fn take_open(&mut self) -> Option<FaultKind> {
        let why = self.open.take().filter(|_| !self.is_reported)?;
        self.is_reported = true;
        Some(FaultKind::NotModelled { what: why.to_owned() })
    }
}

/// The axis of a letter.
fn axis_of(name: &str) -> Option<usize> {
    let letter = |byte: u8| AXIS_LETTERS.iter().position(|letter| byte.eq_ignore_ascii_case(letter));
    match name.trim().as_bytes() {
        [byte] => letter(*byte),
        _ => None,
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `FGREF[A]=10`.
    pub(crate) fn feed_reference(&mut self, index: &[u8], word: &Word) {
        self.words.has_values = true;
        let index = String::from_utf8_lossy(index).into_owned();
        let axis = index
            .strip_prefix('[')
            .and_then(|rest| axis_of(rest.strip_suffix(']')?));
        let value = self.value_of(word);
        if axis.is_none() || value.is_none_or(|value| value < 0.0) {
            self.not_modelled(word.range);
        }
        if let Some(own) = self.own.as_mut() {
            own.feed_group.written.push((axis, value.filter(|value| *value >= 0.0)));
        }
    }
}

/// How far an axis moves, mm or degrees; `None`: not known.
fn moved(motion: &Motion, axis: usize) -> Option<f64> {
    let bit = 1 << axis;
    if motion.end.known & bit == 0 {
        return (motion.says_way & bit == 0 && motion.start.known & bit == 0).then_some(0.0);
    }
    let way = motion.end.values[axis] - motion.start.get(axis)?;
    // an absolute word of a modulo axis may turn the other way
    let sure = ROTARY & bit == 0 || way.abs() <= 180.0 || motion.says_way & bit != 0;
    sure.then_some(way)
}

/// The same arc in its plane.
fn flat(arc: &Arc) -> Arc {
    let height = (arc.end - arc.start).dot(&arc.normal);
    Arc {
        end: arc.end - arc.normal * height,
        ..*arc
    }
}

/// The axes of the plane of an arc, bits as in [`crate::Position::known`]: all three of an arc that is not known; 0: no arc.
fn plane_of(motion: &Motion) -> u16 {
    let arc = match &motion.kind {
        MotionKind::Arc(Some(arc)) => arc,
        MotionKind::Arc(None) => return 0b111,
        _ => return 0,
    };
    (0..3)
        .filter(|&axis| arc.normal[axis] == 0.0)
        .fold(0, |all, axis| all | 1 << axis)
}

/// What F is measured along in a motion.
enum Path {
    /// As the machine does it: along X, Y and Z, or, where only rotary axes turn, in degrees.
    Own,
    /// A path of its own, mm.
    Mm(f64),
    /// Not known.
    Open(&'static str),
}

impl FeedGroup {
    /// The path of a motion in programmed coordinates.
    fn path(&self, motion: &Motion) -> Path {
        let axes = match self.measured {
            Measured::Axes(axes) => axes,
            Measured::Unknown => return Path::Open("FGROUP of an axis without a known letter: what F is"),
            Measured::Machine => {
                let turns = |axis: usize| ROTARY & (1 << axis) != 0 && moved(motion, axis) != Some(0.0);
                let alone = (0..3).all(|axis| moved(motion, axis) == Some(0.0)) && !motion.tcp;
                let referenced = (0..9).any(|axis| self.radius_mm[axis].is_some() && turns(axis));
                return if alone && referenced {
                    Path::Open("FGREF without FGROUP: what F is where only rotary axes turn")
                } else {
                    Path::Own
                };
            }
        };
        let mut ways = [0.0; 9];
        let (mut moving, mut unknown) = (0_u16, 0_u16);
        for (axis, way) in ways.iter_mut().enumerate() {
            match moved(motion, axis) {
                Some(moved) => *way = moved,
                None => unknown |= 1 << axis,
            }
            moving |= u16::from(*way != 0.0) << axis;
        }
        let by_vector = match motion.orientation {
            Orientation::Words => false,
            Orientation::Vector(before, after) => before.is_none_or(|before| (before - after).norm() > 1e-9),
        };
        let turning = axes & ROTARY & (moving | unknown);
        if motion.tcp && axes & ROTARY != 0 && (turning != 0 && motion.great_circle != Some(false) || by_vector) {
            return match self.turn_of_tool(motion, axes) {
                Some(turn) if unknown & axes & LINEAR == 0 => self.length(motion, axes & LINEAR, &ways, turn),
                Some(_) => Path::Open("FGROUP: what F is in a motion whose ends are not known"),
                None => Path::Open(
                    "FGROUP with rotary axes, where the tool turns about its tip neither by ORIAXES nor, with two of them, by \
                     ORIVECT between tool vectors: what F is",
                ),
            };
        }
        let straight = moving | unknown | plane_of(motion);
        let as_machine = |axes: u16| straight & LINEAR & !axes == 0 && straight & LINEAR & !0b111 == 0;
        if as_machine(axes) && turning == 0 && (straight & LINEAR != 0 || straight == 0) {
            return Path::Own;
        }
        if unknown & axes != 0 {
            return Path::Open(
                "FGROUP: what F is in a motion whose ends are not known, or whose rotary axis may turn either way",
            );
        }
        let only_turns = straight & LINEAR == 0 && straight & ROTARY & !axes == 0;
        if only_turns && (0..9).all(|axis| straight & (1 << axis) == 0 || self.radius_mm[axis].is_none()) {
            return Path::Own;
        }
        self.length(motion, axes, &ways, 0.0)
    }

    /// The path of the turn of the tool about its tip in a great circle, mm: its angle at the geometric mean of the radii of the two rotary
    /// axes. Source: Programming Manual, Fundamentals, 11/2006, p. 277, and 07/2010, p. 119 (effective FGREF of a vector interpolation).
    fn turn_of_tool(&self, motion: &Motion, axes: u16) -> Option<f64> {
        let Orientation::Vector(Some(before), after) = motion.orientation else {
            return None;
        };
        let radii: Vec<f64> = (0..9)
            .filter(|axis| axes & ROTARY & (1 << axis) != 0)
            .map(|axis| self.radius_mm[axis].unwrap_or(DEGREE_AS_MM))
            .collect();
        let [first, second] = radii[..] else {
            return None;
        };
        let angle = trunnion_geometry::math::atan2(before.cross(&after).norm(), before.dot(&after));
        (motion.great_circle == Some(true)).then_some(angle * (first * second).sqrt())
    }

    /// Whether no linear axis moves, and a rotary one with an FGREF of its own.
    fn turns_about_radius(&self, motion: &Motion) -> bool {
        let moves = |axis: usize| moved(motion, axis) != Some(0.0);
        let linear = (0..9).any(|axis| LINEAR & (1 << axis) != 0 && moves(axis));
        !linear && !motion.tcp && (0..9).any(|axis| self.radius_mm[axis].is_some() && moves(axis))
    }

    /// The path along these axes, and along the turn of the tool, mm.
    fn length(&self, motion: &Motion, axes: u16, ways: &[f64; 9], turn: f64) -> Path {
        let mut square = turn * turn;
        let mut left = axes;
        if let MotionKind::Arc(arc) = &motion.kind {
            let Some(arc) = arc else {
                return Path::Open("FGROUP: what F is on an arc that is not known");
            };
            let plane = plane_of(motion);
            if plane.count_ones() != 2 || axes & plane != plane && axes & plane != 0 {
                return Path::Open("FGROUP with one axis of an arc: what F is");
            }
            left &= !plane;
            if axes & plane != 0 {
                let round = flat(arc).length();
                square += round * round;
            }
        }
        for axis in (0..9).filter(|axis| left & (1 << axis) != 0) {
            let way = if ROTARY & (1 << axis) != 0 {
                ways[axis].to_radians() * self.radius_mm[axis].unwrap_or(DEGREE_AS_MM)
            } else {
                ways[axis]
            };
            square += way * way;
        }
        let length: f64 = square.sqrt();
        match length {
            length if length.is_nan() => Path::Open("FGREF of a value that is not known: what F is"),
            length if length > 0.0 => Path::Mm(length),
            _ => Path::Open("FGROUP: what F is in a block that moves none of its axes"),
        }
    }
}

impl Iso<'_> {
    /// FGROUP(X,Y,A) and FGROUP().
    pub(crate) fn feed_group(&mut self, found: &Found<'_>, report: &mut Report<'_>) {
        let text = report.program.text(found.range).into_owned();
        let inside = text
            .split_once('(')
            .map(|(_, inside)| inside.trim_end().trim_end_matches(')'));
        let measured = match inside.map(str::trim) {
            None => Measured::Unknown,
            Some("") => Measured::Machine,
            Some(names) => {
                let axes: Option<Vec<usize>> = names.split(',').map(axis_of).collect();
                axes.map_or(Measured::Unknown, |axes| {
                    Measured::Axes(axes.iter().fold(0, |all, axis| all | 1 << axis))
                })
            }
        };
        if measured == Measured::Unknown {
            let what = "FGROUP of an axis without a known letter: what F is".to_owned();
            report.fault(found.range, FaultKind::NotModelled { what });
        }
        if self.core.effects.wanted() {
            let named = |axis: &usize| matches!(measured, Measured::Axes(axes) if axes & (1 << axis) != 0);
            let letters: String = (0..9)
                .filter(named)
                .map(|axis| char::from(AXIS_LETTERS[axis]))
                .collect();
            let to = match measured {
                Measured::Machine => None,
                Measured::Axes(_) => Some(Argument::text("FGROUP", &letters)),
                Measured::Unknown => Some(Argument::text("FGROUP", &text)),
            };
            let block = self.core.main_block(report.block);
            self.core
                .effects
                .add(block, Effect::set("feed group", to.into_iter().collect::<Vec<_>>()));
        }
        let own = &mut self.memory.own;
        own.changes += u64::from(own.feed_group.measured != measured);
        own.feed_group.measured = measured;
        own.feed_group.is_reported = measured == Measured::Unknown;
    }

    /// FGREF of the block, in the unit of lengths in effect.
    pub(crate) fn feed_references(&mut self, report: &Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        for (axis, value) in std::mem::take(&mut self.memory.own.feed_group.written) {
            let radius = value.map_or(f64::NAN, |value| value * unit);
            if self.core.effects.wanted() {
                let letter = axis.map_or('?', |axis| char::from(AXIS_LETTERS[axis]));
                let to = [Argument::number("FGREF", radius)];
                let block = self.core.main_block(report.block);
                self.core
                    .effects
                    .add(block, Effect::set(format!("feed radius {letter}"), to));
            }
            let own = &mut self.memory.own;
            match axis {
                Some(axis) => own.feed_group.radius_mm[axis] = Some(radius),
                None => own.feed_group.radius_mm = [Some(radius); 9],
            }
            own.changes += 1;
            own.feed_group.is_reported = false;
        }
    }

    pub(crate) fn writes_feed_reference(&self) -> bool {
        !self.memory.own.feed_group.written.is_empty()
    }

    /// A motion in programmed coordinates with the feed that FGROUP makes of F.
    pub(crate) fn measured(&mut self, motion: &Motion) -> Motion {
        let thread = matches!(self.core.state.motion, Some(Action::Thread | Action::VariableThread));
        let mut motion = *motion;
        let runs = matches!(motion.kind, MotionKind::Linear | MotionKind::Arc(_));
        let along = matches!(motion.feed, Feed::PerMinute(_) | Feed::PerRevolution(_));
        if !runs || !along || thread {
            return motion;
        }
        let inch = self.core.state.feed.unit_mm();
        let group = &mut self.memory.own.feed_group;
        match (group.path(&motion), motion.feed) {
            (Path::Own, _) => {}
            (Path::Mm(length), Feed::PerMinute(feed)) => {
                // F of a block that only turns was read in degrees
                let unit = if group.turns_about_radius(&motion) { inch } else { 1.0 };
                motion.feed = Feed::InverseTime(feed * unit / length);
            }
            (Path::Mm(_), _) => {
                motion.feed = Feed::Unknown;
                group.open = Some("FGROUP with a feed per revolution: how long the block lasts");
            }
            (Path::Open(why), _) => {
                motion.feed = Feed::Unknown;
                group.open = Some(why);
            }
        }
        motion
    }
}
