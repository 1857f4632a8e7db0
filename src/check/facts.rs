//! Facts that wake rules, one type each. A type says when it holds (`of`), and has a cheap first test that must pass before that is
//! computed (`may`): `may` is never false where the rules that the fact wakes would report something; debug builds check that.
//! A new fact is a type here and a line in `wake.rs`.
mod axes;
mod curve;
mod cut;
mod motion;
mod place;
mod pole;
mod posture;
mod travel;

pub(crate) use axes::{CableAxis, ClampedTurn, IdleTip, LongTurn, NoTravel, OverTravel};
pub(crate) use curve::{Curved, Margin};
pub(crate) use cut::{Cut, HeldBackCut, OtherLength, StrayingCut, UncertainCut, VectorCut};
pub(crate) use motion::{
    CutSpindleUnlimited, FirstApproach, FirstCut, LengthLeft, LengthOffZ, SteepHelix, UnsaidUnits,
};
pub(crate) use place::{Arrival, LostArc, LostEnd, Passing};
pub(crate) use pole::{NearPole, PoleCrossing, PolePass, first_pass};
pub(crate) use posture::{OneSidedCut, OpenPosture, PostureSwap};
pub(crate) use travel::{FarCut, WindingCut};

/// A fact about a leg, together with its view.
macro_rules! over_view {
    ($($fact:ident),*) => {$(
        impl<'v> core::ops::Deref for $fact<'v> {
            type Target = crate::view::LegView<'v>;
            fn deref(&self) -> &Self::Target {
                self.view
            }
        }
    )*};
}
use over_view;
