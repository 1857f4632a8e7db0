//! `fmt`: layout and block numbers. A file is replaced only where both texts are proved to do the same; a file that cannot be proved is not changed.
use super::{
    Done,
    args::Global,
    failure::{Failure, remark},
    fix::print_diff,
    load::{self, Loaded},
    waiting, walk,
};
use crate::cli::out::Out;
use rayon::prelude::*;
use std::{
    io::Write,
    path::{Path, PathBuf},
};
use trunnion_files::Seen;
use trunnion_ide::style;
use trunnion_layout::{Layout, Numbers, Refusal, Renumbered};
use trunnion_syntax::{LineIndex, Program, TextRange};

/// `fmt`
#[derive(clap::Args)]
pub(crate) struct Fmt {
    /// Files and directories; `-` reads standard input and writes to standard output.
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Write nothing; list the files that would change, with exit status 1 if there are any.
    #[arg(long)]
    check: bool,
    /// Write nothing; print a unified diff.
    #[arg(long, conflicts_with = "stdout")]
    diff: bool,
    /// Write nothing; print the new text (one file).
    #[arg(long, conflicts_with = "check")]
    stdout: bool,
    /// Replace the files safely (the default): write new files next to them, flush them, rename them.
    #[arg(long, conflicts_with_all = ["check", "diff", "stdout"])]
    write: bool,
    /// Renumber the blocks from START in steps of STEP (default 10). Jumps, M99 P, M97 P and turning contours follow. Each
    /// program of a file starts again. Blocks without a number stay without one.
    #[arg(long, value_name = "START[,STEP]", value_parser = numbers)]
    renumber: Option<Numbers>,
}

/// `10` or `10,5`.
fn numbers(text: &str) -> Result<Numbers, String> {
    let (start, step) = text.split_once(',').unwrap_or((text, "10"));
    let whole = |part: &str| {
        part.trim()
            .parse::<u32>()
            .map_err(|_| format!("`{part}` is not a whole number"))
    };
    match (whole(start)?, whole(step)?) {
        (_, 0) => Err("the step must be 1 or more".to_owned()),
        (start, step) => Ok(Numbers { start, step }),
    }
}

/// The result for one file.
struct Outcome {
    path: PathBuf,
    name: String,
    before: Vec<u8>,
    /// The state of the file when it was read.
    seen: Option<Seen>,
    after: Vec<u8>,
    remarks: Vec<String>,
    refused: bool,
}

/// Runs `fmt`. A file whose new layout cannot be proved is not changed, and makes the exit status 2.
pub(super) fn run(global: &Global, command: &Fmt) -> Result<Done, Failure> {
    if command.write && command.paths.iter().any(|path| load::is_stdin(path)) {
        return Err(Failure::new(
            "--write needs files, because standard input cannot be replaced; without --write the new text goes to standard output",
        ));
    }
    let mut found = walk::programs(&command.paths)?;
    found.remark(global.quiet, global.verbose);
    let paths = std::mem::take(&mut found.files);
    if command.stdout && paths.len() > 1 {
        return Err(Failure::new(format!("--stdout takes one file, not {}", paths.len())));
    }
    // in pieces, so that not all files are in memory at once
    let (mut changed, mut unchanged) = (0usize, 0usize);
    let mut failures: Vec<_> = found.failures.into_iter().map(Some).collect();
    for some in paths.chunks(64) {
        let outcomes: Vec<_> = match (some, paths.len()) {
            ([one], 1) => vec![waiting::during(global, "formatting", one, || {
                lay_out(global, command, one)
            })],
            _ => some.par_iter().map(|path| lay_out(global, command, path)).collect(),
        };
        for outcome in outcomes {
            match outcome.and_then(|outcome| finish(global, command, &outcome)) {
                Ok(Some(true)) => changed += 1,
                Ok(Some(false)) => unchanged += 1,
                Ok(None) => failures.push(None),
                Err(failure) if failure.is_broken_pipe() => return Err(failure),
                Err(failure) => failures.push(Some(failure)),
            }
        }
    }
    let told = !(command.stdout || command.paths.iter().all(|path| load::is_stdin(path)));
    if told && (global.verbose || paths.len() > 1) {
        let verb = if command.check || command.diff {
            "would change"
        } else {
            "changed"
        };
        let rest = if failures.is_empty() {
            String::new()
        } else {
            format!(", {} failed", failures.len())
        };
        remark(global.quiet, &format!("{changed} {verb}, {unchanged} unchanged{rest}"));
    }
    let count = failures.len();
    for failure in failures.iter().flatten().take(count.saturating_sub(1)) {
        failure.print();
    }
    match failures.pop() {
        Some(Some(failure)) => Err(failure),
        Some(None) => Err(Failure::new(format!(
            "{count} of {} files were not changed; see the reasons above",
            paths.len()
        ))),
        None if command.check && changed > 0 => Ok(Done::Found),
        None => Ok(Done::Clean),
    }
}

