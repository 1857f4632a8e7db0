//! `init`: a settings file to begin with, filled with what the programs of the folder show.
use super::{
    Done,
    args::{Global, Init},
    failure::{Failure, remark},
    load, walk,
};
use std::{
    collections::BTreeMap,
    fmt::Write,
    path::{Path, PathBuf},
};
use trunnion_files::Outputs;

/// Writes `trunnion.toml` in a folder that has none.
pub(super) fn run(global: &Global, command: &Init) -> Result<Done, Failure> {
    let folder = command.folder.clone().unwrap_or_else(|| PathBuf::from("."));
    if !folder.is_dir() {
        return Err(Failure::file(
            &folder,
            "is not a folder; name the folder of the programs",
        ));
    }
    let file = folder.join("trunnion.toml");
    if file.exists() {
        return Err(Failure::file(
            &file,
            "exists already and was not changed; edit it, or remove it first",
        ));
    }
    known(global, &folder)?;
    let target = Outputs::new().output("trunnion.toml", &file)?;
    let mut dialects = BTreeMap::<String, usize>::new();
    let mut certain = true;
    // a folder without programs gets its settings too
    let found = walk::programs(std::slice::from_ref(&folder)).unwrap_or_default();
    for path in &found.files {
        if let Ok(opened) = load::open(global, path)
            && opened.resolved.foreign.is_none()
        {
            *dialects.entry(opened.resolved.dialect.name.clone()).or_default() += 1;
            certain &= opened.resolved.dialect_certain;
        }
    }
    target.write(text(global, &dialects, certain).as_bytes(), None)?;
    let read = if dialects.is_empty() {
        "no program was found there".to_owned()
    } else {
        let each: Vec<String> = dialects.iter().map(|(name, count)| format!("{count} {name}")).collect();
        format!("programs found: {}", each.join(", "))
    };
    remark(global.quiet, &format!("{}: written; {read}", file.display()));
    let first = match global.machine {
        Some(_) => "",
        None => "set the machine in it, then ",
    };
    let next = format!("next: {first}run `trunnion check {}`", folder.display());
    remark(global.quiet, &next);
    Ok(Done::Clean)
}

/// What the user names must exist before it is written down.
fn known(global: &Global, folder: &Path) -> Result<(), Failure> {
    if let Some(machine) = &global.machine {
        trunnion_workspace::find_machine(machine, Some(folder))?;
    }
    match &global.dialect {
        Some(name) if trunnion_dialect::builtin(name).is_none() => {
            let hint = trunnion_dialect::dialect_hint(name);
            Err(Failure::new(format!("unknown dialect `{name}`{hint}")))
        }
        _ => Ok(()),
    }
}

/// The text of the settings; `certain`: each program shows its dialect. Where one does not, the machine's control decides, as long as no setting does.
fn text(global: &Global, dialects: &BTreeMap<String, usize>, certain: bool) -> String {
    let mut out = String::from(
        "# Settings of trunnion for the programs in this folder and below.\n\
         # All keys: `trunnion schema settings`, or docs/settings.md in the source of trunnion.\n\n",
    );
    match &global.machine {
        Some(machine) => {
            let _ = writeln!(out, "machine = {}", toml::Value::String(machine.clone()));
        }
        None => out.push_str(
            "# The machine that runs them: a name of `trunnion machine list`, or a file. Without it only text and motions are judged.\n\
             # machine = \"mill-3axis\"\n",
        ),
    }
    match (&global.dialect, dialects.len()) {
        (Some(dialect), _) => {
            let _ = writeln!(out, "\ndialect = {}", toml::Value::String(dialect.clone()));
        }
        (None, 1) if certain => {
            let name = dialects.keys().next().map_or("", String::as_str);
            let _ = writeln!(
                out,
                "\n# All programs that were found here look like this.\ndialect = \"{name}\""
            );
        }
        _ => out.push_str("\n# dialect = \"fanuc-30i\"   # default: found out for each program\n"),
    }
    out.push_str(
        "\n# Where the part zero is in machine coordinates, in mm. What depends on an undeclared offset is unknown.\n\
         # [work_offsets]\n# G54 = { X = 0.0, Y = 0.0, Z = 0.0 }\n\n\
         # Tools: number, shape (ball, flat, bull), sizes in mm.\n\
         # [[tool]]\n# number = 1\n# shape = \"ball\"\n# diameter = 10.0\n# length = 120.0\n\n\
         # Levels of rules: allow, info, warning or error.\n# [rules]\n# block-number-order = \"allow\"\n",
    );
    out
}
