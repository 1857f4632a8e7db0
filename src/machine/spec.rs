//! The machine file as it is written (TOML), with clear errors.
use crate::Machine;

/// Why a machine file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the file, where known.
    pub span: Option<core::ops::Range<usize>>,
}

impl core::fmt::Display for MachineError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for MachineError {}

/// Loads and validates a machine file. `id` is its name for reports (file stem).
pub fn load(id: &str, toml: &str) -> Result<Machine, MachineError> {
    let _ = (id, toml);
    todo!()
}
