//! An arc has neither a centre nor a radius.
//!
//! # Why
//! The control cannot know which arc is meant. Most controls stop, some move in a straight line.
//!
//! # Example
//! ```gcode
//! N10 G17 G0 X0 Y0
//! N20 G2 X10 Y0 F300
//! ;      ^^^ arc-centre-missing: the arc has neither centre nor radius
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G17 G0 X0 Y0
//! N20 G2 X10 Y0 I5 J0 F300
//! ```
//!
//! # Guarantee
//! Sound. Where the program names no plane and the centre has a distance along Z, the plane G17 is only assumed: unknown.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.5.3 on arcs at feed rate (G2, G3).
use crate::prelude::*;
use trunnion_syntax::{Address, BlockId, Program, Value, Word};

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::ArcCentre, plain)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::ArcCentreMissing {
        if !out.names_plane() && lies_elsewhere(out.program(), fault.block) {
            out.report(
                fault.range,
                "the centre of this arc lies in another plane than G17, which is assumed: the program names no plane",
            )
            .note("where the control starts in another plane, as a lathe does in G18, the arc is another one; its path was not checked")
            .help("write G18 or G19 before it, declare `[control] power_on`, or name the dialect if it is a program for a lathe")
            .unknown()
            .merge(Merge::once(0));
            return;
        }
        let (message, help) = cause(out.program(), fault.block);
        out.report(fault.range, message).help(help);
    }
}

/// Whether the centre words of a block have a distance along Z, which the plane G17 does not have.
fn lies_elsewhere(program: &Program, block: BlockId) -> bool {
    let view = program.block(block);
    let is_far = |word: Word| {
        matches!(word.address, Address::Letter(b'K'))
            && matches!(word.value, Value::Number(number) | Value::Call(_, number) if number.to_f64() != 0.0)
    };
    view.record().is_none() && view.words().any(is_far)
}

/// What the block lacks, by the words it has, and what to do.
fn cause(program: &Program, block: BlockId) -> (&'static str, &'static str) {
    let view = program.block(block);
    let words = || view.record().is_none().then(|| view.words()).into_iter().flatten();
    let is_radius = |address: Address| match address {
        Address::Letter(letter) => letter == b'R',
        Address::Named(range) => program.bytes(range).eq_ignore_ascii_case(b"CR"),
        Address::Indexed(..) => false,
    };
    let is_centre = |word: &Word| matches!(word.address, Address::Letter(b'I' | b'J' | b'K'));
    let is_zero =
        |word: Word| matches!(word.value, Value::Number(number) | Value::Call(_, number) if number.to_f64() == 0.0);
    if words().any(|word| is_radius(word.address)) {
        return (
            "the arc ends where it starts: a radius cannot describe a full circle",
            "write the centre words of the plane (G17: I J, G18: K I, G19: J K)",
        );
    }
    let help = "write the distances from the arc's start to its centre (G17: I J, G18: K I, G19: J K)";
    match words().filter(is_centre).count() {
        0 => (
            "the arc has neither centre nor radius",
            "write the centre words of the plane (G17: I J, G18: K I, G19: J K), or a radius",
        ),
        _ if words().filter(is_centre).all(is_zero) => {
            ("the arc's centre is its start point: this is not a circle", help)
        }
        1 => ("the arc's centre lacks a coordinate in the plane", help),
        _ => ("the arc's centre is its start point: this is not a circle", help),
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    /// A lathe starts in G18.
    #[test]
    fn a_centre_in_another_plane_than_the_assumed_one() {
        let arc = "G0 X40 Z98\nG3 X50 Z93 I0 K-5 F100\n";
        let unused = ";             ^^^ unused-word: `K-5` is not used";
        let own = |said: &str| format!(";  ^^^ arc-centre-missing: {said}\n{unused}\nM30\n");
        let assumed = own("the centre of this arc lies in another plane than G17, which is assumed");
        assert_drawn("gcode", &format!("{arc}{assumed}"));
        let said = own("the arc's centre is its start point");
        assert_drawn("gcode", &format!("G17 {arc}{said}"));
    }

    #[test]
    fn what_is_there_is_not_said_to_be_missing() {
        assert_drawn(
            "gcode",
            "N10 G17 G90 G0 X0 Y0\nN20 G2 X0 Y0 R5 F300\n;      ^^ arc-centre-missing: the arc ends where it starts: a radius cannot describe a full circle\n",
        );
        assert_drawn(
            "gcode",
            "N10 G17 G90 G0 X0 Y0\nN20 G2 X10 Y0 I0 J0 F300\n;      ^^^ arc-centre-missing: the arc's centre is its start point\n",
        );
    }
}
