//! Motions built by hand, followed on machines: what happens at the end of a block and inside it.
mod blocks;
mod common;
mod excursions;
mod great_circle;
mod guide_vane;
mod random;
mod review;
mod states;
