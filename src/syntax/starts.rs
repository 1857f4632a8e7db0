//! Where tokens start, in little more than one byte each.
//!
//! Fresh memory costs more than what is written there, and a start needs four bytes only in a long file. So sixteen neighbours share one
//! start in full, that of the first of them, and each keeps how far after it stands. Where that is more than a byte holds (long
//! comments) the sixteen are kept in full elsewhere. Either way a start is found in a fixed number of steps.

/// This many neighbours share one full start.
const GROUP: usize = 16;
/// What the first token of a group keeps where the group is wide; it keeps 0 otherwise.
const WIDE: u8 = 1;

/// Start offsets that never go down.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Starts {
    /// Of each token, how far it comes after the first one of its group, bytes; of a wide group, [`WIDE`] and zeros.
    behind: Vec<u8>,
    /// Of each group, where its first token starts; of a wide one, its place in `wide`.
    groups: Vec<u32>,
    /// The starts of groups with distances above a byte, zeros after the last.
    wide: Vec<[u32; GROUP]>,
}

impl Starts {
    /// Makes room for this many more.
    pub(crate) fn reserve(&mut self, count: usize) {
        self.behind.reserve(count);
        self.groups.reserve(count / GROUP + 1);
    }
    /// How many there are.
    fn len(&self) -> usize {
        self.behind.len()
    }
    /// Memory in use, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.behind.len() + size_of_val(&*self.groups) + size_of_val(&*self.wide)
    }
    /// Start number `at`. It must be there.
    #[inline]
    pub(crate) fn get(&self, at: usize) -> u32 {
        let group = self.groups[at / GROUP];
        if self.behind[at / GROUP * GROUP] == WIDE {
            self.wide[group as usize][at % GROUP]
        } else {
            group + u32::from(self.behind[at])
        }
    }
    /// Adds one.
    #[inline]
    pub(crate) fn push(&mut self, start: u32) {
        let within = self.len() % GROUP;
        let group = self.groups.last().copied().unwrap_or_default();
        if within == 0 {
            self.groups.push(start);
            self.behind.push(0);
        } else if let Ok(behind) = u8::try_from(start.wrapping_sub(group))
            && self.behind[self.len() - within] != WIDE
        {
            self.behind.push(behind);
        } else {
            self.push_wide(within, start);
        }
    }
    /// Adds number `within` of a group that is wide, at the latest from now on.
    #[cold]
    fn push_wide(&mut self, within: usize, start: u32) {
        let first = self.len() - within;
        if self.behind[first] != WIDE {
            let mut starts = [0; GROUP];
            for (at, own) in starts[..within].iter_mut().enumerate() {
                *own = self.get(first + at);
            }
            self.set_group(self.wide.len() as u32);
            self.wide.push(starts);
            self.behind[first..].fill(0);
            self.behind[first] = WIDE;
        }
        if let Some(starts) = self.wide.last_mut() {
            starts[within] = start;
        }
        self.behind.push(0);
    }
    /// Changes the stored last group.
    fn set_group(&mut self, to: u32) {
        if let Some(group) = self.groups.last_mut() {
            *group = to;
        }
    }
    /// Takes the last one away.
    pub(crate) fn pop(&mut self) {
        let Some(at) = self.len().checked_sub(1) else { return };
        let (first, within) = (at / GROUP * GROUP, at % GROUP);
        if within == 0 {
            self.groups.pop();
        } else if self.behind[first] == WIDE
            && let Some(mut starts) = self.wide.pop()
        {
            // the rest of the group may be narrow, and is stored as if it had never been wide
            starts[within] = 0;
            self.behind.truncate(first);
            self.groups.pop();
            self.extend(&starts[..within]);
            return;
        }
        self.behind.pop();
    }
    /// Adds some.
    pub(crate) fn extend(&mut self, starts: &[u32]) {
        let room = self.len().next_multiple_of(GROUP) - self.len();
        let (head, rest) = starts.split_at(room.min(starts.len()));
        for &start in head {
            self.push(start);
        }
        let (groups, tail) = rest.as_chunks::<GROUP>();
        for group in groups {
            self.push_group(group);
        }
        for &start in tail {
            self.push(start);
        }
    }
    /// Adds a whole group after whole groups.
    #[inline]
    fn push_group(&mut self, starts: &[u32; GROUP]) {
        let first = starts[0];
        if starts[GROUP - 1].wrapping_sub(first) > u32::from(u8::MAX) {
            for &start in starts {
                self.push(start);
            }
            return;
        }
        self.groups.push(first);
        self.behind
            .extend_from_slice(&starts.map(|start| start.wrapping_sub(first) as u8));
    }
    /// Adds those of another table from number `from` to before `to`, each moved by this many bytes (wrapping).
    pub(crate) fn extend_moved(&mut self, other: &Self, from: usize, to: usize, by: u32) {
        let mut at = from;
        while at < to {
            let end = ((at / GROUP + 1) * GROUP).min(to);
            let mut starts = [0; GROUP];
            let some = &mut starts[..end - at];
            other.copy_group(at, some);
            for start in &mut *some {
                *start = start.wrapping_add(by);
            }
            self.extend(some);
            at = end;
        }
    }
    /// The starts from number `at` on, all of one group.
    #[inline]
    fn copy_group(&self, at: usize, into: &mut [u32]) {
        let (group, within) = (self.groups[at / GROUP], at % GROUP);
        if self.behind[at - within] == WIDE {
            into.copy_from_slice(&self.wide[group as usize][within..within + into.len()]);
            return;
        }
        for (start, &behind) in into.iter_mut().zip(&self.behind[at..]) {
            *start = group + u32::from(behind);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GROUP, Starts};
    use proptest::prelude::*;

    /// Lengths of tokens: mostly short, some about as long as a byte tells, some longer, now and then near the end of what offsets hold.
    fn lengths() -> impl Strategy<Value = Vec<u32>> {
        let length = prop_oneof![
            12 => 1..20_u32,
            2 => 100..400_u32,
            1 => 250..260_u32,
            1 => prop_oneof![Just(255_u32), Just(256), Just(65_536), Just(0x7000_0000)],
        ];
        proptest::collection::vec(length, 0..120)
    }

    /// The starts of tokens of these lengths, as far as offsets reach.
    fn starts(lengths: &[u32]) -> Vec<u32> {
        let mut at = Some(0_u32);
        let ends = lengths.iter().map_while(|&length| {
            let start = at?;
            at = start.checked_add(length);
            Some(start)
        });
        ends.collect()
    }

    fn compact(starts: &[u32]) -> Starts {
        let mut out = Starts::default();
        for &start in starts {
            out.push(start);
        }
        out
    }

    fn all(table: &Starts) -> Vec<u32> {
        (0..table.len()).map(|at| table.get(at)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn they_are_what_was_pushed(lengths in lengths()) {
            let plain = starts(&lengths);
            prop_assert_eq!(all(&compact(&plain)), plain);
        }

        #[test]
        fn in_pieces_they_are_the_same(lengths in lengths(), cuts in proptest::collection::vec(0..50_usize, 0..9)) {
            let plain = starts(&lengths);
            let mut pieces = Starts::default();
            let mut rest = plain.as_slice();
            for cut in cuts {
                let (piece, behind) = rest.split_at(cut.min(rest.len()));
                pieces.extend(piece);
                rest = behind;
            }
            pieces.extend(rest);
            prop_assert_eq!(pieces, compact(&plain));
        }

        #[test]
        fn what_is_taken_away_leaves_no_trace(lengths in lengths(), most in 0..60_usize) {
            let plain = starts(&lengths);
            let left = plain.len().saturating_sub(most);
            let mut table = compact(&plain);
            for _ in left..plain.len() {
                table.pop();
            }
            prop_assert_eq!(&table, &compact(&plain[..left]));
            table.extend(&plain[left..]);
            prop_assert_eq!(table, compact(&plain));
        }

        #[test]
        fn a_piece_of_another_table_is_moved(
            front in lengths(), lengths in lengths(), from in 0..60_usize, count in 0..60_usize, by in any::<i16>()
        ) {
            let (plain, front) = (starts(&lengths), starts(&front));
            let from = from.min(plain.len());
            let to = (from + count).min(plain.len());
            let moved = plain[from..to].iter().map(|start| start.wrapping_add(by as u32)).collect::<Vec<_>>();
            prop_assume!(moved.is_sorted());
            let mut table = compact(&front);
            table.extend_moved(&compact(&plain), from, to, by as u32);
            let both = [front, moved].concat();
            prop_assert_eq!(all(&table), both);
        }
    }

    #[test]
    fn a_group_reaches_as_far_as_a_byte_tells() {
        for reach in 254..258 {
            for last in 1..GROUP {
                let plain = (0..GROUP).map(|at| {
                    if at < last {
                        at as u32
                    } else {
                        reach + at as u32 - last as u32
                    }
                });
                let plain = plain.collect::<Vec<_>>();
                let mut pieces = Starts::default();
                pieces.extend(&plain);
                assert_eq!(all(&pieces), plain, "{reach} {last}");
                assert_eq!(pieces, compact(&plain), "{reach} {last}");
            }
        }
    }

    #[test]
    fn short_tokens_take_little_more_than_a_byte() {
        let short = (0..1600).map(|at| at * 15).collect::<Vec<_>>();
        assert_eq!(compact(&short).bytes(), 1600 + 4 * 1600 / GROUP);
        // one token too long makes one group wide
        let long = short
            .iter()
            .map(|&at| if at < 60 { at } else { at + 40 })
            .collect::<Vec<_>>();
        assert_eq!(compact(&long).bytes(), 1600 + 4 * 1600 / GROUP + 4 * GROUP);
        assert_eq!(all(&compact(&long)), long);
    }
}
