//! Calls that move nothing: tools, offsets, feed, spindle, planes, units, and the machine's own codes.
use super::bridge::{Bridge, LINEAR_AXES};
use super::feed::Rate;
use super::frames::Shift;
use crate::feed_speed::METRES_PER_FOOT;
use crate::tools::Chosen;
use crate::{Fault, FaultKind, Sink};
use trunnion_dialect::{Action, Code, Dialect, Owner, Plane};
use trunnion_ngc::{At, Canon, OwnCode, Side, SpindleTurn, State, Units};
use trunnion_syntax::{Address, BlockId, TextRange, Value};

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// The codes of the machine's own of one block. Which of them runs first is for the machine to say, so that of several that do more
    /// than switch something it is not known what they leave active.
    pub(super) fn own_codes(&mut self, codes: &[OwnCode], at: At, state: &State) {
        for own in codes {
            self.own_code(*own, at, state);
        }
        let dialect = self.core.dialect;
        let moves = |own: &&OwnCode| table_entry(dialect, **own).is_some_and(|code| !is_harmless(code.action));
        let moving: Vec<&OwnCode> = codes.iter().filter(moves).collect();
        let [_, .., last] = moving[..] else { return };
        let names: Vec<String> = moving.iter().map(ToString::to_string).collect();
        let what = format!("{} in one block: the machine decides their order", names.join(" and "));
        self.fault(at, last.range, FaultKind::NotModelled { what });
        self.lose_kinematics();
    }

    /// Neither the kinematics nor the position is known from here on.
    fn lose_kinematics(&mut self) {
        self.calls.kinematics_unknown = true;
        self.calls.lost = true;
        self.calls.lost_rotary = true;
        self.core.state.zero.lose(true);
    }

    /// One of the machine's own codes: its effect by the dialect's table, otherwise the position after it is unknown.
    fn own_code(&mut self, own: OwnCode, at: At, state: &State) {
        let code = table_entry(self.core.dialect, own);
        let clamps_axis = self.clamp_code(own, state);
        let Some(code) = code else {
            if !clamps_axis {
                self.core.state.spindle.may_start();
                self.fault(at, own.range, FaultKind::UnknownCode { machine_builder: true });
            }
            return;
        };
        if own.letter == b'M' && code.owner == Owner::MachineBuilder && code.action == Action::NoMotion && !clamps_axis
        {
            self.core.state.spindle.may_start();
            // a program of the user: what it does is not known
            self.fault(at, own.range, FaultKind::UnknownCode { machine_builder: true });
        }
        let known = matches!(
            code.action,
            Action::TcpOn
                | Action::TcpOff
                | Action::Kinematics
                | Action::NoMotion
                | Action::PathMode
                | Action::ProgramStop
        );
        if state.side != Side::Off && !is_harmless(code.action) {
            // motions before it in the text come after it
            let what = format!("{} under cutter radius compensation", code.id);
            self.fault(at, own.range, FaultKind::NotModelled { what });
            self.calls.kinematics_unknown = true;
            self.calls.lost_rotary = true;
            self.core.state.zero.lose(true);
            return;
        }
        if known && state.named_axes != 0 {
            // the words are arguments of the remap, or a motion with it: the interpreter does not run them
            let what = format!("{} with axis words in its block", code.id);
            self.fault(at, own.range, FaultKind::NotModelled { what });
            self.calls.lost = true;
            self.calls.lost_rotary = true;
        }
        match code.action {
            Action::TcpOn => self.tcp(true),
            Action::TcpOff => self.tcp(false),
            Action::Kinematics => self.kinematics(&code.id, own, at),
            Action::NoMotion | Action::PathMode | Action::ProgramStop => {}
            Action::FrameReset => self.calls.lost |= std::mem::take(&mut self.calls.hidden),
            action => {
                let what = code.id.clone();
                self.fault(at, own.range, FaultKind::NotModelled { what });
                self.calls.lost = true;
                if action == Action::FrameChange {
                    self.calls.hidden = true;
                } else {
                    self.calls.lost_rotary = true;
                }
            }
        }
        self.core.state.zero.lose(self.calls.is_hidden());
    }

    /// Takes a code that closes or opens a clamp; whether it is one.
    fn clamp_code(&mut self, own: OwnCode, state: &State) -> bool {
        if own.letter != b'M' {
            return false;
        }
        let core = &mut *self.core;
        let codes = &core.setup.control.clamp_codes;
        let clamps = &mut core.state.clamps;
        let is_one = clamps.hear(codes, own.tenths);
        // motions before it in the text may come after it
        if is_one && state.side != Side::Off {
            clamps.hear_unread(codes);
        }
        is_one
    }

    /// A code that switches the kinematics.
    fn kinematics(&mut self, code: &str, own: OwnCode, at: At) {
        let declared = self.core.setup.control.tcp_codes.as_ref();
        if let Some(on) = declared.and_then(|codes| codes.meaning(code)) {
            self.calls.lost |= std::mem::take(&mut self.calls.kinematics_unknown);
            self.tcp(on);
            return;
        }
        let what =
            format!("{code}: the machine file does not declare which kinematics it selects ([control] tcp_codes)");
        self.fault(at, own.range, FaultKind::NotModelled { what });
        self.tcp(false);
        self.calls.lost = true;
        self.calls.kinematics_unknown = true;
    }

    /// G53, G28 or G30 while tool centre point control is on.
    pub(super) fn frame_unknown(&mut self, at: At) {
        let what = "G53, G28 or G30 while tool centre point control is on: machine coordinates mean the tip or the axes, as the \
                    machine's kinematics define";
        let range = self.code_range(at, b'G', |code| matches!(code, 280 | 300 | 530));
        self.fault(at, range, FaultKind::NotModelled { what: what.to_owned() });
        self.calls.lost = true;
    }

    /// The first code of the current block that `is` says, ten times its number; the whole block where it is not written as a number.
    pub(super) fn code_range(&mut self, at: At, letter: u8, is: impl Fn(i64) -> bool) -> TextRange {
        let block = self.block(at);
        let mut words = self.program.block(block).words();
        let found = words.find(|word| match (word.address, word.value) {
            (Address::Letter(address), Value::Number(number)) if address == letter => {
                is((number.to_f64() * 10.0).round() as i64)
            }
            _ => false,
        });
        found.map_or(TextRange::default(), |word| word.range)
    }

    /// The linear axes of one kind of coordinates are not known from the other.
    pub(super) fn tcp(&mut self, on: bool) {
        if self.core.state.tool_axis.tcp() != on {
            self.core.state.tool_axis.set_tcp(on);
            self.calls.lost = true;
        }
    }

    /// S; that of G96 is in feet per minute where lengths are in inches (LinuxCNC user manual, G96).
    fn spindle_speed(&mut self, speed: f64, unit: f64) {
        let spindle = &mut self.core.state.spindle;
        let speed = Some(speed).filter(|speed| speed.is_finite());
        if spindle.surface_speed() {
            let metres = if unit == 1.0 { 1.0 } else { METRES_PER_FOOT };
            spindle.set_cutting_speed(speed.map(|speed| speed * metres));
        } else {
            spindle.set_rpm(speed);
        }
    }

    /// A spindle that is switched on takes S of G96 in the unit of now (LinuxCNC, emccanon.cc: START_SPINDLE_CLOCKWISE).
    fn speed_of_start(&mut self, turn: SpindleTurn, state: &State) {
        let spindle = &self.core.state.spindle;
        if turn != SpindleTurn::Stop && spindle.surface_speed() && spindle.speed_programmed() {
            self.spindle_speed(state.speed[0], state.units.mm());
        }
    }

    pub(super) fn modal(&mut self, call: &Canon, at: At, state: &State) {
        let unit = state.units.mm();
        self.report_unknown_shift(call, at);
        match *call {
            Canon::FeedRate(rate) => {
                self.calls.rate = Some(Rate {
                    mm: rate * unit,
                    deg: rate,
                });
                self.core.state.feed.set(Some(rate * unit));
            }
            Canon::FeedMode(_, mode) => self.calls.per_revolution = mode == 1,
            Canon::StartSync(synced) => {
                let deg = synced.per_revolution;
                self.calls.synced = Some(Rate { mm: deg * unit, deg });
            }
            Canon::SpindleMode(0, ceiling) => {
                let spindle = &mut self.core.state.spindle;
                spindle.set_surface_speed(ceiling != 0.0);
                // 1e30 is what the control takes without D
                spindle.limit(Some(ceiling).filter(|ceiling| *ceiling != 0.0 && *ceiling < 1e30));
            }
            Canon::G92Offset(ref offset) => {
                self.calls.g92 = Shift::metric(offset, unit);
                self.zero_set_here();
            }
            Canon::StopSync => self.calls.synced = None,
            Canon::Spindle(0, turn) => {
                self.core.state.spindle.switch(turn != SpindleTurn::Stop);
                self.speed_of_start(turn, state);
            }
            Canon::Spindle(spindle, turn) if turn != SpindleTurn::Stop => self.further_spindle(spindle, at),
            Canon::SpindleSpeed(0, speed) => {
                self.spindle_speed(speed, unit);
            }
            Canon::SelectTool(number) => {
                let number = u32::try_from(number).ok();
                self.core.state.tool.prepare(number);
                self.core.tools.prepare(number.map_or(Chosen::Unread, Chosen::Number));
            }
            Canon::ChangeTool { .. } | Canon::ChangeToolNumber { .. } => {
                let number = u32::try_from(state.tool).ok();
                let core = &mut *self.core;
                core.state.tool.load(number);
                core.tools.load(number.map_or(Chosen::Unread, Chosen::Number));
                core.merge_tool();
                // the change may move the machine: the interpreter has forgotten X Y Z too
                if matches!(call, Canon::ChangeTool { .. }) {
                    for axis in LINEAR_AXES {
                        self.calls.machine.forget(axis);
                    }
                }
            }
            Canon::ToolOffset(ref offset) => {
                self.tool_offset(offset, at, state);
            }
            Canon::G5xOffset(index, ref offset) => {
                self.work_offset(index, offset, at, state);
            }
            Canon::Units(units) => {
                // the first one is the control's own, before the program
                let own = !std::mem::replace(&mut self.calls.own_units, true);
                let unit = if units == Units::Inch { 25.4 } else { 1.0 };
                if own {
                    self.core.state.own_units(unit, unit);
                } else {
                    self.core.state.units(unit, unit);
                }
            }
            Canon::Plane(plane) => {
                self.core.state.coordinates.set_plane(match plane {
                    trunnion_ngc::Plane::Xz => Plane::Zx,
                    trunnion_ngc::Plane::Yz => Plane::Yz,
                    _ => Plane::Xy,
                });
            }
            _ => {}
        }
    }

    /// Another spindle than the first starts: which one holds the tool is not known, nor whether the machine has it.
    fn further_spindle(&mut self, spindle: i32, at: At) {
        self.core.state.spindle.may_start();
        let what = format!(
            "spindle ${spindle}: the INI file says how many spindles there are ([TRAJ]SPINDLES), and it is not known here"
        );
        let range = self.code_range(at, b'M', |code| [30, 40].contains(&code));
        self.fault(at, range, FaultKind::NotModelled { what });
    }

    /// The program has no end: reported at its last line that is not blank.
    pub(super) fn missing_end(&mut self) {
        let blocks = (0..self.program.block_count() as u32).rev().map(BlockId);
        let mut written = blocks.filter(|&block| {
            let range = self.program.block(block).range();
            !self.program.bytes(range).trim_ascii().is_empty()
        });
        if let Some(block) = written.next() {
            let range = self.program.block(block).range();
            let kind = FaultKind::MissingProgramEnd;
            self.sink.fault(Fault {
                place: None,
                block,
                range,
                kind,
            });
        }
    }
}

/// What the dialect's table says about one of the machine's own codes.
fn table_entry(dialect: &Dialect, own: OwnCode) -> Option<&Code> {
    if own.letter == b'G' {
        dialect.g(own.tenths)
    } else {
        dialect.m(own.tenths)
    }
}

/// Whether what a code does changes neither the position nor what words mean.
fn is_harmless(action: Action) -> bool {
    matches!(action, Action::NoMotion | Action::PathMode | Action::ProgramStop)
}
