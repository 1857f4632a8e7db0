//! Work of which only the newest counts: one job at a time, and while it runs the newest job alone waits.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

type Job = Box<dyn FnOnce() + Send>;

/// See the module. A clone is the same queue.
#[derive(Clone, Default)]
pub(crate) struct Latest(Arc<Mutex<State>>);

#[derive(Default)]
struct State {
    /// A turn is spawned that ends only when nothing waits.
    runs: bool,
    /// The number of the newest job that there was.
    newest: u64,
    next: Option<Job>,
}

impl Latest {
    /// Runs `job` unless one with a higher number was there before it or comes before its turn. `spawn` starts a turn on another thread, where there
    /// is none.
    pub(crate) fn run(&self, number: u64, spawn: impl FnOnce(Job), job: impl FnOnce() + Send + 'static) {
        let mut state = self.state();
        if number < state.newest {
            return;
        }
        state.newest = number;
        let replaced = state.next.replace(Box::new(job));
        let runs = std::mem::replace(&mut state.runs, true);
        drop(state);
        // what it holds may be large
        drop(replaced);
        if !runs {
            let queue = self.clone();
            spawn(Box::new(move || queue.turn()));
        }
    }

    fn turn(&self) {
        while let Some(job) = self.next() {
            // a job that ends badly loses its own result and not those of later versions
            let _ = catch_unwind(AssertUnwindSafe(job));
        }
    }

    /// The job that waits; where there is none, the turn is over.
    fn next(&self) -> Option<Job> {
        let mut state = self.state();
        let next = state.next.take();
        state.runs = next.is_some();
        next
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::{Job, Latest};
    use std::sync::{Arc, Mutex};

    #[test]
    fn one_turn_runs_the_newest_job_alone() {
        let (queue, ran) = (Latest::default(), Arc::new(Mutex::new(Vec::new())));
        let mut turns: Vec<Job> = Vec::new();
        let start = |number: u64, again: Option<Latest>, turns: &mut Vec<Job>| {
            let ran = Arc::clone(&ran);
            let job = move || {
                ran.lock().expect("whole").push(number);
                if let Some(queue) = again {
                    // comes while this one runs: the same turn takes it
                    queue.run(
                        1001,
                        |_| unreachable!("a turn runs"),
                        move || ran.lock().expect("whole").push(1001),
                    );
                }
            };
            queue.run(number, |turn| turns.push(turn), job);
        };
        for number in 0..1000 {
            start(number, None, &mut turns);
        }
        start(5, None, &mut turns);
        assert_eq!(turns.len(), 1);
        turns.pop().expect("there")();
        assert_eq!(*ran.lock().expect("whole"), [999]);
        start(1000, Some(queue.clone()), &mut turns);
        turns.pop().expect("a new turn")();
        assert_eq!(*ran.lock().expect("whole"), [999, 1000, 1001]);
        assert!(turns.is_empty());
    }
}
