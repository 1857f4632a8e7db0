//! What a program is run with: INI values, tool table, parameters, other files, bounds.
mod files;

use crate::{ToolRows, Units};
pub use files::BadLine;
use std::collections::BTreeMap;
use std::sync::Arc;
use trunnion_vocabulary::{Files, Limits};

/// The control can drive this many spindles (LinuxCNC documentation, `[TRAJ]SPINDLES`).
const MOST_SPINDLES: usize = 8;

/// What is known at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Start {
    /// Everything is zero, as `rs274` starts.
    #[default]
    Zero,
    /// The position is unknown; parameters that are kept between programs are unknown if no parameter file declares them.
    Unknown,
}

/// Values of an INI file: section, key.
#[derive(Clone, Debug, Default)]
pub struct Ini {
    /// Upper case is kept as written; of equal keys in a section the first is used.
    pub values: BTreeMap<(String, String), String>,
}

/// A row of the tool table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolEntry {
    /// T.
    pub number: i32,
    /// P.
    pub pocket: i32,
    /// X Y Z A B C U V W, machine units.
    pub offset: [f64; 9],
    /// D, machine units.
    pub diameter: f64,
    /// I, deg.
    pub front_angle: f64,
    /// J, deg.
    pub back_angle: f64,
    /// Q, 0-9.
    pub orientation: i32,
}

impl ToolEntry {
    /// A row without a tool; it is never found by its number.
    pub(crate) const NOBODY: Self = Self {
        number: i32::MIN,
        pocket: -1,
        offset: [0.0; 9],
        diameter: 0.0,
        front_angle: 0.0,
        back_angle: 0.0,
        orientation: 0,
    };
}

/// The tool table. Row 0 is the spindle.
#[derive(Clone, Debug, Default)]
pub struct ToolTable {
    /// Rows in file order after row 0.
    pub rows: Vec<ToolEntry>,
    /// Row 0 at the start of a run: the last row without P.
    pub spindle: Option<ToolEntry>,
}

/// Numbered parameters by index: those that a parameter file declares.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    /// Index and value, ascending.
    pub values: Vec<(u32, f64)>,
    /// Global names, in lower case, and values, which are there before a program runs.
    pub globals: Vec<(String, f64)>,
}

/// What a program is run with.
#[derive(Clone)]
pub struct Setup {
    /// Units of the tool table and of the parameters; `rs274` takes both as inches.
    pub machine_units: Units,
    /// What is known at the start.
    pub start: Start,
    /// INI values.
    pub ini: Ini,
    /// Tool table.
    pub tools: ToolTable,
    /// Parameter file.
    pub parameters: Parameters,
    /// Called programs.
    pub files: Option<Arc<dyn Files>>,
    /// Bounds.
    pub limits: Limits,
    /// M100 to M199 exist; `rs274` by itself knows none.
    pub user_codes: bool,
    /// The machine's own codes (remaps) in addition to those of the control: letter and ten times the number, ascending.
    pub own_codes: Arc<[(u8, u32)]>,
    /// Which G codes among them are motions, so that they stay in effect: ten times the number, ascending.
    pub own_motions: Arc<[u32]>,
    /// The tool table may lack tools that the machine has: any number exists, with offset and diameter zero.
    pub any_tool: bool,
    /// The INI file is not known: each of the eight spindles that a machine may have exists, and M codes above 199 are its own (remaps).
    pub any_ini: bool,
    /// Lines that begin with `/` are skipped (the switch of the panel).
    pub block_delete: bool,
    /// A file that only defines subprograms runs them, one after the other, with unknown arguments; `rs274` runs nothing then.
    pub enter_definitions: bool,
    /// Decimals of numbers in messages after those that the control writes: 0 except for a closer look.
    pub more_decimals: usize,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            machine_units: Units::Inch,
            start: Start::default(),
            ini: Ini::default(),
            tools: ToolTable::sample(),
            parameters: Parameters::default(),
            files: None,
            limits: Limits::default(),
            user_codes: false,
            own_codes: Arc::from([]),
            own_motions: Arc::from([]),
            any_tool: false,
            any_ini: false,
            block_delete: false,
            enter_definitions: false,
            more_decimals: 0,
        }
    }
}

impl Setup {
    /// How many spindles the machine has, 1-8: `[TRAJ]SPINDLES`.
    pub fn spindles(&self) -> usize {
        self.ini
            .whole("TRAJ", "SPINDLES")
            .map_or(1, |count| count.clamp(1, MOST_SPINDLES as i64) as usize)
    }
    /// Whether a spindle exists; the first is 0.
    pub fn has_spindle(&self, number: i32) -> bool {
        let count = if self.any_ini { MOST_SPINDLES } else { self.spindles() };
        usize::try_from(number).is_ok_and(|number| number < count)
    }
    /// What M19 adds to its angle, degrees: `[RS274NGC]ORIENT_OFFSET`.
    pub fn orient_offset(&self) -> f64 {
        self.ini.number("RS274NGC", "ORIENT_OFFSET").unwrap_or(0.0)
    }
    /// Whether the changer swaps tools: `[EMCIO]RANDOM_TOOLCHANGER`.
    pub fn random_tool_changer(&self) -> bool {
        self.ini
            .whole("EMCIO", "RANDOM_TOOLCHANGER")
            .is_some_and(|value| value != 0)
    }
    /// Whether G92 is kept after a program: unless `[RS274NGC]DISABLE_G92_PERSISTENCE`.
    pub fn g92_persists(&self) -> bool {
        self.ini
            .whole("RS274NGC", "DISABLE_G92_PERSISTENCE")
            .is_none_or(|value| value == 0)
    }
    /// Which of A, B, C are wrapped: `[AXIS_A]WRAPPED_ROTARY`.
    pub fn wrapped_axes(&self) -> [bool; 3] {
        ["AXIS_A", "AXIS_B", "AXIS_C"].map(|section| {
            self.ini
                .whole(section, "WRAPPED_ROTARY")
                .is_some_and(|value| value != 0)
        })
    }
    /// Rows of the tool table as a run starts with them.
    pub(crate) fn tool_rows(&self) -> Arc<ToolRows> {
        let random = self.random_tool_changer();
        let empty = ToolEntry {
            number: if random { -1 } else { 0 },
            pocket: -1,
            ..ToolEntry::default()
        };
        let mut rows = vec![self.tools.spindle.unwrap_or(empty)];
        rows.extend(self.tools.rows.iter().copied());
        Arc::new(ToolRows::new(rows))
    }
}

impl Ini {
    /// The value of a key as a whole number.
    pub fn whole(&self, section: &str, key: &str) -> Option<i64> {
        self.values
            .get(&(section.to_owned(), key.to_owned()))?
            .trim()
            .parse()
            .ok()
    }
    /// A value as a number; section and key in upper case. `None`: it is not there, or is none.
    pub fn number(&self, section: &str, key: &str) -> Option<f64> {
        let text = self.values.get(&(section.to_owned(), key.to_owned()))?;
        text.trim().parse().ok().filter(|value: &f64| value.is_finite())
    }
}
