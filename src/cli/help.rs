//! The help of commands: examples at its end. In commands that read no program the options of all commands mean nothing, so one line says where they are.
use super::{args::Args, examples};
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
    let names: Vec<String> = command.get_subcommands().map(|sub| sub.get_name().to_owned()).collect();
    let with_examples = names.iter().fold(command, |command, name| match examples::of(name) {
        Some(text) => command.mut_subcommand(name, |sub| sub.after_help(text)),
        None => command,
    });
    WITHOUT_A_PROGRAM
        .iter()
        .fold(with_examples, |command, (path, used)| without(command, path, used))
}

fn without(command: Command, path: &[&str], used: &[&str]) -> Command {
    if let Some((name, rest)) = path.split_first() {
        return command.mut_subcommand(name, |inner| without(inner, rest, used));
    }
    let hidden = |arg: clap::Arg| {
        let hide = arg.is_global_set() && !used.contains(&arg.get_id().as_str());
        arg.hide(hide)
    };
    let ends = match command.get_after_help() {
        Some(examples) => format!("{examples}\n\n{WHERE}"),
        None => WHERE.to_owned(),
    };
    command.mut_args(hidden).after_help(ends)
}

/// The command that arguments name: the first word that is neither an option nor the value of one.
pub(super) fn named(arguments: &[String]) -> Option<&str> {
    let command = Args::command();
    let has_value = |word: &str| {
        let is = |arg: &&clap::Arg| {
            let long = arg.get_long().is_some_and(|long| word.strip_prefix("--") == Some(long));
            let short = arg
                .get_short()
                .is_some_and(|short| word.strip_prefix('-') == Some(short.encode_utf8(&mut [0; 4])));
            long || short
        };
        command.get_opts().any(|arg| is(&arg))
    };
    let mut words = arguments.iter().map(String::as_str);
    while let Some(word) = words.next() {
        if !word.starts_with('-') {
            return Some(word);
        }
        if has_value(word) {
            words.next();
        }
    }
    None
}

/// What is wrong with arguments, in one line without the usage.
pub(super) fn what(error: &clap::Error) -> String {
    let text = error.render().to_string();
    let text = text.strip_prefix("error: ").unwrap_or(&text);
    let text = text.split("\n\nUsage:").next().unwrap_or(text);
    let text = text.split("\n\nFor more information").next().unwrap_or(text);
    let in_a_line = |part: &str| part.split_whitespace().collect::<Vec<_>>().join(" ");
    text.split("\n\n").map(in_a_line).collect::<Vec<_>>().join("; ")
}
