//! A letter or name has no meaning in the dialect.
//!
//! # Why
//! A word that the control does not know stops it, or the control skips it together with its intended effect.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 SPEED=3
//! ;          ^^^^^^^ unknown-word: `SPEED=3` has no meaning in iso-6983
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! ```
//!
//! # Guarantee
//! Sound for the dialect's table of letters and names.
//!
//! # Sources
//! * grammar/README.md, the dialect tables and their sources.
use crate::prelude::*;
use trunnion_dialect::{Dialect, nearest};
use trunnion_syntax::Format;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::UnknownWord, plain)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::UnknownWord && !out.is_slip(fault.range) {
        let text = out.text(fault.range);
        let near = near_word(&text, out.dialect());
        let hint = near
            .as_ref()
            .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let dialect = &out.dialect().name;
        out.report(fault.range, format!("`{text}` has no meaning in {dialect}{hint}"))
            .help("correct the word, or name the dialect of the program: --dialect NAME")
            .merge(Merge::run(hash(&text), 0.0))
            .replace_with_some(near);
    }
}

/// A word or statement of Klartext, whose words are names, with the likely spelling of its first name.
fn near_word(text: &str, dialect: &Dialect) -> Option<String> {
    if dialect.lex.format != Format::Klartext || text.ends_with("...") {
        return None;
    }
    let end = text.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (name, rest) = text.split_at(end);
    if name.len() < 3 {
        return None;
    }
    let known = dialect.codes().iter().flat_map(|code| {
        let words = code.words.iter().map(String::as_str);
        words.chain([code.id.as_str()]).filter(|word| word.len() >= 3)
    });
    let near = nearest(&name.to_ascii_uppercase(), known)?;
    Some(format!("{near}{rest}"))
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    /// A misspelt statement is one finding, and a misspelt feed is not missing as well.
    #[test]
    fn klartext_names_have_a_likely_spelling() {
        let text = "BEGIN PGM A MM\nTOL CALL 1 Z S1000\n;^^^^^^^^^^^^^^^^^ unknown-word: `TOL CALL 1 Z S1000` has no meaning in heidenhain-klartext; did you mean `TOOL CALL 1 Z S1000`?\nL X+0 Y+0 Z+50 R0 FMAXX M3\n;                 ^^^^^ unknown-word: `FMAXX` has no meaning in heidenhain-klartext; did you mean `FMAX`?\nL M30\nEND PGM A MM\n";
        assert_drawn("gcode heidenhain-klartext", text);
    }
}
