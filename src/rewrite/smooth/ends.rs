//! What may be chosen at the ends of a chain.
use super::chain::Station;
use crate::survey::Point;

/// Whether posture and turns of each end of a chain are free: the motions that share its position are straight and guided by tool centre
/// point control, and beyond them is a rapid that turns the rotary axes there, or nothing.
pub(crate) fn free_ends(points: &[Point], stations: &[Station]) -> [bool; 2] {
    let (Some(first), Some(last)) = (stations.first(), stations.last()) else {
        return [false; 2];
    };
    [
        follows_words(&points[first.first]) && reached_by_rapid(points, first.first),
        left_by_rapid(points, last.last),
    ]
}

/// The motions that keep the position of the rotary axes at the start of a chain: the first of them.
pub(crate) fn lead_in(points: &[Point], mut first: usize) -> usize {
    while first > 0 && points[first].rotary_change == [0.0; 2] && points[first].from_known {
        first -= 1;
    }
    first
}

/// The motions that keep the position of the rotary axes at the end of a chain: one past the last of them.
pub(crate) fn lead_out(points: &[Point], last: usize) -> usize {
    let rest = points[last + 1..].iter();
    last + 1
        + rest
            .take_while(|point| point.rotary_change == [0.0; 2] && point.end.is_ok())
            .count()
}

fn reached_by_rapid(points: &[Point], first: usize) -> bool {
    let start = lead_in(points, first);
    let shared = points[start..=first].iter().all(follows_words);
    // the rapid starts where it started before
    let from = start == 0 || points[start - 1].end.is_ok() && points[start].from_known;
    shared && points[start].rapid && from
}

fn left_by_rapid(points: &[Point], last: usize) -> bool {
    let next = lead_out(points, last);
    points[last + 1..next].iter().all(follows_words)
        && points
            .get(next)
            .is_none_or(|point| point.rapid && follows_words(point) && point.from_known)
}

/// The motion can be written for another posture by its rotary words alone.
fn follows_words(point: &Point) -> bool {
    point.tcp
        && !point.vector
        && !point.incremental
        && (point.rapid || point.linear)
        && point.end.is_ok()
        && !point.machine_coordinates
}
