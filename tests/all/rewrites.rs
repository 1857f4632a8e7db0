//! Rewrites and their certificates on published rows, on hard cases and on random chains.

mod curves;
mod deleted;
mod everywhere;
mod feeds;
mod fitting;
mod mutants;
mod named_blocks;
mod points;
mod random;
mod retracting;
mod routing;
mod slopes;
mod smoothing;
mod strategy_2;
mod switching;
mod unwinding;
mod waypoints;
