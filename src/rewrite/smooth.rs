//! What `smooth-pole` is made of: chains of stations, the choice of posture and turns, the path through the tube.
pub(crate) mod chain;
pub(crate) mod ends;
mod even;
mod firm;
pub(crate) mod mark;
pub(crate) mod obstacles;
mod pentadiagonal;
pub(crate) mod plan;
mod reach;
pub(crate) mod window;

#[cfg(test)]
mod tests;
