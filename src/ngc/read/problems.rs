//! Errors of the text of a line and of its values, in the words of the control (messages observed from `rs274`).
use crate::{Class, Error, Problem};
use trunnion_formula::{FormulaError, FormulaErrorKind as Kind};

macro_rules! problems {
    ($($name:ident $class:ident $message:literal $help:literal)*) => {
        $(pub(crate) const $name: Problem = Problem { class: Class::$class, message: $message, help: $help };)*
        /// All of them.
        #[cfg(test)]
        pub(super) const ALL: &[&Problem] = &[$(&$name),*];
    };
}

problems! {
    UNCLOSED_COMMENT Syntax "Unclosed comment found" "Close the comment with `)` on the same line."
    NESTED_COMMENT Syntax "Nested comment found" "Write the inner parentheses as brackets, or as a separate comment."
    BAD_CHARACTER Syntax "Bad character '{}' used" "Remove the character, or write it inside a comment."
    UNKNOWN_LETTER UnknownWord "Bad character '{}' used" "The control has no word with this letter here."
    SEQUENCE_NUMBER Number "Bad format unsigned integer" "Write N once, at the start of the line, with a whole number and no sign."
    EQUAL_SIGN Syntax "Equal sign missing in parameter setting" "A parameter at the start of a word is assigned: write `#1=2`."
    REPEATED RepeatedWord "Multiple {} words on one line" "Keep one of the two words."
    REPEATED_SPINDLE RepeatedWord "Multiple spindle choice ($) words on one line" "Keep one of the two words."
    NEGATIVE_F Number "Negative f word used" "F is a feed: zero or positive."
    NEGATIVE_S Number "Negative spindle speed used" "S is a speed: zero or positive; use M4 for the other direction."
    NEGATIVE_H Number "Negative h word used" "H is the number of a tool."
    NEGATIVE_L Number "Negative l word used" "L is a count or a kind: zero or positive."
    NEGATIVE_T Number "Negative tool id (tool not found)" "T is the number of a tool."
    NEGATIVE_G Number "Negative g code used" "G codes are positive."
    NEGATIVE_M Number "Negative m code used" "M codes are positive, 199 at most."
    G_RANGE UnknownCode "G-code out of range" "G codes are below 100 and have at most one decimal."
    G_UNKNOWN UnknownCode "Unknown g code used" "The control has no such code."
    G_GROUP GroupConflict "Two g codes used from same modal group" "Keep one of the two codes, or write them in two lines."
    M_RANGE UnknownCode "M-code greater than 199: M{}" "M codes end at 199."
    M_UNKNOWN UnknownCode "Unknown m code used: M{}" "The control has no such code."
    M_GROUP GroupConflict "Two m codes used from same modal group" "Keep one of the two codes, or write them in two lines."
    READ_ONLY Variable "Parameter is readonly" "The control sets this parameter itself: choose another number."
    READ_ONLY_NAME Variable "Cannot assign to read-only parameter #<{}>" "The control sets this parameter itself: choose another name."
    NOT_INTEGER Number "Non integer value for integer" "The value must be a whole number, within 0.0001."
    NOT_A_NUMBER Number "bad number format (conversion failed) parsing '{}'" "Write a number, a parameter `#`, an expression `[ ]` or a function here."
    TWO_POINTS Number "bad number format (trailing characters) parsing '{}'" "A number has one decimal point."
    NO_VALUE Number "No characters found in reading real value" "The line ends where a value is expected."
    UNCLOSED_BRACKET Expression "Unclosed expression" "Close the bracket with `]` on the same line."
    UNKNOWN_FUNCTION Expression "Unknown word {}" "No function has this name."
    NO_BRACKET Expression "Left bracket missing after unary operation name" "Write the argument of a function in `[ ]`."
    NO_SLASH Expression "Slash missing after first atan argument" "ATAN has two arguments: `ATAN[y]/[x]`."
    NO_SECOND_BRACKET Expression "Left bracket missing after slash with atan" "ATAN has two arguments: `ATAN[y]/[x]`."
    UNKNOWN_OPERATOR Expression "Unknown operation{}" "Write an operator or `]` here."
    UNCLOSED_NAME Variable "Named parameter not terminated" "Close the name with `>` on the same line."
    EXISTS_PARAMETER Expression "Expected # reading parameter" "EXISTS needs a parameter: `EXISTS[#<name>]`."
    EXISTS_CLOSE Expression "Expected ] reading bracketed parameter" "EXISTS takes one parameter and nothing else."
    PARAMETER_RANGE Variable "Parameter number out of range" "Numbered parameters are 1 to 5601."
    NOT_DEFINED Variable "Named parameter #<{}> not defined" "Set the parameter before it is read, or test it with EXISTS."
    DIVISION Expression "Attempt to divide by zero" "The divisor is zero here."
    ROOT Expression "Negative argument to sqrt" "The argument is negative here."
    ACOS Expression "Argument to acos out of range" "The argument is outside -1 to 1 here."
    ASIN Expression "Argument to asin out of range" "The argument is outside -1 to 1 here."
    LOGARITHM Expression "Zero or negative argument to ln" "The argument is not positive here."
    POWER Expression "Attempt to raise negative to non integer power" "The power of a negative number must be a whole number."
    INFINITE Expression "Calculation resulted in 'infinity'" "The result is too large."
    NO_RESULT Expression "Calculation resulted in 'not a number'" "The operation has no result (`0 MOD 0`)."
    UNREADABLE Variable "" "Only the machine knows this value."
    NOT_READABLE Variable "" "Read it before compensation is switched on, or write G40 first."
    UNDECIDED Other "" "The code comes from an unknown value, so it is not known which code it is."
}

