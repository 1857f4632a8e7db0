//! What a caller asks for: the options of `trunnion check`, and the texts of the files that it would read.
use serde::Deserialize;
use std::{collections::BTreeMap, path::PathBuf};
use trunnion_check::{Scope, Severity};
use trunnion_workspace::{Overrides, Texts};

/// The settings file, where `files` has one.
const SETTINGS: &str = "trunnion.toml";

/// Options, as JSON. All but the name may be left out.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Request {
    /// Name of the program; its extension may name a dialect.
    pub(crate) name: String,
    machine: Option<String>,
    dialect: Option<String>,
    tool: Option<String>,
    allow: Vec<String>,
    port_to: Vec<String>,
    assume: Vec<String>,
    block_delete: Option<Switch>,
    scope: Option<Judged>,
    deny: Deny,
    /// Settings (`trunnion.toml`), machine files, dialect tables and called programs by their names.
    files: BTreeMap<PathBuf, String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Switch {
    On,
    Off,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Judged {
    Language,
    Motion,
    Machine,
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Deny {
    #[default]
    Error,
    Warning,
    Info,
}

impl Request {
    /// Reads it.
    ///
    /// # Errors
    /// It is not JSON, or an option is not known or has a wrong value.
    pub fn read(json: &str) -> Result<Self, String> {
        serde_json::from_str(json).map_err(|error| format!("these options cannot be read: {error}"))
    }

    pub(crate) fn scope(&self) -> Option<Scope> {
        self.scope.map(|scope| match scope {
            Judged::Language => Scope::Language,
            Judged::Motion => Scope::Motion,
            Judged::Machine => Scope::Machine,
        })
    }

    pub(crate) fn deny(&self) -> Severity {
        match self.deny {
            Deny::Error => Severity::Error,
            Deny::Warning => Severity::Warning,
            Deny::Info => Severity::Info,
        }
    }

    pub(crate) fn overrides(&self) -> Overrides {
        let settings = PathBuf::from(SETTINGS);
        Overrides {
            machine: self.machine.clone(),
            dialect: self.dialect.clone(),
            config: self.files.contains_key(&settings).then_some(settings),
            tool: self.tool.clone(),
            allow: self.allow.clone(),
            port_to: self.port_to.clone(),
            block_delete: self.block_delete.map(|switch| switch == Switch::On),
            assume: self.assume.clone(),
            texts: Texts(self.files.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_option_that_is_not_known_is_named() {
        let error = Request::read(r#"{"name": "a.nc", "machin": "x"}"#).expect_err("refused");
        assert!(error.contains("`machin`"), "{error}");
        let request =
            Request::read(r#"{"name": "a.nc", "block_delete": "on", "files": {"trunnion.toml": ""}}"#).expect("read");
        let overrides = request.overrides();
        assert_eq!(overrides.block_delete, Some(true));
        assert_eq!(overrides.config.as_deref(), Some(std::path::Path::new(SETTINGS)));
    }
}
