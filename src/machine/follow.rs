//! Motions to joints, block by block: words, the choice between postures and windings, and the state that a follower keeps.
pub(crate) mod allowed_windings;
pub(crate) mod checkpoint;
pub(crate) mod choice;
pub(crate) mod follower;
pub(crate) mod interpreter_setup;
pub(crate) mod joint_line;
pub(crate) mod line_cache;
pub(crate) mod lookahead;
pub(crate) mod posture_rule;
pub(crate) mod reference;
pub(crate) mod requests;
pub(crate) mod rotary_way;
pub(crate) mod row;
pub(crate) mod stance;
pub(crate) mod tool_vector;
pub(crate) mod unknown_axes;
pub(crate) mod words;
