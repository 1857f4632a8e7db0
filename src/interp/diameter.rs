//! What X words are: radii or diameters, by G10.9 of a Fanuc lathe and by DIAMON, DIAM90 and DIAMOF of a Sinumerik.
//!
//! Sources: Fanuc Series 30i operator's manual, lathe system (G10.9); for the Sinumerik two readers of its programs, which agree: NC-PB/gEdit (diameter
//! on, off, for absolute words only) and the package sinumerik-highlight of Atom. Centres I, J, K and radii stay as they are. Not in them, and not
//! followed: X of TRANS, of a pole, of POLY, of I=AC(), of I1=, of rows of holes, of `$P_EP[X]` and the like while X words are diameters.
use crate::FaultKind;
use crate::codes::{BlockCodes, Found, not_modelled};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use trunnion_dialect::Action;

/// See the module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum XWords {
    /// As the dialect and the machine file say.
    #[default]
    AsDeclared,
    Radius,
    Diameter,
    /// Diameters; distances are radii.
    DiameterAbsolute,
}

impl XWords {
    /// What a code makes them.
    fn of(action: Action) -> Option<Self> {
        match action {
            Action::DiameterOn => Some(Self::Diameter),
            Action::DiameterAbsolute => Some(Self::DiameterAbsolute),
            Action::DiameterOff => Some(Self::Radius),
            _ => None,
        }
    }

    /// The code by which the program has set them.
    pub(crate) fn code(self) -> Option<&'static str> {
        match self {
            Self::AsDeclared => None,
            Self::Radius => Some("DIAMOF"),
            Self::Diameter => Some("DIAMON"),
            Self::DiameterAbsolute => Some("DIAM90"),
        }
    }

    /// Whether the code is one of those.
    pub(crate) fn is_set_by(action: Action) -> bool {
        Self::of(action).is_some()
    }
}

impl<'d> Iso<'d> {
    /// Whether coordinates along X are diameters; `further`: a code of the block that says so. `is_distance`: of such words.
    fn x_is_diameter(&self, further: Option<XWords>, is_distance: bool) -> bool {
        match further.unwrap_or(self.memory.x_words) {
            XWords::AsDeclared => self.core.dialect.quirks.diameter,
            XWords::Radius => false,
            XWords::Diameter => true,
            XWords::DiameterAbsolute => !is_distance,
        }
    }

    /// Whether the program has made X words diameters: what else is one is not known.
    pub(crate) fn program_sets_diameters(&self) -> bool {
        matches!(self.memory.x_words, XWords::Diameter | XWords::DiameterAbsolute) && !self.core.dialect.quirks.diameter
    }

    /// Whether U of a block is a diameter.
    pub(crate) fn distances_are_diameters(&self) -> bool {
        self.x_is_diameter(None, true)
    }

    /// G10.9 X0 and X1.
    pub(crate) fn diameter_switch(
        &mut self,
        found: &Found<'_>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        block.takes_coordinates = true;
        let x = words.axes.get(0);
        match x {
            Some(value)
                if self.core.dialect.quirks.diameter && (value == 0.0 || value == 1.0) && words.axes.given == 1 =>
            {
                self.memory.x_words = if value == 1.0 { XWords::Diameter } else { XWords::Radius };
            }
            _ => {
                not_modelled(found, report);
                self.core.unknown.for_good();
                self.core.forget_position();
            }
        }
    }

    /// DIAMON, DIAM90, DIAMOF. On a machine whose X words are no diameters the first two are not followed.
    pub(crate) fn diameter_code(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let control = &self.core.setup.control;
        let (declared, counts) = (control.axes_declared, control.x_diameter);
        let Some(to) = XWords::of(found.code.action) else {
            return;
        };
        if to != XWords::Radius && declared && !counts {
            return self.unmodelled_code(found, words, block, report);
        }
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
        if self.memory.x_words != to {
            self.memory.own.changes += 1;
        }
        self.memory.x_words = to;
        if !self.core.radii && (counts || to != XWords::Radius) {
            self.core.radii = true;
            if counts {
                // it was a diameter
                self.core.state.position.forget(0);
            }
        }
    }

    /// X words are again what they were at a call, after a subprogram with SAVE.
    pub(crate) fn bring_x_words_back(&mut self, was: XWords) {
        let by_machine = was == XWords::AsDeclared && self.core.setup.control.x_diameter && self.core.radii;
        // coordinates have become radii since, and the machine still reads diameters
        self.memory.x_words = if by_machine { XWords::Diameter } else { was };
    }

    /// X of a block as a radius.
    pub(crate) fn x_as_radius(&self, codes: &[Found<'_>], words: &mut Words, report: &mut Report<'_>) {
        let has = |action: Action| codes.iter().any(|found| found.code.action == action);
        if has(Action::Dwell) || has(Action::DiameterSwitch) {
            return;
        }
        let further = codes
            .iter()
            .filter_map(|found| XWords::of(found.code.action))
            .next_back();
        let modal = if has(Action::Incremental) || has(Action::Absolute) {
            has(Action::Incremental)
        } else {
            self.core.state.coordinates.incremental()
        };
        let said = words.axes.incremental & 1 != 0 || modal && words.axes.absolute & 1 == 0;
        if !self.x_is_diameter(further, said) {
            return;
        }
        if !self.core.dialect.quirks.diameter {
            if has(Action::ProgrammableFrame) {
                // angles, factors, and axes to mirror
                return;
            }
            open_diameters(codes, words, report);
        }
        words.axes.values[0] *= 0.5;
    }
}

/// Values of X of which no source says whether they are diameters become unknown.
fn open_diameters(codes: &[Found<'_>], words: &mut Words, report: &mut Report<'_>) {
    let data = |found: &&Found<'_>| matches!(found.code.action, Action::ProgrammableShift | Action::Pole);
    let data = codes.iter().find(data).map(|found| found.code.id.as_str());
    let axis = words.axes.get(0).is_some_and(|x| x != 0.0);
    let what = match data {
        Some(code) if axis => format!("X of {code}"),
        _ if words.polynomial && words.axes.given & 1 != 0 => "X of POLY".to_owned(),
        _ if words.centre.absolute & words.centre.given & 1 != 0 => {
            words.centre.given &= !1;
            words.centre.unread |= 1;
            report.fault(words.first.unwrap_or_default(), unknown_diameter("I=AC()"));
            return;
        }
        _ => return,
    };
    words.axes.given &= !1;
    words.axes.unread |= 1;
    report.fault(words.first.unwrap_or_default(), unknown_diameter(&what));
}

/// That no source says whether a value is a diameter.
fn unknown_diameter(what: &str) -> FaultKind {
    FaultKind::NotModelled {
        what: format!("{what} while X words are diameters: whether it is one too"),
    }
}
