//! Effects of a LinuxCNC program: canonical calls that are not motions and not in the modal state.
use super::bridge::Bridge;
use super::frames::Shift;
use crate::feed_speed::METRES_PER_FOOT;
use crate::{Argument, Effect, Reach};
use crate::{Feed, MotionKind, Sink};
use std::borrow::Cow;
use trunnion_ngc::{At, Canon, Coolant, MotionMode, SpindleMode, SpindleTurn, State, Stop, Switch, Units};

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// Emits the effect of a canonical call, if it has one.
    #[cold]
    pub(super) fn effect_of_call(&mut self, call: &Canon, at: At, state: &State) {
        if let Some(effect) = effect(call, state.units.mm(), self.speed_unit(call, state)) {
            let block = self.block(at);
            let reach = reach(call).unwrap_or(effect.usual_reach());
            self.core.effects.add_with(block, effect, reach);
            if matches!(call, Canon::ChangeTool { .. } | Canon::ChangeToolNumber { .. }) {
                let change = vec![Argument::code("tool change")];
                self.core.effects.add(block, Effect::Event(change));
            }
            self.hand_on();
        }
        // a spindle that is switched on takes S of G96 in the unit of now (LinuxCNC, emccanon.cc: START_SPINDLE_CLOCKWISE)
        if let Canon::Spindle(spindle, SpindleTurn::Clockwise | SpindleTurn::CounterClockwise) = call
            && self.cuts_at_speed(*spindle, state)
        {
            let speed = usize::try_from(*spindle).ok().and_then(|index| state.speed.get(index));
            let speed = Canon::SpindleSpeed(*spindle, speed.copied().unwrap_or(f64::NAN));
            self.effect_of_call(&speed, at, state);
        }
        // also after a G92 of the program, which shifts the axes that it names and leaves the rest
        if matches!(call, Canon::G92Offset(_)) && self.has_code(at, |tenths| matches!(tenths, 921 | 922)) {
            let block = self.block(at);
            let effect = Effect::set("G92 of the program before", [Argument::code("cleared")]);
            self.core.effects.add(block, effect);
            self.hand_on();
        }
        if let Canon::G92Offset(offset) = call
            && Shift::metric(offset, state.units.mm()).map(f64::to_bits) != self.calls.g92.map(f64::to_bits)
        {
            self.core.set_from_here(self.block(at), None);
            self.hand_on();
        }
    }

    /// Whether G96 is in effect for a spindle.
    fn cuts_at_speed(&self, spindle: i32, state: &State) -> bool {
        let mode = usize::try_from(spindle)
            .ok()
            .and_then(|index| state.spindle_mode.get(index));
        match spindle {
            0 => self.core.state.spindle.surface_speed(),
            _ => matches!(mode, Some(SpindleMode::ConstantSurface(_))),
        }
    }

    /// m/min or 1/min per unit of S: under G96 it is in feet per minute where lengths are in inches (LinuxCNC user manual, G96).
    fn speed_unit(&self, call: &Canon, state: &State) -> f64 {
        match call {
            Canon::SpindleSpeed(spindle, _) if state.units == Units::Inch && self.cuts_at_speed(*spindle, state) => {
                METRES_PER_FOOT
            }
            _ => 1.0,
        }
    }

    /// Whether a line has one of these G codes.
    fn has_code(&mut self, at: At, is: impl Fn(i64) -> bool) -> bool {
        self.code_range(at, b'G', is) != trunnion_syntax::TextRange::default()
    }

    /// Control points of a spline that no G5.3 has ended: there is no curve, and they stay in the control.
    pub(super) fn open_spline(&mut self, points: &[[f64; 3]], at: At) {
        let what = "G5.2 without G5.3: the control makes no curve of these control points, and may mix them with those of a later spline";
        let kind = crate::FaultKind::NotModelled { what: what.to_owned() };
        self.fault(at, trunnion_syntax::TextRange::default(), kind);
        if self.core.effects.wanted() {
            let names = ["X", "Y", "P"];
            let words = points.iter().flatten().zip(names.into_iter().cycle());
            let mut effect = vec![Argument::code("G5.2")];
            effect.extend(words.map(|(value, name)| Argument::number(name, *value)));
            let block = self.block(at);
            self.core
                .effects
                .add_with(block, Effect::Unmodelled(effect), Reach::Itself);
            self.hand_on();
        }
    }

    /// Rigid tapping: in along the thread and back to where it began.
    pub(super) fn tap(&mut self, to: [f64; 3], back: f64, at: At, state: &State) {
        let shift = self.shift(state);
        let start = shift.programmed(&self.calls.machine);
        let point = shift.point(to);
        let mut end = start;
        for axis in 0..3 {
            if point[axis].is_finite() {
                end.set(axis, point[axis]);
            } else {
                end.forget(axis);
            }
        }
        let feed = self
            .calls
            .synced
            .map_or(Feed::Unknown, |pitch| Feed::PerRevolution(pitch.mm));
        if self.core.effects.wanted() {
            self.tapping(Some(back), at);
        }
        self.motion(MotionKind::Linear, end, &shift, feed, at, state);
        self.motion(MotionKind::Linear, start, &shift, feed, at, state);
        if self.core.effects.wanted() {
            self.tapping(None, at);
        }
    }

    /// Rigid tapping begins, with the ratio of the speed back, or ends.
    #[cold]
    pub(super) fn tapping(&mut self, back: Option<f64>, at: At) {
        let block = self.block(at);
        let to: Vec<Argument> = back.map(|back| Argument::number("G33.1", back)).into_iter().collect();
        self.core.effects.add(block, Effect::set("cycle", to));
        self.hand_on();
    }

    /// A motion in machine coordinates (G53), or the first one after it.
    pub(super) fn machine_frame(&mut self, is_on: bool, at: At) {
        if std::mem::replace(&mut self.calls.machine_frame, is_on) != is_on {
            let block = self.block(at);
            let to: Vec<Argument> = is_on.then(|| Argument::code("G53")).into_iter().collect();
            self.core.effects.add(block, Effect::set("coordinates", to));
            self.hand_on();
        }
    }

    fn hand_on(&mut self) {
        self.core.emit_effects(self.sink);
    }
}

