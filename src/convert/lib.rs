//! Floor 7: one language, control or machine to another. APT/CL to G-code, G-code to APT/CL, dialect to dialect, machine to machine.
//!
//! It proposes a program; [`trunnion_certify::conversion`] reads both texts from scratch and compares them motion for motion. What cannot be
//! proved within tolerance is refused with reason and place. *It never proves itself.*
mod cl;
mod clamps;
mod comments;
mod convert;
mod edit;
mod emit;
mod emit_apt;
mod emit_code;
mod emit_coolant;
mod emit_klartext;
mod emit_length;
mod emit_move;
mod events;
mod events_apt;
mod events_klartext;
mod events_spindle;
mod feeds;
mod job;
mod meanings;
mod modal;
mod number;
mod options;
mod plan;
mod plan_arc;
mod plan_words;
mod post;
mod posture;
mod refuse;
mod sample;
mod setting;
mod swaps;
mod template;
mod travel;

pub use cl::{ClFeed, ClPoint, ClTool, cl_text};
pub use convert::{Converted, Source, convert};
pub use edit::{Edit, Edited, Positions, Shape, edit, edit_part};
pub use options::{Options, OrientationWords, Target, Units};
pub use post::{BUILTIN_POSTS, Post, PostError, builtin_post, builtin_post_source, load_post};
pub use refuse::Refused;
pub use travel::Beyond;
pub use trunnion_certify::{Apart, Change, Part};
