//! `report`: self-contained HTML pages about programs, for people who do not run commands.
mod page;
mod pages;
mod replay;
mod sheet;

use super::{
    Done,
    args::{Global, Report},
    failure::{Failure, remark},
    load::{self, Loaded},
    plot, waiting, walk,
};
use indicatif::{ProgressBar, ProgressDrawTarget};
use page::Row;
use pages::Pages;
use rayon::prelude::*;
use std::{
    io::IsTerminal,
    path::{Path, PathBuf},
};
use trunnion_check::{Report as Checked, Verdict, check};
use trunnion_files::Outputs;
use trunnion_machine::Machine;
use trunnion_plot::{Along, PlotError, Shows, axis_plane, deviation, feed, joints, path};
use trunnion_stats::Tally;

/// Files that are looked at before the first of them is written.
const AT_ONCE: usize = 8;

/// Writes the page, or the pages.
pub(super) fn run(global: &Global, command: &Report) -> Result<Done, Failure> {
    let found = walk::programs(&command.paths)?;
    found.remark(global.quiet, global.verbose);
    let mut outputs = Outputs::new();
    for file in &found.files {
        outputs.input(file);
    }
    let mut pages = Pages::new(&command.output, &found.files, &mut outputs)?;
    let mut failures: Vec<String> = Vec::new();
    for failure in &found.failures {
        failure.print();
        failures.push(format!("{}: {}", failure.place(), failure.message()));
    }
    let bar = if global.quiet || found.files.len() < 2 || !std::io::stderr().is_terminal() {
        ProgressBar::hidden()
    } else {
        ProgressBar::with_draw_target(Some(found.files.len() as u64), ProgressDrawTarget::stderr())
    };
    let mut rows: Vec<Row> = Vec::new();
    let mut denied = false;
    let files: Vec<(usize, &PathBuf)> = found.files.iter().enumerate().collect();
    for some in files.chunks(AT_ONCE) {
        let look = |&(at, file): &(usize, &PathBuf)| {
            let program = judged(global, file, found.files.len()).map(|part| part.written(at, pages.link(at)));
            bar.inc(1);
            (at, program)
        };
        let programs: Vec<_> = some.par_iter().map(look).collect();
        for (at, program) in programs {
            match program {
                Ok(program) => {
                    denied |= program.denied;
                    rows.push(pages.put(at, found.files.len(), program)?);
                }
                Err(failure) => {
                    bar.suspend(|| failure.print());
                    failures.push(format!("{}: {}", failure.place(), failure.message()));
                }
            }
        }
    }
    bar.finish_and_clear();
    if rows.is_empty() && !failures.is_empty() {
        return Err(Failure::new(
            "no program could be read (see above), so no page was written",
        ));
    }
    pages.finish(&rows, &failures)?;
    remark(global.quiet, &format!("{}: {}", command.output.display(), total(&rows)));
    if !failures.is_empty() {
        return Err(Failure::new("not every file could be checked (see above)"));
    }
    Ok(if denied { Done::Found } else { Done::Clean })
}

/// The part of one file. Several files have the bar.
fn judged(global: &Global, file: &Path, files: usize) -> Result<Part, Failure> {
    match files {
        1 => waiting::during(global, "reporting on", file, || part(global, file)),
        _ => part(global, file),
    }
}

/// How many programs, and their verdicts.
fn total(rows: &[Row]) -> String {
    let of = |verdict: Verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let programs = page::counted(rows.len());
    let in_part = |row: &&Row| row.verdict == Verdict::Pass && !row.not_looked_at.is_empty();
    let in_part = match rows.iter().filter(in_part).count() {
        0 => String::new(),
        some => format!(" ({some} looked at in part)"),
    };
    format!(
        "{programs}: {} passed{in_part}, {} unknown, {} failed",
        of(Verdict::Pass),
        of(Verdict::Unknown),
        of(Verdict::Fail)
    )
}

/// A program as a page shows it.
struct Written {
    row: Row,
    body: String,
    /// Something is found at the level of --deny.
    denied: bool,
}

