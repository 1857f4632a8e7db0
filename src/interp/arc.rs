//! Arcs of a block: centre form and radius form, in the three planes.
use crate::{FaultKind, Position, words::Words};
use trunnion_dialect::{Dialect, Plane};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::{Arc, RadiusFault, Turning};

/// Ends of an arc that are nearer to each other are one place: half of the finest step of words, 0.00001 mm. One of them may have been computed.
pub(crate) const ONE_PLACE_MM: f64 = 5e-6;

/// Axes of a plane in [`crate::AXIS_LETTERS`]: first, second, normal. Seen from the normal's positive end the second axis is
/// a quarter turn counter-clockwise from the first.
pub(crate) fn plane_axes(plane: Plane) -> [usize; 3] {
    match plane {
        Plane::Xy => [0, 1, 2],
        Plane::Zx => [2, 0, 1],
        Plane::Yz => [1, 2, 0],
    }
}

/// What defines an arc in addition to the words of its block.
pub(crate) struct ArcSetting<'a> {
    pub(crate) dialect: &'a Dialect,
    pub(crate) plane: Plane,
    pub(crate) turning: Turning,
    /// I J K are coordinates unless a word says otherwise.
    pub(crate) centre_absolute: bool,
    pub(crate) length_unit_mm: f64,
    pub(crate) start: Position,
    pub(crate) end: Position,
    /// Further full turns; `None`: unknown.
    pub(crate) turns: Option<u32>,
    /// X is that of a lathe.
    pub(crate) lathe: bool,
}

/// An arc, as far as it is known, and what is wrong with it.
pub(crate) type Outcome = (Option<Arc>, Option<FaultKind>);

/// The arc of a block; no arc and no fault where the start, the end or the centre is not known.
pub(crate) fn arc(setting: &ArcSetting<'_>, words: &Words) -> Outcome {
    let axes = plane_axes(setting.plane);
    let by_centre = axes[..2]
        .iter()
        .any(|&axis| (words.centre.given | words.centre.unread) & (1 << axis) != 0);
    match (words.radius.is_given(), by_centre) {
        (true, true) => (
            None,
            Some(FaultKind::NotModelled {
                what: "R together with I, J, K".to_owned(),
            }),
        ),
        (true, false) => by_radius(setting, words, axes),
        (false, true) => by_centre_words(setting, words, axes),
        (false, false) => (None, Some(FaultKind::ArcCentreMissing)),
    }
}

/// Start and end in space. A height that is unknown is taken as 0, and then the flag is false: the arc is valid only in its plane. That is
/// enough on a lathe, where no word of a block moves Y: both ends have the same.
fn ends(setting: &ArcSetting<'_>, axes: [usize; 3]) -> Option<(Vec3, Vec3, bool)> {
    let plane = (1u16 << axes[0]) | (1 << axes[1]);
    if setting.start.known & setting.end.known & plane != plane {
        return None;
    }
    let (mut start, mut end) = (Vec3::zeros(), Vec3::zeros());
    for axis in 0..3 {
        start[axis] = setting.start.get(axis).unwrap_or(0.0);
        end[axis] = setting.end.get(axis).unwrap_or(0.0);
    }
    let height = 1u16 << axes[2];
    let level = setting.lathe && axes[2] == 1 && (setting.start.known | setting.end.known) & height == 0;
    let whole = setting.start.xyz().is_some() && setting.end.xyz().is_some();
    Some((start, end, whole || level))
}

fn normal(axes: [usize; 3]) -> Vec3 {
    let mut normal = Vec3::zeros();
    normal[axes[2]] = 1.0;
    normal
}

