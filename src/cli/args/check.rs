//! Arguments of `check`.
use super::super::check::CheckScope;
use clap::ValueEnum;
use std::path::PathBuf;

/// What the help of `check` ends with.
const CHECK_EXAMPLES: &str = "\
Examples:
  trunnion check part.nc --machine mill-3axis
  trunnion check programs --write-baseline baseline.json    accept what is known
  trunnion check programs --baseline baseline.json          only what is new fails
  trunnion check programs --format junit -o report.xml

Exit status: 0 nothing found at the --deny level (with --strict nothing unknown either), 1 something found,
2 not every file could be checked.";

/// `check`
#[derive(clap::Args)]
#[command(after_help = CHECK_EXAMPLES)]
pub(crate) struct Check {
    /// Files and directories; `-` reads standard input.
    #[arg(required = true)]
    pub(crate) paths: Vec<PathBuf>,
    /// Output format. Default: pretty on a terminal, otherwise short.
    #[arg(long, value_enum)]
    pub(crate) format: Option<CheckFormat>,
    /// How much is judged: the text, also the programmed motions, also the axes of the machine. Default: machine where one is named,
    /// otherwise motion.
    #[arg(long, value_enum)]
    pub(crate) scope: Option<CheckScope>,
    /// Write the result to this file instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Accept the findings of this baseline: they are counted, but do not fail. A finding that got worse is not accepted.
    #[arg(long, value_name = "FILE", help_heading = "Baseline")]
    pub(crate) baseline: Option<PathBuf>,
    /// Write all findings to this baseline and end with status 0.
    #[arg(long, value_name = "FILE", help_heading = "Baseline")]
    pub(crate) write_baseline: Option<PathBuf>,
    /// Also print how many findings each rule has.
    #[arg(long)]
    pub(crate) statistics: bool,
    /// Keep results in this folder, and skip files that did not change since.
    #[arg(long, value_name = "FOLDER", help_heading = "Repeated runs")]
    pub(crate) cache: Option<PathBuf>,
    /// Check again whenever a file changes, until interrupted.
    #[arg(long, help_heading = "Repeated runs")]
    pub(crate) watch: bool,
    /// Show at most this many findings per file, the worst ones first (0: all). By default as many as fit on a
    /// screen of 40 lines in pretty form, and 200 in short form.
    #[arg(long)]
    pub(crate) limit: Option<usize>,
}

/// Formats of `check`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    Pretty,
    Short,
    Json,
    /// SARIF 2.1.0, for code scanning.
    Sarif,
    /// JUnit XML, for test reports.
    Junit,
    /// Annotations in a GitHub workflow.
    Github,
}

impl CheckFormat {
    /// As it is written on the command line.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Pretty => "pretty",
            Self::Short => "short",
            Self::Json => "json",
            Self::Sarif => "sarif",
            Self::Junit => "junit",
            Self::Github => "github",
        }
    }
}
