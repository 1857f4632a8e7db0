//! Programs with their findings drawn under them, for the examples in rule headers and for tests.
//!
//! ```text
//! N20 G1 X10
//! ;      ^^^ rule-name: beginning of the message
//! ```
//!
//! A line of carets (`;` or `$$`, carets, a rule's name, a colon, text) belongs to the nearest line above that is not such a line. It
//! is taken out before the program is read. The mark hides the first column: carets directly after it reach back to it, and
//! `;^` there means a width of 1 or 2.
use crate::{Assume, Report, RuleLevel, Settings, check};
use std::sync::Arc;
use trunnion_interp::{Files, Library, Limits, Loaded, Searched, Setup};
use trunnion_machine::Machine;
use trunnion_syntax::LineIndex;

/// Rules that say what a fragment lacks; they are silent in fixtures that do not draw them.
pub const QUIET: &[&str] = &[
    "machine-unset",
    "missing-program-end",
    "not-run",
    "spindle-unset",
    "units-unset",
];

/// Lines end with a carriage return alone.
const CR: &str = "line-ends=cr";

/// In place of a dialect: what the text shows.
const DETECTED: &str = "detected";

/// One finding as drawn.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Drawn {
    /// Line of the program without caret lines, from 1.
    pub line: usize,
    /// First column in characters, from 1.
    pub column: usize,
    /// How many characters, at least 1.
    pub width: usize,
    /// Rule.
    pub rule: String,
    /// Beginning of the message.
    pub text: String,
}

/// A program and what is expected of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fixture {
    /// Name of a built-in dialect, or `detected`: the text shows it.
    pub dialect: String,
    /// Name of a built-in machine, if any; `NAME+clamp` is one whose first rotary axis has `clamp = true`, `NAME+A.cable` one whose A
    /// has `cable = true`.
    pub machine: Option<String>,
    /// Dialects to port the program to.
    pub port_to: Vec<String>,
    /// Work offsets and tool lengths that are not declared are unknown; else they are taken as zero.
    pub undeclared: bool,
    /// The program without caret lines.
    pub program: String,
    /// What is drawn, sorted.
    pub drawn: Vec<Drawn>,
}

impl Fixture {
    /// Reads a fixture; `info` is a fence's info string: `gcode`, then names of a dialect (else iso-6983) and a machine, and
    /// `port=NAME` for each dialect that the program is to be carried over to; `line-ends=cr`; `undeclared`: see that field.
    pub fn parse(info: &str, text: &str) -> Self {
        let undeclared = info.split_whitespace().any(|word| word == "undeclared");
        let is_dialect = |word: &&str| trunnion_dialect::BUILTIN_NAMES.contains(word) || *word == DETECTED;
        let (ported, names): (Vec<&str>, Vec<&str>) = info
            .split_whitespace()
            .skip(1)
            .filter(|word| !matches!(*word, CR | "undeclared"))
            .partition(|word| word.starts_with("port="));
        let dialect = names
            .iter()
            .copied()
            .find(|word| is_dialect(word))
            .unwrap_or("iso-6983");
        let machine = names
            .iter()
            .find(|word| !is_dialect(word))
            .map(|word| (*word).to_owned());
        let mut fixture = Self {
            dialect: dialect.to_owned(),
            machine,
            undeclared,
            port_to: ported.iter().map(|word| word["port=".len()..].to_owned()).collect(),
            ..Self::default()
        };
        let mut lines = 0;
        for line in text.lines() {
            if let Some(drawn) = caret_line(line, lines) {
                fixture.drawn.push(drawn);
            } else {
                fixture.program.push_str(line);
                fixture.program.push('\n');
                lines += 1;
            }
        }
        fixture.drawn.sort();
        if info.split_whitespace().any(|word| word == CR) {
            fixture.program = fixture.program.replace('\n', "\r");
        }
        fixture
    }

    /// Checks the program; `Err` says that dialect or machine do not exist.
    pub fn check(&self) -> Result<Report, String> {
        let (dialect, foreign) = if self.dialect == DETECTED {
            let found = trunnion_dialect::detect(None, self.program.as_bytes(), None);
            (found.dialect, found.foreign)
        } else {
            let dialect = trunnion_dialect::builtin(&self.dialect);
            (dialect.ok_or_else(|| format!("no dialect {}", self.dialect))?, None)
        };
        let machine = self.machine.as_deref().map(machine).transpose()?;
        let drawn = |rule: &&&str| self.drawn.iter().any(|drawn| drawn.rule == **rule);
        let rules = QUIET
            .iter()
            .filter(|rule| !drawn(rule))
            .map(|rule| ((*rule).to_owned(), RuleLevel::Allow))
            .collect();
        let program = trunnion_syntax::parse(self.program.clone().into_bytes(), dialect.lex);
        Ok(check(
            &program,
            &Settings {
                dialect,
                machine: machine.as_ref(),
                setup: setup(),
                rules,
                port_to: self.port_to.clone(),
                scope: None,
                control_known: true,
                foreign,
                assume: Assume {
                    work_offset: !self.undeclared,
                    tool_length: !self.undeclared,
                    power_on: false,
                },
            },
        ))
    }

    /// Compares what is found with what is drawn: the same rules at the same places with messages that begin as drawn.
    /// `Err` shows both.
    pub fn compare(&self) -> Result<Report, String> {
        let report = self.check()?;
        let found = self.found(&report);
        let agrees = |(found, drawn): (&Drawn, &Drawn)| {
            let hidden = usize::from(drawn.column == 1 && drawn.width == 2);
            (found.line, found.column, &found.rule) == (drawn.line, drawn.column, &drawn.rule)
                && (drawn.width - hidden..=drawn.width).contains(&found.width)
                && found.text.starts_with(&drawn.text)
        };
        if found.len() == self.drawn.len() && found.iter().zip(&self.drawn).all(agrees) {
            return Ok(report);
        }
        Err(format!(
            "found:\n{}drawn:\n{}in:\n{}",
            list(&found),
            list(&self.drawn),
            self.program
        ))
    }

