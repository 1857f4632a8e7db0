//! `fix`: proposes rewrites, has them proved, applies them.
use super::{
    Done,
    args::{Fix, Global},
    failure::{Failure, remark},
    load::{self, Loaded},
};
use similar::TextDiff;
use std::{
    fs::File,
    io::Write,
    path::{Path, PathBuf},
};
use tempfile::NamedTempFile;
use trunnion_certify::Certificate;
use trunnion_rewrite::{Attempt, Options, Rewrite, attempt, rewrite, rewrites};

/// What all rewrites together came to.
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
    let chosen = choose(command, &loaded)?;
    if chosen.is_empty() {
        remark(
            global.quiet,
            &format!("{}: no reported finding can be fixed by a rewrite", loaded.name),
        );
    }
    let before = loaded.program.source().to_vec();
    let name = loaded.name.clone();
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
    if let (Some(file), Some((_, certificate))) = (&command.certificate, outcome.applied.first()) {
        write_atomic(file, certificate.to_json().as_bytes())?;
    }
    if let Some(file) = &command.output {
        write_atomic(file, &outcome.after)?;
    } else if command.write && outcome.after != before {
        if command.backup {
            let mut backup = command.file.clone().into_os_string();
            backup.push(".bak");
            write_atomic(&PathBuf::from(backup), &before)?;
        }
        write_atomic(&command.file, &outcome.after)?;
    }
    Ok(if outcome.refused { Done::Found } else { Done::Clean })
}

fn options(command: &Fix) -> Result<Options, Failure> {
    let defaults = Options::default();
    let options = Options {
        tolerance_mm: command.tolerance_mm.unwrap_or(defaults.tolerance_mm),
        tolerance_deg: command.tolerance_deg.unwrap_or(defaults.tolerance_deg),
    };
    let good = |value: f64| value.is_finite() && value > 0.0;
    if !good(options.tolerance_mm) || !good(options.tolerance_deg) {
        return Err(Failure::new(
            "--tolerance-mm and --tolerance-deg must be positive numbers",
        ));
    }
    Ok(options)
}

/// The named rewrites, or all that cure a reported finding.
fn choose(command: &Fix, loaded: &Loaded) -> Result<Vec<&'static Rewrite>, Failure> {
    if command.rewrite.is_empty() {
        let report = trunnion_check::check(&loaded.program, &loaded.resolved.settings());
        let reported = |r: &Rewrite| report.diagnostics.iter().any(|d| r.cures.contains(&d.rule));
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
    let mut out = std::io::stdout().lock();
    diff.unified_diff()
        .context_radius(2)
        .header(&format!("a/{name}"), &format!("b/{name}"))
        .to_writer(&mut out)?;
    Ok(())
}

/// Written beside the file, flushed to disk, then renamed over it: the original survives a crash at any moment.
pub(super) fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let fail = |error: &std::io::Error| Failure::io(path, "write the file", error);
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut file = NamedTempFile::new_in(folder).map_err(|e| fail(&e))?;
    file.write_all(bytes).map_err(|e| fail(&e))?;
    keep_permissions(&target, file.as_file()).map_err(|e| fail(&e))?;
    file.as_file().sync_all().map_err(|e| fail(&e))?;
    file.persist(&target).map_err(|e| fail(&e.error))?;
    if let Ok(folder) = File::open(folder) {
        // Makes the rename itself durable; not every file system can do this, and the file is complete either way.
        let _ = folder.sync_all();
    }
    Ok(())
}

/// The permissions of the file that is replaced; a new file gets the usual ones, not the temporary file's private ones.
fn keep_permissions(target: &Path, file: &File) -> std::io::Result<()> {
    match std::fs::metadata(target) {
        Ok(old) => file.set_permissions(old.permissions()),
        Err(_) => usual_permissions(file),
    }
}

#[cfg(unix)]
fn usual_permissions(file: &File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn usual_permissions(_file: &File) -> std::io::Result<()> {
    Ok(())
}
