//! Arguments of the commands that help people to begin.
use super::super::schema::SchemaName;
use std::path::PathBuf;

/// `report`
#[derive(clap::Args)]
pub(crate) struct Report {
    /// Files and directories; `-` reads standard input.
    #[arg(required = true)]
    pub(crate) paths: Vec<PathBuf>,
    /// The page to write. A folder (`-o reports/`): a page for each program, and index.html with all verdicts.
    #[arg(short, long, value_name = "FILE|FOLDER/")]
    pub(crate) output: PathBuf,
}

/// `init`
#[derive(clap::Args)]
pub(crate) struct Init {
    /// The folder of the programs. Default: the current one.
    pub(crate) folder: Option<PathBuf>,
}

/// `schema`
#[derive(clap::Args)]
pub(crate) struct Schema {
    /// Which schema.
    #[arg(value_enum)]
    pub(crate) name: SchemaName,
}

/// `completions`
#[derive(clap::Args)]
pub(crate) struct Completions {
    /// The shell.
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}
