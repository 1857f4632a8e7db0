//! Words of programs whose meaning `[control]` declares.
use serde::Deserialize;
use trunnion_interp::{ChamferLength, HolePlaces, ScaledAxes};

/// Which axes cycle 11 of Klartext scales.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Scaled {
    Plane,
    All,
}

/// What the length of CHF of Klartext measures.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Chamfer {
    Side,
    Face,
}

/// How the arguments of CYCLE802 are read.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Places {
    Pairs,
}

impl From<Scaled> for ScaledAxes {
    fn from(axes: Scaled) -> Self {
        match axes {
            Scaled::Plane => Self::Plane,
            Scaled::All => Self::All,
        }
    }
}

impl From<Chamfer> for ChamferLength {
    fn from(length: Chamfer) -> Self {
        match length {
            Chamfer::Side => Self::Side,
            Chamfer::Face => Self::Face,
        }
    }
}

impl From<Places> for HolePlaces {
    fn from(Places::Pairs: Places) -> Self {
        Self::Pairs
    }
}
