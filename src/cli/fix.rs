//! `fix`: proposes rewrites, has them proved, applies them.
use super::{
    Done,
    args::{Fix, Global},
    failure::{Failure, remark, shown},
    load::{self, Loaded},
};
use crate::cli::out::Out;
use similar::TextDiff;
use std::{io::IsTerminal, path::PathBuf};
use trunnion_certify::Certificate;
use trunnion_certify::postures::PostureCost;
use trunnion_rewrite::{Attempt, Options, Rewrite, attempt, rewrite, rewrites};

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

/// The result of all rewrites together.
struct Outcome {
    after: Vec<u8>,
    applied: Vec<(&'static str, Certificate)>,
    refused: bool,
}

/// Runs `fix`. A refused rewrite makes the exit status 1.
pub(super) fn run(global: &Global, command: &Fix) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.file)?;
    loaded.machine_or_fail("fix")?;
    if load::is_stdin(&command.file) && command.write {
        return Err(Failure::new(
            "--write needs a file, because standard input cannot be replaced; use -o FILE",
        ));
    }
    let options = options(command)?;
    let mut outputs = loaded.outputs();
    let output = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    let mut backup = command.file.clone().into_os_string();
    backup.push(".bak");
    let backup = PathBuf::from(backup);
    let backup = command
        .backup
        .then(|| outputs.output("--backup", &backup))
        .transpose()?;
    let certificate = command.certificate.as_ref();
    let certificate = certificate
        .map(|path| outputs.output("--certificate", path))
        .transpose()?;
    if command.write {
        trunnion_files::sweep_beside(&command.file);
    }
    let chosen = choose(command, &loaded)?;
    if chosen.is_empty() {
        remark(
            global.quiet,
            &format!("{}: no reported finding can be fixed by a rewrite", loaded.name),
        );
    }
    let before = loaded.program.source().to_vec();
    let (name, seen) = (loaded.name.clone(), loaded.seen.clone());
    let outcome = apply_all(global, loaded, &chosen, &options);
    if command.certificate.is_some() && outcome.applied.len() > 1 {
        let names: Vec<_> = outcome.applied.iter().map(|(name, _)| *name).collect();
        return Err(Failure::new(format!(
            "a certificate covers one rewrite, but {} would be applied; run fix once for each with --rewrite NAME",
            names.join(", ")
        )));
    }
    if command.diff || !(command.write || command.output.is_some()) {
        print_diff(&name, &before, &outcome.after)?;
    }
    // the program first: a certificate next to an old program names the digest that does not fit
    if let Some(target) = &output {
        target.write(&outcome.after, None)?;
    } else if command.write && outcome.after != before {
        if let Some(backup) = &backup {
            backup.write(&before, None)?;
        }
        load::replace(&command.file, seen.as_ref(), &before, &outcome.after)?;
    }
    if let (Some(target), Some((_, proved))) = (&certificate, outcome.applied.first()) {
        target.write(proved.to_json().as_bytes(), None)?;
    }
    Ok(if outcome.refused { Done::Found } else { Done::Clean })
}

fn options(command: &Fix) -> Result<Options, Failure> {
    let defaults = Options::default();
    let options = Options {
        tolerance_mm: command.tolerance_mm.unwrap_or(defaults.tolerance_mm),
        tolerance_deg: command.tolerance_deg.unwrap_or(defaults.tolerance_deg),
        cost: match command.cost {
            CostOf::Travel => PostureCost::Travel,
            CostOf::Time => PostureCost::Time,
            CostOf::Deviation => PostureCost::Deviation,
        },
        ..defaults
    };
    let good = |value: f64| value.is_finite() && value > 0.0;
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
        let reported = |r: &Rewrite| report.findings().any(|d| r.cures.contains(&d.rule));
        return Ok(rewrites().iter().copied().filter(|r| reported(r)).collect());
    }
    let find = |name: &String| {
        rewrite(name).ok_or_else(|| {
            let names: Vec<&str> = rewrites().iter().map(|known| known.name).collect();
            let hint = trunnion_check::or_known(name, &names, "rewrites");
            Failure::new(format!("unknown rewrite `{name}`{hint}"))
        })
    };
    command.rewrite.iter().map(find).collect()
}

fn apply_all(global: &Global, mut loaded: Loaded, chosen: &[&'static Rewrite], options: &Options) -> Outcome {
    let mut outcome = Outcome {
        after: loaded.program.source().to_vec(),
        applied: Vec::new(),
        refused: false,
    };
    for rewrite in chosen {
        match attempt(rewrite, &loaded.program, &loaded.resolved.settings(), options) {
            Attempt::NothingToDo => {
                remark(
                    global.quiet,
                    &format!("{}: {}: nothing to do", loaded.name, rewrite.name),
                );
            }
            Attempt::Refused(reason) => {
                outcome.refused = true;
                remark(false, &format!("{}: {}: refused: {reason}", loaded.name, rewrite.name));
            }
            Attempt::Certified {
                after,
                certificate,
                summary,
                ..
            } => {
                remark(
                    global.quiet,
                    &format!("{}: {}: proved: {summary}", loaded.name, rewrite.name),
                );
                outcome.applied.push((rewrite.name, *certificate));
                loaded.program = trunnion_syntax::parse(after.clone(), loaded.resolved.dialect.lex);
                outcome.after = after;
            }
        }
    }
    outcome
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
