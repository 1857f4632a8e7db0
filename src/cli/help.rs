//! The help of commands that read no program: the options of all commands mean nothing there, so one line says where they are.
use super::args::Args;
use clap::{Command, CommandFactory};

/// Commands that read no program, with the options of all commands that they use.
const WITHOUT_A_PROGRAM: &[(&[&str], &[&str])] = &[
    (&["machine", "list"], &[]),
    (&["machine", "show"], &[]),
    (&["machine", "check"], &[]),
    (&["machine", "import"], &["quiet"]),
    (&["explain"], &[]),
    (&["rules"], &[]),
    (&["schema"], &[]),
    (&["completions"], &[]),
    (&["man"], &[]),
    (&["lsp"], &[]),
];

const WHERE: &str = "`trunnion help check` lists the options of commands that read a program.";

/// The command line.
pub(super) fn command() -> Command {
    let mut command = Args::command();
    // gives each command the options of all commands
    command.build();
    WITHOUT_A_PROGRAM
        .iter()
        .fold(command, |command, (path, used)| without(command, path, used))
}

fn without(command: Command, path: &[&str], used: &[&str]) -> Command {
    if let Some((name, rest)) = path.split_first() {
        return command.mut_subcommand(name, |inner| without(inner, rest, used));
    }
    let hidden = |arg: clap::Arg| {
        let hide = arg.is_global_set() && !used.contains(&arg.get_id().as_str());
        arg.hide(hide)
    };
    command.mut_args(hidden).after_help(WHERE)
}
