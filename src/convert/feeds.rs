//! What does not mean the same in the output: feeds that followed the spindle, and a tool radius that the control compensated.
use crate::plan::Out;
use trunnion_certify::conversion::Reading;
use trunnion_dialect::{Action, Dialect};
use trunnion_interp::Feed;
use trunnion_syntax::{Address, BlockId, Value};

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

/// The first block that ran with G41 or G42. The output has the path of the tool's centre without them.
pub(crate) fn compensated(reading: &Reading, dialect: &Dialect) -> Option<BlockId> {
    let compensates = |block: &BlockId| {
        reading.program.block(*block).words().any(|word| {
            let (Address::Letter(b'G'), Value::Number(number)) = (word.address, word.value) else {
                return false;
            };
            let code = dialect.g((number.to_f64() * 10.0).round() as u32);
            code.is_some_and(|code| matches!(code.action, Action::CompensationLeft | Action::CompensationRight))
        })
    };
    reading.blocks.iter().map(|ran| ran.block).find(compensates)
}
