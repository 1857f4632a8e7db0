//! A comment is opened and not closed.
//!
//! # Why
//! Controls differ: one reports an alarm, another takes the rest of the line, or of the file, as a comment and
//! skips the motions in it.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 (approach
//! ;          ^^^^^^^^^ unclosed-comment: the comment is not closed
//! N20 G0 Z5
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10 (approach)
//! N20 G0 Z5
//! ```
//!
//! # Guarantee
//! Sound for the comment marks of the dialect.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.3.3 on comments and messages.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Text(check)]);

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    if error.kind == SyntaxErrorKind::UnclosedComment {
        out.report(error.range, "the comment is not closed")
            .note("nothing up to the end of the comment runs")
            .help("add the closing mark");
    }
}
