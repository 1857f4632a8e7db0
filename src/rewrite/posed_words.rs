//! The words of a program for other postures and turns: rotary words, and X Y Z where the control does not guide the tip.
use crate::slots::{Scheme, Slot, Slots, Styles, insert_word, slots, styles};
use crate::style::add_whole;
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_machine::{Joints, Machine, forward, inverse};
use trunnion_syntax::{BlockId, Decimal, Program, TextEdit};

/// A motion as programmed, and where it takes the machine.
#[derive(Clone, Debug)]
pub(crate) struct Move {
    /// Its block.
    pub block: BlockId,
    /// X Y Z and the two rotary axes (workpiece side first) as programmed at its end, mm and deg; none where unknown or missing.
    pub words: [Option<f64>; 5],
    /// Work offsets of the two rotary axes, deg; 0 in machine coordinates.
    pub rotary_zero: [f64; 2],
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// G91.
    pub incremental: bool,
    /// X Y Z are coordinates of the tip.
    pub tip_words: bool,
    /// Work offset or tool length are neither declared nor assumed.
    pub undeclared: bool,
    /// It only waits.
    pub rests: bool,
    /// Joints at its end, and the tool length, mm; none where unknown.
    pub joints: Option<(Joints, f64)>,
}

/// Writes postures into a program, motion by motion.
pub(crate) struct PosedWords<'a> {
    program: &'a Program,
    machine: &'a Machine,
    scheme: Scheme,
    styles: Styles,
    /// What is in effect after the last motion of the program after, file units and deg.
    current: [Option<f64>; 5],
    /// The block that was written last, and what its words were to say.
    last: Option<(BlockId, [Option<f64>; 5])>,
    edits: Vec<TextEdit>,
}

impl<'a> PosedWords<'a> {
    pub(crate) fn new(program: &'a Program, machine: &'a Machine) -> Self {
        let mut letters = [0; 2];
        for (slot, &joint) in letters.iter_mut().zip(&machine.rotary) {
            *slot = machine.axes[joint].letter;
        }
        let scheme = Scheme::Rotaries(letters);
        Self {
            program,
            machine,
            scheme,
            styles: styles(program, scheme),
            current: [None; 5],
            last: None,
            edits: Vec::new(),
        }
    }

    /// The edits, in the order of the text.
    pub(crate) fn finish(self) -> Vec<TextEdit> {
        self.edits
    }

    /// Writes a motion with the rotary joints `q` (rad) instead of those as written; `None`: as written. `Err`: why it cannot be written.
    pub(crate) fn add(&mut self, motion: &Move, q: Option<[f64; 2]>) -> Result<(), String> {
        if motion.rests {
            return Ok(());
        }
        let mut wanted = motion.words.map(|value| value.map(|value| value / motion.unit_mm));
        for (value, word) in wanted[3..].iter_mut().zip(&motion.words[3..]) {
            *value = *word;
        }
        let changes = match q {
            Some(q) => self.turned(motion, q, &mut wanted)?,
            None => false,
        };
        self.write(motion, &wanted, changes)?;
        self.current = wanted;
        Ok(())
    }

    /// Puts the words of other rotary joints into `wanted`; whether any differs.
    fn turned(&self, motion: &Move, q: [f64; 2], wanted: &mut [Option<f64>; 5]) -> Result<bool, String> {
        let Some((joints, length)) = motion.joints else {
            return Err("the position is unknown".into());
        };
        let mut posed = joints;
        let (mut changes, mut swaps) = (false, false);
        for (index, (&joint, &q)) in self.machine.rotary.iter().zip(&q).enumerate() {
            let turn = deg(q - joints[joint]);
            if turn.abs() < 1e-9 {
                continue;
            }
            changes = true;
            let word = motion.words[3 + index].ok_or("a rotary position is unknown")?;
            let whole = (turn / 360.0).round();
            if (turn - 360.0 * whole).abs() < 1e-6 {
                wanted[3 + index] = Some(word + 360.0 * whole);
                posed[joint] = joints[joint] + rad(360.0 * whole);
                continue;
            }
            swaps = true;
            let style = self.styles[3 + index].ok_or_else(|| self.never(3 + index))?;
            let value = parsed(&style.write(deg(q) - motion.rotary_zero[index], false))
                .ok_or_else(|| format!("{} has too many digits", self.scheme.name(3 + index)))?;
            wanted[3 + index] = Some(value);
            posed[joint] = rad(value + motion.rotary_zero[index]);
        }
        if swaps && !motion.tip_words {
            if motion.undeclared {
                return Err(
                    "without tool centre point control X Y Z of the other posture depend on work offset and tool length, which are not \
                     declared: declare them in trunnion.toml or take them as zero with --assume work-offset,tool-length"
                        .into(),
                );
            }
            let tip: Vec3 = forward(self.machine, &joints, length).tip;
            inverse(self.machine, &mut posed, &tip, length).ok_or("the linear axes cannot follow")?;
            for (index, letter) in b"XYZ".iter().enumerate() {
                let (Some(word), Some(joint)) = (motion.words[index], self.machine.joint(*letter)) else {
                    return Err(format!("{} is unknown", char::from(*letter)));
                };
                wanted[index] = Some((word + posed[joint] - joints[joint]) / motion.unit_mm);
            }
        }
        Ok(changes)
    }

