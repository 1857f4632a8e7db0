//! Numbers and directions for messages.
use trunnion_geometry::Vec3;

/// `+Z` for a coordinate direction, else its three components.
pub(crate) fn direction(vector: &Vec3) -> String {
    for (index, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let unit = Vec3::ith(index, 1.0);
        if (vector - unit).norm() < 1e-12 {
            return format!("+{name}");
        }
        if (vector + unit).norm() < 1e-12 {
            return format!("-{name}");
        }
    }
    triple(vector)
}

/// `(x, y, z)`.
pub(crate) fn triple(vector: &Vec3) -> String {
    format!("({}, {}, {})", number(vector.x), number(vector.y), number(vector.z))
}

/// At most six decimals, no trailing zeros, no negative zero.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.6}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".to_owned()
    } else {
        short.to_owned()
    }
}
