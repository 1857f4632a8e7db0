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
    /// The programs do the same but for rapid motions (`reroute-rapid`): each run of rapid motions with nothing between them begins and ends where it did
    /// within the tolerances, and everything else is as in [`Self::SameToolPath`]. In each run that differs no rotary axis turns. A motion of the
    /// program after is one of the program before, or runs along the tool above the start or the end of what differs, or lies nowhere below the highest level at which
    /// the rapids since the last cut went across the tool before. Every motion keeps the tool, with its holder where one is declared, at least `clearance_mm` away from all declared obstacles, those of the third kind
    /// also from the part: exactly, not by samples, and where the axes of a rapid may not arrive together, on all paths that they may take.
    ClearRapids {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
        /// mm.
        clearance_mm: f64,
        /// Work offsets and tool lengths that are not declared are taken as zero; else rapids that depend on one are unknown.
        assumed_zeros: bool,
    },
    /// All of [`Self::SameToolPath`] but the feeds of cuts. A feed that differs is no higher than the one before, or than the one asked for, and no
    /// axis is faster than its highest speed with it, nor needs more than its acceleration in a bend, as the planner sees it (docs/kinematics.md#time);
    /// it is lower only where an axis would (`adapt-feed`). Under inverse time (G93) the same holds for the time of the block.
    AdaptedFeed {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
        /// The feed asked for, mm/min: cuts that are slower may be made as fast as this. 0: none is made faster.
        asked_mm_min: f64,
    },
    /// All of [`Self::SameToolPath`], but a line without tool centre point control may be made in several pieces. Each piece keeps the tip within
    /// `tolerance_mm` of the straight segment that the original line programs, and ends where the rotary axes of that line come past, within
    /// `tolerance_deg` (`insert-points`). Nothing is claimed of the path between the ends of the original line, which may be farther off.
    InsertedPoints {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
    /// All of [`Self::SameToolPath`], but between two cuts the tool may leave the part and come back to where it was in another posture or with other
    /// turns (`insert-retract`): away along its axis at rapid, turned at rapid or at feed at least `clearance_mm` away from all declared obstacles, the part among
    /// them, and back along its axis at feed, or on a ramp above the cut before. The cut that follows ends where it did, changes no posture and turns no rotary axis
    /// farther than before or by more than half a turn; nothing else is claimed of its path.
    InsertedRetracts {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
        /// mm.
        clearance_mm: f64,
        /// Work offsets and tool lengths that are not declared are taken as zero; else what depends on one is unknown.
        assumed_zeros: bool,
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
    /// Lines may be put together into fewer lines, arcs, helices and curves (`fit-arcs`, `fit-splines`, `drop-redundant`). The two paths are nowhere
    /// farther apart than `tolerance_mm`, both walked from start to end and neither going back; `source` says whether the old path is the lines or only their
    /// ends. Feed, spindle, tool, offsets and rotary axes are the same at each line, and all else is as in [`Self::SameToolPath`] within
    /// 1e-6 mm and deg.
    RefittedPath {
        /// mm.
        tolerance_mm: f64,
        /// What the new path must be near.
        source: RefitSource,
    },
    /// The geometry of [`Self::SameToolPath`] alone: feed, spindle, coolant, stops and the like may differ.
    SamePath {
        /// mm.
        tolerance_mm: f64,
        /// deg.
        tolerance_deg: f64,
    },
}

/// What a refitted path must be near.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RefitSource {
    /// The programmed points, as where they were taken from a curve. Nothing is claimed of the lines between them.
    Points,
    /// The lines as they are programmed: the same path as written.
    #[default]
    Chords,
}

/// Motions that are not put together are the same within this, mm and deg: rounding.
const REST: f64 = 1e-6;

impl Claim {
    /// Distance of the compared point from the tip along the tool axis, mm: the ball's centre, or the tip itself.
    pub fn point_height_mm(&self) -> f64 {
        match self {
            Self::SameBallCentre { ball_radius_mm, .. } => *ball_radius_mm,
            Self::SamePoses { .. }
            | Self::LeastPostures { .. }
            | Self::ClearRapids { .. }
            | Self::AdaptedFeed { .. }
            | Self::InsertedPoints { .. }
            | Self::InsertedRetracts { .. }
            | Self::SameToolPath { .. }
            | Self::RefittedPath { .. }
            | Self::SameProgrammedCentre { .. }
            | Self::SamePath { .. } => 0.0,
        }
    }

    /// Tolerances: mm and deg. Of a refitted path those of what is not refitted.
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
            | Self::ClearRapids {
                tolerance_mm,
                tolerance_deg,
                ..
            }
            | Self::AdaptedFeed {
                tolerance_mm,
                tolerance_deg,
                ..
            }
            | Self::InsertedPoints {
                tolerance_mm,
                tolerance_deg,
            }
            | Self::InsertedRetracts {
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
            Self::RefittedPath { .. } => (REST, REST),
        }
    }

    /// Whether it is the claim of a rewrite that only changes coordinates: then nothing but numbers of coordinate words may differ in the text.
    pub fn is_rewrite(&self) -> bool {
        !matches!(
            self,
            Self::AdaptedFeed { .. }
                | Self::InsertedPoints { .. }
                | Self::InsertedRetracts { .. }
                | Self::SameToolPath { .. }
                | Self::RefittedPath { .. }
                | Self::ClearRapids { .. }
                | Self::SamePath { .. }
        )
    }
}

/// What of a claim must hold with any values of what nobody declares. `None`: nothing, as these values are claimed to be zero.
pub(crate) fn for_any_values(claim: &Claim) -> Option<Claim> {
    match claim {
        Claim::ClearRapids { assumed_zeros, .. } | Claim::InsertedRetracts { assumed_zeros, .. } if *assumed_zeros => {
            None
        }
        // how fast the axes are depends on where the part is
        Claim::AdaptedFeed {
            tolerance_mm,
            tolerance_deg,
            ..
        } => Some(Claim::SamePath {
            tolerance_mm: *tolerance_mm,
            tolerance_deg: *tolerance_deg,
        }),
        claim if claim.is_rewrite() => None,
        claim => Some(claim.clone()),
    }
}
