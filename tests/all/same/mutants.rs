//! Programs with one word changed. What a mutant does is judged here by the text alone, never by Trunnion's comparison: the bases mark the
//! words that may be deleted (`{G90}`: restated or the state at power-on) and those that may be anything (`<G80>`: without effect).
use super::reading::{Expected, Pair};
use super::words::{
    Freedom, LETTERS, Word, is_layout, leading_zero, line_of, other_majors, other_values, spelled, swapped,
    trailing_zero, words,
};
use std::path::Path;
use trunnion::dialect::{CodeKind, Dialect, builtin};

/// A program whose every unmarked word matters.
pub(crate) struct Base {
    name: String,
    machine: String,
    dialect: &'static Dialect,
    lines: Vec<Vec<Word>>,
    inserts: Vec<String>,
}

/// Codes that mean the same, or may, by the control's own text.
const ALIASES: &[(&str, &str, &str)] = &[
    ("sinumerik-840d", "G71", "G710"),
    ("sinumerik-840d", "G70", "G700"),
    ("iso-6983", "G71", "G21"),
    ("grbl", "M2", "M30"),
    ("haas-ngc", "G154", "G111"),
];
/// Codes that change nothing by themselves: LinuxCNC's saved modal state, Haas pictures and a test of the program.
const IDLE: &[(&str, &str)] = &[
    ("linuxcnc", "M70"),
    ("linuxcnc", "M71"),
    ("linuxcnc", "M73"),
    ("haas-ngc", "M48"),
    ("haas-ngc", "M130"),
    ("haas-ngc", "M131"),
];
/// TRANS, ATRANS and G58 are alike where no frame is active, TRANS, ROT and MIRROR where they stand alone.
const FREE_GROUPS: &[&str] = &["programmable-frame"];

