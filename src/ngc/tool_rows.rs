//! The rows of the tool table during a run, found by number without a search.
use crate::ToolEntry;
use std::collections::BTreeSet;

/// The rows; row 0 is the spindle.
#[derive(Clone, Debug)]
pub struct ToolRows {
    rows: Vec<ToolEntry>,
    /// Number and place of each row after row 0 that holds a tool: a program may name hundreds of thousands of tools.
    places: BTreeSet<(i32, usize)>,
}

impl Default for ToolRows {
    fn default() -> Self {
        Self::new(vec![ToolEntry::default()])
    }
}

impl ToolRows {
    /// A table; the first row is the spindle.
    pub(crate) fn new(rows: Vec<ToolEntry>) -> Self {
        let numbered = rows.iter().enumerate().skip(1);
        let places = numbered.filter_map(|(row, entry)| key(row, entry)).collect();
        Self { rows, places }
    }

    /// A row.
    pub fn get(&self, row: usize) -> Option<&ToolEntry> {
        self.rows.get(row)
    }

    /// How many rows there are.
    pub(crate) fn count(&self) -> usize {
        self.rows.len()
    }

    /// What is in the spindle.
    pub fn spindle(&self) -> Option<&ToolEntry> {
        self.rows.first()
    }

    /// The first row after row 0 with a tool of this number.
    pub(crate) fn row_of(&self, number: i32) -> Option<usize> {
        let (_, row) = self.places.range((number, 0)..=(number, usize::MAX)).next()?;
        Some(*row)
    }

    /// Adds a row at the end; its place.
    pub(crate) fn push(&mut self, entry: ToolEntry) -> usize {
        let row = self.rows.len();
        self.places.extend(key(row, &entry));
        self.rows.push(entry);
        row
    }

    /// Replaces a row, if it exists.
    pub(crate) fn set(&mut self, row: usize, entry: ToolEntry) {
        let Some(place) = self.rows.get_mut(row) else { return };
        let old = std::mem::replace(place, entry);
        let (old, new) = (key(row, &old), key(row, &entry));
        if row > 0 && old != new {
            if let Some(old) = old {
                self.places.remove(&old);
            }
            self.places.extend(new);
        }
    }

    /// Writes the pocket of the spindle's row.
    pub(crate) fn set_pocket_of_spindle(&mut self, pocket: i32) {
        if let Some(row) = self.rows.first_mut() {
            row.pocket = pocket;
        }
    }
}

/// Under what a row is found; a row without a tool is not.
fn key(row: usize, entry: &ToolEntry) -> Option<(i32, usize)> {
    (*entry != ToolEntry::NOBODY).then_some((entry.number, row))
}

#[cfg(test)]
mod tests {
    use super::{ToolEntry, ToolRows};

    fn tool(number: i32) -> ToolEntry {
        ToolEntry {
            number,
            ..ToolEntry::default()
        }
    }

    /// What a search from the first row on finds, after every change.
    #[test]
    fn a_row_is_found_as_a_search_finds_it() {
        let mut table = ToolRows::new([0, 3, 5, 3].map(tool).to_vec());
        let mut seed = 1_u32;
        for _ in 0..2000 {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let (row, number) = ((seed >> 8) as usize % 12, (seed >> 16) as i32 % 6);
            match seed >> 29 {
                0 => drop(table.push(tool(number))),
                1 => table.set(row, ToolEntry::NOBODY),
                _ => table.set(row, tool(number)),
            }
            for number in [i32::MIN, -1, 0, 1, 2, 3, 4, 5, 6] {
                let is_it = |entry: &ToolEntry| entry.number == number && *entry != ToolEntry::NOBODY;
                let searched = table.rows.iter().skip(1).position(is_it).map(|place| place + 1);
                assert_eq!(table.row_of(number), searched, "{number}");
            }
        }
    }
}
