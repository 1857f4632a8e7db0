//! Conditions, loops and subprograms of random programs.
use super::generate::{Program, number};

impl Program {
    pub(crate) fn condition(&mut self) {
        let label = self.next_label();
        let left = self.expression(2);
        let text = format!("o{label} if [{left} GT {}]", number(self.random.between(-5.0, 5.0)));
        self.line(&text);
        self.inner();
        if self.random.one_in(3) {
            let condition = self.expression(1);
            self.line(&format!("o{label} elseif [{condition} LT 1]"));
            self.inner();
        }
        if self.random.one_in(2) {
            self.line(&format!("o{label} else"));
            self.inner();
        }
        self.line(&format!("o{label} endif"));
    }

    pub(crate) fn repeated(&mut self) {
        let label = self.next_label();
        let turns = 1 + self.random.below(4);
        match self.random.below(3) {
            0 => {
                self.line(&format!("o{label} repeat [{turns}]"));
                self.inner();
                self.line(&format!("o{label} endrepeat"));
            }
            1 => {
                self.line("#3=0");
                self.line(&format!("o{label} while [#3 LT {turns}]"));
                self.inner();
                self.line("#3=[#3+1]");
                if self.random.one_in(4) {
                    let other = self.next_label();
                    let leave = self.random.pick(&["break", "continue"]);
                    self.line(&format!("o{other} if [#3 GT 1]"));
                    self.line(&format!("o{label} {leave}"));
                    self.line(&format!("o{other} endif"));
                }
                self.line(&format!("o{label} endwhile"));
            }
            _ => {
                self.line("#4=0");
                self.line(&format!("o{label} do"));
                self.inner();
                self.line("#4=[#4+1]");
                self.line(&format!("o{label} while [#4 LT {turns}]"));
            }
        }
    }

    pub(crate) fn subprogram(&mut self) {
        let label = self.next_label();
        self.line(&format!("o{label} sub"));
        self.line("G91 G1 X[#1/10] Y#2");
        self.line("G90");
        if self.random.one_in(3) {
            self.line(&format!("o{label} return [#1 * 2]"));
        }
        self.line("(debug, first #1 second #2)");
        self.line(&format!("o{label} endsub [#2 + 1]"));
        for _ in 0..=self.random.below(2) {
            let (a, b) = (self.expression(2), self.expression(2));
            self.line(&format!("o{label} call [{a}] [{b}]"));
        }
        self.line("(debug, value #<_value>)");
    }

    pub(crate) fn inner(&mut self) {
        if self.depth < 2 {
            self.depth += 1;
            match self.random.below(4) {
                0 => self.condition(),
                1 => self.line("#1=[#1+0.5]"),
                _ => self.straight(),
            }
            self.depth -= 1;
        }
    }

    pub(crate) fn next_label(&mut self) -> u32 {
        self.label += 1;
        self.label
    }
}
