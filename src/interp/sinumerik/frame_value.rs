//! Frames as values: `F1=CTRANS(X,10):CROT(Z,30)`, `$P_PFRAME=F1`, `$P_UIFR[1]=CTRANS(X,200)`, `$P_UIFR[1,X,TR]=200`.
//!
//! A chain a:b takes a point that is given in b first through b, then through a. `$P_PFRAME` is what TRANS, ROT, SCALE and MIRROR set, and acts
//! at once; `$P_UIFR[n]` is the work offset n (1 to 4: G54 to G57, 5 to 99: G505 to G599), and acts when its code is programmed next. Between new
//! values of the offset in effect and its code it is not known which ones act: a motion there makes all further positions unknown.
//!
//! Sources: SINUMERIK ONE Programming Manual, 12/2019, p. 631; SINUMERIK 840D Programming Guide Advanced, 04.2000, 6-194, 6-216. In which
//! order several angles of CROT turn is machine data (10600, [control] frame_angles), and fine shifts and rotations of work offsets are not followed.
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::frames::{FrameValue, Linear, OffsetValues, ShiftParts, angles_of, by_traces};
use crate::iso::Iso;
use crate::offsets::Rewritten;
use crate::own::arguments;
use crate::reader::Reader;
use crate::words::Words;
use crate::{FaultKind, Motion, MotionKind};
use trunnion_geometry::Vec3;
use trunnion_syntax::{TextRange, Word};

/// Frames in one chain.
const LONGEST: usize = 64;

/// Where a written frame goes.
enum Target {
    /// A variable of the program.
    Variable,
    Programmable,
    /// The name of the work offset.
    Offset(String),
}

fn is_control_frame(name: &str) -> bool {
    let stem = name.split('[').next().unwrap_or_default().trim();
    stem.eq_ignore_ascii_case("$P_PFRAME") || stem.eq_ignore_ascii_case("$P_UIFR")
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `$P_PFRAME=`, `$P_UIFR[..]=`, or a variable of the type FRAME; false: another word.
    pub(crate) fn frame_word(&mut self, name: TextRange, word: &Word) -> bool {
        let text = self.text(name);
        let Some(own) = self.own.as_mut().filter(|own| !own.is_task) else {
            return false;
        };
        let is_frame = is_control_frame(&text) || own.scope.frames.contains_key(text.to_ascii_lowercase().as_str());
        if is_frame {
            self.words.has_values = true;
            own.written_frames.push((name, word.value_range));
        }
        is_frame
    }

    /// The same for a variable that is named like an address: `F1`.
    pub(crate) fn own_frame_word(&mut self, name: &[u8], word: &Word) -> bool {
        let key = String::from_utf8_lossy(name).to_ascii_lowercase();
        if !self
            .own
            .as_ref()
            .is_some_and(|own| own.scope.frames.contains_key(key.as_str()))
        {
            return false;
        }
        let range = TextRange::new(word.range.start, word.range.start + name.len() as u32);
        self.frame_word(range, word)
    }
}

