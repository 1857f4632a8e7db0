//! `canon`: the canonical calls of a LinuxCNC program, listed as `rs274 -g` lists them.
use super::{
    Done,
    args::{Canon as Command, Global, Switch},
    failure::{Failure, remark},
    load, waiting,
};
use std::{
    io::{BufWriter, Write},
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};
use trunnion_files::{Outputs, Target};
use trunnion_ngc::{
    At, Canon, Engine, Error, FileId, Files, Ini, Listing, Loaded, Parameters, Searched, Setup, Sink, Source, State,
    Step, ToolTable,
};
use trunnion_syntax::TextRange;

/// In place of the sequence number of a line without one.
const NO_NUMBER: &[u8] = b".....";
/// A larger file is not loaded as a called program, bytes.
const LARGEST: u64 = 64 << 20;
/// Endings tried for the name of a called program.
const ENDINGS: [&str; 2] = ["ngc", "nc"];

/// Runs `canon`. An error of the program makes the exit status 1.
pub(super) fn run(global: &Global, command: &Command) -> Result<Done, Failure> {
    let bytes: Arc<[u8]> = load::read_program(global, &command.file)?.0.into();
    let main = Arc::new(Source::new(command.file.display().to_string(), bytes));
    let sources: Sources = Arc::new(Mutex::new(vec![Arc::clone(&main)]));
    let mut outputs = Outputs::new();
    for file in [Some(&command.file), command.ini.as_ref(), command.tool_table.as_ref()]
        .into_iter()
        .flatten()
    {
        outputs.input(file);
    }
    let kept = command
        .parameters
        .as_ref()
        .map(|path| Kept::read(path, &mut outputs))
        .transpose()?;
    let target = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    let mut setup = setup(command, global, &sources, kept.as_ref())?;
    let lines = memchr::memchr_iter(b'\n', main.bytes()).count() as u64;
    setup.limits = load::limits(global, setup.limits).of_steps();
    // the lines of the text itself are always read
    setup.limits.blocks = setup.limits.blocks.saturating_add(lines);
    remark(false, "executing");
    let list = |out: &mut dyn Write| listed(command, &setup, main, sources, out);
    let ran = match target {
        None => waiting::beside_output(global, "executing", &command.file, || {
            list(&mut BufWriter::new(std::io::stdout().lock()))
        }),
        Some(target) => waiting::during(global, "executing", &command.file, || target.fill(list)),
    }?;
    if let Some(kept) = kept {
        kept.save(&ran.parameters)?;
    }
    Ok(if ran.refused { Done::Found } else { Done::Clean })
}

/// What is left of a run that is listed.
struct Ran {
    /// The program has an error.
    refused: bool,
    /// The parameter file after it.
    parameters: Vec<u8>,
}

/// Lists what a run does.
fn listed(
    command: &Command,
    setup: &Setup,
    main: Arc<Source>,
    sources: Sources,
    out: &mut dyn Write,
) -> Result<Ran, Failure> {
    let mut engine = Engine::new(main, setup);
    let mut out = Printer {
        out,
        listing: Listing {
            more: usize::from(command.more_decimals),
            ..Listing::default()
        },
        sources,
        number: Vec::new(),
        place: None,
        running: false,
        refused: false,
        failed: None,
    };
    let last = engine.run(true, &mut out);
    if let Step::Undecided(why) = &last {
        return Err(Failure::file(&command.file, format!("cannot be decided: {why}")));
    }
    if let Step::OutOfFuel(at) = last {
        let text = format!(
            "does not end: the loop or call at line {} was stopped after {} executed lines; if it is only long, use --max-steps N",
            at.line + 1,
            setup.limits.blocks
        );
        return Err(Failure::file(&command.file, text));
    }
    if let Step::Endless(at, _) = last {
        let text = format!(
            "does not end: the loop at line {} sends nothing to the machine and returns to the same values",
            at.line + 1
        );
        return Err(Failure::file(&command.file, text));
    }
    // without an INI file rs274 resets its machine twice
    let resets = if command.ini.is_some() { 1 } else { 2 };
    for _ in 0..resets {
        out.running = false;
        out.print(&Canon::Reset, engine.at());
    }
    if let Some(error) = out.failed.take() {
        return Err(error.into());
    }
    out.out.flush()?;
    let parameters = engine.kept_parameters().text_with(usize::from(command.more_decimals));
    Ok(Ran {
        refused: out.refused,
        parameters: parameters.into_bytes(),
    })
}

