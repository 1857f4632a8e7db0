//! What a program requests apart from its motions: the part that no pose, feed or spindle speed of a motion holds.
//!
//! Every code and word of a block that ran is one of three things. Motions hold it (coordinates, feeds, planes, tools, offsets, calls);
//! or it is one of the requests that have a name here; or it is [`Ask::Own`]: something of this control or machine. What is not
//! recognised is `Own`, so that a new code is refused until it is classified.
use super::Ran;
use super::ask_apt::record_asks;
use super::ask_iso::Blocks;
use super::ask_klartext::sentence_asks;
use trunnion_dialect::{Dialect, PathMode};
use trunnion_interp::AllClampCodes;
use trunnion_syntax::{Address, Block, BlockId, Format, Program, TextRange, Value, Word};

/// Coolant that is switched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// On, from outside.
    Flood,
    /// On, as mist.
    Mist,
    /// On, through-spindle.
    Thru,
    /// Air on.
    Air,
    /// Through-spindle coolant off; the others stay on.
    ThruOff,
    /// All off.
    Off,
}

/// One request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ask {
    /// Coolant.
    Coolant(Coolant),
    /// The program waits for the operator; optional: only where the switch is set.
    Stop {
        /// M1.
        optional: bool,
    },
    /// What the control does at the end of each block from here on.
    Path {
        /// The mode.
        mode: PathMode,
        /// The code, as written.
        name: String,
    },
    /// The code of a clamp that the machine names, as written.
    Clamp(String),
    /// The M code with this number, whatever it means to the control (APT AUXFUN).
    Auxiliary(u32),
    /// It moves nothing and does not stop the program: texts that are shown, permissions, codes that end what never began. As written.
    Idle(String),
    /// Something of this control or machine that motions do not hold.
    Own(Own),
}

/// A request of one control or machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Own {
    /// What it is called: `G84`, `M64`, `SPOS`, `#500`, `COUPLE`.
    pub name: String,
    /// As it is written, with the words that belong to it, upper case, one blank between words.
    pub text: String,
    /// Why it cannot be carried over.
    pub why: Why,
}

/// Why a request cannot be carried over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The motion is coupled to the spindle: plain feed motions would break the tool.
    Synchronised,
    /// The spindle stops at an angle.
    Oriented,
    /// A cutting speed: the spindle's turns follow the diameter.
    SurfaceSpeed,
    /// The highest or lowest spindle speed.
    SpindleLimit,
    /// It is stored in the control and stays there after the program ends.
    Stored,
    /// How exactly and how fast the control runs along the path.
    PathControl,
    /// The program waits for the operator, or raises an alarm.
    Waits,
    /// A switch on the machine decides what runs.
    Switch,
    /// The program starts again, or returns to its caller.
    Repeats,
    /// The motions of the code are unknown well enough.
    Motion,
    /// What it does depends on the control or the machine builder.
    Machine,
}

impl Why {
    /// Whether the user may leave it out by name. What moves the tool or holds the spindle to it may not be left out.
    pub fn may_be_dropped(self) -> bool {
        !matches!(
            self,
            Self::Synchronised | Self::SurfaceSpeed | Self::Switch | Self::Motion
        )
    }
    /// A sentence about it, without its name in front.
    pub fn sentence(self) -> &'static str {
        match self {
            Self::Synchronised => {
                "couples the motion to the spindle (tapping, threading): plain feed motions would break the tool. Program \
                 it by hand for the other control"
            }
            Self::Oriented => "stops the spindle at an angle, which is not carried over",
            Self::SurfaceSpeed => {
                "is a constant cutting speed, which is not carried over: program a spindle speed (G97)"
            }
            Self::SpindleLimit => "limits the spindle speed, which is not carried over",
            Self::Stored => "stores data that stay in the control after the program ends, which is not carried over",
            Self::PathControl => "sets how exactly the control follows the path, and has no counterpart",
            Self::Waits => "waits for the operator or raises an alarm, and has no counterpart",
            Self::Switch => "depends on a switch of the machine: remove the `/` or the block",
            Self::Repeats => {
                "restarts the program or returns to its caller, but the converted program ends here: write M30"
            }
            Self::Motion => "is not carried over: its motion is not known exactly enough",
            Self::Machine => "has no counterpart: what it does depends on the machine",
        }
    }
}

