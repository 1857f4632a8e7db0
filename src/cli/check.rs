//! `check`: the verdict on files and folders.
mod baseline;
mod cache;
mod document;
mod github;
mod junit;
mod one;
pub(super) mod refused;
mod sarif;
mod statistics;
mod watch;

use super::{
    Done,
    args::{Check, CheckFormat, Global},
    failure::{Failure, remark},
    json,
    out::Out,
    waiting, walk,
};
use baseline::{Accepted, Baseline};
use cache::Cache;
use clap::ValueEnum;
use document::Document;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
pub(super) use one::is_found;
use one::{Checked, Job};
use rayon::prelude::*;
use statistics::Statistics;
use std::{
    io::{IsTerminal, Write},
    path::PathBuf,
};
use trunnion_check::Scope;
use trunnion_files::Outputs;

/// With more files, the lines of those that pass are left out where standard error is no terminal, as in the log of a CI job.
const MOST_LINES: usize = 300;

/// Files that are checked before the first of them is printed.
const AT_ONCE: usize = 64;

/// `--scope`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckScope {
    Language,
    Motion,
    Machine,
}

impl CheckScope {
    /// As the check takes it.
    pub(crate) fn scope(self) -> Scope {
        match self {
            Self::Language => Scope::Language,
            Self::Motion => Scope::Motion,
            Self::Machine => Scope::Machine,
        }
    }
}

/// Runs `check`, again and again with `--watch`.
pub(super) fn run(global: &Global, command: &Check) -> Result<Done, Failure> {
    if command.watch {
        return watch::run(global, command);
    }
    once(global, command)
}

/// Checks all files once.
fn once(global: &Global, command: &Check) -> Result<Done, Failure> {
    let mut found = walk::programs(&command.paths).unwrap_or_else(walk::Found::failed);
    found.remark(global.quiet, global.verbose);
    if command.baseline.is_none() && command.write_baseline.is_none() {
        for path in found.baselines() {
            let path = path.display();
            remark(
                global.quiet,
                &format!("{path}: a baseline, which is not used; --baseline {path} uses it"),
            );
        }
    }
    let format = command.format.unwrap_or_else(|| {
        if command.output.is_none() && std::io::stdout().is_terminal() {
            CheckFormat::Pretty
        } else {
            CheckFormat::Short
        }
    });
    let mut outputs = Outputs::new();
    for file in found.files.iter().chain(&command.paths) {
        outputs.input(file);
    }
    if command.output.is_none() {
        outputs.standard("the result");
    }
    let mut output = |option: &str, path: Option<&PathBuf>| path.map(|path| outputs.output(option, path)).transpose();
    let target = output("-o", command.output.as_ref())?;
    let to_baseline = output("--write-baseline", command.write_baseline.as_ref())?;
    // without them nothing is checked; the document says so, for whoever reads no terminal
    let mut failed = |failure| found = walk::Found::failed(failure);
    let baseline = command.baseline.as_deref().map(Baseline::read).transpose();
    let baseline = baseline.unwrap_or_else(|failure| (failed(failure), None).1);
    let cache = command.cache.as_deref().map(Cache::open).transpose();
    let cache = cache.unwrap_or_else(|failure| (failed(failure), None).1);
    let job = Job {
        global,
        command,
        format,
        baseline: baseline.as_ref(),
        cache: cache.as_ref(),
    };
    let mut accepted = Accepted::new(command.write_baseline.as_deref());
    let mut tally = Tally::default();
    if let Some(target) = target {
        target.fill(|out| print(&job, &found, &mut tally, &mut accepted, out))?;
    } else {
        print(&job, &found, &mut tally, &mut accepted, &mut Out::standard())?;
    }
    if let Some((target, path)) = to_baseline.zip(command.write_baseline.as_ref()) {
        if !tally.not_checked.is_empty() {
            return Err(Failure::new(
                "not every file could be checked (see above), so no baseline was written",
            ));
        }
        target.fill(|out| accepted.print(out).map_err(Failure::from))?;
        remark(global.quiet, &accepted.remark(&path.display().to_string()));
        return Ok(Done::Clean);
    }
    if let Some(baseline) = &baseline {
        baseline.remark_gone(global.quiet, tally.gone);
    }
    if !tally.not_checked.is_empty() {
        return Err(Failure::new("not every file could be checked (see above)"));
    }
    Ok(if tally.found { Done::Found } else { Done::Clean })
}

/// Where the lines with the verdicts go.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lines {
    /// Into the document, after all files.
    Last,
    /// Into the document, after their file, each with what was not covered.
    Here,
    /// The same, and to standard error, because the document is a file.
    HereAndRemarks,
    /// To standard error.
    Remarks,
    /// Nowhere: the document has the verdicts itself.
    Nowhere,
}

