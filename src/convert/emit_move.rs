//! The words of one motion.
use crate::OrientationWords;
use crate::Refused;
use crate::clamps::Step;
use crate::emit_code::{WORDS, Writer};
use crate::number::{number, significant};
use crate::plan::{Move, Shape};
use crate::post::ArcWords;
use crate::template::fill;
use trunnion_geometry::{Vec3, arc::Arc, deg};
use trunnion_interp::{AXIS_LETTERS, Feed};
use trunnion_machine::{AxisKind, Machine};
use trunnion_syntax::BlockId;

/// Planes by their normal: code, letters of the centre, index of the two axes.
const PLANES: [(&str, [char; 2], [usize; 2]); 3] = [
    ("G19", ['J', 'K'], [1, 2]),
    ("G18", ['I', 'K'], [0, 2]),
    ("G17", ['I', 'J'], [0, 1]),
];

impl Writer<'_> {
    pub(crate) fn length(&self, mm: f64) -> String {
        let inch = self.options.units == crate::Units::Inch;
        let decimals = self.post.length[usize::from(inch)];
        number(mm / self.options.units.mm(), decimals, self.post.point)
    }

    /// A rapid of which only these words are known, and whether the tip is guided and a tool length is active in it.
    pub(crate) fn plain_rapid(
        &mut self,
        known: &[(usize, f64)],
        (led, length): (bool, bool),
        block: BlockId,
    ) -> Result<(), Refused> {
        if led {
            self.get_ready(block)?;
        } else if length {
            self.length_on(block)?;
        } else {
            self.not_ready()?;
            if known.iter().any(|(axis, _)| *axis == 2) {
                self.length_off(block)?;
            }
        }
        let code = if self.klartext { "L" } else { "G0" };
        let mut words: Vec<String> = self.modal.change("motion", code.to_owned()).into_iter().collect();
        let (first, mut turns) = (words.len(), 0);
        for (axis, value) in known {
            if self.stays & 1 << axis != 0 {
                continue;
            }
            let text = if (3..6).contains(axis) {
                number(*value, self.post.angle, self.post.point)
            } else {
                self.length(*value)
            };
            turns |= if *axis > 2 { 1 << axis } else { 0 };
            words.push(format!("{}{}", WORDS[*axis], self.signed(text)));
        }
        if self.klartext {
            self.modal.forget("motion");
            words.push("FMAX".to_owned());
        }
        self.join_length(&mut words, first);
        self.clamp(Step::Motion { turns, cuts: false }, block)?;
        self.line(&words.join(" "));
        self.moved.push(self.lines);
        self.forget_coordinates();
        Ok(())
    }

    /// G17, where an arc has left another plane in effect: a tool's length and cycles follow the plane on some controls.
    pub(crate) fn usual_plane(&mut self) -> Option<String> {
        let usual = PLANES[2].0.to_owned();
        std::mem::take(&mut self.off_plane).then(|| {
            self.modal.set("plane", usual.clone());
            usual
        })
    }

    pub(crate) fn one(&mut self, one: &Move, block: BlockId) -> Result<(), Refused> {
        if self.klartext {
            return self.sentence(one, block);
        }
        let mut words: Vec<String> = Vec::new();
        self.feed_mode(one, &mut words, block)?;
        let arc = match one.shape {
            Shape::Arc(arc) => Some(arc),
            Shape::Rapid | Shape::Line => None,
        };
        let axis = arc.map(|arc| (0..3).find(|axis| arc.normal[*axis].abs() > 0.5).unwrap_or(2));
        if let Some(axis) = axis {
            words.extend(self.modal.change("plane", PLANES[axis].0.to_owned()));
            self.off_plane = axis != 2;
        } else {
            words.extend(self.usual_plane());
        }
        let code = match (one.shape, arc.zip(axis)) {
            (Shape::Rapid, _) => "G0",
            (_, Some((arc, axis))) if arc.sweep * arc.normal[axis] < 0.0 => "G2",
            (_, Some(_)) => "G3",
            _ => "G1",
        };
        words.extend(self.modal.change("motion", code.to_owned()));
        let before = words.len();
        let turns = self.coordinates(one, axis, &mut words);
        if words.len() == before {
            // nothing changes: a word makes it a motion
            let axis = (0..3).find(|axis| self.stays & 1 << axis == 0).unwrap_or(0);
            words.push(format!("{}{}", WORDS[axis], self.length(one.xyz[axis])));
        }
        if let Some((arc, axis)) = arc.zip(axis) {
            self.arc_words(&arc, axis, &mut words);
        } else {
            self.join_length(&mut words, before);
        }
        if let Some(length) = self.length_waits.take() {
            self.line(&length);
        }
        self.feed(one, &mut words);
        let cuts = one.shape != Shape::Rapid;
        self.clamp(Step::Motion { turns, cuts }, block)?;
        let line = words.join(" ");
        self.line(&line);
        self.moved.push(self.lines);
        Ok(())
    }

    /// The words of the axes that changed; bit per axis other than X Y Z that they may turn or shift.
    pub(crate) fn coordinates(&mut self, one: &Move, arc_axis: Option<usize>, words: &mut Vec<String>) -> u16 {
        let mut turns = 0;
        for (axis, word) in WORDS.into_iter().enumerate().take(3) {
            let text = format!("{word}{}", self.signed(self.length(one.xyz[axis])));
            if self.stays & 1 << axis != 0 {
                continue;
            }
            if arc_axis.is_some_and(|normal| normal != axis) {
                // the plane's coordinates are always there
                self.modal.forget(word);
            }
            words.extend(self.modal.change(word, text));
        }
        if let Some(machine) = self.mode.machine() {
            let slot = |joint: usize| {
                AXIS_LETTERS
                    .iter()
                    .position(|known| *known == machine.axes[joint].letter)
            };
            let rotary = machine.rotary.iter().enumerate();
            let mut rotary: Vec<_> = rotary
                .filter_map(|(index, &joint)| Some((slot(joint)?, index)))
                .collect();
            rotary.sort_unstable();
            for (slot, index) in rotary {
                let value = deg(one.q[index]) - self.zero[slot];
                let text = self.signed(number(value, self.post.angle, self.post.point));
                let text = format!("{}{text}", WORDS[slot]);
                let news = self.modal.change(WORDS[slot], text);
                turns |= u16::from(news.is_some()) << slot;
                words.extend(news);
            }
            turns |= self.idle_words(machine, words);
        } else if self.options.orientation == OrientationWords::Vectors {
            let part = |value: f64| number(value, self.post.vector, self.post.point);
            let template = self.post.template("vector").unwrap_or_default();
            let text = fill(template, |name| match name {
                "i" => Some(part(one.axis.x)),
                "j" => Some(part(one.axis.y)),
                "k" => Some(part(one.axis.z)),
                _ => None,
            });
            // arcs keep the vector: their I J K are the centre
            if arc_axis.is_none() {
                let news = self.modal.change("vector", text.unwrap_or_default());
                if news.is_some() {
                    // the control decides which axes turn
                    turns = u16::MAX;
                }
                words.extend(news);
            }
        }
        turns
    }

    /// Axes that the kinematics are not solved for are where the plan holds them: at `hold`, or at zero. A program must say so once.
    fn idle_words(&mut self, machine: &Machine, words: &mut Vec<String>) -> u16 {
        let mut said = 0;
        for (joint, axis) in machine.axes.iter().enumerate() {
            let slot = AXIS_LETTERS.iter().position(|known| *known == axis.letter);
            let Some(slot) = slot.filter(|slot| *slot > 2 && !machine.rotary.contains(&joint)) else {
                continue;
            };
            let text = match axis.kind {
                AxisKind::Linear => self.length(-self.zero[slot]),
                AxisKind::Rotary => {
                    let value = deg(axis.extra.hold.unwrap_or(0.0)) - self.zero[slot];
                    number(value, self.post.angle, self.post.point)
                }
            };
            let text = format!("{}{}", WORDS[slot], self.signed(text));
            let news = self.modal.change(WORDS[slot], text);
            said |= u16::from(news.is_some()) << slot;
            words.extend(news);
        }
        said
    }

    fn arc_words(&self, arc: &Arc, axis: usize, words: &mut Vec<String>) {
        let (_, letters, axes) = PLANES[axis];
        let radius = arc.radius_start;
        let minor = arc.sweep.abs() < 3.0;
        if self.post.arc == ArcWords::Radius && minor {
            let text = self.length(radius);
            let template = self.post.template("arc-radius").unwrap_or("R{radius}");
            words.extend(fill(template, |name| (name == "radius").then(|| text.clone())));
            return;
        }
        let centre: Vec3 = arc.centre - arc.start;
        for (letter, axis) in letters.iter().zip(axes) {
            words.push(format!("{letter}{}", self.length(centre[axis])));
        }
    }

    /// The code of another meaning of F, where it changes.
    fn feed_mode(&mut self, one: &Move, words: &mut Vec<String>, block: BlockId) -> Result<(), Refused> {
        let key = match one.feed {
            Feed::PerMinute(_) => "feed-per-minute",
            Feed::PerRevolution(_) => "feed-per-revolution",
            Feed::InverseTime(_) => "feed-inverse-time",
            Feed::Rapid | Feed::Unknown => return Ok(()),
        };
        let Some(code) = self.post.template(key) else {
            return Err(self.refuse(
                Some(block),
                format!("the post for {} has no `{key}`", self.post.dialect),
            ));
        };
        if let Some(code) = self.modal.change("mode", code.to_owned()) {
            self.modal.forget("F");
            words.push(code);
        }
        Ok(())
    }

    pub(crate) fn feed(&mut self, one: &Move, words: &mut Vec<String>) {
        let (point, unit) = (self.post.point, self.options.units.mm());
        let text = match one.feed {
            Feed::PerMinute(feed) => number(feed / unit, self.post.feed, point),
            Feed::PerRevolution(feed) => number(feed / unit, self.post.feed_per_revolution, point),
            Feed::InverseTime(feed) => {
                // each block needs its own
                self.modal.forget("F");
                significant(feed, self.post.inverse_time_digits, point)
            }
            Feed::Rapid | Feed::Unknown => return,
        };
        words.extend(self.modal.change("F", format!("F{text}")));
    }
}