fn by_centre_words(setting: &ArcSetting<'_>, words: &Words, axes: [usize; 3]) -> Outcome {
    let mut centre = Vec3::zeros();
    // the point that the words give as coordinates, where they are distances
    let mut read_as_coordinates = Some(Vec3::zeros());
    for &axis in &axes[..2] {
        let bit = 1 << axis;
        if words.centre.unread & bit != 0 {
            return (None, None);
        }
        let absolute =
            words.centre.absolute & bit != 0 || (setting.centre_absolute && words.centre.incremental & bit == 0);
        let value = words.centre.get(axis).map(|value| value * setting.length_unit_mm);
        read_as_coordinates = read_as_coordinates
            .zip(value.filter(|_| !absolute))
            .map(|(mut point, value)| {
                point[axis] = value;
                point
            });
        centre[axis] = match (value, absolute) {
            (Some(value), true) => value,
            (None, true) => return (None, Some(FaultKind::ArcCentreMissing)),
            (value, false) => match setting.start.get(axis) {
                Some(start) => start + value.unwrap_or(0.0),
                None => return (None, None),
            },
        };
    }
    let Some((start, end, whole)) = ends(setting, axes) else {
        return (None, None);
    };
    let Some(turns) = setting.turns else {
        return (None, None);
    };
    let with_centre = |centre| {
        let arc = Arc::from_centre(start, end, centre, normal(axes), setting.turning, turns);
        arc.map(|arc| arc.closed_within(ONE_PLACE_MM))
    };
    let wrong = |arc: &Arc| mismatch(arc, setting.dialect, setting.length_unit_mm);
    let fits_absolute = || {
        let other = read_as_coordinates.and_then(with_centre);
        other.is_some_and(|arc| arc.radius_start > 0.0 && wrong(&arc).is_none())
    };
    let Some(arc) = with_centre(centre) else {
        let kind = if fits_absolute() {
            let in_plane = |axis: &usize| (end[*axis] - start[*axis]).powi(2);
            let chord = axes[..2].iter().map(in_plane).sum::<f64>().sqrt();
            FaultKind::ArcFitsAbsolute { start: 0.0, end: chord }
        } else {
            FaultKind::ArcCentreMissing
        };
        return (None, Some(kind));
    };
    let fault = wrong(&arc).map(|kind| {
        if fits_absolute() {
            let (start, end) = (arc.radius_start, arc.radius_end);
            FaultKind::ArcFitsAbsolute { start, end }
        } else {
            kind
        }
    });
    (whole.then_some(arc), fault)
}

/// Whether the two radii of an arc differ by more than the dialect allows.
pub(crate) fn mismatch(arc: &Arc, dialect: &Dialect, length_unit_mm: f64) -> Option<FaultKind> {
    let (start, end) = (arc.radius_start, arc.radius_end);
    let tolerance = dialect.arc_limit_mm(start.max(end), length_unit_mm != 1.0);
    ((start - end).abs() > tolerance).then_some(FaultKind::ArcRadiusMismatch { start, end, tolerance })
}

/// The arc of a given radius: positive the one below half a turn, negative the one above.
fn by_radius(setting: &ArcSetting<'_>, words: &Words, axes: [usize; 3]) -> Outcome {
    let Some(number) = words.radius.number() else {
        return (None, None);
    };
    let Some((start, end, whole)) = ends(setting, axes) else {
        return (None, None);
    };
    let radius = number.value * setting.length_unit_mm;
    let tolerance = setting
        .dialect
        .arc_limit_mm(radius.abs(), setting.length_unit_mm != 1.0);
    match Arc::from_radius(start, end, radius, normal(axes), setting.turning, tolerance) {
        Ok(mut arc) => {
            let Some(turns) = setting.turns else {
                return (None, None);
            };
            arc.sweep += arc.sweep.signum() * f64::from(turns) * core::f64::consts::TAU;
            (whole.then_some(arc), None)
        }
        Err(RadiusFault::SamePoint) => (None, Some(FaultKind::ArcCentreMissing)),
        Err(RadiusFault::TooSmall(half_chord)) => (None, Some(FaultKind::ArcRadiusTooSmall { radius, half_chord })),
    }
}