/// The parameter file: read at the start, written back at the end as the control does. The old one is kept next to it as `.bak`.
struct Kept {
    path: PathBuf,
    bytes: Vec<u8>,
    target: Target,
    backup: Option<Target>,
}

impl Kept {
    fn read(path: &Path, outputs: &mut Outputs) -> Result<Self, Failure> {
        let target = outputs.output("--parameters", path)?;
        let exists = path.exists();
        Ok(Self {
            path: path.to_owned(),
            bytes: if exists { load::read(path)? } else { Vec::new() },
            backup: exists.then(|| outputs.backup("--parameters", path)).transpose()?,
            target,
        })
    }
    fn save(&self, text: &[u8]) -> Result<(), Failure> {
        if let Some(backup) = &self.backup {
            backup.write(&self.bytes, None)?;
        }
        let before = self.backup.as_ref().map(|_| self.bytes.as_slice());
        Ok(self.target.write(text, before)?)
    }
}

/// The programs of a run, the main one first, in the order in which they were loaded.
type Sources = Arc<Mutex<Vec<Arc<Source>>>>;

fn setup(command: &Command, global: &Global, sources: &Sources, kept: Option<&Kept>) -> Result<Setup, Failure> {
    let ini = match &command.ini {
        Some(path) => Ini::parse(&load::read(path)?),
        None => Ini::default(),
    };
    let tools = match &command.tool_table {
        Some(path) => {
            let (table, bad) = ToolTable::parse(&load::read(path)?);
            for line in bad {
                remark(false, &format!("{}:{}: {}", path.display(), line.line, line.message));
            }
            table
        }
        None => ToolTable::sample(),
    };
    let parameters = match kept {
        Some(kept) => Parameters::parse(&kept.bytes)
            .map_err(|bad| Failure::file(&kept.path, format!("line {}: {}", bad.line, bad.message)))?,
        None => Parameters::default(),
    };
    let files = Folders {
        folders: folders(command, &ini),
        sources: Arc::clone(sources),
    };
    Ok(Setup {
        ini,
        tools,
        parameters,
        files: Some(Arc::new(files)),
        block_delete: global.block_delete == Some(Switch::On),
        more_decimals: usize::from(command.more_decimals),
        ..Setup::default()
    })
}

/// Where called programs are looked for: `[DISPLAY]PROGRAM_PREFIX` and `[RS274NGC]SUBROUTINE_PATH` (relative to the INI file), and the
/// folder of the program.
fn folders(command: &Command, ini: &Ini) -> Vec<PathBuf> {
    let beside = |path: &Path| path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    let base = command.ini.as_deref().map_or_else(PathBuf::new, beside);
    let mut folders = Vec::new();
    for (section, key) in [("DISPLAY", "PROGRAM_PREFIX"), ("RS274NGC", "SUBROUTINE_PATH")] {
        if let Some(list) = ini.values.get(&(section.to_owned(), key.to_owned())) {
            folders.extend(
                list.split(':')
                    .filter(|folder| !folder.is_empty())
                    .map(|folder| base.join(folder)),
            );
        }
    }
    folders.push(beside(&command.file));
    folders
}

/// A file that the control would use, but that is not read.
fn refused(folder: &Path, why: String) -> Searched {
    remark(false, &why);
    Searched::refused(folder.display().to_string(), why)
}

/// Finds called programs in folders.
struct Folders {
    folders: Vec<PathBuf>,
    sources: Sources,
}

