//! From a path to a parsed program with everything it is checked with.
use super::{
    args::{Global, Switch},
    failure::Failure,
};
use std::{
    collections::BTreeSet,
    io::{Read, Write},
    path::Path,
};
use trunnion_check::assumptions;
use trunnion_dialect::Foreign;
use trunnion_files::{Outputs, Seen, Target};
use trunnion_interp::{Fault, FaultKind, Limits, Setup};
use trunnion_machine::Machine;
use trunnion_same::{Input, assumed, with_zeros};
use trunnion_syntax::{LineIndex, Program};
use trunnion_workspace::{Overrides, Resolved, resolve};

/// A program with everything it is checked with.
pub(crate) struct Loaded {
    /// For people: the path as given, or `<stdin>`.
    pub(crate) name: String,
    /// Parsed.
    pub(crate) program: Program,
    /// Settings, machine, dialect.
    pub(crate) resolved: Resolved,
    /// The state of the file when it was read; `None` for standard input.
    pub(crate) seen: Option<Seen>,
}

impl Loaded {
    /// The machine, or a failure that says how to name one.
    pub(crate) fn machine_or_fail(&self, what: &str) -> Result<&Machine, Failure> {
        self.resolved.machine.as_ref().ok_or_else(|| {
            Failure::new(format!(
                "{what} needs a machine: add --machine NAME (`trunnion machine list` lists the built-in ones) or \
                 `machine = \"NAME\"` in trunnion.toml"
            ))
        })
    }
    /// Why the file is not read, if it is not.
    pub(crate) fn not_read(&self) -> Option<String> {
        self.resolved.foreign.map(|foreign| match foreign {
            Foreign::Control(control) => format!("the program is for {}, which is not supported", control.title),
            Foreign::NotAProgram(what) => format!("this is {what}"),
        })
    }
    /// The name of the dialect, or of the control that is not supported; none for a file that is not a program.
    pub(crate) fn dialect_name(&self) -> Option<&str> {
        self.resolved.dialect_name()
    }
    /// Undeclared work offsets and tool lengths that the program uses, as `check` lists them: the joints of the machine are computed
    /// with zero. Empty without a machine.
    pub(crate) fn assumptions(&self) -> Vec<String> {
        if self.resolved.machine.is_none() {
            return Vec::new();
        }
        // no further than the command itself follows the program
        let mut setup = self.resolved.setup.clone();
        setup.limits = setup.limits.of_steps();
        assumptions(&self.program, self.resolved.dialect, &setup)
    }
    /// The files of a command that reads this program: none of its outputs may replace one of them.
    pub(crate) fn outputs(&self) -> Outputs {
        let mut outputs = Outputs::new();
        if self.seen.is_some() {
            outputs.input(Path::new(&self.name));
        }
        for file in &self.resolved.files {
            outputs.input(file);
        }
        outputs
    }
    /// As the floors take it.
    pub(crate) fn input(&self) -> Input<'_> {
        Input {
            program: &self.program,
            dialect: self.resolved.dialect,
            setup: &self.resolved.setup,
            machine: self.resolved.machine.as_ref(),
        }
    }
    /// One line on what was chosen and why, for `-v`.
    pub(crate) fn explanation(&self) -> String {
        let r = &self.resolved;
        let machine = r.machine.as_ref().map_or("none", |m| m.id.as_str());
        let config = r
            .config_path
            .as_ref()
            .map_or_else(|| "none".to_owned(), |p| p.display().to_string());
        format!(
            "{}: dialect {} ({}); machine {machine} ({}); settings {config}",
            self.name,
            self.dialect_name().unwrap_or("none"),
            r.dialect_reason,
            r.machine_reason
        )
    }
}

/// What one or two programs assume, as a line of text begins or continues: `assuming G54 = 0 (not declared)`; `None` where everything is
/// declared.
pub(crate) fn assuming(programs: &[&Loaded]) -> Option<String> {
    let all = assumed_by(programs);
    (!all.is_empty()).then(|| format!("assuming {}", all.join(", ")))
}

/// What one or two programs assume, each once.
pub(crate) fn assumed_by(programs: &[&Loaded]) -> Vec<String> {
    let mut known = BTreeSet::new();
    let all = programs.iter().flat_map(|loaded| loaded.assumptions());
    all.filter(|text| known.insert(text.clone())).collect()
}

/// The setup of programs that are compared, with the zero points and tool lengths at 0 that --assume names and nobody declares.
pub(crate) fn with_assumed(setup: &Setup, programs: &[&Loaded]) -> Setup {
    let mut unset = Vec::new();
    for loaded in programs {
        let assume = loaded.resolved.assume;
        unset.extend(assumed(loaded.input(), [assume.work_offset, assume.tool_length]));
    }
    with_zeros(setup, &unset)
}

