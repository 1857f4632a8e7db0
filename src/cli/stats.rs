//! `stats`: what a program is made of: blocks, motions, tools, distances, times, extents.
mod show;

use super::{Done, args::Global, args::ListFormat, failure::Failure, json::write_json, load, walk};
use crate::cli::out::Out;
use serde_json::json;
use std::{io::Write, path::PathBuf};
use trunnion_check::check;
use trunnion_stats::Tally;

/// `stats`
#[derive(clap::Args)]
pub(crate) struct Stats {
    /// Files and directories; `-` reads standard input.
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    #[arg(long, value_enum, default_value = "text")]
    format: ListFormat,
}

/// Runs `stats`. Nothing is judged: the exit status is 0 whatever the program contains.
pub(super) fn run(global: &Global, command: &Stats) -> Result<Done, Failure> {
    let mut out = Out::standard();
    let mut files = Vec::new();
    let found = walk::programs(&command.paths)?;
    found.remark(global.quiet, global.verbose);
    for (number, path) in found.files.iter().enumerate() {
        let loaded = load::load_for_steps(global, path)?;
        let tally = Tally::of(loaded.input());
        let machine = loaded.resolved.machine.is_some();
        let cycle_time_s = machine.then(|| check(&loaded.program, &loaded.resolved.settings()).cycle_time_s);
        let cycle_time_s = cycle_time_s.flatten();
        match command.format {
            ListFormat::Json => files.push(show::json(&loaded, &tally, cycle_time_s)),
            ListFormat::Text => {
                if number > 0 {
                    writeln!(out)?;
                }
                out.text(&show::text(&loaded, &tally, cycle_time_s));
            }
        }
    }
    if command.format == ListFormat::Json {
        let document = json!({ "schema": "trunnion-stats/1", "version": env!("CARGO_PKG_VERSION"), "files": files });
        write_json(&mut out, &document)?;
    }
    out.flush()?;
    Ok(Done::Clean)
}
