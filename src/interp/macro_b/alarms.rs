//! The alarms that a Fanuc control gives for mistakes of macros and of the flow of a program: one table with sources.
//!
//! `PS0077` of a Series 30i is alarm 077 of older controls. Numbers marked as trade knowledge were not checked against a manual.
use crate::{FaultKind, Refusal};
use trunnion_dialect::{Dialect, Macros};

/// A mistake of a macro or of the flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mistake {
    /// M98 or G65 without P.
    ProgramWordMissing,
    /// Calls nested too deep.
    Nesting,
    /// A program or sequence number that does not exist.
    NumberNotFound,
    /// Arithmetic without a result: overflow.
    Overflow,
    /// Division by zero, TAN of 90 deg.
    DividedByZero,
    /// A formula that cannot be read.
    Format,
    /// No such variable.
    VariableNumber,
    /// A variable that may not be written.
    ProtectedVariable,
    /// Brackets nested too deep.
    Brackets,
    /// The argument of a function is out of range.
    FunctionRange,
    /// DO without END.
    EndMissing,
    /// A number of a loop that is not 1, 2 or 3.
    LoopNumber,
    /// Words and macro statements in one block.
    MixedBlock,
    /// GOTO to a number that is not a sequence number.
    SequenceNumber,
    /// The text ends without M99 or M30.
    EndOfRecord,
    /// A fault without a number of its own.
    Unnumbered,
}

struct Row {
    mistake: Mistake,
    refusal: Refusal,
    number: &'static str,
    /// Kept with the number for whoever checks it.
    #[expect(dead_code, reason = "documentation of the number")]
    source: &'static str,
}

const TRADE: &str = "trade knowledge, not checked against a manual";

const fn row(mistake: Mistake, refusal: Refusal, number: &'static str, source: &'static str) -> Row {
    Row {
        mistake,
        refusal,
        number,
        source,
    }
}

const ROWS: [Row; 15] = [
    row(Mistake::ProgramWordMissing, Refusal::MissingWord, "PS0076", TRADE),
    row(Mistake::Nesting, Refusal::Subprogram, "PS0077", TRADE),
    row(Mistake::NumberNotFound, Refusal::Label, "PS0078", TRADE),
    row(Mistake::Overflow, Refusal::Expression, "PS0110", TRADE),
    row(Mistake::DividedByZero, Refusal::Expression, "PS0112", TRADE),
    row(Mistake::Format, Refusal::Expression, "PS0114", TRADE),
    row(Mistake::VariableNumber, Refusal::Variable, "PS0115", TRADE),
    row(Mistake::ProtectedVariable, Refusal::Variable, "PS0116", TRADE),
    row(Mistake::Brackets, Refusal::Expression, "PS0118", TRADE),
    row(Mistake::FunctionRange, Refusal::Expression, "PS0119", TRADE),
    row(Mistake::EndMissing, Refusal::Structure, "PS0124", TRADE),
    row(Mistake::LoopNumber, Refusal::Structure, "PS0126", TRADE),
    row(Mistake::MixedBlock, Refusal::Structure, "PS0127", TRADE),
    row(Mistake::SequenceNumber, Refusal::Label, "PS0128", TRADE),
    row(Mistake::EndOfRecord, Refusal::ProgramEnd, "PS5010", TRADE),
];

/// Whether macros follow Fanuc's rules.
pub(crate) fn is_fanuc(dialect: &Dialect) -> bool {
    match dialect.quirks.macros {
        Macros::Fanuc => true,
        Macros::Generic => false,
    }
}

/// The fact that the control refuses the block. `refusal` is taken where the mistake has no number.
pub(crate) fn rejected(dialect: &Dialect, mistake: Mistake, refusal: Refusal, message: String) -> FaultKind {
    let row = ROWS.iter().find(|row| row.mistake == mistake);
    FaultKind::Rejected {
        refusal: row.map_or(refusal, |row| row.refusal),
        message,
        alarm: row.filter(|_| is_fanuc(dialect)).map(|row| row.number.to_owned()),
    }
}
