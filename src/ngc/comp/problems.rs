//! Refusals of cutter compensation.
use crate::{Class, Problem};

const SMALLER_TOOL: &str = "Use a smaller tool or a wider corner.";

pub(super) const GOUGE_LINE: Problem = Problem {
    class: Class::Compensation,
    message: "Straight feed in concave corner cannot be reached by the tool without gouging",
    help: SMALLER_TOOL,
};
pub(super) const GOUGE_RAPID: Problem = Problem {
    class: Class::Compensation,
    message: "Straight traverse in concave corner cannot be reached by the tool without gouging",
    help: SMALLER_TOOL,
};
pub(super) const GOUGE_ARC: Problem = Problem {
    class: Class::Compensation,
    message: "Arc move in concave corner cannot be reached by the tool without gouging",
    help: SMALLER_TOOL,
};
pub(super) const ARC_TO_STRAIGHT: Problem = Problem {
    class: Class::Compensation,
    message: "Arc to straight motion makes a corner the compensated tool can't fit in without gouging",
    help: SMALLER_TOOL,
};
pub(super) const ARC_TO_ARC: Problem = Problem {
    class: Class::Compensation,
    message: "Arc to arc motion makes a corner the compensated tool can't fit in without gouging",
    help: SMALLER_TOOL,
};
pub(super) const ENTRY_LENGTH: Problem = Problem {
    class: Class::Compensation,
    message: "Length of cutter compensation entry move is not greater than the tool radius",
    help: "Start compensation with a straight motion in the plane that is longer than the tool radius.",
};
pub(super) const ENTRY_ARC: Problem = Problem {
    class: Class::Compensation,
    message: "Radius of cutter compensation entry arc is not greater than the tool radius",
    help: "Start compensation farther away from the contour, or with a straight motion.",
};
pub(super) const TIGHT_ARC: Problem = Problem {
    class: Class::Compensation,
    message: "Tool radius not less than arc radius with comp",
    help: "The tool does not fit into this arc: use a smaller tool or a larger arc.",
};
pub(super) const NOT_G0_G1: Problem = Problem {
    class: Class::Compensation,
    message: "Bug code not g0 or g1",
    help: "End compensation with G40 before a thread.",
};
pub(super) const MISMATCH: Problem = Problem {
    class: Class::Compensation,
    message: "BUG: cutter compensation has generated an invalid arc with mismatched radii r1 {} r2 {}",
    help: "Start compensation of a turning tool with a straight motion.",
};
