//! Arcs, canned cycles and compensated contours of random programs.
use super::generate::{Program, number};
use core::fmt::Write;

impl Program {
    pub(crate) fn arc_by_centre(&mut self) {
        self.go();
        let (first, second, letters, axis, plane) = match self.random.below(3) {
            0 => (0, 1, ["X", "Y", "I", "J"], "Z", "G17"),
            1 => (2, 0, ["Z", "X", "K", "I"], "Y", "G18"),
            _ => (1, 2, ["Y", "Z", "J", "K"], "X", "G19"),
        };
        let radius = self.random.between(1.0, 30.0);
        let (from, sweep) = (self.random.between(0.0, 6.27), self.random.between(0.0, 6.27));
        let centre = [
            self.at[first] - radius * from.cos(),
            self.at[second] - radius * from.sin(),
        ];
        let end = [
            centre[0] + radius * (from + sweep).cos(),
            centre[1] + radius * (from + sweep).sin(),
        ];
        let mut text = format!("{plane} {}", self.random.pick(&["G2", "G3"]));
        let mut offset = [-radius * from.cos(), -radius * from.sin()];
        if self.random.one_in(5) {
            text.push_str(" G90.1");
            offset = centre;
        } else {
            text.push_str(" G91.1");
        }
        if self.random.one_in(6) {
            // a full circle has no end
        } else {
            let _ = write!(text, " {}{:.4} {}{:.4}", letters[0], end[0], letters[1], end[1]);
        }
        let _ = write!(text, " {}{:.4} {}{:.4}", letters[2], offset[0], letters[3], offset[1]);
        if self.random.one_in(3) {
            let _ = write!(text, " {axis}{}", number(self.random.between(-9.0, 9.0)));
        }
        if self.random.one_in(4) {
            let _ = write!(text, " P{}", 1 + self.random.below(3));
        }
        self.line(&text);
        self.line("G91.1");
        self.go();
    }

    pub(crate) fn arc_by_radius(&mut self) {
        self.go();
        let (dx, dy) = (self.random.between(-9.0, 9.0), self.random.between(-9.0, 9.0));
        let half = 0.5 * dx.hypot(dy);
        let factor = self.random.between(0.95, 3.0);
        let sign = if self.random.one_in(3) { "-" } else { "" };
        let code = self.random.pick(&["G2", "G3"]);
        let (x, y) = (self.at[0] + dx, self.at[1] + dy);
        self.line(&format!(
            "G17 {code} X{} Y{} R{sign}{:.4}",
            number(x),
            number(y),
            half * factor
        ));
    }

    pub(crate) fn cycle(&mut self) {
        self.go();
        let code = self
            .random
            .pick(&["G81", "G82", "G83", "G73", "G85", "G86", "G89", "G84", "G74"]);
        if !self.random.one_in(9) {
            self.line(if code == "G74" { "M4" } else { "M3" });
        }
        let (plane, along, others) = match self.random.below(4) {
            0 => ("G18", 'Y', ['X', 'Z']),
            1 => ("G19", 'X', ['Y', 'Z']),
            _ => ("G17", 'Z', ['X', 'Y']),
        };
        self.line(plane);
        if self.random.one_in(2) {
            let mode = self.random.pick(&["G98", "G99"]);
            self.line(mode);
        }
        let distance = self.random.pick(&["G90", "G90", "G91"]);
        let (bottom, r) = (self.random.between(-30.0, 0.0), self.random.between(0.0, 12.0));
        let mut text = format!("{distance} {code} {along}{} R{}", number(bottom), number(r));
        for axis in others {
            let _ = write!(text, " {axis}{}", number(self.random.between(-20.0, 20.0)));
        }
        if matches!(code, "G83" | "G73") {
            let _ = write!(text, " Q{}", number(self.random.between(1.5, 9.0)));
        }
        if matches!(code, "G82" | "G86" | "G89") {
            let _ = write!(text, " P{}", number(self.random.between(0.1, 3.0)));
        }
        if self.random.one_in(3) {
            let _ = write!(text, " L{}", 1 + self.random.below(3));
        }
        self.line(&text);
        for _ in 0..self.random.below(3) {
            let axis = others[self.random.below(2)];
            let value = number(self.random.between(-20.0, 20.0));
            self.line(&format!("{axis}{value}"));
        }
        self.line("G80");
        self.line("G90 G17");
    }

    /// A polyline with turns in both directions, now and then with arcs, under compensation.
    pub(crate) fn compensated(&mut self) {
        self.line("G17 G90");
        self.go();
        let radius = self.random.between(0.0, 3.0);
        let code = self.random.pick(&["G41.1", "G42.1"]);
        self.line(&format!("{code} D{}", number(radius * 2.0)));
        let mut heading = self.random.between(0.0, 6.27);
        let (mut x, mut y) = (self.at[0], self.at[1]);
        for step in 0..2 + self.random.below(6) {
            let length = self.random.between(4.0, 25.0);
            let arc = step > 0 && self.random.one_in(5);
            if arc {
                let r = self.random.between(4.0, 15.0);
                let left = self.random.one_in(2);
                let turn = self.random.between(0.3, 2.0) * if left { 1.0 } else { -1.0 };
                let side = if left { 1.0 } else { -1.0 };
                let (cx, cy) = (x - side * r * heading.sin(), y + side * r * heading.cos());
                let angle = (y - cy).atan2(x - cx) + turn;
                let (ex, ey) = (cx + r * angle.cos(), cy + r * angle.sin());
                let code = if left { "G3" } else { "G2" };
                self.line(&format!("{code} X{ex:.4} Y{ey:.4} I{:.4} J{:.4}", cx - x, cy - y));
                (x, y) = ((ex * 10000.0).round() / 10000.0, (ey * 10000.0).round() / 10000.0);
                heading += turn;
            } else {
                x += length * heading.cos();
                y += length * heading.sin();
                (x, y) = ((x * 1000.0).round() / 1000.0, (y * 1000.0).round() / 1000.0);
                let how = if self.random.one_in(8) { "G0" } else { "G1" };
                let deeper = if self.random.one_in(6) {
                    format!(" Z{}", number(self.random.between(-5.0, 5.0)))
                } else {
                    String::new()
                };
                self.line(&format!("{how} X{} Y{}{deeper}", number(x), number(y)));
            }
            if self.random.one_in(9) {
                let word = self.random.pick(&["M8", "F200", "(corner)", "Z1", "M9", "G4 P0.1"]);
                self.line(word);
            }
            heading += self.random.between(-2.4, 2.4);
        }
        self.line("G40");
        self.go();
    }
}
