//! Signs of the controls whose programs are read.
use super::text::{assigned, has, has_word, is_block, word};
use super::votes::Votes;

/// A command to grbl itself, which senders put at the start of a file.
fn grbl_command(line: &str) -> Option<&'static str> {
    let commands = ["$H", "$X", "$C", "$SLP", "$I", "$G", "$#", "$N", "$$"];
    let starts = ["$J=", "$RST="];
    commands
        .into_iter()
        .find(|command| before_comment(line) == *command)
        .or_else(|| starts.into_iter().find(|start| line.starts_with(start)))
}

/// What stands before a comment.
fn before_comment(line: &str) -> &str {
    line.split(['(', ';']).next().unwrap_or_default().trim()
}

/// Signs in a line as it is written, in upper case.
pub(super) fn raw(line: &str, votes: &mut Votes) {
    // grbl answers `$$` alone with its settings
    match line.strip_prefix("$$") {
        Some(_) if before_comment(line) == "$$" => votes.add("apt", 3, "`$$` alone"),
        Some(_) => votes.add("apt", 10, "a `$$` comment"),
        None => {}
    }
    let (code, text) = line.split_once(';').unwrap_or((line, ""));
    let text = text.trim();
    if !text.is_empty() && !text.starts_with('(') && !is_block(text) && !code.contains('(') {
        votes.add(NOT_FANUC, 8, "text after `;`");
    }
    let majors = [
        "PARTNO", "GOTO", "FEDRAT", "LOADTL", "SPINDL", "MULTAX", "CUTTER", "FINI", "LOAD", "COOLNT", "CLDATA", "UNITS",
    ];
    for major in majors {
        if let Some(rest) = line.strip_prefix(major)
            && (rest.trim_start().starts_with('/')
                || (rest.is_empty() && major == "FINI")
                || (major == "PARTNO" && rest.starts_with(' ')))
        {
            votes.add("apt", 10, major);
        }
    }
    apt_source(line, votes);
    if line.starts_with("%_N_") {
        votes.add("sinumerik-840d", 20, "%_N_");
    }
    if let Some(command) = grbl_command(line) {
        votes.add("grbl", 12, command);
    }
    let active = [
        "(DEBUG,",
        "(PRINT,",
        "(LOGOPEN,",
        "(LOGAPPEND,",
        "(PROBEOPEN",
        "(ABORT,",
    ];
    for comment in active {
        if line.contains(comment) {
            votes.add("linuxcnc", 8, comment);
        }
    }
    if line.starts_with(";PY,") {
        votes.add("linuxcnc", 10, ";py,");
    }
}

/// Definitions, control of the flow and motions along surfaces: an APT processor reads them, and writes CL data without them.
fn apt_source(line: &str, votes: &mut Votes) {
    let statement = match line.split_once(')') {
        // a label: `LAB1)`
        Some((label, rest)) if label.bytes().all(|byte| byte.is_ascii_alphanumeric()) => rest.trim_start(),
        _ => line,
    };
    let major = |text: &str| {
        text.split(['/', ',', ' ', '(', '$'])
            .next()
            .unwrap_or_default()
            .to_owned()
    };
    let is_name = |text: &str| {
        let text = text.split('(').next().unwrap_or_default().trim();
        text.starts_with(|first: char| first.is_ascii_uppercase())
            && text.bytes().all(|byte| byte.is_ascii_alphanumeric())
    };
    let shapes = [
        "POINT", "LINE", "CIRCLE", "PLANE", "VECTOR", "PATERN", "CYLNDR", "SPHERE", "CONE", "ELLIPS", "HYPERB",
        "PARAB", "LCONIC", "GCONIC", "TABCYL", "RLDSRF", "QADRIC", "POLCON", "SCURV", "SSURF", "MATRIX", "MACRO",
    ];
    if let Some((name, rest)) = statement.split_once('=')
        && let Some(shape) = shapes.into_iter().find(|shape| *shape == major(rest.trim_start()))
        && is_name(name)
        && rest.contains('/')
    {
        votes.add("apt-source", 10, &format!("a definition of {shape}"));
    }
    let words = [
        "TERMAC", "RESERV", "LOOPST", "LOOPND", "JUMPTO", "ZSURF", "GOLFT", "GORGT", "GOFWD", "GOBACK", "TLLFT",
        "TLRGT", "INDIRP",
    ];
    let first = major(statement);
    if let Some(word) = words.into_iter().find(|word| *word == first) {
        votes.add("apt-source", 10, word);
    }
    let to_a_name = |rest: &str| {
        rest.trim_start()
            .strip_prefix('/')
            .is_some_and(|rest| is_name(rest.split(',').next().unwrap_or_default()))
    };
    if ["GOTO", "FROM", "GO"]
        .iter()
        .any(|word| statement.strip_prefix(word).is_some_and(to_a_name))
    {
        votes.add("apt-source", 10, "a motion to a name");
    }
}

