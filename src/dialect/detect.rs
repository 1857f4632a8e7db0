//! Which dialect a program is written in, and why.
use crate::{BUILTIN_NAMES, Dialect, builtin, modeline};

/// A detected dialect with the reason for people.
#[derive(Clone, Debug)]
pub struct Detected {
    /// The dialect.
    pub dialect: &'static Dialect,
    /// Why: "file extension .mpf", "the machine's control family" ...
    pub reason: String,
}

/// How much of a program is looked at for signs of its dialect, bytes.
const CONTENT_BYTES: usize = 64 * 1024;

/// Modeline comment `(trunnion: dialect NAME)` in the first 10 lines, then a file extension that one dialect owns, then
/// signs in the content (first 64 KiB), then the machine's control family, then the core: extensions such as `.nc` are shared by many
/// controls, and a program that bears the signs of another control than the machine's is still that control's program.
pub fn detect(file_name: Option<&str>, source: &[u8], family: Option<&str>) -> Detected {
    if let Some(dialect) = modeline(source).dialect.as_deref().and_then(builtin) {
        return Detected {
            dialect,
            reason: "modeline comment in the program".to_owned(),
        };
    }
    let extension = file_name.and_then(extension);
    if let Some(extension) = &extension
        && let Some(dialect) = by_extension(extension)
    {
        return Detected {
            dialect,
            reason: format!("file extension .{extension}"),
        };
    }
    let head = &source[..source.len().min(CONTENT_BYTES)];
    if let Some((name, reason)) = content(head) {
        return Detected {
            dialect: builtin(name).unwrap_or_else(core_dialect),
            reason,
        };
    }
    let Some((family, dialect)) = family.and_then(|family| Some((family, builtin(family)?))) else {
        return Detected {
            dialect: core_dialect(),
            reason: "nothing in the file points to a particular control".to_owned(),
        };
    };
    if let Some(line) = foreign_comment(head, dialect) {
        let reason = format!("content: a comment in line {line} of a kind that {family} does not have");
        return Detected {
            dialect: core_dialect(),
            reason,
        };
    }
    Detected {
        dialect,
        reason: format!("the machine's control family {family}"),
    }
}

