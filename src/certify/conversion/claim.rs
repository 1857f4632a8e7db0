//! What is claimed of a conversion, and what was found.
use serde::{Deserialize, Serialize};

/// Which motions of the two programs belong together; in order, as the converter says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// The next motion of the original is made by this many motions of the output, each an equal share of it.
    Moves(u32),
    /// The next motion before is a rapid of which only some axes are known; the next one after has the same words.
    Words,
    /// The next motion of the original has none in the output. Only a rapid with an unknown end, if no known pose with the same tool comes
    /// before it, or none after it.
    Left,
    /// This many motions of the output have none in the original: positioning rapids, where the pose before is unknown.
    Added(u32),
}

/// What is claimed of the program after. Lengths mm, angles deg, feeds mm/min.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConversionClaim {
    /// At the ends of motions the tip is where it was within this.
    pub end_mm: f64,
    /// At the ends of motions the tool axis is where it was within this.
    pub end_deg: f64,
    /// At every moment of a feed motion the tip is where it was within this.
    pub path_mm: f64,
    /// At every moment of a feed motion the tool axis is where it was within this; `None`: it is reported and not judged.
    pub path_deg: Option<f64>,
    /// Feeds in mm/min agree within this.
    pub feed_mm_min: f64,
    /// Where one of the programs gives times, these agree within this share.
    pub time_share: f64,
}

/// What was proved, with the worst numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConversionProof {
    /// Motions before.
    pub motions_before: u64,
    /// Motions after.
    pub motions_after: u64,
    /// Rapids without a known end that were left out.
    pub left_out: u64,
    /// Positioning rapids that were added.
    pub added: u64,
    /// Tip at the ends of motions, mm.
    pub end_mm: f64,
    /// Tool axis at the ends of motions, deg.
    pub end_deg: f64,
    /// Proven bound on the distance of the tips at any moment of a feed motion, mm.
    pub path_mm: f64,
    /// Proven bound on the angle of the tool axes at any moment of a feed motion, deg.
    pub path_deg: f64,
    /// How far the tip can be from where it was in a rapid, if all axes run together, mm; not judged.
    pub rapid_mm: f64,
    /// Feeds in mm/min, largest difference.
    pub feed_mm_min: f64,
    /// Times, largest difference, as a share.
    pub time_share: f64,
    /// Feed motions whose feed or time could not be compared: the tip does not move, or the spindle speed is unknown.
    pub feeds_not_compared: u64,
}
