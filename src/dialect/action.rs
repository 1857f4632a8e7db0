//! The role of letters, and how tables name actions.
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use trunnion_vocabulary::Action;

/// The role of a word's letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Block number.
    BlockNumber,
    /// Program or subprogram number.
    ProgramNumber,
    /// Preparatory code.
    G,
    /// Miscellaneous code.
    M,
    /// Coordinate of an axis (the axis letter is the word's letter).
    Axis,
    /// Arc centre I, J, K (also direction vector under `TcpVectorOn`).
    ArcCentre,
    /// Arc radius R, CR=.
    ArcRadius,
    /// Further full turns of an arc, TURN=.
    ArcTurns,
    /// Component of the tool vector A3= B3= C3=.
    ToolVector,
    /// STAT=: bits that choose the posture of a point-to-point motion.
    PostureStatus,
    /// TU=: bits that choose the turn of each rotary axis in a point-to-point motion.
    PostureTurn,
    /// FP=: the number of a fixed point.
    FixedPoint,
    /// `FGREF[A]=`: the radius at which a rotary axis counts for the feed.
    FeedReference,
    /// Feed F.
    Feed,
    /// Spindle speed S.
    Speed,
    /// Tool T.
    Tool,
    /// Tool length offset number H.
    LengthOffset,
    /// Cutting edge / offset number D.
    EdgeOffset,
    /// A parameter of the code in the block (P, Q, L, ...).
    Parameter,
    /// Lathe: a distance along X (U), Z (W), Y (V) or an angle about C (H), whatever is modal.
    Increment,
    /// A variable of the program (R1=): no motion; its value is not followed.
    Variable,
    /// A word of a path that its name tells apart: polar coordinates AP= RP=, opening angle AR=, intermediate point I1=, corners CHR= RND=,
    /// angle of a line ANG=, angle of a turned frame RPL=.
    PathWord,
    /// OVR=: percent of the programmed feed.
    FeedOverride,
    /// OVRRAP=: percent of the rapid.
    RapidOverride,
    /// Recognised; it moves nothing, but its effect (posture, feed limit) is not modelled: reported once.
    NotFollowed,
    /// Recognised, but it changes the path or calls a program in a form that is not modelled (RND=, CHF=, A2=, L20).
    NotModelled,
}

/// An action as a table names it, for serde.
pub(crate) fn action<'de, D: Deserializer<'de>>(from: D) -> Result<Action, D::Error> {
    let name = String::deserialize(from)?;
    Action::named(&name).ok_or_else(|| D::Error::unknown_variant(&name, Action::NAMES))
}

/// The same where there may be none.
pub(crate) fn some_action<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Action>, D::Error> {
    action(from).map(Some)
}
