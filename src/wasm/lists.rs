//! What is built in, for menus and explanations.
use serde_json::json;
use trunnion_dialect::BUILTIN_NAMES;
use trunnion_machine::{BUILTIN_MACHINES, builtin};

/// Machines, dialects, and rules with their pages, as JSON.
pub fn lists() -> String {
    let machines = BUILTIN_MACHINES
        .iter()
        .map(|name| json!({ "name": name, "title": builtin(name).map(|machine| &machine.name) }));
    let dialects = BUILTIN_NAMES
        .iter()
        .map(|name| json!({ "name": name, "title": trunnion_dialect::builtin(name).map(|dialect| &dialect.title) }));
    let rules = trunnion_check::rules()
        .iter()
        .map(|rule| json!({ "name": rule.name, "summary": rule.summary(), "page": rule.docs }));
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "machines": machines.collect::<Vec<_>>(),
        "dialects": dialects.collect::<Vec<_>>(),
        "rules": rules.collect::<Vec<_>>(),
    })
    .to_string()
}

#[cfg(test)]
mod tests {
    #[test]
    fn nothing_is_empty() {
        let lists: serde_json::Value = serde_json::from_str(&super::lists()).expect("JSON");
        for (list, least) in [("machines", 20), ("dialects", 10), ("rules", 60)] {
            assert!(lists[list].as_array().is_some_and(|list| list.len() >= least), "{list}");
        }
    }
}
