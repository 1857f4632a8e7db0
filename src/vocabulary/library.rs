//! Other programs that a program calls, and the bounds of a run.
use std::sync::Arc;

/// A program that another one calls.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// Where it was found, for messages.
    pub path: String,
    /// Its bytes.
    pub bytes: Arc<[u8]>,
}

/// Finds programs that a program calls (`M98 P1000`, `o<name> call`): in its folder and in configured folders.
pub trait Files: Send + Sync {
    /// The program with this name (`name`, without folder; the implementor tries extensions), or the folders that were searched.
    ///
    /// # Errors
    /// The folders that were searched.
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>>;
}

/// A folder in which a called program was looked for.
#[derive(Clone, PartialEq, Eq)]
pub struct Searched {
    /// As shown in messages.
    pub folder: String,
    /// A file of that name exists but is not used: which, and why. The control would use it, so no other place is searched.
    pub refused: Option<String>,
    /// Nothing was searched, so the program may exist: why.
    pub skipped: Option<String>,
}

impl Searched {
    /// A file of that name is in the folder and is not used.
    pub fn refused(folder: String, why: String) -> Self {
        Self {
            refused: Some(why),
            ..folder.into()
        }
    }

    /// Nothing was searched.
    pub fn skipped(why: String) -> Self {
        Self {
            skipped: Some(why),
            ..String::new().into()
        }
    }
}

impl From<String> for Searched {
    fn from(folder: String) -> Self {
        Self {
            folder,
            refused: None,
            skipped: None,
        }
    }
}

impl From<&str> for Searched {
    fn from(folder: &str) -> Self {
        folder.to_owned().into()
    }
}

impl core::fmt::Debug for Searched {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.refused.as_ref().or(self.skipped.as_ref()) {
            None => write!(f, "{:?}", self.folder),
            Some(why) => write!(f, "{:?} ({why:?})", self.folder),
        }
    }
}

/// Bounds of a run: a program that does not end within them is stopped and reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Executed lines, and motions of cycles, of a run that keeps nothing (`check`). The blocks that the program itself has are
    /// not counted: a program without loops and calls is followed to its end. Blocks of more than [`Limits::BYTES_PER_BLOCK`] bytes on average
    /// count for more, except on LinuxCNC, whose lines are short.
    pub blocks: u64,
    /// The same for a run in which every step is compared, proved, listed or drawn (`diff`, `certify`, `fix`, `trace`, `canon`, `stats`,
    /// `plot`, `surface`, the language server): a step takes ten times as long there.
    pub steps: u64,
    /// Motions that are held in memory at once, with everything known about them: of a whole program in `convert`; of one block, up to a quarter
    /// of it, in a comparison.
    pub held: u64,
    /// Calls inside calls, where the control sets no lower bound itself: LinuxCNC stops at [`Limits::LINUXCNC_DEPTH`].
    pub depth: u32,
}

/// What a run may execute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// Blocks.
    pub blocks: u64,
    /// Their bytes together.
    pub bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            blocks: 1_500_000,
            steps: 150_000,
            held: 150_000,
            depth: 100,
        }
    }
}

impl Limits {
    /// The number of levels of calls of LinuxCNC, including the main program.
    pub const LINUXCNC_DEPTH: u32 = 10;
    /// Blocks of loops and calls may have this many bytes on average. Longer ones take longer, so fewer of them run.
    pub const BYTES_PER_BLOCK: u64 = 24;

    /// What a run of a program of so many blocks and bytes may execute: its own text, and the bound beside it.
    pub const fn work(&self, blocks: u64, bytes: u64) -> Work {
        Work {
            blocks: self.blocks.saturating_add(blocks),
            bytes: self.blocks.saturating_mul(Self::BYTES_PER_BLOCK).saturating_add(bytes),
        }
    }

    /// For a run whose motions are held.
    #[must_use]
    pub fn of_held(self) -> Self {
        Self {
            blocks: self.blocks.min(self.steps).min(self.held),
            ..self
        }
    }

    /// For a run in which every step is compared, proved, listed or drawn.
    #[must_use]
    pub fn of_steps(self) -> Self {
        Self {
            blocks: self.blocks.min(self.steps),
            ..self
        }
    }

    /// How many pieces of 2 deg the long turns of guided motions may take together.
    #[must_use]
    pub fn turned(self) -> u64 {
        self.steps
    }
}