/// The key of a spindle's setting; spindle 0 has the name without a number.
fn key(name: &'static str, spindle: i32) -> Cow<'static, str> {
    if spindle == 0 {
        name.into()
    } else {
        format!("{name} ${spindle}").into()
    }
}

fn count(name: &'static str, value: i32) -> Argument {
    Argument::number(name, f64::from(value))
}

fn on(is_on: bool) -> Vec<Argument> {
    is_on.then(|| Argument::code("on")).into_iter().collect()
}

/// `(PROBEOPEN file)` and `(PROBECLOSE)`, which open and close a file for the results of probing.
fn is_probe_file(text: &[u8]) -> bool {
    [&b"PROBEOPEN"[..], b"PROBECLOSE"].iter().any(|word| {
        text.get(..word.len())
            .is_some_and(|head| head.eq_ignore_ascii_case(word))
    })
}

/// What an event may change; `None`: as others of its sort.
fn reach(call: &Canon) -> Option<Reach> {
    match call {
        Canon::UserCode(..) => Some(Reach::Everything),
        Canon::Stop(_)
        | Canon::Log(_)
        | Canon::DigitalOutput { .. }
        | Canon::AnalogOutput { .. }
        | Canon::WaitInput { .. } => Some(Reach::Itself),
        _ => None,
    }
}

/// What a call does apart from moving. Calls that a [`crate::Motion`] or the modal state holds, and texts that do not stop the program, have
/// none. `mm`: per unit of lengths; `speed_unit`: m/min or 1/min per unit of S.
#[expect(
    clippy::too_many_lines,
    reason = "one row for each canonical call, so that a new one must be sorted in"
)]
fn effect(call: &Canon, mm: f64, speed_unit: f64) -> Option<Effect> {
    Some(match call {
        Canon::MotionMode(mode) => Effect::set(
            "path-control",
            match mode {
                MotionMode::ExactPath => vec![Argument::code("G61")],
                MotionMode::ExactStop => vec![Argument::code("G61.1")],
                MotionMode::Continuous(tolerance) => {
                    vec![Argument::code("G64"), Argument::number("P", *tolerance * mm)]
                }
            },
        ),
        Canon::NaiveCamTolerance(tolerance) => Effect::set("path-control Q", [Argument::number("Q", *tolerance * mm)]),
        Canon::SpindleMode(spindle, ceiling) => Effect::set(
            key("speed mode", *spindle),
            if *ceiling == 0.0 {
                Vec::new()
            } else {
                vec![Argument::number("D", *ceiling)]
            },
        ),
        Canon::SpindleSpeed(spindle, speed) => {
            Effect::set(key("speed", *spindle), [Argument::number("S", *speed * speed_unit)])
        }
        Canon::Spindle(spindle, turn) => Effect::set(
            key("spindle", *spindle),
            [Argument::code(match turn {
                SpindleTurn::Clockwise => "M3",
                SpindleTurn::CounterClockwise => "M4",
                SpindleTurn::Stop => "M5",
            })],
        ),
        Canon::OrientSpindle(spindle, angle, direction) => Effect::set(
            key("spindle", *spindle),
            [
                Argument::code("M19"),
                Argument::number("R", *angle),
                count("P", *direction),
            ],
        ),
        Canon::WaitOrient(spindle, seconds) => Effect::Event(vec![
            count("wait for orientation", *spindle),
            Argument::number("Q", *seconds),
        ]),
        Canon::Coolant(coolant) => match coolant {
            Coolant::MistOn => Effect::set("mist coolant", on(true)),
            Coolant::MistOff => Effect::set("mist coolant", on(false)),
            Coolant::FloodOn => Effect::set("flood coolant", on(true)),
            Coolant::FloodOff => Effect::set("flood coolant", on(false)),
        },
        Canon::SelectTool(tool) => Effect::set("tool prepared", [count("T", *tool)]),
        Canon::ChangeTool { tool, .. } | Canon::ChangeToolNumber { tool, .. } => {
            Effect::set("tool in use", [count("T", *tool)])
        }
        Canon::SetToolEntry(row, entry) => {
            let mut words = vec![
                count("G10 L1", *row),
                count("T", entry.number),
                count("P", entry.pocket),
                Argument::number("D", entry.diameter),
                Argument::number("I", entry.front_angle),
                Argument::number("J", entry.back_angle),
                count("Q", entry.orientation),
            ];
            let letters = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];
            words.extend(
                letters
                    .iter()
                    .zip(entry.offset)
                    .map(|(letter, value)| Argument::number(*letter, value)),
            );
            Effect::Event(words)
        }
        Canon::ReloadTools => Effect::Event(vec![Argument::code("G10 L0")]),
        Canon::Switch(switch, is_on) => {
            let name: Cow<'static, str> = match switch {
                Switch::FeedOverride => "feed override".into(),
                Switch::SpeedOverride(spindle) => key("speed override", *spindle),
                Switch::AdaptiveFeed => "adaptive feed".into(),
                Switch::FeedHold => "feed hold".into(),
            };
            Effect::set(name, [Argument::code(if *is_on { "on" } else { "off" })])
        }
        Canon::DigitalOutput { index, on, with_motion } => Effect::Event(vec![
            Argument::code(match (with_motion, on) {
                (true, true) => "M62",
                (true, false) => "M63",
                (false, true) => "M64",
                (false, false) => "M65",
            }),
            count("P", *index),
        ]),
        Canon::AnalogOutput {
            index,
            value,
            with_motion,
        } => Effect::Event(vec![
            Argument::code(if *with_motion { "M67" } else { "M68" }),
            count("E", *index),
            Argument::number("Q", *value),
        ]),
        Canon::WaitInput {
            index,
            analog,
            until,
            timeout,
        } => Effect::Event(vec![
            Argument::code("M66"),
            count(if *analog { "E" } else { "P" }, *index),
            count("L", *until),
            Argument::number("Q", *timeout),
        ]),
        Canon::OwnCodes(codes) => {
            let mut words: Vec<Argument> = codes.iter().map(|code| Argument::code(code.to_string())).collect();
            words.sort_by(|a, b| a.name.cmp(&b.name));
            Effect::Event(words)
        }
        Canon::UserCode(number, p, q) => Effect::Event(vec![
            Argument::code(format!("M{number}")),
            Argument::number("P", *p),
            Argument::number("Q", *q),
        ]),
        Canon::Stop(Stop::Program) => Effect::Event(vec![Argument::code("M0")]),
        Canon::Stop(Stop::Optional) => Effect::Event(vec![Argument::code("M1")]),
        Canon::Stop(Stop::End) => Effect::End(vec![Argument::code("M2")]),
        Canon::Finish => Effect::End(vec![Argument::code("%")]),
        Canon::PalletShuttle => Effect::Event(vec![Argument::code("pallet shuttle")]),
        Canon::Message(text) => Effect::set("message", [Argument::text("MSG", &String::from_utf8_lossy(text))]),
        Canon::Log(text) => Effect::Event(vec![Argument::text("LOG", &String::from_utf8_lossy(text))]),
        // files that the control writes
        Canon::Comment(text) if is_probe_file(text) => Effect::Event(vec![Argument::text(
            "",
            &String::from_utf8_lossy(text).to_ascii_uppercase(),
        )]),
        Canon::Probe(kind, _) => Effect::Event(vec![Argument::code(format!("G38.{kind}"))]),
        Canon::StartSync(synced) if !synced.velocity => {
            Effect::set("cycle", [Argument::number("synchronised", synced.per_revolution * mm)])
        }
        Canon::StopSync => Effect::set("cycle", []),
        Canon::StartChange
        | Canon::StartSync(_)
        | Canon::Units(_)
        | Canon::G5xOffset(..)
        | Canon::G92Offset(_)
        | Canon::XyRotation(_)
        | Canon::FeedReference
        | Canon::Reset
        | Canon::Plane(_)
        | Canon::Comment(_)
        | Canon::Print(_)
        | Canon::FeedRate(_)
        | Canon::FeedMode(..)
        | Canon::Traverse(_)
        | Canon::Feed(_)
        | Canon::Arc { .. }
        | Canon::Nurbs { .. }
        | Canon::ProbeResult
        | Canon::RigidTap(..)
        | Canon::Dwell(_)
        | Canon::ToolOffset(_) => return None,
    })
}
