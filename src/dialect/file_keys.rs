//! The keys of `trunnion.toml` and of machine files, from their published schemas: what each means, and how it is written.
use serde_json::Value;
use std::sync::OnceLock;

/// Which file it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyFile {
    /// `trunnion.toml`.
    Settings,
    /// A machine file.
    Machine,
}

/// A key, or what stands in its place: an entry of a list, a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    file: KeyFile,
    /// As written in the schema: with the description of this use.
    node: &'static Value,
}

impl KeyFile {
    fn schema(self) -> &'static Value {
        static SETTINGS: OnceLock<Value> = OnceLock::new();
        static MACHINE: OnceLock<Value> = OnceLock::new();
        let (cell, text) = match self {
            Self::Settings => (&SETTINGS, include_str!("../../grammar/schemas/settings.json")),
            Self::Machine => (&MACHINE, include_str!("../../grammar/schemas/machine.json")),
        };
        cell.get_or_init(|| serde_json::from_str(text).unwrap_or_default())
    }

    /// The file as a whole.
    pub fn root(self) -> Key {
        Key {
            file: self,
            node: self.schema(),
        }
    }

    /// What is at a path of keys: `["axis", "dyn"]`; lists are entered.
    pub fn at<S: AsRef<str>>(self, path: &[S]) -> Option<Key> {
        path.iter()
            .try_fold(self.root(), |key, name| key.entered().key(name.as_ref()))
    }

    /// The tables that have a key of this name, each as a path.
    pub fn tables_with(self, name: &str) -> Vec<Vec<&'static str>> {
        fn search(key: Key, name: &str, path: &mut Vec<&'static str>, found: &mut Vec<Vec<&'static str>>) {
            let table = key.entered();
            for (own, inner) in table.keys() {
                if own == name {
                    found.push(path.clone());
                }
                path.push(own);
                search(inner, name, path, found);
                path.pop();
            }
        }
        let mut found = Vec::new();
        search(self.root(), name, &mut Vec::new(), &mut found);
        found
    }

    /// A table as people write it: `[limits]`, `[[axis]]`, `[[axis]] dyn`; empty for the top of the file.
    pub fn title<S: AsRef<str>>(self, path: &[S]) -> String {
        let Some((first, rest)) = path.split_first() else {
            return String::new();
        };
        let first = first.as_ref();
        let is_list = self
            .root()
            .key(first)
            .is_some_and(|key| key.resolved()["type"] == "array");
        let mut title = if is_list {
            format!("[[{first}]]")
        } else {
            format!("[{first}]")
        };
        for name in rest {
            title.push(' ');
            title.push_str(name.as_ref());
        }
        title
    }
}