/// A request and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The block.
    pub block: BlockId,
    /// Which run of a block: index into [`super::Reading::blocks`].
    pub ran: usize,
    /// Bytes of the program.
    pub range: TextRange,
    /// How many motions come before it.
    pub at: usize,
    /// What.
    pub ask: Ask,
}

/// All requests of a program in the order they ran, and the direction of the spindle after each block (counter-clockwise; `None`: not programmed).
pub(super) fn asks(
    program: &Program,
    dialect: &Dialect,
    clamps: &AllClampCodes,
    ran: &[Ran],
) -> (Vec<Asked>, Vec<Option<bool>>) {
    let mut all = Vec::new();
    let mut turns = Vec::with_capacity(ran.len());
    let mut turn = None;
    let mut before = 0;
    let mut blocks = Blocks::new(program, dialect, clamps);
    for (index, one) in ran.iter().enumerate() {
        let block = program.block(one.block);
        let found = found_in(&block, &mut blocks);
        turn = found.counter_clockwise.or(turn);
        turns.push(turn);
        for (range, mut ask) in found.asks {
            // it acts on the motion of its block, and on none without one
            if let Ask::Own(own) = &mut ask
                && own.name == "G9"
                && one.motions == before
            {
                own.text.push_str(" alone");
            }
            // these act when the motions of their block are done
            let after = matches!(ask, Ask::Stop { .. } | Ask::Coolant(Coolant::Off | Coolant::ThruOff));
            all.push(Asked {
                block: one.block,
                ran: index,
                range,
                at: if after { one.motions } else { before },
                ask,
            });
        }
        before = one.motions;
    }
    if let Some(one) = ran.last()
        && let Some(range) = runs_again(program, dialect, one.block)
    {
        all.push(Asked {
            block: one.block,
            ran: ran.len() - 1,
            range,
            at: one.motions,
            ask: Ask::Own(Own {
                name: "M99".to_owned(),
                text: "M99 at the end".to_owned(),
                why: Why::Repeats,
            }),
        });
    }
    (all, turns)
}

/// M99 as the last block that runs: the program starts again, or returns to its caller.
fn runs_again(program: &Program, dialect: &Dialect, block: BlockId) -> Option<TextRange> {
    let is_iso = program.options().format.has_words();
    let is = |word: &Word| match (word.address, word.value) {
        (Address::Letter(b'M'), Value::Number(number)) => number.to_integer() == Some(99),
        _ => false,
    };
    let found = program.block(block).words().find(|word| is_iso && is(word));
    found.filter(|_| dialect.m(990).is_some()).map(|word| word.range)
}

/// What a text requests, block by block in the order they are written: for templates.
pub fn asked_in(text: &[u8], dialect: &Dialect) -> Vec<Ask> {
    let program = trunnion_syntax::parse(text.to_vec(), dialect.lex);
    let clamps = AllClampCodes::default();
    let mut blocks = Blocks::new(&program, dialect, &clamps);
    program
        .blocks()
        .flat_map(|block| found_in(&block, &mut blocks).asks)
        .map(|(_, ask)| ask)
        .collect()
}

fn found_in(block: &Block<'_>, blocks: &mut Blocks<'_>) -> Found {
    match block.program().options().format {
        Format::Apt => record_asks(block),
        Format::Klartext => sentence_asks(block),
        Format::Iso | Format::Osp => blocks.next(block),
    }
}

/// What one block asks for.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// Requests and where they are written.
    pub asks: Vec<(TextRange, Ask)>,
    /// Direction of the spindle, if programmed: counter-clockwise.
    pub counter_clockwise: Option<bool>,
}

impl Found {
    /// Adds a request of the control's own.
    pub(super) fn own(&mut self, range: TextRange, name: impl Into<String>, text: impl Into<String>, why: Why) {
        let own = Own {
            name: name.into(),
            text: text.into(),
            why,
        };
        self.asks.push((range, Ask::Own(own)));
    }
}
