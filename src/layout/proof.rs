//! The proof that two texts do exactly the same: `trunnion_same` decides, and it does not know how the second text was made.
use trunnion_dialect::Dialect;
use trunnion_interp::{Limits, Setup};
use trunnion_same::{Claim, Difference, Exact, Input, Near, Steps, Verdict, compare};
use trunnion_syntax::Program;

/// The first difference between two runs; `None` where there is none. `renumbered`: block numbers, and texts that name them, may differ.
pub fn first_difference(
    before: &Program,
    after: &Program,
    dialect: &Dialect,
    setup: &Setup,
    renumbered: bool,
) -> Option<Difference> {
    let mut setup = setup.clone();
    let steps = setup.limits.steps;
    // both runs stop after the same block, however long its text has become: as if all blocks were as long as the longest
    let longest = before.blocks().map(|block| block.range().as_usize().len() as u64).max();
    let share = longest.unwrap_or(0).div_ceil(Limits::BYTES_PER_BLOCK).max(1);
    let most_blocks = (steps / share).saturating_add(before.block_count() as u64);
    // what is refused or not modelled takes long to compare
    let most_actions = steps.max(before.block_count() as u64);
    // the interpreters have a larger bound, which includes the blocks of the text
    setup.limits.blocks = steps.saturating_add(before.block_count() as u64).saturating_mul(4);
    setup.limits.steps = setup.limits.blocks;
    let input = |program| Input {
        program,
        dialect,
        setup: &setup,
        machine: None,
    };
    let claim = Claim {
        exact: Some(Exact {
            frees_block_numbers: renumbered,
            most_blocks,
            most_actions,
        }),
        ..Claim::STRICT
    };
    let [mut old, mut new] = [Steps::new(input(before)), Steps::new(input(after))];
    let mut near = Near { mm: 0.0, deg: 0.0 };
    match compare(&mut old, &mut new, &claim, &mut near) {
        Verdict::Same => None,
        Verdict::Differs(difference) | Verdict::Unknown(difference) => Some(difference),
    }
}
