//! The program uses a tool length that is not declared.
//!
//! # Why
//! With tool centre point control the linear axes move together with the rotary axes; the longer the tool, the
//! farther. The travel of the axis along the tool depends on the length in any case. All of that is unknown until the
//! length is declared.
//!
//! # Example
//! ```gcode fanuc-30i mikron-ucp710 undeclared
//! N10 G90 G54
//! N20 G0 X0. Y0. Z100.
//! ;   ^^^^^^^^^^^^^^^^ work-offset-unset: G54 is not declared
//! N30 G0 G43 H5 Z100.
//! ;   ^^^^^^^^^^^^^^^ tool-length-unset: the length of tool 5 is not declared
//! ```
//!
//! # Use instead
//! Declare it in `trunnion.toml`: `[[tool]] number = 5, length = 120.5`, in mm; the offset that T0202 of a lathe names:
//! `[tool_offsets] 2 = { X = -120.5, Z = -60 }`, X as a radius. To take all undeclared lengths as zero, use
//! `--assume tool-length` or `assume = ["tool-length"]`: the verdict lists it.
//!
//! # Guarantee
//! Sound; reported once per tool, at the first motion that depends on its length. The offsets of a lathe's tools are one finding.
//!
//! # Sources
//! * docs/contract.md#offsets-and-tool-lengths
use crate::datum::{Missing, Open};
use crate::prelude::*;
use trunnion_interp::LengthOf;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Open(check)]);

fn check(open: &Open, out: &mut Reporter<'_>) {
    let Missing::Length(of) = open.missing else { return };
    let by_turret = matches!(of, LengthOf::Offset(_));
    let missing = open.missing.name(out.dialect());
    let help = open.missing.help(out.dialect());
    out.event(|draft| {
        draft
            .unknown()
            .say(format!(
                "{missing} is not declared: it is unknown whether the axes that it shifts stay within their travel"
            ))
            .note(if by_turret {
                "the last two digits of T name the offset, which shifts X and Z; it lies in the control. This covers all tools"
            } else {
                "the tool length is measured from the gauge point of the spindle to the tip, in mm"
            })
            .help(help);
        for fit in open.fits.iter().filter(|_| !by_turret) {
            if let Ok([low, high]) = fit.range {
                draft
                    .note(format!(
                        "{} stays within its travel with a length of {} to {}",
                        letter(fit.letter),
                        mm(low),
                        mm(high)
                    ))
                    .value("fits_length_min_mm", low)
                    .value("fits_length_max_mm", high);
            }
        }
    });
}
