//! The program uses a work offset that is not declared.
//!
//! # Why
//! The position of the part in the machine decides whether the axes have enough travel. Where rotary axes turn, it
//! also decides how far and how fast the linear axes move and, without tool centre point control, how the tip moves.
//! All of that is unknown until the offset is declared.
//!
//! # Example
//! ```gcode fanuc-30i mikron-ucp710 undeclared
//! N10 G90 G54
//! N20 G0 X0. Y0. Z100.
//! ;   ^^^^^^^^^^^^^^^^ work-offset-unset: G54 is not declared
//! ```
//!
//! # Use instead
//! Declare it in `trunnion.toml`: `[work_offsets] G54 = { X = 0, Y = 0, Z = 0 }`, in mm and degrees. To take all
//! undeclared offsets as zero, use `--assume work-offset` or `assume = ["work-offset"]`: the verdict lists it.
//!
//! # Guarantee
//! Sound; reported once per offset, on machines with rotary axes, at the first motion that depends on it. On a chain
//! of linear axes `axis-limit` reports the offsets that fit.
//!
//! # Sources
//! * docs/contract.md#offsets-and-tool-lengths
use crate::datum::{Missing, Open};
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Open(check)]);

fn check(open: &Open, out: &mut Reporter<'_>) {
    if !open.fits.is_empty() || !matches!(open.missing, Missing::Offset(_)) {
        return;
    }
    let missing = open.missing.name(out.dialect());
    let help = open.missing.help(out.dialect());
    out.event(|draft| {
        draft
            .unknown()
            .say(format!("{missing} is not declared: it is unknown whether the linear axes stay within their travel"))
            .note("where rotary axes turn, the speed of the linear axes is unknown too and, without tool centre point control, the path of the tip; what depends only on the tool axis is judged")
            .help(help);
    });
}
