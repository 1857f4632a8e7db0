//! `fix`: proposes rewrites, has them proved, applies them.
mod report;
mod retarget;

use super::{
    Done,
    args::{Fix, Global, ListFormat},
    failure::{Failure, remark, shown},
    load::{self, Loaded},
    waiting,
};
use crate::cli::out::Out;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use report::{Outcome, Step};
use similar::TextDiff;
use std::io::IsTerminal;
use trunnion_certify::RefitSource;
use trunnion_certify::postures::PostureCost;
use trunnion_certify::{Chain, ChainStep};
use trunnion_rewrite::{
    Attempt, Known, Options, Place, ProgrammedPoint, Rewrite, attempt_at, gains, rewrite, rewrites,
};
use trunnion_syntax::{LineIndex, parse};

/// Which point of a ball X Y Z are.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum PointOf {
    /// Its tip.
    Tip,
    /// Its centre.
    Centre,
}

/// What `switch-angles` chooses postures by.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum CostOf {
    /// Travel of the rotary axes.
    Travel,
    /// Time of the slowest rotary axis.
    Time,
    /// How far the tip is off its line.
    Deviation,
}

/// What `fit-arcs` and `fit-splines` keep to.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum SourceOf {
    /// The ends of the lines.
    Points,
    /// The lines.
    Chords,
}

/// Runs `fix`. A rewrite that changes nothing because it is refused makes the exit status 1.
pub(super) fn run(global: &Global, command: &Fix) -> Result<Done, Failure> {
    let mut loaded = load::load(global, &command.file)?;
    loaded.machine_or_fail("fix")?;
    if load::is_stdin(&command.file) && command.write {
        return Err(Failure::new(
            "--write needs a file, because standard input cannot be replaced; use -o FILE",
        ));
    }
    let options = options(command, &loaded)?;
    retarget::fits(command)?;
    let mut outputs = loaded.outputs();
    command.target.files().for_each(|file| outputs.input(file));
    let shows_diff = command.diff || !(command.write || command.output.is_some());
    match command.format {
        ListFormat::Json => outputs.standard("the JSON document"),
        ListFormat::Text if shows_diff => outputs.standard("the diff"),
        ListFormat::Text => {}
    }
    let output = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    let backup = command
        .backup
        .then(|| outputs.backup("--backup", &command.file))
        .transpose()?;
    let certificate = command.certificate.as_ref();
    let certificate = certificate
        .map(|path| outputs.output("--certificate", path))
        .transpose()?;
    if command.write {
        trunnion_files::sweep_beside(&command.file);
    }
    let chosen = waiting::during(global, "checking", &command.file, || choose(command, &loaded))?;
    // the findings are those of a check; proposals and proofs are of every step
    loaded.resolved.bound_steps();
    if chosen.is_empty() && !retarget::wanted(command) {
        remark(
            global.quiet,
            &format!("{}: no reported finding can be fixed by a rewrite", loaded.name),
        );
    }
    let before = loaded.program.source().to_vec();
    let mut outcome = apply_all(global, command, &loaded, &chosen, &options);
    if retarget::wanted(command) {
        let target = command.target.choose(&loaded)?;
        let step = waiting::during(global, "retargeting", &command.file, || {
            retarget::apply(command, &loaded, &target, &outcome.after)
        })?;
        if let Some(retargeted) = &step.retargeted {
            outcome.after = retargeted.text.clone().into_bytes();
            retargeted.summary.iter().for_each(|line| remark(global.quiet, line));
        } else {
            say(global.quiet, &loaded.name, step.rewrite, &step.attempt);
        }
        outcome.steps.push(step);
    }
    match command.format {
        ListFormat::Json => report::print_json(&loaded, &outcome)?,
        ListFormat::Text => {
            report::print_gains(global.quiet, &loaded, &outcome);
            if shows_diff {
                print_diff(&loaded.name, &before, &outcome.after)?;
            }
        }
    }
    // the program first: a certificate next to an old program names the digest that does not fit
    if let Some(target) = &output {
        target.write(&outcome.after, None)?;
    } else if command.write && outcome.after != before {
        if let Some(backup) = &backup {
            backup.write(&before, None)?;
        }
        load::replace(&command.file, loaded.seen.as_ref(), &before, &outcome.after)?;
    }
    if let (Some(target), Some(json)) = (&certificate, certificates(&outcome)) {
        target.write(json.as_bytes(), None)?;
    }
    Ok(if outcome.refused() { Done::Found } else { Done::Clean })
}

