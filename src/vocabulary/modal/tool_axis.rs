//! How the tool axis is programmed and led.

/// Tool centre point control and the ways to program the tool axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToolAxis {
    tcp: bool,
    great_circle: Option<bool>,
    vectors: bool,
    multax: bool,
}

impl ToolAxis {
    /// Tool centre point control is on.
    pub fn tcp(&self) -> bool {
        self.tcp
    }
    /// The tool axis turns on great circles; `None`: the program has not chosen.
    pub fn great_circle(&self) -> Option<bool> {
        self.great_circle
    }
    /// G43.5, APT: vectors are programmed.
    pub fn vectors(&self) -> bool {
        self.vectors
    }
    /// APT MULTAX.
    pub fn multax(&self) -> bool {
        self.multax
    }
    /// Tool centre point control goes on or off.
    pub fn set_tcp(&mut self, on: bool) {
        self.tcp = on;
    }
    /// ORIVECT, ORIAXES; `None`: as before the program has chosen.
    pub fn set_great_circle(&mut self, on: Option<bool>) {
        self.great_circle = on;
    }
    /// Vectors are programmed, or axes.
    pub fn set_vectors(&mut self, on: bool) {
        self.vectors = on;
    }
    /// MULTAX, MULTAX/OFF.
    pub fn set_multax(&mut self, on: bool) {
        self.multax = on;
    }
}
