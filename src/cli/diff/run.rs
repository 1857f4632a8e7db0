//! A program as a stream of events: nothing is kept but the events of the block in hand.
use super::event::{Body, Coolant, Event, Tech, coolant, says_more, statement};
use super::point::Point;
use super::unread::reads_unknown;
use crate::cli::{load::Loaded, stop::Stop, stop::Stops};
use std::collections::VecDeque;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, MotionKind, Sink};
use trunnion_machine::{Follower, Machine};

/// Runs a program event by event.
pub(super) struct Events<'a> {
    loaded: &'a Loaded,
    interpreter: Interpreter<'a>,
    block: Block<'a>,
    coolant: Coolant,
    ready: VecDeque<Event>,
}

/// What a block in hand has said.
struct Block<'a> {
    machine: Option<&'a Machine>,
    follower: Option<Follower<'a>>,
    motions: Vec<(Motion, Point, Tech)>,
    /// A fault of the block says that its words hold more than its motions.
    whole: bool,
    stops: Stops,
    dialect: &'a Dialect,
}

impl<'a> Events<'a> {
    pub(super) fn new(loaded: &'a Loaded, machine: Option<&'a Machine>) -> Self {
        Self {
            loaded,
            interpreter: Interpreter::new(loaded.resolved.dialect, &loaded.resolved.setup),
            block: Block {
                machine,
                follower: machine.map(Follower::new),
                motions: Vec::new(),
                whole: false,
                stops: Stops::default(),
                dialect: loaded.resolved.dialect,
            },
            coolant: 0,
            ready: VecDeque::new(),
        }
    }

    /// Where the run stopped before the end of its program; asked when there are no more events.
    pub(super) fn stop(&self) -> Option<&Stop> {
        self.block.stops.last()
    }

    /// Runs the next block; `false` at the end.
    fn advance(&mut self) -> bool {
        let program = &self.loaded.program;
        let Some(id) = self.interpreter.advance(program, &mut self.block) else {
            return false;
        };
        self.block.stops.block_done();
        let block = program.block(id);
        let now = coolant(&block, self.coolant);
        // M9 works at the end of its block, M7 and M8 at its start
        let during = self.coolant | now;
        self.coolant = now;
        let motions = self.block.motions.iter().map(|(motion, ..)| motion);
        let whole = std::mem::take(&mut self.block.whole) || reads_unknown(&block, &self.interpreter, motions);
        if let Some(text) = statement(&block, self.loaded.resolved.dialect, whole) {
            self.ready.push_back(Event {
                block: id,
                body: Body::Statement(text),
            });
        }
        for (motion, point, tech) in self.block.motions.drain(..) {
            self.ready.push_back(Event {
                block: motion.block,
                body: Body::Motion(point, tech.with_coolant(during)),
            });
        }
        true
    }
}

impl Iterator for Events<'_> {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        loop {
            if let Some(event) = self.ready.pop_front() {
                return Some(event);
            }
            if !self.advance() {
                // what is said at the very end, if anything
                return self.ready.pop_front();
            }
        }
    }
}

impl Sink for Block<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.as_mut().map(|follower| follower.follow(motion));
        let point = Point::new(motion, self.machine.zip(leg.as_ref()));
        // what is not known of a way stands in the words alone
        self.whole |= matches!(motion.kind, MotionKind::Arc(None) | MotionKind::Unknown);
        self.motions.push((*motion, point, Tech::new(motion, state)));
    }
    fn fault(&mut self, fault: Fault) {
        self.whole |= says_more(&fault.kind);
        self.stops.fault(&fault, self.dialect);
    }
}
