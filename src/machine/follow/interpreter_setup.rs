//! The data of a machine for the interpreter of a program.
use crate::follow::words::Words;
use crate::{AxisKind, Machine, Side};
use trunnion_geometry::Vec3;
use trunnion_interp::{ControlData, RotaryTurn};

impl Machine {
    /// Copies the declarations of the machine into the data of its control: the codes of its kinematics and clamps, its further axes, and where its tool
    /// points at home. Data of another machine are removed; without a machine, all of it.
    pub fn tell(machine: Option<&Self>, control: &mut ControlData) {
        control.tcp_codes = machine.and_then(|machine| machine.control.tcp_codes.clone());
        control.clamp_codes = machine.map(Self::clamp_codes).unwrap_or_default();
        control.further_axes = machine.map(Self::further_axes).unwrap_or_default();
        control.axes_declared = machine.is_some();
        control.length_along = machine.and_then(Self::length_along);
        control.rotary_turns = machine.and_then(Self::rotary_turns);
        control.x_diameter = machine.is_some_and(|machine| {
            machine
                .axes
                .iter()
                .any(|axis| axis.letter == b'X' && axis.extra.diameter)
        });
        control.absent_axis = machine.and_then(Self::absent_axis);
        control.has_rotary =
            machine.is_some_and(|machine| machine.axes.iter().any(|axis| axis.kind == AxisKind::Rotary));
    }

    /// Index of the letter of the axis that it lacks.
    pub(crate) fn absent_axis(&self) -> Option<u8> {
        let letter = trunnion_interp::AxisLetter::new(self.absent?)?;
        Some(letter.0)
    }

    /// How far 1 mm of tool length moves a joint while words are joints, mm: 0 for rotary axes.
    pub fn per_length(&self, joint: usize) -> f64 {
        Words::new(self).joint_per_length(joint)
    }

    /// Letters of its axes other than X Y Z A B C.
    fn further_axes(&self) -> Vec<u8> {
        let letters = self.axes.iter().map(|axis| axis.letter);
        letters.filter(|letter| !b"XYZABC".contains(letter)).collect()
    }

    /// Its rotary axes for planes that are given by their positions. `None` where the tool does not point along Z at home, or a rotary axis is held.
    fn rotary_turns(&self) -> Option<Vec<RotaryTurn>> {
        let held = self.held().any(|(joint, _)| self.axes[joint].kind == AxisKind::Rotary);
        let upright = self.tool_axis == Vec3::z();
        let turn = |rotary: &crate::RotaryAxis| {
            let axis = &self.axes[rotary.joint];
            let letter = trunnion_interp::AxisLetter::new(axis.letter)?;
            Some(RotaryTurn {
                letter: usize::from(letter.0),
                direction: (rotary.direction * rotary.sign).into(),
                on_table: axis.side == Side::Table,
            })
        };
        (!held && upright).then(|| self.constants.rotary().iter().map(turn).collect())?
    }

    /// By how much 1 mm of tool length shifts the words of X, Y and Z (diameters by 2 mm) while they are joints: the tool axis at home.
    /// `None` where that is Z alone.
    pub(crate) fn length_along(&self) -> Option<[f64; 3]> {
        let along = Words::new(self).length_along();
        (along != [0.0, 0.0, 1.0]).then_some(along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin;

    #[test]
    fn nothing_of_another_machine_is_left() {
        let machine = builtin("linuxcnc-xyzbca-trsrn").expect("built in");
        let mut control = ControlData {
            further_axes: vec![b'W'],
            length_along: Some([1.0, 0.0, 0.0]),
            ..ControlData::default()
        };
        control.clamp_codes[3] = Some(trunnion_interp::ClampCodes { on: 10, off: 11 });
        Machine::tell(Some(machine), &mut control);
        assert!(machine.control.tcp_codes.is_some());
        assert_eq!(control.tcp_codes, machine.control.tcp_codes);
        assert_eq!(control.clamp_codes, machine.clamp_codes());
        assert_eq!(control.length_along, None);
        Machine::tell(None, &mut control);
        assert_eq!(control, ControlData::default());
    }
}
