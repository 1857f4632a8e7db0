//! AUXFUN/n: the post-processor puts out Mn (ISO 4343, post processor commands). What the numbers below 31 do on every control is in ISO 6983-1, table
//! of miscellaneous functions.
use crate::FaultKind;
use crate::apt::{Apt, Args};
use crate::core::Report;

impl Apt<'_> {
    pub(super) fn auxiliary(&mut self, args: &Args, report: &mut Report<'_>) {
        let number = match args.numbers() {
            &[number] if !args.odd && args.words().is_empty() && number.fract() == 0.0 => Some(number as i64),
            _ => None,
        };
        let spindle = &mut self.core.state.spindle;
        match number {
            Some(0 | 1) => spindle.leave_to_machine(),
            Some(2 | 30) => {
                self.core.state.ended = true;
                self.core.proper_end = true;
            }
            Some(3 | 4) => spindle.switch(true),
            Some(5 | 19) => spindle.switch(false),
            Some(7..=9) => {}
            Some(6) | None => {
                let what = report.program.text(report.whole()).into_owned();
                report.fault(report.whole(), FaultKind::NotModelled { what });
                spindle.lose();
                self.lose_place();
            }
            // what the machine builder gives it
            Some(_) => spindle.may_start(),
        }
    }
}
