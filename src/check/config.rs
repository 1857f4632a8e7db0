//! Settings of a check: `trunnion.toml` and what the command line adds. No file is opened here.
use crate::Severity;
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_machine::Machine;

/// Level of a rule in `trunnion.toml`: `[rules] pole-flip = "error"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RuleLevel {
    /// Not reported.
    Allow,
    /// With this severity.
    At(Severity),
}

/// `trunnion.toml` as read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Config {
    /// `machine = "NAME"` or a path relative to the file.
    pub machine: Option<String>,
    /// `dialect = "NAME"`.
    pub dialect: Option<String>,
    /// `[rules]`.
    pub rules: Vec<(String, RuleLevel)>,
    /// `[tolerances] tip = 0.02` (mm), overrides the machine's: tip, pole_cone (deg), pole_angle (deg), ...
    pub tolerances: Vec<(String, f64)>,
    /// `[[tool]]`, `[work_offsets]`.
    pub setup: Setup,
}

/// Why `trunnion.toml` cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the file.
    pub span: Option<core::ops::Range<usize>>,
}

impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ConfigError {}

impl Config {
    /// Reads the text of a `trunnion.toml`.
    pub fn parse(toml: &str) -> Result<Self, ConfigError> {
        let _ = toml;
        todo!()
    }
}

/// Everything one check needs.
#[derive(Clone)]
pub struct Settings<'a> {
    /// The dialect.
    pub dialect: &'a Dialect,
    /// The machine with tolerances applied, if any.
    pub machine: Option<&'a Machine>,
    /// Tools and offsets.
    pub setup: Setup,
    /// Rule levels, last wins (config, then command line).
    pub rules: Vec<(String, RuleLevel)>,
}
