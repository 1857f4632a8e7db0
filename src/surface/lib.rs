//! Floor 5: the surface that a part should have, and how far the path of the tool deviates from it.
//!
//! A required surface is a grid of points, Bezier patches, or an STL. It is compared with the real path between the blocks (the surface
//! that the trajectories span), not with the programmed points alone. It does not know rules, terminals or pictures.
mod file;
mod judge;
mod mesh;
mod patch;
mod search;
mod sheet;
mod stl;

pub use file::{SurfaceError, required, required_stl};
pub use judge::{Errors, Found, Judge, MOST_LOOKS, Options, PictureSample};
pub use mesh::{Nearest, Required, Uv};
pub use sheet::Sheet;
