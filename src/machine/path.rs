//! What happens between two blocks: where the joints are inside a block, with bounds of deviation, travel, speed and duration.
pub(crate) mod block_path;
pub(crate) mod curvature;
pub(crate) mod curve_distance;
pub(crate) mod deviation;
pub(crate) mod feed_meaning;
pub(crate) mod joint_path;
pub(crate) mod length;
pub(crate) mod limits;
pub(crate) mod orientation;
pub(crate) mod peak;
pub(crate) mod quick_bounds;
pub(crate) mod rotary_path;
pub(crate) mod rotary_radii;
pub(crate) mod speed;
pub(crate) mod swept;
pub(crate) mod tip_path;
pub(crate) mod travel;
