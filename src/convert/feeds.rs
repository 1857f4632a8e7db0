//! Cuts whose feed does not mean the same in the output.
use crate::plan::Out;
use trunnion_certify::conversion::Reading;
use trunnion_interp::Feed;
use trunnion_syntax::BlockId;

/// Lines of the original: see [`crate::Converted::feeds_per_minute`].
pub(crate) fn per_minute(reading: &Reading, outs: &[Out], line: impl Fn(BlockId) -> u32) -> Vec<u32> {
    let is_per_minute =
        |out: &Out| matches!(out, Out::Moves(moves) if moves.iter().any(|one| matches!(one.feed, Feed::PerMinute(_))));
    let mut lines: Vec<u32> = reading
        .motions
        .iter()
        .zip(outs)
        .filter(|(posed, out)| matches!(posed.motion.feed, Feed::PerRevolution(_)) && is_per_minute(out))
        .map(|(posed, _)| line(posed.motion.block))
        .collect();
    lines.dedup();
    lines
}
