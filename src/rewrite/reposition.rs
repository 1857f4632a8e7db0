//! A tool pose turned about the rotary axis nearest the workpiece, in either posture, and written back into its block, the ball's centre
//! kept.
use crate::slots::{Scheme, Slot, Slots, Styles, insert_word, slots};
use crate::style::NumberStyle;
use trunnion_geometry::math::{angle_between, atan2};
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_machine::{Joints, Machine, POLE_TOLERANCE, Stance, forward};
use trunnion_syntax::{Block, BlockId, Program, TextEdit};

/// So many tilts are tried for a tool vector that lies on the pole and is to carry an azimuth.
const TILTS: u32 = 64;

/// What is the same for all points of a window.
pub(crate) struct Writer<'a> {
    /// The program.
    pub program: &'a Program,
    /// The machine.
    pub machine: &'a Machine,
    /// Which words are written.
    pub scheme: Scheme,
    /// How the program writes them.
    pub styles: Styles,
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// Distance of the ball's centre from the programmed point along the tool axis, mm.
    pub ball_radius: f64,
    /// Work offsets of the rotary axes, deg.
    pub rotary_zero: [f64; 2],
    /// The tool axis may turn by this much, deg.
    pub tolerance_deg: f64,
    /// The ball's centre may shift by this much, mm.
    pub tolerance_mm: f64,
}

/// A coordinate's new number: its text and the value of that text.
#[derive(Clone)]
struct Number {
    text: String,
    value: f64,
}

/// Where the rotary joints are to be at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// First rotary joint, rad.
    pub q: f64,
    /// The second one, rad, where the posture changes; `None`: as programmed.
    pub second: Option<f64>,
    /// On which side of the pole the second joint was before, where a tool vector at the pole is to carry an azimuth: 1 or -1.
    pub side: f64,
}

/// An orientation as it will be written.
struct Orientation {
    /// The tool axis of these numbers.
    axis: Vec3,
    /// The first rotary joint that gives it, rad.
    q: f64,
    /// Coordinate and number.
    numbers: Vec<(usize, Number)>,
}

