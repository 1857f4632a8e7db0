//! Linear systems in which each unknown is joined with two others on either side.

/// A symmetric matrix with two diagonals on either side of the middle one, and its factors L D L'.
pub(super) struct Pentadiagonal {
    /// For each row: the middle, and what joins it with the next and the one after.
    rows: Vec<[f64; 3]>,
}

impl Pentadiagonal {
    pub(super) fn new(count: usize) -> Self {
        Self {
            rows: vec![[0.0; 3]; count],
        }
    }

    /// Zero, with a trace of the unit matrix for the unknowns without meaning.
    pub(super) fn clear(&mut self) {
        self.rows.fill([1e-12, 0.0, 0.0]);
    }

    /// Adds `weight` times the square of a row that begins at an unknown.
    pub(super) fn add(&mut self, at: usize, [a, b, c]: [f64; 3], weight: f64) {
        let rows = &mut self.rows[at..];
        rows[0][0] += weight * a * a;
        rows[0][1] += weight * a * b;
        rows[0][2] += weight * a * c;
        if let Some(next) = rows.get_mut(1) {
            next[0] += weight * b * b;
            next[1] += weight * b * c;
        }
        if let Some(next) = rows.get_mut(2) {
            next[0] += weight * c * c;
        }
    }

    /// Replaces the matrix by its factors; false where it is not positive.
    pub(super) fn factor(&mut self) -> bool {
        for at in 0..self.rows.len() {
            let [middle, next, after] = self.rows[at];
            if middle <= 0.0 || !middle.is_finite() {
                return false;
            }
            let (l1, l2) = (next / middle, after / middle);
            if let Some(row) = self.rows.get_mut(at + 1) {
                row[0] -= l1 * next;
                row[1] -= l1 * after;
            }
            if let Some(row) = self.rows.get_mut(at + 2) {
                row[0] -= l2 * after;
            }
            self.rows[at] = [middle, l1, l2];
        }
        true
    }

    /// Solves for a right side, in place.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let count = self.rows.len();
        for at in 0..count {
            let value = x[at];
            if at + 1 < count {
                x[at + 1] -= self.rows[at][1] * value;
            }
            if at + 2 < count {
                x[at + 2] -= self.rows[at][2] * value;
            }
        }
        for at in (0..count).rev() {
            let mut value = x[at] / self.rows[at][0];
            if at + 1 < count {
                value -= self.rows[at][1] * x[at + 1];
            }
            if at + 2 < count {
                value -= self.rows[at][2] * x[at + 2];
            }
            x[at] = value;
        }
    }
}
