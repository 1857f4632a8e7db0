//! Random LinuxCNC programs: mostly such as people write, some with a mistake.
use super::settings::Case;
use crate::random::Random;
use core::fmt::Write;

/// A program as it grows.
pub(crate) struct Program {
    pub(crate) random: Random,
    pub(crate) case: Case,
    /// Text after the end of the program.
    pub(crate) behind: String,
    /// Numbers of the tool table.
    pub(crate) tools: Vec<u32>,
    pub(crate) spindles: usize,
    /// Last O-word number.
    pub(crate) label: u32,
    /// Where the program is in X Y Z while that is known.
    pub(crate) at: [f64; 3],
    pub(crate) depth: u32,
}

/// A number as people write it.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The program of a seed.
pub(crate) fn program(seed: u64) -> Case {
    let mut program = Program {
        random: Random(seed.wrapping_mul(0x1000_0001)),
        case: Case::default(),
        behind: String::new(),
        // those of the table that rs274 takes without one
        tools: vec![1, 2, 3, 99_999],
        spindles: 1,
        label: 100,
        at: [0.0; 3],
        depth: 0,
    };
    program.settings();
    if program.random.one_in(4) {
        program.codes();
    } else {
        program.head();
        let parts = 2 + program.random.below(7);
        for _ in 0..parts {
            program.part();
        }
    }
    if program.random.one_in(12) {
        program.mistake();
    }
    if program.random.one_in(4) {
        program.spoil();
    }
    program.line(if seed.is_multiple_of(3) { "M30" } else { "M2" });
    let behind = core::mem::take(&mut program.behind);
    program.case.text.push_str(&behind);
    program.case
}

impl Program {
    pub(crate) fn line(&mut self, text: &str) {
        self.case.text.push_str(text);
        self.case.text.push('\n');
    }

    fn head(&mut self) {
        if self.random.one_in(4) {
            self.line("G20");
        }
        if self.random.one_in(3) {
            let plane = self.random.pick(&["G17", "G18", "G19"]);
            self.line(plane);
        }
        let feed = number(self.random.between(1.0, 900.0));
        let text = format!("G90 G94 F{feed} S{}", 100 + self.random.below(5000));
        self.line(&text);
        if self.random.one_in(2) {
            let spindle = self.random.pick(&["M3", "M4", "M3 M8", "M5"]);
            self.line(spindle);
        }
        for name in ["#1", "#2", "#<depth>", "#<_size>"] {
            let value = number(self.random.between(-5.0, 20.0));
            self.line(&format!("{name}={value}"));
        }
    }

    fn part(&mut self) {
        match self.random.below(42) {
            0..=3 => self.straight(),
            4..=5 => self.arc_by_centre(),
            6 => self.arc_by_radius(),
            7..=9 => self.cycle(),
            10..=12 => self.compensated(),
            13 => self.condition(),
            14 => self.repeated(),
            15 => self.subprogram(),
            16..=17 => self.offsets(),
            18 => self.modes(),
            19 => self.messages(),
            20 => self.spline(),
            21 => self.inverse_time(),
            22..=24 => self.tools(),
            25..=26 => self.compensated_by_tool(),
            27 => self.spindles(),
            28 => self.signals(),
            29..=30 => self.saved(),
            31 => self.probing(),
            32 => self.polar(),
            33..=34 => self.names(),
            35..=36 => self.systems(),
            37 => self.threads(),
            38 => self.splines(),
            39 => self.turning(),
            40 => self.called_file(),
            _ => self.numbered(),
        }
    }

    /// A value: mostly a number, else an expression of about that size.
    pub(crate) fn value(&mut self, value: f64) -> String {
        match self.random.below(9) {
            0 => format!("[{}+{}]", number(value - 1.5), number(1.5)),
            1 => format!("[{} - #1 + #1]", number(value)),
            2 => format!("[{}*2/2]", number(value)),
            3 => format!("[ABS[{}]]", number(value)),
            4 => self.expression(3),
            _ => number(value),
        }
    }

