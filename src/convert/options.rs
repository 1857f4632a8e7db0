//! The options of a conversion.
use crate::Post;
use trunnion_machine::Machine;

/// Units of the output program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// Millimetres.
    #[default]
    Mm,
    /// Inches.
    Inch,
}

impl Units {
    /// mm per unit.
    pub(crate) fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Inch => 25.4,
        }
    }
}

/// How the tool's orientation is written under tool centre point control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OrientationWords {
    /// Rotary words, by inverse kinematics.
    #[default]
    Rotary,
    /// Tool vectors.
    Vectors,
}

/// What is written.
#[derive(Clone, Copy)]
pub enum Target<'a> {
    /// APT / CL data: independent of a machine.
    Apt,
    /// G-code.
    Code {
        /// The number formats and templates for the control.
        post: &'a Post,
        /// The machine it runs on; `None`: the program has no rotary words.
        machine: Option<&'a Machine>,
    },
}

/// The options of a conversion.
#[derive(Clone, Debug)]
pub struct Options {
    /// Units of the output program.
    pub units: Units,
    /// Rotary words or vectors.
    pub orientation: OrientationWords,
    /// Tool centre point control is used where the machine has rotary axes; else joints are written and linearised.
    pub tcp: bool,
    /// At every moment of a feed motion the tip stays within this of where it was, mm; `None`: the tolerance of the machine, or 0.01.
    pub tolerance_mm: Option<f64>,
    /// How far the tool axis may be from where it was inside a cut, deg; `None`: 0.5. Judged between programs that name rotary axes.
    pub tolerance_deg: Option<f64>,
    /// A cut may turn the table to the other posture, or wind back a rotary axis.
    pub allow_swap: bool,
    /// INSERT records are treated as remarks.
    pub insert_is_remark: bool,
    /// Codes that are left out: `M10`.
    pub drop: Vec<String>,
    /// Arcs are written as lines.
    pub lines_only: bool,
    /// Name of the program, where it says none itself.
    pub program_name: Option<String>,
    /// Number of the program (`O1`).
    pub program_number: u32,
    /// Work offset, where the program names none, or names it as another kind of control does; `None`: the one of the post.
    pub work_offset: Option<String>,
}

impl Options {
    /// The work offset of a program that names none, or names it as another kind of control does.
    pub(crate) fn work_offset<'a>(&'a self, post: Option<&'a Post>) -> &'a str {
        let own = post.map_or("G54", |post| post.work_offset.as_str());
        self.work_offset.as_deref().unwrap_or(own)
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            units: Units::Mm,
            orientation: OrientationWords::Rotary,
            tcp: true,
            tolerance_mm: None,
            tolerance_deg: None,
            allow_swap: false,
            insert_is_remark: false,
            drop: Vec::new(),
            lines_only: false,
            program_name: None,
            program_number: 1,
            work_offset: None,
        }
    }
}
