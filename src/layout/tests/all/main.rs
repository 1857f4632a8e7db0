//! The layout: what it does to each form, and that it changes nothing else on any text.
mod cut_files;
mod forms;
mod guards;
mod random;
mod real_files;
mod renumbering;
mod support;
