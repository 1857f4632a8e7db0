//! Motions built by hand, followed on machines: what happens at the end of a block and inside it.
mod asked;
mod blocks;
mod common;
mod controls;
mod excursions;
mod great_circle;
mod guide_vane;
mod orientation;
mod programs;
mod random;
mod review;
mod saddle;
mod soundness;
mod states;
mod travel;
mod within;
