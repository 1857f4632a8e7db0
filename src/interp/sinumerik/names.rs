//! Names of programs and keywords.
use trunnion_flow::Key;

/// Statements of the flow that this run follows.
const STATEMENTS: [&[u8]; 21] = [
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

/// File names that a program may have. A name alone is searched as a main program first, then as a subprogram (Programming Manual,
/// 3.2.3.1).
pub(crate) fn files(name: &Key) -> Vec<String> {
    let Key::Name(name) = name else { return Vec::new() };
    let lower = name.to_ascii_lowercase();
    let mut files = Vec::new();
    for ending in ["MPF", "mpf", "SPF", "spf"] {
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
    use super::{Key, files, program_key};

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
