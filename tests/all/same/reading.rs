//! Reads the tables of pairs; README.md in this folder describes them.
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

/// What the two commands must say.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Expected {
    /// PROVED and SAME.
    Same,
    /// PROVED or UNKNOWN, SAME or UNKNOWN: the same, but only a model that the contract does not demand can tell.
    PerhapsSame,
    /// Anything but PROVED and SAME.
    Different,
    /// REFUTED and DIFFERENT.
    CertainlyDifferent,
    /// UNKNOWN and UNKNOWN.
    Unknown,
}

impl Expected {
    fn named(word: &str) -> Option<Self> {
        Some(match word {
            "same" => Self::Same,
            "same?" => Self::PerhapsSame,
            "different" => Self::Different,
            "different!" => Self::CertainlyDifferent,
            "unknown" => Self::Unknown,
            _ => return None,
        })
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Same => "same",
            Self::PerhapsSame => "same?",
            Self::Different => "different",
            Self::CertainlyDifferent => "different!",
            Self::Unknown => "unknown",
        })
    }
}

/// One pair of programs.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    /// Table, theme and what differs.
    pub(crate) name: String,
    pub(crate) expected: Expected,
    pub(crate) dialect: String,
    /// Of the program after, where it is for another control.
    pub(crate) dialect_after: Option<String>,
    pub(crate) machine: String,
    /// The claim that `certify` is asked for; all fields when absent.
    pub(crate) claim: Option<String>,
    pub(crate) before: String,
    pub(crate) after: String,
    /// Subprograms and settings beside the two programs, by file name.
    pub(crate) files: Vec<(String, String)>,
}

/// What a table or a section sets for its pairs.
#[derive(Clone, Default)]
struct Setting {
    dialect: String,
    dialect_after: Option<String>,
    machine: String,
    claim: Option<String>,
    frame: String,
    frame_after: Option<String>,
}

impl Setting {
    /// Takes `key value`; an unknown key is a mistake in the table.
    fn set(&mut self, key: &str, value: &str, place: &str) {
        let value = value.trim().to_owned();
        match key.trim() {
            "dialect" => self.dialect = value,
            "machine" => self.machine = value,
            "claim" => self.claim = Some(value),
            "frame" => self.frame = value,
            "dialect-after" => self.dialect_after = Some(value),
            "frame-after" => self.frame_after = Some(value),
            other => panic!("{place}: `{other}` is no setting"),
        }
    }

    /// The settings of a headline, `=== title | key value | key value`, and its title.
    fn of_headline<'t>(&self, headline: &'t str, place: &str) -> (&'t str, Self) {
        let mut parts = headline.split(" | ");
        let title = parts.next().unwrap_or_default().trim();
        let mut own = self.clone();
        for part in parts {
            let (key, value) = part.trim().split_once(' ').unwrap_or((part.trim(), ""));
            own.set(key, value, place);
        }
        (title, own)
    }
}

