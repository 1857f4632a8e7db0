//! The list of rewrites, alphabetical.
use crate::Rewrite;

/// All rewrites.
pub fn rewrites() -> &'static [&'static Rewrite] {
    &[]
}

/// A rewrite by name.
pub fn rewrite(name: &str) -> Option<&'static Rewrite> {
    rewrites().iter().copied().find(|rewrite| rewrite.name == name)
}
