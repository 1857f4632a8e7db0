//! Facts about what is wrong with a program's meaning. The check floor writes the messages.
use trunnion_syntax::{BlockId, TextRange};

/// The kind of mistake for which a control refuses a block; rules of the check floor select by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Refusal {
    /// The text is not a block of the language.
    Syntax,
    /// A number is malformed or out of range for its word.
    Number,
    /// An expression is malformed or has no value.
    Expression,
    /// A parameter that has no value, does not exist, or may not be written.
    Variable,
    /// An O-word or sequence number that is missing or exists twice.
    Label,
    /// A missing subprogram.
    Subprogram,
    /// Control structures that do not fit together.
    Structure,
    /// Two codes of one modal group, or codes that exclude each other.
    GroupConflict,
    /// A word occurs twice.
    RepeatedWord,
    /// A word that nothing in the block uses, or that is not allowed there.
    UnusedWord,
    /// A word is missing that a code needs.
    MissingWord,
    /// A code that the control does not know.
    UnknownCode,
    /// A letter that the control does not know.
    UnknownWord,
    /// Feed or spindle speed is missing or zero.
    Feed,
    /// An arc's radius does not fit.
    ArcRadius,
    /// An arc without centre or radius, or with both.
    ArcCentre,
    /// Cutter radius compensation is impossible or used wrongly.
    Compensation,
    /// A canned cycle is used wrongly.
    CannedCycle,
    /// The program's end is missing.
    ProgramEnd,
    /// Anything else: offsets, planes, tools, probing.
    Other,
    /// Not a mistake: the control runs it, this interpreter does not.
    NotModelled,
}

/// A wrong state of tool centre point control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TcpMistake {
    /// Rotary words in a feed motion with TCP off, after it was on in the same tool's work.
    RotaryWithout,
    /// A feed motion under TCP while no tool length is in effect.
    NoLength,
    /// The tool is changed under TCP.
    ToolChange,
    /// Machine coordinates (G53) under TCP.
    MachineCoordinates,
    /// TCP is switched on by a code that takes the number of a tool length, and the program has given none for this tool.
    NoLengthNumber,
}

