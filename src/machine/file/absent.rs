//! The axis that a machine with two linear axes lacks: Y of a lathe, Z of a laser.
//!
//! The formulas need three directions. The missing one is a chain member of its own that never moves: no program can name it, and what
//! people see of the machine leaves it out.
use crate::kinematics::constants::NEARLY_FLAT;
use crate::{Axis, AxisExtra, AxisKind, Limits, Side};
use trunnion_geometry::Vec3;

/// Adds the missing axis to two linear axes and no rotary one, last in the chain, and returns its letter. Any other set of axes stays.
pub(crate) fn complete(axes: &mut Vec<Axis>) -> Option<u8> {
    let [one, other] = &axes[..] else { return None };
    if [one, other].iter().any(|axis| axis.kind != AxisKind::Linear) {
        return None;
    }
    let across = one.direction.cross(&other.direction);
    if across.norm() < NEARLY_FLAT {
        return None;
    }
    let usual = [(b'X', Vec3::x()), (b'Y', Vec3::y()), (b'Z', Vec3::z())];
    let free = usual
        .iter()
        .filter(|(letter, _)| ![one.letter, other.letter].contains(letter));
    let (letter, along) = free
        .map(|(letter, direction)| (*letter, direction.dot(&across)))
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let direction = across.normalize() * if along < 0.0 { -1.0 } else { 1.0 };
    axes.push(Axis {
        letter,
        kind: AxisKind::Linear,
        side: Side::Head,
        direction,
        point: Vec3::zeros(),
        sign: 1.0,
        limits: Limits::Unbounded,
        max_speed: None,
        max_acceleration: None,
        note: None,
        source: None,
        extra: AxisExtra::default(),
    });
    Some(letter)
}

#[cfg(test)]
mod tests {
    use crate::load;

    /// A machine with these two axes, letter and direction.
    fn machine(axes: [(&str, &str); 2]) -> Result<crate::Machine, crate::MachineError> {
        let entry = |(letter, dir): (&str, &str)| {
            format!("[[axis]]\nletter = \"{letter}\"\nkind = \"linear\"\ndir = {dir}\nsign = 1\n")
        };
        load(
            "two",
            &format!("schema = \"ncmachine/1\"\n{}{}", entry(axes[0]), entry(axes[1])),
        )
    }

    #[test]
    fn a_lathe_lacks_y_and_a_laser_z() {
        for (axes, lacks, direction) in [
            ([("X", "[1, 0, 0]"), ("Z", "[0, 0, 1]")], b'Y', [0.0, 1.0, 0.0]),
            ([("Z", "[0, 0, 1]"), ("X", "[1, 0, 0]")], b'Y', [0.0, 1.0, 0.0]),
            ([("X", "[1, 0, 0]"), ("Y", "[0, 1, 0]")], b'Z', [0.0, 0.0, 1.0]),
        ] {
            let machine = machine(axes).expect("two axes are enough");
            assert_eq!(machine.absent, Some(lacks));
            assert_eq!(<[f64; 3]>::from(machine.axes[2].direction), direction);
            assert_eq!(machine.own_axes().count(), 2);
        }
    }

    #[test]
    fn two_parallel_axes_are_not_enough() {
        let error = machine([("Z", "[0, 0, 1]"), ("W", "[0, 0, 1]")]).expect_err("they span no plane");
        assert!(
            error.message.starts_with("linear axes in independent directions"),
            "{error}"
        );
    }
}