    pub(crate) fn expression(&mut self, depth: u32) -> String {
        if depth == 0 || self.random.one_in(4) {
            return match self.random.below(5) {
                0 => "#1".into(),
                1 => "#2".into(),
                2 => "#<depth>".into(),
                3 => "#<_size>".into(),
                _ => number(self.random.between(-9.0, 9.0)),
            };
        }
        match self.random.below(8) {
            0 => {
                let function = self
                    .random
                    .pick(&["ABS", "SIN", "COS", "TAN", "FIX", "FUP", "ROUND", "EXP", "ATAN1"]);
                let inner = self.expression(1);
                match function {
                    "EXP" => format!("EXP[{inner} / 10]"),
                    "ATAN1" => format!("ATAN[{inner}]/[1.5]"),
                    "TAN" => format!("TAN[FIX[{inner}] / 2]"),
                    _ => format!("{function}[{inner}]"),
                }
            }
            1 => format!("-{}", self.expression(depth - 1)),
            2 => format!("SQRT[ABS[{}]]", self.expression(depth - 1)),
            _ => {
                let operator = self.random.pick(&[
                    "+", "-", "*", "+", "-", " MOD ", " AND ", " OR ", " XOR ", " EQ ", " NE ", " GT ", " LE ", " LT ",
                    " GE ",
                ]);
                let left = self.expression(depth - 1);
                let right = if operator == " MOD " {
                    number(self.random.between(1.0, 7.0))
                } else {
                    self.expression(depth - 1)
                };
                format!("[{left}{operator}{right}]")
            }
        }
    }

    pub(crate) fn straight(&mut self) {
        for _ in 0..=self.random.below(4) {
            let mut text = self.random.pick(&["G0", "G1", "G1", "", "g 01", "N10 G0"]).to_owned();
            let mut any = false;
            for axis in ["X", "Y", "Z", "A", "B", "C"] {
                if self.random.one_in(if axis < "D" { 6 } else { 2 }) {
                    let value = self.random.between(-50.0, 50.0);
                    let value = self.value(value);
                    let blank = self.random.pick(&["", " "]);
                    let _ = write!(text, "{blank}{axis}{value}");
                    any = true;
                }
            }
            if any {
                self.line(&text);
            }
        }
        self.go();
    }

    /// A known place in X Y Z.
    pub(crate) fn go(&mut self) {
        self.at = [0.0; 3].map(|_: f64| (self.random.between(-40.0, 40.0) * 1000.0).round() / 1000.0);
        let [x, y, z] = self.at.map(number);
        let how = self.random.pick(&["G0", "G1"]);
        self.line(&format!("G90 {how} X{x} Y{y} Z{z}"));
    }

    fn offsets(&mut self) {
        let [a, b, c] = [0.0; 3].map(|_: f64| number(self.random.between(-30.0, 30.0)));
        let system = 1 + self.random.below(9);
        match self.random.below(14) {
            0 => self.line(&format!("G10 L2 P{system} X{a} Y{b} Z{c}")),
            1 => self.line(&format!("G10 L20 P{system} X{a} Z{c}")),
            2 => self.line(&format!("G10 L2 P{system} R{a}")),
            3 => self.line(&format!("G92 X{a} Y{b}")),
            4 => {
                let code = self.random.pick(&["G92.1", "G92.2", "G92.3"]);
                self.line(code);
            }
            5 => self.line(&format!("G52 X{a} Z{b}")),
            6 => self.line(&format!("G43.1 Z{c}")),
            7 => self.line("G49"),
            8 => self.line(&format!("G53 G0 X{a} Z{c}")),
            9 => {
                let code = self
                    .random
                    .pick(&["G28", "G30", "G28.1", "G30.1", "G28 X1 Y2", "G30 Z3"]);
                self.line(code);
            }
            10 => self.line(&format!("G10 L2 P0 X{a} A{b}")),
            11 => self.line(&format!("G43.2 X{a}")),
            _ => {
                let code = self
                    .random
                    .pick(&["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"]);
                self.line(code);
            }
        }
        self.line("(debug, #5220 #5221 #5222 #5223 #5211 #5213 #5420 #5421 #5422)");
        self.go();
    }

