//! A post for an Okuma machining centre.
use super::{Step, Way, plain};

#[derive(Clone, Copy)]
pub(super) struct Style {
    pub(super) name: &'static str,
    numbers: bool,
    /// Arcs by I and J, else by R.
    centres: bool,
    /// X, Y and Z in every block.
    all: bool,
    /// G91.
    incremental: bool,
    /// The words of a block on lines that `$` continues.
    continued: bool,
    /// Values in common variables of this name.
    variables: Option<&'static str>,
    /// In subprograms of 100 blocks.
    subprograms: bool,
    /// G01 in place of G1.
    two_digits: bool,
}

const CAM: Style = Style {
    name: "numbers, R",
    numbers: true,
    centres: false,
    all: false,
    incremental: false,
    continued: false,
    variables: None,
    subprograms: false,
    two_digits: false,
};

pub(super) const STYLES: [Style; 5] = [
    CAM,
    Style {
        name: "no numbers, I and J, all axes, G01",
        numbers: false,
        centres: true,
        all: true,
        two_digits: true,
        ..CAM
    },
    Style {
        name: "G91, lines continued by $",
        incremental: true,
        continued: true,
        numbers: false,
        ..CAM
    },
    Style {
        name: "values in V, in subprograms",
        variables: Some("V"),
        subprograms: true,
        numbers: false,
        ..CAM
    },
    Style {
        name: "values in VC",
        variables: Some("VC"),
        centres: true,
        ..CAM
    },
];

impl Style {
    pub(super) fn post(&self, steps: &[Step]) -> String {
        let mut blocks = Vec::new();
        let mut modal = ("", f64::NAN);
        for (at, step) in steps.iter().enumerate() {
            self.block(step, at == 0, &mut modal, &mut blocks);
        }
        let mut out = String::from("$PART.MIN%\nO0001 (PART)\n");
        let head = ["G0 G40 G80", "G15 H1", "T1 M6", "S480 M3", "G56 H1", "G94 G17 G90"];
        let mut number = 0;
        let mut put = |block: &str| {
            number += 1;
            if self.numbers {
                out.push_str(&format!("N{number} "));
            }
            out.push_str(block);
            out.push('\n');
        };
        head.into_iter().for_each(&mut put);
        if self.subprograms {
            let parts: Vec<&[String]> = blocks.chunks(100).collect();
            for part in 0..parts.len() {
                put(&format!("CALL OS{part}"));
            }
            put("M2");
            for (index, part) in parts.iter().enumerate() {
                put(&format!("OS{index}"));
                part.iter().for_each(|block| put(block));
                put("RTS");
            }
        } else {
            for block in &blocks {
                put(block);
            }
            put("G90");
            put("M2");
        }
        out
    }

    fn block(&self, step: &Step, first: bool, modal: &mut (&'static str, f64), blocks: &mut Vec<String>) {
        let code = match (step.way, self.two_digits) {
            (Way::Rapid, false) => "G0",
            (Way::Line, false) => "G1",
            (Way::Arc(_, sweep), false) => {
                if sweep < 0.0 {
                    "G2"
                } else {
                    "G3"
                }
            }
            (Way::Rapid, true) => "G00",
            (Way::Line, true) => "G01",
            (Way::Arc(_, sweep), true) => {
                if sweep < 0.0 {
                    "G02"
                } else {
                    "G03"
                }
            }
        };
        let mut words = Vec::new();
        if modal.0 != code || self.all {
            words.push(code.to_owned());
            modal.0 = code;
        }
        let full = matches!(step.way, Way::Arc(..)) && (step.from - step.to).norm() < 1e-6;
        for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            let moved = (step.to[axis] - step.from[axis]).abs() > 1e-9;
            if !first && !self.all && !moved {
                continue;
            }
            let value = if self.incremental && !first {
                step.to[axis] - step.from[axis]
            } else {
                step.to[axis]
            };
            match self.variables {
                Some(name) => {
                    blocks.push(format!("{name}{}={}", axis + 1, plain(value)));
                    words.push(format!("{letter}={name}{}", axis + 1));
                }
                None => words.push(format!("{letter}{}", plain(value))),
            }
        }
        if let Way::Arc(centre, sweep) = step.way {
            if self.centres || full {
                let arm = centre - step.from;
                words.push(format!("I{} J{}", plain(arm.x), plain(arm.y)));
            } else {
                let radius = step.radius(centre);
                words.push(format!(
                    "R{}",
                    plain(if sweep.abs() > 180.0 { -radius } else { radius })
                ));
            }
        }
        if step.way != Way::Rapid && (modal.1 != step.feed || self.all) {
            words.push(format!("F{}", plain(step.feed)));
            modal.1 = step.feed;
        }
        blocks.push(words.join(if self.continued { "\n$ " } else { " " }));
        if first && self.incremental {
            blocks.push("G91".to_owned());
        }
    }
}
