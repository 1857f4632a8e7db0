//! A proof that a program never ends: it repeats without a call to the machine, and everything that it depends on is as before.
//!
//! Between two passes of a loop's condition only conditions, loops and assignments ran, so that parameters and names are everything that
//! can differ. They are compared with those of an earlier pass (Brent's method of finding a cycle: the one kept is renewed after 1024,
//! 2048, 4096... passes), which costs nothing where a loop moves the machine.
use super::labels::Place;
use crate::Engine;
use crate::parameters::Store;

/// This many passes without a call are made before the first is kept.
const FIRST: u64 = 1024;

/// Passes of loops since something was last sent to the machine.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    /// Nothing but conditions, loops and assignments ran since the last pass.
    quiet: bool,
    passes: u64,
    renew: u64,
    kept: Option<Box<Pass>>,
    /// The first line among those that open a loop that ran since that pass.
    outermost: Option<Place>,
}

/// What the run depends on at a loop's condition.
#[derive(Clone, Debug)]
struct Pass {
    place: Place,
    /// New labels make lines mean something else.
    generation: u64,
    broken: bool,
    store: Store,
}

impl Watch {
    /// Something ran that may depend on more, or change more, than parameters.
    #[inline]
    pub(super) fn stir(&mut self) {
        self.quiet = false;
    }
}

impl Engine {
    /// The outermost loop that never ends, if the run was at this condition before in the same state. `opener`: the line
    /// that opens this loop.
    pub(super) fn find_endless(&mut self, place: Place, opener: Place) -> Option<Place> {
        let flow = &mut self.flow;
        let watch = &mut flow.watch;
        if !core::mem::replace(&mut watch.quiet, true) {
            *watch = Watch {
                quiet: true,
                renew: FIRST,
                ..Watch::default()
            };
            return None;
        }
        watch.passes += 1;
        if watch.outermost.is_none_or(|first| opener.line() < first.line()) {
            watch.outermost = Some(opener);
        }
        let (generation, broken) = (flow.labels.generation, flow.broken);
        if watch.kept.as_ref().is_some_and(|kept| {
            kept.place == place
                && kept.generation == generation
                && kept.broken == broken
                && kept.store.is_same(&self.store)
        }) {
            return watch.outermost;
        }
        if watch.passes >= watch.renew {
            watch.renew *= 2;
            watch.outermost = None;
            watch.kept = Some(Box::new(Pass {
                place,
                generation,
                broken,
                store: self.store.clone(),
            }));
        }
        None
    }
}
