//! What a rewrite claims about the programs before and after it.
use crate::postures::PostureCost;
use serde::{Deserialize, Serialize};

/// The claim. Lengths mm, angles deg (certificates are read by people).
///
/// The first three are claims of rewrites: beside the poses, everything else must be as before (kinds of motion, feeds, spindle,
/// tools, and every byte that is not a number of a coordinate word).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Claim {
    /// Every motion ends in the same pose and its rotary joints differ by whole turns only (`unwind-rotary`). Where the number of
    /// turns is the same at both ends of a motion, its path is the same too; where it changes, the rotary axis takes the other
    /// way round, and nothing is claimed between the ends (the certificate says by how much the paths differ there).
    SamePoses {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
    /// At every block end the tool axis turns about the part by at most `tolerance_deg`, and the point `ball_radius_mm` above the tip
    /// along the tool axis (the ball's centre) stays where it was within `tolerance_mm` (`smooth-pole`). Every motion that
    /// differs is made with a ball of that radius. No cut swaps the posture (a rotary excess above `swap_excess`) where it did not before.
    /// The certificate says how far the paths lie apart between block ends.
    SameBallCentre {
        /// mm.
        ball_radius_mm: f64,
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
    /// As [`Self::SameBallCentre`] for a program whose X Y Z are the centre of the ball, which its user declares: at every block end the tool
    /// axis turns about the part by at most `tolerance_deg`, and the programmed point stays where it was within `tolerance_mm`
    /// (`smooth-pole` with `--point centre`). Every motion that differs is made with a declared ball.
    SameProgrammedCentre {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
    /// Every motion ends in the same pose, in any posture and with any number of whole turns (`switch-angles`), and no other choice among
    /// the states of [`crate::postures::Graph`] costs less: all postures and turns inside the travel of the axes, of an axis with more than 31
    /// turns those nearest to the program, at the pole the values of the neighbouring positions. No cut changes the posture where the pole is
    /// not inside it and the rotary excess is above `swap_excess`, or turns a rotary axis by more than half a turn, where it did not before. Nothing is claimed of the paths between the ends (the
    /// certificate says by how much they differ there).
    LeastPostures {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
        /// What a sequence of postures costs.
        cost: PostureCost,
        /// The least cost of reaching each state of the graph, in billionths of the cost's unit; none where it cannot be reached.
        labels: Vec<Option<u64>>,
    },
    /// The programs do the same (interface section 8.3): at every moment of every motion the tip is where it was within `tolerance_mm`
    /// and the tool axis within `tolerance_deg`, and feed, spindle, tool, offsets, coolant, stops, outputs, stored data and whatever is not
    /// modelled are the same. The texts may differ in anything, and a line may be cut in two.
    SameToolPath {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
    /// The geometry of [`Self::SameToolPath`] alone: feed, spindle, coolant, stops and the like may differ.
    SamePath {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
}

impl Claim {
    /// Distance of the compared point from the tip along the tool axis, mm: the ball's centre, or the tip itself.
    pub fn point_height_mm(&self) -> f64 {
        match self {
            Self::SameBallCentre { ball_radius_mm, .. } => *ball_radius_mm,
            Self::SamePoses { .. }
            | Self::SameProgrammedCentre { .. }
            | Self::LeastPostures { .. }
            | Self::SameToolPath { .. }
            | Self::SamePath { .. } => 0.0,
        }
    }

    /// Tolerances: mm and deg.
    pub fn tolerances(&self) -> (f64, f64) {
        match *self {
            Self::SamePoses {
                tolerance_mm,
                tolerance_deg,
            }
            | Self::SameBallCentre {
                tolerance_mm,
                tolerance_deg,
                ..
            }
            | Self::SameProgrammedCentre {
                tolerance_mm,
                tolerance_deg,
            }
            | Self::LeastPostures {
                tolerance_mm,
                tolerance_deg,
                ..
            }
            | Self::SameToolPath {
                tolerance_mm,
                tolerance_deg,
            }
            | Self::SamePath {
                tolerance_mm,
                tolerance_deg,
            } => (tolerance_mm, tolerance_deg),
        }
    }

    /// Whether it is a rewrite's claim: then nothing but numbers of coordinate words may differ in the text.
    pub fn is_rewrite(&self) -> bool {
        !matches!(self, Self::SameToolPath { .. } | Self::SamePath { .. })
    }
}
