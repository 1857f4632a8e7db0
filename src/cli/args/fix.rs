//! The arguments of `fix`.
use super::ListFormat;
use std::path::PathBuf;

/// `fix`
#[derive(clap::Args)]
pub(crate) struct Fix {
    /// The program.
    pub(crate) file: PathBuf,
    /// Use only these rewrites (`all`: every one). Default: all that fix a reported finding.
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub(crate) rewrite: Vec<String>,
    /// Change only what touches these lines of the program. A rewrite of the whole program is applied whole or not at all.
    #[arg(long, value_name = "FIRST[-LAST]", value_parser = super::lines::lines)]
    pub(crate) lines: Option<(u32, u32)>,
    /// How far the tip (for ball tools: the centre of the ball) may move, in mm.
    #[arg(long, value_name = "MM")]
    pub(crate) tolerance_mm: Option<f64>,
    /// How far the tool axis may turn, in degrees.
    #[arg(long, value_name = "DEG")]
    pub(crate) tolerance_deg: Option<f64>,
    /// switch-angles: what to minimise when choosing postures for the whole program. Default: `cost` of [fix] in trunnion.toml, else travel.
    #[arg(long, value_enum)]
    pub(crate) cost: Option<crate::cli::fix::CostOf>,
    /// fit-arcs, fit-splines: whether the new path must stay near the whole programmed lines or only near their ends. Default: `source` of [fix] in trunnion.toml, else
    /// chords.
    #[arg(long, value_enum)]
    pub(crate) source: Option<crate::cli::fix::SourceOf>,
    /// smooth-pole: which point of a ball the programmed X Y Z are. Default: `point` of [fix] in trunnion.toml, else its tip.
    #[arg(long, value_enum)]
    pub(crate) point: Option<crate::cli::fix::PointOf>,
    /// adapt-feed: make cuts that are slower than this as fast as the axes allow, up to this, in mm/min. Plunges too: see --lines. Default:
    /// `feed_mm_min` of [fix] in trunnion.toml, else no cut is made faster.
    #[arg(long, value_name = "MM_MIN")]
    pub(crate) feed: Option<f64>,
    #[command(flatten, next_help_heading = "Target of retarget")]
    pub(crate) target: crate::cli::convert::TargetArgs,
    /// What to print: a unified diff (text), or the result and the gain at every place (json).
    #[arg(long, value_enum, default_value = "text", conflicts_with = "diff")]
    pub(crate) format: ListFormat,
    /// Print a unified diff (the default).
    #[arg(long)]
    pub(crate) diff: bool,
    /// Replace the file safely: write a new file next to it, flush it, rename it.
    #[arg(long)]
    pub(crate) write: bool,
    /// With --write: keep the original as FILE.bak.
    #[arg(long, requires = "write")]
    pub(crate) backup: bool,
    /// Write the result to this file.
    #[arg(short, long, value_name = "FILE", conflicts_with = "write")]
    pub(crate) output: Option<PathBuf>,
    /// Write the certificate (JSON) to this file; several rewrites make a chain of certificates.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) certificate: Option<PathBuf>,
}
