//! `stats`: what a program is made of: blocks, motions, tools, distances, times, extents.
mod show;

use super::{Done, args::Global, args::ListFormat, failure::Failure, load, walk};
use crate::cli::out::{Indented, Out};
use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};
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
        let (loaded, tally, time) = match count(global, path) {
            Ok(counted) => counted,
            Err(failure) => {
                failure.print();
                failed += 1;
                continue;
            }
        };
        if json {
            write!(out, "{}\n    ", if written > 0 { "," } else { "" })?;
            let mut file = Indented::new(&mut out, "    ");
            serde_json::to_writer_pretty(&mut file, &show::json(&loaded, &tally, time)).map_err(io::Error::from)?;
        } else {
            if written > 0 {
                writeln!(out)?;
            }
            out.text(&show::text(&loaded, &tally, time));
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

/// Runs one program and counts; and its cycle time, s, where it is on a machine.
fn count(global: &Global, path: &Path) -> Result<(load::Loaded, Tally, Option<[f64; 2]>), Failure> {
    let loaded = load::load_for_steps(global, path)?;
    let tally = Tally::of(loaded.input());
    let machine = loaded.resolved.machine.is_some();
    let time = machine.then(|| check(&loaded.program, &loaded.resolved.settings()).cycle_time_s);
    Ok((loaded, tally, time.flatten()))
}
