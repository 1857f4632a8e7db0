//! Cycles that scale the system of coordinates: 11 by one factor about the datum, 26 by a factor for each axis about a centre.
//!
//! Cycle 11 multiplies coordinates and radii, in the working plane or along all three axes, as machine parameter 7410 says, and the dimensions in
//! cycles (TNC 410 user's manual, p. 186; the values of the parameter: TNC 407 technical manual, 6.7.4). It acts about the active datum, cycle 26 about its
//! own centre (TNC 620 340 56x-02, p. 256; TNC 128 77184x-02, p. 458). A factor of 1 ends either, that of cycle 26 for the same axis. What a scaling
//! does together with other transformations, with cycle 26 to radii that are words, and to which dimensions of a cycle, is in no source.
use super::Klartext;
use super::path_words::PathWords;
use super::reason::Reason;
use super::words::Words;
use crate::core::Report;
use crate::frames::Scaling;
use crate::{MotionKind, Position, Refusal, ScaledAxes};
use trunnion_dialect::Plane;

/// Least and greatest factor of cycle 11 (TNC 410 user's manual, p. 186).
const FACTORS: std::ops::RangeInclusive<f64> = 0.000_001..=99.999_999;
/// Bits of X, Y and Z.
const XYZ: u16 = 0b111;
/// Bits of U, V and W.
const PARALLEL: u16 = 0b1_1100_0000;

/// What both cycles have set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales {
    /// Cycle 11: its factor, and the working plane where it was defined; none: 1.
    whole: Option<(f64, Plane)>,
    /// Cycle 26: factors of X, Y and Z.
    factors: [f64; 3],
    /// Cycle 26: centres of the axes that are scaled, mm.
    centre: [f64; 3],
    /// Axes whose scaling by cycle 26 is not known.
    open: u16,
    /// The datum has changed since the system is scaled.
    moved: bool,
}

impl Default for Scales {
    fn default() -> Self {
        Self {
            whole: None,
            factors: [1.0; 3],
            centre: [0.0; 3],
            open: 0,
            moved: false,
        }
    }
}

impl Scales {
    /// Whether cycle 26 scales an axis.
    fn by_axis(&self) -> bool {
        self.factors != [1.0; 3]
    }

    /// Between the coordinates of the words and those of the workpiece; `axes`: which cycle 11 scales.
    fn scaling(&self, axes: Option<ScaledAxes>) -> Option<Scaling> {
        if self.by_axis() {
            let (centre, factors) = (self.centre, self.factors);
            return Some(Scaling { centre, factors });
        }
        let (factor, plane) = self.whole?;
        let mut factors = [factor; 3];
        if axes? == ScaledAxes::Plane {
            factors[crate::arc::plane_axes(plane)[2]] = 1.0;
        }
        let centre = [0.0; 3];
        Some(Scaling { centre, factors })
    }
}

/// The words of cycle 26, in the program's unit.
#[derive(Default)]
struct AxisFactors {
    given: u16,
    factors: [Option<f64>; 3],
    centre: [Option<f64>; 3],
    /// Words that are not read stand beside them.
    unread: bool,
}

