//! The command line: parses arguments, calls one file of `cli/`, sets the exit status.
mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
