//! Paper 002 and beyond: numbers recomputed by independent programs.
#![allow(missing_docs)]
mod corners;
