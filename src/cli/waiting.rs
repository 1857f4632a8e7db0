//! A line on the terminal that says what runs, how far it is and for how long, once it has taken a second.
use super::args::Global;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::{fmt::Write, io::IsTerminal, path::Path, sync::mpsc, thread, time::Duration};
use trunnion_interp::Progress;

/// What ends sooner needs no line.
const PATIENCE: Duration = Duration::from_secs(1);
/// The line is written anew after this time.
const TICK: Duration = Duration::from_millis(200);

/// Watched where a line is shown.
pub(super) fn progress(quiet: bool) -> Progress {
    if quiet || !std::io::stderr().is_terminal() {
        return Progress::default();
    }
    Progress::watched()
}

/// Does the work, and says so on standard error if that is a terminal and the work takes long: `checking part.mpf, 37 %, 12s`. The line is gone
/// before this returns.
pub(super) fn during<T>(global: &Global, doing: &str, file: &Path, work: impl FnOnce() -> T) -> T {
    if global.quiet || !std::io::stderr().is_terminal() {
        return work();
    }
    global.progress.begin();
    let message = format!("{doing} {}", super::failure::shown(&file.display().to_string()));
    with_line(PATIENCE, line, || said(&message, &global.progress), work)
}

/// With the share of the text that is run. Work that runs it again says so: its share begins anew.
fn said(message: &str, progress: &Progress) -> String {
    match progress.share() {
        None => message.to_owned(),
        Some((share, 1)) => format!("{message}, {share} %"),
        Some((share, run)) => format!("{message}, run {run}: {share} %"),
    }
}

/// The same for a bar that has another message: `{share}` in its template, with a comma before it.
pub(super) fn with_share(style: ProgressStyle, progress: Progress) -> ProgressStyle {
    style.with_key("share", move |_: &ProgressState, out: &mut dyn Write| {
        // a line that cannot be shown is left out
        let _ = out.write_str(&said("", &progress));
    })
}

/// The same for work that writes to standard output meanwhile: where both are a terminal, the output itself shows that it goes on.
pub(super) fn beside_output<T>(global: &Global, doing: &str, file: &Path, work: impl FnOnce() -> T) -> T {
    if std::io::stdout().is_terminal() {
        return work();
    }
    during(global, doing, file, work)
}

fn line() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
        bar.set_style(style);
    }
    bar
}

/// Shows the line as long as the work takes, from `patience` on.
fn with_line<T>(
    patience: Duration,
    line: impl FnOnce() -> ProgressBar + Send,
    said: impl Fn() -> String + Send,
    work: impl FnOnce() -> T,
) -> T {
    let (end, ended) = mpsc::channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            if ended.recv_timeout(patience) != Err(mpsc::RecvTimeoutError::Timeout) {
                return;
            }
            let bar = line().with_elapsed(patience);
            // the sender sends nothing: it goes away when the work is done
            while ended.recv_timeout(TICK) == Err(mpsc::RecvTimeoutError::Timeout) {
                bar.set_message(said());
                bar.tick();
            }
            bar.finish_and_clear();
        });
        // also where the work panics
        let _end = end;
        work()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, Ordering};

    #[test]
    fn only_long_work_shows_a_line_which_is_gone_at_its_end() {
        let bar = ProgressBar::hidden();
        let shown = AtomicBool::new(false);
        let show = || {
            shown.store(true, Ordering::SeqCst);
            bar.clone()
        };
        let wait = || {
            while !shown.load(Ordering::SeqCst) {
                thread::yield_now();
            }
            7
        };
        assert_eq!(with_line(Duration::ZERO, show, String::new, wait), 7);
        assert!(bar.is_finished());
        let never = || -> ProgressBar { panic!("a line for work that is done") };
        assert_eq!(with_line(Duration::from_hours(1), never, String::new, || 8), 8);
    }

    #[test]
    fn the_share_of_a_long_text_is_said_and_that_it_is_run_again() {
        let progress = Progress::watched();
        assert_eq!(said("checking part.mpf", &progress), "checking part.mpf");
        progress.reach(37 * 1024, 102_400);
        assert_eq!(said("checking part.mpf", &progress), "checking part.mpf, 37 %");
        progress.end();
        assert_eq!(said("checking part.mpf", &progress), "checking part.mpf");
        progress.reach(5 * 1024, 102_400);
        assert_eq!(said("", &progress), ", run 2: 5 %");
    }
}
