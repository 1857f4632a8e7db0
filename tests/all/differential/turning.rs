//! Turning cycles of random programs: G70 to G72.2 with a contour in a subprogram.
use super::generate::{Program, number};

impl Program {
    pub(crate) fn turning(&mut self) {
        let label = self.next_label();
        self.line("G18 G90 G94 F100");
        self.say_one(&["G8", "G8", "G7"]);
        self.line(&format!("o{label} sub"));
        let (mut x, mut z) = (self.random.between(2.0, 8.0), self.random.between(-1.0, 2.0));
        self.line(&format!("G0 X{} Z{}", number(x), number(z)));
        for _ in 0..2 + self.random.below(4) {
            // details finer than the allowance are a world of their own
            let scale = if self.random.one_in(4) { 0.1 } else { 1.0 };
            let (dx, dz) = (
                self.random.between(0.0, 6.0) * scale,
                self.random.between(-9.0, -0.5) * scale,
            );
            let dx = if self.random.one_in(5) { -dx / 2.0 } else { dx };
            x += dx;
            z += dz;
            let (x, z) = (number(x), number(z));
            let corner = match self.random.below(9) {
                0 => format!(" A{}", number(self.random.between(0.1, 1.2))),
                1 => format!(" C{}", number(self.random.between(0.1, 1.2))),
                _ => String::new(),
            };
            let text = match self.random.below(9) {
                0 => format!("G1 U{} W{}{corner}", number(dx), number(dz)),
                1 => format!("G1 X{x} W{}{corner}", number(dz)),
                2 => format!("G1 Z{z}{corner}\nX{x}"),
                3 => format!("G3 X{x} Z{z} R{}", number(dx.hypot(dz) * 0.8)),
                4 => format!("G2 X{x} Z{z} R{}", number(dx.hypot(dz) * 1.2)),
                _ => format!("G1 X{x} Z{z}{corner}"),
            };
            self.line(&text);
        }
        self.line(&format!("o{label} endsub"));
        let code = self
            .random
            .pick(&["G70", "G71", "G71", "G71.1", "G71.2", "G72", "G72.1", "G72.2"])
            .to_owned();
        let (start_x, start_z) = (x + self.random.between(1.0, 20.0), self.random.between(3.0, 9.0));
        let mut text = format!("{code} Q{label} X{} Z{}", number(start_x), number(start_z));
        if code == "G70" {
            for (word, n) in [(" D{p}", 3), (" E0.2", 3), (" P{3}", 2)] {
                if self.random.one_in(n) {
                    text.push_str(&self.fill(word));
                }
            }
        } else {
            if self.random.one_in(3) {
                text.push_str(" D");
                text.push_str(&number(self.random.between(0.05, 0.8)));
            }
            for (word, n) in [(" I{p}", 2), (" R{p}", 2)] {
                if self.random.one_in(n) {
                    text.push_str(&self.fill(word));
                }
            }
        }
        self.line(&text);
        self.line("G8 G17");
        self.go();
    }
}
