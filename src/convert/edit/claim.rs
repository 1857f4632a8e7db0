//! What is claimed of a moved path, what cannot be asked for, and what the user must know.
use super::shape::Work;
use super::{Change, Shape};
use crate::refuse::Refused;
use trunnion_dialect::Dialect;

/// What no program can be.
pub(super) fn possible(dialect: &Dialect, shape: Shape) -> Result<(), Refused> {
    let lathe = dialect.quirks.diameter;
    match shape {
        Shape::Scale(factor) if !(factor.is_finite() && factor > 0.0) => Err(Refused::new(
            "the scale must be a positive number; --mirror turns a sign",
        )),
        Shape::Mirror(_) | Shape::Rotate(..) if lathe => Err(Refused::new(
            "a turned part is not mirrored or turned on a lathe: the tool cuts on one side of the spindle axis",
        )),
        Shape::Shift(by) if lathe && by[0] != 0.0 => Err(Refused::new(
            "a shift along X of a turned part changes its diameters and is no shift of the part: shift along Z",
        )),
        Shape::Shift(by) if by.iter().any(|value| !value.is_finite()) => {
            Err(Refused::new("a shift must be a number of at most nine digits"))
        }
        Shape::Rotate(_, degrees) if !degrees.is_finite() => Err(Refused::new("the angle must be a number of degrees")),
        _ => Ok(()),
    }
}

/// What is to be proved of a path that is moved so. `decimals`: digits of rounded words.
pub(super) fn change(shape: Shape, decimals: usize, unit_mm: f64) -> Change {
    let exact = matches!(shape, Shape::Shift(_) | Shape::Mirror(_));
    let end_mm = if exact {
        1e-6
    } else {
        unit_mm * 0.5 * 10f64.powi(-(decimals as i32)) * 1.000_1 + 1e-9
    };
    let mut change = Change::nothing(end_mm, 10.0 * end_mm, 1e-9);
    match shape {
        Shape::Shift(by) => change.shift = by.map(|by| by * unit_mm),
        Shape::Scale(factor) => {
            for axis in 0..3 {
                change.linear[axis][axis] = factor;
            }
        }
        Shape::Mirror(axis) => change.linear[axis][axis] = -1.0,
        Shape::Rotate(axis, degrees) => {
            let (sin, cos) = super::turn::sin_cos(degrees);
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            (change.linear[u][u], change.linear[u][v]) = (cos, -sin);
            (change.linear[v][u], change.linear[v][v]) = (sin, cos);
        }
    }
    change
}

impl Work<'_> {
    /// What is to be proved.
    pub(super) fn change(&self, unit_mm: f64) -> Change {
        Change {
            part: self.part,
            ..change(self.shape, self.decimals, unit_mm)
        }
    }

    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = vec![
            "the part is another one: check the program again for travel, clamps and stock; what is in machine coordinates (G53, G28) stays".to_owned(),
        ];
        match self.shape {
            Shape::Mirror(_) => {
                notes
                    .push("climb milling becomes conventional milling, because the spindle turns as before".to_owned());
                if self.taps {
                    notes.push("tapped holes keep their hand: a right-hand thread stays one".to_owned());
                }
            }
            Shape::Scale(_) => {
                notes
                    .push("feeds, speeds, dwells and tools are unchanged; peck steps and levels are scaled".to_owned());
                if self.compensated {
                    notes.push("the radius of cutter compensation is not scaled".to_owned());
                }
            }
            Shape::Shift(_) | Shape::Rotate(..) => {}
        }
        if self.part.is_some() {
            notes.push(
                "only the chosen lines are moved: the rapids that lead into them and out of them take another way"
                    .to_owned(),
            );
        }
        notes
    }
}
