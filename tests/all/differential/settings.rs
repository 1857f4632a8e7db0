//! What random programs are run with: tool tables, parameter files, INI files, called programs.
use super::generate::{Program, number};
use core::fmt::Write;

/// A program and what belongs to it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Case {
    /// The program.
    pub(crate) text: String,
    /// Files beside it.
    pub(crate) files: Vec<(String, String)>,
    pub(crate) block_delete: bool,
}

/// Name of the parameter file.
pub(crate) const PARAMETERS: &str = "p.var";

impl Case {
    /// Whether a file is beside the program.
    pub(crate) fn has(&self, file: &str) -> bool {
        self.files.iter().any(|(name, _)| name == file)
    }

    /// Arguments that name the files, as one of the two interpreters wants them.
    pub(crate) fn arguments(&self, oracle: bool) -> Vec<&'static str> {
        let mut arguments = Vec::new();
        for ([theirs, ours], file) in [
            (["-i", "--ini"], "m.ini"),
            (["-t", "--tool-table"], "t.tbl"),
            (["-v", "--parameters"], PARAMETERS),
        ] {
            if self.has(file) {
                arguments.extend([if oracle { theirs } else { ours }, file]);
            }
        }
        if self.block_delete {
            arguments.push(if oracle { "-b" } else { "--block-delete=on" });
        }
        arguments
    }
}

impl Program {
    /// What the program is run with, now and then.
    pub(crate) fn settings(&mut self) {
        if self.random.one_in(3) {
            self.tool_table();
        }
        if self.random.one_in(4) {
            self.parameter_file();
        }
        if self.random.one_in(4) {
            self.ini_file();
        }
        self.case.block_delete = self.random.one_in(5);
    }

    fn file(&mut self, name: &str, text: String) {
        self.case.files.push((name.to_owned(), text));
    }

    fn tool_table(&mut self) {
        let mut text = String::new();
        self.tools.clear();
        for _ in 0..=self.random.below(5) {
            let tool = 1 + self.random.below(40) as u32;
            if self.tools.contains(&tool) {
                continue;
            }
            self.tools.push(tool);
            let _ = write!(text, "T{tool} P{}", self.tools.len() + self.random.below(3) * 10);
            for letter in ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"] {
                if self.random.one_in(if letter == "Z" { 2 } else { 6 }) {
                    let _ = write!(text, " {letter}{}", number(self.random.between(-3.0, 3.0)));
                }
            }
            if !self.random.one_in(4) {
                let _ = write!(text, " D{}", number(self.random.between(-0.05, 0.4)));
            }
            if self.random.one_in(4) {
                let _ = write!(text, " I{} J{}", self.random.below(90), self.random.below(90));
                let _ = write!(text, " Q{}", self.random.below(10));
            }
            text.push_str(" ;a tool\n");
        }
        self.file("t.tbl", text);
    }

    fn parameter_file(&mut self) {
        let mut text = String::new();
        for index in [31, 100, 3000] {
            if self.random.one_in(2) {
                let _ = writeln!(text, "{index}\t{:.6}", self.random.between(-9.0, 9.0));
            }
        }
        let mut index = 5161;
        while index <= 5390 {
            let place = (index - 5220) % 20;
            let value = match index {
                5210 => f64::from(u8::from(self.random.one_in(3))),
                5220 => 1.0 + self.random.below(9) as f64,
                // X and Y turn by whole degrees
                5221.. if place == 10 && self.random.one_in(3) => self.random.below(90) as f64,
                5221.. if place == 10 => 0.0,
                _ if self.random.one_in(3) => self.random.between(-2.0, 2.0),
                _ => 0.0,
            };
            let kept =
                matches!(index, 5161..=5169 | 5181..=5189 | 5210..=5220) || (index > 5220 && (1..=10).contains(&place));
            if kept {
                let _ = writeln!(text, "{index}\t{value:.6}");
            }
            index += 1;
        }
        self.file(PARAMETERS, text);
    }

    fn ini_file(&mut self) {
        let mut text = "[TRAJ]\n".to_owned();
        if self.random.one_in(2) {
            self.spindles = 1 + self.random.below(4);
            let _ = writeln!(text, "SPINDLES = {}", self.spindles);
        }
        if self.random.one_in(3) {
            text.push_str("[EMCIO]\nRANDOM_TOOLCHANGER = 1\n");
        }
        text.push_str("[RS274NGC]\n");
        for key in ["DISABLE_G92_PERSISTENCE", "DISABLE_FANUC_STYLE_SUB"] {
            if self.random.one_in(4) {
                let _ = writeln!(text, "{key} = {}", self.random.below(2));
            }
        }
        for section in ["AXIS_A", "AXIS_B"] {
            if self.random.one_in(4) {
                let _ = writeln!(text, "[{section}]\nWRAPPED_ROTARY = 1");
            }
        }
        let _ = writeln!(text, "[OWN]\nNUMBER = {}", number(self.random.between(-5.0, 5.0)));
        self.file("m.ini", text);
    }
}
