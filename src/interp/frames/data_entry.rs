//! G10: offsets that the program writes.
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{FaultKind, Refusal, Setup, Undeclared};
use trunnion_dialect::Action;

/// What G10 L10 to L13 have written for one number; mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ToolOffset {
    /// L10.
    pub(crate) length: Option<f64>,
    /// L11.
    pub(crate) length_wear: f64,
    /// L12.
    pub(crate) radius: Option<f64>,
    /// L13.
    pub(crate) radius_wear: f64,
    /// Whether L12 or L13 wrote a diameter or a radius is a setting.
    pub(crate) radius_unclear: bool,
}

/// Values of a work offset, mm and degrees; zero where they are not known.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) struct OffsetValues {
    /// In the order of [`crate::AXIS_LETTERS`].
    pub(crate) values: [f64; 9],
    /// Axes that are declared or that the program has written, bits as in [`crate::Position::known`].
    pub(crate) known: u16,
}

impl OffsetValues {
    /// All of them are known.
    pub(crate) fn declared(values: [f64; 9]) -> Self {
        let known = Undeclared::ALL_ZEROS;
        Self { values, known }
    }
}

impl crate::frames::Frames {
    /// The program writes a work offset, which need not come into force.
    pub(crate) fn remember_offset(&mut self, name: &str, zero: OffsetValues) {
        let written = &mut self.written;
        match written.iter_mut().find(|(known, _)| **known == *name) {
            Some(known) => known.1 = zero,
            None => written.push((name.into(), zero)),
        }
    }

    /// Values of a work offset: written by the program, else declared.
    pub(crate) fn offset_values(&self, name: &str, setup: &Setup) -> Option<OffsetValues> {
        let same = |known: &str| known.eq_ignore_ascii_case(name);
        let written = self.written.iter().find(|(known, _)| same(known));
        let declared = || setup.work_offset(name);
        match written {
            Some((_, zero)) => Some(*zero),
            None => declared().map(|offset| OffsetValues::declared(offset.values)),
        }
    }
}

impl<'d> Iso<'d> {
    /// What the program has written for a number.
    pub(crate) fn tool_offset(&self, number: u32) -> Option<&ToolOffset> {
        self.memory.frames.tool_offsets.get(&number)
    }

    /// G10 with its L: 2 and 20 work offsets, 10 to 13 tool offsets, 50 and 52 parameters until G11.
    pub(crate) fn data_entry(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        block.takes_coordinates = true;
        let unread = words.axes.unread != 0 || matches!(words.p, WordValue::Unread);
        let (l, p) = (words.letter(b'L').index(), words.p.index());
        match (l, p) {
            (Some(2), Some(0..=6)) if !unread => self.write_offset(words, p.unwrap_or(0), false),
            (Some(20), Some(1..=300)) if !unread && self.additional_offsets().is_some() => {
                self.write_offset(words, p.unwrap_or(1), true);
            }
            (Some(10..=13), Some(number)) if words.radius.number().is_some() => {
                self.write_tool(l.unwrap_or(10), number, words, found, report);
            }
            (Some(50..=52), _) => {
                self.memory.frames.entering_data = true;
                self.unclear_entry(found, words, block, report);
            }
            (Some(2), Some(number)) if number > 6 => {
                let alarm = self
                    .core
                    .dialect
                    .alarm("data-entry-l")
                    .map(|alarm| alarm.number.clone());
                let message = format!("G10 L2 P{number}: P names a work offset, 0 to 6 (1 is G54)");
                report.fault(
                    found.range,
                    FaultKind::Rejected {
                        refusal: Refusal::Other,
                        message,
                        alarm,
                    },
                );
            }
            _ => self.unclear_entry(found, words, block, report),
        }
    }

    fn unclear_entry(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
        let l = words.letter(b'L').index();
        let what = l.map_or_else(|| found.code.id.clone(), |l| format!("{} L{l}", found.code.id));
        report.fault(found.range, FaultKind::NotModelled { what });
        self.frame_begins(found, words, block);
    }

