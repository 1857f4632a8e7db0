//! Notable blocks in a picture: each rule has a colour and a shape, so that the picture reads in grey, too.
use crate::canvas::{Entry, GREEN, ORANGE, PURPLE, SKY, Swatch, VERMILION};
use crate::record::Mark;
use crate::scale::counted;
use plotters::prelude::RGBColor;
use std::collections::BTreeSet;

/// The outline of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    Circle,
    Square,
    Triangle,
    Diamond,
    Pentagon,
}

impl Shape {
    /// Its corners about the origin, `y` downwards; they lie on a circle of this radius.
    pub(crate) fn corners(self, radius: f64) -> Vec<(f64, f64)> {
        let (count, first) = match self {
            Self::Circle => (32, 0.0),
            Self::Square => (4, 45.0),
            Self::Triangle => (3, -90.0),
            Self::Diamond => (4, 0.0),
            Self::Pentagon => (5, 90.0),
        };
        (0..count)
            .map(|i| trunnion_geometry::rad(first + 360.0 * f64::from(i) / f64::from(count)))
            .map(|turn| {
                (
                    radius * trunnion_geometry::math::cos(turn),
                    radius * trunnion_geometry::math::sin(turn),
                )
            })
            .collect()
    }
}

/// Rules in the order of their looks.
const LOOKS: [(Shape, RGBColor); 5] = [
    (Shape::Circle, VERMILION),
    (Shape::Square, PURPLE),
    (Shape::Triangle, ORANGE),
    (Shape::Diamond, GREEN),
    (Shape::Pentagon, SKY),
];

/// A rule that is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Marked {
    pub(crate) rule: &'static str,
    pub(crate) shape: Shape,
    pub(crate) colour: RGBColor,
    count: usize,
}

/// The rules of the marks.
pub(crate) struct Rules {
    /// Most frequent first; as many as there are looks.
    pub(crate) drawn: Vec<Marked>,
    /// Marks of all other rules.
    left_out: usize,
}

impl Rules {
    pub(crate) fn of(marks: &[Mark]) -> Self {
        let mut counts: Vec<(&'static str, usize)> = Vec::new();
        for mark in marks {
            match counts.iter_mut().find(|(rule, _)| *rule == mark.rule) {
                Some((_, count)) => *count += 1,
                None => counts.push((mark.rule, 1)),
            }
        }
        counts.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(b.0)));
        let left_out = counts.iter().skip(LOOKS.len()).map(|(_, count)| count).sum();
        let drawn = counts.into_iter().zip(LOOKS);
        let drawn = drawn.map(|((rule, count), (shape, colour))| Marked {
            rule,
            shape,
            colour,
            count,
        });
        Self {
            drawn: drawn.collect(),
            left_out,
        }
    }

    /// Entries of the legend.
    pub(crate) fn entries(&self) -> Vec<Entry> {
        let drawn = self.drawn.iter().map(|marked| {
            let text = format!("{} ({})", marked.rule, marked.count);
            (Swatch::Symbol(marked.shape, marked.colour), text)
        });
        let rest = (self.left_out > 0).then(|| {
            let text = format!("{} of other rules not drawn", counted(self.left_out, "finding"));
            (Swatch::Plain, text)
        });
        drawn.chain(rest).collect()
    }
}

/// How many groups get a label.
const LABELS: usize = 24;

/// Marked lines that are seen in one place.
pub(crate) struct Group {
    /// Where the first of them is, in units of the sheet.
    place: (f64, f64),
    lines: BTreeSet<u32>,
}

impl Group {
    /// `line 12`, `lines 12, 14`, `lines 12, 14 and 3 more`.
    pub(crate) fn text(&self) -> String {
        const NAMED: usize = 3;
        let named: Vec<String> = self.lines.iter().take(NAMED).map(ToString::to_string).collect();
        let plural = if self.lines.len() > 1 { "s" } else { "" };
        let more = self.lines.len().saturating_sub(NAMED);
        let rest = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        format!("line{plural} {}{rest}", named.join(", "))
    }
}

/// Groups marks by where they are seen, so that those that cover each other share a label.
#[derive(Default)]
pub(crate) struct Groups(Vec<((f64, f64), Group)>);

impl Groups {
    /// Adds a line whose mark is drawn at `at` (a value) and `place` (on the sheet); marks nearer than `apart` are one group.
    pub(crate) fn add(&mut self, line: u32, at: (f64, f64), place: (f64, f64), apart: f64) {
        let near = |group: &Group| (group.place.0 - place.0).abs().max((group.place.1 - place.1).abs()) < apart;
        if let Some((_, group)) = self.0.iter_mut().find(|(_, group)| near(group)) {
            group.lines.insert(line);
            return;
        }
        if self.0.len() < LABELS {
            let lines = BTreeSet::from([line]);
            self.0.push((at, Group { place, lines }));
        }
    }

    /// The groups, each with the value at which its first mark stands.
    pub(crate) fn all(&self) -> impl Iterator<Item = &((f64, f64), Group)> {
        self.0.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::AxisLetters;

    fn marks(rules: &[&'static str]) -> Vec<Mark> {
        let mark = |(line, &rule): (u32, &&'static str)| Mark {
            line,
            rule,
            axes: AxisLetters::default(),
        };
        (1..).zip(rules).map(mark).collect()
    }

    #[test]
    fn the_most_frequent_rules_are_drawn_and_the_rest_is_counted() {
        let rules = Rules::of(&marks(&["b", "a", "b"]));
        let names: Vec<String> = rules.entries().into_iter().map(|(_, text)| text).collect();
        assert_eq!(names, ["b (2)", "a (1)"]);
        let rules = Rules::of(&marks(&["a", "a", "b", "b", "c", "c", "d", "d", "e", "e", "f", "g"]));
        let last = rules.entries().pop().expect("an entry").1;
        assert_eq!(
            (rules.drawn.len(), last.as_str()),
            (5, "2 findings of other rules not drawn")
        );
    }

    /// A picture in grey tells them apart, too.
    #[test]
    fn each_rule_has_a_shape_of_its_own() {
        for (at, (shape, colour)) in LOOKS.iter().enumerate() {
            for (other, second) in &LOOKS[..at] {
                assert!(shape != other && colour != second);
                assert_ne!(shape.corners(1.0).len(), 0);
            }
        }
    }

    #[test]
    fn marks_in_one_place_share_a_label() {
        let mut groups = Groups::default();
        for (line, x) in [
            (7, 0.0),
            (9, 3.0),
            (9, 3.0),
            (20, 100.0),
            (11, 1.0),
            (12, 2.0),
            (13, 4.0),
        ] {
            groups.add(line, (x, 0.0), (x, 0.0), 10.0);
        }
        let texts: Vec<String> = groups.all().map(|(_, group)| group.text()).collect();
        assert_eq!(texts, ["lines 7, 9, 11 and 2 more", "line 20"]);
    }
}
