//! What is wrong with a TOML file (settings, machine, dialect), for people: its reader speaks of fields, variants and types. The message names the
//! key, its table, what the value must be, and a line that is right.
use crate::file_keys::{Key, KeyFile};
use crate::nearest::{did_you_mean, nearest, or_known};
use crate::toml_place::TomlPlace;
use core::ops::Range;

/// The message of the reader of TOML in words. `span`: the bytes of the text where it is; `file`: whose keys they are, where they are published.
pub fn plain_toml(file: Option<KeyFile>, text: &str, message: &str, span: Option<Range<usize>>) -> String {
    let complaint = Complaint { file, text, span };
    if let Some(key) = message
        .strip_prefix("missing field `")
        .and_then(|rest| rest.strip_suffix('`'))
    {
        return complaint.missing(key);
    }
    if let Some((key, rest)) = message
        .strip_prefix("unknown field `")
        .and_then(|rest| rest.split_once('`'))
    {
        let known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        return complaint.unknown(key, &known);
    }
    if let Some((given, rest)) = message
        .strip_prefix("unknown variant `")
        .and_then(|rest| rest.split_once("`, expected "))
    {
        let known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        return complaint.unknown_value(given, &known);
    }
    let written = complaint.span.clone().and_then(|span| text.get(span));
    if let (true, Some(key)) = (message == "duplicate key", written) {
        return format!("`{key}` is declared twice: keep one of them, with all that belongs to it");
    }
    if let Some(told) = complaint
        .unquoted()
        .filter(|_| message.starts_with("string values must be quoted"))
    {
        return told;
    }
    if message == "recursion limit" || message.starts_with("cannot recurse further") {
        return TOO_DEEP.to_owned();
    }
    let expected = ["invalid type: ", "invalid value: ", "invalid length "];
    // one of several words
    if message == "wanted string or table" {
        return complaint.wrong_kind("a string").unwrap_or_else(|| message.to_owned());
    }
    let told = || {
        let rest = expected.iter().find_map(|start| message.strip_prefix(start))?;
        complaint.wrong_kind(rest.rsplit_once(", expected ")?.1)
    };
    told().unwrap_or_else(|| message.to_owned())
}

/// Dots, brackets or braces without end.
const TOO_DEEP: &str = "lists, tables or dotted keys stand inside each other too often here; no key of such a file is more than a few levels deep: \
                        remove the brackets, braces or dots that are too many";

/// Something that the reader refuses, with its place.
struct Complaint<'t> {
    file: Option<KeyFile>,
    text: &'t str,
    span: Option<Range<usize>>,
}

