//! x
use crate::Dialect;
/// x
pub fn textmate(dialects: &[&Dialect]) -> String { String::new() }
