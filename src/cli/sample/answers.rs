//! The closed-form answers of a test piece, as JSON.
use super::{Kind, Sample, make};
use crate::cli::{Done, failure::Failure, json::write_json};
use serde_json::{Value, json};
use std::io::Write;

/// Prints them.
pub(super) fn print(command: &Sample) -> Result<Done, Failure> {
    let piece = make::piece(command)?;
    let finite = |value: f64| {
        if value.is_finite() {
            json!(value)
        } else {
            json!("infinite")
        }
    };
    let answers: Value = match command.piece {
        Kind::Cone => {
            let answers = make::cone_sizes(command).answers();
            json!({
                "tilt_range_deg": answers.tilt_deg,
                "turn_travel_deg": answers.travel_deg,
                "turn_per_psi_max": finite(answers.rate_max),
                "turn_per_psi_min": answers.rate_min,
                "turn_per_psi_at_largest_tilt": answers.rate_far,
                "winds": answers.winds,
                "tip_radius_mm": answers.tip_radius,
                "feed_limit_mm_min_per_rad_s": answers.feed_limit_mm_min(1.0),
            })
        }
        Kind::CircleC | Kind::CircleA | Kind::CircleAc | Kind::FixedTip => json!({ "tip_deviation_mm": 0.0 }),
        Kind::SWall => {
            let sizes = make::wall_sizes(command);
            json!({
                "tip_to_wall_mm": 0.5 * sizes.tool_diameter,
                "chord_error_mm": sizes.chord,
                "axis_on_pole": if sizes.tilt_deg == 0.0 { 2 * sizes.waves + 1 } else { 0 },
                "length_mm": sizes.length(),
            })
        }
        Kind::Staircase => json!({
            "block_length_mm": command.size.unwrap_or(0.02),
            "block_time_s": command.size.unwrap_or(0.02) * 60.0 / piece.feed_mm_min,
        }),
        Kind::Saddle | Kind::CornerSet | Kind::CircleDiamondSquare => {
            return Err(Failure::new("this test piece has no closed-form answers"));
        }
    };
    let mut out = std::io::stdout().lock();
    let document =
        json!({ "schema": "trunnion-answers/1", "piece": piece.name, "title": piece.title, "answers": answers });
    write_json(&mut out, &document)?;
    out.flush()?;
    Ok(Done::Clean)
}
