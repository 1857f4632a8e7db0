//! The planner against closed forms and independent code.
#![allow(missing_docs)]
mod closed;
mod linuxcnc;
mod programs;
mod random;
