//! The proof that two texts do exactly the same: `trunnion_same` decides, and it does not know how the second text was made.
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_same::{Claim, Difference, Exact, Input, Near, Steps, Verdict, compare};
use trunnion_syntax::Program;

/// Blocks that a proof runs beyond those that the program has, so that loops are followed and do not take forever.
const MOST_REPEATED: u64 = 1_000_000;

/// The first difference between two runs; `None` where there is none. `renumbered`: block numbers, and texts that name them, may differ.
pub fn first_difference(
    before: &Program,
    after: &Program,
    dialect: &Dialect,
    setup: &Setup,
    renumbered: bool,
) -> Option<Difference> {
    let mut setup = setup.clone();
    let repeated = setup.limits.blocks.min(MOST_REPEATED).max(setup.limits.steps);
    let most_blocks = repeated.saturating_add(before.block_count() as u64);
    // this proof has its own bound, which includes the blocks of the text; actions other than motions have the same
    setup.limits.blocks = most_blocks.saturating_mul(2);
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