impl Klartext<'_> {
    /// 11.1 SCL 0.99.
    pub(super) fn scaling(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        let said = words.find(|word| word.is("SCL")).map(|word| word.value);
        let plane = self.core.state.coordinates.plane();
        let declared = self.core.setup.control.scaled_axes.is_some();
        self.memory.scales.whole = None;
        match said.and_then(|said| self.said(said, report)) {
            None => Self::not_modelled("cycle 11 without a factor", report),
            Some(factor) if !FACTORS.contains(&factor) => {
                let message = "the factor of cycle 11 must be from 0.000001 to 99.999999";
                Self::rejected(Refusal::Number, message, report);
            }
            Some(factor) if factor != 1.0 && !declared => {
                let what = "cycle 11: a machine parameter decides whether the tool axis is scaled (declare [control] scaled_axes)";
                Self::not_modelled(what, report);
            }
            Some(factor) => {
                self.memory.scales.whole = (factor != 1.0).then_some((factor, plane));
                self.found(Reason::Scale);
                return self.rescale(report);
            }
        }
        self.rescale(report);
        self.lose(Reason::Scale);
    }

    /// 26.1 X1.4 Y0.6 CCX+15 CCY+20.
    pub(super) fn axis_scaling(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        let found = self.axis_factors(words, report);
        let what = self.scale_axes(&found, line, report);
        self.rescale(report);
        if let Some(what) = what {
            self.memory.unfollowed = true;
            Self::not_modelled(what, report);
        }
        if self.memory.scales.open == 0 {
            self.found(Reason::AxisScale);
        } else {
            self.lose(Reason::AxisScale);
        }
    }

    /// Takes over what cycle 26 says; what of it is not followed.
    fn scale_axes(&mut self, found: &AxisFactors, line: u32, report: &mut Report<'_>) -> Option<&'static str> {
        let unit = self.core.state.coordinates.unit_mm();
        let scales = &mut self.memory.scales;
        let before = scales.factors;
        scales.factors = [1.0; 3];
        if line != 1 || found.unread {
            scales.open = XYZ;
            return Some("cycle 26: other words than factors of X, Y and Z and their centres CCX, CCY and CCZ");
        }
        if found.given == 0 {
            scales.open = XYZ;
            let message = "cycle 26 needs the factor of an axis: X, Y or Z";
            Self::rejected(Refusal::MissingWord, message, report);
            return None;
        }
        scales.open &= !found.given;
        let mut what = None;
        for (axis, before) in before.iter().enumerate() {
            let bit = 1 << axis;
            if found.given & bit == 0 {
                // whether an axis that is left out keeps its factor
                if *before != 1.0 || scales.open & bit != 0 {
                    scales.open |= bit;
                    what = Some("cycle 26 that leaves out an axis that is scaled: whether that keeps its factor");
                }
                continue;
            }
            match (found.factors[axis], found.centre[axis]) {
                (Some(1.0), _) => {}
                (Some(factor), Some(centre)) if factor > 0.0 && factor.is_finite() => {
                    (scales.factors[axis], scales.centre[axis]) = (factor, centre * unit);
                }
                (Some(factor), None) if factor > 0.0 => {
                    scales.open |= bit;
                    what = Some(
                        "cycle 26 without the centre of a scaled axis (CCX, CCY, CCZ): about which point it is scaled",
                    );
                }
                (Some(_), _) => {
                    scales.open |= bit;
                    Self::rejected(Refusal::Number, "the factors of cycle 26 must be above 0", report);
                }
                // the missing value was reported
                (None, _) => scales.open |= bit,
            }
        }
        if scales.open != 0 {
            // nothing is scaled by half of a cycle
            let open = (0..3).filter(|axis| scales.factors[*axis] != 1.0);
            scales.open |= open.fold(0, |all, axis| all | 1 << axis);
            scales.factors = [1.0; 3];
        }
        what
    }

    fn axis_factors(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> AxisFactors {
        let mut found = AxisFactors::default();
        for word in words.by_ref() {
            let name = word.name();
            if let [letter @ b'X'..=b'Z'] = name {
                let axis = usize::from(letter - b'X');
                found.unread |= found.given & 1 << axis != 0;
                found.given |= 1 << axis;
                found.factors[axis] = self.said(word.value, report);
            } else if let [b'C', b'C', letter @ b'X'..=b'Z'] = name {
                let axis = usize::from(letter - b'X');
                found.unread |= found.centre[axis].is_some();
                found.centre[axis] = self.said(word.value, report);
            } else if name == b";" {
                break;
            } else {
                found.unread = true;
            }
        }
        found
    }

    fn rescale(&mut self, report: &mut Report<'_>) {
        let mut shape = self.memory.frames.shape;
        shape.scaling = self.memory.scales.scaling(self.core.setup.control.scaled_axes);
        self.memory.scales.moved &= shape.scaling.is_some();
        self.reshape(shape, report);
    }

    /// Whether coordinates of words are turned, mirrored or scaled, or perhaps are.
    pub(super) fn is_shaped(&self) -> bool {
        let perhaps = [Reason::Rotation, Reason::Mirror, Reason::Scale, Reason::AxisScale];
        let lost = self.memory.lost;
        !self.memory.frames.shape.is_identity() || perhaps.into_iter().any(|reason| lost.has(reason))
    }

    /// The shift of the program changes: where the centre of cycle 26 is then is in no source. Cycle 11 scales about the active datum.
    pub(super) fn scaled_system_shifts(&mut self) {
        self.memory.scales.moved |= self.memory.scales.by_axis();
    }

    /// A preset is chosen: whether a scaling stays is not taken from a source.
    pub(super) fn scaled_preset_changes(&mut self) {
        self.memory.scales.moved |= self.memory.frames.shape.scaling.is_some();
    }

    /// A program that is not there may leave a datum, a plane, a rotation, a mirror image and scalings: what it shifts and turns stays after its end.
    /// Each is unknown until the program sets it again.
    pub(super) fn lose_system(&mut self) {
        self.memory.scales.open = XYZ;
        for reason in [
            Reason::Datum,
            Reason::Plane,
            Reason::Rotation,
            Reason::Mirror,
            Reason::Scale,
            Reason::AxisScale,
        ] {
            self.lose(reason);
        }
    }

    /// Positions are unknown while something holds that no source describes together with a scaling.
    pub(super) fn review_scaling(&mut self, report: &mut Report<'_>) {
        match self.scaled_with() {
            Some(what) => {
                self.not_modelled_once(&what, report);
                if !self.memory.lost.has(Reason::ScaleWith) {
                    self.lose(Reason::ScaleWith);
                }
            }
            None => self.found(Reason::ScaleWith),
        }
    }

    fn scaled_with(&self) -> Option<String> {
        let (shape, scales) = (&self.memory.frames.shape, &self.memory.scales);
        shape.scaling?;
        let by_axis = scales.by_axis();
        let cycle = if by_axis { "cycle 26" } else { "cycle 11" };
        let plane = self.core.state.coordinates.plane();
        let in_plane = self.core.setup.control.scaled_axes == Some(ScaledAxes::Plane);
        let turned_elsewhere = |of: Plane| shape.rotation.is_some_and(|rotation| rotation.plane != of);
        let with = match scales.whole {
            Some(_) if by_axis => "together with cycle 11: the factor of both",
            Some((_, of)) if in_plane && (of != plane || turned_elsewhere(of)) => {
                "with another tool axis after it: which axes it scales"
            }
            _ if by_axis && shape.rotation.is_some() => "together with cycle 10: their order",
            _ if by_axis && shape.mirror != [None; 3] => "together with cycle 8: their order",
            _ if self.memory.frames.tilt.is_some() => "in a tilted plane",
            _ if self.core.state.tool_axis.tcp() => "under M128 or FUNCTION TCPM",
            _ if scales.moved => "with another datum after it: whether the scaling and its centre stay",
            _ => return None,
        };
        Some(format!("{cycle} {with}"))
    }

    /// The radius of RND in the workpiece; `None`: not known. Cycle 11 multiplies radii; what cycle 26 does with them is not stated.
    pub(super) fn scaled_size(&mut self, name: &str, mm: f64, report: &mut Report<'_>) -> Option<f64> {
        let Some(scaling) = self.memory.frames.shape.scaling else {
            return Some(mm);
        };
        if self.memory.scales.by_axis() {
            self.not_modelled_once(&format!("{name} while cycle 26 scales: its size"), report);
            return None;
        }
        Some(mm * scaling.factors[self.axes()[0]])
    }

    /// Whether a cycle runs in a scaled system: its dimensions are scaled, in the tool axis too or not.
    pub(super) fn scales_cycles(&mut self, report: &mut Report<'_>) -> bool {
        let scales = self.memory.frames.shape.scaling.is_some();
        if scales {
            let what = "a machining cycle while cycle 11 or 26 scales: which of its dimensions are scaled";
            self.not_modelled_once(what, report);
        }
        scales
    }

    /// Whether a way is scaled whose length is a word: of APPR and DEP, of M140.
    pub(super) fn scales_lengths(&mut self, what: &str, report: &mut Report<'_>) -> bool {
        let scales = self.memory.frames.shape.scaling.is_some();
        if scales {
            let what = format!("{what} while cycle 11 or 26 scales: whether its lengths are scaled");
            self.not_modelled_once(&what, report);
        }
        scales
    }

    /// Cycle 11 scales U, V and W too (TNC 410 user's manual, p. 186), by which of both settings is not stated; cycle 26 may.
    pub(super) fn scale_parallel_axes(&mut self, words: &PathWords, end: &mut Position, report: &mut Report<'_>) {
        if words.given & PARALLEL != 0 && self.memory.frames.shape.scaling.is_some() {
            self.not_modelled_once("U, V or W while cycle 11 or 26 scales: whether they are scaled", report);
            end.known &= !(words.given & PARALLEL);
        }
    }

    /// An arc of the words that is none in the workpiece.
    pub(super) fn distorted(&mut self, before: &MotionKind, after: &MotionKind, report: &mut Report<'_>) {
        if matches!((before, after), (MotionKind::Arc(Some(_)), MotionKind::Arc(None))) {
            let scaled = self.memory.frames.shape.scaling.is_some();
            let what = if scaled && self.memory.frames.shape.rotation.is_none() {
                "an arc whose two axes are scaled by different factors: the control requires the same factor for both"
            } else {
                "an arc in another plane than cycle 10 turns"
            };
            self.not_modelled_once(what, report);
        }
    }
}
