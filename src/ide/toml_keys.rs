//! Keys of `trunnion.toml` and of machine files. Their published schemas say which keys a table may have and explain them.
use core::ops::Range;
use trunnion_check::{Config, or_known};
use trunnion_dialect::{Key, KeyFile, TomlPlace};

/// Which file it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TomlFile {
    /// `trunnion.toml`.
    Settings,
    /// A machine file.
    Machine,
    /// Something else, of which nothing is said.
    Other,
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
            Self::Other => None,
        }
    }

    fn keys(self) -> Option<KeyFile> {
        match self {
            Self::Settings => Some(KeyFile::Settings),
            Self::Machine => Some(KeyFile::Machine),
            Self::Other => None,
        }
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
        let hint = trunnion_dialect::dialect_hint(name);
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

/// What the schema says of a key, with a line that is right.
fn docs(name: &str, key: Key) -> String {
    let example = key.example().filter(|_| key.keys().next().is_none());
    let example = example.map_or_else(String::new, |value| format!("\n\n```toml\n{name} = {value}\n```"));
    key.description().to_owned() + &example
}

fn in_key(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-')
}

/// Keys for the place of the cursor, with their explanation, and the bytes that they take the place of.
pub fn toml_completions(file: TomlFile, text: &str, at: usize) -> (Vec<(String, String)>, Range<usize>) {
    let at = at.min(text.len());
    let before = text.get(..at).unwrap_or(text);
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = &before[start..];
    let letters = line.bytes().rev().take_while(|byte| in_key(*byte)).count();
    let (typed, from) = (&line[line.len() - letters..], at - letters);
    // an open `[` at the beginning of a line is the header of a table
    let table = match line[..line.len() - letters].trim() {
        "[" | "[[" => Vec::new(),
        _ if line.contains(['#', '"']) => return (Vec::new(), at..at),
        _ => {
            let place = TomlPlace::of(text, from);
            if place.key.is_some() {
                return (Vec::new(), at..at);
            }
            place.table
        }
    };
    let table = file.keys().and_then(|keys| keys.at(&table));
    let keys = table.into_iter().flat_map(Key::keys);
    let found = keys.filter(|(key, _)| key.starts_with(typed));
    (
        found.map(|(name, key)| (name.to_owned(), docs(name, key))).collect(),
        from..at,
    )
}

/// What the key at a byte means, and its bytes.
pub fn toml_at(file: TomlFile, text: &str, at: usize) -> Option<(String, Range<usize>)> {
    let at = at.min(text.len());
    let (before, after) = text.split_at_checked(at)?;
    let from = at - before.bytes().rev().take_while(|byte| in_key(*byte)).count();
    let to = at + after.bytes().take_while(|byte| in_key(*byte)).count();
    let rest = text[to..].trim_start_matches([' ', '\t']);
    if from == to || !rest.starts_with(['=', ']', '.']) {
        return None;
    }
    let place = TomlPlace::of(text, from);
    if place.key.is_some() {
        return None;
    }
    let name = &text[from..to];
    let key = file.keys()?.at(&place.table)?.key(name)?;
    let docs = docs(name, key);
    (!docs.is_empty()).then(|| (format!("**{name}** {docs}"), from..to))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hover(file: TomlFile, text: &str) -> Option<String> {
        let at = text.find('|').expect("a mark");
        toml_at(file, &text.replace('|', ""), at).map(|(said, _)| said)
    }

    /// Every key of both schemas has a description, and the editor shows it where the key stands.
    #[test]
    fn every_key_is_explained_where_it_stands() {
        fn all(table: Key, path: &mut Vec<&'static str>, found: &mut Vec<(Vec<&'static str>, &'static str)>) {
            for (name, key) in table.keys() {
                path.push(name);
                found.push((path.clone(), key.description()));
                all(key, path, found);
                path.pop();
            }
        }
        for file in [TomlFile::Settings, TomlFile::Machine] {
            let mut found = Vec::new();
            all(file.keys().expect("a schema").root(), &mut Vec::new(), &mut found);
            assert!(found.len() > 60, "{file:?}: {}", found.len());
            for (path, said) in found {
                assert!(said.len() > 1, "{file:?} {path:?} has no description");
                let (name, tables) = path.split_last().expect("a name");
                let text = match tables {
                    [] => format!("|{name} = 1"),
                    [table, inner @ ..] => {
                        let open = inner.iter().fold(String::new(), |open, name| open + name + " = { ");
                        format!("{}\n{open}|{name} = 1", file.keys().expect("a schema").title(&[table]))
                    }
                };
                let shown = hover(file, &text).unwrap_or_else(|| panic!("{text}"));
                assert!(shown.starts_with(&format!("**{name}** {said}")), "{text}: {shown}");
            }
        }
    }

    #[test]
    fn only_keys_are_explained() {
        for text in [
            "machine = \"mi|ll-3axis\"",
            "# mach|ine",
            "[limits]\nmach|ine = 1",
            "nos|uch = 1",
            "|",
        ] {
            assert_eq!(hover(TomlFile::Settings, text), None, "{text}");
        }
    }

    #[test]
    fn keys_are_completed_in_their_table() {
        let names = |file, text: &str| -> Vec<String> {
            let at = text.find('|').expect("a mark");
            let (found, place) = toml_completions(file, &text.replace('|', ""), at);
            assert!(place.end == at && place.start <= at);
            found
                .into_iter()
                .map(|(name, docs)| {
                    assert!(docs.len() > 1, "{name}");
                    name
                })
                .collect()
        };
        assert_eq!(names(TomlFile::Settings, "[limits]\nbl|"), ["blocks"]);
        assert_eq!(names(TomlFile::Settings, "mach|"), ["machine", "machine_path"]);
        assert_eq!(
            names(TomlFile::Settings, "[[to|"),
            ["tolerances", "tool", "tool_offsets"]
        );
        assert_eq!(
            names(TomlFile::Machine, "[[axis]]\nletter = \"X\"\ndyn = { vmax = 1, am|"),
            ["amax"]
        );
        assert_eq!(names(TomlFile::Machine, "[control.corner]\nmod|"), ["model"]);
        for none in ["machine = m|", "# mach|", "[variables]\nR|"] {
            assert!(names(TomlFile::Settings, none).is_empty(), "{none}");
        }
    }
}
