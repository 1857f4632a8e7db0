//! A called program is not found.
//!
//! # Why
//! The control stops at the call. What the subprogram would do is unknown here, so nothing after the call is
//! proved.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 M98 P1234
//! ;   ^^^^^^^^^ missing-subprogram: program `O1234` not found
//! N20 M30
//! ```
//!
//! # Use instead
//! Put the program in the folder of the one that calls it, or name its folder in `trunnion.toml`: `subprogram_path = ["subs"]`.
//!
//! # Guarantee
//! Sound for the calls that are modelled. On an Okuma, which is supplied with subprograms of its own, it is unknown whether the program is
//! there. Only the program itself, its folder and the folders in the settings are
//! searched.
//!
//! # Sources
//! * docs/contract.md#where-subprograms-are-searched
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
use crate::caller::Part;
use crate::prelude::*;
use trunnion_dialect::Language;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::Subprogram, plain)]);

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
        let near = out.near_code(name);
        let in_control = out.dialect().advice.subprograms_in_control;
        let alone = out.part() == Part::Called && out.dialect().quirks.language == Language::Linuxcnc;
        let refused = searched.iter().find_map(|place| place.refused.as_ref());
        let draft = out.report(
            fault.range,
            match refused {
                None if near.is_some() => {
                    let near = near.as_deref().unwrap_or_default();
                    format!("program `{name}` not found{caller}; did you mean the code `{near}`?")
                }
                None => format!("program `{name}` not found{caller}"),
                Some(why) => format!("program `{name}`{caller} is not read: {why}"),
            },
        );
        let shown = |folder: &'_ str| {
            if folder == "." {
                "the current folder".to_owned()
            } else {
                folder.to_owned()
            }
        };
        let folders: Vec<String> = searched.iter().map(|place| shown(place.folder.as_str())).collect();
        draft.note(if searched.is_empty() {
            "only the program itself was searched".to_owned()
        } else {
            format!("searched: the program itself, {}", folders.join(", "))
        });
        if alone && refused.is_none() {
            draft
                .unknown()
                .note("the program that calls this file may have its subprograms in another folder".to_owned());
        }
        if in_control && refused.is_none() {
            draft
                .unknown()
                .note("this control has subprograms of its own: this may be one of them".to_owned());
        }
        if let Some(alarm) = alarm {
            draft.note(format!("the control says: {alarm}"));
            draft.value_text("alarm", alarm.clone());
        }
        draft
            .help(if refused.is_some() {
                "give the program its own small, readable file in the folder of the program or of `subprogram_path`"
            } else {
                "put it in the folder of the program, or name its folder in trunnion.toml: subprogram_path = [\"subs\"]"
            })
            .merge(Merge::once(hash(name)));
    }
}
