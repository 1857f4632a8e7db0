//! From a path to a parsed program with everything it is checked with.
use super::{
    args::{Global, Switch},
    failure::Failure,
};
use std::{fs::File, io::Read, path::Path};
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
        block_delete: global.block_delete.map(|switch| switch == Switch::On),
    }
}

/// Whether the path means standard input.
pub(crate) fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Bytes in a megabyte as `--max-file-mb` counts it.
const MEGABYTE: u64 = 1_000_000;
/// Places in a file are counted in 32 bits, so no larger one is read, megabytes.
const MOST_MEGABYTES: u64 = 4_294;

/// Bytes of a file of at most 4.29 GB, or of standard input for `-`.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    bytes(path, MOST_MEGABYTES)?.ok_or_else(|| {
        Failure::file(
            path,
            format!("is larger than {MOST_MEGABYTES} MB, the largest size that can be read; split it"),
        )
    })
}

/// Bytes of a program whose blocks are all held at once: up to nine bytes of memory for each byte of it, so its size is bounded.
pub(crate) fn read_program(global: &Global, path: &Path) -> Result<Vec<u8>, Failure> {
    let most = global.max_file_mb;
    bytes(path, most.min(MOST_MEGABYTES))?.ok_or_else(|| {
        if most >= MOST_MEGABYTES {
            let text = format!("is larger than {MOST_MEGABYTES} MB, the largest size that can be read; split it");
            return Failure::file(path, text);
        }
        Failure::file(
            path,
            format!(
                "is larger than {most} MB and was not read; `--max-file-mb N` raises the limit (it needs memory of ten times the \
                 file size or more)"
            ),
        )
    })
}

/// Bytes of a file or of standard input; `None` where there are more than `megabytes`. Reads no more than that, so a device or
/// a pipe without an end is refused too.
fn bytes(path: &Path, megabytes: u64) -> Result<Option<Vec<u8>>, Failure> {
    let most = megabytes.saturating_mul(MEGABYTE);
    let mut bytes = Vec::new();
    let read = if is_stdin(path) {
        std::io::stdin().lock().take(most + 1).read_to_end(&mut bytes)
    } else {
        if path.is_dir() {
            return Err(Failure::file(path, "is a directory; this command takes one program"));
        }
        File::open(path).and_then(|file| {
            // a regular file reports its size: one that is too large is not read at all
            let told = file.metadata()?.len();
            if told > most {
                return Ok(most as usize + 1);
            }
            bytes.reserve_exact(told as usize + 1);
            file.take(most + 1).read_to_end(&mut bytes)
        })
    };
    let doing = if is_stdin(path) {
        "read standard input"
    } else {
        "read the file"
    };
    let length = read.map_err(|error| Failure::io(path, doing, &error))?;
    Ok((length as u64 <= most).then_some(bytes))
}

/// Reads and parses a program with its settings.
pub(crate) fn load(global: &Global, path: &Path) -> Result<Loaded, Failure> {
    let source = read_program(global, path)?;
    let stdin = is_stdin(path);
    let resolved = resolve((!stdin).then_some(path), &source, &overrides(global))?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let program = trunnion_syntax::parse_on(source, resolved.dialect.lex, threads);
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
