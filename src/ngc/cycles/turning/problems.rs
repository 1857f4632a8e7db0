//! Refusals of the turning cycles.
use crate::{Class, Problem};

macro_rules! problems {
    ($($name:ident $class:ident $message:literal $help:literal)*) => {
        $(pub(super) const $name: Problem = Problem { class: Class::$class, message: $message, help: $help };)*
    };
}

problems! {
    NO_Q MissingWord "G7x.x  requires a Q word" "Add Q: the number of the subprogram that holds the contour."
    PLANE CannedCycle "G{} can only be used in XZ plane (G18)" "Write G18 before the cycle."
    COMPENSATED CannedCycle "G{} cannot be used with cutter compensation enabled" "End compensation with G40 before the cycle."
    NOT_INTEGER Number "Non integer value for integer" "Q is the number of a subprogram: a whole number."
    ZERO_I CannedCycle "G7X error: I must be greater than zero." "I is the depth of one cut."
    MONOTONIC CannedCycle "G7X error: Not monotonic"
        "The contour must not turn back: along Z for G71, along X for G72, along one of the two for G70."
    PARALLEL CannedCycle "G7X error: Cannot intersect parallel lines"
        "With an allowance (D, E) two straight blocks of a contour must not be in line: write them as one block."
    NO_CENTRE ArcCentre "G7X error: either I or K must be present for arc" "Add the centre (I, K) or the radius (R)."
    BOTH_CENTRES ArcCentre "G7X error: both R and I or K flag used for arc" "Write either the centre or the radius."
    BOTH_CORNERS CannedCycle "G7X error: Both A and C parameters on a corner" "A rounds the corner, C chamfers it: write one of them."
    BOTH_X CannedCycle "G7x error: Cannot use U and X in the same block" "Write X, or its increment U."
    BOTH_Z CannedCycle "G7x error: Cannot use W and Z in the same block" "Write Z, or its increment W."
    STEPS_U CannedCycle "G7x error: Cannot use U in incremental mode (G91)" "Write X, which is an increment under G91."
    STEPS_W CannedCycle "G7x error: Cannot use W in incremental mode (G91)" "Write Z, which is an increment under G91."
    UNKNOWN NotModelled "turning cycle with an unknown value: the path of the tool is unknown from here on"
        "This is not an error in the program. Write X and Z in the block of the cycle, or check it on the control."
    CONTOUR NotModelled "block in the contour of a turning cycle: it is not known how the control runs it"
        "This is not an error in the program. Write the contour with G0, G1, G2 and G3, or check it on the control."
    CORNER NotModelled "corner of a turning contour without enough room for its radius or chamfer"
        "Make the radius smaller, or check it on the control."
    DOUBTFUL NotModelled "rounded or chamfered corner of a turning contour next to an arc, or one that uses up half of a line across the cut: it is not known how the control runs it"
        "This is not an error in the program. Make the corner smaller, or check it on the control."
    CORNER_ALONE NotModelled "corner of a turning contour with nothing before it: the control crashes"
        "Remove A or C, or write the contour after the move to it."
    SWALLOWED NotModelled "contour of a turning cycle whose allowance is larger than the details at its ends: the path of the tool is unknown"
        "Make D smaller, or check it on the control."
    FINE NotModelled "corner of a turning contour whose radius or chamfer is shorter than 0.01 mm or inch, as programmed, along the cut: it is not known how the control runs it"
        "This is not an error in the program. Remove A or C, make it larger, or check it on the control."
    SHALLOW NotModelled "nearly straight corner of a turning contour with an allowance: it is not known how the control rounds it"
        "This is not an error in the program. Check it on the control."
    ARC_CORNER NotModelled "corner between two arcs of a turning contour with an allowance: it is not known how the control cuts it"
        "This is not an error in the program. Make the arcs tangent, or check it on the control."
    FINISH_COMPENSATED NotModelled "G70 with cutter compensation: the path of the tool is unknown"
        "This is not an error in the program. Check it on the control."
    POCKET_ARCS NotModelled "pockets of a turning contour with several arcs: it is not known where the control cuts them"
        "This is not an error in the program. Check it on the control."
    ARC NotModelled "arc of a turning contour with its deepest point inside, or with unequal radii: it is not known how the control cuts there"
        "This is not an error in the program. Split the arc at its deepest point, or check it on the control."
    BACK NotModelled "turning contour that moves back very slightly along the cut: it is not known whether the control accepts it"
        "Make sure that no block moves back along the cut, not even by a thousandth, or check it on the control."
    ENDLESS CannedCycle "turning cycle that never ends: a cut would start beyond the contour"
        "Place X and Z of the cycle outside the contour and its allowance; the control hangs here."
    MANY CannedCycle "turning cycle with more cuts than the limit on executed lines" "I is the depth of one cut: make it larger."
}
