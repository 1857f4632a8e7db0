//! The surface that a test piece should have, as `trunnion surface` reads it.
use super::{Kind, Sample, make};
use crate::cli::failure::Failure;
use std::fmt::Write;
use trunnion_geometry::Vec3;
use trunnion_pieces::saddle_net;

/// Points along the S-wall: chords of 0.05 mm, with an error below 1e-5 mm.
const ALONG: usize = 3200;

/// TOML text.
pub(super) fn surface(command: &Sample, origin: Vec3) -> Result<String, Failure> {
    let (kind, about, rows) = match command.piece {
        Kind::Saddle => ("patch", "degree 4 x 4, the exact saddle", saddle_net()),
        Kind::SWall => (
            "grid",
            "the wall, lower edge first",
            make::wall_sizes(command).grid(ALONG),
        ),
        _ => {
            return Err(Failure::new(
                "--required: only the saddle and the s-wall have a required surface",
            ));
        }
    };
    let mut text = format!("schema = \"trunnion-surface/1\"\n# {about}\n[[{kind}]]\nrows = [\n");
    for row in rows {
        text.push_str("  [");
        for point in row {
            let point = point + origin;
            let _ = write!(text, "[{}, {}, {}], ", point.x, point.y, point.z);
        }
        text.push_str("],\n");
    }
    text.push_str("]\n");
    Ok(text)
}
