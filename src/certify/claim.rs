//! What a rewrite claims about the programs before and after it.
use serde::{Deserialize, Serialize};

/// The claim. Lengths mm, angles deg (certificates are read by people).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Claim {
    /// Every motion ends in the same pose; rotary joints differ by whole turns only (`unwind-rotary`), and no motion's tip path
    /// differs by more than `tolerance_mm` nor its tool axis by more than `tolerance_deg`.
    SamePoses {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
    /// At every block end the tool axis turns about the part by at most `tolerance_deg`, and the point `ball_radius_mm` above the tip along
    /// the tool axis (the ball's centre) stays where it was within `tolerance_mm` (`smooth-pole`).
    SameBallCentre {
        /// mm.
        ball_radius_mm: f64,
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
}
