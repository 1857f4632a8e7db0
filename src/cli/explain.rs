//! `explain` and `rules`: pages and lists, from the headers of the rules' own files.
use super::{
    Done,
    args::{Explain, ListFormat, Rules},
    failure::Failure,
    json::write_json,
    short,
};
use crate::cli::out::Out;
use serde_json::json;
use std::io::Write;
use trunnion_check::{Guarantee, did_you_mean, rule, rule_names, rules};
use trunnion_rewrite::{rewrite, rewrites};

/// Prints the page of a rule or rewrite.
pub(super) fn explain(command: &Explain) -> Result<Done, Failure> {
    let name = command.name.to_ascii_lowercase();
    let docs = rule(&name).map(|r| r.docs).or_else(|| rewrite(&name).map(|r| r.docs));
    let Some(docs) = docs else {
        let mut names = rule_names();
        names.extend(rewrites().iter().map(|known| known.name));
        let hint = did_you_mean(&name, &names, "; `trunnion rules` lists all");
        return Err(Failure::new(format!("unknown rule or rewrite `{name}`{hint}")));
    };
    let mut out = Out::standard();
    writeln!(out, "{name}\n{}\n\n{}", "=".repeat(name.len()), docs.trim_end())?;
    Ok(Done::Clean)
}

/// Prints the list.
pub(super) fn rules_list(command: &Rules) -> Result<Done, Failure> {
    let mut out = Out::standard();
    let summary = |docs: &'static str| docs.lines().next().unwrap_or_default();
    let guarantee = |g| if g == Guarantee::Sound { "sound" } else { "heuristic" };
    if command.format == ListFormat::Json {
        let list: Vec<_> = rules()
            .iter()
            .map(|r| {
                json!({ "name": r.name, "severity": short::severity(r.severity), "guarantee": guarantee(r.guarantee),
                        "summary": summary(r.docs) })
            })
            .collect();
        let fixes: Vec<_> = rewrites()
            .iter()
            .map(|r| json!({ "name": r.name, "cures": r.cures, "summary": summary(r.docs) }))
            .collect();
        write_json(
            &mut out,
            &json!({ "schema": "trunnion-rules/1", "rules": list, "rewrites": fixes }),
        )?;
        return Ok(Done::Clean);
    }
    writeln!(out, "Rules (`trunnion explain NAME` for the page):")?;
    for r in rules() {
        writeln!(
            out,
            "  {:26} {:8} {:10} {}",
            r.name,
            short::severity(r.severity),
            guarantee(r.guarantee),
            summary(r.docs)
        )?;
    }
    writeln!(out, "\nRewrites:")?;
    for r in rewrites() {
        writeln!(
            out,
            "  {:26} cures {:28} {}",
            r.name,
            r.cures.join(", "),
            summary(r.docs)
        )?;
    }
    Ok(Done::Clean)
}
