//! The edits that people ask for: another unit, absolute or incremental words, and a path that is shifted, scaled, mirrored or turned.
//!
//! An edit changes words and nothing else. It proposes; [`trunnion_certify::certify_change`] runs both texts and compares them motion for motion.
//! What it cannot write or cannot prove is refused with the reason.
mod claim;
mod edits;
mod kinds;
mod klartext;
mod positions;
mod shape;
mod survey;
mod turn;
mod unit;

use crate::convert::wording;
use crate::refuse::Refused;
use trunnion_certify::{Apart, Change, Part, Unproved, certify_change};
use trunnion_dialect::Dialect;
use trunnion_interp::{LengthUnit, Setup};
use trunnion_syntax::{Format, Program, TextEdit, apply_edits, parse};

/// How positions are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Positions {
    /// G90.
    Absolute,
    /// G91.
    Incremental,
}

/// How the path is moved. Lengths in the unit of the program, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// By so much along X, Y and Z.
    Shift([f64; 3]),
    /// By one factor about the zero point.
    Scale(f64),
    /// The sign of one axis (0 to 2: X Y Z).
    Mirror(usize),
    /// About one axis (0 to 2: X Y Z) through the zero point, counter-clockwise as seen from its positive end.
    Rotate(usize, f64),
}

/// An edit of a whole program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edit {
    /// Lengths and feeds in another unit.
    Unit(LengthUnit),
    /// Absolute or incremental words.
    Positions(Positions),
    /// Another place, size or direction of the path.
    Shape(Shape),
}

/// An edited program, proved.
#[derive(Clone, Debug)]
pub struct Edited {
    /// The text.
    pub text: Vec<u8>,
    /// What is changed, in the order of the text.
    pub edits: Vec<TextEdit>,
    /// How near both programs are to each other.
    pub apart: Apart,
    /// What was proved, within which bounds.
    pub change: Change,
    /// What the user must know: each one sentence.
    pub notes: Vec<String>,
}

impl Edited {
    /// What was proved, in one sentence.
    pub fn summary(&self) -> String {
        let plural = |count: u64, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        format!(
            "{} changed, and proved by running both programs: {} compared; ends within {:.6} mm (allowed {:.6} mm), arcs inside and steps of drilling within {:.6} mm, \
             feeds within {:.5} %",
            plural(self.edits.len() as u64, "word"),
            plural(self.apart.motions, "motion"),
            self.apart.end_mm,
            self.change.end_mm,
            self.change.arc_mm,
            self.apart.feed_share * 100.0
        )
    }
}

/// What a proposal consists of.
struct Proposal {
    edits: Vec<TextEdit>,
    change: Change,
    notes: Vec<String>,
}

/// Edits a program. `decimals`: digits after the point of rounded lengths; by default as many as the program writes, and at least 3 in mm, 4 in
/// inch.
///
/// # Errors
/// Why it is refused, with the place.
pub fn edit(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    edit: Edit,
    decimals: Option<usize>,
) -> Result<Edited, Refused> {
    edit_part(program, dialect, setup, edit, decimals, None)
}

/// The same for some blocks; all others do what they did.
///
/// # Errors
/// Why it is refused, with the place.
pub fn edit_part(
    program: &Program,
    dialect: &Dialect,
    setup: &Setup,
    edit: Edit,
    decimals: Option<usize>,
    part: Option<Part>,
) -> Result<Edited, Refused> {
    match dialect.lex.format {
        Format::Iso | Format::Osp | Format::Klartext => {}
        Format::Apt => return Err(Refused::new("edits are for G code: change CL data in the CAM system")),
    }
    if let Some(error) = program.errors().first() {
        let message = "this text is not understood; `trunnion check` explains it";
        return Err(Refused::range(program, error.range, message));
    }
    if part.is_some() && (dialect.lex.format == Format::Klartext || matches!(edit, Edit::Unit(_))) {
        let message = if matches!(edit, Edit::Unit(_)) {
            "a program is written in one unit from its beginning to its end: write all of it in the other unit"
        } else {
            "a part of a Klartext program is not edited: edit all of it, or shift the datum (TRANS DATUM)"
        };
        return Err(Refused::new(message));
    }
    let proposal = match edit {
        _ if dialect.lex.format == Format::Klartext => klartext::propose(program, dialect, setup, edit, decimals),
        Edit::Unit(unit) => unit::propose(program, dialect, setup, unit, decimals),
        Edit::Positions(positions) => positions::propose(program, dialect, setup, positions, part),
        Edit::Shape(shape) => shape::propose(program, dialect, setup, shape, decimals, part),
    };
    match (proposal, edit) {
        (Ok(proposal), _) => prove(program, dialect, setup, proposal),
        (Err(nothing), Edit::Shape(shape)) if nothing.is_nothing => {
            stays(program, dialect, setup, shape, part)?;
            Err(nothing)
        }
        (Err(refused), _) => Err(refused),
    }
}

/// Proves that a program, or the part of it, without words to change is where the edit would put it.
fn stays(program: &Program, dialect: &Dialect, setup: &Setup, shape: Shape, part: Option<Part>) -> Result<(), Refused> {
    let mut unit_mm = 1.0;
    survey::survey(program, dialect, setup, |here| {
        unit_mm = here.is.coordinates.unit_mm();
        Ok(())
    })?;
    let proposal = Proposal {
        edits: Vec::new(),
        change: Change {
            part,
            ..claim::change(shape, DECIMALS_OF_NOTHING, unit_mm)
        },
        notes: Vec::new(),
    };
    prove(program, dialect, setup, proposal).map(|_| ())
}

/// Digits of the bound within which such a program stays.
const DECIMALS_OF_NOTHING: usize = 6;

/// Applies what is proposed, and proves it.
fn prove(program: &Program, dialect: &Dialect, setup: &Setup, proposal: Proposal) -> Result<Edited, Refused> {
    let Proposal { edits, change, notes } = proposal;
    let text = apply_edits(program.source(), &edits)
        .ok_or_else(|| Refused::new("a word would be changed in two ways: please report this program"))?;
    let after = parse(text.clone(), dialect.lex);
    match certify_change([program, &after], dialect, setup, &change) {
        Ok(apart) => Ok(Edited {
            text,
            edits,
            apart,
            change,
            notes,
        }),
        Err(Unproved::Fault { after: false, fault }) => {
            Err(Refused::range(program, fault.range, wording(program, &fault)))
        }
        Err(Unproved::Fault { after: true, fault }) => {
            let message = format!("after the edit, {}", wording(&after, &fault));
            Err(Refused::at(program, fault.block, message))
        }
        Err(Unproved::Found { differs, before, what }) => {
            let verdict = if differs {
                "it would not do the same"
            } else {
                "it cannot be proved"
            };
            let message = format!("{verdict}: {what}");
            Err(match before {
                Some(block) => Refused::at(program, block, message),
                None => Refused::new(message),
            })
        }
    }
}
