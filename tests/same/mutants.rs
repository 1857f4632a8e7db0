//! Programs with one word changed. What a mutant does is judged here by the text alone, never by Trunnion's comparison: the bases mark the
//! words that may be deleted (`{G90}`: restated or the state at power-on) and those that may be anything (`<G80>`: without effect).
use crate::reading::{Expected, Pair};
use std::path::Path;
use trunnion::dialect::{CodeKind, Dialect, builtin};

/// splitmix64: the same sample in every run.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }
}

/// What may happen to a word without a consequence.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Freedom {
    None,
    Deletion,
    Anything,
}

/// A word as it is written: `X`, `10.` or `CR=`, `10` or `TRANS` with nothing, or an APT record and its text.
#[derive(Clone)]
struct Word {
    head: String,
    value: String,
    freedom: Freedom,
}

impl Word {
    fn text(&self) -> String {
        format!("{}{}", self.head, self.value)
    }
    fn letter(&self) -> Option<char> {
        let mut chars = self.head.chars();
        let letter = chars.next().filter(char::is_ascii_uppercase)?;
        (chars.next().is_none() && !self.value.is_empty()).then_some(letter)
    }
    /// G1, M6 or TRANS: what the table may list.
    fn code(&self) -> Option<String> {
        match self.letter() {
            Some('G' | 'M') => Some(self.text()),
            Some(_) => None,
            None => (self.value.is_empty() && self.head.chars().all(|c| c.is_ascii_alphanumeric()))
                .then(|| self.head.clone()),
        }
    }
}

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
const LETTERS: &str = "XYZABCIJKRFSTHDPQLE";