    /// The code that selects additional work offsets by P: G54.1, G154.
    pub(crate) fn additional_offsets(&self) -> Option<&'d str> {
        let codes = self.core.dialect.codes();
        let code = codes.iter().find(|code| {
            code.action == Action::WorkOffset && code.words.iter().any(|word| word == "P") && code.id != "G54"
        })?;
        Some(&code.id)
    }

    fn write_offset(&mut self, words: &Words, p: u32, additional: bool) {
        let name = match (additional, p) {
            (true, p) => self.additional_offsets().map(|code| format!("{code} P{p}")),
            (false, 0) => None,
            (false, p) => Some(format!("G{}", 53 + p)),
        };
        let mut zero = match &name {
            Some(name) => self.offset_values(name).unwrap_or_default(),
            None => OffsetValues {
                values: self.memory.frames.external,
                known: self.memory.frames.external_written,
            },
        };
        for (axis, kept) in zero.values.iter_mut().enumerate() {
            if let Some(value) = self.axis_value(words, axis) {
                if self.core.state.coordinates.incremental() {
                    *kept += value;
                } else {
                    *kept = value;
                    zero.known |= 1 << axis;
                }
            }
        }
        if let Some(name) = name {
            self.store_offset(&name, zero);
        } else {
            self.memory.frames.external = zero.values;
            self.memory.frames.external_written = zero.known;
            self.refresh_zero();
        }
    }

    /// The program writes a work offset; it acts at once if it is active.
    pub(crate) fn store_offset(&mut self, name: &str, zero: OffsetValues) {
        self.memory.frames.remember_offset(name, zero);
        let in_force = match self.core.state.zero.offset() {
            Some(known) => known.eq_ignore_ascii_case(name),
            None => self.core.dialect.quirks.first_offset_at_start && name == "G54",
        };
        if in_force {
            self.set_zero(Some(name.into()), zero);
        }
    }

    /// Values of a work offset: written by the program, else declared.
    pub(crate) fn offset_values(&self, name: &str) -> Option<OffsetValues> {
        self.memory.frames.offset_values(name, &self.core.setup)
    }

    fn write_tool(&mut self, l: u32, number: u32, words: &Words, found: &Found<'d>, report: &mut Report<'_>) {
        let value = words.radius.number().map_or(0.0, |number| number.value) * self.core.state.coordinates.unit_mm();
        self.store_tool(l, number, value, self.core.state.coordinates.incremental());
        // a parameter of the control decides when the new length acts; after the next G43 or G49 it is certain
        let in_force = self.memory.length_offset == Some(number) && self.core.state.length.mm().is_some();
        if l <= 11 && in_force {
            let what = format!("{} of the active length offset", found.code.id);
            report.fault(found.range, FaultKind::NotModelled { what });
            if let Some(code) = self.core.dialect.g(490) {
                self.core.unknown.begin(code, true);
                self.core.forget_linear();
            }
        }
    }

    /// The program writes what L10 to L13 name of a tool offset, mm.
    pub(crate) fn store_tool(&mut self, l: u32, number: u32, value: f64, incremental: bool) {
        let add = |old: f64| if incremental { old + value } else { value };
        let declared = self.core.tools.data(Some(number)).and_then(|tool| tool.length_mm);
        let unclear = self.core.dialect.quirks.cutter_offset_ambiguous;
        let offset = self.memory.frames.tool_offsets.entry(number).or_default();
        match l {
            10 => offset.length = Some(add(offset.length.or(declared).unwrap_or(0.0))),
            11 => offset.length_wear = add(offset.length_wear),
            12 => offset.radius = Some(add(offset.radius.unwrap_or(0.0))),
            _ => offset.radius_wear = add(offset.radius_wear),
        }
        offset.radius_unclear |= unclear && l >= 12;
    }
}
