//! Where places of a text are after edits, and before them.
use trunnion_syntax::{TextEdit, TextRange};

/// Edits as a map between the text before and the text after. Offsets are bytes.
pub(crate) struct Edited {
    /// Before and after: first byte of each edit, and the byte after it.
    ranges: Vec<([usize; 2], [usize; 2])>,
}

impl Edited {
    /// The map of sorted edits that do not overlap.
    pub(crate) fn new(edits: &[TextEdit]) -> Self {
        let (mut was, mut is) = (0, 0);
        let mut ranges = Vec::with_capacity(edits.len());
        for edit in edits {
            let range = edit.range.as_usize();
            is += range.start - was;
            ranges.push(([range.start, range.end], [is, is + edit.new_text.len()]));
            is += edit.new_text.len();
            was = range.end;
        }
        Self { ranges }
    }

    /// The byte of the text before that a byte of the text after comes from; for new text, the first byte that it replaces.
    pub(crate) fn before(&self, after: usize) -> usize {
        let count = self.ranges.partition_point(|(_, is)| is[0] <= after);
        let Some((was, is)) = count.checked_sub(1).and_then(|last| self.ranges.get(last)) else {
            return after;
        };
        if after < is[1] {
            was[0]
        } else {
            was[1] + (after - is[1])
        }
    }

    /// The range of the text after that holds what a range of the text before became, with all edits that touch it.
    pub(crate) fn after(&self, before: TextRange) -> TextRange {
        let before = before.as_usize();
        // edits that start inside belong to the range, and so does what is inserted at its end: the range of a block ends before the line end, so the
        // next place begins after it
        let shift = |count: usize| match count.checked_sub(1).and_then(|last| self.ranges.get(last)) {
            Some((was, is)) => (was[1], is[1]),
            None => (0, 0),
        };
        let (was, is) = shift(self.ranges.partition_point(|(was, _)| was[0] < before.start));
        let start = is + before.start.saturating_sub(was);
        let inside = |was: &[usize; 2]| was[0] < before.end || *was == [before.end; 2];
        let (was, is) = shift(self.ranges.partition_point(|(was, _)| inside(was)));
        let end = is + before.end.saturating_sub(was);
        TextRange::new(start as u32, end.max(start) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::Edited;
    use trunnion_syntax::{TextEdit, TextRange};

    #[test]
    fn places_are_found_on_both_sides() {
        let edit = |start, end, text: &str| TextEdit {
            range: TextRange::new(start, end),
            new_text: text.to_owned(),
        };
        // abcdefgh -> aXYdeZgh
        let map = Edited::new(&[edit(1, 3, "XY"), edit(5, 5, "Z"), edit(5, 6, "")]);
        assert_eq!([0, 1, 2, 3, 5, 6].map(|at| map.before(at)), [0, 1, 1, 3, 5, 6]);
        assert_eq!(map.after(TextRange::new(1, 3)), TextRange::new(1, 3));
        assert_eq!(map.after(TextRange::new(3, 6)), TextRange::new(3, 6));
        // a line is put after another one
        let after = Edited::new(&[edit(3, 3, "\nZ")]);
        assert_eq!(after.after(TextRange::new(1, 3)), TextRange::new(1, 5));
        assert_eq!(after.after(TextRange::new(4, 6)), TextRange::new(6, 8));
        let longer = Edited::new(&[edit(1, 3, "12345")]);
        assert_eq!(longer.before(7), 4);
        assert_eq!(longer.after(TextRange::new(0, 3)), TextRange::new(0, 6));
        assert_eq!(longer.after(TextRange::new(3, 5)), TextRange::new(6, 8));
    }
}