impl Writer<'_> {
    /// Programmed coordinates of a stance as the file counts them: X, Y, Z in file units, then the rotary words.
    pub(crate) fn programmed(&self, stance: &Stance) -> [f64; 5] {
        let tip = stance.tip / self.unit_mm;
        [tip.x, tip.y, tip.z, self.word(stance, 0), self.word(stance, 1)]
    }

    /// The word of a rotary axis at a stance, deg.
    fn word(&self, stance: &Stance, axis: usize) -> f64 {
        let joint = self.machine.rotary.get(axis);
        joint.map_or(0.0, |&joint| deg(stance.joints[joint]) - self.rotary_zero[axis])
    }

    /// Writes the pose of `stance`, turned as `aim` says, into its block. `current` holds the coordinates
    /// in effect before the block in the program after, and those after it on return. Gives the first rotary joint that is
    /// written, rad: that of `aim` but for rounding.
    pub(crate) fn turn(
        &self,
        block: BlockId,
        stance: &Stance,
        aim: Aim,
        current: &mut [f64; 5],
        edits: &mut Vec<TextEdit>,
    ) -> Result<f64, String> {
        let view = self.program.block(block);
        let slots = slots(self.program, &view, self.scheme)?;
        let Orientation {
            axis,
            q,
            numbers: orientation,
        } = self.orientation(stance, aim, &slots)?;
        let tip = (stance.tip + (stance.axis - axis) * self.ball_radius) / self.unit_mm;
        let mut numbers: Vec<(usize, Number)> = Vec::new();
        for index in 0..3 {
            numbers.push((
                index,
                self.number(index, tip[index], slots[index].as_ref().map(|slot| &*slot.text))?,
            ));
        }
        let written = Vec3::new(numbers[0].1.value, numbers[1].1.value, numbers[2].1.value) * self.unit_mm;
        self.verify(stance, &written, &axis)?;
        numbers.extend(orientation);
        self.edit(&view, &slots, numbers, current, edits)?;
        Ok(q)
    }

    /// Makes the block contain the pose of `stance`, whatever was in effect before.
    pub(crate) fn restore(
        &self,
        block: BlockId,
        stance: &Stance,
        current: &mut [f64; 5],
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let view = self.program.block(block);
        let slots = slots(self.program, &view, self.scheme)?;
        let programmed = self.programmed(stance);
        // an active vector stays active; a rotary word may have to be repeated
        let words = if self.by_words() { 5 } else { 3 };
        let mut numbers = Vec::new();
        for (index, &value) in programmed.iter().enumerate().take(words) {
            match &slots[index] {
                Some(slot) => numbers.push((
                    index,
                    Number {
                        text: slot.text.to_string(),
                        value: slot.value,
                    },
                )),
                None => numbers.push((index, self.number(index, value, None)?)),
            }
        }
        self.edit(&view, &slots, numbers, current, edits)
    }

    /// Rotary words are written, not vectors.
    fn by_words(&self) -> bool {
        matches!(self.scheme, Scheme::Rotaries(_))
    }

    /// The orientation nearest to `aim` that can be written and is turned by no more than allowed.
    fn orientation(&self, stance: &Stance, aim: Aim, slots: &Slots<'_>) -> Result<Orientation, String> {
        if self.by_words() {
            return self.rotary_words(stance, aim, slots);
        }
        if stance.pole_angle > POLE_TOLERANCE {
            return self.vector(stance, &stance.joints, aim.q, slots);
        }
        // any small tilt carries the azimuth: the first one whose rounded components do, or else the best
        let mut best: Option<Orientation> = None;
        for part in 1..=TILTS {
            let tilt = 0.45 * rad(self.tolerance_deg) * f64::from(part) / f64::from(TILTS);
            let Some(joints) = self.beside_pole(stance, aim.side, tilt) else {
                continue;
            };
            let Ok(found) = self.vector(stance, &joints, aim.q, slots) else {
                continue;
            };
            let off = |one: &Orientation| (one.q - aim.q).abs();
            if best.as_ref().is_none_or(|best| off(&found) < off(best)) {
                best = Some(found);
            }
            if best.as_ref().is_some_and(|best| off(best) < rad(0.005)) {
                break;
            }
        }
        best.ok_or_else(|| "a tool vector on the pole has too few digits to carry an azimuth".into())
    }

    /// The tool vector nearest to the one of `joints` with the first rotary joint at `q`, rad.
    fn vector(&self, stance: &Stance, joints: &Joints, q: f64, slots: &Slots<'_>) -> Result<Orientation, String> {
        let at = |q: f64| {
            let mut joints = *joints;
            joints[self.machine.rotary[0]] = q;
            forward(self.machine, &joints, stance.tool_length).axis
        };
        let [Some(i), Some(j), Some(k)] = [&slots[3], &slots[4], &slots[5]] else {
            return Err("the block has no tool vector to turn".into());
        };
        let length = Vec3::new(i.value, j.value, k.value).norm();
        let wanted = at(q) * length;
        let choices =
            [(3, i), (4, j), (5, k)].map(|(index, slot)| self.neighbours(index, wanted[index - 3], Some(slot)));
        let [i, j, k] = choices;
        let (i, j, k) = (i?, j?, k?);
        let e = self.machine.axes[self.machine.rotary[0]].direction;
        let mut best: Option<(bool, f64, [&Number; 3], Vec3)> = None;
        for combination in 0..8usize {
            let numbers = [&i[combination & 1], &j[combination >> 1 & 1], &k[combination >> 2]];
            let vector = Vec3::from(numbers.map(|number| number.value));
            let norm = vector.norm();
            if norm <= 0.0 || (vector / norm).cross(&e).norm() <= POLE_TOLERANCE {
                continue;
            }
            let (out, off) = (!self.allowed_turn(stance, &(vector / norm)), (vector - wanted).norm());
            if best.as_ref().is_none_or(|best| (out, off) < (best.0, best.1)) {
                best = Some((out, off, numbers, vector / norm));
            }
        }
        let (_, _, numbers, axis) = best.ok_or("the tool vector would round to the pole or to zero")?;
        Ok(Orientation {
            axis,
            q: q + self.azimuth_between(&at(q), &axis),
            numbers: (3..).zip(numbers.map(Number::clone)).collect(),
        })
    }

    /// The rotary words nearest to `aim`.
    fn rotary_words(&self, stance: &Stance, aim: Aim, slots: &Slots<'_>) -> Result<Orientation, String> {
        let [first, second] = [self.machine.rotary[0], self.machine.rotary[1]];
        let mut joints = stance.joints;
        let other = match (aim.second, &slots[4]) {
            (Some(q), slot) => {
                let number = self.number(4, deg(q) - self.rotary_zero[1], slot.as_ref().map(|slot| &*slot.text))?;
                joints[second] = rad(number.value + self.rotary_zero[1]);
                number
            }
            (None, Some(slot)) => Number {
                text: slot.text.to_string(),
                value: slot.value,
            },
            (None, None) => self.number(4, self.word(stance, 1), None)?,
        };
        let at = |number: &Number| {
            let mut joints = joints;
            joints[first] = rad(number.value + self.rotary_zero[0]);
            forward(self.machine, &joints, stance.tool_length).axis
        };
        let wanted = deg(aim.q) - self.rotary_zero[0];
        let rank = |number: &Number| (!self.allowed_turn(stance, &at(number)), (number.value - wanted).abs());
        let best = self
            .neighbours(3, wanted, slots[3].as_ref())?
            .into_iter()
            .min_by(|a, b| {
                let (a, b) = (rank(a), rank(b));
                a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
            });
        let number = best.ok_or("not a number")?;
        Ok(Orientation {
            axis: at(&number),
            q: rad(number.value + self.rotary_zero[0]),
            numbers: vec![(3, number), (4, other)],
        })
    }

    /// Joints beside the pole for a tool vector on it, so that the vector says where the first rotary axis is: tilted by `tilt`, rad, to
    /// the side `side` of the second rotary axis.
    fn beside_pole(&self, stance: &Stance, side: f64, tilt: f64) -> Option<Joints> {
        let second = *self.machine.rotary.get(1)?;
        let tilted = |by: f64| {
            let mut joints = stance.joints;
            joints[second] += side * by;
            joints
        };
        let found = angle_between(
            &stance.axis,
            &forward(self.machine, &tilted(tilt), stance.tool_length).axis,
        );
        (found > 0.0).then(|| tilted(tilt * tilt / found))
    }

    /// By how much the rotary joint turns from one tool axis to a neighbouring one, rad.
    fn azimuth_between(&self, from: &Vec3, to: &Vec3) -> f64 {
        let axis = &self.machine.axes[self.machine.rotary[0]];
        let e = axis.direction;
        let (from, to) = (from - e * e.dot(from), to - e * e.dot(to));
        axis.sign * atan2(e.dot(&from.cross(&to)), from.dot(&to))
    }

    /// The tool axis is not turned farther than it may, with room for the last bit of a double.
    fn allowed_turn(&self, stance: &Stance, axis: &Vec3) -> bool {
        deg(angle_between(&stance.axis, axis)) <= self.tolerance_deg * (1.0 - 1e-9)
    }

    /// The numbers below and above `value` as the program writes coordinate `index`.
    fn neighbours(&self, index: usize, value: f64, was: Option<&Slot<'_>>) -> Result<[Number; 2], String> {
        let texts = self
            .style(index)?
            .neighbours(value, was.is_some_and(|slot| slot.text.starts_with('+')));
        let [low, high] = texts.map(|text| self.read(index, text));
        Ok([low?, high?])
    }

    fn style(&self, index: usize) -> Result<NumberStyle, String> {
        self.styles[index]
            .ok_or_else(|| format!("the program never writes {} as a plain number", self.scheme.name(index)))
    }

    fn read(&self, index: usize, text: String) -> Result<Number, String> {
        match trunnion_syntax::Decimal::parse(text.as_bytes()) {
            Some(value) => Ok(Number {
                text,
                value: value.to_f64(),
            }),
            None => Err(format!("{} has too many digits: {text}", self.scheme.name(index))),
        }
    }

    /// A number as the program writes coordinate `index`.
    fn number(&self, index: usize, value: f64, was: Option<&str>) -> Result<Number, String> {
        let text = self
            .style(index)?
            .write(value, was.is_some_and(|text| text.starts_with('+')));
        self.read(index, text)
    }

    /// The rounded pose keeps the claim.
    fn verify(&self, stance: &Stance, tip: &Vec3, axis: &Vec3) -> Result<(), String> {
        let turned = deg(angle_between(&stance.axis, axis));
        if !self.allowed_turn(stance, axis) {
            return Err(format!(
                "rounding turns the tool axis by {turned:.6} deg; {} deg is allowed",
                self.tolerance_deg
            ));
        }
        let shift = ((tip + axis * self.ball_radius) - (stance.tip + stance.axis * self.ball_radius)).norm();
        if shift > self.tolerance_mm {
            return Err(format!(
                "with the number of digits in this program the ball centre would shift by {shift:.6} mm; {} mm is allowed (--tolerance-mm)",
                self.tolerance_mm
            ));
        }
        Ok(())
    }

    /// Edits that make the block contain `numbers`: a number that differs is replaced, a missing word is inserted if another value is in effect.
    fn edit(
        &self,
        block: &Block<'_>,
        slots: &Slots<'_>,
        numbers: Vec<(usize, Number)>,
        current: &mut [f64; 5],
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let mut found = Vec::new();
        for (index, number) in numbers {
            match &slots[index] {
                Some(slot) if slot.value == number.value => {}
                Some(slot) => found.push(TextEdit {
                    range: slot.number,
                    new_text: number.text,
                }),
                None => {
                    let rounding = self.styles[index].map_or(0.0, |style| style.rounding());
                    if (number.value - current[index.min(4)]).abs() > 0.5 * rounding {
                        found.push(self.insertion(block, index, &number.text)?);
                    }
                }
            }
            if index < 3 || self.by_words() {
                current[index] = number.value;
            }
        }
        // insertions at one place stay in the order of the coordinates
        found.sort_by_key(|edit| edit.range.start);
        edits.extend(found);
        Ok(())
    }

    fn insertion(&self, block: &Block<'_>, index: usize, text: &str) -> Result<TextEdit, String> {
        let edit = self
            .scheme
            .letter(index)
            .and_then(|letter| insert_word(self.program, block, letter, text));
        edit.ok_or_else(|| {
            format!(
                "{} is not written in the block, and there is no place to add it",
                self.scheme.name(index)
            )
        })
    }
}
