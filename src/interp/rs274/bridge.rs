//! Canonical calls of LinuxCNC's interpreter become motions and modal state.
use super::call_state::CallState;
use super::chords::chords;
use super::faults::{fault_of, placed};
use super::frames::Shift;
use crate::core::Core;
use crate::{FaultKind, Feed, Motion, MotionKind, Orientation, Position, Sink};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::{Arc, Turning};
use trunnion_ngc::{At, Canon, Error, FileId, OwnCode, Pose, State};
use trunnion_syntax::{BlockId, Program, TextRange};

/// X Y Z U V W.
pub(super) const LINEAR_AXES: [usize; 6] = [0, 1, 2, 6, 7, 8];

/// U V W.
const FURTHER_AXES: u16 = 0b111 << 6;

/// Chords stay within this of a spline, mm.
const SPLINE_TOLERANCE_MM: f64 = 0.001;
/// The same where it is declared how far the control's own arcs are from the curve.
const DECLARED_TOLERANCE_MM: f64 = 1e-5;

/// Receives canonical calls.
pub(super) struct Bridge<'i, 'd, 'p, S: Sink> {
    pub(super) core: &'i mut Core<'d>,
    pub(super) calls: &'i mut CallState,
    pub(super) program: &'p Program,
    pub(super) sink: &'i mut S,
}

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// The block of the main program that represents a place.
    pub(super) fn block(&self, at: At) -> BlockId {
        if at.file == FileId::MAIN {
            let last = (self.program.block_count() as u32).saturating_sub(1);
            let block = match &self.calls.blocks {
                None => at.line.min(last),
                Some(blocks) => blocks.get(at.line as usize).copied().unwrap_or(last),
            };
            return BlockId(block);
        }
        self.calls.places.caller(at.chain)
    }

    /// The offsets that the machine knows.
    pub(super) fn shift(&self, state: &State) -> Shift {
        Shift::of(state, &self.calls.g92, &self.calls.tool_offset)
    }

    pub(super) fn fault(&mut self, at: At, range: TextRange, kind: FaultKind) {
        let block = self.block(at);
        let range = if at.file == FileId::MAIN && range != TextRange::default() {
            range
        } else {
            self.program.block(block).range()
        };
        self.calls.has_other_effects |= crate::effects::has_other_effects(&kind);
        let in_called = at.file != FileId::MAIN;
        let path = self.calls.paths.get(at.file.0 as usize).filter(|_| in_called);
        let place = path.map(|path| (&**path, at.line + 1));
        self.sink.fault(placed((block, range), kind, place));
    }

    /// `codes`: ten times the numbers of the G codes that may be meant, for the place.
    pub(super) fn not_modelled(&mut self, at: At, codes: core::ops::RangeInclusive<i64>, what: String) {
        let range = self.code_range(at, b'G', |code| codes.contains(&code));
        self.fault(at, range, FaultKind::NotModelled { what });
    }

    /// Reports once that a program without a machine names U, V or W, which not every machine has.
    #[inline]
    fn further_axes(&mut self, at: At, state: &State) {
        if state.named_axes & FURTHER_AXES != 0 && !self.core.setup.control.axes_declared {
            self.further_axes_undeclared(at, state);
        }
    }

    #[cold]
    fn further_axes_undeclared(&mut self, at: At, state: &State) {
        if std::mem::replace(&mut self.calls.further_said, true) {
            return;
        }
        let letter = ['U', 'V', 'W'][(state.named_axes >> 6).trailing_zeros().min(2) as usize];
        let what = format!("axis {letter}: without a machine file it is not known whether the machine has it");
        self.fault(at, TextRange::default(), FaultKind::NotModelled { what });
    }

    #[inline]
    pub(super) fn motion(&mut self, kind: MotionKind, end: Position, shift: &Shift, feed: Feed, at: At, state: &State) {
        self.motion_to(kind, [end, shift.machine(&end)], shift, feed, at, state);
    }

    /// `ends`: where the motion ends, and that in coordinates of the machine.
    pub(super) fn motion_to(
        &mut self,
        kind: MotionKind,
        ends: [Position; 2],
        shift: &Shift,
        feed: Feed,
        at: At,
        state: &State,
    ) -> Motion {
        if self.core.effects.wanted() {
            self.machine_frame(state.machine_frame, at);
        }
        let block = self.block(at);
        let mut start = shift.programmed(&self.calls.machine);
        let ([mut end, mut machine], mut kind) = (ends, kind);
        // an axis that the machine lacks does not move
        let standing = self.core.standing.absent();
        standing.hold(&mut start);
        standing.hold(&mut end);
        standing.hold(&mut machine);
        if self.core.state.tool_axis.tcp() && state.machine_frame {
            self.frame_unknown(at);
            kind = MotionKind::Unknown;
            for axis in LINEAR_AXES {
                end.forget(axis);
            }
            machine = shift.machine(&end);
        }
        if self.calls.is_hidden() {
            for axis in LINEAR_AXES {
                end.forget(axis);
            }
            machine = shift.machine(&end);
            if let MotionKind::Arc(arc) = &mut kind {
                *arc = None;
            }
        }
        self.calls.machine = machine;
        self.further_axes(at, state);
        let core = &mut *self.core;
        core.state.position = end;
        core.chain = self.calls.places.chain(at);
        super::modal::refresh(&mut core.state, state, shift);
        let modal = &core.state;
        let motion = Motion {
            block,
            chain: core.chain,
            kind,
            start,
            end,
            // lines that are emitted as differences may name other rotary axes
            says_way: if modal.coordinates.incremental() {
                crate::core::ROTARY & end.known | state.named_axes
            } else {
                0
            },
            ways: crate::Ways::default(),
            orientation: Orientation::Words,
            tcp: modal.tool_axis.tcp(),
            great_circle: modal.tool_axis.great_circle(),
            feed,
            spindle_on: modal.spindle.on(),
            spindle_rpm: modal.spindle.rpm(),
            spin: None,
            zero: shift.zero,
            tool_length_mm: shift.length,
            undeclared: if state.machine_frame {
                modal.undeclared().of_axes(start.known & !state.named_axes)
            } else {
                modal.undeclared()
            },
            machine_coordinates: false,
            // G7 halves X, and G8 takes it as it is: neither leaves that to the machine file
            radii: state.lathe_diameter || core.setup.control.x_diameter,
            tool: modal.tool.number(),
            tilt: crate::Tilt::default(),
            relocations: 0,
            effects: core.effects.count(),
            slack_mm: self.calls.slack_mm,
        };
        let named = state.named_axes & !motion.end.known != 0;
        let no_path = matches!(
            kind,
            MotionKind::Arc(None) | MotionKind::Unknown | MotionKind::Dwell(None)
        );
        self.calls.unknown_end |= named || no_path;
        self.sink.motion(&motion, &self.core.state);
        motion
    }

    /// Where an arc ends, and the arc as far as its start is known.
    fn arc(&self, call: ArcCall, shift: &Shift, state: &State) -> (Option<Arc>, Position) {
        let start = shift.programmed(&self.calls.machine);
        let order = match state.plane {
            trunnion_ngc::Plane::Xy => [0, 1, 2],
            trunnion_ngc::Plane::Xz => [2, 0, 1],
            trunnion_ngc::Plane::Yz => [1, 2, 0],
            // the interpreter refuses arcs in planes of U V W
            _ => return (None, Position::default()),
        };
        let place = |[first, second]: [f64; 2], along: f64| {
            let mut point = [0.0; 3];
            point[order[0]] = first;
            point[order[1]] = second;
            point[order[2]] = along;
            point
        };
        let mut pose: Pose = [0.0; 9];
        pose[..3].copy_from_slice(&place(call.end, call.axis_end));
        pose[3..].copy_from_slice(&call.others);
        let end = shift.coordinates(&pose);
        let mut normal = Vec3::zeros();
        normal[order[2]] = 1.0;
        let turning = if call.turns > 0 {
            Turning::CounterClockwise
        } else {
            Turning::Clockwise
        };
        let centre = shift.point(place(call.centre, call.axis_end));
        let extra = call.turns.unsigned_abs().checked_sub(1);
        let known = start.xyz().zip(end.xyz()).zip(extra);
        let arc = known
            .and_then(|((start, to), extra)| Arc::from_centre(start, to, centre, shift.turned(normal), turning, extra));
        (arc, end)
    }
}

