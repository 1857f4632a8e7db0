//! A certificate without its seal, and its claim.
use super::{CanonicalV1, Encode};
use crate::certificate::{
    Certificate, MotionChange, MotionCounts, NamedDigest, PostureCosts, RapidChanges, RotaryChange, TextChange,
    TextDigest, Worst, WorstChanges,
};
use crate::claim::Claim;

// The seal is made from these bytes.
record! {
    Certificate {
        schema = 1, tool_version = 2, before = 3, after = 4, dialect = 5, machine = 6, setup_sha256 = 7, library = 8,
        claim = 9, text = 10, motions = 11, worst = 12, rotary = 13, changes = 14, after_dialect = 15, postures = 16,
        rapids = 17,
    } without {
        seal_sha256,
    }
}

record! {
    TextDigest {
        sha256 = 1, bytes = 2,
    }
}

record! {
    NamedDigest {
        name = 1, sha256 = 2,
    }
}

record! {
    TextChange {
        numbers_changed = 1, words_inserted = 2, bytes_changed = 3, rest_identical = 4,
    }
}

record! {
    MotionCounts {
        total = 1, changed = 2, unknown = 3, process_changed = 4,
    }
}

record! {
    Worst {
        value = 1, motion = 2, line = 3,
    }
}

record! {
    WorstChanges {
        point_shift_mm = 1, tip_shift_mm = 2, axis_change_deg = 3, path_bound_mm = 4, path_axis_bound_deg = 5,
        forward_residual_mm = 6, forward_residual_deg = 7,
    }
}

record! {
    RotaryChange {
        axis = 1, step_before_deg = 2, step_after_deg = 3, travel_before_deg = 4, travel_after_deg = 5,
    }
}

record! {
    PostureCosts {
        stations = 1, switches_before = 2, switches_after = 3, before = 4, after = 5,
    }
}

record! {
    MotionChange {
        motion = 1, line = 2, point_shift_mm = 3, tip_shift_mm = 4, axis_change_deg = 5, rotary_change_deg = 6,
        path_sampled_mm = 7, path_bound_mm = 8, path_axis_bound_deg = 9,
    }
}

record! {
    RapidChanges {
        runs = 1, motions_before = 2, motions_after = 3, length_before_mm = 4, length_after_mm = 5, least_distance_mm = 6,
        line = 7,
    }
}

impl Claim {
    /// A claim of nothing but two tolerances.
    fn encode_tolerances(&self, variant: u16, out: &mut CanonicalV1) {
        let (mm, degrees) = self.tolerances();
        out.variant(variant, |fields| {
            fields.field(1, &mm).field(2, &degrees);
        });
    }
}

impl Encode for Claim {
    fn encode(&self, out: &mut CanonicalV1) {
        match self {
            Self::SamePoses { .. } => self.encode_tolerances(1, out),
            Self::SameToolPath { .. } => self.encode_tolerances(3, out),
            Self::SamePath { .. } => self.encode_tolerances(4, out),
            Self::SameProgrammedCentre { .. } => self.encode_tolerances(9, out),
            Self::InsertedPoints { .. } => self.encode_tolerances(10, out),
            Self::SameBallCentre {
                ball_radius_mm,
                tolerance_mm,
                tolerance_deg,
            } => out.variant(2, |fields| {
                fields
                    .field(1, ball_radius_mm)
                    .field(2, tolerance_mm)
                    .field(3, tolerance_deg);
            }),
            Self::AdaptedFeed {
                tolerance_mm,
                tolerance_deg,
                asked_mm_min,
            } => out.variant(8, |fields| {
                fields
                    .field(1, tolerance_mm)
                    .field(2, tolerance_deg)
                    .field(3, asked_mm_min);
            }),
            Self::InsertedRetracts {
                tolerance_mm,
                tolerance_deg,
                clearance_mm,
                assumed_zeros,
            } => out.variant(11, |fields| {
                fields
                    .field(1, tolerance_mm)
                    .field(2, tolerance_deg)
                    .field(3, clearance_mm)
                    .field(4, assumed_zeros);
            }),
            Self::LeastPostures {
                tolerance_mm,
                tolerance_deg,
                cost,
                labels,
            } => out.variant(5, |fields| {
                fields
                    .field(1, tolerance_mm)
                    .field(2, tolerance_deg)
                    .field(3, cost)
                    .field(4, labels);
            }),
            Self::RefittedPath { tolerance_mm, source } => out.variant(7, |fields| {
                fields.field(1, tolerance_mm).field(2, source);
            }),
            Self::ClearRapids {
                tolerance_mm,
                tolerance_deg,
                clearance_mm,
                assumed_zeros,
            } => out.variant(6, |fields| {
                fields
                    .field(1, tolerance_mm)
                    .field(2, tolerance_deg)
                    .field(3, clearance_mm)
                    .field(4, assumed_zeros);
            }),
        }
    }
}
