//! What the program says of the spindle, as events.
use crate::events::EventCollector;
use crate::job::Event;
use crate::refuse::Refused;
use trunnion_syntax::BlockId;

/// The last command to the spindle.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Spindle {
    Unknown,
    Off,
    /// Counter-clockwise, and its speed.
    On(bool, f64),
}

impl EventCollector<'_> {
    pub(crate) fn spindle(
        &mut self,
        on: Option<bool>,
        rpm: Option<f64>,
        turns: bool,
        block: BlockId,
    ) -> Result<(), Refused> {
        let wanted = match (on, rpm) {
            (None, _) => return Ok(()),
            (Some(false), _) => Spindle::Off,
            (Some(true), Some(rpm)) => Spindle::On(turns, rpm),
            (Some(true), None) => {
                let message = "the spindle turns at an unknown speed (none is programmed, or a cutting speed is)";
                return Err(Refused::at(self.program, block, message));
            }
        };
        if self.spindle != wanted {
            self.spindle = wanted;
            let event = match wanted {
                Spindle::On(ccw, rpm) => Event::SpindleOn(ccw, rpm),
                Spindle::Off | Spindle::Unknown => Event::SpindleOff,
            };
            self.job.push(event, block);
            self.speed = rpm.filter(|_| on == Some(true)).or(self.speed);
        }
        Ok(())
    }

    /// A cut runs where it is not known whether the spindle turns: after a stop, or without M3. The speed is that of the program.
    pub(crate) fn speed(&mut self, rpm: Option<f64>, block: BlockId) {
        if let Some(speed) = rpm.filter(|_| rpm != self.speed) {
            self.speed = rpm;
            self.job.push(Event::Speed(speed), block);
        }
    }
}
