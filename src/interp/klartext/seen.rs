//! What a program that is called sees of its caller, beside parameters and the modal state: the cycle that CYCL CALL runs, and the pole.
use super::Klartext;
use super::hole::Cycle;
use crate::Argument;

impl Klartext<'_> {
    /// See the module. Values that are not known are left out: how they are written is compared where they are.
    pub(super) fn what_calls_see(&self) -> Vec<Argument> {
        let mut seen = Vec::new();
        match &self.memory.cycle {
            Cycle::None => {}
            Cycle::Hole(hole) => {
                seen.push(Argument::number("cycle", f64::from(hole.cycle)));
                for (parameter, value) in &hole.given {
                    seen.extend(value.map(|value| Argument::number(format!("cycle {parameter}"), value)));
                }
            }
            Cycle::Other(number) => seen.push(Argument::number("cycle", f64::from(*number))),
            Cycle::Old(old) => seen.extend(old.arguments()),
        }
        for (axis, value) in ["X", "Y", "Z"].into_iter().zip(self.memory.pole) {
            seen.extend(value.map(|value| Argument::number(format!("pole {axis}"), value)));
        }
        seen
    }
}
