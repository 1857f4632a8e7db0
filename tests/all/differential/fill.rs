//! Lines from patterns: `{..}` stands for a random value of a sort.
use super::generate::{Program, number};
use std::fmt::Write;

impl Program {
    /// Writes a line from a pattern.
    pub(crate) fn say(&mut self, pattern: &str) {
        let text = self.fill(pattern);
        self.line(&text);
    }

    /// Writes one of the lines, a pattern each.
    pub(crate) fn say_one(&mut self, patterns: &[&str]) {
        let pattern = self.random.pick(patterns).to_owned();
        self.say(&pattern);
    }

    /// Writes between one and `most` of the lines.
    pub(crate) fn say_some(&mut self, most: usize, patterns: &[&str]) {
        for _ in 0..=self.random.below(most) {
            self.say_one(patterns);
        }
    }

    /// The pattern with its values.
    pub(crate) fn fill(&mut self, pattern: &str) -> String {
        let mut text = String::new();
        let mut rest = pattern;
        while let Some((before, behind)) = rest.split_once('{') {
            let (sort, behind) = behind.split_once('}').unwrap_or((behind, ""));
            text.push_str(before);
            text.push_str(&self.value_of(sort));
            rest = behind;
        }
        text + rest
    }

    fn value_of(&mut self, sort: &str) -> String {
        match sort {
            // a coordinate, a coordinate near zero, a length
            "v" => number(self.random.between(-40.0, 40.0)),
            "w" => number(self.random.between(-3.0, 3.0)),
            // a thread of a million passes shows no more than one of a hundred, and takes long
            "degression" if self.random.one_in(8) => number(self.random.between(0.05, 9.0)),
            "degression" => number(self.random.between(0.05, 3.0)),
            "p" => number(self.random.between(0.05, 9.0)),
            // now and then an expression
            "e" => {
                let value = self.random.between(-20.0, 20.0);
                self.value(value)
            }
            "x" => self.expression(2),
            "angle" => number(self.random.between(-400.0, 400.0)),
            "feed" => number(self.random.between(1.0, 900.0)),
            "speed" => number(self.random.between(0.0, 5000.0)),
            // digits
            "i" => self.random.below(10).to_string(),
            "3" => self.random.below(3).to_string(),
            "system" => (1 + self.random.below(9)).to_string(),
            "spindle" => {
                let spindles = self.spindles;
                match self.random.below(8) {
                    0 => "-1".into(),
                    1 => spindles.to_string(),
                    _ => self.random.below(spindles).to_string(),
                }
            }
            "tool" if self.random.one_in(12) => self.random.below(30).to_string(),
            "tool" => {
                let place = self.random.below(self.tools.len());
                self.tools[place].to_string()
            }
            // some axis words of the plane, and any axes
            "xyz" => self.axes("XYZ", 2),
            "xz" => self.axes("XZ", 2),
            "axes" => self.axes("XYZABC", 3),
            other => panic!("the generator knows no value {other}"),
        }
    }

    /// Words of some of the letters, each once in `n`; at least one.
    fn axes(&mut self, letters: &str, n: usize) -> String {
        let mut text = String::new();
        for letter in letters.chars() {
            if self.random.one_in(n) {
                let value = self.random.between(-40.0, 40.0);
                _ = write!(text, "{letter}{} ", self.value(value));
            }
        }
        if text.is_empty() {
            let value = number(self.random.between(-40.0, 40.0));
            text = format!("{}{value}", &letters[..1]);
        }
        text
    }
}
