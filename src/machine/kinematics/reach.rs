//! Which tool axes a machine reaches, in words: the cone, the pole, and how many postures each tilt has inside the travels.
use crate::file::text::{direction, number};
use crate::{Limits, Machine, Orientations, orientations, windings};
use trunnion_geometry::math::{atan2, rotate};
use trunnion_geometry::{Vec3, deg, rad};

/// The cone of tool axes that the geometry allows, and the part of it inside the travel of the second rotary axis.
pub(crate) fn reach(machine: &Machine) -> String {
    let constants = &machine.constants;
    let Some(pair) = &constants.pair else {
        let home = direction(&machine.tool_axis);
        return match constants.rotary_count {
            0 => format!("the tool axis is always {home}"),
            _ => format!(
                "the cone that {home} sweeps around {}",
                direction(&constants.rotary[0].direction)
            ),
        };
    };
    let first = direction(&constants.rotary[0].direction);
    let whole = if pair.reach_min < 1e-9 && pair.reach_max > core::f64::consts::PI - 1e-9 {
        "every direction".to_owned()
    } else {
        format!(
            "tool axes {} to {} deg from {first}",
            number(deg(pair.reach_min)),
            number(deg(pair.reach_max))
        )
    };
    let second = &machine.axes[constants.rotary[1].joint];
    let Limits::Range(min, max) = second.limits else {
        return whole;
    };
    let [low, high] = legal_cone(machine, [min, max]);
    format!(
        "{whole} by geometry; within the travel of {}: {} to {} deg from {first}",
        char::from(second.letter),
        number(deg(low)),
        number(deg(high))
    )
}

/// Smallest and largest angle between tool axis and first rotary axis while the second rotary axis runs over its travel, rad.
fn legal_cone(machine: &Machine, [min, max]: [f64; 2]) -> [f64; 2] {
    let constants = &machine.constants;
    let e1 = constants.rotary[0].direction;
    let angle = |q2: f64| {
        let axis = crate::tool_axis_at(machine, [0.0, q2]);
        atan2(e1.cross(&axis).norm(), e1.dot(&axis))
    };
    let azimuth = constants.pair.as_ref().map_or(0.0, |pair| pair.k_azimuth) * constants.rotary[1].sign;
    // the angle is extreme at the ends and where S = 0: at q2 = k pi - azimuth; one turn holds them all
    let pi = core::f64::consts::PI;
    let first = ((min + azimuth) / pi).ceil();
    let inside = (0..3)
        .map(|k| (first + f64::from(k)) * pi - azimuth)
        .filter(|&q2| q2 <= max);
    let angles = [min, max].into_iter().chain(inside).map(angle);
    angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], a| {
        [low.min(a), high.max(a)]
    })
}

pub(crate) fn pole(machine: &Machine) -> String {
    let constants = &machine.constants;
    if constants.pair.is_none() {
        return String::new();
    }
    let [first, second] = constants
        .rotary
        .map(|rotary| char::from(machine.axes[rotary.joint].letter));
    let e1 = constants.rotary[0].direction;
    let ends: Vec<String> = [e1, -e1]
        .iter()
        .filter_map(|end| match orientations(machine, end) {
            Orientations::Pole(q2) => {
                let legal = !windings(machine, constants.rotary[1].joint, q2, 0.0).is_empty();
                let outside = if legal { "" } else { ", outside its travel" };
                Some(format!(
                    "{} ({second} = {} deg{outside})",
                    direction(end),
                    number(deg(q2))
                ))
            }
            _ => None,
        })
        .collect();
    if ends.is_empty() {
        return format!("none: the tool is never parallel to the axis of {first}");
    }
    format!(
        "{first} is free where the tool is parallel to {}; near it, {first} must turn fast",
        ends.join(" or ")
    )
}

/// How many postures inside the travels the tilts from the first rotary axis have, whole degrees, as ranges in words; empty for machines
/// with fewer than two rotary axes. For a tilt the smallest and largest number among its azimuths are given, every 15 deg.
pub(crate) fn postures_by_tilt(machine: &Machine) -> Vec<String> {
    if machine.constants.pair.is_none() {
        return Vec::new();
    }
    let e1 = machine.constants.rotary[0].direction;
    let across = e1
        .cross(&if e1.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() })
        .normalize();
    let mut ranges: Vec<(u32, u32, [usize; 2])> = Vec::new();
    // half degrees avoid the pole and the edges of the reach
    for tilt in 0..180_u32 {
        let tilted = rotate(&across, rad(f64::from(tilt) + 0.5), &e1);
        let counts =
            (0..24).map(|step| legal_postures(machine, &rotate(&e1, rad(f64::from(step) * 15.0 + 0.5), &tilted)));
        let bounds = counts.fold([usize::MAX, 0], |[low, high], count| [low.min(count), high.max(count)]);
        match ranges.last_mut() {
            Some((_, end, known)) if *known == bounds => *end = tilt + 1,
            _ => ranges.push((tilt, tilt + 1, bounds)),
        }
    }
    let words = |[low, high]: [usize; 2]| match (low, high) {
        (0, 0) => "none".to_owned(),
        (low, high) if low == high => low.to_string(),
        (low, high) => format!("{low} to {high}, by azimuth"),
    };
    ranges
        .into_iter()
        .map(|(from, to, bounds)| format!("{from} to {to} deg: {}", words(bounds)))
        .collect()
}

/// Postures whose rotary values have a winding inside the travels.
fn legal_postures(machine: &Machine, axis: &Vec3) -> usize {
    let Orientations::Postures(postures) = orientations(machine, axis) else {
        return 0;
    };
    let legal = |q: &[f64; 2]| {
        let rotary = machine.constants.rotary();
        rotary
            .iter()
            .zip(q)
            .all(|(rotary, value)| !windings(machine, rotary.joint, *value, 0.0).is_empty())
    };
    postures.iter().filter(|posture| legal(&posture.q)).count()
}