/// The global options.
pub(crate) fn overrides(global: &Global) -> Overrides {
    Overrides {
        machine: global.machine.clone(),
        dialect: global.dialect.clone(),
        config: global.config.clone(),
        tool: global.tool.clone(),
        allow: global.allow.clone(),
        port_to: global.port_to.clone(),
        assume: global.assume.clone(),
        block_delete: global.block_delete.map(|switch| switch == Switch::On),
        ..Overrides::default()
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
    let (bytes, _) = bytes(path, MOST_MEGABYTES)?.ok_or_else(|| {
        Failure::file(
            path,
            format!("is larger than {MOST_MEGABYTES} MB, the largest size that can be read; split it"),
        )
    })?;
    Ok(bytes)
}

/// The bytes of a program and the state of its file; no state for standard input.
type Source = (Vec<u8>, Option<Seen>);

/// Bytes of a program whose blocks are all held at once: up to nine bytes of memory for each byte of it, so its size is bounded.
pub(crate) fn read_program(global: &Global, path: &Path) -> Result<Source, Failure> {
    let bounds = global.text_bounds();
    let most = bounds.megabytes;
    let source = bytes(path, most.min(MOST_MEGABYTES))?.ok_or_else(|| {
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
    })?;
    // a carriage return alone ends a line, too
    let ends_line = |at: &usize| source.0[*at] == b'\n' || source.0.get(at + 1) != Some(&b'\n');
    let ends = memchr::memchr2_iter(b'\n', b'\r', &source.0).filter(ends_line);
    let lines = ends.count() as u64;
    if lines > bounds.lines {
        let most = bounds.lines;
        let text = format!("has {lines} lines, more than {most}, and was not read; `--max-lines N` raises the limit");
        return Err(Failure::file(path, text));
    }
    Ok(source)
}

/// Bytes of a regular file or of standard input; `None` where there are more than `megabytes`.
fn bytes(path: &Path, megabytes: u64) -> Result<Option<Source>, Failure> {
    let most = megabytes.saturating_mul(MEGABYTE);
    if is_stdin(path) {
        let mut bytes = Vec::new();
        // no more than that, so that a pipe without an end is refused too
        std::io::stdin()
            .lock()
            .take(most + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| Failure::io(path, "read standard input", &error))?;
        return Ok((bytes.len() as u64 <= most).then_some((bytes, None)));
    }
    Ok(trunnion_files::read(path, most)?.map(|input| (input.bytes, Some(input.seen))))
}

/// Reads and parses a program with its settings; a file for an unsupported control, or one that is not a program, is a failure.
pub(crate) fn load(global: &Global, path: &Path) -> Result<Loaded, Failure> {
    let loaded = load_any(global, path)?;
    if let Some(why) = loaded.not_read() {
        return Err(Failure::file(path, format!("{why}, so it is not read")));
    }
    Ok(loaded)
}

/// Reads and parses a file with its settings, whatever it is.
pub(crate) fn load_any(global: &Global, path: &Path) -> Result<Loaded, Failure> {
    Ok(open(global, path)?.parse())
}

/// A program that is read but not parsed, with its settings.
pub(crate) struct Opened {
    name: String,
    /// The bytes of the program.
    pub(crate) source: Vec<u8>,
    /// Settings, machine, dialect.
    pub(crate) resolved: Resolved,
    seen: Option<Seen>,
}

impl Opened {
    /// Parses it.
    pub(crate) fn parse(self) -> Loaded {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        Loaded {
            program: trunnion_syntax::parse_on(self.source, self.resolved.dialect.lex, threads),
            name: self.name,
            resolved: self.resolved,
            seen: self.seen,
        }
    }
}

/// Reads a file and its settings, whatever it is.
pub(crate) fn open(global: &Global, path: &Path) -> Result<Opened, Failure> {
    let (source, seen) = read_program(global, path)?;
    let stdin = is_stdin(path);
    let mut resolved = resolve((!stdin).then_some(path), &source, &overrides(global))?;
    resolved.bound(limits(global, resolved.setup.limits));
    resolved.setup.progress = global.progress.clone();
    let name = if stdin {
        "<stdin>".to_owned()
    } else {
        path.display().to_string()
    };
    Ok(Opened {
        name,
        source,
        resolved,
        seen,
    })
}

/// [`load`] for a command that lists or draws every step.
pub(crate) fn load_for_steps(global: &Global, path: &Path) -> Result<Loaded, Failure> {
    let mut loaded = load(global, path)?;
    loaded.resolved.bound_steps();
    Ok(loaded)
}

/// The bounds of a run, with those of the command line.
pub(crate) fn limits(global: &Global, mut limits: Limits) -> Limits {
    if let Some(steps) = global.max_steps {
        limits.steps = steps;
        limits.blocks = limits.blocks.max(steps);
    }
    limits
}

/// Why a run ended early, and what to do.
pub(crate) fn not_followed(loaded: &Loaded, fault: &Fault) -> Option<String> {
    let FaultKind::EndlessLoop { blocks, proved } = fault.kind else {
        return None;
    };
    let lines = LineIndex::new(loaded.program.source());
    let (line, _) = lines.line_column(loaded.program.source(), fault.range.start);
    Some(if proved {
        format!(
            "{}:{line}: this loop never ends; what comes after it is left out",
            loaded.name
        )
    } else {
        format!(
            "{}:{line}: stopped: no end within {blocks} executed blocks; if the program is only long, use --max-steps N or raise `steps` \
             of [limits] in trunnion.toml",
            loaded.name
        )
    })
}

/// Replaces the file of a program, unless it changed since it was read.
pub(crate) fn replace(path: &Path, seen: Option<&Seen>, before: &[u8], after: &[u8]) -> Result<(), Failure> {
    let Some(seen) = seen else {
        return Err(Failure::new("standard input cannot be replaced; use -o FILE"));
    };
    Ok(Target::in_place(path, seen, before)?.write(after, Some(before))?)
}

/// Writes `bytes` to the file of `-o`, or to standard output without one.
pub(crate) fn put(target: Option<&Target>, bytes: &[u8]) -> Result<(), Failure> {
    if let Some(target) = target {
        return Ok(target.write(bytes, None)?);
    }
    let mut out = std::io::stdout().lock();
    let written = out.write_all(bytes).and_then(|()| out.flush());
    Ok(trunnion_files::unless_closed(written)?)
}
