//! The fewest pieces of a chain: the shortest path over its points, layer by layer.

/// So many points after the last one that can be reached are tried too: one piece may fit where a shorter one with the same start does not. Where
/// a piece has many points they lie densely, and that is rare.
fn ahead(points: usize) -> usize {
    match points {
        0..=16 => 32,
        17..=64 => 8,
        _ => 3,
    }
}

/// The joints of a division of `0..=last` into the fewest pieces, both ends included. `fits(i, j)` says whether the part from `i` to `j` is
/// one piece; `fits(i, i + 1)` must be true.
pub(crate) fn fewest(last: usize, fits: &mut impl FnMut(usize, usize) -> bool) -> Vec<usize> {
    const NONE: usize = usize::MAX;
    let mut from = vec![NONE; last + 1];
    from[0] = 0;
    // the first point that is not reached yet
    let mut open = 1;
    let mut layer = vec![0];
    while from[last] == NONE {
        let mut next = Vec::new();
        // the farthest start first: it decides how far the layer reaches
        for &i in layer.iter().rev() {
            let mut failed = 0;
            let mut j = open.max(i + 1);
            while j <= last {
                if from[j] == NONE {
                    if fits(i, j) {
                        failed = 0;
                        from[j] = i;
                        next.push(j);
                    } else {
                        failed += 1;
                        if failed > ahead(j - i) {
                            break;
                        }
                    }
                }
                j += 1;
            }
            while open <= last && from[open] != NONE {
                open += 1;
            }
        }
        next.sort_unstable();
        layer = next;
    }
    let mut joints = vec![last];
    while let Some(&at) = joints.last().filter(|at| **at > 0) {
        joints.push(from[at]);
    }
    joints.reverse();
    joints
}

#[cfg(test)]
mod tests {
    use super::fewest;

    #[test]
    fn it_finds_what_a_greedy_choice_misses() {
        // pieces of at most 3, but from 3 only single steps: 0-2-5-8 takes three, the greedy 0-3-4-7-8 four
        let mut fits = |i: usize, j: usize| j == i + 1 || j - i <= 3 && i != 3;
        assert_eq!(fewest(8, &mut fits).len() - 1, 3);
        // a long piece may fit where a shorter one does not
        let mut holes = |i: usize, j: usize| j == i + 1 || i == 0 && j == 9;
        assert_eq!(fewest(10, &mut holes), [0, 9, 10]);
    }

    #[test]
    fn single_steps_are_the_way_out() {
        assert_eq!(fewest(3, &mut |i, j| j == i + 1), [0, 1, 2, 3]);
    }
}