impl Files for Folders {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        for folder in &self.folders {
            let endings = ENDINGS.map(|ending| folder.join(format!("{name}.{ending}")));
            for path in endings {
                if !path.is_file() {
                    continue;
                }
                let input = match trunnion_files::read(&path, LARGEST) {
                    Ok(Some(input)) => input,
                    Ok(None) => {
                        return Err(vec![refused(
                            folder,
                            format!("{} is larger than 64 MB", path.display()),
                        )]);
                    }
                    Err(error) => return Err(vec![refused(folder, error.to_string())]),
                };
                let bytes: Arc<[u8]> = input.bytes.into();
                let mut sources = self.sources.lock().unwrap_or_else(PoisonError::into_inner);
                let path = path.display().to_string();
                sources.push(Arc::new(Source::new(path.clone(), Arc::clone(&bytes))));
                return Ok(Loaded { path, bytes });
            }
        }
        let folders = self.folders.iter();
        Err(folders.map(|folder| folder.display().to_string().into()).collect())
    }
}

/// Prints what a run does.
struct Printer<W: Write> {
    out: W,
    listing: Listing,
    sources: Sources,
    /// Digits of the sequence number of the current line, and which line that is.
    number: Vec<u8>,
    place: Option<At>,
    /// The calls before the first line have been printed.
    running: bool,
    /// The program has an error.
    refused: bool,
    /// The first error of writing.
    failed: Option<std::io::Error>,
}

impl<W: Write> Printer<W> {
    fn print(&mut self, call: &Canon, at: At) {
        if !self.running {
            self.running = *call == Canon::Reset;
            self.number = NO_NUMBER.to_vec();
        } else if self.place != Some(at) {
            self.place = Some(at);
            self.number = sequence_number(&self.line(at));
        }
        let written = self.listing.write(call, &self.number, &mut self.out);
        if let Err(error) = written {
            self.failed.get_or_insert(error);
        }
    }
    /// Bytes of a line without its end.
    fn line(&self, at: At) -> Vec<u8> {
        let range = {
            let sources = self.sources.lock().unwrap_or_else(PoisonError::into_inner);
            sources.get(at.file.0 as usize).and_then(|source| source.line(at.line))
        };
        range.map_or_else(Vec::new, |range| self.text(at.file, range))
    }
    /// Bytes of a file without the final line end.
    fn text(&self, file: FileId, range: TextRange) -> Vec<u8> {
        let sources = self.sources.lock().unwrap_or_else(PoisonError::into_inner);
        let line = sources
            .get(file.0 as usize)
            .and_then(|source| source.bytes().get(range.as_usize()));
        let line = line.unwrap_or_default();
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        line.strip_suffix(b"\r").unwrap_or(line).to_vec()
    }
}

/// The digits of N as they are written, dots where the line has none.
fn sequence_number(line: &[u8]) -> Vec<u8> {
    let mut signs = line
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .skip_while(|byte| **byte == b'/')
        .copied();
    let digits: Vec<u8> = match signs.next() {
        Some(b'N' | b'n') => signs.take_while(u8::is_ascii_digit).collect(),
        _ => Vec::new(),
    };
    if digits.is_empty() { NO_NUMBER.to_vec() } else { digits }
}

impl<W: Write> Sink for Printer<W> {
    fn call(&mut self, call: &Canon, at: At, state: &State) {
        self.print(call, state.emitting_line.unwrap_or(at));
    }
    fn error(&mut self, error: &Error, at: At) {
        if std::mem::replace(&mut self.refused, true) {
            // further errors of the same line: the control stops at the first
            return;
        }
        // in order when both streams go to one place
        if let Err(error) = self.out.flush() {
            self.failed.get_or_insert(error);
        }
        remark(false, error.message());
        let line = match error.read_last {
            Some((file, range)) => self.text(file, range),
            None => self.line(at),
        };
        remark(false, String::from_utf8_lossy(&line).trim_end());
    }
}
