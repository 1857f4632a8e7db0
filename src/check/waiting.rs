//! Rules that wait for facts of a motion or a leg.
use crate::sink::{Active, Reporter};
use crate::wake::Wake;
use trunnion_syntax::BlockId;

/// Rules that wait for facts, and those of them that the last motion or leg may have woken: one is like the other in most programs.
#[derive(Default)]
pub(crate) struct Waiting {
    pub(crate) rules: Vec<Active>,
    /// The facts that were possible, and the rules of these facts.
    pub(crate) awake: (Option<u32>, Vec<Active>),
}

impl Waiting {
    /// The rules that may have something to say where these facts are possible.
    #[inline]
    pub(crate) fn awake(&mut self, possible: u32) -> &[Active] {
        let (of, awake) = &mut self.awake;
        if *of != Some(possible) {
            *of = Some(possible);
            awake.clear();
            awake.extend(self.rules.iter().filter(|rule| rule.wake.is_in(possible)));
        }
        awake
    }

    /// A debug build also asks the rules that were not woken, and checks that they are silent.
    pub(crate) fn assert_silent(
        &self,
        reporter: &mut Reporter<'_>,
        at: (BlockId, u64),
        ask: impl Fn(Wake, &mut Reporter<'_>),
    ) {
        if !cfg!(debug_assertions) {
            return;
        }
        let asleep = |rule: &&Active| !self.awake.0.is_some_and(|possible| rule.wake.is_in(possible));
        for rule in self.rules.iter().filter(asleep) {
            reporter.enter(rule, Some(at.0), at.1);
            ask(rule.wake, reporter);
            debug_assert!(reporter.is_silent(), "{} was not woken", rule.name);
            reporter.leave();
        }
    }
}
