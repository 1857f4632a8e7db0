//! Keys of `trunnion.toml` and of machine files. The reader of the file itself says which keys a table may have, so that the list is always
//! the true one; the example of the settings page explains those of `trunnion.toml`.
use core::ops::Range;
use trunnion_check::{Config, or_known};

/// The page of settings, whose example explains each key.
const PAGE: &str = include_str!("../../docs/settings.md");

/// A key that no table has.
const PROBE: &str = "zzqqzz";

/// Which file it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TomlFile {
    /// `trunnion.toml`.
    Settings,
    /// A machine file.
    Machine,
}

impl TomlFile {
    /// What is wrong with a text, and its bytes where known.
    pub fn problem(self, text: &str) -> Option<(String, Option<Range<usize>>)> {
        match self {
            Self::Settings => match Config::parse(text) {
                Ok(config) => unknown_name(&config, text),
                Err(error) => Some((error.message, error.span)),
            },
            Self::Machine => trunnion_machine::load("machine", text)
                .err()
                .map(|error| (error.message, error.span)),
        }
    }

    /// The keys that the table with this header may have; empty where any key may stand, and where there is no such table.
    fn keys(self, header: &str) -> Vec<String> {
        let head = match self {
            Self::Settings => "",
            Self::Machine => "schema = \"ncmachine/1\"\n",
        };
        let probe = format!("{head}{header}\n{PROBE} = 0\n");
        let Some((message, _)) = self.problem(&probe) else {
            return Vec::new();
        };
        let Some((_, known)) = message.split_once(&format!("`{PROBE}`; known keys: ")) else {
            return Vec::new();
        };
        known.split(", ").map(str::to_owned).collect()
    }
}

/// A machine or dialect that the settings name and that does not exist.
fn unknown_name(config: &Config, text: &str) -> Option<(String, Option<Range<usize>>)> {
    let place = |name: &str| {
        let at = text.find(&format!("\"{name}\""))? + 1;
        Some(at..at + name.len())
    };
    if let Some(name) = config.dialect.as_deref()
        && trunnion_dialect::named(name, String::new(), true).is_none()
    {
        let hint = or_known(name, trunnion_dialect::BUILTIN_NAMES, "dialects");
        return Some((format!("unknown dialect `{name}`{hint}"), place(name)));
    }
    let name = config.machine.as_deref()?;
    let is_file = name.contains(['/', '\\']) || name.to_ascii_lowercase().ends_with(".toml");
    if is_file || trunnion_machine::builtin(name).is_some() {
        return None;
    }
    let hint = or_known(name, trunnion_machine::BUILTIN_MACHINES, "machines");
    Some((format!("unknown machine `{name}`{hint}"), place(name)))
}

/// The header of the table that byte `at` is in, as it is written; empty at the top.
fn header(text: &str, at: usize) -> &str {
    let before = text.get(..at).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    before[..line_start]
        .lines()
        .rev()
        .map(str::trim)
        .find(|line| line.starts_with('['))
        .map_or("", |line| line.split('#').next().unwrap_or(line).trim())
}

/// Keys for the beginning of a line, with their explanation, and the bytes that they take the place of.
pub fn toml_completions(file: TomlFile, text: &str, at: usize) -> (Vec<(String, String)>, Range<usize>) {
    let at = at.min(text.len());
    let before = text.get(..at).unwrap_or(text);
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = &before[start..];
    let (typed, header, list) = match line.trim_start().trim_start_matches('[') {
        _ if line.contains(['=', '#', '"']) => return (Vec::new(), at..at),
        name if line.trim_start().starts_with('[') => (name, "", file.keys("")),
        name => (name, header(text, at), file.keys(header(text, at))),
    };
    let from = at - typed.len();
    let found = list
        .into_iter()
        .filter(|key| key.starts_with(typed))
        .map(|key| {
            let docs = docs(file, header, &key);
            (key, docs)
        })
        .collect();
    (found, from..at)
}

/// What the key at a byte means, and its bytes.
pub fn toml_at(file: TomlFile, text: &str, at: usize) -> Option<(String, Range<usize>)> {
    let at = at.min(text.len());
    let start = text.get(..at)?.rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next()?;
    let bare = line.trim_start();
    let indent = line.len() - bare.len();
    let (key, from, header) = if bare.starts_with('[') {
        let name = bare.trim_start_matches('[');
        let key = name.split([']', '.']).next()?.trim();
        (key, start + indent + bare.len() - name.len(), "")
    } else {
        (bare.split('=').next()?.trim(), start + indent, header(text, at))
    };
    if key.is_empty() || key.starts_with('#') || !(from..=from + key.len()).contains(&at) {
        return None;
    }
    let known = file.keys(header);
    if !known.is_empty() && !known.iter().any(|name| name == key) {
        return None;
    }
    let docs = docs(file, header, key);
    if docs.is_empty() && known.is_empty() {
        return None;
    }
    Some((
        format!("**{key}** {docs}").trim_end().to_owned(),
        from..from + key.len(),
    ))
}

/// What the page of settings says about a key: the line of its example, with its remark.
fn docs(file: TomlFile, header: &str, key: &str) -> String {
    if file == TomlFile::Machine {
        let item = PAGE.lines().position(|line| {
            line.starts_with(&format!("* `{key}")) || line.starts_with(&format!("* `[control] {key}"))
        });
        let Some(item) = item else { return String::new() };
        let mut text = String::new();
        for line in PAGE
            .lines()
            .skip(item)
            .enumerate()
            .take_while(|(at, line)| *at == 0 || line.starts_with("  "))
            .map(|(_, line)| line)
        {
            text.push_str(line.trim_start_matches("* ").trim());
            text.push(' ');
        }
        return text.trim_end().to_owned();
    }
    let example = PAGE.split("```").nth(1).unwrap_or_default();
    let mut table = "";
    for line in example.lines() {
        let (code, remark) = line
            .split_once(" # ")
            .or_else(|| line.split_once("# "))
            .unwrap_or((line, ""));
        let code = code.trim();
        if code.starts_with('[') {
            table = code;
            if header.is_empty() && code.trim_matches(['[', ']']) == key {
                return remark.trim().to_owned();
            }
        } else if table == header && code.split('=').next().is_some_and(|name| name.trim() == key) {
            return format!("{}\n\n```toml\n{code}\n```", remark.trim());
        }
    }
    String::new()
}