/// Signs against a Fanuc, for none of the others alone.
pub(super) const NOT_FANUC: &str = "not-fanuc";

/// Signs in a line without comments, in upper case.
pub(super) fn code(code: &str, votes: &mut Votes) {
    sinumerik(code, votes);
    linuxcnc_and_fanuc(code, votes);
    haas(code, votes);
}

fn sinumerik(code: &str, votes: &mut Votes) {
    for name in [
        "TRAORI",
        "TRAFOOF",
        "CYCLE800",
        "CYCLE832",
        "MCALL",
        "SUPA",
        "G710",
        "G700",
        "GOTOF",
        "GOTOB",
        "DIAMON",
        "DIAMOF",
        "DEF REAL",
        "DEF INT",
        "DEF BOOL",
        "DEF STRING",
        "MSG(",
        "STOPRE",
        "EXTERN",
        "WORKPIECE(",
        "ATRANS",
        "AROT",
        "SETAL(",
        "SPOS",
    ] {
        if has_word(code, name) {
            votes.add("sinumerik-840d", 10, name);
        }
    }
    for name in [
        "AC(", "IC(", "DC(", "G500", "ENDLOOP", "ENDFOR", "TRANS", "CYCLE81(", "CYCLE83(",
    ] {
        if has_word(code, name) {
            votes.add("sinumerik-840d", 6, name);
        }
    }
    // G110 and G111 are work offsets of a Haas
    for name in ["AP=", "RP="] {
        if has_word(code, name) {
            votes.add("sinumerik-840d", 8, name);
        }
    }
    if assigned(code) && !code.contains('#') {
        votes.add("sinumerik-840d", 4, "a word with `=`");
    }
}

