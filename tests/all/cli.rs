//! The `trunnion` program as its users run it: one file here is one command or one kind of input.
#![allow(clippy::print_stdout, reason = "a skipped test says so")]

mod certificates;
mod commands;
mod convert;
mod diff;
mod edit;
mod files;
mod findings;
mod fix;
mod fmt;
mod hostile;
mod inch_pictures;
mod lathes;
mod long_lines;
mod machines;
mod messages;
mod own_settings;
mod pictures;
mod pieces;
mod planes;
mod retarget;
mod servo;
mod stats;
mod steps;
mod stumbles;
mod switching;
mod timing;
pub(crate) mod tools;
mod twins;
mod usage;
