//! Names of programs and keywords.
use trunnion_flow::Key;

/// Statements of the flow that this run follows.
const STATEMENTS: [&[u8]; 23] = [
    b"IF",
    b"ELSE",
    b"ENDIF",
    b"LOOP",
    b"ENDLOOP",
    b"WHILE",
    b"ENDWHILE",
    b"FOR",
    b"ENDFOR",
    b"REPEAT",
    b"REPEATB",
    b"UNTIL",
    b"GOTO",
    b"GOTOF",
    b"GOTOB",
    b"GOTOC",
    b"GOTOS",
    b"CASE",
    b"RET",
    b"CALL",
    b"PCALL",
    b"EXTCALL",
    b"ISOCALL",
];

/// Whether a name begins a statement of the flow.
pub(super) fn is_statement(name: &[u8]) -> bool {
    STATEMENTS.iter().any(|known| name.eq_ignore_ascii_case(known))
}

/// The name of a program as it is compared: `SHAFT` for `%_N_SHAFT_MPF`, `_N_SHAFT_SPF`, `Shaft`.
pub(super) fn program_key(text: &str) -> Key {
    let name = text.trim_start_matches('%').trim().to_ascii_uppercase();
    let name = name.strip_prefix("_N_").unwrap_or(&name);
    let name = name
        .strip_suffix("_MPF")
        .or_else(|| name.strip_suffix("_SPF"))
        .unwrap_or(name);
    Key::Name(name.into())
}

/// What a file name ends with that says what sort of program it is.
const ENDINGS: [&str; 2] = ["MPF", "SPF"];

/// A name without its ending (`.SPF`), and the ending.
fn split_ending(name: &str) -> (&str, Option<&str>) {
    match name.rsplit_once('.') {
        Some((stem, ending)) if ENDINGS.contains(&ending) => (stem, Some(ending)),
        _ => (name, None),
    }
}

/// The name of a program as a call by a text or path gives it, with `.SPF` or `.MPF` where it says so; `None`: it is no name of a program.
pub(super) fn called_key(text: &str) -> Option<Key> {
    let upper = text.trim().to_ascii_uppercase();
    let name = upper.strip_prefix("_N_").unwrap_or(&upper);
    let name = match name.rsplit_once('_') {
        Some((stem, ending)) if ENDINGS.contains(&ending) => format!("{stem}.{ending}"),
        _ => name.to_owned(),
    };
    let (stem, _) = split_ending(&name);
    let plain = !stem.is_empty() && stem.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    plain.then(|| Key::Name(name.into()))
}

/// The same as programs inside a file are named.
pub(crate) fn without_ending(key: &Key) -> Key {
    match key {
        Key::Name(name) => Key::Name(split_ending(name).0.into()),
        Key::Number(number) => Key::Number(*number),
    }
}

/// File names that a program may have. A name alone is searched as a main program first, then as a subprogram (Programming Manual,
/// 3.2.3.1).
pub(crate) fn files(name: &Key) -> Vec<String> {
    let Key::Name(name) = name else { return Vec::new() };
    let (name, said) = split_ending(name);
    let lower = name.to_ascii_lowercase();
    let mut files = Vec::new();
    let wanted = |ending: &&str| said.is_none_or(|said| ending.eq_ignore_ascii_case(said));
    for ending in ["MPF", "mpf", "SPF", "spf"].into_iter().filter(wanted) {
        files.push(format!("{name}.{ending}"));
        files.push(format!("{lower}.{ending}"));
        if ending.starts_with(|first: char| first.is_ascii_uppercase()) {
            files.push(format!("_N_{name}_{ending}"));
        }
    }
    files
}

#[cfg(test)]
mod tests {
    use super::{Key, called_key, files, program_key, without_ending};

    #[test]
    fn a_call_may_say_which_sort_of_program_it_means() {
        for (text, name) in [
            ("sub", "SUB"),
            ("_N_SUB", "SUB"),
            ("SUB.SPF", "SUB.SPF"),
            ("_N_SUB_SPF", "SUB.SPF"),
            ("sub_mpf", "SUB.MPF"),
        ] {
            let key = called_key(text).expect("a name");
            assert_eq!(key, Key::Name(name.into()), "{text}");
            assert_eq!(without_ending(&key), Key::Name("SUB".into()));
        }
        for text in ["", "SUB.TXT", ".SPF", "A B", "_N__SPF"] {
            assert_eq!(called_key(text), None, "{text}");
        }
        let files = files(&Key::Name("SUB.SPF".into()));
        assert_eq!(files, ["SUB.SPF", "sub.SPF", "_N_SUB_SPF", "SUB.spf", "sub.spf"]);
    }

    #[test]
    fn a_program_has_one_name() {
        for text in ["%_N_SHAFT_MPF", "%_N_SHAFT_SPF", "Shaft", "%SHAFT", "_N_SHAFT_SPF"] {
            assert_eq!(program_key(text), Key::Name("SHAFT".into()), "{text}");
        }
        let files = files(&Key::Name("L020".into()));
        assert_eq!(files[0], "L020.MPF");
        assert!(files.contains(&"l020.spf".to_owned()) && files.contains(&"_N_L020_SPF".to_owned()));
    }
}
