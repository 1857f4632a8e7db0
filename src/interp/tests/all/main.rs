//! Programs and the motions and faults that they must give.
#![expect(clippy::print_stderr, reason = "a test that finds no data says so")]
#![expect(clippy::format_push_string, reason = "texts of tests are short")]
mod apt;
mod arcs;
mod by_hand;
mod by_hand_paths;
mod called_cycles;
mod canonical;
mod compensation;
mod corners;
mod cycles;
mod cycles_given_up;
mod cycles_steps;
mod directives;
mod faults;
mod files;
mod fold_samples;
mod frames;
mod macro_calls;
mod macro_flow;
mod macro_programs;
mod macro_values;
mod motions;
mod orientation;
mod own_codes;
mod properties;
mod repeated;
mod roughing;
mod roughing_unknown;
mod silent;
mod steady;
mod support;
mod threads;
mod tilted;
mod tools;
mod words;