impl Iso<'_> {
    /// Frames that a block writes; those that are not known make positions unknown from there on.
    pub(crate) fn write_frames(&mut self, words: &mut Words, report: &mut Report<'_>) {
        for (name, range) in std::mem::take(&mut self.memory.own.written_frames) {
            let (text, value) = (
                report.program.text(name).trim().to_owned(),
                report.program.text(range).into_owned(),
            );
            self.memory.own.changes += 1;
            self.memory.own.note_text(&text, &value);
            let whole = TextRange::new(name.start, range.end.max(name.end));
            if self.write_frame(&text, &value).is_none() {
                let what = format!("{text}={}", value.trim());
                report.fault(whole, FaultKind::NotModelled { what });
                let key = text.to_ascii_lowercase();
                match self.memory.own.scope.frames.get_mut(key.as_str()) {
                    Some(frame) => *frame = None,
                    None => words.writes_system = true,
                }
            }
        }
    }

    /// `None`: it is not known or not followed.
    fn write_frame(&mut self, name: &str, value: &str) -> Option<()> {
        let (stem, index) = match name.split_once('[') {
            Some((stem, index)) => (stem.trim(), Some(index.trim_end().strip_suffix(']')?)),
            None => (name, None),
        };
        let key = stem.to_ascii_lowercase();
        let parts = index.map(arguments).unwrap_or_default();
        if key == "$p_pframe" && parts.len() == 2 || key == "$p_uifr" && parts.len() == 3 {
            return self.write_component(&key, &parts, value);
        }
        let target = match (key.as_str(), parts.as_slice()) {
            ("$p_pframe", []) => Target::Programmable,
            ("$p_uifr", [number]) => Target::Offset(offset_name(whole(self.memory.own.value(number)?)?)),
            (_, []) => Target::Variable,
            _ => return None,
        };
        let frame = self.frame_chain(value)?;
        match target {
            Target::Variable => {
                *self.memory.own.scope.frames.get_mut(key.as_str())? = Some(frame);
                Some(())
            }
            Target::Programmable => self.set_programmable(frame),
            Target::Offset(_) if frame.turns() => None,
            Target::Offset(name) => {
                let mut values = [0.0; 9];
                values[..3].copy_from_slice(frame.shift.as_slice());
                self.write_offset_value(&name, OffsetValues::declared(values))
            }
        }
    }

    /// `$P_PFRAME[X,TR]=5`, `$P_UIFR[1,X,TR]=200`.
    fn write_component(&mut self, key: &str, parts: &[&str], value: &str) -> Option<()> {
        let [numbers @ .., axis, kind] = parts else { return None };
        let value = self.memory.own.value(value)?;
        let axis = axis_of(axis)?;
        let linear = crate::core::LINEAR & (1 << axis) != 0;
        if kind.eq_ignore_ascii_case("RT") && axis < 3 && key == "$p_pframe" {
            let mut frame = self.programmable();
            let parts = self.memory.frames.parts;
            let mut angles = angles_of(&frame.turn);
            angles[axis] = value;
            frame.turn = self.turn_of(angles.map(Some))?;
            self.set_programmable(frame)?;
            self.memory.frames.parts = parts;
            return Some(());
        }
        if !kind.eq_ignore_ascii_case("TR") || !linear {
            return None;
        }
        let value = value * self.core.state.coordinates.unit_mm();
        if key == "$p_pframe" {
            let mut frame = self.programmable();
            frame.shift[axis] = value;
            return Some(frame)
                .filter(|frame| !frame.fine)
                .and_then(|frame| self.set_programmable(frame));
        }
        let number = whole(self.memory.own.value(numbers.first()?)?)?;
        let name = offset_name(number);
        let mut values = self.offset_values(&name).unwrap_or_default();
        values.values[axis] = value;
        values.known |= 1 << axis;
        self.write_offset_value(&name, values)
    }

    /// The motions of a called cycle, and what is known of all those of the block.
    #[inline]
    pub(crate) fn called_motions(
        &mut self,
        codes: &[Found<'_>],
        words: &Words,
        block: &BlockCodes,
        motion: &mut Option<Motion>,
        report: &mut Report<'_>,
    ) {
        self.called_cycle(codes, words, block, motion, report);
        if self.memory.offset_open.is_some() {
            self.moves_in_open_offset(motion, report);
        }
    }

    /// At the end of a block: where a motion ends is unknown if the work offset in effect got new values and its code has not been programmed since.
    fn moves_in_open_offset(&mut self, motion: &mut Option<Motion>, report: &mut Report<'_>) {
        self.memory.offset_open = self.memory.offset_open.map(|_| Rewritten::Before);
        let counts = |motion: &Motion| !motion.machine_coordinates && !matches!(motion.kind, MotionKind::Dwell(_));
        if !self.memory.out.iter().chain(motion.as_ref()).any(counts) {
            return;
        }
        self.memory.offset_open = None;
        let what = "a motion after new values of the work offset in effect: which ones act (program its code, such as G54, before it)";
        report.fault(report.whole(), FaultKind::NotModelled { what: what.to_owned() });
        self.system_changed();
        let mut out = std::mem::take(&mut self.memory.out);
        for motion in out.iter_mut().chain(motion.as_mut()).filter(|motion| counts(motion)) {
            self.core.hide(motion);
        }
        self.memory.out = out;
    }

    /// A work offset that is in effect changes when it is programmed again; until then nothing says which one acts.
    fn write_offset_value(&mut self, name: &str, values: OffsetValues) -> Option<()> {
        let in_effect = self
            .core
            .state
            .zero
            .offset()
            .is_some_and(|known| known.eq_ignore_ascii_case(name));
        if self.memory.frames.tilt.is_some() {
            return None;
        }
        if in_effect {
            self.memory.offset_open = Some(Rewritten::Here);
        }
        self.memory.frames.remember_offset(name, values);
        Some(())
    }

    pub(crate) fn programmable(&self) -> FrameValue {
        let frames = &self.memory.frames;
        if let Some(tilt) = frames.tilt.filter(|tilt| tilt.programmed) {
            return FrameValue::new(tilt.turn, tilt.origin);
        }
        FrameValue {
            turn: frames.shape.linear.unwrap_or_default().matrix(),
            shift: Vec3::new(frames.local[0], frames.local[1], frames.local[2]),
            fine: frames.parts.has_fine(),
        }
    }

    pub(super) fn set_programmable(&mut self, frame: FrameValue) -> Option<()> {
        let plain = self.memory.frames.tilt.is_none_or(|tilt| tilt.programmed)
            && !self.core.unknown.any()
            && self.memory.frames.local[3..] == [0.0; 6];
        if !plain {
            return None;
        }
        if frame.turns() && self.needs_solid(&frame.turn) {
            return self.replace_solid(&frame).then_some(());
        }
        self.memory.frames.local[..3].copy_from_slice(frame.shift.as_slice());
        self.memory.frames.parts = ShiftParts::of_frame(frame.fine);
        self.replace_linear(Some(Linear::from_matrix(frame.turn)).filter(|_| frame.turns()));
        Some(())
    }

    /// `a:b:c`.
    fn frame_chain(&self, text: &str) -> Option<FrameValue> {
        let text = text.split(';').next()?.trim();
        let parts: Vec<&str> = links(text);
        if parts.len() > LONGEST {
            return None;
        }
        parts.into_iter().try_fold(FrameValue::default(), |chain, part| {
            Some(chain.then(&self.frame_link(part)?))
        })
    }

    fn frame_link(&self, text: &str) -> Option<FrameValue> {
        let key = text.to_ascii_lowercase();
        if let Some(frame) = self.memory.own.scope.frames.get(key.as_str()) {
            return *frame;
        }
        if key == "$p_pframe" {
            let plain = !self.core.unknown.any() && self.memory.frames.tilt.is_none_or(|tilt| tilt.programmed);
            return Some(self.programmable()).filter(|_| plain);
        }
        if let Some(number) = key.strip_prefix("$p_uifr[").and_then(|rest| rest.strip_suffix(']')) {
            let values = self.offset_values(&offset_name(whole(self.memory.own.value(number)?)?))?;
            let known = values.known & 0b111 == 0b111;
            let shift = Vec3::new(values.values[0], values.values[1], values.values[2]);
            let turns = values.values[3..].iter().any(|value| *value != 0.0);
            return (known && !turns).then_some(FrameValue {
                shift,
                ..FrameValue::default()
            });
        }
        let (name, inside) = text.split_once('(')?;
        let inside = inside.trim_end().strip_suffix(')')?;
        let parts: Vec<&str> = arguments(inside).into_iter().filter(|part| !part.is_empty()).collect();
        self.built_frame(&name.trim().to_ascii_uppercase(), &parts)
    }

    /// CTRANS, CFINE, CROT, CSCALE, CMIRROR with axes and values.
    fn built_frame(&self, name: &str, parts: &[&str]) -> Option<FrameValue> {
        let own = &self.memory.own;
        let mut frame = FrameValue::default();
        if name == "CMIRROR" {
            for part in parts {
                match axis_of(part) {
                    Some(axis) if axis < 3 => frame.turn[(axis, axis)] = -1.0,
                    // a value has no meaning
                    None if own.value(part).is_some() => {}
                    _ => return None,
                }
            }
            return Some(frame);
        }
        let mut named = Vec::new();
        for pair in parts.chunks(2) {
            let [axis, value] = pair else { return None };
            named.push((axis_of(axis).filter(|axis| *axis < 3)?, own.value(value)?));
        }
        match name {
            "CTRANS" | "CFINE" => {
                frame.fine = name == "CFINE";
                for (axis, value) in named {
                    frame.shift[axis] += value * self.core.state.coordinates.unit_mm();
                }
            }
            "CSCALE" => {
                for (axis, value) in named {
                    (value > 0.0).then_some(())?;
                    frame.turn[(axis, axis)] *= value;
                }
            }
            "CROT" | "CROTS" if named.is_empty() => {}
            "CROT" | "CROTS" => {
                let mut angles = [None; 3];
                for (axis, degrees) in named {
                    angles[axis] = Some(degrees);
                }
                frame.turn = match name {
                    "CROT" => self.turn_of(angles)?,
                    _ => by_traces(angles)?,
                };
            }
            _ => return None,
        }
        Some(frame)
    }
}

