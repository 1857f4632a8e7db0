//! The main spindle.

/// What is known of the main spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spindle {
    on: Option<bool>,
    rpm: Option<f64>,
    surface_speed: bool,
    limit_rpm: Option<f64>,
}

impl Spindle {
    /// Whether it turns; `None`: unknown.
    pub fn on(&self) -> Option<bool> {
        self.on
    }
    /// 1/min; `None` before the first S, and under constant cutting speed.
    pub fn rpm(&self) -> Option<f64> {
        self.rpm
    }
    /// G96: S is a cutting speed.
    pub fn surface_speed(&self) -> bool {
        self.surface_speed
    }
    /// The highest speed that the program allows (G50 S, G92 S), 1/min; NaN where its value could not be read.
    pub fn limit_rpm(&self) -> Option<f64> {
        self.limit_rpm
    }
    /// It starts, stops, or does what is unknown.
    pub fn turn(&mut self, on: Option<bool>) {
        self.on = on;
    }
    /// A speed is programmed, 1/min; `None`: its value is unknown. Under constant cutting speed S is no speed of the spindle.
    pub fn set_rpm(&mut self, rpm: Option<f64>) {
        self.rpm = rpm.filter(|_| !self.surface_speed);
    }
    /// Constant cutting speed begins or ends; in both cases the speed of the spindle is unknown until the next S.
    pub fn set_surface_speed(&mut self, on: bool) {
        if std::mem::replace(&mut self.surface_speed, on) || on {
            self.rpm = None;
        }
    }
    /// The program limits the speed, 1/min.
    pub fn limit(&mut self, rpm: f64) {
        self.limit_rpm = Some(rpm);
    }
    /// Whether it turns, and how fast, is unknown from here on.
    pub fn lose(&mut self) {
        (self.on, self.rpm) = (None, None);
    }
    /// Equal, where an unknown number equals an unknown number.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        (self.on, self.surface_speed) == (other.on, other.surface_speed)
            && super::alike(self.rpm, other.rpm)
            && super::alike(self.limit_rpm, other.limit_rpm)
    }
}
