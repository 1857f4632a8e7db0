//! `schema`: the JSON Schemas of what commands print and of files that people write.
use super::{Done, args::Schema, failure::Failure, out::Out};
use clap::ValueEnum;
use std::io::Write;

/// What has a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaName {
    /// `check --format json`.
    Check,
    /// `trace --format json`.
    Trace,
    /// `fix --format json`.
    Fix,
    /// `servo --format json`.
    Servo,
    /// `stats --format json`.
    Stats,
    /// `convert --format json`.
    Convert,
    /// `diff --format json`.
    Diff,
    /// `surface --format json`.
    Surface,
    /// `rules --format json`.
    Rules,
    /// `parse --format json`, with or without `--tokens`.
    Parse,
    /// The file of `fix --certificate`.
    Certificate,
    /// The file of `convert --certificate`.
    Conversion,
    /// The file of `check --write-baseline`.
    Baseline,
    /// A machine file (TOML).
    Machine,
    /// trunnion.toml.
    Settings,
}

impl SchemaName {
    fn text(self) -> &'static str {
        match self {
            Self::Check => include_str!("../../grammar/schemas/check.json"),
            Self::Trace => include_str!("../../grammar/schemas/trace.json"),
            Self::Fix => include_str!("../../grammar/schemas/fix.json"),
            Self::Servo => include_str!("../../grammar/schemas/servo.json"),
            Self::Stats => include_str!("../../grammar/schemas/stats.json"),
            Self::Convert => include_str!("../../grammar/schemas/convert.json"),
            Self::Diff => include_str!("../../grammar/schemas/diff.json"),
            Self::Surface => include_str!("../../grammar/schemas/surface.json"),
            Self::Rules => include_str!("../../grammar/schemas/rules.json"),
            Self::Parse => include_str!("../../grammar/schemas/parse.json"),
            Self::Conversion => include_str!("../../grammar/schemas/conversion.json"),
            Self::Certificate => include_str!("../../grammar/schemas/certificate.json"),
            Self::Baseline => include_str!("../../grammar/schemas/baseline.json"),
            Self::Machine => include_str!("../../grammar/schemas/machine.json"),
            Self::Settings => include_str!("../../grammar/schemas/settings.json"),
        }
    }
}

/// Prints one.
pub(super) fn run(command: &Schema) -> Result<Done, Failure> {
    let mut out = Out::standard();
    out.write_all(command.name.text().as_bytes())?;
    Ok(Done::Clean)
}