/// Keywords after the number or name of an O-word.
const O_WORDS: &[&str] = &[
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

fn linuxcnc_and_fanuc(code: &str, votes: &mut Votes) {
    // how arc centres count: LinuxCNC, grbl, Mach3 and others of their kind, whose posts also write G28 G91 Z0 and G43 H
    for number in ["90.1", "91.1"] {
        if has(code, b'G', number) {
            votes.add(NOT_FANUC, 6, &format!("G{number}"));
        }
    }
    // Fanuc Series 30i: a program with a name in place of a number
    if votes.line <= 5 && code.starts_with('<') && code.ends_with('>') && code.len() > 2 {
        votes.add("fanuc-30i", 6, "a program name <...>");
    }
    if let Some(rest) = code.strip_prefix('O').map(str::trim_start) {
        program_number(rest, votes);
    }
    if let Some(rest) = code.strip_prefix(':') {
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        if digits > 0 && rest[digits..].trim().is_empty() {
            votes.add("fanuc-30i", 6, "a program number :");
        }
    }
    for text in ["#<", "M428", "M429", "EXISTS["] {
        if code.contains(text) {
            votes.add("linuxcnc", 10, text);
        }
    }
    for (letter, number, with) in [
        (b'M', "66", b'P'),
        (b'M', "67", b'E'),
        (b'M', "68", b'E'),
        (b'M', "61", b'Q'),
    ] {
        if has(code, letter, number) && word(code, with) {
            votes.add(
                "linuxcnc",
                6,
                &format!("{}{number} {}", char::from(letter), char::from(with)),
            );
        }
    }
    if has(code, b'G', "96") && word(code, b'D') {
        votes.add("linuxcnc", 8, "G96 D");
    }
    for text in ["G43.4", "G43.5", "G68.2", "G54.1", "G5.1Q", "G5.1 Q", "G05.1"] {
        if code.contains(text) {
            votes.add("fanuc-30i", 10, text);
        }
    }
    for text in ["GOTO", "]DO", "] DO", "]THEN", "] THEN"] {
        if code.contains(text) && code.contains('[') && !code.starts_with('O') {
            votes.add("fanuc-30i", 6, "custom macro");
        }
    }
    if has(code, b'G', "65") && word(code, b'P') {
        votes.add("fanuc-30i", 6, "G65 P");
    }
    if code.contains("DPRNT[") || code.contains("POPEN") {
        votes.add("fanuc-30i", 8, "DPRNT or POPEN");
    }
    if code.starts_with("#3000=") || code.starts_with("#3006=") {
        votes.add("fanuc-30i", 8, "#3000 or #3006");
    }
    if has(code, b'G', "28") && has(code, b'G', "91") {
        votes.add("fanuc-30i", 3, "G91 G28");
    }
    if has(code, b'G', "43") && word(code, b'H') {
        votes.add("fanuc-30i", 2, "G43 H");
    }
}

/// What follows an O at the start of a line.
fn program_number(rest: &str, votes: &mut Votes) {
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    let digits = rest.len() - after.len();
    let label = digits > 0 || rest.starts_with('<') || rest.starts_with('#') || rest.starts_with('[');
    let last = if let Some(end) = after.find('>') {
        after[end + 1..].trim_start()
    } else {
        after.trim_start()
    };
    if label && O_WORDS.iter().any(|word| last.starts_with(word)) {
        votes.add("linuxcnc", 10, "an O-word");
    } else if (1..=8).contains(&digits) && after.trim().is_empty() {
        votes.add("fanuc-30i", 6, "a program number O");
        if digits == 5 {
            votes.add("haas-ngc", 6, "a program number of five digits");
        }
    } else if rest.starts_with('<') && after.trim_end().ends_with('>') {
        votes.add("fanuc-30i", 6, "a program name O<...>");
    }
}

/// What distinguishes a Haas from a Fanuc, but neither from other controls.
pub(super) const HAAS_HINT: &str = "haas-hint";

/// Codes that a Haas has and a Fanuc does not.
fn haas(code: &str, votes: &mut Votes) {
    for number in [
        "101", "103", "110", "111", "114", "115", "154", "187", "195", "234", "241", "254", "255", "268", "269",
    ] {
        if has(code, b'G', number) && has_word(code, &format!("G{number}")) {
            votes.add("haas-ngc", 8, &format!("G{number}"));
        }
    }
    if has(code, b'M', "97") && word(code, b'P') {
        votes.add("haas-ngc", 8, "M97");
    }
    let pocket = has(code, b'G', "12") || has(code, b'G', "13");
    if pocket && word(code, b'I') && !word(code, b'X') {
        votes.add("haas-ngc", 8, "a circular pocket G12 or G13");
    }
    if has(code, b'G', "150") && word(code, b'P') {
        votes.add("haas-ngc", 8, "G150");
    }
    let axes = [b'X', b'Y', b'Z', b'A', b'B', b'C', b'U', b'V', b'W'];
    if has(code, b'G', "28") && !has(code, b'G', "91") && !code.bytes().any(|byte| axes.contains(&byte)) {
        votes.add("haas-ngc", 6, "G28 without axes");
    }
    // other controls need G90 with it
    if has(code, b'G', "53") && !has(code, b'G', "90") {
        if word(code, b'Z') {
            votes.add(HAAS_HINT, 3, "G53 Z");
        }
        if word(code, b'X') || word(code, b'Y') {
            votes.add(HAAS_HINT, 3, "G53 X or Y");
        }
    }
    if has(code, b'M', "31") || has(code, b'M', "33") {
        votes.add(HAAS_HINT, 3, "the chip auger M31 or M33");
    }
    for cycle in ["71", "72"] {
        let one_block = [b'P', b'Q', b'U', b'W', b'D'].iter().all(|letter| word(code, *letter));
        if has(code, b'G', cycle) && one_block {
            votes.add("haas-ngc", 8, &format!("G{cycle} in one block"));
        }
    }
    if has(code, b'G', "76") && word(code, b'K') && word(code, b'D') && !word(code, b'P') {
        votes.add("haas-ngc", 6, "G76 in one block");
    }
}
