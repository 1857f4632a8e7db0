//! What a code of path control demands where one block ends and the next begins.
use serde::Deserialize;

/// What the control does at the end of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PathMode {
    /// The axes stop at the end of every block.
    ExactStop,
    /// The tool passes through every end point, and stops only where the path bends.
    ExactPath,
    /// The control may round corners and keep its speed.
    Continuous,
}
