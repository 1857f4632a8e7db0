//! A program as a stream of events that can be aligned with those of another.
use crate::event::{Body, Event, Tech};
use crate::point::Point;
use trunnion_machine::Machine;
use trunnion_same::{Input, Item, Steps, shown};

/// Runs a program event by event.
pub(crate) struct Events<'a> {
    steps: Steps<'a>,
    machine: Option<&'a Machine>,
}

impl<'a> Events<'a> {
    pub(crate) fn new(input: Input<'a>) -> Self {
        Self {
            steps: Steps::new(input),
            machine: input.machine,
        }
    }

    /// Where the run stopped before the end of its program; called when there are no more events.
    pub(crate) fn stop(&self) -> Option<&trunnion_same::Stop> {
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
