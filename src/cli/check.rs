//! `check`: the verdict on files and folders.
use super::{
    Done,
    args::{Check, CheckFormat, Global},
    failure::{Failure, remark, shown},
    json, load, render, short, walk,
};
use crate::cli::out::Out;
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use std::{
    io::{IsTerminal, Write},
    path::{Path, PathBuf},
};
use trunnion_check::{Coverage, Report, Scope, Severity, Summary, Verdict};

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
    /// Why the file is not read, if it is not.
    pub(super) not_read: Option<String>,
    /// The dialect and why, where that was not certain.
    pub(super) read_as: Option<String>,
    /// How much was judged.
    pub(super) scope: Scope,
    /// What was checked.
    pub(super) coverage: Coverage,
    /// Undeclared values that were assumed.
    pub(super) assumptions: Vec<String>,
    /// Some finding at or above `--deny`, or unknown under `--strict`.
    pub(super) found: bool,
    /// For `-v`.
    pub(super) explanation: String,
}

/// Runs `check`.
pub(super) fn run(global: &Global, command: &Check) -> Result<Done, Failure> {
    let found = walk::programs(&command.paths)?;
    found.remark(global.quiet, global.verbose);
    let format = command.format.unwrap_or_else(|| {
        if std::io::stdout().is_terminal() {
            CheckFormat::Pretty
        } else {
            CheckFormat::Short
        }
    });
    let bar = progress(global, found.files.len());
    let mut tally = Tally::default();
    for failure in &found.failures {
        failure.print();
        tally.not_checked.push(json::NotChecked::of(failure));
    }
    let mut out = Out::standard();
    if format == CheckFormat::Json {
        json::write(&mut out, |put| {
            each(global, command, format, &found.files, &bar, &mut tally, put);
            tally.not_checked.as_slice()
        })?;
    } else {
        let mut last_lines = Vec::new();
        each(global, command, format, &found.files, &bar, &mut tally, &mut |file| {
            bar.suspend(|| print_text(&mut out, global, format, &file, &mut last_lines));
        });
        for line in &last_lines {
            let _ = writeln!(out, "{line}");
        }
        if found.walked && !global.quiet {
            let line = tally.line();
            if format == CheckFormat::Pretty {
                let _ = writeln!(out, "{line}");
            } else {
                remark(false, &line);
            }
        }
    }
    bar.finish_and_clear();
    out.flush()?;
    if !tally.not_checked.is_empty() {
        return Err(Failure::new("not every file could be checked (see above)"));
    }
    Ok(if tally.found { Done::Found } else { Done::Clean })
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
}

impl Tally {
    fn count(&mut self, file: &Checked) {
        self.files += 1;
        match file.verdict {
            Verdict::Pass => self.pass += 1,
            Verdict::Fail => self.fail += 1,
            Verdict::Unknown => self.unknown += 1,
        }
        self.found |= file.found;
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
fn each(
    global: &Global,
    command: &Check,
    format: CheckFormat,
    files: &[PathBuf],
    bar: &ProgressBar,
    tally: &mut Tally,
    put: &mut dyn FnMut(Checked),
) {
    for some in files.chunks(AT_ONCE) {
        let results: Vec<Result<Checked, Failure>> = some
            .par_iter()
            .map(|path| {
                let checked = check_file(global, command, format, path);
                bar.inc(1);
                checked
            })
            .collect();
        for result in results {
            match result {
                Ok(file) => {
                    if global.verbose {
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

fn print_text(
    out: &mut impl Write,
    global: &Global,
    format: CheckFormat,
    file: &Checked,
    last_lines: &mut Vec<String>,
) {
    // standard output keeps its errors for the end
    let _ = out.write_all(file.text.as_bytes());
    if format == CheckFormat::Pretty {
        if !global.quiet {
            last_lines.push(render::verdict_line(file, global.color.on()));
        }
        return;
    }
    let _ = out.flush();
    remark(global.quiet, &render::verdict_line(file, false));
}

fn check_file(global: &Global, command: &Check, format: CheckFormat, path: &Path) -> Result<Checked, Failure> {
    let loaded = load::load_any(global, path)?;
    let mut settings = loaded.resolved.settings();
    settings.scope = command.scope.map(CheckScope::scope);
    let report = trunnion_check::check(&loaded.program, &settings);
    let lines = trunnion_syntax::LineIndex::new(loaded.program.source());
    let text = match format {
        CheckFormat::Pretty => render::pretty(&loaded, &lines, &report, command.limit, global.color.on()),
        CheckFormat::Short => shown(&short::short(&loaded, &lines, &report, command.limit)).into_owned(),
        CheckFormat::Json => String::new(),
    };
    let deny = global.deny.severity();
    let verdict = report.verdict(deny);
    let json = (format == CheckFormat::Json).then(|| json::file(&loaded, &lines, &report, (verdict, settings.scope())));
    Ok(Checked {
        scope: settings.scope(),
        not_read: loaded.not_read(),
        read_as: (!loaded.resolved.dialect_certain)
            .then(|| format!("{} ({})", loaded.resolved.dialect.name, loaded.resolved.dialect_reason)),
        text,
        json,
        verdict,
        summary: report.summary,
        machine: loaded.resolved.machine.as_ref().map(|m| m.id.clone()),
        found: is_found(&report, deny, global.strict),
        explanation: loaded.explanation(),
        coverage: report.coverage,
        assumptions: report.assumptions,
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
