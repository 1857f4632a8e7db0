//! How long each operation takes at the programmed feeds and the axes' speeds.
use trunnion_check::Settings;
use trunnion_interp::{Fault, ModalState, Motion, MotionKind, Sink};
use trunnion_machine::{Follower, block_duration_s};
use trunnion_syntax::{BlockId, Program};

/// A run of more executed blocks is not timed.
const MOST_BLOCKS: u64 = 2_000_000;

/// The time of the motions whose blocks lie from each start to the next one, s; `None` where one of them is not known. Without a machine
/// nothing is known.
pub fn operation_times(program: &Program, settings: &Settings<'_>, starts: &[BlockId]) -> Vec<Option<f64>> {
    let Some(machine) = settings.machine.filter(|_| !starts.is_empty()) else {
        return vec![None; starts.len()];
    };
    let mut timer = Timer {
        follower: Follower::new(machine),
        starts,
        times: vec![Some(0.0); starts.len()],
    };
    let mut interpreter = settings.interpreter();
    for _ in 0..MOST_BLOCKS {
        if interpreter.advance(program, &mut timer).is_none() {
            return timer.times;
        }
    }
    vec![None; starts.len()]
}

struct Timer<'t> {
    follower: Follower<'t>,
    starts: &'t [BlockId],
    times: Vec<Option<f64>>,
}

impl Sink for Timer<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        let leg = self.follower.follow(motion);
        let after = self.starts.partition_point(|start| *start <= motion.block);
        let Some(time) = after.checked_sub(1).and_then(|at| self.times.get_mut(at)) else {
            return;
        };
        let took = match motion.kind {
            MotionKind::Dwell(seconds) => seconds,
            _ if leg.start.is_none() && leg.end.is_ok() => Some(0.0),
            _ => block_duration_s(self.follower.machine(), &leg),
        };
        *time = time.zip(took).map(|(sum, took)| sum + took);
    }

    fn fault(&mut self, _fault: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}