/// An arc as it is called.
#[derive(Clone, Copy)]
struct ArcCall {
    end: [f64; 2],
    centre: [f64; 2],
    turns: i32,
    axis_end: f64,
    others: [f64; 6],
}

impl<S: Sink> trunnion_ngc::Sink for Bridge<'_, '_, '_, S> {
    fn straight(&mut self, rapid: bool, end: &Pose, at: At, state: &State) {
        self.straight_motion(rapid, end, at, state);
    }

    fn call(&mut self, call: &Canon, at: At, state: &State) {
        if !matches!(call, Canon::Traverse(_) | Canon::Feed(_) | Canon::FeedRate(_)) {
            self.calls.steady = None;
        }
        if self.core.effects.wanted() {
            self.effect_of_call(call, at, state);
        }
        match call {
            Canon::Traverse(pose) => self.straight_motion(true, pose, at, state),
            Canon::Feed(pose) => self.straight_motion(false, pose, at, state),
            &Canon::Arc {
                end,
                centre,
                turns,
                axis_end,
                others,
            } => {
                let call = ArcCall {
                    end,
                    centre,
                    turns,
                    axis_end,
                    others,
                };
                self.arc_motion(call, at, state);
            }
            Canon::Nurbs {
                order,
                points,
                knots,
                end,
            } => self.spline(*order, points, knots, end, at, state),
            Canon::Probe(kind, pose) => self.probe(*kind, pose, at, state),
            Canon::RigidTap(to, back) => self.tap(*to, *back, at, state),
            Canon::Dwell(seconds) => {
                let shift = self.shift(state);
                let end = shift.programmed(&self.calls.machine);
                // it is not known what a machine does with a negative time, which the interpreter accepts
                let is_time = seconds.is_finite() && *seconds >= 0.0;
                let kind = MotionKind::Dwell(is_time.then_some(*seconds));
                self.motion(kind, end, &shift, Feed::Unknown, at, state);
            }
            Canon::UserCode(number, ..) => {
                let tenths = number.unsigned_abs() * 10;
                let range = self.code_range(at, b'M', |code| code == i64::from(tenths));
                let letter = b'M';
                self.own_codes(&[OwnCode { letter, tenths, range }], at, state);
            }
            Canon::OwnCodes(codes) => self.own_codes(codes, at, state),
            _ => self.modal(call, at, state),
        }
    }

    fn cut(&mut self, range: TextRange, at: At) {
        let what = "NUL character: the control does not read the rest of this line".to_owned();
        self.fault(at, range, FaultKind::NotModelled { what });
    }

    fn entered(&mut self, name: &str, at: At) {
        self.core.state.spindle.lose();
        let numbered = name.bytes().all(|byte| byte.is_ascii_digit());
        let label = if numbered {
            format!("o{name}")
        } else {
            format!("o<{name}>")
        };
        self.fault(at, TextRange::default(), FaultKind::caller_lacks(&label));
    }

    fn error(&mut self, error: &Error, at: At) {
        self.calls.lost |= error.problem.class == trunnion_ngc::Class::NotModelled && !error.is_of_unset();
        if !self.sink.reads_faults() && error.problem.class != trunnion_ngc::Class::ProgramEnd {
            self.calls.has_other_effects = true;
            return;
        }
        let kind = fault_of(error);
        if kind == FaultKind::MissingProgramEnd {
            self.missing_end();
            return;
        }
        self.fault(at, error.range, kind);
    }
}

