//! Where places of an older text are in the text as it is now, after any number of edits.
use core::ops::Range;
use trunnion_syntax::TextRange;

/// At most this many edited places are kept apart; beyond that the two nearest are merged.
const MOST: usize = 64;

/// One edited place, bytes of the older text and of the newer one.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Place {
    old: Range<u32>,
    new: Range<u32>,
}

/// Edits since a text, put together: disjoint places in order.
#[derive(Debug, Default)]
pub(crate) struct Moves(Vec<Place>);

impl Moves {
    /// No edit.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// An edit replaces these bytes of the text as it is now by `length` bytes.
    pub(crate) fn edit(&mut self, bytes: Range<u32>, length: u32) {
        let first = self.0.partition_point(|place| place.new.end < bytes.start);
        let touched = self.0[first..].partition_point(|place| place.new.start <= bytes.end);
        let behind = first + touched;
        // where the ends of the edit are in the older text, if they are outside the places
        let old = |at: u32, before: usize| match before.checked_sub(1).map(|last| &self.0[last]) {
            Some(place) => place.old.end + (at - place.new.end),
            None => at,
        };
        let mut merged = Place {
            old: old(bytes.start, first)..0,
            new: bytes.start..bytes.end,
        };
        merged.old.end = match self.0[first..behind].last() {
            Some(last) => {
                let head = &self.0[first];
                if head.new.start <= bytes.start {
                    (merged.old.start, merged.new.start) = (head.old.start, head.new.start);
                }
                merged.new.end = bytes.end.max(last.new.end);
                last.old.end + (merged.new.end - last.new.end)
            }
            None => old(bytes.end, first),
        };
        let shift = |at: u32| at - (bytes.end - bytes.start) + length;
        merged.new.end = shift(merged.new.end);
        for place in &mut self.0[behind..] {
            place.new = shift(place.new.start)..shift(place.new.end);
        }
        self.0.splice(first..behind, [merged]);
        if self.0.len() > MOST {
            self.join_nearest();
        }
    }

    /// Makes one of the two places that are nearest to each other; the text between them counts as edited.
    fn join_nearest(&mut self) {
        let gap = |index: &usize| self.0[index + 1].old.start - self.0[*index].old.end;
        let Some(index) = (0..self.0.len().saturating_sub(1)).min_by_key(gap) else {
            return;
        };
        let next = self.0.remove(index + 1);
        let place = &mut self.0[index];
        (place.old.end, place.new.end) = (next.old.end, next.new.end);
    }

    /// Where a range of the older text is now; `None` where it was edited.
    pub(crate) fn moved(&self, range: TextRange) -> Option<TextRange> {
        let before = self.0.partition_point(|place| place.old.end <= range.start);
        if self.0.get(before).is_some_and(|next| range.end >= next.old.start) {
            return None;
        }
        let Some(place) = before.checked_sub(1).map(|last| &self.0[last]) else {
            return Some(range);
        };
        let now = |at: u32| at - place.old.end + place.new.end;
        Some(TextRange::new(now(range.start), now(range.end)))
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, Moves};
    use proptest::prelude::*;
    use trunnion_syntax::TextRange;

    /// One edit after the other.
    fn step_by_step(edits: &[(u32, u32, u32)], mut range: TextRange) -> Option<TextRange> {
        for &(start, end, length) in edits {
            if range.start >= end {
                let now = |at| at - end + start + length;
                range = TextRange::new(now(range.start), now(range.end));
            } else if range.end >= start {
                return None;
            }
        }
        Some(range)
    }

    proptest! {
        #[test]
        fn edits_put_together_move_places_as_they_do_one_by_one(
            raw in proptest::collection::vec((0..400_u32, 0..9_u32, 0..9_u32), 0..40),
            from in 0..300_u32, length in 1..9_u32,
        ) {
            let (mut moves, mut edits, mut size) = (Moves::default(), Vec::new(), 400_u32);
            for (start, cut, length) in raw {
                let start = start.min(size);
                let end = (start + cut).min(size);
                moves.edit(start..end, length);
                edits.push((start, end, length));
                size = size - (end - start) + length;
            }
            let range = TextRange::new(from, from + length);
            prop_assert_eq!(moves.moved(range), step_by_step(&edits, range));
        }
    }

    #[test]
    fn any_number_of_edits_is_kept_as_a_few_places() {
        let mut moves = Moves::default();
        for _ in 0..5000 {
            moves.edit(0..0, 3);
        }
        assert_eq!(moves.0.len(), 1);
        assert_eq!(moves.moved(TextRange::new(7, 9)), Some(TextRange::new(15_007, 15_009)));
        for number in 0..5000 {
            moves.edit(20_000 + 10 * number..20_000 + 10 * number, 2);
        }
        assert_eq!(moves.0.len(), MOST);
        let behind = TextRange::new(90_000, 90_001);
        assert_eq!(moves.moved(behind), Some(TextRange::new(115_000, 115_001)));
    }
}