/// What the page says about one program.
struct Part {
    name: String,
    verdict: Verdict,
    /// In what it was found: ` on mill-3axis`.
    judged_in: String,
    /// What it says nothing about.
    not_looked_at: Vec<String>,
    /// The line that `check` prints.
    line: String,
    /// Name and value: machine, dialect, scope, coverage.
    facts: Vec<(&'static str, String)>,
    assumptions: Vec<String>,
    /// What only pictures, replay and set-up sheet assume: the check leaves it open.
    drawn_with: Vec<String>,
    findings: Vec<page::Shown>,
    /// Title and SVG, or why there is none.
    pictures: Vec<(&'static str, Result<String, String>)>,
    replay: Option<replay::Data>,
    sheet: Vec<sheet::Table>,
    /// The program moves in inch: its pictures are in inch.
    inch: bool,
    /// Something is found at the level of --deny.
    denied: bool,
}

impl Part {
    /// As HTML: number and place of the program in the report.
    fn written(self, at: usize, link: String) -> Written {
        Written {
            body: page::program(at, &self),
            denied: self.denied,
            row: Row {
                verdict: self.verdict,
                judged_in: self.judged_in,
                name: self.name,
                not_looked_at: self.not_looked_at,
                inch: self.inch,
                link,
            },
        }
    }
}

fn part(global: &Global, file: &Path) -> Result<Part, Failure> {
    let mut loaded = load::load_any(global, file)?;
    let settings = loaded.resolved.settings();
    let scope = settings.scope();
    let report = check(&loaded.program, &settings);
    let deny = global.deny.severity();
    let verdict = report.verdict(deny);
    let judged = super::verdict::Judged {
        name: &loaded.name,
        verdict,
        summary: report.summary,
        machine: loaded.resolved.machine.as_ref().map(|m| m.id.as_str()),
        not_read: loaded.not_read(),
        read_as: None,
        scope,
        coverage: &report.coverage,
        assumptions: &report.assumptions,
        accepted: 0,
    };
    let line = super::verdict::verdict_line(&judged, false);
    let not_looked_at = super::verdict::not_looked_at(&judged);
    let judged_in = match judged.not_read {
        Some(_) => String::new(),
        None => super::verdict::judged_in(scope, judged.machine),
    };
    let denied = super::check::is_found(&report, deny, global.strict);
    let readable = loaded.not_read().is_none();
    let facts = page::facts(&loaded, &report, scope);
    let findings = page::findings(&loaded, &report);
    // the verdict is that of a check; pictures and tables are of every step
    loaded.resolved.bound_steps();
    let assumed = if readable { loaded.assumptions() } else { Vec::new() };
    let (pictures, replay) = match &loaded.resolved.machine {
        Some(machine) if readable => drawn(&loaded, machine, &report, &assumed),
        _ => (Vec::new(), None),
    };
    let tally = readable.then(|| Tally::of(loaded.input()));
    let sheet = tally.as_ref().map_or_else(Vec::new, |tally| {
        sheet::tables(&loaded, &assumed, tally, report.cycle_time_s)
    });
    let known = |text: &String| !report.assumptions.contains(text);
    let drawn_with = assumed.into_iter().filter(known).collect();
    Ok(Part {
        verdict,
        judged_in,
        not_looked_at,
        line,
        facts,
        findings,
        assumptions: report.assumptions,
        drawn_with,
        pictures,
        replay,
        sheet,
        inch: tally.is_some_and(|tally| tally.inch),
        name: loaded.name,
        denied,
    })
}

/// The pictures and the replay of a program on a machine.
#[allow(clippy::type_complexity, reason = "the fields of Part")]
fn drawn(
    loaded: &Loaded,
    machine: &Machine,
    report: &Checked,
    assumed: &[String],
) -> (Vec<(&'static str, Result<String, String>)>, Option<replay::Data>) {
    let shows = Shows {
        deviation: true,
        feed: true,
    };
    let mut record = plot::gather(loaded, machine, None, shows);
    plot::plan(loaded, machine, &mut record);
    let marks = plot::marks_of(report, loaded, None);
    let head = |title: &str| plot::header_assuming(title, loaded, machine, assumed);
    let text = |drawn: Result<String, PlotError>| drawn.map_err(|error| error.0);
    let tolerance = machine.tolerances.tip_mm;
    let mut pictures = vec![
        ("Path", text(path(&head("Path of the tool tip"), &record, tolerance))),
        (
            "Joints",
            text(joints(
                &head("Joints of the machine"),
                machine,
                &record,
                &marks,
                Along::Way,
            )),
        ),
    ];
    if machine.rotary.len() == 2 {
        let plane = axis_plane(
            &head("Tool axis seen along the pole"),
            machine,
            &record,
            &marks,
            None,
            None,
        );
        pictures.push(("Axis plane", text(plane)));
    }
    pictures.push((
        "Deviation",
        text(deviation(&head("Deviation of the tool tip"), &record, tolerance)),
    ));
    pictures.push(("Feed", text(feed(&head("Feed of the tool tip"), &record))));
    (pictures, replay::data(loaded, machine, &record, &marks))
}
