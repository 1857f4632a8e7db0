//! A plain pass over a program: run and followed on the machine, nothing judged. What rewrites are measured against.
use std::hint::black_box;
use trunnion::check::Settings;
use trunnion::interp::{Fault, ModalState, Motion, Sink, run};
use trunnion::machine::{Follower, Machine};
use trunnion::syntax::Program;

struct Follow<'m>(Follower<'m>);

impl Sink for Follow<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        black_box(self.0.follow(motion));
    }
    fn fault(&mut self, _: Fault) {}
}

/// Runs the program and follows each motion.
pub(crate) fn follow(program: &Program, settings: &Settings<'_>, machine: &Machine) {
    run(
        program,
        settings.dialect,
        &settings.setup,
        &mut Follow(Follower::new(machine)),
    );
}
