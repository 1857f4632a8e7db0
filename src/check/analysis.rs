//! One check of one program: run in the order in which the control runs it, follow, judge. Streams: apart from the program,
//! only findings and one modal state are kept.
use crate::apart;
use crate::both;
use crate::event;
use crate::pass::Pass;
use crate::suppress::{Suppressions, has_code};
use crate::unreadable::is_utf16;
use crate::view::Overview;
use crate::{Report, Settings};
use crate::{coverage, unread};
use core::ops::ControlFlow;
use trunnion_dialect::Foreign;
use trunnion_interp::{Interpreter, directives};
use trunnion_syntax::{BlockId, Program};

/// Executed blocks between two check-points, and between two questions whether to continue.
pub(crate) const CHECK_POINT_BLOCKS: u64 = 1024;

/// Observes the run of a program.
pub(crate) trait Watch {
    /// Before each 1024th executed block, with the modal state there; `Break` ends the check.
    fn pause(&mut self, executed: u64, interpreter: &Interpreter<'static>, pass: &Pass<'_>) -> ControlFlow<()>;
    /// After each block: how many ran before it, and whether it ran for the first time.
    fn ran(&mut self, executed: u64, block: BlockId, first: bool);
}

/// Nobody looks on.
struct NoObserver;

impl Watch for NoObserver {
    fn pause(&mut self, _: u64, _: &Interpreter<'static>, _: &Pass<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
    fn ran(&mut self, _: u64, _: BlockId, _: bool) {}
}

/// Checks a parsed program; a long one on two threads, where there are two.
pub fn check(program: &Program, settings: &Settings<'_>) -> Report {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    check_on(program, settings, threads)
}

/// Checks a parsed program on at most this many threads (no more than two are used). The report does not depend on their number.
pub fn check_on(program: &Program, settings: &Settings<'_>, threads: usize) -> Report {
    check_depth(program, settings, threads, Depth::Whole)
}

/// Finds what speaks against a change of a program: all errors, and all that is undecided. Warnings may be missing, findings of one event are
/// not put together, and the time is not planned; the message of a run of findings need not be that of its worst block.
pub fn check_objections(program: &Program, settings: &Settings<'_>) -> Report {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    check_depth(program, settings, threads, Depth::Objections)
}

/// How much of a report is wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Depth {
    Whole,
    /// Errors and what is undecided.
    Objections,
}

fn check_depth(program: &Program, settings: &Settings<'_>, threads: usize, depth: Depth) -> Report {
    if threads > 1 && program.block_count() >= apart::WORTH {
        check_apart(program, settings, depth)
    } else {
        judge_depth(program, settings, &mut NoObserver, depth).unwrap_or_default()
    }
}

/// The program runs on a thread of its own.
fn check_apart(program: &Program, settings: &Settings<'_>, depth: Depth) -> Report {
    let whole = with_both(program, settings, depth, |settings| {
        analyse(program, settings, depth, |interpreter, read, pass| {
            Some(apart::run(program, settings.judged_machine(), interpreter, read, pass))
        })
    });
    whole.unwrap_or_default()
}

/// Checks with every state of the switch for block delete that is possible; `watch` observes the run that runs every block. `None` if
/// it stopped the run.
pub(crate) fn judge(program: &Program, settings: &Settings<'_>, watch: &mut impl Watch) -> Option<Report> {
    judge_depth(program, settings, watch, Depth::Whole)
}

fn judge_depth(program: &Program, settings: &Settings<'_>, watch: &mut impl Watch, depth: Depth) -> Option<Report> {
    let mut first = Some(watch);
    with_both(program, settings, depth, |settings| {
        analyse(program, settings, depth, |interpreter, read, pass| {
            read(pass);
            match first.take() {
                Some(watch) => run(program, interpreter, pass, watch),
                None => run(program, interpreter, pass, &mut NoObserver),
            }
        })
    })
}

/// Checks as declared; if the state of the block delete switch is not declared, also with the switch on.
fn with_both(
    program: &Program,
    settings: &Settings<'_>,
    depth: Depth,
    mut check: impl FnMut(&Settings<'_>) -> Option<Report>,
) -> Option<Report> {
    if let Some(foreign) = settings.foreign {
        return Some(not_read(program, settings, foreign));
    }
    let mut report = check(settings)?;
    if both::is_open(program, settings) {
        let mut on = settings.clone();
        on.setup.control.block_delete = Some(true);
        both::join(&mut report, &check(&on)?);
    }
    if depth == Depth::Whole {
        event::group(program, &mut report);
    }
    report.coverage.complete(program, settings.dialect);
    report.coverage.not_judged = coverage::not_judged(settings);
    coverage::tell(program, settings, &mut report);
    unread::weigh(program, &mut report);
    report.causes_first(program);
    Some(report)
}

/// The report on a file that is not read: one finding.
fn not_read(program: &Program, settings: &Settings<'_>, foreign: Foreign) -> Report {
    let suppressions = Suppressions::default();
    let mut pass = Pass::new(program, settings, &suppressions);
    pass.report_foreign(foreign);
    pass.finish(&settings.interpreter())
}

/// Runs a program to its end; `None` if `watch` stopped it.
fn run(
    program: &Program,
    mut interpreter: Interpreter<'static>,
    pass: &mut Pass<'_>,
    watch: &mut impl Watch,
) -> Option<Interpreter<'static>> {
    for executed in 0.. {
        if executed % CHECK_POINT_BLOCKS == 0 && watch.pause(executed, &interpreter, pass).is_break() {
            return None;
        }
        let Some(block) = interpreter.advance(program, pass) else {
            break;
        };
        watch.ran(executed, block, pass.ran(block));
    }
    Some(interpreter)
}

/// What is read of a program before it runs.
pub(crate) type Read<'r> = &'r dyn Fn(&mut Pass<'_>);

/// Checks a parsed program; `run` lets the pass read what comes before a run and shows it the run, or stops.
fn analyse(
    program: &Program,
    settings: &Settings<'_>,
    depth: Depth,
    run: impl FnOnce(Interpreter<'static>, Read<'_>, &mut Pass<'_>) -> Option<Interpreter<'static>>,
) -> Option<Report> {
    let directives = directives(program);
    let suppressions = Suppressions::new(program, &directives);
    let mut pass = Pass::new(program, settings, &suppressions);
    if depth == Depth::Objections {
        pass.objections_only();
    }
    let overview = Overview {
        program,
        settings,
        directives: &directives,
    };
    let mut interpreter = settings.interpreter();
    if pass.wants_effects() {
        interpreter.watch_effects();
    }
    if is_utf16(program.source()) {
        if !pass.report_unreadable() {
            pass.read_whole(&overview);
        }
        return Some(pass.finish(&interpreter));
    }
    let read = |pass: &mut Pass<'_>| {
        pass.read_text(program);
        pass.read_whole(&overview);
        let blocks = (0..program.block_count() as u32).map(BlockId);
        pass.count_blocks(blocks.filter(|&id| has_code(program, id)).count() as u64);
    };
    let interpreter = run(interpreter, &read, &mut pass)?;
    Some(pass.finish(&interpreter))
}

#[cfg(test)]
mod tests;
