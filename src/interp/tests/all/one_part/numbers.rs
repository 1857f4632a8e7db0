//! Numbers and angles of a part as they are written.
use super::written::Control;
use std::fmt::Write as _;
use trunnion_geometry::math::{atan2, cos, hypot, sin};

/// A number with up to seven decimals; with a point for a Fanuc, with a sign for Klartext.
pub(super) fn number(control: Control, value: f64) -> String {
    let text = format!("{value:.7}");
    let text = text.trim_end_matches('0');
    let text = if text == "-0." { "0." } else { text };
    match control {
        Control::Fanuc => text.to_owned(),
        Control::Klartext if !text.starts_with('-') => format!("+{}", text.trim_end_matches('.')),
        _ => text.trim_end_matches('.').to_owned(),
    }
}

/// Angles about Z, the new X, the new Z of turns by `a`, `b`, `c` about the fixed X, Y, Z.
pub(super) fn euler([a, b, c]: [f64; 3]) -> [f64; 3] {
    let [(sa, ca), (sb, cb), (sc, cc)] = [a, b, c].map(|angle| (sin(angle.to_radians()), cos(angle.to_radians())));
    // the third column and the third row of Rz(c) Ry(b) Rx(a)
    let z = [cc * sb * ca + sc * sa, sc * sb * ca - cc * sa, cb * ca];
    let row = [-sb, cb * sa];
    if hypot(z[0], z[1]) < 1e-12 {
        // upright, as a is 0 or 180 only where b is 0: a turn about Z
        return [c, 0.0, 0.0];
    }
    [
        atan2(z[0], -z[1]),
        atan2(hypot(z[0], z[1]), z[2]),
        atan2(row[0], row[1]),
    ]
    .map(f64::to_degrees)
}

#[test]
fn numbers_are_written_for_their_control() {
    let mut text = String::new();
    for control in super::written::ALL {
        let _ = write!(text, "{} {} ", number(control, 12.0), number(control, -0.000_000_01));
    }
    assert_eq!(text, "+12 +0 12 0 12. 0. 12 0 ");
}
