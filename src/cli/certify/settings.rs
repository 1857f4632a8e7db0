//! What the settings of two programs' folders say differently. A certificate holds one set-up, so two programs are proved the same only where
//! their settings agree.
use crate::cli::load::Loaded;
use std::path::Path;
use trunnion_interp::{Setup, Tool};

/// Why no verdict is given, if the settings of both programs differ in what a run depends on. Where the program after has none, as a file that
/// was written to another folder, those of the program before apply to both.
pub(super) fn differ(before: &Loaded, after: &Loaded) -> Option<String> {
    let (old, new) = (&before.resolved, &after.resolved);
    new.config_path.as_ref()?;
    let mut what = unlike(&old.setup, &new.setup);
    if let (Some(first), Some(second)) = (&old.machine, &new.machine)
        && !trunnion_certify::same_machine(first, second)
    {
        what.push(format!("machine ({} and {})", first.id, second.id));
    }
    if what.is_empty() {
        return None;
    }
    let settings = |path: &Option<std::path::PathBuf>| {
        let path = path.as_deref().map(Path::display);
        path.map_or_else(|| "no settings".to_owned(), |path| path.to_string())
    };
    Some(format!(
        "the settings of both programs differ ({}; {}): {}. A certificate holds one set-up: give both programs the same settings; \
         `trunnion diff` compares each with its own",
        settings(&old.config_path),
        settings(&new.config_path),
        what.join(", ")
    ))
}

/// Names of what differs.
fn unlike(old: &Setup, new: &Setup) -> Vec<String> {
    let mut what = Vec::new();
    let offsets = old.work_offsets.iter().chain(&new.work_offsets);
    for offset in offsets {
        let name = format!("work offset {}", offset.name);
        if old.work_offset(&offset.name) != new.work_offset(&offset.name) && !what.contains(&name) {
            what.push(name);
        }
    }
    let of = |tools: &[Tool], number| -> Vec<Tool> {
        let found = tools.iter().filter(|tool| tool.number == number);
        found.copied().collect()
    };
    for tool in old.tools.iter().chain(&new.tools) {
        let name = format!("tool {}", tool.number);
        if of(&old.tools, tool.number) != of(&new.tools, tool.number) && !what.contains(&name) {
            what.push(name);
        }
    }
    if old.tool_offsets != new.tool_offsets {
        what.push("tool offsets".to_owned());
    }
    if old.control != new.control {
        what.push("what they say of the control".to_owned());
    }
    if old.variables != new.variables {
        what.push("values of numbered variables".to_owned());
    }
    what
}
