//! `machine import`: a machine file from another program's file, and what that file does not say.
use crate::cli::{
    Done,
    args::{Global, ImportFormat},
    failure::{Failure, remark},
    load,
};
use std::path::Path;
use trunnion_files::Outputs;
use trunnion_machine::{MachineError, import_freecad, import_linuxcnc};
use trunnion_workspace::LoadError;

/// Runs `machine import`. Found: something is missing without which the file does not load.
pub(super) fn run(
    global: &Global,
    file: &Path,
    format: Option<ImportFormat>,
    output: Option<&Path>,
    set: &[String],
) -> Result<Done, Failure> {
    let text = trunnion_files::read_text(file)?;
    let mut outputs = Outputs::new();
    outputs.input(file);
    let target = output.map(|path| outputs.output("-o", path)).transpose()?;
    let extension = file
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or("")
        .to_ascii_lowercase();
    let format = match (format, extension.as_str()) {
        (Some(format), _) => format,
        (None, "ini") => ImportFormat::LinuxcncIni,
        (None, "fcm" | "json") => ImportFormat::Freecad,
        (None, _) => {
            let message = "its extension does not show its format; add --format linuxcnc-ini or --format freecad";
            return Err(Failure::file(file, message));
        }
    };
    let given = pins(set)?;
    let name = file.file_name().and_then(|name| name.to_str()).unwrap_or("machine");
    let failed = |error: MachineError| LoadError::at(file, &text, error.span.as_ref(), &error.message);
    let imported = match format {
        ImportFormat::LinuxcncIni => import_linuxcnc(name, &text, &given).map_err(failed)?,
        ImportFormat::Freecad if !given.is_empty() => {
            return Err(Failure::new("--set sets HAL pins; a FreeCAD machine has none"));
        }
        ImportFormat::Freecad => import_freecad(name, &text).map_err(failed)?,
    };
    load::put(target.as_ref(), imported.toml.as_bytes())?;
    for line in &imported.open {
        remark(global.quiet, &format!("open: {line}"));
    }
    let id = file.file_stem().and_then(|stem| stem.to_str()).unwrap_or("machine");
    match trunnion_machine::load(id, &imported.toml) {
        Ok(_) => Ok(Done::Clean),
        Err(error) => {
            remark(
                global.quiet,
                &format!("the machine file is not complete: {}", error.message),
            );
            Ok(Done::Found)
        }
    }
}

/// `--set PIN=VALUE`.
fn pins(set: &[String]) -> Result<Vec<(String, f64)>, Failure> {
    let pin = |text: &String| {
        let (pin, value) = text.split_once('=')?;
        let value: f64 = value.trim().parse().ok()?;
        value.is_finite().then(|| (pin.trim().to_owned(), value))
    };
    set.iter()
        .map(|text| {
            pin(text).ok_or_else(|| Failure::new(format!("--set {text}: write PIN=VALUE, for example nut-angle=55")))
        })
        .collect()
}