/// The links of a chain: the parts between colons outside of brackets.
fn links(text: &str) -> Vec<&str> {
    let (mut parts, mut deep, mut from) = (Vec::new(), 0i32, 0);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'(' | b'[' => deep += 1,
            b')' | b']' => deep -= 1,
            b':' if deep == 0 => {
                parts.push(text[from..at].trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(text[from..].trim());
    parts
}

fn axis_of(text: &str) -> Option<usize> {
    let &[letter] = text.trim().as_bytes() else { return None };
    crate::AXIS_LETTERS
        .iter()
        .position(|known| *known == letter.to_ascii_uppercase())
}

fn whole(value: f64) -> Option<u32> {
    (value.fract() == 0.0 && (1.0..=99.0).contains(&value)).then_some(value as u32)
}

/// The code of a settable frame: 1 to 4 are G54 to G57, 5 to 99 G505 to G599.
pub(super) fn offset_name(number: u32) -> String {
    match number {
        1..=4 => format!("G{}", 53 + number),
        _ => format!("G{}", 500 + number),
    }
}

/// The number of the settable frame of a code: the inverse of [`offset_name`].
fn offset_number(name: &str) -> Option<u32> {
    let number: u32 = name.strip_prefix(['G', 'g'])?.parse().ok()?;
    match number {
        54..=57 => Some(number - 53),
        505..=599 => Some(number - 500),
        _ => None,
    }
}

impl crate::frames::Frames {
    /// The settable frames that are written or declared: number and name.
    pub(super) fn offset_names<'a>(&'a self, setup: &'a crate::Setup) -> impl Iterator<Item = (u32, &'a str)> {
        let written = self.written.iter().map(|(name, _)| name.as_ref());
        let declared = setup.work_offsets.iter().map(|offset| offset.name.as_ref());
        written
            .chain(declared)
            .filter_map(|name: &str| Some((offset_number(name)?, name)))
    }
}
