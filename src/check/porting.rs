//! What changes its meaning when a program goes to another control: one function per lint, which reads the text and two dialects.
//!
//! A lint says only what follows from the text; whether a program runs there is what a check in the other dialect says.
mod expressions;
mod line;
mod words;

use crate::runs::Merge;
use crate::sink::Reporter;
use crate::view::Overview;
use crate::words::hash;
use line::Line;
use trunnion_dialect::{Dialect, Expressions};
use trunnion_syntax::TextRange;

/// From which control to which.
pub(crate) struct Route<'d> {
    pub(crate) from: &'d Dialect,
    pub(crate) to: &'d Dialect,
    pub(crate) languages: (Expressions, Expressions),
}

impl Route<'_> {
    /// Whether expressions go from RS274/NGC to macro B or back.
    pub(crate) fn crosses(&self) -> bool {
        matches!(
            self.languages,
            (Expressions::Rs274Ngc, Expressions::MacroB) | (Expressions::MacroB, Expressions::Rs274Ngc)
        )
    }
}

/// One place whose meaning changes.
pub(crate) struct Hit {
    pub(crate) range: TextRange,
    /// What it means there, after `on TARGET `.
    pub(crate) message: String,
    /// What to do.
    pub(crate) help: &'static str,
    /// Reported once per program: what must agree for that; `None`: reported at each place.
    pub(crate) once: Option<&'static str>,
}

/// Reads one block.
type Lint = fn(&Line<'_>, &Route<'_>, &mut Vec<Hit>);

const LINTS: &[Lint] = &[
    expressions::rounding,
    expressions::remainder,
    expressions::precedence,
    expressions::power,
    expressions::named_parameter,
    expressions::flow,
    words::same_group,
    words::repeated_word,
    words::unknown_code,
    words::dwell_unit,
    words::skip_inside,
    words::implicit_decimal,
    words::comment_marks,
];

/// Reports what would change its meaning on the controls that the settings name.
pub(crate) fn report(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let from = overview.settings.dialect;
    for name in &overview.settings.port_to {
        let Some(to) = trunnion_dialect::builtin(name) else {
            continue;
        };
        let both_iso = from.lex.format.has_words() && to.lex.format.has_words();
        if to.name == from.name || !both_iso {
            continue;
        }
        let route = Route {
            from,
            to,
            languages: (from.expressions(), to.expressions()),
        };
        let mut hits = Vec::new();
        for block in overview.program.blocks() {
            let line = Line::new(block);
            for lint in LINTS {
                lint(&line, &route, &mut hits);
            }
            for hit in hits.drain(..) {
                let draft = out.report(hit.range, format!("on {name} {}", hit.message));
                draft.help(hit.help);
                if let Some(key) = hit.once {
                    draft.merge(Merge::once(hash(&format!("{name} {key}"))));
                }
            }
        }
    }
}
