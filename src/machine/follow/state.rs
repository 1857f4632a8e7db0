//! What a follower keeps.
use crate::{Joints, MAX_AXES, Stance};

/// What a follower remembers between two motions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    pub(crate) stance: Option<Stance>,
    pub(crate) known_joints: (Joints, u16),
    /// Last known rotary joints, rad; zeros before the first: the reference of the posture choice.
    pub(crate) rotary: [f64; 2],
    /// Whether they are the present positions of the rotary axes.
    pub(crate) rotary_known: bool,
    /// Rotary joints that have been moved to an unknown position and not named since, as a mask.
    pub(crate) rotary_lost: u16,
    /// Sign of the last stance that had one, 0 when there was none.
    pub(crate) sign: i8,
    /// Rotary joints that a turn onto a tilted plane has set and no word has named since, as a mask.
    pub(crate) aimed: u16,
    /// Letters with a known end in the last motion.
    pub(crate) named: u16,
    /// Whether the last motion's X Y Z were tip coordinates.
    pub(crate) tip_words: bool,
    /// Pieces that the long turns of the run have taken.
    pub(crate) turned: u64,
    /// A tool vector gave the rotary joints their positions.
    pub(crate) led: bool,
    /// [`trunnion_interp::Motion::relocations`] of the last motion.
    pub(crate) relocations: u32,
    /// See [`crate::Leg::taken_away`].
    pub(crate) taken_away: bool,
}

impl State {
    /// Before the first motion.
    pub(crate) const UNKNOWN: Self = Self {
        stance: None,
        known_joints: ([0.0; MAX_AXES], 0),
        rotary: [0.0; 2],
        rotary_known: false,
        rotary_lost: 0,
        sign: 0,
        aimed: 0,
        named: 0,
        tip_words: false,
        turned: 0,
        led: false,
        relocations: 0,
        taken_away: false,
    };
}
