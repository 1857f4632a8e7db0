//! Programs and the motions and faults that they must give.
#![expect(clippy::unwrap_used, reason = "a test may stop where its own text is wrong")]
mod probe;
mod support;
