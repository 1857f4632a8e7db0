//! Other programs that a program calls, and the bounds of a run.
use std::sync::Arc;

/// A program that another one calls.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// Where it was found, as people are shown it.
    pub path: String,
    /// Its bytes.
    pub bytes: Arc<[u8]>,
}

/// Finds programs that a program calls (`M98 P1000`, `o<name> call`): beside it and in configured folders.
pub trait Files: Send + Sync {
    /// The program of a name (`name`, without folder; the implementor tries extensions), or the folders that were searched.
    ///
    /// # Errors
    /// The folders that were searched, as people are shown them.
    fn load(&self, name: &str) -> Result<Loaded, Vec<String>>;
}

/// Bounds of a run: a program that does not end within them is reported, not awaited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Executed lines.
    pub blocks: u64,
    /// Calls inside calls, where the control sets no lower bound itself: LinuxCNC stops at [`Limits::LINUXCNC_DEPTH`].
    pub depth: u32,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            blocks: 10_000_000,
            depth: 100,
        }
    }
}

impl Limits {
    /// So many levels of calls LinuxCNC has, the main program's among them.
    pub const LINUXCNC_DEPTH: u32 = 10;
}
