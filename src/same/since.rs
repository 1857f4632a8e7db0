//! What happened since the last motion, and since something ran that may have changed everything modal.
use crate::process::Held;
use std::borrow::Cow;
use std::collections::BTreeSet;
use trunnion_dialect::{Action, Code};
use trunnion_interp::{Effect, Motion};

/// Keys of settings that were restated after a program that is missing end so.
const AFTER_LOSS: &str = " after a program that is not known";

/// Whether a setting counts only because what was in force before it is not known.
pub(crate) fn is_after_loss(key: &str) -> bool {
    key.ends_with(AFTER_LOSS)
}

/// See the module.
#[derive(Default)]
pub(crate) struct Since {
    /// Something may have moved the coordinates, or the machine, since the last motion.
    pub(crate) disturbed: bool,
    /// Frame of the last motion.
    last: Option<(Motion, Held)>,
    /// Keys that were restated since everything was lost; `None` before that.
    restated: Option<BTreeSet<String>>,
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

    /// Everything modal is unknown from here on; the keys that were restated before.
    pub(crate) fn lose(&mut self) -> Vec<Cow<'static, str>> {
        let before = self.restated.replace(BTreeSet::new()).unwrap_or_default();
        before.into_iter().map(Cow::Owned).collect()
    }

    /// A word of a group is said: the key under which that counts, if anything was lost before.
    pub(crate) fn restated(&mut self, group: &str) -> Option<Cow<'static, str>> {
        let restated = self.restated.as_mut()?;
        let key = format!("{group}{AFTER_LOSS}");
        restated.insert(key.clone());
        Some(key.into())
    }
}

/// Whether an effect may move the machine, or where its coordinates lie.
pub(crate) fn disturbs(effect: &Effect) -> bool {
    match effect {
        Effect::Unmodelled(_) => true,
        Effect::Set { key, .. } => {
            let kept = [
                "spindle",
                "speed",
                "flood",
                "mist",
                "tool prepared",
                "path-control",
                "feed",
                "coordinates",
            ];
            !(kept.iter().any(|start| key.starts_with(start)) || is_after_loss(key) || key == "cycle")
                && key.chars().any(|c| c == '[' || c == '=')
        }
        Effect::Event(words) => {
            let plain = |name: &str| {
                matches!(name, "M0" | "M1" | "/" | "LOG" | "M5" | "M3" | "M4" | "G4")
                    || matches!(name, "M62" | "M63" | "M64" | "M65" | "M66" | "M67" | "M68")
            };
            !words.first().is_some_and(|word| plain(&word.name))
        }
        Effect::Store(_) | Effect::End(_) => false,
    }
}

/// M100 to M199 of LinuxCNC: a program of the user.
pub(crate) fn is_own_code(effect: &Effect) -> bool {
    let Effect::Event(words) = effect else { return false };
    let number = words
        .first()
        .and_then(|word| word.name.strip_prefix('M')?.parse::<u32>().ok());
    number.is_some_and(|number| (100..=199).contains(&number))
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
pub(crate) fn keeps_place(code: &Code) -> bool {
    matches!(
        code.action,
        Action::Rapid
            | Action::Linear
            | Action::ArcClockwise
            | Action::ArcCounterClockwise
            | Action::Dwell
            | Action::PlaneXy
            | Action::PlaneZx
            | Action::PlaneYz
            | Action::Absolute
            | Action::Incremental
            | Action::ArcCentreAbsolute
            | Action::ArcCentreIncremental
            | Action::Inch
            | Action::InchLengthsOnly
            | Action::Metric
            | Action::FeedInverseTime
            | Action::FeedPerMinute
            | Action::FeedPerRevolution
            | Action::CompensationOff
            | Action::WorkOffset
            | Action::SpindleClockwise
            | Action::SpindleCounterClockwise
            | Action::SpindleStop
            | Action::ProgramStop
            | Action::ProgramEnd
            | Action::PathMode
            | Action::ReturnInitial
            | Action::ReturnToR
            | Action::CycleOff
            | Action::OrientationAxes
            | Action::OrientationVector
            | Action::ConstantSurfaceSpeed
            | Action::ConstantSpindleSpeed
    ) || code.action == Action::NoMotion && matches!(code.group.as_deref(), Some("coolant" | "mist"))
}
