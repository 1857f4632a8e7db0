//! The unit in which people read the lengths of a picture. Records are in mm.

const MM_PER_INCH: f64 = 25.4;

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// Millimetre.
    #[default]
    Mm,
    /// Inch: for a program that moves in inch.
    Inch,
}

impl Unit {
    /// Inch or mm.
    pub fn of_inch(inch: bool) -> Self {
        if inch { Self::Inch } else { Self::Mm }
    }
    /// Its sign.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Inch => "in",
        }
    }
    /// A length or feed in mm, in this unit.
    pub fn of_mm(self, mm: f64) -> f64 {
        match self {
            Self::Mm => mm,
            Self::Inch => mm / MM_PER_INCH,
        }
    }
    /// A length in this unit, in mm.
    pub(crate) fn to_mm(self, value: f64) -> f64 {
        match self {
            Self::Mm => value,
            Self::Inch => value * MM_PER_INCH,
        }
    }
    /// Decimals that are as fine as so many of a length in mm, or finer.
    pub fn digits(self, of_mm: usize) -> usize {
        match self {
            Self::Mm => of_mm,
            Self::Inch => of_mm + 2,
        }
    }
    /// A length in mm as text in this unit, with so many decimals for mm: `12.7 mm`, `0.5 in`.
    pub(crate) fn text(self, mm: f64, digits: usize) -> String {
        format!("{:.*} {}", self.digits(digits), self.of_mm(mm), self.name())
    }
    /// The same without zeros at the end, for a value that somebody declared.
    pub(crate) fn declared(self, mm: f64) -> String {
        let text = format!("{:.*}", self.digits(6), self.of_mm(mm));
        let text = text.trim_end_matches('0').trim_end_matches('.');
        format!("{text} {}", self.name())
    }
    /// The name of an axis that shows the travel.
    pub(crate) fn travel(self) -> &'static str {
        match self {
            Self::Mm => "travel of the tool tip / mm",
            Self::Inch => "travel of the tool tip / in",
        }
    }
}
