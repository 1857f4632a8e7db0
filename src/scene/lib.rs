//! Floor 6: what a viewer in three dimensions needs of a run, as plain arrays of numbers.
//!
//! Legs of a machine or programmed motions come in; strands of vertices come out, thinned to what a viewer can draw, in the
//! bytes of `docs/scene.md`. It does not know files, rules, colours or protocols.
mod bytes;
mod scene;
#[cfg(test)]
mod tests;
mod thin;
mod tracer;

pub use bytes::encode;
pub use scene::{Kind, Scene, Vertex};
pub use thin::thin;
pub use tracer::Tracer;
