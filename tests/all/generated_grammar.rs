//! The TextMate grammars of the editor extension are what the dialect tables make of them.
//!
//! `UPDATE=1 cargo test --test all generated_grammar` writes them again.
use std::path::{Path, PathBuf};
use trunnion::dialect::{BUILTIN_NAMES, Dialect, builtin, textmate};
use trunnion::syntax::Format;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("vscode-extension/syntaxes")
        .join(name)
}

fn dialects(format: Format) -> Vec<&'static Dialect> {
    BUILTIN_NAMES
        .iter()
        .filter_map(|name| builtin(name))
        .filter(|dialect| dialect.lex.format == format || format == Format::Iso && dialect.lex.format.has_words())
        .collect()
}

fn fresh(name: &str, text: &str) {
    let path = file(name);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::create_dir_all(path.parent().expect("there")).expect("there");
        std::fs::write(&path, text).expect("there");
    }
    let there = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        there == text,
        "{} is stale: run `UPDATE=1 cargo test --test all generated_grammar`",
        path.display()
    );
}

#[test]
fn gcode_grammar_is_fresh() {
    fresh("gcode.tmLanguage.json", &textmate(&dialects(Format::Iso)));
}

#[test]
fn apt_grammar_is_fresh() {
    fresh("apt.tmLanguage.json", &textmate(&dialects(Format::Apt)));
}

#[test]
fn klartext_grammar_is_fresh() {
    fresh("klartext.tmLanguage.json", &textmate(&dialects(Format::Klartext)));
}

#[test]
fn grammars_know_the_codes_of_the_tables() {
    let grammar: serde_json::Value = serde_json::from_str(&textmate(&dialects(Format::Iso))).expect("there");
    assert_eq!(grammar["scopeName"], "source.gcode");
    let codes = grammar["repository"]["codes"]["patterns"].as_array().expect("a list");
    let expressions: String = codes.iter().filter_map(|pattern| pattern["match"].as_str()).collect();
    for part in [
        r"43(?:\.[1234589])?",
        "599|598|",
        "|700|",
        r"|53(?:\.[136])?|",
        "430|429|428|",
    ] {
        assert!(expressions.contains(part), "{part}");
    }
    let names = grammar["repository"]["names"].to_string();
    for part in ["TRAORI|", "CYCLE832|", "ENDWHILE|", r"|GOTO\\d*|"] {
        assert!(names.contains(part), "{part}");
    }
    let apt: serde_json::Value = serde_json::from_str(&textmate(&dialects(Format::Apt))).expect("there");
    assert_eq!(apt["scopeName"], "source.apt");
    assert!(apt.to_string().contains("TOOL PATH"));
    let klartext: serde_json::Value = serde_json::from_str(&textmate(&dialects(Format::Klartext))).expect("there");
    assert_eq!(klartext["scopeName"], "source.klartext");
    assert!(klartext.to_string().contains("APPR|"));
}

#[test]
fn no_dialect_still_makes_a_grammar() {
    let grammar: serde_json::Value = serde_json::from_str(&textmate(&[])).expect("there");
    assert!(grammar["repository"]["codes"].to_string().contains("(?!)"));
}
