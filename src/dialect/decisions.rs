//! Decisions in which controls differ: one type each, so that a new kind does not compile until every place has decided.
use crate::{Dialect, Quirks};
use serde::Deserialize;
use trunnion_syntax::Format;

/// What a language has in addition to words and codes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Language {
    /// Nothing (grbl).
    #[default]
    Words,
    /// Custom macro B: variables, IF, GOTO, WHILE, M98, G65.
    MacroB,
    /// Sinumerik: the program defines its own names (variables, labels, subprograms), so an unknown name alone is not an error.
    Sinumerik,
    /// Programs are run by LinuxCNC's own interpreter.
    Linuxcnc,
    /// Okuma's user task: variables with names, CALL, RTS, GOTO, IF, MODIN.
    UserTask,
}

/// Which control's custom macro B it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Macros {
    /// Of no control in particular.
    #[default]
    Generic,
    /// Fanuc's: its alarms, levels of calls, numbers of modal groups (#4014) and P of M98 that begins with the number of repetitions.
    Fanuc,
}

/// What T does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToolWord {
    /// It prepares the tool for M6.
    #[default]
    Prepares,
    /// It puts the tool into the spindle at once.
    Changes,
    /// The same, and its last two digits name an offset: T0102 (lathes).
    ChangesWithOffset,
}

impl ToolWord {
    /// T alone changes the tool.
    pub fn changes(self) -> bool {
        match self {
            Self::Prepares => false,
            Self::Changes | Self::ChangesWithOffset => true,
        }
    }
    /// The offset that a number with its tool selects; `None`: none, or it is not known which (T2 may be tool 2, or offset 2 of tool 0).
    pub fn offset(self, number: u32) -> Option<u32> {
        (self == Self::ChangesWithOffset && number >= 100).then_some(number % 100)
    }
    /// The tool that a number selects.
    pub fn tool(self, number: u32) -> u32 {
        match self {
            Self::ChangesWithOffset if number >= 100 => number / 100,
            Self::Prepares | Self::Changes | Self::ChangesWithOffset => number,
        }
    }
}

/// What numbers without a decimal point mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WholeNumbers {
    /// What is written.
    #[default]
    AsWritten,
    /// A coordinate is millimetres or least increments, as a parameter of the control says (Fanuc).
    AmbiguousLengths,
    /// The same for F, by a setting (Haas).
    AmbiguousLengthsAndFeeds,
}

impl WholeNumbers {
    /// Whether lengths without a decimal point have two meanings.
    #[inline]
    pub fn lengths_ambiguous(self) -> bool {
        match self {
            Self::AsWritten => false,
            Self::AmbiguousLengths | Self::AmbiguousLengthsAndFeeds => true,
        }
    }
    /// Whether F without a decimal point has.
    #[inline]
    pub fn feeds_ambiguous(self) -> bool {
        match self {
            Self::AsWritten | Self::AmbiguousLengths => false,
            Self::AmbiguousLengthsAndFeeds => true,
        }
    }
}

/// What happens to the axis of the tool when its length changes: G43, G49, H.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LengthChange {
    /// The coordinates shift and the axis stays; an increment in the same block is travelled as it is written.
    #[default]
    Shifts,
    /// The axis travels the change too, in a block without its word as well.
    Moves,
    /// A parameter decides, or no source states it.
    Undeclared,
}

/// What G28, G30 and G53 do to the length of the tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LengthAfterReturn {
    /// It acts again in the next block.
    #[default]
    Kept,
    /// G28 cancels it, like G49.
    CancelledByG28,
    /// A motion of the tool's axis by any of them cancels it until the next G43 or H.
    Cancelled,
    /// Such a motion cancels it; when it acts again, a parameter decides.
    Undeclared,
}

/// The language of expressions and flow, for carrying a program over to another control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expressions {
    /// RS274/NGC: LinuxCNC, grbl.
    Rs274Ngc,
    /// Custom macro B: Fanuc, Haas.
    MacroB,
    /// Neither.
    Other,
}

impl Dialect {
    /// The language of its expressions and flow. Words alone are read as RS274/NGC, of which they are a subset.
    pub fn expressions(&self) -> Expressions {
        match (self.lex.format, self.quirks.language) {
            (Format::Apt | Format::Klartext | Format::Osp, _)
            | (Format::Iso, Language::Sinumerik | Language::UserTask) => Expressions::Other,
            (Format::Iso, Language::MacroB) => Expressions::MacroB,
            (Format::Iso, Language::Words | Language::Linuxcnc) => Expressions::Rs274Ngc,
        }
    }
}

impl Quirks {
    /// Custom macro B is part of the language.
    #[inline]
    pub fn macro_b(&self) -> bool {
        match self.language {
            Language::MacroB => true,
            Language::Words | Language::Sinumerik | Language::Linuxcnc | Language::UserTask => false,
        }
    }
    /// The program may define names of its own.
    #[inline]
    pub fn user_names(&self) -> bool {
        match self.language {
            Language::Sinumerik | Language::UserTask => true,
            Language::Words | Language::MacroB | Language::Linuxcnc => false,
        }
    }
    /// The program declares its names and its subprograms' parameters: the language of a Sinumerik.
    #[inline]
    pub fn declares_names(&self) -> bool {
        match self.language {
            Language::Sinumerik => true,
            Language::Words | Language::MacroB | Language::Linuxcnc | Language::UserTask => false,
        }
    }
    /// Okuma's user task.
    #[inline]
    pub fn user_task(&self) -> bool {
        match self.language {
            Language::UserTask => true,
            Language::Words | Language::MacroB | Language::Linuxcnc | Language::Sinumerik => false,
        }
    }
    /// Programs are run by LinuxCNC's own interpreter.
    #[inline]
    pub fn rs274(&self) -> bool {
        match self.language {
            Language::Linuxcnc => true,
            Language::Words | Language::MacroB | Language::Sinumerik | Language::UserTask => false,
        }
    }
}
