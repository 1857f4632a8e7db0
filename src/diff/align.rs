//! Which motion of one program is which of the other: the longest common subsequence of their keys, by Myers' greedy algorithm
//! ("An O(ND) difference algorithm and its variations", 1986), up to a bound of differences.

/// More differences than these are not aligned: time grows with their product with the length, memory with their square.
const MOST: usize = 2000;

/// A range of both programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stretch {
    /// The same: first index in each, and how many.
    Same(usize, usize, usize),
    /// Different: first index and how many in each.
    Different(usize, usize, usize, usize),
}

/// Aligns two lists of keys; `None` where they have more than [`MOST`] differences.
pub(crate) fn align(a: &[u64], b: &[u64]) -> Option<Vec<Stretch>> {
    let head = a.iter().zip(b).take_while(|(x, y)| x == y).count();
    let tail = a[head..]
        .iter()
        .rev()
        .zip(b[head..].iter().rev())
        .take_while(|(x, y)| x == y)
        .count();
    let (inner_a, inner_b) = (&a[head..a.len() - tail], &b[head..b.len() - tail]);
    let mut out = Vec::new();
    push(&mut out, Stretch::Same(0, 0, head));
    for stretch in middle(inner_a, inner_b)? {
        push(
            &mut out,
            match stretch {
                Stretch::Same(x, y, length) => Stretch::Same(x + head, y + head, length),
                Stretch::Different(x, more, y, other) => Stretch::Different(x + head, more, y + head, other),
            },
        );
    }
    push(&mut out, Stretch::Same(a.len() - tail, b.len() - tail, tail));
    Some(out)
}

/// Appends a stretch that is not empty.
fn push(out: &mut Vec<Stretch>, stretch: Stretch) {
    let empty = matches!(stretch, Stretch::Same(_, _, 0) | Stretch::Different(_, 0, _, 0));
    if !empty {
        out.push(stretch);
    }
}

fn middle(a: &[u64], b: &[u64]) -> Option<Vec<Stretch>> {
    if a.is_empty() || b.is_empty() {
        return Some(vec![Stretch::Different(0, a.len(), 0, b.len())]);
    }
    let trace = forward(a, b)?;
    Some(backward(a.len(), b.len(), &trace))
}

/// The farthest x on each diagonal k = x - y for each number of differences; diagonal k of round d stands at `k + d`.
fn forward(a: &[u64], b: &[u64]) -> Option<Vec<Vec<u32>>> {
    let mut trace: Vec<Vec<u32>> = Vec::new();
    for d in 0..=MOST.min(a.len() + b.len()) {
        let mut row = vec![0u32; 2 * d + 1];
        for at in (0..=2 * d).step_by(2) {
            let k = at as i64 - d as i64;
            let mut x = match trace.last() {
                None => 0,
                Some(last) => reached(last, d, k).0,
            } as usize;
            let Some(mut y) = usize::try_from(x as i64 - k).ok() else {
                row[at] = x as u32;
                continue;
            };
            while x < a.len() && y < b.len() && a[x] == b[y] {
                x += 1;
                y += 1;
            }
            row[at] = x as u32;
            if x == a.len() && y == b.len() {
                trace.push(row);
                return Some(trace);
            }
        }
        trace.push(row);
    }
    None
}

/// Where diagonal `k` of round `d` starts, and from which diagonal it came: down (an element of b) or right (one of a).
fn reached(last: &[u32], d: usize, k: i64) -> (u32, i64) {
    let before = |k: i64| {
        let at = k + d as i64 - 1;
        (at >= 0 && (at as usize) < last.len()).then(|| last[at as usize])
    };
    match (before(k - 1), before(k + 1)) {
        (Some(left), Some(right)) if left < right => (right, k + 1),
        (Some(left), _) => (left + 1, k - 1),
        (None, Some(right)) => (right, k + 1),
        (None, None) => (0, k),
    }
}

/// Walks back from the end and collects the stretches.
fn backward(a: usize, b: usize, trace: &[Vec<u32>]) -> Vec<Stretch> {
    let (mut x, mut y) = (a, b);
    // pairs of equal elements as runs, last first
    let mut runs = Vec::new();
    for d in (0..trace.len()).rev() {
        let k = x as i64 - y as i64;
        let (start, from) = if d == 0 { (0, k) } else { reached(&trace[d - 1], d, k) };
        let start = start as usize;
        if x > start {
            runs.push((start, (start as i64 - k) as usize, x - start));
        }
        if d > 0 {
            (x, y) = if from == k - 1 {
                (start - 1, (start as i64 - k) as usize)
            } else {
                (start, (start as i64 - k) as usize - 1)
            };
        }
    }
    let mut out = Vec::new();
    let (mut at_a, mut at_b) = (0, 0);
    for (from_a, from_b, length) in runs.into_iter().rev() {
        push(&mut out, Stretch::Different(at_a, from_a - at_a, at_b, from_b - at_b));
        push(&mut out, Stretch::Same(from_a, from_b, length));
        (at_a, at_b) = (from_a + length, from_b + length);
    }
    push(&mut out, Stretch::Different(at_a, a - at_a, at_b, b - at_b));
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Length of the longest common subsequence, the slow way.
    fn longest(a: &[u64], b: &[u64]) -> usize {
        let mut row = vec![0; b.len() + 1];
        for x in a {
            let mut corner = 0;
            for (at, y) in b.iter().enumerate() {
                let above = row[at + 1];
                row[at + 1] = if x == y { corner + 1 } else { above.max(row[at]) };
                corner = above;
            }
        }
        row[b.len()]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn stretches_cover_both_lists_and_hold_the_longest_common_part(
            a in proptest::collection::vec(0u64..4, 0..40), b in proptest::collection::vec(0u64..4, 0..40)
        ) {
            let (mut at_a, mut at_b, mut same) = (0, 0, 0);
            for stretch in align(&a, &b).unwrap() {
                match stretch {
                    Stretch::Same(x, y, length) => {
                        prop_assert_eq!((x, y), (at_a, at_b));
                        prop_assert_eq!(&a[x..x + length], &b[y..y + length]);
                        (at_a, at_b, same) = (x + length, y + length, same + length);
                    }
                    Stretch::Different(x, more, y, other) => {
                        prop_assert_eq!((x, y), (at_a, at_b));
                        (at_a, at_b) = (x + more, y + other);
                    }
                }
            }
            prop_assert_eq!((at_a, at_b), (a.len(), b.len()));
            prop_assert_eq!(same, longest(&a, &b));
        }
    }

    #[test]
    fn lists_without_anything_in_common_are_given_up() {
        let a: Vec<u64> = (0..5000).collect();
        let b: Vec<u64> = (10_000..15_000).collect();
        assert_eq!(align(&a, &b), None);
        assert_eq!(align(&a, &[]), Some(vec![Stretch::Different(0, 5000, 0, 0)]));
    }
}
