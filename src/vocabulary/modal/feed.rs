//! F: what it means, and its value.

/// What F means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// G94.
    PerMinute,
    /// G95.
    PerRevolution,
    /// G93.
    InverseTime,
}

/// F in effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedWord {
    mode: FeedMode,
    value: Option<f64>,
    unit_mm: f64,
}

impl FeedWord {
    /// Before the first F, in mm.
    pub fn new(mode: FeedMode) -> Self {
        Self {
            mode,
            value: None,
            unit_mm: 1.0,
        }
    }
    /// Meaning of F.
    pub fn mode(&self) -> FeedMode {
        self.mode
    }
    /// F in mm/min, mm/rev or 1/min; `None` before the first, and where its value could not be read.
    pub fn value(&self) -> Option<f64> {
        self.value
    }
    /// mm per length unit of F.
    pub fn unit_mm(&self) -> f64 {
        self.unit_mm
    }
    /// F is programmed, in mm/min, mm/rev or 1/min; `None`: its value is unknown.
    pub fn set(&mut self, value: Option<f64>) {
        self.value = value;
    }
    /// What F means is programmed; F keeps its value.
    pub fn set_mode(&mut self, mode: FeedMode) {
        self.mode = mode;
    }
    /// The same, where the control forgets F.
    pub fn switch_mode(&mut self, mode: FeedMode) {
        (self.mode, self.value) = (mode, None);
    }
    pub(super) fn set_unit(&mut self, unit_mm: f64) {
        self.unit_mm = unit_mm;
    }
    /// Equal, where an unknown number equals an unknown number.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        self.mode == other.mode && self.unit_mm == other.unit_mm && super::alike(self.value, other.value)
    }
}