/// What of the machine or the tool a program rests on and nothing declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lacks<'a> {
    /// The position of a reference point or a fixed point.
    ReferencePoint,
    /// The radius of a tool, by its number as written: `D1`.
    Radius(&'a str),
    /// The arguments of a subprogram that nothing in its file calls, by its label.
    Caller(&'a str),
    /// The meaning of a name.
    Meaning(UnknownName<'a>),
}

/// A name that is no code of the control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownName<'a> {
    /// As written, with the arguments behind it.
    pub text: &'a str,
    /// It may be a program, and none of this name was found.
    pub is_program: bool,
    /// Where it stands, if that is another file: ` in SUB.SPF, line 3`.
    pub place: &'a str,
}

const REFERENCE_LACKS: &str = ": its position is not declared";
const CALLER_LACKS: &str = ": its arguments are unknown, because nothing in this file calls it";
const NAME_LACKS: &str = ": no code of the control";
const PROGRAM_LACKS: &str = ", and no program of that name was found";
const RADIUS_OF: &str = "cutter radius compensation: the radius of ";
const RADIUS_LACKS: &str = " is not declared; the programmed path is used instead";

impl FaultKind {
    /// Nothing declares the position of a reference point.
    pub fn reference_lacks(number: u32) -> Self {
        let what = format!("reference point {number}{REFERENCE_LACKS}");
        Self::NotModelled { what }
    }

    /// Nothing declares the position of a fixed point (G75 of a Sinumerik).
    pub fn fixed_point_lacks(number: u32) -> Self {
        let what = format!("fixed point {number}{REFERENCE_LACKS}");
        Self::NotModelled { what }
    }

    /// Nothing declares the radius of a tool that compensation needs; `number`: as written, `D1`.
    pub fn radius_lacks(number: &str) -> Self {
        let what = format!("{RADIUS_OF}{number}{RADIUS_LACKS}");
        Self::NotModelled { what }
    }

    /// A subprogram was run without a call; `label`: `o<slot>`.
    pub fn caller_lacks(label: &str) -> Self {
        let what = format!("{label}{CALLER_LACKS}");
        Self::NotModelled { what }
    }

    /// A name that is no code of the control; `is_program`: it may be a program, and none was found.
    pub fn name_lacks(text: &str, is_program: bool) -> Self {
        let program = if is_program { PROGRAM_LACKS } else { "" };
        let what = format!("{text}{NAME_LACKS}{program}");
        Self::NotModelled { what }
    }

    /// What is not declared, where that is why something is not modelled.
    pub fn lacks(&self) -> Option<Lacks<'_>> {
        let Self::NotModelled { what } = self else { return None };
        if what.ends_with(REFERENCE_LACKS) {
            return Some(Lacks::ReferencePoint);
        }
        if let Some(label) = what.strip_suffix(CALLER_LACKS) {
            return Some(Lacks::Caller(label));
        }
        if let Some((text, rest)) = what.split_once(NAME_LACKS) {
            let place = rest.strip_prefix(PROGRAM_LACKS);
            return Some(Lacks::Meaning(UnknownName {
                text,
                is_program: place.is_some(),
                place: place.unwrap_or(rest),
            }));
        }
        what.strip_prefix(RADIUS_OF)?
            .strip_suffix(RADIUS_LACKS)
            .map(Lacks::Radius)
    }
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum FaultKind {
    /// Tool centre point control is in the wrong state.
    TcpState(TcpMistake),
    /// The control refuses the block, or would.
    Rejected {
        /// Why, by kind: rules select by it.
        refusal: Refusal,
        /// A sentence for people: what is wrong and what to do, with numbers and units.
        message: String,
        /// The control's own alarm number or message, where known.
        alarm: Option<String>,
    },
    /// A loop or chain of calls did not end within the bounds of the run, or never will. Range: the line that opens the loop.
    EndlessLoop {
        /// Executed blocks when it was stopped: more than the bound where nothing is proved.
        blocks: u64,
        /// It is proved to be endless: a pass changed nothing on which the next one depends.
        proved: bool,
    },
    /// A called program was not found.
    MissingSubprogram {
        /// As written.
        name: String,
        /// Folders that were searched.
        searched: Vec<crate::Searched>,
        /// The control's own sentence, where it has one.
        alarm: Option<String>,
        /// File and line of the call, where that is not the main program.
        caller: Option<String>,
    },
    /// A condition, jump or call whose outcome depends on something unknown: what runs after it is not followed.
    NotDecided {
        /// What is unknown, e.g. `#5061 (result of probing)`.
        what: String,
    },
    /// The program stops itself here with an alarm (`#3000=1(TEXT)`, `(ABORT,TEXT)`, SETAL), where the run proves that
    /// it is reached.
    ProgramAlarm {
        /// Its text.
        message: String,
    },
    /// The dialect knows no such code. Text as written is at the range. `machine_builder`: an M code a builder may own.
    UnknownCode {
        /// True for M codes that the control leaves to the machine builder.
        machine_builder: bool,
    },
    /// The dialect gives this letter or name no meaning.
    UnknownWord,
    /// Two codes of one modal group.
    GroupConflict {
        /// The group's name.
        group: String,
        /// The first code.
        first: String,
        /// The second code (at the range).
        second: String,
        /// Range of the first.
        first_range: TextRange,
    },
    /// A word is given twice.
    RepeatedWord,
    /// No code of the block and none in effect reads the word at the range; the control skips it.
    UnusedWord,
    /// A feed motion while no feed is known (or F0; or G93 without F in the block).
    MissingFeed {
        /// True under G93, where each block needs its own F.
        inverse_time: bool,
        /// True if F is programmed but zero or negative.
        zero: bool,
    },
    /// Start and end of an arc lie at different distances from the centre.
    ArcRadiusMismatch {
        /// mm.
        start: f64,
        /// mm.
        end: f64,
        /// mm, the dialect's limit.
        tolerance: f64,
    },
    /// Start and end of an arc lie at different distances from the centre, and at the same from the point that I J K give as coordinates,
    /// although they are distances here.
    ArcFitsAbsolute {
        /// From the centre as programmed, mm.
        start: f64,
        /// From the centre as programmed, mm.
        end: f64,
    },
    /// Radius form: the end is farther away than two radii.
    ArcRadiusTooSmall {
        /// Programmed, mm.
        radius: f64,
        /// Half the distance between start and end, mm.
        half_chord: f64,
    },
    /// An arc without centre and radius.
    ArcCentreMissing,
    /// The length of a tool vector is not 1 (dialects where that matters), or zero (anywhere).
    VectorNotUnit {
        /// Its length.
        norm: f64,
    },
    /// APT: the record is not known.
    AptUnknownRecord,
    /// APT: MULTAX is on and GOTO has no vector.
    AptVectorMissing,
    /// An expression, parameter, call or cycle that is not evaluated: positions it feeds are unknown.
    NotModelled {
        /// What, e.g. `G81`, `R1+2`, `CYCLE800`.
        what: String,
    },
    /// A work offset is used that is not declared: taken as zero. Reported once per offset.
    WorkOffsetUnset {
        /// `G54`.
        name: String,
    },
    /// A tool's length is not declared: taken as zero. Once per tool.
    ToolLengthUnset {
        /// Tool or offset number as written.
        tool: String,
    },
    /// A block of the program defines a tool (TOOL DEF) whose length or diameter differs from that of the settings; the program's counts.
    ToolDefinedTwice {
        /// The tool.
        tool: u32,
        /// Its diameter differs; else its length.
        is_diameter: bool,
        /// What the program says, mm.
        program_mm: f64,
        /// What the settings say, mm.
        settings_mm: f64,
    },
    /// A coordinate other than zero has no decimal point, in a dialect where a parameter of the control decides what that means.
    /// It is read as mm (or inch, degrees) as written. Range: the word.
    AmbiguousDecimal,
    /// The program has no end code.
    MissingProgramEnd,
    /// Cutter compensation is on at the end of the program.
    CompensationLeft,
}

/// One fact.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The block.
    pub block: BlockId,
    /// Where in the file.
    pub range: TextRange,
    /// What.
    pub kind: FaultKind,
    /// The line of a called program that it is about, where the kind does not say it: `SUB.SPF line 3: G1 X5`. Block and range are then those of
    /// the call.
    pub place: Option<Box<str>>,
}
