//! The main spindle.

/// What is known of the main spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spindle {
    on: Option<bool>,
    rpm: Option<f64>,
    surface_speed: bool,
    cutting_speed_m_min: Option<f64>,
    limit_rpm: Option<f64>,
    speed_programmed: bool,
    is_unread: bool,
    left: bool,
    was_started: bool,
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
    /// The cutting speed of G96, m/min; `None` where it is off or its value is unknown.
    pub fn cutting_speed_m_min(&self) -> Option<f64> {
        self.cutting_speed_m_min
    }
    /// The highest speed that the program allows (G50 S, G92 S, G96 D), 1/min; NaN where its value could not be read.
    pub fn limit_rpm(&self) -> Option<f64> {
        self.limit_rpm
    }
    /// The program has given an S.
    pub fn speed_programmed(&self) -> bool {
        self.speed_programmed
    }
    /// Something that is not modelled may have switched the spindle or given S: a builder's code, a program that is missing.
    pub fn is_unread(&self) -> bool {
        self.is_unread
    }
    /// It turned before something that stops it on some machines: a tool change, a program stop, a tapping cycle.
    pub fn is_left_to_machine(&self) -> bool {
        self.left
    }
    /// The program has started a spindle; what is not modelled may have done so, too, see [`Self::is_unread`].
    pub fn was_started(&self) -> bool {
        self.was_started
    }
    /// The program switches it on or off.
    pub fn switch(&mut self, on: bool) {
        self.on = Some(on);
        self.left = false;
        self.was_started |= on;
    }
    /// Within a cycle it turns, stops, or goes on as before, without a word of the program.
    pub fn turn(&mut self, on: Option<bool>) {
        self.on = on;
        self.left = false;
    }
    /// A speed is programmed, 1/min; `None`: its value is unknown. Under constant cutting speed S is no speed of the spindle.
    pub fn set_rpm(&mut self, rpm: Option<f64>) {
        self.speed_programmed = true;
        self.rpm = rpm.filter(|_| !self.surface_speed);
    }
    /// Constant cutting speed begins or ends; in both cases the speed of the spindle is unknown until the next S.
    pub fn set_surface_speed(&mut self, on: bool) {
        if std::mem::replace(&mut self.surface_speed, on) || on {
            self.rpm = None;
        }
        self.cutting_speed_m_min = None;
    }
    /// S under constant cutting speed, m/min; `None`: its value is unknown.
    pub fn set_cutting_speed(&mut self, m_min: Option<f64>) {
        self.speed_programmed = true;
        self.cutting_speed_m_min = m_min;
    }
    /// The program limits the speed, 1/min; `None`: it does not any more.
    pub fn limit(&mut self, rpm: Option<f64>) {
        self.limit_rpm = rpm;
    }
    /// What is not modelled may have switched it: whether it turns is unknown.
    pub fn lose(&mut self) {
        self.on = None;
        self.left = false;
        self.is_unread = true;
    }
    /// The machine builder, or a parameter, decides whether it stops here: at a tool change, a program stop, the end of a tap.
    pub fn leave_to_machine(&mut self) {
        if self.on == Some(true) {
            self.on = None;
            self.left = true;
        }
    }
    /// The same, and its speed is unknown, too.
    pub fn forget(&mut self) {
        self.lose();
        self.rpm = None;
    }
    /// What is not modelled may have started it: it is not known to stand still any more.
    pub fn may_start(&mut self) {
        if self.on != Some(true) {
            self.lose();
        }
    }
    /// Equal, where an unknown number equals an unknown number.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        let without_numbers = |spindle: &Self| Self {
            rpm: None,
            cutting_speed_m_min: None,
            limit_rpm: None,
            ..*spindle
        };
        without_numbers(self) == without_numbers(other)
            && super::alike(self.rpm, other.rpm)
            && super::alike(self.cutting_speed_m_min, other.cutting_speed_m_min)
            && super::alike(self.limit_rpm, other.limit_rpm)
    }
}
