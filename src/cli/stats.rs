//! `stats`: what a program is made of: blocks, motions, tools, distances, times, extents.
mod show;
mod time;

use super::{Done, args::Global, args::ListFormat, failure::Failure, load, waiting, walk};
use crate::cli::out::{Indented, Out};
use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};
use time::Times;
use trunnion_stats::Tally;

/// `stats`
#[derive(clap::Args)]
pub(crate) struct Stats {
    /// Files and directories; `-` reads standard input.
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Also say how long each tool and operation takes, where the feed is not reached, and why.
    #[arg(long)]
    time: bool,
    #[arg(long, value_enum, default_value = "text")]
    format: ListFormat,
}

/// Runs `stats`. Nothing is judged: the exit status is 0 whatever the program contains. A file that cannot be read is reported, and the others
/// are counted; each is written before the next one is read.
pub(super) fn run(global: &Global, command: &Stats) -> Result<Done, Failure> {
    let mut out = Out::standard();
    let found = walk::programs(&command.paths)?;
    found.remark(global.quiet, global.verbose);
    let mut failed = found.failures.len();
    found.failures.iter().for_each(Failure::print);
    let json = command.format == ListFormat::Json;
    let mut written = 0;
    if json {
        write!(out, "{{\n  \"files\": [")?;
    }
    for path in &found.files {
        let counted = waiting::during(global, "counting", path, || count(global, path));
        let (loaded, tally) = match counted {
            Ok(counted) => counted,
            Err(failure) => {
                failure.print();
                failed += 1;
                continue;
            }
        };
        let times = loaded
            .resolved
            .machine
            .as_ref()
            .map(|machine| waiting::during(global, "planning", path, || Times::of(&loaded, machine)));
        let interval = times.as_ref().and_then(Times::interval);
        let asked = times.as_ref().filter(|_| command.time);
        if json {
            write!(out, "{}\n    ", if written > 0 { "," } else { "" })?;
            let mut file = Indented::new(&mut out, "    ");
            let shown = show::json(&loaded, &tally, interval, asked.map(Times::json));
            serde_json::to_writer_pretty(&mut file, &shown).map_err(io::Error::from)?;
        } else {
            if written > 0 {
                writeln!(out)?;
            }
            out.text(&show::text(&loaded, &tally, interval));
            if let Some(times) = asked {
                out.text(&times.text());
            } else if command.time {
                out.text("  planned       unknown without --machine\n");
            }
        }
        written += 1;
    }
    if json {
        let end = if written > 0 { "\n  ]" } else { "]" };
        let version = env!("CARGO_PKG_VERSION");
        writeln!(
            out,
            "{end},\n  \"schema\": \"trunnion-stats/1\",\n  \"version\": \"{version}\"\n}}"
        )?;
    }
    out.flush()?;
    if failed > 0 {
        return Err(Failure::new("not every file could be read (see above)"));
    }
    Ok(Done::Clean)
}

/// Runs one program and counts.
fn count(global: &Global, path: &Path) -> Result<(load::Loaded, Tally), Failure> {
    let loaded = load::load_for_steps(global, path)?;
    let tally = Tally::of(loaded.input());
    Ok((loaded, tally))
}