impl Lines {
    fn of(job: &Job<'_>) -> Self {
        match job.format {
            CheckFormat::Github if job.command.output.is_some() => Self::HereAndRemarks,
            _ if job.command.output.is_some() => Self::Remarks,
            CheckFormat::Pretty => Self::Last,
            CheckFormat::Github => Self::Here,
            CheckFormat::Short => Self::Remarks,
            CheckFormat::Json | CheckFormat::Sarif | CheckFormat::Junit => Self::Nowhere,
        }
    }
}

/// Checks the files and writes the document.
fn print(
    job: &Job<'_>,
    found: &walk::Found,
    tally: &mut Tally,
    accepted: &mut Accepted,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let quiet = job.global.quiet;
    let lines = Lines::of(job);
    let brief = !job.global.verbose && found.files.len() > MOST_LINES && !std::io::stderr().is_terminal();
    for failure in &found.failures {
        failure.print();
        tally.not_checked.push(json::NotChecked::of(failure));
    }
    let bar = progress(job.global, found.files.len());
    let mut document = Document::new(job.format, out);
    document.begin()?;
    let mut last_lines = Vec::new();
    let mut failed = None;
    each(job, &found.files, &bar, tally, &mut |file| {
        accepted.take(&file);
        bar.suspend(|| {
            if let Err(error) = document.file(&file) {
                failed.get_or_insert(error);
            }
            match lines {
                Lines::HereAndRemarks => {
                    // it is part of the file that was asked for
                    let _ = document.line(&format!("{}{}", file.line, file.about));
                    if !brief || file.verdict != "pass" {
                        remark(quiet, &file.line);
                    }
                }
                _ if brief && file.verdict == "pass" => {}
                Lines::Last => last_lines.push(file.line),
                Lines::Here if !quiet => {
                    // standard output keeps its errors for the end
                    let _ = document.line(&format!("{}{}", file.line, file.about));
                }
                Lines::Remarks => {
                    document.flush();
                    remark(quiet, &file.line);
                }
                Lines::Here | Lines::Nowhere => {}
            }
        });
    });
    bar.finish_and_clear();
    if let Some(error) = failed {
        return Err(error.into());
    }
    document.end(tally, job.command.statistics)?;
    if lines == Lines::HereAndRemarks && found.walked {
        let _ = document.line(&tally.line());
    }
    if !quiet {
        let note = if brief && tally.pass > 0 {
            " (-v prints a line for each file that passes too)"
        } else {
            ""
        };
        last_lines.extend((found.walked || brief).then(|| tally.line() + note));
        match lines {
            Lines::Last | Lines::Here => {
                for line in &last_lines {
                    let _ = document.line(line);
                }
            }
            Lines::Remarks | Lines::HereAndRemarks => last_lines.iter().for_each(|line| remark(false, line)),
            Lines::Nowhere => {}
        }
    }
    document.flush();
    Ok(())
}

/// The result of all files together.
#[derive(Default)]
struct Tally {
    files: u64,
    pass: u64,
    fail: u64,
    unknown: u64,
    not_checked: Vec<json::NotChecked>,
    found: bool,
    /// Findings of the baseline that are not found any more.
    gone: u64,
    statistics: Statistics,
    summary: one::Counts,
    /// The machine of all files, if it is one.
    machine: Option<String>,
}

impl Tally {
    fn count(&mut self, file: &Checked) {
        if self.files == 0 {
            self.machine.clone_from(&file.machine);
        } else if self.machine != file.machine {
            self.machine = None;
        }
        self.files += 1;
        match file.verdict.as_str() {
            "pass" => self.pass += 1,
            "fail" => self.fail += 1,
            _ => self.unknown += 1,
        }
        self.found |= file.found;
        self.gone += file.gone;
        self.statistics.add(&file.rules);
        self.summary.add(&file.summary);
    }
    /// The last line of a folder.
    fn line(&self) -> String {
        let Self {
            files,
            pass,
            fail,
            unknown,
            not_checked,
            ..
        } = self;
        let failed = match not_checked.len() {
            0 => String::new(),
            failed => format!(", {failed} not checked"),
        };
        let noun = if *files == 1 { "file" } else { "files" };
        format!("{files} {noun}: {pass} pass, {fail} fail, {unknown} unknown{failed}")
    }
}

/// Checks the files on all cores and hands them over in order. Only a piece of them is in memory at once.
fn each(job: &Job<'_>, files: &[PathBuf], bar: &ProgressBar, tally: &mut Tally, put: &mut dyn FnMut(Checked)) {
    for some in files.chunks(AT_ONCE) {
        let results: Vec<Result<Checked, Failure>> = some
            .par_iter()
            .map(|path| {
                // several files have the bar
                let checked = match files {
                    [_] => waiting::during(job.global, "checking", path, || job.check(path)),
                    _ => job.check(path),
                };
                bar.inc(1);
                checked
            })
            .collect();
        for result in results {
            match result {
                Ok(file) => {
                    if job.global.verbose {
                        remark(false, &file.explanation);
                    }
                    tally.count(&file);
                    put(file);
                }
                Err(failure) => {
                    bar.suspend(|| failure.print());
                    tally.not_checked.push(json::NotChecked::of(&failure));
                }
            }
        }
    }
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