/// The certificate, or the chain of several, as JSON. `None`: nothing is changed.
fn certificates(outcome: &Outcome) -> Option<String> {
    let retargeted = outcome.steps.iter().find_map(|step| step.retargeted.as_ref());
    if let Some(retargeted) = retargeted {
        return retargeted.certificate.clone();
    }
    let proved = || {
        outcome
            .steps
            .iter()
            .filter_map(|step| Some((step.rewrite, step.attempt.proved.as_ref()?)))
    };
    let (_, first) = proved().next()?;
    if proved().count() == 1 {
        return Some(first.certificate.to_json());
    }
    let steps = proved().map(|(rewrite, proved)| ChainStep::new(rewrite, &proved.edits, (*proved.certificate).clone()));
    Some(Chain::new(steps.collect()).to_json())
}

fn options(command: &Fix, loaded: &Loaded) -> Result<Options, Failure> {
    let settings = Options::of(&loaded.resolved.fix);
    let cost = command.cost.map(|cost| match cost {
        CostOf::Travel => PostureCost::Travel,
        CostOf::Time => PostureCost::Time,
        CostOf::Deviation => PostureCost::Deviation,
    });
    let options = Options {
        tolerance_mm: command.tolerance_mm.unwrap_or(settings.tolerance_mm),
        tolerance_deg: command.tolerance_deg.unwrap_or(settings.tolerance_deg),
        cost: cost.unwrap_or(settings.cost),
        given_mm: command.tolerance_mm.or(settings.given_mm),
        feed_mm_min: command.feed.unwrap_or(settings.feed_mm_min),
        source: command.source.map_or(settings.source, |source| match source {
            SourceOf::Points => RefitSource::Points,
            SourceOf::Chords => RefitSource::Chords,
        }),
        point: command.point.map_or(settings.point, |point| match point {
            PointOf::Tip => ProgrammedPoint::Tip,
            PointOf::Centre => ProgrammedPoint::Centre,
        }),
    };
    let good = |value: f64| value.is_finite() && value > 0.0;
    if command.feed.is_some_and(|feed| !good(feed)) {
        return Err(Failure::new("--feed must be a positive number, in mm/min"));
    }
    if !good(options.tolerance_mm) || !good(options.tolerance_deg) {
        return Err(Failure::new(
            "--tolerance-mm and --tolerance-deg must be positive numbers",
        ));
    }
    Ok(options)
}

/// The named rewrites, or all that fix a reported finding.
fn choose(command: &Fix, loaded: &Loaded) -> Result<Vec<&'static Rewrite>, Failure> {
    if command.rewrite.is_empty() {
        let report = trunnion_check::check(&loaded.program, &loaded.resolved.settings());
        let reported = |r: &Rewrite| report.findings().any(|d| r.may_fix(d));
        return Ok(rewrites().iter().copied().filter(|r| reported(r)).collect());
    }
    if command.rewrite.iter().any(|name| name == "all") {
        return Ok(rewrites()
            .iter()
            .copied()
            .filter(|r| r.name != retarget::NAME)
            .collect());
    }
    let find = |name: &String| {
        rewrite(name).ok_or_else(|| {
            let names: Vec<&str> = rewrites().iter().map(|known| known.name).collect();
            let hint = trunnion_check::or_known(name, &names, "rewrites");
            Failure::new(format!("unknown rewrite `{name}`{hint}"))
        })
    };
    let to_converter = |r: &&Rewrite| r.name == retarget::NAME && retarget::wanted(command);
    let found: Result<Vec<_>, _> = command.rewrite.iter().map(find).collect();
    Ok(found?.into_iter().filter(|r| !to_converter(r)).collect())
}

