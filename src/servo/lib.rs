//! Floor 1: what the servo loops of the axes make of a corner. Closed forms, simulated loops, and the corner controller of Lim and Jee (2011).
//! Lengths are mm, times s, gains 1/s. Formulas: docs/kinematics.md#servo.
//!
//! It knows neither programs nor machines.
mod closed;
mod corner;
mod plant;
mod profile;
mod search;
mod simulate;

pub use closed::{closed_form, closed_form_with_ramps, sampled_gain, slowest_corner_speed, stop_acceleration};
pub use corner::Corner;
pub use plant::Plant;
pub use profile::Profile;
pub use search::{Within, within};
pub use simulate::{Correction, Response, Servo, ServoError, Spot, simulate};
