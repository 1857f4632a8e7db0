//! The tool axis in the workpiece frame written as a formula in the rotary joints.
use crate::Machine;
use crate::file::text::number;
use trunnion_geometry::Vec3;

/// Coefficients below this are rounding and are left out.
const NOTHING: f64 = 1e-12;

/// `(sin A sin C, -sin A cos C, cos A)`: u = Rot(e1, s1 q1) Rot(e2, s2 q2) k0 (kinematics notes 2.1) multiplied out.
pub(crate) fn tool_axis_formula(machine: &Machine) -> String {
    let constants = &machine.constants;
    // the vector as a sum of terms: coefficient vector and the product of sines and cosines that goes with it
    let mut terms: Vec<(Vec3, String)> = vec![(machine.tool_axis, String::new())];
    for rotary in constants.rotary().iter().rev() {
        let letter = char::from(machine.axes[rotary.joint].letter);
        let mut turned = Vec::new();
        for (vector, factors) in terms {
            let along = rotary.direction * rotary.direction.dot(&vector);
            let across = vector - along;
            let side = rotary.direction.cross(&vector) * rotary.sign;
            let with = |name: &str| format!("{factors} {name} {letter}").trim_start().to_owned();
            turned.push((along, factors.clone()));
            turned.push((across, with("cos")));
            turned.push((side, with("sin")));
        }
        terms = turned;
    }
    let component = |index: usize| {
        let mut text = String::new();
        for (vector, factors) in &terms {
            let value = vector[index];
            if value.abs() < NOTHING {
                continue;
            }
            let sign = match (text.is_empty(), value < 0.0) {
                (true, true) => "-",
                (true, false) => "",
                (false, true) => " - ",
                (false, false) => " + ",
            };
            text.push_str(sign);
            let size = value.abs();
            if factors.is_empty() {
                text.push_str(&number(size));
            } else if (size - 1.0).abs() < NOTHING {
                text.push_str(factors);
            } else {
                text.push_str(&number(size));
                text.push(' ');
                text.push_str(factors);
            }
        }
        if text.is_empty() { "0".to_owned() } else { text }
    };
    format!("({}, {}, {})", component(0), component(1), component(2))
}