    fn modes(&mut self) {
        let words = [
            "G20",
            "G21",
            "G61",
            "G61.1",
            "G64",
            "G64 P0.1",
            "G64 P0.2 Q0.3",
            "G4 P0.5",
            "M9",
            "M7",
            "M8",
            "M0",
            "M1",
            "M5",
            "M48",
            "M49",
            "M50 P0",
            "M51 P1",
            "M52 P1",
            "M53 P0",
            "G97 S500",
            "G96 D2000 S150",
            "G97",
            "M64 P1",
            "M65 P2",
            "M62 P0",
            "G7",
            "G8",
            "M19 R30",
            "G90.1",
            "G91.1",
            "G93",
            "G94",
            "G95",
        ];
        for _ in 0..=self.random.below(3) {
            let word = self.random.pick(&words);
            self.line(word);
        }
        self.line("G94 G91.1 G8 F100");
        self.go();
    }

    fn messages(&mut self) {
        let value = self.expression(3);
        self.line(&format!("#5={value}"));
        self.line("(debug, five #5 and #<_size>)");
        self.line("(msg, hello  World )");
        self.line("; a comment (with brackets");
        self.line("(print, #1)");
        self.line("G1 X1 (one) Y2 (msg,two)");
    }

    fn spline(&mut self) {
        self.line("G17");
        self.go();
        match self.random.below(3) {
            0 => self.line("G5 X10 Y12 I2 J3 P-1 Q-4"),
            1 => self.line("G5.1 X10 Y12 I2 J3"),
            _ => {
                self.line("G5.2 X0 Y1 P1 L3");
                self.line("X2 Y2 P1");
                self.line("X4 Y0 P1");
                self.line("G5.3");
            }
        }
        self.go();
    }

    fn inverse_time(&mut self) {
        let mode = self.random.pick(&["G93", "G95"]);
        let text = format!("{mode} F{}", number(self.random.between(0.1, 5.0)));
        self.line(&text);
        for _ in 0..=self.random.below(3) {
            let (x, f) = (self.random.between(-20.0, 20.0), self.random.between(0.5, 9.0));
            self.line(&format!("G1 X{} F{}", number(x), number(f)));
        }
        self.line("G94 F150");
    }

    /// One line that a control refuses, or nearly so.
    pub(crate) fn mistake(&mut self) {
        let lines = [
            "G1 X1 X2",
            "G0 G1 X1",
            "G2 X1 Y1",
            "X1,5",
            "G1 X[1",
            "G1 X[1/0]",
            "G1 X[SQRT[-1]]",
            "G41 G18",
            "#0=1",
            "G1 X#<nothing>",
            "G4",
            "G4 X2",
            "M3 M4",
            "G81 X1 Y1",
            "o900 call",
            "o901 endif",
            "G53 G2 X1 Y1 I1",
            "G1 A1 Q5",
            "G99 X[ACOS[2]]",
            "T-1",
            "M6 M61 Q1",
            "S-5",
            "F-1",
            "G28 G1 X1",
            "G10 L2 P12 X1",
            "G10 L5 P1",
            "G38.2 Z-1 F0",
            "(unclosed",
            "G1 X1 / Y2",
            "N-1",
            "G5.3",
            "G43 H99",
            "G41 D99",
            "G88 X1",
            "o9 while [1",
            "G64 P-1",
            "G17 G2 X5 Y5 K1",
            "M66 P1 L7",
            "G33 X1",
            "G33.1 Z1",
            "#5420=1",
            "G83 Z-1 R1 Q0",
            "@5 ^",
            "G1 @2 ^30 X1",
            "G80 X1",
            "G1 X1 *5",
            "M101 P-3",
            "G76 Z1",
            "G1 Xe1",
            "G1 X--1",
            "(a (b))",
        ];
        let line = self.random.pick(&lines);
        self.line(line);
    }
}
