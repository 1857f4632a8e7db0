//! Where rules report to: ranges from blocks, levels from settings, merging of consecutive findings.
/// Collects findings of rules.
pub struct Reporter<'a> {
    _program: &'a (),
}
