//! A line on the terminal that says what runs and for how long, once it has taken a second.
use super::args::Global;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::{io::IsTerminal, path::Path, sync::mpsc, thread, time::Duration};

/// What ends sooner needs no line.
const PATIENCE: Duration = Duration::from_secs(1);

/// Does the work, and says so on standard error if that is a terminal and the work takes long: `checking part.mpf, 12 s`. The line is gone before
/// this returns.
pub(super) fn during<T>(global: &Global, doing: &str, file: &Path, work: impl FnOnce() -> T) -> T {
    if global.quiet || !std::io::stderr().is_terminal() {
        return work();
    }
    let message = format!("{doing} {}", super::failure::shown(&file.display().to_string()));
    with_line(PATIENCE, || line(message), work)
}

/// The same for work that writes to standard output meanwhile: where both are a terminal, the output itself shows that it goes on.
pub(super) fn beside_output<T>(global: &Global, doing: &str, file: &Path, work: impl FnOnce() -> T) -> T {
    if std::io::stdout().is_terminal() {
        return work();
    }
    during(global, doing, file, work)
}

fn line(message: String) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message(message);
    bar
}

/// Shows the line as long as the work takes, from `patience` on.
fn with_line<T>(patience: Duration, line: impl FnOnce() -> ProgressBar + Send, work: impl FnOnce() -> T) -> T {
    let (end, ended) = mpsc::channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            if ended.recv_timeout(patience) != Err(mpsc::RecvTimeoutError::Timeout) {
                return;
            }
            let bar = line().with_elapsed(patience);
            bar.enable_steady_tick(Duration::from_millis(200));
            // the sender sends nothing: it goes away when the work is done
            let _ = ended.recv();
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
        assert_eq!(with_line(Duration::ZERO, show, wait), 7);
        assert!(bar.is_finished());
        let never = || -> ProgressBar { panic!("a line for work that is done") };
        assert_eq!(with_line(Duration::from_hours(1), never, || 8), 8);
    }
}
