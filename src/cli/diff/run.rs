//! A program as a stream of events that can be aligned with those of another.
use super::event::{Body, Event, Tech};
use super::point::Point;
use crate::cli::load::Loaded;
use trunnion_machine::Machine;
use trunnion_same::{Input, Item, Steps, shown};

/// A loaded program as the comparison takes it.
pub(super) fn input<'a>(loaded: &'a Loaded, machine: Option<&'a Machine>) -> Input<'a> {
    Input {
        program: &loaded.program,
        dialect: loaded.resolved.dialect,
        setup: &loaded.resolved.setup,
        machine,
    }
}

/// Runs a program event by event.
pub(super) struct Events<'a> {
    steps: Steps<'a>,
    machine: Option<&'a Machine>,
}

impl<'a> Events<'a> {
    pub(super) fn new(loaded: &'a Loaded, machine: Option<&'a Machine>) -> Self {
        Self {
            steps: Steps::new(input(loaded, machine)),
            machine,
        }
    }

    /// Where the run stopped before the end of its program; asked when there are no more events.
    pub(super) fn stop(&self) -> Option<&trunnion_same::Stop> {
        self.steps.stop()
    }
}

impl Iterator for Events<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        let item = self.steps.next()?;
        Some(Event {
            block: item.block(),
            body: match item {
                Item::Motion(step) => Body::Motion(
                    Point::new(&step.motion, self.machine.zip(step.leg.as_ref())),
                    Tech::new(&step),
                ),
                Item::Happens { words, .. } => Body::Statement(shown(&words)),
            },
        })
    }
}