impl Key {
    /// The definition that it refers to.
    fn resolved(self) -> &'static Value {
        let Some(name) = self.node["$ref"].as_str() else {
            return self.node;
        };
        name.rsplit('/')
            .next()
            .map_or(self.node, |name| &self.file.schema()["$defs"][name])
    }

    fn with(self, node: &'static Value) -> Self {
        Self { file: self.file, node }
    }

    /// An entry of it, where it is a list of tables; else itself.
    fn entered(self) -> Self {
        let node = self.resolved();
        if node["items"].is_object() {
            self.with(&node["items"])
        } else {
            self
        }
    }

    /// An entry of a list.
    pub fn item(self) -> Option<Self> {
        let items = &self.resolved()["items"];
        items.is_object().then(|| self.with(items))
    }

    /// A key of this table, or of an entry where it is a list of tables.
    pub fn key(self, name: &str) -> Option<Self> {
        let node = self.entered().resolved();
        let own = node["properties"].get(name);
        let any = || Some(&node["additionalProperties"]).filter(|any| any.is_object());
        own.or_else(any).map(|node| self.with(node))
    }

    /// The keys of this table, in order; none where any key may stand.
    pub fn keys(self) -> impl Iterator<Item = (&'static str, Self)> {
        let properties = self.entered().resolved()["properties"].as_object();
        let all = properties.into_iter().flatten();
        all.map(move |(name, node)| (name.as_str(), self.with(node)))
    }

    /// A key that this table must have, else one that it may have.
    pub fn first_key(self) -> Option<&'static str> {
        let required = self.entered().resolved()["required"][0].as_str();
        required.or_else(|| self.keys().next().map(|(name, _)| name))
    }

    /// What it means; empty where the schema does not say.
    pub fn description(self) -> &'static str {
        let own = self.node["description"].as_str();
        own.or_else(|| self.resolved()["description"].as_str())
            .unwrap_or_default()
    }

    /// What it means without defaults: the first sentence.
    pub fn meaning(self) -> &'static str {
        let text = self.description();
        let end = text.find(". ").unwrap_or(text.len());
        text[..end].trim_end_matches('.')
    }

    /// What its value must be; `None` where several kinds are possible.
    pub fn kind(self) -> Option<String> {
        let node = self.resolved();
        if let Some(texts) = choices(node) {
            return Some(texts.join(" or "));
        }
        let of_numbers = node["items"]["type"] == "number";
        Some(match node["type"].as_str()? {
            "string" => "a text in quotes".to_owned(),
            "integer" => "a whole number".to_owned(),
            "number" => "a number".to_owned(),
            "boolean" => "true or false".to_owned(),
            "array" => match node["minItems"].as_u64() {
                Some(2) if of_numbers => "a list of two numbers".to_owned(),
                Some(3) if of_numbers => "a list of three numbers".to_owned(),
                _ if self.entered().keys().next().is_some() => "a list of tables".to_owned(),
                _ => "a list in brackets".to_owned(),
            },
            "object" => "a table".to_owned(),
            _ => return None,
        })
    }

    /// A value that is written rightly: one that the schema gives, or any of its kind.
    pub fn example(self) -> Option<String> {
        let given = self.node["examples"]
            .get(0)
            .or_else(|| self.resolved()["examples"].get(0));
        if let Some(given) = given {
            return Some(as_toml(given));
        }
        let node = self.resolved();
        if let Some(texts) = choices(node) {
            return texts.first().cloned();
        }
        Some(match node["type"].as_str()? {
            "string" => {
                let quoted = self.description().split('"').nth(1)?;
                format!("\"{quoted}\"")
            }
            "integer" => "1".to_owned(),
            "number" => "1.0".to_owned(),
            "boolean" => "true".to_owned(),
            "array" => {
                let item = self.item()?.example()?;
                let count = node["minItems"].as_u64().unwrap_or(1).max(1) as usize;
                format!("[{}]", vec![item; count].join(", "))
            }
            "object" if node["additionalProperties"]["type"] == "number" => "{ X = 0, Y = 0, Z = 0 }".to_owned(),
            _ => return None,
        })
    }
}

/// The only texts that a value may be, in quotes.
fn choices(node: &Value) -> Option<Vec<String>> {
    if let Some(only) = node["const"].as_str() {
        return Some(vec![format!("\"{only}\"")]);
    }
    let all = node["enum"].as_array()?;
    Some(
        all.iter()
            .filter_map(Value::as_str)
            .map(|text| format!("\"{text}\""))
            .collect(),
    )
}

fn as_toml(value: &Value) -> String {
    match value {
        Value::Object(table) => {
            let entries: Vec<String> = table
                .iter()
                .map(|(key, value)| format!("{key} = {}", as_toml(value)))
                .collect();
            format!("{{ {} }}", entries.join(", "))
        }
        Value::Array(list) => format!("[{}]", list.iter().map(as_toml).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::KeyFile::{Machine, Settings};

    #[test]
    fn a_key_is_found_by_its_path() {
        let key = |file: super::KeyFile, path: &[&str]| file.at(path).expect("a key");
        assert_eq!(
            key(Settings, &["tool", "number"]).meaning(),
            "Number of the tool, each once"
        );
        assert_eq!(
            key(Settings, &["tool", "number"]).kind().as_deref(),
            Some("a whole number")
        );
        assert_eq!(
            key(Machine, &["axis", "dyn", "vmax"]).kind().as_deref(),
            Some("a number")
        );
        assert_eq!(key(Machine, &["schema"]).example().as_deref(), Some("\"ncmachine/1\""));
        let offset = key(Settings, &["work_offsets", "G54"]);
        assert_eq!(offset.kind().as_deref(), Some("a table"));
        assert_eq!(offset.example().as_deref(), Some("{ X = 0, Y = 0, Z = 0 }"));
        assert_eq!(
            key(Machine, &["spindle", "tool_axis"]).kind().as_deref(),
            Some("a list of three numbers")
        );
        assert!(Settings.at(&["tool", "numbr"]).is_none());
        assert_eq!(Machine.title(&["axis", "dyn"]), "[[axis]] dyn");
        assert_eq!(Settings.title(&["limits"]), "[limits]");
        assert_eq!(Settings.tables_with("tip"), [["tolerances"]]);
        assert_eq!(Machine.tables_with("letter"), [["axis"]]);
    }
}