/// Applies one rewrite after the other, each to what the ones before it leave.
fn apply_all(
    global: &Global,
    command: &Fix,
    loaded: &Loaded,
    chosen: &[&'static Rewrite],
    options: &Options,
) -> Outcome {
    let settings = loaded.resolved.settings();
    let mut outcome = Outcome {
        after: loaded.program.source().to_vec(),
        steps: Vec::new(),
    };
    let mut program = loaded.program.clone();
    let bar = progress(global, chosen.len());
    let mut only_in_g_code = Vec::new();
    let mut known = Known::default();
    for rewrite in chosen {
        bar.set_message(rewrite.name);
        global.progress.begin();
        let index = LineIndex::new(program.source());
        let line = |at: u32| index.line_column(program.source(), at).0;
        let touches = |place: &Place| {
            let ends = (
                program.block(place.first).range().start,
                program.block(place.last).range().start,
            );
            command
                .lines
                .is_none_or(|(first, last)| line(ends.0) <= last && first <= line(ends.1))
        };
        let attempt = attempt_at(rewrite, &program, &settings, options, touches, &known);
        match rewrite.only_in_g_code(&program) {
            Some(writes) => only_in_g_code.push(format!("{} ({writes})", rewrite.name)),
            None => bar.suspend(|| say(global.quiet, &loaded.name, rewrite.name, &attempt)),
        }
        let mut gained = Vec::new();
        if let (Some(proved), Some(machine)) = (&attempt.proved, settings.machine) {
            let after = parse(proved.after.clone(), loaded.resolved.dialect.lex);
            if command.format == ListFormat::Json {
                let ends: Vec<_> = attempt.places.iter().map(|place| (place.first, place.last)).collect();
                gained = gains([&program, &after], &proved.edits, &settings, machine, &ends).1;
            }
            outcome.after.clone_from(&proved.after);
            program = after;
            known = Known::default();
        }
        outcome.steps.push(Step {
            rewrite: rewrite.name,
            attempt,
            gains: gained,
            retargeted: None,
        });
        bar.inc(1);
    }
    bar.finish_and_clear();
    if !only_in_g_code.is_empty() {
        remark(
            false,
            &format!(
                "{}: not made in Klartext, because each reads and writes G code only: {}",
                loaded.name,
                only_in_g_code.join(", ")
            ),
        );
    }
    outcome
}

/// Which rewrite is at work, on a terminal.
fn progress(global: &Global, rewrites: usize) -> ProgressBar {
    if global.quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(rewrites as u64), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{spinner} {bar:30} {pos}/{len} rewrites, {elapsed}: {msg}{share}")
    {
        bar.set_style(waiting::with_share(style, global.progress.clone()));
    }
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    bar
}

/// What became of a rewrite, for people.
fn say(quiet: bool, name: &str, rewrite: &str, attempt: &Attempt) {
    let reasons = attempt.reasons();
    match (&attempt.proved, reasons) {
        (Some(proved), None) => remark(quiet, &format!("{name}: {rewrite}: proved: {}", proved.summary)),
        (Some(proved), Some(reasons)) => remark(
            quiet,
            &format!("{name}: {rewrite}: proved: {}; not changed: {reasons}", proved.summary),
        ),
        (None, Some(reasons)) => remark(false, &format!("{name}: {rewrite}: refused: {reasons}")),
        (None, None) => remark(quiet, &format!("{name}: {rewrite}: nothing to do")),
    }
}

pub(super) fn print_diff(name: &str, before: &[u8], after: &[u8]) -> Result<(), Failure> {
    if before == after {
        return Ok(());
    }
    let diff = TextDiff::from_lines(before, after);
    let mut diff = diff.unified_diff();
    diff.context_radius(2)
        .header(&shown(&format!("a/{name}")), &shown(&format!("b/{name}")));
    let mut out = Out::standard();
    if std::io::stdout().is_terminal() {
        let mut text = Vec::new();
        diff.to_writer(&mut text)?;
        out.text(&String::from_utf8_lossy(&text));
    } else {
        // as it is: it may go to `patch`
        diff.to_writer(&mut out)?;
    }
    Ok(())
}
