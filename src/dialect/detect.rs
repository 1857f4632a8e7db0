//! Which control a program is written for, and why: signs in its text decide, then its name, then the machine.
mod brother;
mod declared;
mod fadal;
mod foreign;
mod kernels;
mod num;
mod others;
mod seen;
mod shape;
mod supported;
mod text;
mod votes;

use crate::unsupported::{Unsupported, unsupported};
use crate::{BUILTIN_NAMES, Dialect, builtin, modeline};
pub use declared::declared;
pub(crate) use foreign::binary;
use seen::Seen;
pub use shape::possible_lathe;
use text::{is_block, lines};

/// A detected dialect with the reason for people.
#[derive(Clone, Debug)]
pub struct Detected {
    /// The dialect; the core for a text that is not read.
    pub dialect: &'static Dialect,
    /// Why: "file extension .mpf", "the machine's control family" ...
    pub reason: String,
    /// The reason leaves little doubt.
    pub certain: bool,
    /// The text is not for a control that is supported.
    pub foreign: Option<Foreign>,
}

/// Why a text is not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// It is for a control that is recognised and not supported.
    Control(&'static Unsupported),
    /// It is not a program: what it is.
    NotAProgram(&'static str),
}

/// What is known about the machine on which a program is to run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surroundings<'a> {
    /// The control family of the machine file.
    pub family: Option<&'a str>,
    /// Whether the part can turn on a spindle: a lathe, a mill-turn machine. `None`: no machine is named.
    pub turns: Option<bool>,
    /// The machine has X and Z and no Y, as lathes with two axes.
    pub no_y: bool,
}

/// How much of a program is searched for signs of its dialect, bytes.
const CONTENT_BYTES: usize = 64 * 1024;

/// As [`detect_on`], where only the control family of the machine is known.
pub fn detect(file_name: Option<&str>, source: &[u8], family: Option<&str>) -> Detected {
    let known = Surroundings {
        family,
        ..Surroundings::default()
    };
    detect_on(file_name, source, known)
}

/// Modeline comment `(trunnion: dialect NAME)` in the first 10 lines, then signs in the first 64 KiB of the text, then a file extension
/// that one control owns, then the machine's control family, then the core: extensions such as `.nc` are shared by many controls, and a
/// program with the signs of a control other than the machine's is still a program for that control. A dialect of lathes is never chosen
/// for a machine that does not turn the part.
pub fn detect_on(file_name: Option<&str>, source: &[u8], known: Surroundings<'_>) -> Detected {
    if let Some(what) = not_text(source) {
        return what;
    }
    if let Some(name) = modeline(source).dialect.as_deref()
        && let Some(detected) = named(name, "modeline comment in the program".to_owned(), true)
    {
        return detected;
    }
    let extension = file_name.and_then(extension);
    let head = &source[..source.len().min(CONTENT_BYTES)];
    let text = String::from_utf8_lossy(head).to_ascii_uppercase();
    let seen = Seen::of(&text);
    let owner = extension.as_deref().and_then(owner);
    if owner.is_none()
        && let Some(what) = foreign::prose(&text, seen.most())
    {
        return Detected {
            dialect: core_dialect(),
            reason: format!("content: {what}"),
            certain: true,
            foreign: Some(Foreign::NotAProgram(what)),
        };
    }
    let found = seen
        .decide(owner, known)
        .unwrap_or_else(|| by_name_or_machine(extension.as_deref(), head, known));
    // a file name or a machine does not say whether an Okuma mills or turns
    let turns = found.foreign.is_none() && found.dialect.name == OKUMA && seen.okuma_name(known) != OKUMA;
    let lathe = turns.then(|| named(seen.okuma_name(known), found.reason.clone(), found.certain));
    lathe.flatten().unwrap_or(found)
}

/// The dialect whose programs look like those of lathes.
const OKUMA: &str = "okuma-osp";

/// A file that is not text has no dialect, whatever is declared.
pub fn not_text(source: &[u8]) -> Option<Detected> {
    let what = binary(source)?;
    Some(Detected {
        dialect: core_dialect(),
        reason: format!("content: {what}"),
        certain: true,
        foreign: Some(Foreign::NotAProgram(what)),
    })
}

