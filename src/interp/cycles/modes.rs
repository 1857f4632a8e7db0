//! The modes at the end of the calls of drilling cycles that newer posts write.
use super::called::Given;
use trunnion_dialect::Plane;

/// _GMODE, _DMODE and _AMODE at the end of a call of CYCLE81 to CYCLE83: what the numbers before them mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Modes {
    /// The call has none, or they are all zero: the depth is the last of DP and DPR that is there.
    None,
    /// They say which of the two depths counts, and maybe in which plane.
    Depth {
        incremental: bool,
        /// G17, G18 or G19; `None`: the one in force.
        plane: Option<Plane>,
    },
    /// They say something else, or are not evaluated.
    Other,
}

impl Modes {
    /// How many numbers they are.
    pub(super) const COUNT: usize = 3;

    /// Source: Sinumerik 840D sl G code Programming Manual, Programming cycles externally (CYCLE81, CYCLE82, CYCLE83). _DMODE: 1 to 3 are
    /// G17 to G19. _AMODE: the last digit is 1 for an incremental and 2 for an absolute depth, the one before it 1 for a dwell in seconds;
    /// the others of CYCLE83 are about steps.
    pub(super) fn of(id: &str, numbers: &[Given]) -> Self {
        let (first, steps) = match id {
            "CYCLE81" | "CYCLE82" => (6, false),
            "CYCLE83" => (17, true),
            _ => return Self::None,
        };
        let mode = |place: usize| numbers.get(first + place).copied().unwrap_or(Given::Nothing).or_zero();
        let (Some(geometry), Some(display), Some(alternative)) = (mode(0), mode(1), mode(2)) else {
            return Self::Other;
        };
        if [geometry, display, alternative] == [0.0; 3] {
            return Self::None;
        }
        let is_whole = alternative.fract() == 0.0 && (0.0..1e9).contains(&alternative);
        let digits = if is_whole {
            alternative as u32
        } else {
            return Self::Other;
        };
        let plane = match display {
            0.0 => None,
            1.0 => Some(Plane::Xy),
            2.0 => Some(Plane::Zx),
            3.0 => Some(Plane::Yz),
            _ => return Self::Other,
        };
        let depth = match digits % 10 {
            1 => true,
            2 => false,
            _ => return Self::Other,
        };
        let in_seconds = digits / 10 % 10 <= 1;
        if geometry != 0.0 || !in_seconds || !steps && digits >= 100 {
            return Self::Other;
        }
        Self::Depth {
            incremental: depth,
            plane,
        }
    }
}
