//! `completions` and `man`: what shells and `man` want to know of the command line.
use super::{
    Done,
    args::{Args, Completions},
    failure::Failure,
    help,
    out::Out,
};
use clap::CommandFactory;
use std::io::Write;

/// Prints the completions for a shell.
pub(super) fn completions(command: &Completions) -> Result<Done, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(command.shell, &mut Args::command(), "trunnion", &mut text);
    Out::standard().write_all(&text)?;
    Ok(Done::Clean)
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