/// Whether a name had no value.
pub(crate) fn is_not_defined(error: &Error) -> bool {
    error.problem == &NOT_DEFINED
}

/// An error of an expression as an error of the line.
#[cold]
pub(crate) fn formula(error: &FormulaError) -> Error {
    let problem = match &error.kind {
        Kind::MissingValue => &NO_VALUE,
        Kind::NotANumber { .. } => &NOT_A_NUMBER,
        Kind::TwoPoints { .. } => &TWO_POINTS,
        Kind::UnclosedBracket => &UNCLOSED_BRACKET,
        Kind::UnknownFunction(_) => &UNKNOWN_FUNCTION,
        Kind::MissingBracket => &NO_BRACKET,
        Kind::MissingSlash => &NO_SLASH,
        Kind::MissingSecondBracket => &NO_SECOND_BRACKET,
        Kind::UnknownOperator(_) => &UNKNOWN_OPERATOR,
        Kind::UnclosedName => &UNCLOSED_NAME,
        Kind::MissingParameter => &EXISTS_PARAMETER,
        Kind::MissingClose => &EXISTS_CLOSE,
        Kind::NotInteger(_) => &NOT_INTEGER,
        Kind::ParameterOutOfRange(_) => &PARAMETER_RANGE,
        Kind::NotDefined(_) => &NOT_DEFINED,
        Kind::DivisionByZero => &DIVISION,
        Kind::NegativeRoot => &ROOT,
        Kind::AcosRange => &ACOS,
        Kind::AsinRange => &ASIN,
        Kind::LogarithmRange => &LOGARITHM,
        Kind::NegativePower => &POWER,
        Kind::Infinite => &INFINITE,
        Kind::Undefined => &NO_RESULT,
        // the position under compensation: the only one with a reason
        Kind::NotReadable(_) => &NOT_READABLE,
        // Macro B's own
        Kind::MissingComma | Kind::TooDeep { .. } | Kind::NotDecimalCoded | Kind::NoTangent => &UNREADABLE,
    };
    let text = error
        .kind
        .rs274_message()
        .map_or_else(|| error.kind.to_string(), Into::into);
    Error::with(problem, error.range, text)
}