    /// Edits that make the block say `wanted`.
    fn write(&mut self, motion: &Move, wanted: &[Option<f64>; 5], changes: bool) -> Result<(), String> {
        if let Some((_, said)) = self.last.as_ref().filter(|(block, _)| *block == motion.block) {
            // a cycle: its other motions follow from the same words
            return if !changes || said[3..] == wanted[3..] {
                Ok(())
            } else {
                Err("one block makes several motions, and its words cannot be changed for all of them".into())
            };
        }
        let view = self.program.block(motion.block);
        let carried = (0..5).any(|index| self.differs(index, wanted[index], self.current[index]));
        if !changes && !carried {
            self.last = Some((motion.block, *wanted));
            return Ok(());
        }
        let slots: Slots<'_> = slots(self.program, &view, self.scheme)?;
        let named = slots.iter().any(Option::is_some);
        if motion.incremental && named {
            return Err("coordinates are incremental (G91)".into());
        }
        let mut found = Vec::new();
        for index in 0..5 {
            let Some(value) = wanted[index] else { continue };
            match &slots[index] {
                Some(slot) if !self.differs(index, Some(slot.value), Some(value)) => {}
                Some(slot) => found.push(TextEdit {
                    range: slot.number,
                    new_text: self.text(index, value, Some(slot))?,
                }),
                None if self.differs(index, Some(value), self.current[index]) && self.current[index].is_some() => {
                    let text = self.text(index, value, None)?;
                    let edit = self
                        .scheme
                        .letter(index)
                        .and_then(|letter| insert_word(self.program, &view, letter, &text));
                    found.push(edit.ok_or_else(|| {
                        format!(
                            "{} is not written in the block, and there is no place to add it",
                            self.scheme.name(index)
                        )
                    })?);
                }
                None => {}
            }
        }
        found.sort_by_key(|edit| edit.range.start);
        self.edits.extend(found);
        self.last = Some((motion.block, *wanted));
        Ok(())
    }

    /// Whether two values of a coordinate differ as the program writes numbers.
    fn differs(&self, index: usize, a: Option<f64>, b: Option<f64>) -> bool {
        match (a, b) {
            (Some(a), Some(b)) => {
                let rounding = self.styles[index].map_or(0.0, |style| style.rounding());
                (a - b).abs() > 0.5 * rounding.min(1e-3)
            }
            _ => false,
        }
    }

    fn text(&self, index: usize, value: f64, slot: Option<&Slot<'_>>) -> Result<String, String> {
        if let Some(slot) = slot {
            let whole = ((value - slot.value) / 360.0).round();
            if index >= 3 && (value - slot.value - 360.0 * whole).abs() < 1e-9 {
                // the cast cannot overflow: rotary travel is limited to few turns
                if let Some(text) = add_whole(&slot.text, 360 * whole as i64) {
                    return Ok(text);
                }
            }
        }
        let style = self.styles[index].ok_or_else(|| self.never(index))?;
        Ok(style.write(value, slot.is_some_and(|slot| slot.text.starts_with('+'))))
    }

    fn never(&self, index: usize) -> String {
        format!("the program never writes {} as a plain number", self.scheme.name(index))
    }
}

fn parsed(text: &str) -> Option<f64> {
    Decimal::parse(text.as_bytes()).map(Decimal::to_f64)
}
