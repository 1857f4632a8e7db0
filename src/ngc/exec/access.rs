//! Numbered parameters that the control updates with its state.
use super::ends::word;
use crate::{Block, Engine, Pose, Units};

/// First numbers of the nine axes: G28, G30, G92, and the coordinate systems every 20 from 5221.
pub(crate) const HOME: usize = 5161;
/// See [`HOME`].
pub(crate) const SECOND_HOME: usize = 5181;
/// 1: G92 is in effect.
pub(crate) const G92_ON: usize = 5210;
/// See [`HOME`].
pub(crate) const G92: usize = 5211;
/// See [`HOME`].
const SYSTEMS: usize = 5221;

/// First parameter of a coordinate system, 1-9.
pub(crate) fn system(index: i32) -> usize {
    SYSTEMS + 20 * (index.clamp(1, 9) as usize - 1)
}

impl Engine {
    /// A numbered parameter.
    pub(crate) fn parameter(&self, index: usize) -> f64 {
        self.store.number(index)
    }
    /// Writes a numbered parameter, also one that programs may only read.
    pub(crate) fn set_parameter(&mut self, index: usize, value: f64) {
        self.store.set_number(index, value);
    }
    /// Program units per unit of the parameters and the tool table.
    pub(crate) fn stored_unit(&self) -> f64 {
        self.setup.machine_units.mm() / self.state.units.mm()
    }
    /// Nine parameters as a pose in program units.
    pub(crate) fn stored_pose(&self, first: usize) -> Pose {
        let unit = self.stored_unit();
        std::array::from_fn(|axis| self.parameter(first + axis) * scale(axis, unit))
    }
    /// Writes a pose in program units.
    pub(crate) fn store_pose(&mut self, first: usize, pose: &Pose) {
        let unit = self.stored_unit();
        for (axis, value) in pose.iter().enumerate() {
            self.set_parameter(first + axis, value / scale(axis, unit));
        }
    }
    /// Offset in program units and rotation in deg of a coordinate system, 1-9.
    pub(crate) fn stored_origin(&self, index: i32) -> (Pose, f64) {
        let first = system(index);
        (self.stored_pose(first), self.parameter(first + 9))
    }
    /// The offset of G92 from the parameters, program units.
    pub(crate) fn stored_axis_offset(&self) -> Pose {
        match self.parameter(G92_ON) {
            0.0 => [0.0; 9],
            on if on.is_nan() => [f64::NAN; 9],
            _ => self.stored_pose(G92),
        }
    }
    /// A pose with the words of the block: the rest stays.
    pub(crate) fn over(&self, block: &Block, pose: Pose) -> Pose {
        std::array::from_fn(|axis| word(&self.state, block, super::ends::AXES[axis]).unwrap_or(pose[axis]))
    }
    /// Parameters that follow the state: position (5420-5428, program units) and the tool in the spindle (5400-5413, units of the table).
    pub(crate) fn refresh_parameters(&mut self) {
        self.store.set_numbers(5420, self.state.place());
    }
}

/// Lengths scale, degrees do not.
pub(crate) fn scale(axis: usize, unit: f64) -> f64 {
    if (3..6).contains(&axis) { 1.0 } else { unit }
}

/// mm or inch as the factor between units of files and of the program.
pub(crate) fn unit_of(files: Units, program: Units) -> f64 {
    files.mm() / program.mm()
}

impl Engine {
    /// A value that only the machine knows: NaN in checks, and what `rs274` takes otherwise.
    pub(crate) fn unknown(&self, otherwise: f64) -> f64 {
        if self.setup.start == crate::Start::Unknown {
            f64::NAN
        } else {
            otherwise
        }
    }
}

/// Parameters that a parameter file always holds: stored points, G92, coordinate systems.
fn always_kept(index: u32) -> bool {
    match index {
        5161..=5169 | 5181..=5189 | 5210..=5220 => true,
        5221..=5390 => (1..=10).contains(&((index - 5220) % 20)),
        _ => false,
    }
}

impl Engine {
    /// What the control writes into its parameter file at the end: what it must contain, and what was in it.
    pub fn kept_parameters(&self) -> crate::Parameters {
        let declared = &self.setup.parameters.values;
        let mut indices: Vec<u32> = declared.iter().map(|&(index, _)| index).collect();
        indices.extend((5161..=5390).filter(|&index| always_kept(index)));
        indices.sort_unstable();
        indices.dedup();
        let values = indices
            .into_iter()
            .map(|index| {
                // a program that ends without M2 leaves them
                let resets = self.flow.met_end() && !self.setup.g92_persists();
                let forgotten = resets && matches!(index, 5210..=5219);
                let value = if forgotten { 0.0 } else { self.parameter(index as usize) };
                (index, value)
            })
            .collect();
        crate::Parameters {
            values,
            globals: Vec::new(),
        }
    }
}
