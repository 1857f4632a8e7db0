//! `diff`: where two programs move the tool differently. What differs only in its text is not shown.
mod json;
mod show;

use super::{
    Done,
    args::{ClaimOf, Global},
    failure::{Failure, remark},
    load, waiting,
};
use crate::cli::out::Out;
use clap::ValueEnum;
use std::{io::Write, path::PathBuf};
use trunnion_diff::{Pair, Tolerance, compare, list};
use trunnion_same::{Input, Verdict};

/// `diff`
#[derive(clap::Args)]
pub(crate) struct Diff {
    /// The program before.
    before: PathBuf,
    /// The program after.
    after: PathBuf,
    /// Positions that differ by no more are the same, mm.
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    tolerance_mm: f64,
    /// Angles that differ by no more are the same, degrees.
    #[arg(long, value_name = "DEG", default_value_t = 0.001)]
    tolerance_deg: f64,
    /// What is compared: all, or the geometry of the tool path alone.
    #[arg(long, value_enum, default_value = "all")]
    claim: ClaimOf,
    /// Show at most this many differences (0: all that were compared in detail).
    #[arg(long, default_value_t = 100)]
    limit: usize,
    #[arg(long, value_enum, default_value = "pretty")]
    format: DiffFormat,
}

/// Formats of `diff`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DiffFormat {
    Pretty,
    Json,
}

/// Runs `diff`. A difference makes the exit status 1.
pub(super) fn run(global: &Global, command: &Diff) -> Result<Done, Failure> {
    let good = |value: f64| value.is_finite() && value >= 0.0;
    if !good(command.tolerance_mm) || !good(command.tolerance_deg) {
        return Err(Failure::new(
            "--tolerance-mm and --tolerance-deg must be numbers of 0 or more",
        ));
    }
    if load::is_stdin(&command.before) && load::is_stdin(&command.after) {
        return Err(Failure::new("only one of the two programs can be standard input"));
    }
    let before = load::load(global, &command.before)?;
    let after = load::load(global, &command.after)?;
    if global.verbose {
        remark(false, &before.explanation());
        remark(false, &after.explanation());
    }
    let tolerance = Tolerance {
        mm: command.tolerance_mm,
        deg: command.tolerance_deg,
    };
    let path_only = command.claim == ClaimOf::Path;
    let found = waiting::during(global, "comparing with", &command.after, || {
        with_pair(&before, &after, |pair| compare(pair, tolerance, path_only))
    });
    let limit = if command.limit == 0 { usize::MAX } else { command.limit };
    let mut out = Out::standard();
    match command.format {
        DiffFormat::Json => json::write(&mut out, [&before, &after], &found, tolerance)?,
        DiffFormat::Pretty => out.text(&show::text(&before, &after, &found, tolerance, limit)),
    }
    out.flush()?;
    Ok(if found.same() { Done::Clean } else { Done::Found })
}

/// What `then` says of two loaded programs, by joints of the machine of the first one.
fn with_pair<T>(before: &load::Loaded, after: &load::Loaded, then: impl FnOnce(&Pair<'_>) -> T) -> T {
    let (old, new) = (&before.resolved, &after.resolved);
    // files of one folder call the same programs
    let folder = |loaded: &load::Loaded| {
        std::path::Path::new(&loaded.name)
            .parent()
            .map(std::path::Path::to_path_buf)
    };
    let [setup, mut beside] = [old, new].map(|resolved| load::with_assumed(&resolved.setup, &[before, after]));
    if folder(before) == folder(after) {
        beside.library = old.setup.library.clone();
    }
    let pair = Pair {
        before: Input {
            setup: &setup,
            ..before.input()
        },
        after: Input {
            machine: old.machine.as_ref(),
            setup: &beside,
            ..after.input()
        },
        one_setup: old.config_path == new.config_path,
    };
    then(&pair)
}

/// One line on how much of two programs that are not the same is the same, motion by motion; `verdict`: what `certify` has found.
pub(super) fn shared(
    before: &load::Loaded,
    after: &load::Loaded,
    (tolerance_mm, tolerance_deg): (f64, f64),
    verdict: Verdict,
) -> String {
    let tolerance = Tolerance {
        mm: tolerance_mm,
        deg: tolerance_deg,
    };
    show::shared(&with_pair(before, after, |pair| list(pair, tolerance, verdict)))
}
