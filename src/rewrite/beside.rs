//! Fewer pieces where they need not meet at the points of a chain: each point has lanes beside it in which pieces may meet.
//!
//! Lane 0 is the point itself. That a longer piece fits where a shorter one does not is rare with arcs, so the farthest point is found by doubling steps and
//! halving, and of each layer only the farthest points in each lane are kept.

/// A point and its lane.
pub(crate) type Gate = (usize, usize);

/// So many of the farthest points in each lane begin the next layer: more save nothing on curves.
const KEPT: usize = 1;

/// The gates of a division of `0..=last` into at most `most` pieces, both ends included, both in lane 0; `None` where none was found.
pub(crate) fn fewest_beside(
    last: usize,
    lanes: usize,
    most: usize,
    fits: &mut impl FnMut(Gate, Gate) -> bool,
) -> Option<Vec<Gate>> {
    const NONE: u32 = u32::MAX;
    let slot = |(index, lane): Gate| index * lanes + lane;
    let mut from = vec![NONE; (last + 1) * lanes];
    let mut layer: Vec<Gate> = vec![(0, 0)];
    for _ in 0..most {
        let mut next: Vec<Gate> = Vec::new();
        let mut farthest = vec![0; lanes];
        for &start in &layer {
            for (lane, farthest) in farthest.iter_mut().enumerate() {
                let end = if lane == 0 { last } else { last - 1 };
                let reached = (*farthest).max(start.0);
                let mut near = reached;
                // no arc has one line only
                let mut step = if reached < end && fits(start, (reached + 1, lane)) {
                    1
                } else {
                    2
                };
                // doubling, then halving
                while near + step <= end && fits(start, (near + step, lane)) {
                    near += step;
                    step *= 2;
                }
                while step > 1 {
                    step /= 2;
                    if near + step <= end && fits(start, (near + step, lane)) {
                        near += step;
                    }
                }
                if near == reached {
                    continue;
                }
                *farthest = near;
                for index in (reached + 1..=near).rev().take(KEPT) {
                    let gate = (index, lane);
                    if from[slot(gate)] == NONE && (index == near || fits(start, gate)) {
                        from[slot(gate)] = slot(start) as u32;
                        next.push(gate);
                    }
                }
            }
        }
        if from[slot((last, 0))] != NONE {
            let mut gates = vec![(last, 0)];
            while let Some(&at) = gates.last().filter(|at| **at != (0, 0)) {
                let before = from[slot(at)] as usize;
                gates.push((before / lanes, before % lanes));
            }
            gates.reverse();
            return Some(gates);
        }
        next.retain(|(index, lane)| index + KEPT > farthest[*lane]);
        next.sort_unstable_by_key(|(index, lane)| (core::cmp::Reverse(*index), *lane));
        layer = next;
        if layer.is_empty() {
            return None;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::fewest_beside;

    #[test]
    fn lanes_are_taken_where_they_save_a_piece() {
        // from lane 1 pieces reach 4 points, else 3: 0-3-6-9-10 takes four in lane 0
        let mut fits = |(i, from): (usize, usize), (j, _): (usize, usize)| j - i <= if from == 1 { 4 } else { 3 };
        assert_eq!(fewest_beside(10, 1, 9, &mut fits).map(|gates| gates.len()), Some(5));
        let found = fewest_beside(10, 2, 3, &mut fits).expect("three pieces");
        assert_eq!((found.first(), found.last()), (Some(&(0, 0)), Some(&(10, 0))));
        assert!(found.len() == 4 && found[1].1 == 1, "{found:?}");
        assert_eq!(fewest_beside(10, 2, 2, &mut fits), None);
    }
}
