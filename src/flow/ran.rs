//! Which blocks of the main program have run.

/// A set of blocks.
#[derive(Clone, Debug, Default)]
pub struct Ran {
    bits: Vec<u64>,
    /// First block of the current range, which is not in `bits` yet.
    from: u32,
}

impl Ran {
    /// Words that a clone copies.
    pub fn copied(&self) -> usize {
        self.bits.len()
    }

    /// The range up to `end` (not included) has run; another begins at `next`.
    pub fn jump(&mut self, end: u32, next: u32) {
        self.add(self.from, end);
        self.from = next;
    }

    /// A range begins at `next`, after blocks of another file.
    pub fn begin(&mut self, next: u32) {
        self.from = next;
    }

    fn add(&mut self, from: u32, end: u32) {
        if from >= end {
            return;
        }
        let (first, last) = (from / 64, (end - 1) / 64);
        if self.bits.len() <= last as usize {
            self.bits.resize(last as usize + 1, 0);
        }
        for word in first..=last {
            let low = if word == first { from % 64 } else { 0 };
            let high = if word == last { (end - 1) % 64 } else { 63 };
            self.bits[word as usize] |= (u64::MAX << low) & (u64::MAX >> (63 - high));
        }
    }

    /// Whether a block ran before the current range.
    pub fn has(&self, block: u32) -> bool {
        let bits = self.bits.get(block as usize / 64).copied().unwrap_or(0);
        bits & (1 << (block % 64)) != 0
    }
}

#[cfg(test)]
mod tests {
    use super::Ran;

    #[test]
    fn a_stretch_counts_once_it_is_left() {
        let mut ran = Ran::default();
        assert!(!ran.has(0));
        ran.jump(130, 200);
        ran.jump(201, 3);
        let has: Vec<u32> = (0..300).filter(|&block| ran.has(block)).collect();
        assert_eq!(has, (0..130).chain([200]).collect::<Vec<_>>());
        ran.jump(3, 9);
        assert!(!ran.has(150), "an empty stretch adds nothing");
    }
}