/// Lays out one file and renumbers it if requested. Writes nothing.
fn lay_out(global: &Global, command: &Fmt, path: &Path) -> Result<Outcome, Failure> {
    if !(command.check || command.diff || command.stdout) {
        trunnion_files::sweep_beside(path);
    }
    let mut loaded = load::load(global, path)?;
    let before = loaded.program.source().to_vec();
    let mut outcome = Outcome {
        path: path.to_owned(),
        name: loaded.name.clone(),
        after: before.clone(),
        before,
        seen: loaded.seen.clone(),
        remarks: Vec::new(),
        refused: false,
    };
    if global.verbose {
        outcome.remarks.push(loaded.explanation());
    }
    let told = match loaded.program.errors().len() {
        0 => None,
        1 => Some("1 problem in the text; its line is not changed".to_owned()),
        many => Some(format!("{many} problems in the text; their lines are not changed")),
    };
    if let Some(told) = told {
        outcome
            .remarks
            .push(format!("{}: {told}, see `trunnion check`", loaded.name));
    }
    let (dialect, setup) = (loaded.resolved.dialect, &loaded.resolved.setup);
    match trunnion_layout::layout(&loaded.program, dialect, setup, &style(&loaded.resolved.format)) {
        Layout::Unchanged => {}
        Layout::Changed(text) => outcome.after = text,
        Layout::Refused(why) => outcome.refuse(&refusal(&loaded, &why)),
    }
    if let (Some(numbers), false) = (command.renumber, outcome.refused) {
        loaded.program = trunnion_syntax::parse(outcome.after.clone(), dialect.lex);
        renumber(&loaded, numbers, &mut outcome);
    }
    if outcome.refused {
        outcome.after.clone_from(&outcome.before);
    }
    Ok(outcome)
}

fn renumber(loaded: &Loaded, numbers: Numbers, outcome: &mut Outcome) {
    let (dialect, setup) = (loaded.resolved.dialect, &loaded.resolved.setup);
    match trunnion_layout::renumber(&loaded.program, dialect, setup, numbers) {
        Renumbered::NoNumbers => outcome.remarks.push(format!("{}: no block has a number", loaded.name)),
        Renumbered::Changed {
            text, called_outside, ..
        } => {
            outcome.after = text;
            if !called_outside.is_empty() {
                let names: Vec<String> = called_outside.iter().map(|name| format!("O{name}")).collect();
                outcome.remarks.push(format!(
                    "{}: calls {}, which is not in this file: if it returns with M99 P to a block of this file, that number is not \
                     followed",
                    loaded.name,
                    names.join(", ")
                ));
            }
        }
        Renumbered::Refused(obstacle) => {
            let at = place(&loaded.program, obstacle.range);
            outcome.refuse(&format!(
                "{}{at}: block numbers are not changed: {}",
                loaded.name, obstacle.why
            ));
        }
        Renumbered::Differs(difference) => {
            let at = place(&loaded.program, block_range(&loaded.program, &difference));
            outcome.refuse(&format!(
                "{}{at}: block numbers are not changed: with new ones, {}",
                loaded.name, difference.what
            ));
        }
    }
}

impl Outcome {
    fn refuse(&mut self, why: &str) {
        self.refused = true;
        self.remarks.push(format!("error: {why}"));
    }
}

/// `:line:column` of a range; empty where it has no place.
fn place(program: &Program, range: TextRange) -> String {
    if range == TextRange::default() {
        return String::new();
    }
    let (line, column) = LineIndex::new(program.source()).line_column(program.source(), range.start);
    format!(":{line}:{column}")
}

/// The block before the point where two runs differ.
fn block_range(program: &Program, difference: &trunnion_same::Difference) -> TextRange {
    difference
        .before
        .map_or_else(TextRange::default, |block| program.block(block).range())
}

/// Why a layout was rejected.
fn refusal(loaded: &Loaded, why: &Refusal) -> String {
    let name = &loaded.name;
    match why {
        Refusal::Words(range) => format!(
            "{name}: not formatted: from byte {} on the words would change",
            range.start
        ),
        Refusal::NotStable(at) => {
            format!("{name}: not formatted: at byte {at} a second run would change the layout again")
        }
        Refusal::Motions(difference) => {
            let at = place(&loaded.program, block_range(&loaded.program, difference));
            format!("{name}{at}: not formatted: {}", difference.what)
        }
    }
}

/// Writes or shows the result for a file. `Some(true)`: it changes; `None`: it was refused.
fn finish(global: &Global, command: &Fmt, outcome: &Outcome) -> Result<Option<bool>, Failure> {
    for text in &outcome.remarks {
        remark(global.quiet && !outcome.refused, text);
    }
    let changed = outcome.after != outcome.before;
    let to_stdout = command.stdout || load::is_stdin(&outcome.path) && !command.check && !command.diff;
    if command.diff {
        print_diff(&outcome.name, &outcome.before, &outcome.after)?;
    }
    if to_stdout {
        let mut out = std::io::stdout().lock();
        out.write_all(&outcome.after)?;
        out.flush()?;
    } else if changed && command.check {
        if !command.diff {
            Out::standard().text(&format!("{}\n", outcome.name));
        }
    } else if changed && !command.diff {
        load::replace(&outcome.path, outcome.seen.as_ref(), &outcome.before, &outcome.after)?;
    }
    Ok((!outcome.refused).then_some(changed))
}
