//! Settings on disk.
mod settings;
