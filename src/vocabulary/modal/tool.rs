//! The tool in the spindle and its length.
use crate::{Tool, ToolShape};

/// Which tool's length is compensated. It distinguishes lengths that are not declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum LengthOf {
    /// None is in effect.
    #[default]
    Nothing,
    /// That of the tool with this number; `None`: of a tool in use whose number is not known.
    Tool(Option<u32>),
    /// The offset of that number, by T of a lathe (T0202): it shifts X and Z; `None`: its number is not known.
    Offset(Option<u32>),
    /// One that belongs to no tool (another edge than the first, a sum of several), or whose number could not be read.
    Other,
}

impl core::fmt::Display for LengthOf {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Nothing => f.write_str("none"),
            Self::Tool(Some(number)) => write!(f, "that of tool {number}"),
            Self::Tool(None) => f.write_str("that of the tool in use"),
            Self::Offset(Some(number)) => write!(f, "that of offset {number}"),
            Self::Offset(None) => f.write_str("that of an offset that T names"),
            Self::Other => f.write_str("one that belongs to no tool"),
        }
    }
}

/// Which tool is in use, and which is prepared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolInUse {
    number: Option<u32>,
    prepared: Option<u32>,
    data: Option<Tool>,
}

impl ToolInUse {
    /// In the spindle; `None` unknown, or chosen by a name.
    pub fn number(&self) -> Option<u32> {
        self.number
    }
    /// Prepared by T, waiting for M6.
    pub fn prepared(&self) -> Option<u32> {
        self.prepared
    }
    /// What is declared about the tool in use: merged from the run's setup, the program's comments and CUTTER.
    pub fn data(&self) -> Option<Tool> {
        self.data
    }
    /// Declared length, mm.
    pub fn own_length_mm(&self) -> Option<f64> {
        self.data?.length_mm
    }
    /// Declared shape, with the diameter in mm; `None` where either is not declared.
    pub fn shape(&self) -> Option<(ToolShape, f64)> {
        let tool = self.data?;
        Some((tool.shape?, tool.diameter_mm?))
    }
    /// T without a change.
    pub fn prepare(&mut self, number: Option<u32>) {
        self.prepared = number;
    }
    /// The change; [`Self::declare`] follows.
    pub fn load(&mut self, number: Option<u32>) {
        self.number = number;
    }
    /// The program gives its length, mm.
    pub fn declare_length(&mut self, mm: f64) {
        if let Some(data) = &mut self.data {
            data.length_mm = Some(mm);
        }
    }
    /// What is declared about the tool in use.
    pub fn declare(&mut self, data: Option<Tool>) {
        self.data = data;
    }
}

/// The active tool length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolLength {
    mm: Option<f64>,
    of: LengthOf,
    is_undeclared: bool,
    is_open: bool,
}

impl ToolLength {
    /// mm; `None`: none is in effect.
    pub fn mm(&self) -> Option<f64> {
        self.mm
    }
    /// Whose it is.
    pub fn of(&self) -> LengthOf {
        self.of
    }
    /// Nothing declares it: it counts as zero, or as what the program adds to it, and is unknown.
    pub fn is_undeclared(&self) -> bool {
        self.is_undeclared
    }
    /// A motion in machine coordinates has cancelled it, and whether it acts again in the next one is not known: it counts as zero.
    pub fn is_open(&self) -> bool {
        self.is_open
    }
    /// A length is in effect, mm.
    pub fn set(&mut self, mm: Option<f64>, of: LengthOf) {
        (self.mm, self.of, self.is_undeclared, self.is_open) = (mm, of, false, false);
    }
    /// The length, mm; where nothing declares it, it counts as zero.
    pub fn set_declared(&mut self, mm: Option<f64>, of: LengthOf) {
        (self.mm, self.of, self.is_undeclared, self.is_open) = (Some(mm.unwrap_or(0.0)), of, mm.is_none(), false);
    }
    /// Nothing declares the length; the program adds so many mm to it.
    pub fn set_undeclared(&mut self, beside_mm: f64, of: LengthOf) {
        (self.mm, self.of, self.is_undeclared, self.is_open) = (Some(beside_mm), of, true, false);
    }
    /// See [`Self::is_open`].
    pub fn leave_open(&mut self) {
        self.is_open = true;
    }
    /// Equal, where an unknown number equals an unknown number.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        (self.of, self.is_undeclared, self.is_open) == (other.of, other.is_undeclared, other.is_open)
            && super::alike(self.mm, other.mm)
    }
}
