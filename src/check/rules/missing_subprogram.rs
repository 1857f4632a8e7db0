//! A called program is not found.
//!
//! # Why
//! The control stops at the call. What the subprogram would have done is not known here, so nothing behind the call is proved.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 M98 P1234
//! ;   ^^^^^^^^^ missing-subprogram: there is no program `O1234`
//! N20 M30
//! ```
//!
//! # Use instead
//! Put the program beside the one that calls it, or name its folder in `trunnion.toml`: `subprogram_path = ["subs"]`.
//!
//! # Guarantee
//! Sound for the calls that are modelled: the program's own text, its folder and the folders of the settings were searched, and no others.
//!
//! # Sources
//! Answers of the interpreter of LinuxCNC 2.9; Trunnion's interface: the folders that were searched are named.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::MissingSubprogram {
        name,
        searched,
        alarm,
        caller,
    } = &fault.kind
    {
        let caller = caller
            .as_ref()
            .map_or_else(String::new, |place| format!(", called in {place}"));
        let draft = out.report(fault.range, format!("there is no program `{name}`{caller}"));
        draft.note(if searched.is_empty() {
            "only the text of the program itself was searched".to_owned()
        } else {
            format!("searched: the program itself, {}", searched.join(", "))
        });
        if let Some(alarm) = alarm {
            draft.note(format!("the control says: {alarm}"));
            draft.value_text("alarm", alarm.clone());
        }
        draft
            .help("put it beside the program, or name its folder in trunnion.toml: subprogram_path = [\"subs\"]")
            .merge_everywhere(hash(name));
        return;
    }
    refused(fault, out, &[Refusal::Subprogram]);
}
