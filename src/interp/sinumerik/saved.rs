//! SAVE of a PROC: when the subprogram returns, the modal G functions and the programmable frame are those of its call. F, S, tools,
//! transformations and the frames of swivelled planes stay as the subprogram leaves them.
//!
//! Sources: SINUMERIK, Basic Machine, Function Manual, 08/2005, p. 2-108, and Basic Functions, 09/2011, p. 793 (subprograms with SAVE): the
//! programmable frame and the G function of the settable frame are those of the call; a settable frame whose values the subprogram has
//! changed under the same G function is a matter of machine data 10617; system frames stay.
use super::{Groups, Spline, SplineEnds};
use crate::diameter::XWords;
use crate::effects::Settings;
use crate::frames::{FrameValue, OffsetValues, ShiftParts};
use crate::iso::Iso;
use crate::travel::Travel;
use crate::{Effect, FaultKind, FeedMode};
use std::sync::Arc;
use trunnion_dialect::{Action, CodeKind};
use trunnion_syntax::BlockId;
use trunnion_vocabulary::Coordinates;

/// What was in effect at the call.
#[derive(Clone, Debug)]
pub(crate) struct Saved {
    /// Something was in effect that is not followed.
    is_lost: bool,
    modes: Modes,
    compensation: u8,
    zero: (Option<Arc<str>>, [f64; 9], u16),
    frame: FrameValue,
    parts: ShiftParts,
    /// The shift of the axes beside X Y Z.
    beside: [f64; 6],
    settings: Settings,
}

/// G functions that a number or a word of the state holds.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Modes {
    motion: Option<Action>,
    spline: Option<Spline>,
    coordinates: Coordinates,
    feed: (FeedMode, f64),
    surface_speed: bool,
    travel: Travel,
    great_circle: Option<bool>,
    euler: bool,
    feed_profile: bool,
    feed_mode_unread: bool,
    x_words: XWords,
    spline_ends: SplineEnds,
    groups: Groups,
}

impl Iso<'_> {
    /// What SAVE keeps.
    pub(super) fn saved(&self) -> Box<Saved> {
        let (core, frames) = (&self.core, &self.memory.frames);
        let zero = &core.state.zero;
        let mut beside = [0.0; 6];
        beside.copy_from_slice(&frames.local[3..]);
        Box::new(Saved {
            is_lost: core.unknown.any() || frames.pending.is_some(),
            modes: self.modes(),
            compensation: core.state.compensation,
            zero: (zero.offset_name(), frames.selected, zero.undeclared()),
            frame: self.programmable(),
            parts: frames.parts,
            beside,
            settings: core.effects.settings().clone(),
        })
    }

    fn modes(&self) -> Modes {
        let (state, own) = (&self.core.state, &self.memory.own);
        Modes {
            motion: state.motion,
            spline: own.splines.kind,
            coordinates: state.coordinates,
            feed: (state.feed.mode(), state.feed.unit_mm()),
            surface_speed: state.spindle.surface_speed(),
            travel: self.memory.travel,
            great_circle: state.tool_axis.great_circle(),
            euler: own.contour.euler,
            feed_profile: self.core.feed_profile,
            feed_mode_unread: self.core.feed_mode_unread,
            x_words: self.memory.x_words,
            spline_ends: own.splines.ends,
            groups: own.groups,
        }
    }

    /// At the return: what was in effect is in effect again. A fault where that is not known.
    pub(crate) fn bring_back(&mut self, saved: &Saved, block: BlockId) -> Option<FaultKind> {
        if let Some(open) = self.not_brought_back(saved) {
            self.core.forget_everything();
            let what = format!("SAVE: {open}");
            return Some(FaultKind::NotModelled { what });
        }
        let Modes { feed, .. } = saved.modes;
        let other_feed = self.core.state.feed.mode() != feed.0;
        self.bring_modes_back(&saved.modes);
        self.settings_come_back(saved, block);
        other_feed.then(|| {
            self.core.state.feed.set(None);
            self.core.feed_unread = true;
            let what = "SAVE: F after the return, where the subprogram has changed what F means; write F".to_owned();
            FaultKind::NotModelled { what }
        })
    }

    /// Why it is not known what comes back; the zero point and the frame are back where it is.
    fn not_brought_back(&mut self, saved: &Saved) -> Option<&'static str> {
        let (core, frames) = (&self.core, &self.memory.frames);
        if saved.is_lost || core.unknown.any() || frames.pending.is_some() {
            return Some("what comes back at the return, with a code in effect that is not followed");
        }
        if core.state.compensation != saved.compensation {
            return Some("cutter radius compensation that comes back at the return");
        }
        let zero = &core.state.zero;
        let (name, values, undeclared) = &saved.zero;
        let same_name = zero.offset() == name.as_deref();
        if same_name && (frames.selected, zero.undeclared()) != (*values, *undeclared) {
            return Some("machine data 10617 decides whether new values of the work offset stay after the return");
        }
        if frames.local[3..] != saved.beside {
            return Some("a programmed shift of further axes that comes back at the return");
        }
        if !same_name {
            let values = OffsetValues {
                values: *values,
                known: !undeclared,
            };
            self.set_zero(name.clone(), values);
        }
        let (mut followed, parts) = (true, saved.parts);
        if self.programmable() != saved.frame {
            let frame = saved.frame;
            self.frames_move(|iso| followed = iso.set_programmable(frame).is_some());
        }
        self.memory.frames.parts = parts;
        (!followed).then_some("the programmable frame that comes back at the return")
    }

    fn bring_modes_back(&mut self, modes: &Modes) {
        if self.modes() == *modes {
            return;
        }
        let (state, own) = (&mut self.core.state, &mut self.memory.own);
        own.changes += 1;
        own.splines.kind = modes.spline;
        own.splines.ends = modes.spline_ends;
        own.groups = modes.groups;
        own.contour.euler = modes.euler;
        own.contour.heading_is_lost();
        state.motion = modes.motion;
        state.coordinates = modes.coordinates;
        state.own_units(modes.coordinates.unit_mm(), modes.feed.1);
        state.feed.set_mode(modes.feed.0);
        if state.spindle.surface_speed() != modes.surface_speed {
            state.spindle.set_surface_speed(modes.surface_speed);
        }
        state.tool_axis.set_great_circle(modes.great_circle);
        self.memory.travel = modes.travel;
        self.core.feed_profile = modes.feed_profile;
        self.core.feed_mode_unread = modes.feed_mode_unread;
        self.bring_x_words_back(modes.x_words);
    }

    /// G functions that only set something, for comparisons.
    fn settings_come_back(&mut self, saved: &Saved, block: BlockId) {
        if !self.core.effects.wanted() {
            return;
        }
        let dialect = self.core.dialect;
        let is_function = |key: &str| {
            let of_group = |code: &trunnion_dialect::Code| {
                code.kind != CodeKind::M && code.group.as_deref() == Some(key) && key != "master-spindle"
            };
            key == "speed mode" || dialect.codes().iter().any(of_group)
        };
        let now = self.core.effects.settings();
        let changed = now.iter().filter(|(key, to)| {
            saved.settings.get(*key).map_or(&[][..], Vec::as_slice) != to.as_slice() && is_function(key)
        });
        let back: Vec<Effect> = changed
            .map(|(key, _)| Effect::set(key.clone(), saved.settings.get(key).cloned().unwrap_or_default()))
            .collect();
        for effect in back {
            self.core.effects.add(block, effect);
        }
    }
}
