//! The program stops itself here with an alarm.
//!
//! # Why
//! Macros protect themselves: `#3000 = 1 (NO TOOL)` on Fanuc, `(ABORT, no tool)` on LinuxCNC. The run reaches this
//! place, so with these values the program ends here, and what follows never runs.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 IF [#1 GT 0] GOTO 40
//! N30 #3000 = 1 (DEPTH IS ZERO)
//! ;^^^^^^^^^^^^^^^^^^^^^^^^^^^^ program-alarm: the program stops itself here
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #1 = 5
//! N20 IF [#1 GT 0] GOTO 40
//! N30 #3000 = 1 (DEPTH IS ZERO)
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound: reported only where the run proves that the place is reached.
//!
//! # Sources
//! * FANUC Series 16i/18i-PB B-63684EN/01: custom macro, system variables.
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::ProgramAlarm { message } = &fault.kind {
        let text = message.trim();
        out.report(
            fault.range,
            if text.is_empty() {
                "the program stops itself here with an alarm".to_owned()
            } else {
                format!("the program stops itself here with the alarm \"{text}\"")
            },
        )
        .note("what follows does not run")
        .help("check which condition leads here");
    }
}
