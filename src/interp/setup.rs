//! What a program is run with: tools, offsets. All lengths mm, angles deg.

/// Shape of a tool's cutting part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolShape {
    /// Ball end: radius = diameter / 2.
    Ball,
    /// Flat end.
    Flat,
    /// Corner radius in mm.
    Bull(f64),
}

/// A tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Number, 0 = the tool in use whatever its number (from `--tool`).
    pub number: u32,
    /// Shape, if declared.
    pub shape: Option<ToolShape>,
    /// mm, if declared.
    pub diameter_mm: Option<f64>,
    /// mm, if declared.
    pub length_mm: Option<f64>,
}

/// A work offset: where the part's zero lies in machine coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkOffset {
    /// `G54`.
    pub name: String,
    /// mm / deg in the order of `AXIS_LETTERS`.
    pub values: [f64; 9],
}

/// What a program is run with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setup {
    /// Declared tools.
    pub tools: Vec<Tool>,
    /// Declared work offsets.
    pub work_offsets: Vec<WorkOffset>,
}