impl<S: Sink> Bridge<'_, '_, '_, S> {
    #[inline]
    fn straight_motion(&mut self, rapid: bool, end: &Pose, at: At, state: &State) {
        self.further_axes(at, state);
        let only = state.motion_only && !self.calls.is_hidden();
        if !only {
            self.calls.steady = None;
        }
        self.line(rapid, end, only, at, state);
    }

    fn arc_motion(&mut self, call: ArcCall, at: At, state: &State) {
        let shift = self.shift(state);
        let (arc, end) = self.arc(call, &shift, state);
        let feed = self.feed(&shift.machine(&end), true, at, state);
        self.motion(MotionKind::Arc(arc), end, &shift, feed, at, state);
    }

    fn spline(&mut self, order: u32, points: &[[f64; 3]], knots: &[f64], end: &Pose, at: At, state: &State) {
        let shift = self.shift(state);
        let target = shift.coordinates(end);
        let feed = self.feed(&shift.machine(&target), true, at, state);
        let arcs = self.core.setup.control.spline_arcs_mm;
        let own = arcs.map_or(SPLINE_TOLERANCE_MM, |_| DECLARED_TOLERANCE_MM);
        let most = self.core.setup.limits.blocks;
        let room = most.saturating_sub(self.calls.curve_work.count());
        let (places, took) = chords(order as usize, points, knots, own / state.units.mm(), room);
        self.calls.curve_work.add_in_vain(took);
        match (&places, arcs) {
            (Some(_), Some(_)) => {}
            (Some(_), None) => self.not_modelled(
                at,
                50..=63,
                format!("spline: judged along chords within {own} mm of it; the control runs it as its own arcs: declare [control] spline_arcs"),
            ),
            (None, _) if took > room => {
                let what = format!("spline: its path, which takes more than {most} steps with those before it ([limits] blocks)");
                self.not_modelled(at, 50..=63, what);
            }
            (None, _) => self.not_modelled(at, 50..=63, "spline: its path".to_owned()),
        }
        let Some(places) = places else {
            self.motion(MotionKind::Unknown, target, &shift, feed, at, state);
            return;
        };
        let (first, second) = match state.plane {
            trunnion_ngc::Plane::Xy => (0, 1),
            trunnion_ngc::Plane::Xz => (2, 0),
            _ => (1, 2),
        };
        let last = places.len().saturating_sub(1);
        self.calls.slack_mm = own + arcs.unwrap_or(0.0);
        for (index, [a, b]) in places.into_iter().enumerate() {
            let mut pose = *end;
            (pose[first], pose[second]) = (a, b);
            let to = if index == last {
                target
            } else {
                shift.coordinates(&pose)
            };
            self.motion(MotionKind::Linear, to, &shift, feed, at, state);
        }
        self.calls.slack_mm = 0.0;
    }

    /// Where the probe touches is known to the machine only: the position of every axis that the block moves is lost.
    fn probe(&mut self, kind: u8, pose: &Pose, at: At, state: &State) {
        let shift = self.shift(state);
        let target = shift.coordinates(pose);
        let start = shift.programmed(&self.calls.machine);
        let mut end = target;
        for axis in 0..9 {
            if start.get(axis) != target.get(axis) {
                end.forget(axis);
            }
        }
        self.not_modelled(at, 382..=385, format!("G38.{kind}: the probed position"));
        self.motion(MotionKind::Unknown, end, &shift, Feed::Unknown, at, state);
    }
}