fn is_layout(line: &str) -> bool {
    line == "%" || line.starts_with('(') || line.starts_with(';') || line.starts_with("O0")
}

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

    fn text(&self, lines: &[Vec<Word>]) -> String {
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
            machine: self.machine.clone(),
            claim: None,
            before: self.text(&self.lines),
            after,
            files: Vec::new(),
        }
    }

    /// The program with the words of one line replaced.
    fn with(&self, at: usize, what: &str, words: Vec<Word>) -> Pair {
        let mut lines = self.lines.clone();
        let before = self.text(&lines[at..=at]);
        lines[at] = words;
        let after = self.text(&lines[at..=at]);
        let what = format!("line {}, {what}: `{}` to `{}`", at + 1, before.trim(), after.trim());
        self.pair(Expected::Different, &what, self.text(&lines))
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
                    for other in self.other_letters(word) {
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

    fn other_letters(&self, word: &Word) -> Vec<Word> {
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

    /// Blocks put before a line that moves: those of the base's list, and each M code that is not in force already.
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
            // what is in force at power-on is not written down in the table
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
            let before = self.text(&self.lines[at..=at]);
            let what = format!("`{block}` put before line {}, `{}`", at + 1, before.trim());
            self.pair(Expected::Different, &what, self.text(&lines))
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
        let mut all = vec![self.pair(Expected::Same, "beside itself", self.text(&self.lines))];
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

fn line_of(words: &[Word]) -> String {
    words.iter().map(Word::text).collect::<Vec<_>>().join(" ")
}

fn spelled(words: &[Word], spell: impl Fn(&Word) -> String) -> String {
    words.iter().map(spell).collect::<Vec<_>>().join(" ")
}

fn leading_zero(word: &Word) -> String {
    let whole = word.value.len() == 1 && word.value.bytes().all(|b| b.is_ascii_digit());
    match word.letter() {
        Some(letter @ ('G' | 'M' | 'T' | 'H' | 'D')) if whole => format!("{letter}0{}", word.value),
        _ => word.text(),
    }
}

fn trailing_zero(word: &Word) -> String {
    match word.letter() {
        Some('X' | 'Y' | 'Z' | 'A' | 'C' | 'U' | 'W' | 'F' | 'I' | 'J' | 'K' | 'R') if word.value.contains('.') => {
            word.text() + "0"
        }
        _ => word.text(),
    }
}

/// Cuts a line of a base: words are apart by blanks, `{}` and `<>` mark them. An APT record is one word.
fn words(line: &str, apt: bool) -> Vec<Word> {
    let comparison = |text: &str| text.contains("AC_DTEB");
    let parts: Vec<&str> = match apt || is_layout(line) || comparison(line) {
        true => vec![line],
        false => line.split(' ').collect(),
    };
    let word = |part: &str| -> Word {
        let (freedom, bare) = match part.as_bytes() {
            [b'{', .., b'}'] => (Freedom::Deletion, &part[1..part.len() - 1]),
            [b'<', .., b'>'] => (Freedom::Anything, &part[1..part.len() - 1]),
            _ if is_layout(part) => (Freedom::Anything, part),
            _ => (Freedom::None, part),
        };
        let cut = match bare.find(['=', '/', '(']).filter(|_| !is_layout(bare)) {
            Some(i) => i + 1,
            None if bare.len() > 1 && !bare.as_bytes()[1].is_ascii_alphabetic() => 1,
            None => bare.len(),
        };
        Word {
            head: bare[..cut].to_owned(),
            value: bare[cut..].to_owned(),
            freedom,
        }
    };
    parts.into_iter().map(word).collect()
}

/// Each number in a word's value, changed in each way that cannot be the same number.
fn other_values(word: &Word) -> Vec<Word> {
    let letter = word.letter();
    if matches!(letter, Some('G' | 'M' | 'N' | 'O')) {
        return Vec::new();
    }
    let call = word.head.ends_with('(') || word.head.ends_with('/');
    let fractions = letter.is_none_or(|letter| "XYZABCIJKRFUW".contains(letter));
    let mut all = Vec::new();
    for (number, (start, end)) in numbers(&word.value).into_iter().enumerate() {
        if without_effect(word, number) {
            continue;
        }
        let old = &word.value[start..end];
        let value: f64 = old.parse().expect("digits");
        let mut others = vec![value + 1.0, value * 10.0];
        if fractions {
            others.push(value + 0.01);
        }
        // the signs of a cycle's arguments and of Q may be ignored
        if !call && letter != Some('Q') {
            others.push(-value);
        }
        for other in others.into_iter().filter(|other| *other != value) {
            let point = if old.contains('.') && other.fract() == 0.0 {
                "."
            } else {
                ""
            };
            let other = format!("{}{point}", (other * 1e9).round() / 1e9);
            let value = format!("{}{other}{}", &word.value[..start], &word.value[end..]);
            all.push(Word { value, ..word.clone() });
        }
    }
    all
}

/// APT: the length of a vector, and the place of a circle's centre along its axis, may be anything.
fn without_effect(word: &Word, number: usize) -> bool {
    match word.head.as_str() {
        "GOTO/" => number == 5,
        "CIRCLE/" => number == 2 || number == 5,
        _ => false,
    }
}

/// Where numbers stand in a text: start and end in bytes. Digits behind a letter are part of a name.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let bytes = text.as_bytes();
    let (mut all, mut i) = (Vec::new(), 0);
    while i < bytes.len() {
        let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
        let dot = |i: usize| bytes.get(i) == Some(&b'.');
        let sign = usize::from(bytes[i] == b'-' && (i == 0 || !bytes[i - 1].is_ascii_alphanumeric()));
        if digit(i + sign) || (dot(i + sign) && digit(i + sign + 1)) {
            let mut end = i + sign;
            while digit(end) || dot(end) {
                end += 1;
            }
            all.push((i, end));
            i = end;
        } else if bytes[i].is_ascii_alphabetic() {
            while bytes.get(i).is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_') {
                i += 1;
            }
        } else {
            i += 1;
        }
    }
    all
}

/// Two neighbours with their letters exchanged, where that says something else.
fn swapped(a: &Word, b: &Word) -> Option<[Word; 2]> {
    let (x, y) = (a.letter()?, b.letter()?);
    let good = |letter: char| LETTERS.contains(letter);
    let free = a.freedom == Freedom::None && b.freedom == Freedom::None;
    let same = a.value.parse::<f64>().ok() == b.value.parse::<f64>().ok();
    (free && good(x) && good(y) && x != y && !same).then(|| {
        [
            Word {
                head: y.to_string(),
                ..a.clone()
            },
            Word {
                head: x.to_string(),
                ..b.clone()
            },
        ]
    })
}

/// APT: other motions, other stops, and other minor words.
fn other_majors(word: &Word) -> Vec<Word> {
    const MAJORS: &[&[&str]] = &[&["GOTO/", "GODLTA/", "FROM/"], &["STOP", "OPSTOP"]];
    const MINORS: &[&[&str]] = &[
        &["MMPM", "MMPR", "IPM", "IPR"],
        &["CLW", "CCLW", "OFF"],
        &["RPM", "SFM", "SMM"],
        &["FLOOD", "MIST", "THRU", "AIR", "OFF"],
    ];
    let majors = MAJORS
        .iter()
        .filter(|group| group.contains(&word.head.as_str()))
        .copied()
        .flatten();
    let mut all: Vec<Word> = majors
        .filter(|other| **other != word.head)
        .map(|other| Word {
            head: (*other).to_owned(),
            ..word.clone()
        })
        .collect();
    for group in MINORS {
        for (i, part) in word
            .value
            .split(',')
            .enumerate()
            .filter(|(_, part)| group.contains(part))
        {
            // OFF belongs to the spindle and to the coolant
            let fits =
                |other: &&&str| **other != part && (part != "OFF" || (word.head == "SPINDL/") == (group[0] == "CLW"));
            for other in group.iter().filter(fits) {
                let mut parts: Vec<&str> = word.value.split(',').collect();
                parts[i] = other;
                all.push(Word {
                    value: parts.join(","),
                    ..word.clone()
                });
            }
        }
    }
    all
}

/// A program as it is, with each number of each word increased by one: block numbers, codes, program names and comments stay.
pub(crate) fn numbers_changed(name: &str, text: &str, dialect: &str, machine: &str) -> Vec<Pair> {
    let lines: Vec<&str> = text.lines().collect();
    let mut all = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let code = line.split(['(', ';']).next().unwrap_or_default();
        if code.starts_with(['%', 'O', '$']) || code.contains("PARTNO") {
            continue;
        }
        for (start, end) in numbers_of_words(code, dialect == "apt") {
            let old: f64 = code[start..end].parse().expect("digits");
            let point = if code[start..end].ends_with('.') { "." } else { "" };
            let other = format!(
                "{}{}{point}{}",
                &line[..start],
                ((old + 1.0) * 1e9).round() / 1e9,
                &line[end..]
            );
            let mut changed = lines.clone();
            changed[at] = &other;
            all.push(Pair {
                name: format!("{name}: line {}: `{line}` to `{other}`", at + 1),
                expected: Expected::Different,
                dialect: dialect.to_owned(),
                machine: machine.to_owned(),
                claim: None,
                before: text.to_owned(),
                after: changed.join("\n") + "\n",
                files: Vec::new(),
            });
        }
    }
    all
}

/// Where the numbers of words stand that are no G, M or N word.
fn numbers_of_words(code: &str, apt: bool) -> Vec<(usize, usize)> {
    let numeric = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    if apt {
        let word = code.split('/').next().unwrap_or_default();
        let all = numbers(code).into_iter().enumerate();
        let without = |number: usize| {
            let word = Word {
                head: format!("{word}/"),
                value: String::new(),
                freedom: Freedom::None,
            };
            without_effect(&word, number)
        };
        return all
            .filter(|(number, _)| !without(*number))
            .map(|(_, place)| place)
            .collect();
    }
    let mut all = Vec::new();
    for (i, letter) in code.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()) {
        let alone = i == 0 || !code.as_bytes()[i - 1].is_ascii_alphabetic();
        let end = code[i + 1..].find(|c| !numeric(c)).map_or(code.len(), |n| i + 1 + n);
        if alone && !"GMN".contains(letter) && end > i + 1 {
            all.push((i + 1, end));
        }
    }
    all
}
