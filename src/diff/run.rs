//! A program as a stream of events that can be aligned with those of another.
use crate::event::{Body, Event, Settings, Tech};
use crate::point::Point;
use std::sync::Arc;
use trunnion_machine::Machine;
use trunnion_same::{Input, Item, Process, Step, Steps, shown};

/// Runs a program event by event.
pub(crate) struct Events<'a> {
    steps: Steps<'a>,
    machine: Option<&'a Machine>,
    /// What was in effect last, and how people read it: it changes seldom.
    last: Option<(Arc<Process>, Settings)>,
}

impl<'a> Events<'a> {
    pub(crate) fn new(input: Input<'a>) -> Self {
        Self {
            steps: Steps::new(input),
            machine: input.machine,
            last: None,
        }
    }

    /// What happens next, not yet put into words.
    pub(crate) fn next_item(&mut self) -> Option<Item> {
        self.steps.next()
    }

    /// Where a motion leads, and what is in effect in it.
    pub(crate) fn motion(&mut self, step: &Step) -> (Point, Tech) {
        let point = Point::new(&step.motion, self.machine.zip(step.leg.as_ref()));
        let settings = match &self.last {
            Some((process, settings)) if Arc::ptr_eq(process, &step.process) => Arc::clone(settings),
            _ => {
                let settings: Settings = step.process.settings().into();
                self.last = Some((Arc::clone(&step.process), Arc::clone(&settings)));
                settings
            }
        };
        (point, Tech::new(step, settings))
    }

    /// Where the run stopped before the end of its program; called when there are no more events.
    pub(crate) fn stop(&self) -> Option<&trunnion_same::Stop> {
        self.steps.stop()
    }
}

impl Iterator for Events<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        let item = self.next_item()?;
        Some(Event {
            block: item.block(),
            body: match item {
                Item::Motion(step) => {
                    let (point, tech) = self.motion(&step);
                    Body::Motion(point, tech)
                }
                Item::Happens { words, .. } => Body::Statement(shown(&words)),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::{Pair, Tolerance, compare};
    use std::sync::{
        Arc,
        atomic::{AtomicU32, Ordering},
    };
    use trunnion_interp::{Files, Library, Loaded, Searched, Setup};
    use trunnion_same::Input;

    /// Has no programs, and counts how often one is looked for: once a run, as a run remembers what is missing.
    struct Nothing(Arc<AtomicU32>);

    impl Files for Nothing {
        fn load(&self, _: &str) -> Result<Loaded, Vec<Searched>> {
            self.0.fetch_add(1, Ordering::Relaxed);
            Err(Vec::new())
        }
    }

    /// How often the two programs are run, both together, until their difference is listed.
    fn runs(before: &str, after: &str) -> u32 {
        let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
        let looked_for = Arc::new(AtomicU32::new(0));
        let setup = Setup {
            library: Library(Some(Arc::new(Nothing(Arc::clone(&looked_for))))),
            ..Setup::default()
        };
        let programs = [before, after].map(|text| trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex));
        let [before, after] = programs.each_ref().map(|program| Input {
            program,
            dialect,
            setup: &setup,
            machine: None,
        });
        let pair = Pair {
            before,
            after,
            one_setup: true,
        };
        let found = compare(&pair, Tolerance { mm: 0.001, deg: 0.001 }, false);
        assert_eq!(found.motions, [2, 2]);
        let all = looked_for.swap(0, Ordering::Relaxed);
        crate::run::Events::new(before).for_each(drop);
        all / looked_for.load(Ordering::Relaxed)
    }

    #[test]
    fn programs_that_are_the_same_are_run_once_each() {
        let text = "G21 G90 F100\nG0 X0 Y0 Z0\nG1 X1\no<missing> call\nM2\n";
        assert_eq!(runs(text, text), 2);
        // with a difference they are run again, to list it
        assert!(runs(text, &text.replace("X1", "X2")) > 2);
    }
}
