//! The program defines a tool with another length or diameter than the settings.
//!
//! # Why
//! The control uses what the program defines (TOOL DEF with L and R). Where `trunnion.toml` says otherwise, the program or the settings do not
//! fit the tool that is on the machine: the tip is off by the difference.
//!
//! # Example
//! ```gcode heidenhain-klartext
//! 0 BEGIN PGM A MM
//! 1 ; trunnion: tool 1 length 80
//! 2 TOOL DEF 1 L+120 R+3
//! ; ^^^^^^^^^^^^^^^^^^^^ tool-defined-twice: tool 1 is 120 mm long in the program, but 80 mm in the settings
//! 3 TOOL CALL 1 Z S1000 F500
//! 4 L X+0 Y+0 Z+50 R0 FMAX M3
//! 5 M30
//! 6 END PGM A MM
//! ```
//!
//! # Use instead
//! Measure the tool. Correct the value that is wrong, or delete the tool from the settings.
//!
//! # Guarantee
//! Sound for tools that a block of the program defines. All other findings hold for what the program defines.
//!
//! # Sources
//! * HEIDENHAIN TNC 640 34059x-07 (Klartext programming): TOOL DEF gives length and radius of a tool in the program.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::ToolDefinedTwice {
        tool,
        is_diameter,
        program_mm,
        settings_mm,
    } = fault.kind
    else {
        return;
    };
    let (program, settings) = (mm(program_mm), mm(settings_mm));
    let message = if is_diameter {
        format!("tool {tool} has a diameter of {program} in the program, but {settings} in the settings")
    } else {
        format!("tool {tool} is {program} long in the program, but {settings} in the settings")
    };
    out.report(fault.range, message)
        .note("the control uses what the program defines, and so does this check")
        .help("measure the tool and correct the value that is wrong")
        .value("program_mm", program_mm)
        .value("settings_mm", settings_mm)
        .merge(Merge::once(u64::from(tool) << 1 | u64::from(is_diameter)));
}
