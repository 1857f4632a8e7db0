//! Floor 0: expressions of RS274/NGC, of Fanuc's Macro B, of Sinumerik and of Okuma's user task: compiled once, evaluated many times.
//!
//! Reading never recurses: a hundred thousand nested brackets need proportional memory, and no stack. Evaluation needs no memory
//! for formulas that keep at most eight values at once. A value that is unknown is NaN and stays so through arithmetic.
//! *It does not know what a word, a block or a variable means.*
mod arithmetic;
mod brackets;
mod code;
mod compile;
mod cursor;
mod degrees;
mod error;
mod eval;
mod infix;
mod name;
mod osp;
mod pool;
mod sinumerik;
mod words;

pub use code::Formula;
pub use compile::{bracketed, target, value, value_or_error};
pub use cursor::Cursor;
pub use error::{FormulaError, FormulaErrorKind};
pub use name::Name;
pub use osp::osp;
pub use pool::Pool;
pub use sinumerik::sinumerik;
use trunnion_syntax::TextRange;

/// Which language an expression is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Grammar {
    /// RS274/NGC as LinuxCNC reads it.
    Rs274,
    /// Fanuc's custom macro B.
    ///
    /// Documented (operator's manuals, chapter custom macro): five levels of brackets, those of functions counted (16/18-C, alarm 118);
    /// numbers are doubles and EQ compares exactly (15i-MA, B-63324EN/03); `<vacant>` is zero but for EQ and NE (the same table is in
    /// Mitsubishi's M700V manual); AND, OR and XOR take the part before the decimal point (Haas 96-8000). Trade knowledge, not read in a manual:
    /// the ranks of the operators, MOD of rounded operands with the sign of the first, FIX towards zero and FUP away from it, variable
    /// numbers rounded, angles of 0 to 360 degrees ([`Variables::positive_angles`]), BIN and BCD of eight digits, ADP as the value itself.
    MacroB,
}

/// The left side of an assignment, after its `#`.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// `#5=`, `##2=`, `#[1+2]=`: the formula of the variable's number.
    Numbered(Formula),
    /// `#<name>=`, Macro B `#_NAME=`: the name without its signs, blanks removed, in lower case.
    Named(Name),
}

/// A variable a formula reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable<'f> {
    /// `#5`.
    Numbered(i64),
    /// `#<name>`, as passed to [`Variables::named`].
    Named(&'f str),
    /// `##2`, `#[1+2]`: the number is only known when it is evaluated. The range of its text.
    Computed(TextRange),
}

/// Why a variable has no value.
#[derive(Clone, Debug, PartialEq)]
pub enum ValueError {
    /// There is no variable of that number.
    OutOfRange,
    /// There is no variable of that name.
    NotDefined,
    /// It cannot be read; the reason, as a sentence.
    NotReadable(Box<str>),
}

/// Where a formula's variables come from.
pub trait Variables {
    /// The value of variable `#index`; NaN if it is not known.
    fn numbered(&self, index: i64) -> Result<f64, ValueError>;

    /// The value of a named variable; NaN if it is not known. `name` is without `<>` or `#`, blanks removed, in lower case.
    fn named(&self, name: &str) -> Result<f64, ValueError>;

    /// The same for a name as formulas hold it, which is compared faster than text.
    #[inline]
    fn named_as(&self, name: &Name) -> Result<f64, ValueError> {
        self.named(name)
    }

    /// The value of `#name[index]` (Macro B on Fanuc's 30i: `[#_ABSIO[1]]`); NaN if it is not known.
    fn named_at(&self, name: &str, index: i64) -> Result<f64, ValueError> {
        let _ = (name, index);
        Err(ValueError::NotDefined)
    }

    /// Whether the named variable has a value (`EXISTS`).
    fn exists(&self, name: &str) -> bool;

    /// Whether there is a variable `#index` (`EXISTS[#5]`).
    fn exists_numbered(&self, index: i64) -> bool {
        self.numbered(index).is_ok()
    }

    /// Whether variable `#index` is `<vacant>` (Macro B). `#0` always is, and is not queried.
    fn null(&self, index: i64) -> bool {
        let _ = index;
        false
    }

    /// Whether a fraction as the index of a named variable stands for the nearest whole number; else it has no element.
    fn rounds_index(&self) -> bool {
        true
    }

    /// Whether ASIN and ATAN give angles of 0 to 360 degrees instead of negative ones (Macro B: Fanuc parameter 6004 bit 0, NAT, is 0);
    /// `None`: it is not known, and so is such an angle.
    fn positive_angles(&self) -> Option<bool> {
        None
    }
}