/// All pairs of one table.
pub(crate) fn read(file: &Path) -> Vec<Pair> {
    let text = std::fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let (mut setting, mut pairs) = (Setting::default(), Vec::new());
    let mut frames = BTreeMap::from([("none".to_owned(), "@@\n".to_owned())]);
    let (head, sections) = sections(&text);
    for line in head
        .lines()
        .filter(|line| !line.trim().is_empty() && !line.starts_with('#'))
    {
        let (key, value) = line
            .split_once(':')
            .unwrap_or_else(|| panic!("{stem}: `{line}` is no `key: value`"));
        setting.set(key, value, &stem);
    }
    for (headline, body) in sections {
        let place = format!("{stem}: {headline}");
        let (title, own) = setting.of_headline(headline, &place);
        if title == "frame" {
            assert!(body.contains("@@\n"), "{place}: a frame has a line `@@`");
            frames.insert(own.frame, body);
            continue;
        }
        let (kind, theme) = title
            .split_once(": ")
            .unwrap_or_else(|| panic!("{place}: a title is `word: name`"));
        let named = |name: &str| frames.get(name).unwrap_or_else(|| panic!("{place}: no frame `{name}`"));
        let frame = named(&own.frame);
        let frame_after = own.frame_after.as_deref().map_or(frame, named);
        let make = |name: String, expected: Expected, before: &str, after: &str, files: &[(String, String)]| Pair {
            name,
            expected,
            dialect: own.dialect.clone(),
            dialect_after: own.dialect_after.clone(),
            machine: own.machine.clone(),
            claim: own.claim.clone(),
            before: frame.replacen("@@\n", before, 1),
            after: frame_after.replacen("@@\n", after, 1),
            files: files.to_vec(),
        };
        if kind == "pairs" {
            let lines = body.lines().map(str::trim);
            for line in lines.filter(|line| !line.is_empty() && !line.starts_with("# ")) {
                let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
                let expected = Expected::named(word).unwrap_or_else(|| panic!("{place}: `{line}`: what is expected?"));
                let (before, after) = two_sides(rest, &place);
                let name = format!("{stem}: {theme}: {}", rest.trim());
                pairs.push(make(name, expected, &before, &after, &[]));
            }
        } else {
            let expected = Expected::named(kind).unwrap_or_else(|| panic!("{place}: what is expected?"));
            let [before, after, files] = &parts(&body, &place);
            let text = |part: &[(String, String)]| part[0].1.clone();
            pairs.push(make(
                format!("{stem}: {theme}"),
                expected,
                &text(before),
                &text(after),
                files,
            ));
        }
    }
    pairs
}

/// The text before the first headline, then each headline with what follows it.
fn sections(text: &str) -> (String, Vec<(&str, String)>) {
    let (mut head, mut all) = (String::new(), Vec::new());
    for line in text.lines() {
        if let Some(headline) = line.strip_prefix("=== ") {
            all.push((headline, String::new()));
        } else {
            let body = all.last_mut().map_or(&mut head, |(_, body)| body);
            body.push_str(line);
            body.push('\n');
        }
    }
    (head, all)
}

/// `a \ b || c`: the blocks before and after, one per line.
fn two_sides(line: &str, place: &str) -> (String, String) {
    // a blank on both sides, so that an empty side needs no special form
    let line = format!(" {} ", line.trim());
    let (before, after) = line
        .split_once(" || ")
        .unwrap_or_else(|| panic!("{place}: `{}` has no `||`", line.trim()));
    let blocks = |side: &str| -> String {
        let parts = side.split(" \\ ").map(str::trim).filter(|part| !part.is_empty());
        parts.flat_map(|part| [part, "\n"]).collect()
    };
    (blocks(before), blocks(after))
}

/// The parts `--- before`, `--- after` and `--- file NAME` of a section. `--- both` is a program compared with itself.
fn parts(body: &str, place: &str) -> [Vec<(String, String)>; 3] {
    let mut found: [Vec<(String, String)>; 3] = Default::default();
    let mut into: Vec<usize> = Vec::new();
    for line in body.lines() {
        if let Some(what) = line.strip_prefix("--- ") {
            let (slots, name): (&[usize], &str) = match what.split_once(' ') {
                None if what == "before" => (&[0], ""),
                None if what == "after" => (&[1], ""),
                None if what == "both" => (&[0, 1], ""),
                Some(("file", name)) => (&[2], name),
                _ => panic!("{place}: `--- {what}`"),
            };
            for slot in slots {
                found[*slot].push((name.to_owned(), String::new()));
            }
            into = slots.to_vec();
        } else {
            for slot in &into {
                let text = &mut found[*slot].last_mut().expect("begun above").1;
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    assert!(
        found[0].len() == 1 && found[1].len() == 1,
        "{place}: one `--- before`, one `--- after`"
    );
    found
}
