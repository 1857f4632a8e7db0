//! Signs of Haas mills, of Fanuc lathes and of grbl in one line of a program.
use crate::detect::has_word;

/// A command to grbl itself, which senders put at the head of a file.
pub(crate) fn grbl_command(line: &str) -> Option<&'static str> {
    let commands = ["$H", "$X", "$C", "$SLP"];
    let starts = ["$J=", "$RST="];
    commands
        .into_iter()
        .find(|command| line.split(['(', ';']).next().unwrap_or_default().trim() == *command)
        .or_else(|| starts.into_iter().find(|start| line.starts_with(start)))
}

/// Words of a line: letter and number as written.
fn words(code: &str) -> impl Iterator<Item = (u8, &str)> {
    code.char_indices()
        .filter(|(_, c)| c.is_ascii_uppercase())
        .map(|(at, letter)| {
            let rest = code[at + 1..].trim_start();
            let end = rest
                .find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-' || c == '+'))
                .unwrap_or(rest.len());
            (letter as u8, &rest[..end])
        })
}

/// Whether a line holds the code of a letter and number, leading zeros left out: `G50`, `M97`.
fn has(code: &str, letter: u8, number: &str) -> bool {
    words(code).any(|(known, digits)| known == letter && digits.trim_start_matches('0') == number)
}

fn word(code: &str, letter: u8) -> bool {
    words(code).any(|(known, digits)| known == letter && !digits.is_empty())
}

/// Signs in a line without comments, upper case.
pub(crate) fn controls(code: &str, sign: &mut dyn FnMut(&'static str, u32, &str)) {
    if code.is_empty() || code.starts_with('$') {
        return;
    }
    haas(code, sign);
    lathe(code, sign);
}

/// Codes that a Haas has and a Fanuc mill has not.
fn haas(code: &str, sign: &mut dyn FnMut(&'static str, u32, &str)) {
    for number in [
        "101", "110", "111", "114", "115", "154", "187", "234", "254", "255", "268", "269",
    ] {
        if has(code, b'G', number) && has_word(code, &format!("G{number}")) {
            sign("haas-ngc", 8, &format!("G{number}"));
        }
    }
    if has(code, b'M', "97") && word(code, b'P') {
        sign("haas-ngc", 8, "M97");
    }
    let pocket = has(code, b'G', "12") || has(code, b'G', "13");
    if pocket && word(code, b'I') && !word(code, b'X') {
        sign("haas-ngc", 8, "a circular pocket G12 or G13");
    }
    if has(code, b'G', "150") && word(code, b'P') {
        sign("haas-ngc", 8, "G150");
    }
}

/// What only lathes write: U and W distances with G28, G50 S, the repeated cycles, T with tool and offset.
fn lathe(code: &str, sign: &mut dyn FnMut(&'static str, u32, &str)) {
    let system_a = "fanuc-30i-lathe-a";
    if has(code, b'G', "50") && word(code, b'S') {
        sign(system_a, 10, "G50 S");
    }
    if has(code, b'G', "28") && (word(code, b'U') || word(code, b'W')) && !word(code, b'Y') {
        sign(system_a, 10, "G28 U or W");
    }
    for cycle in ["71", "72", "73", "76"] {
        let contour = word(code, b'P') && word(code, b'Q');
        let depth = word(code, b'U') && word(code, b'R');
        if has(code, b'G', cycle) && (contour || depth) && !word(code, b'Z') {
            sign(system_a, 8, &format!("the turning cycle G{cycle}"));
        }
    }
    if has(code, b'G', "92") && word(code, b'S') && !word(code, b'X') {
        sign("fanuc-30i-lathe-b", 4, "G92 S");
    }
}
