//! Cuts in which the control of the target turns to the other posture.
use crate::Options;
use crate::refuse::Refused;
use crate::setting::Setting;
use trunnion_certify::conversion::{Part, Posed, Reading};
use trunnion_machine::{Machine, POLE_TOLERANCE, rotary_turns};

/// Refuses a conversion in which the control takes another posture inside a cut, unless the user allows it.
pub(crate) fn swaps_are_allowed(
    turned: &[usize],
    reading: &Reading,
    setting: &Setting<'_>,
    options: &Options,
) -> Result<(), Refused> {
    if let Some(&index) = turned.first().filter(|_| !options.allow_swap) {
        let block = reading.motions[index].motion.block;
        let message = format!(
            "in this cut the control {} ({} such places in all): retract there, or add --allow-swap",
            if setting.vectors {
                "turns to the other posture for the vector"
            } else {
                "moves the tool axis along a great circle past the pole, where the machine cannot turn to the posture at the end"
            },
            turned.len()
        );
        return Err(Refused::at(&reading.program, block, message));
    }
    Ok(())
}

/// Original motions in whose cut a control that reads vectors turns to the other posture, as rule branch-swap measures it, or in which
/// one that moves the tool axis along a great circle would have to away from the pole, which no machine can.
pub(crate) fn control_swaps(after: &Reading, parts: &[Part], machine: Option<&Machine>, vectors: bool) -> Vec<usize> {
    let Some(machine) = machine else { return Vec::new() };
    let swaps_in = |posed: &Posed| {
        let Some(leg) = posed.leg.as_ref().filter(|_| posed.motion.is_feed()) else {
            return false;
        };
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            return false;
        };
        let torn = start.branch * end.branch < 0
            && leg.pole_angle_min > POLE_TOLERANCE
            && posed.tip_words()
            && rotary_turns(machine, leg).is_none();
        torn || vectors && leg.rotary_excess > machine.tolerances.swap_excess
    };
    let (mut swaps, mut was, mut is) = (Vec::new(), 0, 0);
    for part in parts {
        let (before, count) = match part {
            Part::Moves(count) => (1, *count as usize),
            Part::Words => (1, 1),
            Part::Left => (1, 0),
            Part::Added(count) => (0, *count as usize),
        };
        if before == 1 && after.motions[is..is + count].iter().any(swaps_in) {
            swaps.push(was);
        }
        was += before;
        is += count;
    }
    swaps
}