impl Complaint<'_> {
    fn place(&self) -> Option<TomlPlace> {
        Some(TomlPlace::of(self.text, self.span.clone()?.start))
    }

    fn key_at(&self, table: &[String], name: &str) -> Option<Key> {
        let mut path = table.to_vec();
        path.push(name.to_owned());
        self.file?.at(&path)
    }

    /// ` in [limits]`; empty at the top of the file.
    fn in_table(&self, table: &[String]) -> String {
        match self.file {
            Some(file) if !table.is_empty() => format!(" in {}", file.title(table)),
            _ => String::new(),
        }
    }

    fn missing(&self, key: &str) -> String {
        let start = self.span.as_ref().map_or(0, |span| span.start);
        let table = TomlPlace::of_table(self.text, start);
        let whose = match self.file {
            Some(file) if !table.is_empty() => file.title(&table),
            None if !table.is_empty() => format!("[{}]", table.join(".")),
            _ => "the file".to_owned(),
        };
        let Some(known) = self.key_at(&table, key) else {
            return format!("{whose} lacks `{key}`: add it");
        };
        let line = known
            .example()
            .map_or_else(|| format!("`{key}`"), |example| format!("`{key} = {example}`"));
        format!("{whose} lacks `{key}` ({}): add {line}", known.meaning())
    }

    fn unknown(&self, key: &str, known: &[&str]) -> String {
        let table = self.place().map(|place| place.table).unwrap_or_default();
        let here = self.in_table(&table);
        // a key of another table is more likely misplaced than misspelt
        let elsewhere = self.file.map(|file| file.tables_with(key)).unwrap_or_default();
        if let (Some(file), [first, ..]) = (self.file, elsewhere.as_slice())
            && nearest(key, known.iter().copied()).is_none()
        {
            let places: Vec<String> = (elsewhere.iter().take(3))
                .map(|path| match path.as_slice() {
                    [] => "the top of the file, before the first table".to_owned(),
                    path => file.title(path),
                })
                .collect();
            let given = self.key_at(&first.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>(), key);
            let what = given.map_or("", Key::meaning);
            let what = if elsewhere.len() == 1 && !what.is_empty() {
                format!(" ({what})")
            } else {
                String::new()
            };
            return format!("unknown key `{key}`{here}: it belongs in {}{what}", places.join(" or "));
        }
        format!("unknown key `{key}`{here}{}", or_known(key, known, "keys"))
    }

    fn unknown_value(&self, given: &str, known: &[&str]) -> String {
        let what = self.place().map_or_else(String::new, |place| {
            let named = place
                .key
                .as_ref()
                .map_or_else(String::new, |key| format!(" of `{key}`"));
            named + &self.in_table(&place.table)
        });
        format!(
            "unknown value `{given}`{what}{}",
            did_you_mean(given, known, &format!("; write {}", known.join(" or ")))
        )
    }

    /// A value that is neither a number nor in quotes: a number with its unit, or a text.
    fn unquoted(&self) -> Option<String> {
        let start = self.span.as_ref()?.start;
        let from = self.text.get(..start)?.rfind('\n').map_or(0, |end| end + 1);
        let line = self.text.get(from..)?.lines().next()?;
        let (name, value) = line.split_once('=')?;
        let (name, value) = (name.trim(), value.split('#').next().unwrap_or_default().trim());
        let table = self.place()?.table;
        let known = self.key_at(&table, name);
        let here = self.in_table(&table);
        let digits = value
            .bytes()
            .take_while(|byte| byte.is_ascii_digit() || b"+-.".contains(byte));
        let (number, unit) = value.split_at(digits.count());
        if number.parse::<f64>().is_ok_and(f64::is_finite) && !unit.contains(['"', '[', '{', ',']) {
            let meaning = known.map(Key::meaning).filter(|meaning| !meaning.is_empty());
            let meaning = meaning.map_or_else(String::new, |meaning| format!(" ({meaning})"));
            return Some(format!(
                "`{name}`{here} must be a number without its unit{meaning}: `{name} = {number}`"
            ));
        }
        let plain = !value.is_empty() && !value.contains(['"', '\'', '[', '{', '\\']);
        plain.then(|| format!("`{name}`{here} must be a text in quotes: `{name} = \"{value}\"`"))
    }

    /// A value of another kind than the one that is `expected`.
    fn wrong_kind(&self, expected: &str) -> Option<String> {
        let place = self.place()?;
        let name = place.key.clone()?;
        let known = self.key_at(&place.table, &name);
        let entry = known.and_then(|key| (0..place.lists).try_fold(key, |key, _| key.item()));
        let kind = entry.and_then(Key::kind).or_else(|| plain_kind(expected))?;
        let whose = if place.lists > 0 {
            format!("an entry of `{name}`")
        } else {
            format!("`{name}`")
        };
        let meaning = known.map_or("", Key::meaning);
        let meaning = if meaning.is_empty() {
            String::new()
        } else {
            format!(" ({meaning})")
        };
        let line = self.right_line(&place.table, &name, known, place.lists);
        let here = self.in_table(&place.table);
        Some(format!("{whose}{here} must be {kind}{meaning}{line}"))
    }

    /// A line that is right, as the end of a sentence: with the value that was written, if it only has to be written otherwise.
    fn right_line(&self, around: &[String], name: &str, known: Option<Key>, lists: usize) -> String {
        let written = self
            .span
            .clone()
            .and_then(|span| self.text.get(span))
            .unwrap_or_default()
            .trim();
        let is_bare = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-');
        let shown = if name.bytes().all(is_bare) {
            name.to_owned()
        } else {
            format!("\"{name}\"")
        };
        if lists == 0 {
            let kind = known.and_then(Key::kind);
            let inside = written.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
            let number = inside.filter(|inside| inside.parse::<f64>().is_ok_and(f64::is_finite));
            if let (Some(number), Some("a number" | "a whole number")) = (number, kind.as_deref()) {
                return format!(": `{shown} = {number}`");
            }
            if kind.as_deref() == Some("a table")
                && let Some(values) = axis_values(written)
            {
                return format!(": `{shown} = {values}`");
            }
        }
        let table = known.filter(|_| lists == 0).and_then(Key::first_key);
        if let Some((first, file)) = table.zip(self.file) {
            let header = match around {
                [] => file.title(&[name]),
                around => format!("[{}.{name}]", around.join(".")),
            };
            return format!(": write `{header}` on a line of its own and its keys below, for example `{first}`");
        }
        known
            .and_then(Key::example)
            .map_or_else(String::new, |example| format!(": `{shown} = {example}`"))
    }
}

/// `[10, 20, 30]` as values of X, Y and Z; none for anything else.
fn axis_values(list: &str) -> Option<String> {
    let inside = list.strip_prefix('[')?.strip_suffix(']')?;
    let values: Vec<&str> = inside
        .split(',')
        .map(str::trim)
        .filter(|value| !value.is_empty())
        .collect();
    let numbers = (1..=3).contains(&values.len())
        && values
            .iter()
            .all(|value| value.parse::<f64>().is_ok_and(f64::is_finite));
    let named = || {
        values
            .iter()
            .zip(["X", "Y", "Z"])
            .map(|(value, axis)| format!("{axis} = {value}"))
    };
    numbers.then(|| format!("{{ {} }}", named().collect::<Vec<_>>().join(", ")))
}

/// What the reader expects, in words.
fn plain_kind(expected: &str) -> Option<String> {
    let kind = match expected {
        "f64" => "a number",
        "i64" | "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number",
        "a string" | "string" => "a text in quotes",
        "a sequence" => "a list in brackets",
        "a boolean" => "true or false",
        "a map" => "a table",
        _ if expected.starts_with("an array of length 3") => "a list of three numbers, like [0, 0, 1]",
        _ if expected.starts_with("an array of length 2") => "a list of two numbers, like [-100, 100]",
        _ if expected.starts_with("struct ") => "a table",
        _ => return None,
    };
    Some(kind.to_owned())
}
