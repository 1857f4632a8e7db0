//! The command line: parses arguments, calls one file of `cli/`, sets the exit status.
fn main() {}
