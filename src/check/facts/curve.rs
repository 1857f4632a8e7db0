//! Curves, which are followed as lines that they leave by a known amount.
use super::over_view;
use crate::look::Look;
use crate::view::LegView;
use trunnion_geometry::Mat3;
use trunnion_machine::{Axis, AxisKind, Limits, Machine};

/// A piece of a curve where it matters that it is followed as a line: what the line does is judged, and the curve may do something else.
pub(crate) struct Curved<'v> {
    view: &'v LegView<'v>,
    pub(crate) why: Margin,
}
over_view!(Curved);

/// What the line does not decide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Margin {
    /// A joint is nearer to the end of its travel than the curve may be to the line.
    Travel(usize),
    /// A joint that cannot follow the programmed feed is slow enough along the line; the curve may turn into its direction.
    Speed(usize),
}

impl<'v> Curved<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leg.motion.slack_mm > 0.0
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let why = margin(view)?;
        Some(Self { view, why })
    }
}

fn margin(view: &LegView<'_>) -> Option<Margin> {
    let slack = view.motion().slack_mm;
    let (start, end) = view.stances().filter(|_| slack > 0.0)?;
    // X Y Z are the joints themselves, except in a tilted plane
    let growth = if view.motion().tilt.normal.is_some() || view.leads_tip() {
        most_growth(view.machine)
    } else {
        1.0
    };
    let slack = slack * growth;
    let near = |joint: usize, axis: &Axis| {
        let Limits::Range(low, high) = axis.limits else {
            return false;
        };
        let inside = |at: f64| (0.0..slack).contains(&(high - at)) || (0.0..slack).contains(&(at - low));
        inside(start.joints[joint]) || inside(end.joints[joint])
    };
    let feed = view.programmed_feed().unwrap_or(0.0);
    let linear = view.machine.axes.iter().enumerate();
    linear
        .filter(|(_, axis)| axis.kind == AxisKind::Linear)
        .find_map(|(joint, axis)| {
            if near(joint, axis) && !view.rests_on_undeclared(joint) {
                return Some(Margin::Travel(joint));
            }
            let moves = start.joints[joint] != end.joints[joint];
            let slow = axis.max_speed.is_some_and(|most| growth * feed > 60.0 * most);
            (moves && slow).then_some(Margin::Speed(joint))
        })
}

/// By how much a short way of the tip may grow to that of a linear joint: 1 where the linear axes are square to each other.
fn most_growth(machine: &Machine) -> f64 {
    let mut linear = machine.axes.iter().filter(|axis| axis.kind == AxisKind::Linear);
    let (Some(x), Some(y), Some(z), None) = (linear.next(), linear.next(), linear.next(), linear.next()) else {
        return f64::INFINITY;
    };
    let columns = Mat3::from_columns(&[x.direction, y.direction, z.direction]);
    let inverse = columns.try_inverse();
    inverse.map_or(f64::INFINITY, |inverse| {
        (0..3).map(|row| inverse.row(row).norm()).fold(0.0, f64::max)
    })
}
