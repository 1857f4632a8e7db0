//! END PGM names another program or unit than BEGIN PGM.
//!
//! # Why
//! BEGIN PGM and END PGM both name the Klartext program and its unit. Where they differ, the end of another program was pasted in, or a part of the
//! program is missing.
//!
//! # Example
//! ```gcode heidenhain-klartext
//! 0 BEGIN PGM PLATE MM
//! 1 M30
//! 2 END PGM COVER MM
//! ; ^^^^^^^^^^^^^^^^ program-name-mismatch: END PGM names COVER MM, BEGIN PGM names PLATE MM
//! ```
//!
//! # Use instead
//! ```gcode heidenhain-klartext
//! 0 BEGIN PGM PLATE MM
//! 1 M30
//! 2 END PGM PLATE MM
//! ```
//!
//! # Guarantee
//! Heuristic: whether the control refuses the program or corrects the name is not known. Each END PGM is compared with the BEGIN PGM before it.
//!
//! # Sources
//! * HEIDENHAIN TNC 640 34059x-07 (Klartext programming): program name and unit in both blocks.
use crate::prelude::*;
use crate::program_bounds::bound;
use trunnion_syntax::Format;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    if overview.settings.dialect.lex.format != Format::Klartext {
        return;
    }
    let mut begun: Option<String> = None;
    for block in overview.program.blocks() {
        let Some(sentence) = block.sentence() else { continue };
        match bound(&sentence.text()) {
            Some((true, name)) => begun = Some(name),
            Some((false, name)) => {
                if let Some(begun) = begun.as_deref().filter(|begun| !begun.eq_ignore_ascii_case(&name)) {
                    let end = if name.is_empty() { "nothing" } else { &name };
                    out.report(sentence.range, format!("END PGM names {end}, BEGIN PGM names {begun}"))
                        .help("check that the program is complete, then write the same name and unit in both blocks");
                }
            }
            None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn the_unit_belongs_to_it_and_case_does_not() {
        assert_drawn(
            "gcode heidenhain-klartext",
            "0 BEGIN PGM A-1 MM\n1 M30\n2 END PGM A-1 INCH\n; ^^^^^^^^^^^^^^^^ program-name-mismatch: END PGM names A-1 INCH, BEGIN PGM names A-1 MM\n",
        );
        assert_drawn(
            "gcode heidenhain-klartext",
            "0 BEGIN PGM a-1 mm\n1 M30\n2 END PGM A-1 MM\n",
        );
        assert_drawn("gcode heidenhain-klartext", "0 BEGIN PGM A MM\n1 M30\n");
    }
}