/// The first line that is a comment in brackets of a kind that `dialect` does not have.
fn foreign_comment(source: &[u8], dialect: &Dialect) -> Option<usize> {
    let foreign = |line: &[u8]| {
        let line = line.trim_ascii();
        (!dialect.lex.slash_star_comment && line.starts_with(b"/*"))
            || (!dialect.lex.paren_comment && line.starts_with(b"(") && line.ends_with(b")"))
    };
    source.split(|&b| b == b'\n').position(foreign).map(|line| line + 1)
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

/// Lines of a file without an extension that are looked at.
const FIRST_LINES: usize = 40;

/// Whether the first bytes of a file without an extension are those of a program: it bears the sign of a control, or most of its first
/// lines that are neither empty nor comments consist of words (a letter and a number) or name a program.
pub fn looks_like_program(head: &[u8]) -> bool {
    if head.contains(&0) {
        return false;
    }
    let text = String::from_utf8_lossy(head).to_ascii_uppercase();
    let (mut blocks, mut others) = (0usize, 0usize);
    for line in text.lines().map(str::trim).take(FIRST_LINES) {
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
    blocks > others || (blocks + others > 0 && others <= 1 && content(head).is_some())
}

/// Whether a line consists of words alone: letters followed by numbers, comments left out.
fn is_block(line: &str) -> bool {
    let code = line.split(['(', ';']).next().unwrap_or_default();
    let code = code.trim_start_matches('/').trim();
    let mut letters = 0usize;
    let mut after_letter = false;
    for c in code.chars() {
        match c {
            'A'..='Z' if !after_letter => (letters, after_letter) = (letters + 1, true),
            '0'..='9' | '.' => after_letter = false,
            '+' | '-' | ' ' | '=' | '\t' => {}
            _ => return false,
        }
    }
    letters > 0 && !after_letter
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

/// The dialect that alone owns an extension. Extensions of the core (`.nc`) are shared by many controls and name none.
fn by_extension(extension: &str) -> Option<&'static Dialect> {
    let owners = BUILTIN_NAMES
        .iter()
        .filter_map(|name| builtin(name))
        .filter(|dialect| dialect.name != core_dialect().name);
    owners
        .into_iter()
        .find(|dialect| dialect.extensions.iter().any(|known| known == extension))
}

/// The dialect by what the text looks like, with the sign that decided; `None` without any sign.
fn content(source: &[u8]) -> Option<(&'static str, String)> {
    let text = String::from_utf8_lossy(source).to_ascii_uppercase();
    let mut votes: Vec<(&'static str, u32, String, usize)> = Vec::new();
    for (i, line) in text.lines().enumerate() {
        for (name, weight, sign) in line_signs(line.trim()) {
            match votes.iter_mut().find(|vote| vote.0 == name) {
                Some(vote) => vote.1 = vote.1.saturating_add(weight),
                None => votes.push((name, weight, sign, i + 1)),
            }
        }
    }
    // The first of the strongest: a tie goes to the sign that came first.
    let mut best: Option<(&'static str, u32, String, usize)> = None;
    for vote in votes {
        if best.as_ref().is_none_or(|known| vote.1 > known.1) {
            best = Some(vote);
        }
    }
    best.map(|(name, _, sign, line)| (name, format!("content: {sign} in line {line}")))
}

/// Signs of a control in one upper-case line: dialect, weight, what was seen.
fn line_signs(line: &str) -> Vec<(&'static str, u32, String)> {
    let mut signs = Vec::new();
    let mut sign = |name: &'static str, weight: u32, seen: &str| signs.push((name, weight, seen.to_owned()));
    if line.starts_with("$$") {
        sign("apt", 8, "a `$$` comment");
    }
    for word in [
        "PARTNO", "GOTO", "FEDRAT", "LOADTL", "SPINDL", "MULTAX", "CUTTER", "FINI",
    ] {
        if let Some(rest) = line.strip_prefix(word)
            && (rest.trim_start().starts_with('/')
                || (rest.is_empty() && word == "FINI")
                || (word == "PARTNO" && rest.starts_with(' ')))
        {
            sign("apt", 8, word);
        }
    }
    if line.starts_with("%_N_") {
        sign("sinumerik-840d", 20, "%_N_");
    }
    if let Some(command) = crate::signs::grbl_command(line) {
        sign("grbl", 10, command);
    }
    if line.starts_with('%') || line.starts_with("$$") {
        return signs;
    }
    let code = strip_comments(line);
    let code = code.trim();
    iso_signs(code, &mut sign);
    signs
}

fn iso_signs(code: &str, sign: &mut dyn FnMut(&'static str, u32, &str)) {
    for name in [
        "TRAORI", "TRAFOOF", "CYCLE800", "CYCLE832", "MCALL", "SUPA", "G710", "G700", "GOTOF", "GOTOB", "DIAMON",
        "DEF REAL", "DEF INT", "MSG(",
    ] {
        if has_word(code, name) {
            sign("sinumerik-840d", 10, name);
        }
    }
    if assigned(code) && !code.contains('#') {
        sign("sinumerik-840d", 4, "a word with `=`");
    }
    let o_word = code.strip_prefix('O').map(str::trim_start);
    if let Some(rest) = o_word {
        let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        let label = after.len() < rest.len() || rest.starts_with('<') || rest.starts_with('#');
        let words = [
            "SUB",
            "ENDSUB",
            "CALL",
            "IF",
            "WHILE",
            "DO",
            "REPEAT",
            "RETURN",
            "ELSE",
            "ENDIF",
            "ENDWHILE",
            "ENDREPEAT",
            "BREAK",
            "CONTINUE",
        ];
        let last = after
            .trim_start_matches(|c: char| c != '>' && after.contains('>'))
            .trim_start_matches('>')
            .trim_start();
        if label && words.iter().any(|word| last.starts_with(word)) {
            sign("linuxcnc", 10, "an O-word");
        } else if rest.len() >= 4 && rest.as_bytes()[..4].iter().all(u8::is_ascii_digit) {
            sign("fanuc-30i", 6, "a program number O");
        }
    }
    for (name, text) in [
        ("linuxcnc", "#<"),
        ("linuxcnc", "M428"),
        ("linuxcnc", "M429"),
        ("linuxcnc", "EXISTS["),
    ] {
        if code.contains(text) {
            sign(name, 10, text);
        }
    }
    for text in ["G43.4", "G43.5", "G68.2", "G54.1", "G5.1Q", "G5.1 Q", "G05.1"] {
        if code.contains(text) {
            sign("fanuc-30i", 6, text);
        }
    }
    for text in ["GOTO", "]DO", "] DO", "]THEN", "] THEN"] {
        if code.contains(text) && code.contains('[') {
            sign("fanuc-30i", 6, "custom macro");
        }
    }
    crate::signs::controls(code, sign);
}

/// Whether a word or variable is assigned with `=` (`R1=5`, `X=10`, `CR=3`).
fn assigned(code: &str) -> bool {
    code.match_indices('=').any(|(at, _)| {
        let before = code[..at].trim_end();
        before.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_') && !code[at + 1..].starts_with('=')
    })
}

/// Whether `word` occurs in `code` and is not part of a longer name. Words may be packed: `N10G710`.
pub(crate) fn has_word(code: &str, word: &str) -> bool {
    code.match_indices(word).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + word.len()..]);
        let ends = match word.bytes().last() {
            Some(b'0'..=b'9') => !after.starts_with(|c: char| c.is_ascii_digit() || c == '.'),
            Some(b'A'..=b'Z') => !after.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_'),
            _ => true,
        };
        ends && !before.ends_with(|c: char| c.is_ascii_alphabetic() || c == '_')
    })
}

/// Whether the text ends with a name of two letters or more, whose arguments may follow (`CYCLE800`, `MSG`; not `G1`).
fn ends_with_name(text: &str) -> bool {
    let text = text.trim_end();
    let name = text
        .rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .next()
        .unwrap_or_default();
    name.bytes()
        .take(2)
        .filter(|&b| b.is_ascii_alphabetic() || b == b'_')
        .count()
        == 2
}

/// The line without `( ... )` comments and without `; ...`; arguments `NAME( ... )` stay.
fn strip_comments(line: &str) -> String {
    let mut out = String::with_capacity(line.len());
    let mut in_comment = false;
    for c in line.chars() {
        match c {
            ')' if in_comment => in_comment = false,
            _ if in_comment => {}
            ';' => break,
            '(' if !ends_with_name(&out) => in_comment = true,
            _ => out.push(c),
        }
    }
    out
}
