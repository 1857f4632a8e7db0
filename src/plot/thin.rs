//! Fewer points for the same line: invisible points are left out, so that a picture of a million blocks stays small.

/// How far a point that is left out may be from the line, in tenths of a pixel.
const UNSEEN: f64 = 2.5;

/// How often a point is looked at, on average, before the line is cut into [`PIECE`]s. A line that is halved each time needs no more than
/// this up to a million points; one that zigzags loses one point a time, and would need half its length.
const LOOKS: usize = 40;

/// A piece of such a line, points.
const PIECE: usize = 64;

/// The points of a polyline (in tenths of a pixel) that are needed to draw it (Douglas and Peucker, 1973). Ends stay; points that are not
/// numbers are dropped.
pub(crate) fn thin(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    counted(points).0
}

/// Width of a column, tenths of a pixel: of a line from left to right no more than four points of a column are seen.
pub(crate) const COLUMN: f64 = 10.0;

/// The first, lowest, highest and last point of each column, in their order, of a line that only goes from left to right.
fn columns(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    if points.len() < 3 || points.windows(2).any(|two| two[1].0 < two[0].0) {
        return points;
    }
    let column = |point: &(f64, f64)| (point.0 / COLUMN).floor();
    let mut kept = Vec::new();
    for piece in points.chunk_by(|a, b| column(a) == column(b)) {
        let mut lowest = 0;
        let mut highest = 0;
        for (at, point) in piece.iter().enumerate() {
            if point.1 < piece[lowest].1 {
                lowest = at;
            }
            if point.1 > piece[highest].1 {
                highest = at;
            }
        }
        let mut own = [0, lowest, highest, piece.len() - 1];
        own.sort_unstable();
        let mut before = None;
        for at in own {
            if before.replace(at) != Some(at) {
                kept.push(piece[at]);
            }
        }
    }
    kept
}

/// [`thin`], and how many distances it computed.
fn counted(points: &[(f64, f64)]) -> (Vec<(f64, f64)>, usize) {
    let points: Vec<(f64, f64)> = points
        .iter()
        .copied()
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect();
    let points = columns(points);
    if points.len() < 3 {
        return (points, 0);
    }
    let mut keep = vec![false; points.len()];
    let last = points.len() - 1;
    (keep[0], keep[last]) = (true, true);
    let (mut looks, most) = (0, points.len() * LOOKS);
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        if looks > most && to - from > PIECE {
            // the cuts stay as points: the line is as true as before, and perhaps longer than it need be
            for start in (from..to).step_by(PIECE) {
                keep[start] = true;
                open.push((start, to.min(start + PIECE)));
            }
            continue;
        }
        let (mut worst, mut at) = (UNSEEN, None);
        looks += to - from;
        for i in from + 1..to {
            let off = distance(points[i], points[from], points[to]);
            if off > worst {
                (worst, at) = (off, Some(i));
            }
        }
        if let Some(at) = at {
            keep[at] = true;
            open.extend([(from, at), (at, to)]);
        }
    }
    let kept = points.iter().zip(keep).filter(|(_, keep)| *keep);
    (kept.map(|(point, _)| *point).collect(), looks)
}

/// Distance of a point from a segment.
fn distance(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> f64 {
    let (way, off) = ((b.0 - a.0, b.1 - a.1), (p.0 - a.0, p.1 - a.1));
    let length2 = way.0 * way.0 + way.1 * way.1;
    let share = if length2 > 0.0 {
        ((off.0 * way.0 + off.1 * way.1) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (x, y) = (off.0 - way.0 * share, off.1 - way.1 * share);
    (x * x + y * y).sqrt()
}

/// The part of a segment inside a field of this size (Liang and Barsky, 1984).
pub(crate) fn clip(a: (f64, f64), b: (f64, f64), (width, height): (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-dx, a.0), (dx, width - a.0), (-dy, a.1), (dy, height - a.1)] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            from = from.max(q / p);
        } else {
            to = to.min(q / p);
        }
    }
    let at = |t: f64| {
        if t == 0.0 {
            a
        } else if t == 1.0 {
            b
        } else {
            (a.0 + dx * t, a.1 + dy * t)
        }
    };
    (from <= to).then(|| (at(from), at(to)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_runs_vanish_and_spikes_stay() {
        let mut points: Vec<(f64, f64)> = (0..1000).map(|i| (f64::from(i), 0.001 * f64::from(i))).collect();
        assert_eq!(thin(&points).len(), 2);
        points[500].1 = 300.0;
        points[700].1 = f64::NAN;
        let thinned = thin(&points);
        assert!(thinned.contains(&(500.0, 300.0)) && thinned.len() < 8, "{thinned:?}");
    }

    /// Stairs of a million blocks are as wide as the picture, and no peak is lost.
    #[test]
    fn a_line_from_left_to_right_is_as_long_as_the_picture_is_wide() {
        let count = 200_000;
        let stairs = |i: i32| {
            let height = if i == 100_001 {
                7000.0
            } else {
                f64::from(i * 7919 % 1000)
            };
            (f64::from(i / 2) * 12_000.0 / f64::from(count / 2), height)
        };
        let stairs: Vec<(f64, f64)> = (0..count).map(stairs).collect();
        let thinned = thin(&stairs);
        assert!(thinned.len() <= 4 * 1201, "{} points", thinned.len());
        assert!(thinned.iter().any(|point| point.1 == 7000.0));
        assert_eq!((thinned[0], thinned.last()), (stairs[0], stairs.last()));
    }

    #[test]
    fn a_zigzag_costs_no_more_than_its_length() {
        let count = 100_000;
        // downwards, so that no column of it is as wide as a pixel
        let zigzag: Vec<(f64, f64)> = (0..count)
            .map(|i| {
                (
                    if i % 2 == 0 { 0.0 } else { 5000.0 - 1e-3 * f64::from(i) },
                    f64::from(i),
                )
            })
            .collect();
        let (thinned, looks) = counted(&zigzag);
        assert!(thinned.len() > zigzag.len() / 4, "{} points", thinned.len());
        assert!(looks < 100 * zigzag.len(), "{looks} distances of {count} points");
    }
}