impl Base {
    pub(crate) fn read(file: &Path) -> Self {
        let text = std::fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let (head, body) = text.split_once("===\n").unwrap_or_else(|| panic!("{name}: no `===`"));
        let setting = |key: &str| -> &str {
            let found = head.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(':'));
            found.map(str::trim).unwrap_or_default()
        };
        let dialect = builtin(setting("dialect")).unwrap_or_else(|| panic!("{name}: no such dialect"));
        Self {
            machine: setting("machine").to_owned(),
            inserts: setting("insert").split(" | ").map(str::to_owned).collect(),
            lines: body.lines().map(|line| words(line, dialect.name == "apt")).collect(),
            name,
            dialect,
        }
    }

    fn text(lines: &[Vec<Word>]) -> String {
        let line = |words: &Vec<Word>| -> String {
            let words: Vec<String> = words.iter().map(Word::text).filter(|text| !text.is_empty()).collect();
            words.join(" ") + "\n"
        };
        lines.iter().map(line).collect()
    }

    fn pair(&self, expected: Expected, what: &str, after: String) -> Pair {
        Pair {
            name: format!("{}: {what}", self.name),
            expected,
            dialect: self.dialect.name.clone(),
            dialect_after: None,
            machine: self.machine.clone(),
            claim: None,
            before: Self::text(&self.lines),
            after,
            files: Vec::new(),
        }
    }

    /// The program with the words of one line replaced.
    fn with(&self, at: usize, what: &str, words: Vec<Word>) -> Pair {
        let mut lines = self.lines.clone();
        let before = Self::text(&lines[at..=at]);
        lines[at] = words;
        let after = Self::text(&lines[at..=at]);
        let what = format!("line {}, {what}: `{}` to `{}`", at + 1, before.trim(), after.trim());
        self.pair(Expected::Different, &what, Self::text(&lines))
    }

    /// All mutants that do something else.
    pub(crate) fn mutants(&self) -> Vec<Pair> {
        let mut all = Vec::new();
        for (at, words) in self.lines.iter().enumerate() {
            let mut change = |what: &str, i: usize, new: Option<Word>| {
                let mut changed = words.clone();
                match new {
                    Some(word) => changed[i] = word,
                    None => drop(changed.remove(i)),
                }
                all.push(self.with(at, what, changed));
            };
            for (i, word) in words
                .iter()
                .enumerate()
                .filter(|(_, word)| word.freedom != Freedom::Anything)
            {
                if word.freedom == Freedom::None {
                    change("a word deleted", i, None);
                    // P, X, U and F may all be a dwell's time
                    let dwell = words.iter().any(|word| word.text() == "G4");
                    let time = |word: &Word| word.letter().is_some_and(|letter| "PXUF".contains(letter));
                    for other in Self::other_letters(word) {
                        if !(dwell && time(&other)) {
                            change("another letter", i, Some(other));
                        }
                    }
                }
                for other in self.other_codes(word) {
                    change("another code of the group", i, Some(other));
                }
                for other in other_values(word) {
                    change("another number", i, Some(other));
                }
            }
            for i in 1..words.len() {
                if let Some(swapped) = swapped(&words[i - 1], &words[i]) {
                    let mut changed = words.clone();
                    changed.splice(i - 1..=i, swapped);
                    all.push(self.with(at, "letters swapped", changed));
                }
            }
            all.extend(self.insertions(at));
        }
        all
    }

    fn other_letters(word: &Word) -> Vec<Word> {
        let letter = word.letter().filter(|letter| LETTERS.contains(*letter));
        let others = letter.map(|letter| LETTERS.chars().filter(move |other| *other != letter));
        others
            .into_iter()
            .flatten()
            .map(|other| Word {
                head: other.to_string(),
                ..word.clone()
            })
            .collect()
    }

    fn group(&self, code: &str) -> Option<&str> {
        let found = self.dialect.codes().iter().find(|known| known.id == code)?;
        found.group.as_deref()
    }

    fn other_codes(&self, word: &Word) -> Vec<Word> {
        if self.dialect.name == "apt" {
            return other_majors(word);
        }
        let Some(code) = word.code() else { return Vec::new() };
        let Some(group) = self.group(&code).filter(|group| !FREE_GROUPS.contains(group)) else {
            return Vec::new();
        };
        let alias = |a: &str, b: &str| {
            let both = |x: &str, y: &str| (a == x && b == y) || (a == y && b == x);
            ALIASES
                .iter()
                .any(|(dialect, x, y)| self.dialect.name == *dialect && both(x, y))
        };
        let of_group = self
            .dialect
            .codes()
            .iter()
            .filter(|other| other.group.as_deref() == Some(group));
        of_group
            .filter(|other| other.id != code && !alias(&other.id, &code))
            .map(|other| Word {
                head: other.id.clone(),
                value: String::new(),
                ..word.clone()
            })
            .collect()
    }

    /// Blocks put before a line that moves: those of the base's list, and each M code that is not in effect already.
    fn insertions(&self, at: usize) -> Vec<Pair> {
        if !self.moves(at) {
            return Vec::new();
        }
        let in_force = |group: &str| -> Option<String> {
            let earlier = self.lines[..at].iter().flatten().rev();
            let mut codes = earlier.filter_map(Word::code);
            codes.find(|code| self.group(code) == Some(group))
        };
        let idle = |id: &str| {
            IDLE.iter()
                .any(|(dialect, code)| self.dialect.name == *dialect && *code == id)
        };
        let effective = |id: &str| match self.group(id) {
            _ if idle(id) => false,
            None | Some("stopping") => true,
            // what is in effect at power-on is not written down in the table
            Some(group) => in_force(group).is_some_and(|code| code != id),
        };
        let m_codes = self.dialect.codes().iter().filter(|code| code.kind == CodeKind::M);
        let m_codes = m_codes.map(|code| code.id.clone()).filter(|id| effective(id));
        let listed = self.inserts.iter().filter(|block| {
            let word = block.split(' ').next().unwrap_or_default();
            self.group(word)
                .is_none_or(|group| group == "stopping" || in_force(group).as_deref() != Some(word))
        });
        let insert = |block: String| {
            let mut lines = self.lines.clone();
            lines.insert(
                at,
                vec![Word {
                    head: block.clone(),
                    value: String::new(),
                    freedom: Freedom::None,
                }],
            );
            let before = Self::text(&self.lines[at..=at]);
            let what = format!("`{block}` put before line {}, `{}`", at + 1, before.trim());
            self.pair(Expected::Different, &what, Self::text(&lines))
        };
        listed.cloned().chain(m_codes).map(insert).collect()
    }

    /// A plain motion: axis words, F and G0 to G3, nothing else.
    fn moves(&self, at: usize) -> bool {
        let words = &self.lines[at];
        if self.dialect.name == "apt" {
            return words.iter().any(|word| word.head.starts_with("GO"));
        }
        let plain = |word: &Word| match word.letter() {
            Some('X' | 'Y' | 'Z' | 'A' | 'C' | 'U' | 'W' | 'F' | 'I' | 'J' | 'R') => true,
            Some('G') => ["0", "1", "2", "3"].contains(&word.value.as_str()),
            _ => word.head == "X=" || word.head == "Y=",
        };
        words.len() > usize::from(words.iter().any(|word| word.letter() == Some('G'))) && words.iter().all(plain)
    }

    /// The same program, spelled and laid out in other ways.
    pub(crate) fn spellings(&self) -> Vec<Pair> {
        let apt = self.dialect.name == "apt";
        let each = |what: &str, change: &dyn Fn(usize, &[Word]) -> String| -> Pair {
            let lines = self.lines.iter().enumerate();
            let text = lines.map(|(at, words)| if is_layout(&line_of(words)) { line_of(words) } else { change(at, words) } + "\n");
            self.pair(Expected::Same, what, text.collect())
        };
        let comment = if self.dialect.lex.semicolon_comment {
            "; CUT"
        } else {
            "(CUT)"
        };
        let mut all = vec![self.pair(Expected::Same, "beside itself", Self::text(&self.lines))];
        if apt {
            all.push(each("blanks", &|_, words| {
                line_of(words).replace('/', " / ").replace(',', " , ")
            }));
            all.push(each("comments", &|at, words| format!("$$ {at}\n{}", line_of(words))));
            return all;
        }
        all.push(each("block numbers", &|at, words| {
            format!("N{} {}", 10 * (at + 1), line_of(words))
        }));
        all.push(each("comments", &|_, words| format!("{} {comment}", line_of(words))));
        all.push(each("leading zeros", &|_, words| spelled(words, leading_zero)));
        all.push(each("trailing zeros", &|_, words| spelled(words, trailing_zero)));
        all.push(each("words in another order", &|at, words| {
            let mut words = words.to_vec();
            if self.moves(at) {
                words.reverse();
            }
            line_of(&words)
        }));
        if ["linuxcnc", "grbl", "sinumerik-840d"].contains(&self.dialect.name.as_str()) {
            all.push(each("small letters", &|_, words| line_of(words).to_lowercase()));
        }
        all
    }
}
