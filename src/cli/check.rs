//! `check`: the verdict on files and folders.
use super::{
    Done,
    args::{Check, CheckFormat, Global},
    failure::{Failure, remark, shown},
    json, load, render, short, walk,
};
use crate::cli::out::Out;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use std::{
    io::{IsTerminal, Write},
    path::Path,
};
use trunnion_check::{Report, Severity, Summary, Verdict};

/// One checked file, rendered.
pub(super) struct Checked {
    /// Path as given.
    pub(super) name: String,
    /// Its text for standard output: findings (pretty, short) or nothing (JSON).
    pub(super) text: String,
    /// JSON form.
    pub(super) json: Option<json::File>,
    /// Verdict.
    pub(super) verdict: Verdict,
    /// Counts.
    pub(super) summary: Summary,
    /// Machine it was checked for.
    pub(super) machine: Option<String>,
    /// Some finding at or above `--deny`, or unknown under `--strict`.
    pub(super) found: bool,
    /// For `-v`.
    pub(super) explanation: String,
}

/// Runs `check`.
pub(super) fn run(global: &Global, command: &Check) -> Result<Done, Failure> {
    let files = walk::programs(&command.paths)?;
    let format = command.format.unwrap_or_else(|| {
        if std::io::stdout().is_terminal() {
            CheckFormat::Pretty
        } else {
            CheckFormat::Short
        }
    });
    let bar = progress(global, files.len());
    let results: Vec<Result<Checked, Failure>> = files
        .par_iter()
        .map(|path| {
            let checked = check_file(global, command, format, path);
            bar.inc(1);
            checked
        })
        .collect();
    bar.finish_and_clear();
    let mut checked = Vec::new();
    let mut failed = false;
    for result in results {
        match result {
            Ok(file) => checked.push(file),
            Err(failure) => {
                failure.print();
                failed = true;
            }
        }
    }
    if global.verbose {
        for file in &checked {
            remark(false, &file.explanation);
        }
    }
    let mut out = Out::standard();
    let found = checked.iter().any(|file| file.found);
    if format == CheckFormat::Json {
        json::write(&mut out, checked)?;
    } else {
        print_text(&mut out, global, format, &checked)?;
    }
    out.flush()?;
    if failed {
        return Err(Failure::new("not every file could be checked (see above)"));
    }
    Ok(if found { Done::Found } else { Done::Clean })
}

fn print_text(out: &mut impl Write, global: &Global, format: CheckFormat, checked: &[Checked]) -> Result<(), Failure> {
    for file in checked {
        out.write_all(file.text.as_bytes())?;
    }
    if format == CheckFormat::Pretty {
        if !global.quiet {
            for file in checked {
                writeln!(out, "{}", render::verdict_line(file, global.color.on()))?;
            }
        }
        return Ok(());
    }
    for file in checked {
        remark(global.quiet, &render::verdict_line(file, false));
    }
    Ok(())
}

fn check_file(global: &Global, command: &Check, format: CheckFormat, path: &Path) -> Result<Checked, Failure> {
    let loaded = load::load(global, path)?;
    let settings = loaded.resolved.settings();
    let report = trunnion_check::check(&loaded.program, &settings);
    let lines = trunnion_syntax::LineIndex::new(loaded.program.source());
    let text = match format {
        CheckFormat::Pretty => render::pretty(&loaded, &lines, &report, command.limit, global.color.on()),
        CheckFormat::Short => shown(&short::short(&loaded, &lines, &report, command.limit)).into_owned(),
        CheckFormat::Json => String::new(),
    };
    let deny = global.deny.severity();
    let verdict = report.verdict(deny);
    let json = (format == CheckFormat::Json).then(|| json::file(&loaded, &lines, &report, verdict));
    Ok(Checked {
        text,
        json,
        verdict,
        summary: report.summary,
        machine: loaded.resolved.machine.as_ref().map(|m| m.id.clone()),
        found: is_found(&report, deny, global.strict),
        explanation: loaded.explanation(),
        name: loaded.name,
    })
}

/// Whether the exit status is 1.
pub(super) fn is_found(report: &Report, deny: Severity, strict: bool) -> bool {
    use trunnion_check::Status;
    report.diagnostics.iter().any(|d| match d.status {
        Status::Fail => d.severity >= deny,
        Status::Unknown => strict || d.severity >= deny,
    })
}

fn progress(global: &Global, files: usize) -> ProgressBar {
    if global.quiet || files < 2 || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(files as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} files, {eta} left") {
        bar.set_style(style);
    }
    bar
}