    fn found(&self, report: &Report) -> Vec<Drawn> {
        let source = self.program.as_bytes();
        let index = LineIndex::new(source);
        let place = |offset| index.line_column(source, offset);
        let mut found: Vec<Drawn> = report
            .findings()
            .map(|diagnostic| {
                let (line, column) = place(diagnostic.range.start);
                let (end_line, end_column) = place(diagnostic.range.end);
                let line_end = self
                    .program
                    .lines()
                    .nth(line as usize - 1)
                    .map_or(0, |text| text.chars().count())
                    + 1;
                let end = if end_line == line {
                    end_column as usize
                } else {
                    line_end
                };
                let width = end.saturating_sub(column as usize).max(1);
                let text = diagnostic.message.clone();
                Drawn {
                    line: line as usize,
                    column: column as usize,
                    width,
                    rule: diagnostic.rule.to_owned(),
                    text,
                }
            })
            .collect();
        found.sort();
        found
    }
}

/// A library that holds nothing.
struct NoFiles;

impl Files for NoFiles {
    fn load(&self, _: &str) -> Result<Loaded, Vec<Searched>> {
        Err(Vec::new())
    }
}

/// No tools and offsets, no other files, and bounds that a short program keeps.
fn setup() -> Setup {
    Setup {
        limits: Limits {
            blocks: 100_000,
            ..Limits::default()
        },
        library: Library(Some(Arc::new(NoFiles))),
        ..Setup::default()
    }
}

/// A built-in machine; `NAME+KEY` has `KEY = true` added to its first rotary axis, `NAME+A.KEY` to axis A, `NAME+A.KEY=5` with
/// that value, `NAME+control.KEY=5` to the control; `NAME+undeclared` names no rule for postures; `NAME+wall` has an obstacle. Several keys come after each other.
pub(crate) fn machine(name: &str) -> Result<Machine, String> {
    let none = || format!("no machine {name}");
    let Some((builtin, keys)) = name.split_once('+') else {
        return trunnion_machine::builtin(name).cloned().ok_or_else(none);
    };
    let source = trunnion_machine::builtin_source(builtin).ok_or_else(none)?;
    let more = keys
        .split('+')
        .fold(source.to_owned(), |source, key| with_key(&source, key));
    trunnion_machine::load(builtin, &more).map_err(|error| error.message)
}

/// What `NAME+wall` adds: a wall across X.
const WALL: &str = "[[obstacle]]\nname = \"wall\"\nbox = [[40, -100, 0], [60, 100, 35]]\n";

/// The text of a machine file with one key more.
fn with_key(source: &str, key: &str) -> String {
    match key.split_once('.') {
        _ if key == "wall" => format!("{source}\n{WALL}"),
        _ if key == "undeclared" => source.replace("branch = { rule = \"generic\" }", "#"),
        Some(("control", key)) => source.replacen("[control]\n", &format!("[control]\n{key}\n"), 1),
        Some((letter, key)) => {
            let axis = format!("letter = \"{letter}\"\n");
            let entry = if key.contains('=') {
                key.to_owned()
            } else {
                format!("{key} = true")
            };
            source.replacen(&axis, &format!("{axis}{entry}\n"), 1)
        }
        None => {
            let kind = "kind = \"rotary\"";
            source.replacen(kind, &format!("{kind}\n{key} = true"), 1)
        }
    }
}

fn list(findings: &[Drawn]) -> String {
    let line = |d: &Drawn| format!("  {}:{}+{} {}: {}", d.line, d.column, d.width, d.rule, d.text);
    findings
        .iter()
        .map(line)
        .chain([String::new()])
        .collect::<Vec<_>>()
        .join("\n")
}

fn caret_line(line: &str, above: usize) -> Option<Drawn> {
    let rest = line.strip_prefix(';').or_else(|| line.strip_prefix("$$"))?;
    let mark = line.len() - rest.len();
    let carets = rest.trim_start();
    let blanks = rest.len() - carets.len();
    let behind = carets.trim_start_matches('^');
    let width = carets.len() - behind.len();
    let (rule, text) = behind.split_once(':')?;
    if width == 0 || above == 0 {
        return None;
    }
    let (column, width) = if blanks == 0 {
        (1, width + mark)
    } else {
        (mark + blanks + 1, width)
    };
    Some(Drawn {
        line: above,
        column,
        width,
        rule: rule.trim().to_owned(),
        text: text.trim().to_owned(),
    })
}

/// Panics unless the text's findings are those drawn under it; see [`Fixture`].
#[cfg(test)]
pub(crate) fn assert_drawn(info: &str, text: &str) -> Report {
    match Fixture::parse(info, text).compare() {
        Ok(report) => report,
        Err(message) => panic!("{message}"),
    }
}

/// Checks a text on a machine that no fence can name.
#[cfg(test)]
pub(crate) fn check_on(machine: &Machine, dialect: &str, text: &str) -> Report {
    check_with(machine, dialect, text, Setup::default())
}

/// The same with tools, offsets, other files.
#[cfg(test)]
pub(crate) fn check_with(machine: &Machine, dialect: &str, text: &str, setup: Setup) -> Report {
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let settings = Settings {
        assume: Assume::ALL,
        ..Settings::new(dialect, Some(machine), setup)
    };
    check(&program, &settings)
}
