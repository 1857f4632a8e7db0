//! `completions` and `man`: what shells and `man` want to know of the command line.
use super::{
    Done,
    args::{Args, Completions},
    failure::Failure,
    help,
    out::Out,
};
use clap::{Arg, Command, CommandFactory, builder::PossibleValuesParser};
use clap_complete::Shell;
use std::io::Write;

/// Prints the completions for a shell.
pub(super) fn completions(command: &Completions) -> Result<Done, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(command.shell, &mut with_names(Args::command()), "trunnion", &mut text);
    let text = String::from_utf8_lossy(&text);
    Out::standard().write_all(with_files(command.shell, &text).as_bytes())?;
    Ok(Done::Clean)
}

/// The command with the names that its arguments may have. Only for completions: a machine may also be a file, and a wrong name has a better
/// message elsewhere.
fn with_names(command: Command) -> Command {
    let name = command.get_name().to_owned();
    command
        .mut_args(|arg| match names_of(&name, &arg) {
            Some(names) => arg.value_parser(PossibleValuesParser::new(names)),
            None => arg,
        })
        .mut_subcommands(with_names)
}

/// The names that an argument of a command may have: of machines, dialects, rewrites or rules.
fn names_of(command: &str, arg: &Arg) -> Option<Vec<&'static str>> {
    match (command, arg.get_id().as_str()) {
        (_, "machine" | "to_machine") | ("compare", "believed" | "truth") | ("show" | "check", "name") => {
            Some(trunnion_machine::BUILTIN_MACHINES.to_vec())
        }
        (_, "dialect" | "port_to" | "to") => Some(trunnion_dialect::BUILTIN_NAMES.to_vec()),
        ("fix", "rewrite") => Some(rewrites().collect()),
        ("explain", "name") => Some(rules().chain(rewrites()).collect()),
        _ => None,
    }
}

fn rules() -> impl Iterator<Item = &'static str> {
    trunnion_check::rules().iter().map(|rule| rule.name)
}

fn rewrites() -> impl Iterator<Item = &'static str> {
    trunnion_rewrite::rewrites().iter().map(|rewrite| rewrite.name)
}

/// Where the names of machines are offered, files are too. clap offers one or the other.
fn with_files(shell: Shell, script: &str) -> String {
    let names = trunnion_machine::BUILTIN_MACHINES.join(" ");
    match shell {
        Shell::Bash => script.replace(
            &format!("COMPREPLY=($(compgen -W \"{names}\" -- \"${{cur}}\"))"),
            &format!("COMPREPLY=($(compgen -W \"{names}\" -- \"${{cur}}\") $(compgen -f -- \"${{cur}}\"))"),
        ),
        Shell::Zsh => script.replace(&format!(":({names})'"), &format!(":{{compadd -- {names}; _files}}'")),
        Shell::Fish => {
            let names = trunnion_machine::BUILTIN_MACHINES.join("\\t''\n");
            script.replace(&format!("-f -a \"{names}"), &format!("-F -a \"{names}"))
        }
        // Elvish and PowerShell complete no values
        _ => script.to_owned(),
    }
}

/// Prints the manual page of `trunnion` with all its commands.
pub(super) fn man() -> Result<Done, Failure> {
    let mut out = Out::standard();
    let command = help::command();
    clap_mangen::Man::new(command.clone()).render(&mut out)?;
    for sub in command
        .get_subcommands()
        .filter(|sub| !sub.is_hide_set() && sub.get_name() != "help")
    {
        writeln!(out, ".SH \"TRUNNION {}\"", sub.get_name().to_uppercase())?;
        let page = clap_mangen::Man::new(sub.clone());
        page.render_description_section(&mut out)?;
        page.render_options_section(&mut out)?;
        page.render_extra_section(&mut out)?;
    }
    Ok(Done::Clean)
}
