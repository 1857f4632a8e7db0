//! One sub-command per file. Only this folder and `lsp/` do input and output.
mod args;
mod canon;
mod certify;
mod check;
mod convert;
mod diff;
mod edit;
mod examples;
mod explain;
mod failure;
mod fix;
mod fmt;
mod help;
mod init;
mod json;
mod legs;
mod load;
mod machine;
mod out;
mod parse;
mod plot;
mod render;
mod report;
mod sample;
mod schema;
mod screen;
mod servo;
mod shell;
mod short;
mod stats;
mod surface;
mod trace;
mod verdict;
mod waiting;
mod walk;

use args::{Args, Command};
use clap::FromArgMatches;
use std::process::ExitCode;

/// The result of a command.
pub(crate) enum Done {
    /// Nothing at or above the `--deny` level.
    Clean,
    /// Something found.
    Found,
}

/// Help and the version, or what is wrong with the arguments. A document that they ask for says it too.
fn refused(error: &clap::Error) -> ExitCode {
    // a closed standard error must not stop the program
    let _ = error.print();
    let arguments: Vec<String> = std::env::args_os()
        .skip(1)
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    if error.use_stderr()
        && help::named(&arguments) == Some("check")
        && let Err(failure) = check::refused::write(&arguments, &help::what(error))
    {
        failure.print();
    }
    ExitCode::from(error.exit_code() as u8)
}

/// Parses arguments and runs one command. 0: clean, 1: found, 2: the job could not be done.
pub(crate) fn run() -> ExitCode {
    let parsed = help::command().try_get_matches();
    let mut args = match parsed.and_then(|matches| Args::from_arg_matches(&matches)) {
        Ok(args) => args,
        Err(error) => return refused(&error),
    };
    args.global.bound_text(&args.command);
    args.global.progress = waiting::progress(args.global.quiet);
    let global = &args.global;
    let result = match &args.command {
        Command::Check(command) => check::run(global, command),
        Command::Trace(command) => trace::run(global, command),
        Command::Canon(command) => canon::run(global, command),
        Command::Fix(command) => fix::run(global, command),
        Command::Certify(command) => certify::run(global, command),
        Command::Convert(command) => convert::run(global, command),
        Command::Edit(command) => edit::run(global, command),
        Command::Fmt(command) => fmt::run(global, command),
        Command::Diff(command) => diff::run(global, command),
        Command::Stats(command) => stats::run(global, command),
        Command::Explain(command) => explain::explain(command),
        Command::Rules(command) => explain::rules_list(command),
        Command::Machine(command) => machine::run(global, command),
        Command::Plot(command) => plot::run(global, command),
        Command::Surface(command) => surface::run(global, command),
        Command::Servo(command) => servo::run(global, command),
        Command::Sample(command) => sample::run(global, command),
        Command::Report(command) => report::run(global, command),
        Command::Init(command) => init::run(global, command),
        Command::Schema(command) => schema::run(command),
        Command::Completions(command) => shell::completions(command),
        Command::Man => shell::man(),
        Command::Parse(command) => parse::run(global, command),
        Command::Lsp(_) => return ExitCode::from(trunnion_lsp::serve() as u8),
    };
    match result {
        Ok(Done::Clean) => ExitCode::SUCCESS,
        Ok(Done::Found) => ExitCode::from(1),
        Err(failure) if failure.is_broken_pipe() => ExitCode::SUCCESS,
        Err(failure) => {
            failure.print();
            ExitCode::from(2)
        }
    }
}