/// The dialect, or the unsupported control, with this name.
pub fn named(name: &str, reason: String, certain: bool) -> Option<Detected> {
    if let Some(dialect) = builtin(name) {
        return Some(Detected {
            dialect,
            reason,
            certain,
            foreign: None,
        });
    }
    Some(Detected {
        dialect: core_dialect(),
        reason,
        certain,
        foreign: Some(Foreign::Control(unsupported(name)?)),
    })
}

/// Where the text shows nothing.
fn by_name_or_machine(extension: Option<&str>, head: &[u8], known: Surroundings<'_>) -> Detected {
    if let Some(extension) = extension
        && let Some(detected) =
            owner(extension).and_then(|name| named(name, format!("file extension .{extension}"), true))
    {
        return detected;
    }
    let core = |reason: String| Detected {
        dialect: core_dialect(),
        reason,
        certain: false,
        foreign: None,
    };
    let found = known.family.and_then(|family| {
        let reason = format!("the machine's control family {family}");
        Some((family, named(family, reason, true)?))
    });
    let Some((family, detected)) = found else {
        return core("nothing in the file points to a particular control".to_owned());
    };
    if detected.foreign.is_none()
        && let Some(line) = foreign_comment(head, detected.dialect)
    {
        return core(format!(
            "content: a comment on line {line} of a kind that {family} does not have"
        ));
    }
    detected
}

/// The first line that is a comment in brackets of a kind that `dialect` does not have.
fn foreign_comment(source: &[u8], dialect: &Dialect) -> Option<usize> {
    let foreign = |line: &[u8]| {
        let line = line.trim_ascii();
        (!dialect.lex.slash_star_comment && line.starts_with(b"/*"))
            || (!dialect.lex.paren_comment && line.starts_with(b"(") && line.ends_with(b")"))
    };
    source
        .split(|&b| b == b'\n' || b == b'\r')
        .position(foreign)
        .map(|line| line + 1)
}

fn core_dialect() -> &'static Dialect {
    builtin("iso-6983").expect("the core is built in")
}

/// File name extensions (lower case, no dot) that name programs, of all built-in dialects.
pub fn program_extensions() -> Vec<&'static str> {
    let dialects = BUILTIN_NAMES.iter().filter_map(|name| builtin(name));
    dialects
        .flat_map(|dialect| dialect.extensions.iter().map(String::as_str))
        .collect()
}

/// Whether a file's name says that it contains a program; versions after the name count (`part.ncl.8`).
pub fn is_program_file_name(name: &str) -> bool {
    extension(name).is_some_and(|extension| program_extensions().contains(&extension.as_str()))
}

/// Lines of a file without an extension that are read to recognise it.
const FIRST_LINES: usize = 40;

/// Whether the first bytes of a file without an extension are those of a program: it has a sign of a control, or most of its first
/// lines that are neither empty nor comments consist of words (a letter and a number) or name a program.
pub fn looks_like_program(head: &[u8]) -> bool {
    if head.contains(&0) || binary(head).is_some() {
        return false;
    }
    let text = String::from_utf8_lossy(head).to_ascii_uppercase();
    let (mut blocks, mut others) = (0usize, 0usize);
    for line in lines(&text).map(str::trim).take(FIRST_LINES) {
        let comment = line.starts_with(['(', ';', '#', '"']) || line.starts_with("$$") || line.starts_with("/*");
        if line.is_empty() || line == "%" || comment {
            continue;
        }
        if is_block(line) {
            blocks += 1;
        } else {
            others += 1;
        }
    }
    blocks > others || (blocks + others > 0 && others <= 1 && Seen::of(&text).most() >= 4)
}

/// Last extension, lower case; a version number after it (`part.ncl.8`) is left out.
fn extension(name: &str) -> Option<String> {
    let name = name.rsplit(['/', '\\']).next()?;
    let (stem, last) = name.rsplit_once('.')?;
    if !last.is_empty() && last.bytes().all(|b| b.is_ascii_digit()) {
        return stem.rsplit_once('.').map(|(_, real)| real.to_ascii_lowercase());
    }
    Some(last.to_ascii_lowercase())
}

/// The control that alone owns an extension. Extensions of the core (`.nc`) are shared by many controls and name none.
fn owner(extension: &str) -> Option<&'static str> {
    let owners = BUILTIN_NAMES
        .iter()
        .filter_map(|name| builtin(name))
        .filter(|dialect| dialect.name != core_dialect().name);
    owners
        .into_iter()
        .find(|dialect| dialect.extensions.iter().any(|known| known == extension))
        .map(|dialect| dialect.name.as_str())
}
