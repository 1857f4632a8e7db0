//! What happened since the last motion, and since something ran that may have changed everything modal.
use crate::process::Held;
use trunnion_dialect::{Action, Code, Dialect};
use trunnion_interp::Motion;

/// See the module.
#[derive(Default)]
pub(crate) struct Since {
    /// Something may have moved the coordinates, or the machine, since the last motion.
    pub(crate) disturbed: bool,
    /// Something ran that may have changed everything modal: what is restated from then on counts.
    pub(crate) lost: bool,
    /// Frame of the last motion.
    last: Option<(Motion, Held)>,
}

impl Since {
    /// A motion is made: whether it lies in the frame of the motion before, with nothing between that may have changed it.
    pub(crate) fn motion(&mut self, motion: &Motion, held: &Held) -> bool {
        let same = self.last.as_ref().is_some_and(|(last, was)| {
            let zero = last
                .zero
                .iter()
                .zip(motion.zero)
                .all(|(a, b)| a.to_bits() == b.to_bits());
            zero && was == held
                && last.tool_length_mm.to_bits() == motion.tool_length_mm.to_bits()
                && last.tool == motion.tool
                && last.tcp == motion.tcp
                && last.machine_coordinates == motion.machine_coordinates
                && last.radii == motion.radii
                && last.tilt == motion.tilt
        });
        self.last = Some((*motion, held.clone()));
        !std::mem::take(&mut self.disturbed) && same
    }
}

/// Whether the text of an assignment may write a variable of the control (#1000 and above, `$...`), where offsets may be kept.
pub(crate) fn writes_control(text: &str) -> bool {
    let name: String = text.split('=').next().unwrap_or_default().split_whitespace().collect();
    match name.strip_prefix('#') {
        Some(rest) => !rest.starts_with('<') && rest.parse::<u32>().map_or(true, |number| number >= 1000),
        None => !(name.starts_with(['R', 'r']) || name.starts_with('/')),
    }
}

/// Whether a code surely leaves the machine where it is, and its coordinates where they lie, but for what a motion itself says of them.
pub(crate) fn keeps_place(code: &Code, dialect: &Dialect) -> bool {
    // LinuxCNC's engine runs its cycles itself
    let runs_cycles = dialect.quirks.rs274() && code.action == Action::CannedCycle;
    runs_cycles
        || code.action.keeps_place()
        || code.action == Action::NoMotion && matches!(code.group.as_deref(), Some("coolant" | "mist"))
}
