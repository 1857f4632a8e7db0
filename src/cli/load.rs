//! From a path to a parsed program with everything it is checked with.
use super::{args::Global, failure::Failure};
use std::{io::Read, path::Path};
use trunnion_machine::Machine;
use trunnion_syntax::Program;
use trunnion_workspace::{Overrides, Resolved, resolve};

/// A program with everything it is checked with.
pub(crate) struct Loaded {
    /// For people: the path as given, or `<stdin>`.
    pub(crate) name: String,
    /// Parsed.
    pub(crate) program: Program,
    /// Settings, machine, dialect.
    pub(crate) resolved: Resolved,
}

impl Loaded {
    /// The machine, or a failure that says how to name one.
    pub(crate) fn machine_or_fail(&self, what: &str) -> Result<&Machine, Failure> {
        self.resolved.machine.as_ref().ok_or_else(|| {
            Failure::new(format!(
                "{what} needs a machine: add --machine NAME (`trunnion machine list` names the embedded ones) or \
                 `machine = \"NAME\"` in trunnion.toml"
            ))
        })
    }
    /// One line on what was taken and why, for `-v`.
    pub(crate) fn explanation(&self) -> String {
        let r = &self.resolved;
        let machine = r.machine.as_ref().map_or("none", |m| m.id.as_str());
        let config = r
            .config_path
            .as_ref()
            .map_or_else(|| "none".to_owned(), |p| p.display().to_string());
        format!(
            "{}: dialect {} ({}); machine {machine} ({}); settings {config}",
            self.name, r.dialect.name, r.dialect_reason, r.machine_reason
        )
    }
}

/// What the global options say.
pub(crate) fn overrides(global: &Global) -> Overrides {
    Overrides {
        machine: global.machine.clone(),
        dialect: global.dialect.clone(),
        config: global.config.clone(),
        tool: global.tool.clone(),
        allow: global.allow.clone(),
        port_to: global.port_to.clone(),
    }
}

/// Whether the path means standard input.
pub(crate) fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Bytes of a file, or of standard input for `-`.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    if is_stdin(path) {
        let mut bytes = Vec::new();
        std::io::stdin()
            .lock()
            .read_to_end(&mut bytes)
            .map_err(|error| Failure::io(path, "read standard input", &error))?;
        return Ok(bytes);
    }
    if path.is_dir() {
        return Err(Failure::file(path, "is a directory; this command takes one program"));
    }
    std::fs::read(path).map_err(|error| Failure::io(path, "read the file", &error))
}

/// Reads and parses a program with its settings.
pub(crate) fn load(global: &Global, path: &Path) -> Result<Loaded, Failure> {
    let source = read(path)?;
    let stdin = is_stdin(path);
    let resolved = resolve((!stdin).then_some(path), &source, &overrides(global))?;
    let program = trunnion_syntax::parse(source, resolved.dialect.lex);
    let name = if stdin {
        "<stdin>".to_owned()
    } else {
        path.display().to_string()
    };
    Ok(Loaded {
        name,
        program,
        resolved,
    })
}
