//! Refusals of the order of execution: messages as `rs274` prints them.
use crate::{Class, Problem};

const fn problem(class: Class, message: &'static str, help: &'static str) -> Problem {
    Problem { class, message, help }
}

pub(crate) const UNKNOWN_KEYWORD: Problem = problem(
    Class::Structure,
    "Unknown control command in o word",
    "After an O word write sub, endsub, call, return, if, elseif, else, endif, while, endwhile, do, repeat, endrepeat, break or continue.",
);
pub(crate) const NO_CONDITION_IF: Problem = problem(
    Class::Structure,
    "Left bracket missing after 'if'",
    "Write the condition in square brackets: o1 if [#1 gt 0].",
);
pub(crate) const NO_CONDITION_ELSEIF: Problem = problem(
    Class::Structure,
    "Left bracket missing after 'elseif'",
    "Write the condition in square brackets: o1 elseif [#1 gt 0].",
);
pub(crate) const NO_CONDITION_WHILE: Problem = problem(
    Class::Structure,
    "Left bracket missing after 'while'",
    "Write the condition in square brackets: o1 while [#1 gt 0].",
);
pub(crate) const NO_COUNT: Problem = problem(
    Class::Structure,
    "Left bracket missing after 'repeat'",
    "Write the count in square brackets: o1 repeat [5].",
);
pub(crate) const TOO_MANY_ARGUMENTS: Problem = problem(
    Class::Subprogram,
    "Too many subroutine parameters",
    "A call has at most 30 arguments, which become #1 to #30.",
);
pub(crate) const TAIL: Problem = problem(
    Class::Structure,
    "Unexpected character after O-word",
    "Only a comment may follow here; write arguments and return values in square brackets.",
);
pub(crate) const LABEL: Problem = problem(
    Class::Label,
    "Non integer value for integer",
    "The number of an O word must be a whole number.",
);
pub(crate) const DUPLICATE: Problem = problem(
    Class::Label,
    "duplicate O-word label",
    "Give each if, while and repeat of a program or subprogram its own number.",
);
pub(crate) const UNDEFINED: Problem = problem(
    Class::Label,
    "undefined O-word label",
    "No line before this one opens a structure with this number; check the number.",
);
pub(crate) const MISMATCH: Problem = problem(
    Class::Structure,
    "no matching label",
    "The structure that was opened with this number is of a different kind.",
);
pub(crate) const NO_LOOP: Problem = problem(
    Class::Structure,
    "no matching while/do label",
    "Give break and continue the number of the while or do loop they belong to; they do not work in repeat.",
);
pub(crate) const NOT_IN_SUB: Problem = problem(
    Class::Structure,
    "not in a subroutine definition",
    "endsub and return belong inside a called subprogram; check the number, and check the target of the call.",
);
pub(crate) const SEEKING_END: Problem = problem(
    Class::Structure,
    "Not in subroutine definition",
    "This endsub has no sub before it.",
);
pub(crate) const NESTED_SUB: Problem = problem(
    Class::Structure,
    "Nested subroutine definition",
    "End the subprogram with endsub before the next one starts.",
);
pub(crate) const REDEFINED: Problem = problem(
    Class::Subprogram,
    "redefining sub",
    "Give each subprogram its own name.",
);
pub(crate) const ILLEGAL_PLACE: Problem = problem(
    Class::Subprogram,
    "sub found in illegal location",
    "The program runs into a subprogram that was called before its definition: define it before its first call, or after the end of the program.",
);
pub(crate) const CALL_WITH_M98: Problem = problem(
    Class::Subprogram,
    "Fanuc 'O....' subroutine must be called with 'M98'",
    "Call it with M98 P..., or write the subprogram with sub and endsub.",
);
pub(crate) const CALL_WITH_CALL: Problem = problem(
    Class::Subprogram,
    "'O.... sub' subroutine must be called with 'O.... call'",
    "Call it with o... call, or write the subprogram with O... and M99.",
);
pub(crate) const END_WITH_M99: Problem = problem(
    Class::Subprogram,
    "Fanuc 'O....' subroutine definition must end with 'M99'",
    "End it with M99.",
);
pub(crate) const END_WITH_ENDSUB: Problem = problem(
    Class::Subprogram,
    "'O.... endsub' or 'O.... return' must follow 'O.... sub' subroutine definition",
    "End it with o... endsub.",
);
pub(crate) const LATE_M99: Problem = problem(
    Class::Subprogram,
    "Bug:  Reached convert_stop() from M99 as subprogram return",
    "M99 returns from a subprogram only if it is the first word of its line.",
);
pub(crate) const FANUC_CALL_OFF: Problem = problem(
    Class::Subprogram,
    "DISABLE_FANUC_STYLE_SUB set in INI file, but found m98",
    "Use o... call, or remove DISABLE_FANUC_STYLE_SUB.",
);
pub(crate) const FANUC_RETURN_OFF: Problem = problem(
    Class::Subprogram,
    "DISABLE_FANUC_STYLE_SUB set in INI file, but found m99",
    "Use o... endsub, or remove DISABLE_FANUC_STYLE_SUB.",
);
pub(crate) const FANUC_HEAD_OFF: Problem = problem(
    Class::Subprogram,
    "DISABLE_FANUC_STYLE_SUB disabled in INI file, but found bare O-word",
    "Use o... sub, or remove DISABLE_FANUC_STYLE_SUB.",
);
pub(crate) const NO_P: Problem = problem(
    Class::MissingWord,
    "Found 'm98' code with no P-word",
    "Write the number of the subprogram: M98 P100.",
);
pub(crate) const NEGATIVE_L: Problem = problem(
    Class::Number,
    "Negative l word used",
    "L is the number of times the subprogram runs.",
);
pub(crate) const TOO_DEEP: Problem = problem(
    Class::Subprogram,
    "Too many subroutine levels",
    "Subprograms are nested deeper than the control allows; often one calls itself without an end.",
);
pub(crate) const NOT_FOUND: Problem = problem(
    Class::Subprogram,
    "EOF in file seeking o-word",
    "The subprogram is neither in this file after the call nor a separate file on the searched paths.",
);
pub(crate) const NOT_FOUND_PERCENT: Problem = problem(
    Class::Subprogram,
    "Failed to find sub before EOF",
    "The program ends with % before the end of the structure, or before the subprogram that it looks for.",
);
pub(crate) const NO_END: Problem = problem(
    Class::ProgramEnd,
    "File ended with no percent sign or program end",
    "End the program with M2 or M30.",
);
pub(crate) const NO_STRUCTURE_END: Problem = problem(
    Class::Structure,
    "File ended with no percent sign or program end",
    "The line that ends the structure opened or skipped here (endif, endwhile, endrepeat, endsub) is missing.",
);
pub(crate) const NO_END_PERCENT: Problem = problem(
    Class::ProgramEnd,
    "File ended with no percent sign",
    "End a program that starts with % by M2, M30 or %.",
);
pub(crate) const TOO_LONG: Problem = problem(
    Class::Syntax,
    "Command too long",
    "A line can be at most 253 bytes long, including its line end.",
);
pub(crate) const UNSET: Problem = problem(Class::NotModelled, "", "");
pub(crate) const STRAY_PERCENT: Problem = problem(
    Class::Syntax,
    "Bad character '%' used",
    "Write % in the first and last line, or nowhere.",
);
pub(crate) const SEQUENCE_NUMBER: Problem = problem(
    Class::Number,
    "Bad format unsigned integer",
    "Write N with digits only.",
);
pub(crate) const NO_CONTEXT: Problem = problem(
    Class::Other,
    "Cannot restore context from invalid stack frame - missing M70/M73?",
    "Save the modal state with M70 or M73 first, at the same call level.",
);
