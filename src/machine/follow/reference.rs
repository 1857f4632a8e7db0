//! What a choice between postures starts from.
use crate::follow::posture_rule::PostureRule;
use trunnion_interp::Posture;

/// Whether the positions of the rotary axes are known where a choice starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reference {
    Known,
    /// Nothing has moved them: assumed at zero.
    Assumed,
    /// They have been moved to an unknown position.
    Lost,
}

/// What a choice starts from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Before {
    /// Rotary joints, workpiece side first, rad; the last known ones where they are lost, zeros before the first.
    pub(crate) q: [f64; 2],
    pub(crate) reference: Reference,
    /// Sign of the posture; 0 at the pole or where it is unknown.
    pub(crate) sign: i8,
    /// Angle to the pole, rad.
    pub(crate) pole_angle: f64,
    /// The tool axis follows a great circle that does not touch the pole: the posture cannot change along it.
    pub(crate) continuous: bool,
    /// What the program requests.
    pub(crate) wish: Posture,
}

impl Before {
    pub(crate) fn is_known(&self) -> bool {
        self.reference == Reference::Known
    }

    /// Whether the rule has no position to start from.
    pub(crate) fn lacks_start(&self, rule: Option<PostureRule>) -> bool {
        match self.reference {
            Reference::Known => false,
            Reference::Assumed => rule != Some(PostureRule::Generic),
            Reference::Lost => true,
        }
    }
}
