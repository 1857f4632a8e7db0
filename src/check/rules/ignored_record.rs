//! APT records are recognised and have no effect here.
//!
//! # Why
//! CL data hold words for the post-processor. Those that are listed here do not change the path as it is computed. A post-processor may
//! still do something with them, for example clamp an axis or split the output; so they are listed.
//!
//! # Example
//! ```gcode apt
//! SEQNO/10
//! $$^^^^^^ ignored-record: 3 records of 2 kinds have no effect here: SEQNO (2), CLAMP
//! CLAMP/XAXIS
//! SEQNO/20
//! FINI
//! ```
//!
//! # Use instead
//! ```gcode apt
//! FINI
//! ```
//!
//! # Guarantee
//! Sound; one finding per file, at the first such record, with all of them and how often each occurs.
//!
//! # Sources
//! * grammar/dialects/apt.toml, the table of APT words.
//! * ISO 4343:2000, the post-processor commands of APT.
use crate::prelude::*;
use trunnion_interp::ignored_records;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let ignored = ignored_records(overview.program, out.dialect());
    let Some(first) = ignored.first() else { return };
    let total: u32 = ignored.iter().map(|records| records.count).sum();
    let list: Vec<String> = ignored
        .iter()
        .map(|records| match records.count {
            1 => records.name.clone(),
            count => format!("{} ({count})", records.name),
        })
        .collect();
    let what = match (total, list.as_slice()) {
        (1, [only]) => format!("one record has no effect here: {only}"),
        (_, [_]) => format!("{total} records have no effect here: {}", list[0]),
        _ => format!(
            "{total} records of {} kinds have no effect here: {}",
            list.len(),
            list.join(", ")
        ),
    };
    out.report(first.first, what)
        .note("they are words for the post-processor; the path does not depend on them as it is computed here")
        .help("check whether the post-processor moves or clamps something at one of them");
}
