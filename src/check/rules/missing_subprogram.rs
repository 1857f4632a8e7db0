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
//! there. It is unknown, too, once 4096 other programs are missing: no further one is looked for. Only the program itself, its folder and the folders in the settings are
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
        if let Some(why) = searched.iter().find_map(|place| place.skipped.as_ref()) {
            out.report(
                fault.range,
                format!("program `{name}`{caller} was not looked for: {why}"),
            )
            .unknown()
            .help("correct the names of the programs that are not found, or name their folder in trunnion.toml: subprogram_path = [\"subs\"]")
            .merge(Merge::once(hash("not looked for")));
            return;
        }
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

#[cfg(test)]
mod tests {
    use crate::{Settings, Status, check};
    use std::sync::Arc;
    use trunnion_interp::{Files, Library, Loaded, Searched, Setup};

    #[derive(Debug)]
    struct Empty;

    impl Files for Empty {
        fn load(&self, _: &str) -> Result<Loaded, Vec<Searched>> {
            Err(vec!["subs".into()])
        }
    }

    /// Nothing says that they do not exist.
    #[test]
    fn programs_that_are_not_looked_for_are_unknown() {
        let calls: Vec<String> = (1..=4099).map(|number| format!("M98 P{number}")).collect();
        let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
        let setup = Setup {
            library: Library(Some(Arc::new(Empty))),
            ..Setup::default()
        };
        let program = trunnion_syntax::parse(
            format!("G21 G90\n{}\nM30\n", calls.join("\n")).into_bytes(),
            dialect.lex,
        );
        let report = check(&program, &Settings::new(dialect, None, setup));
        let own = report.diagnostics.iter().filter(|d| d.rule == "missing-subprogram");
        let open: Vec<_> = own.filter(|d| d.status == Status::Unknown).collect();
        assert_eq!(open.len(), 1, "{open:?}");
        assert_eq!(open[0].count, 3);
        assert!(
            open[0]
                .message
                .contains("`O4097` was not looked for: 4096 other programs"),
            "{}",
            open[0].message
        );
    }
}
