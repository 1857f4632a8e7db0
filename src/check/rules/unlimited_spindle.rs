//! A cut with constant surface speed while no spindle speed limit is programmed.
//!
//! # Why
//! Under G96 the spindle turns faster as the tool comes closer to the centre line. Without a limit it reaches the
//! machine's maximum speed, whether or not the chuck and the part can take it.
//!
//! # Example
//! ```gcode fanuc-30i-lathe-a
//! N10 G96 S200 M3
//! N20 G0 X50. Z0.
//! N30 G1 X0. F0.1
//! ;   ^^^^^^^^^^^ unlimited-spindle: constant surface speed without a spindle speed limit
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i-lathe-a
//! N5 G50 S2000
//! N10 G96 S200 M3
//! N20 G0 X50. Z0.
//! N30 G1 X0. F0.1
//! ```
//! In G code systems B and C the limit is G92 S2000, on LinuxCNC it is D: `G96 D2000 S200`.
//!
//! # Guarantee
//! Sound for the Fanuc dialects and LinuxCNC: reported once per program, at the first feed motion under G96 before any limit. A
//! limit that a builder's subprogram or a parameter sets is not known.
//!
//! # Sources
//! * FANUC Series 30i B-64484EN-1 (lathe system): constant surface speed control and maximum spindle speed clamp.
//! * grammar/dialects/linuxcnc.toml, the table of its codes: G96.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::CutSpindleUnlimited(check)]);

fn check(cut: &facts::CutSpindleUnlimited<'_>, out: &mut Reporter<'_>) {
    let Some(help) = &cut.dialect.advice.spindle_limit else {
        return;
    };
    if out.once(0) {
        out.report_block("constant surface speed without a spindle speed limit")
            .note("the spindle runs up to the machine's maximum speed as the tool approaches the centre line")
            .help(help);
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_limit_or_turns_per_minute_will_do() {
        assert_drawn(
            "gcode fanuc-30i-lathe-b",
            "G92 S2000\nG96 S200 M3\nG0 X50. Z0.\nG1 X0. F0.1\n",
        );
        assert_drawn(
            "gcode fanuc-30i-lathe-a",
            "G96 S200 M3\nG0 X50. Z0.\nG97 S500\nG1 X0. F0.1\n",
        );
        assert_drawn("gcode linuxcnc", "G96 D2000 S200 M3\nG0 X50 Z0\nG1 X0 F100\nM2\n");
    }

    #[test]
    fn it_is_told_once() {
        assert_drawn(
            "gcode fanuc-30i-lathe-a",
            "G96 S200 M3\nG0 X50. Z0.\nG1 X40. F0.1\n;^^^^^^^^^^^ unlimited-spindle: \nX30.\nX20.\n",
        );
    }
}
