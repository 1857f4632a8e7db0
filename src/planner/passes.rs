//! Backward and forward pass over pieces: the highest speeds that every piece can brake from and accelerate to.
use crate::{Piece, Ramp};

/// Pieces with the highest speed (mm/s) and acceleration (mm/s^2) of each.
pub(crate) struct Passes<'a> {
    pub(crate) pieces: &'a [Piece],
    pub(crate) levels: Vec<[f64; 2]>,
    /// Which of the speeds at corners counts, 0: optimistic, 1: planned.
    pub(crate) side: usize,
    /// Blocks that the control looks ahead; `None`: all.
    pub(crate) lookahead: Option<u32>,
    /// Speed at the start, mm/s.
    pub(crate) first: f64,
}

impl Passes<'_> {
    /// Each piece as fast as it can be.
    pub(crate) fn ramps(&self) -> Vec<Ramp> {
        let speeds = self.speeds();
        let pieces = self
            .pieces
            .iter()
            .zip(&self.levels)
            .zip(speeds.iter().zip(&speeds[1..]));
        pieces
            .map(|((piece, [cap, acceleration]), (from, to))| {
                Ramp::fastest(piece.length, *cap, *acceleration, [*from, *to])
            })
            .collect()
    }

    /// Highest speeds at the ends of the pieces that every piece can brake from and accelerate to.
    pub(crate) fn speeds(&self) -> Vec<f64> {
        let mut speeds = self.braking();
        if let Some(blocks) = self.lookahead {
            self.look(blocks, &mut speeds);
        }
        for index in 0..self.pieces.len() - 1 {
            let from: f64 = speeds[index];
            let reach = (from * from + 2.0 * self.levels[index][1] * self.pieces[index].length).sqrt();
            speeds[index + 1] = speeds[index + 1].min(reach);
        }
        speeds
    }

    /// Highest speeds at the ends of the pieces that every piece can brake from, from the end backwards.
    fn braking(&self) -> Vec<f64> {
        let count = self.pieces.len();
        let mut speeds = vec![0.0; count + 1];
        speeds[0] = self.first;
        for index in (1..count).rev() {
            let [_, acceleration] = self.levels[index];
            let next: f64 = speeds[index + 1];
            let reach = (next * next + 2.0 * acceleration * self.pieces[index].length).sqrt();
            speeds[index] = self.allowed(index).min(reach);
        }
        speeds
    }

    /// Where the speed at the start of a piece is the highest that is allowed there, so that nothing that follows can change it.
    pub(crate) fn settled(&self) -> Vec<bool> {
        let speeds = self.braking();
        (0..self.pieces.len())
            .map(|index| index > 0 && speeds[index] >= self.allowed(index))
            .collect()
    }

    /// The highest speed at the start of a piece that is not the first, whatever follows.
    fn allowed(&self, index: usize) -> f64 {
        let ([before, _], [cap, _]) = (self.levels[index - 1], self.levels[index]);
        self.pieces[index].entry[self.side].min(before).min(cap)
    }

    /// Within the blocks that it sees, the control must be able to stop.
    fn look(&self, blocks: u32, speeds: &mut [f64]) {
        let count = self.pieces.len();
        let gain = |index: usize| 2.0 * self.levels[index][1] * self.pieces[index].length;
        let (mut end, mut sum, mut seen) = (count, 0.0, 0_u32);
        // how many pieces of each motion are inside the window [index, end)
        for index in (0..count).rev() {
            sum += gain(index);
            if index + 1 == count || self.pieces[index + 1].motion != self.pieces[index].motion {
                seen += 1;
            }
            while seen > blocks && end > index + 1 {
                end -= 1;
                sum -= gain(end);
                if self.pieces[end - 1].motion != self.pieces[end].motion {
                    seen -= 1;
                }
            }
            if sum.is_finite() {
                speeds[index] = speeds[index].min(sum.max(0.0).sqrt());
            }
        }
    }
}
