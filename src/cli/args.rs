//! The arguments, as the interface says.
use super::{convert::Convert, diff::Diff, fmt::Fmt, plot::Plot, sample::Sample, stats::Stats, surface::Surface};
use clap::{ArgAction, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use trunnion_check::Severity;

/// Checks NC programs against the machine that shall run them.
#[derive(Parser)]
#[command(name = "trunnion", version, about, max_term_width = 110)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) global: Global,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Options every command takes.
#[derive(clap::Args)]
pub(crate) struct Global {
    /// The machine: the name of an embedded one (`trunnion machine list`) or a TOML file.
    #[arg(long, global = true, value_name = "NAME|FILE")]
    pub(crate) machine: Option<String>,
    /// The dialect; default: modeline comment, then trunnion.toml, then file extension and content.
    #[arg(long, global = true, value_name = "NAME")]
    pub(crate) dialect: Option<String>,
    /// Settings; default: trunnion.toml, looked for upward from the file.
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// The tool in use: shape:diameter[:corner radius] in mm, e.g. ball:10.
    #[arg(long, global = true, value_name = "SHAPE:D[:R]")]
    pub(crate) tool: Option<String>,
    /// Findings of this severity or worse make the exit status 1.
    #[arg(long, global = true, value_enum, default_value = "error")]
    pub(crate) deny: Deny,
    /// Verdicts that stayed unknown count as findings.
    #[arg(long, global = true)]
    pub(crate) strict: bool,
    /// Also say what would change its meaning on this control (a dialect's name; may be repeated).
    #[arg(long, global = true, value_name = "DIALECT", action = ArgAction::Append)]
    pub(crate) port_to: Vec<String>,
    /// Blocks that begin with `/`: run them (off) or skip them (on); default: trunnion.toml, else check judges both.
    #[arg(long, global = true, value_enum, value_name = "STATE")]
    pub(crate) block_delete: Option<Switch>,
    /// Silence a rule (may be repeated).
    #[arg(long, global = true, value_name = "RULE", action = ArgAction::Append)]
    pub(crate) allow: Vec<String>,
    /// A larger program is refused unread, megabytes: its blocks are all held in memory.
    #[arg(long, global = true, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) max_file_mb: u64,
    /// Colours.
    #[arg(long, global = true, value_enum, default_value = "auto")]
    pub(crate) color: Color,
    /// Only findings and failures, no remarks and no progress bar.
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
    /// Say more: which dialect, machine and settings were taken, and why.
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
}

/// `--block-delete`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    On,
    Off,
}

/// `--deny`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Deny {
    Error,
    Warning,
    Info,
}

impl Deny {
    /// As a severity.
    pub(crate) fn severity(self) -> Severity {
        match self {
            Self::Error => Severity::Error,
            Self::Warning => Severity::Warning,
            Self::Info => Severity::Info,
        }
    }
}

/// `--color`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Color {
    Auto,
    Always,
    Never,
}

impl Color {
    /// Whether standard output is coloured.
    pub(crate) fn on(self) -> bool {
        use std::io::IsTerminal;
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
        }
    }
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// The verdict: parse, run, kinematics, rules.
    Check(Check),
    /// What the machine will do, one row per motion.
    Trace(Trace),
    /// The canonical calls of a LinuxCNC program, listed as rs274 -g lists them.
    Canon(Canon),
    /// Propose rewrites, prove them, apply them.
    Fix(Fix),
    /// Re-check a certificate, or prove or refute that AFTER is the same tool path as BEFORE.
    Certify(Certify),
    /// APT/CL to G-code and back, dialect to dialect, machine to machine. Proved motion for motion, or refused.
    Convert(Convert),
    /// Layout only: spacing, case, indentation, block numbers. Proved not to change what the program does.
    Fmt(Fmt),
    /// Where two programs move the tool differently, not where their text differs.
    Diff(Diff),
    /// Blocks, motions, tools, distances, cycle time, extents per axis.
    Stats(Stats),
    /// The page of a rule or a rewrite.
    Explain(Explain),
    /// The list of rules and rewrites.
    Rules(Rules),
    /// Print a machine in words and numbers, or self-test it.
    Machine(Machine),
    /// Pictures of what the machine does, as SVG: joints, tool axis about the pole, deviation, path.
    Plot(Plot),
    /// How far the real path of the tool strays from a required surface.
    Surface(Surface),
    /// Test pieces with known answers, as cutter locations or programs, good or with a planted fault.
    Sample(Box<Sample>),
    /// Tokens or tree of a program.
    Parse(Parse),
    /// The language server on standard input and output.
    Lsp(Lsp),
}

/// `check`
#[derive(clap::Args)]
pub(crate) struct Check {
    /// Files and directories; `-` reads standard input.
    #[arg(required = true)]
    pub(crate) paths: Vec<PathBuf>,
    /// Default: pretty on a terminal, else short.
    #[arg(long, value_enum)]
    pub(crate) format: Option<CheckFormat>,
    /// Show at most this many findings per file in pretty and short form (0: all).
    #[arg(long, default_value_t = 200)]
    pub(crate) limit: usize,
}

/// Formats of `check`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    Pretty,
    Short,
    Json,
}

/// `trace`
#[derive(clap::Args)]
pub(crate) struct Trace {
    /// The program; `-` reads standard input.
    pub(crate) file: PathBuf,
    #[arg(long, value_enum, default_value = "csv")]
    pub(crate) format: TraceFormat,
}

/// Formats of `trace`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TraceFormat {
    Csv,
    Json,
}

/// `canon`
#[derive(clap::Args)]
pub(crate) struct Canon {
    /// The program; `-` reads standard input.
    pub(crate) file: PathBuf,
    /// INI file of the machine.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) ini: Option<PathBuf>,
    /// Tool table; default: the sample table of rs274.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) tool_table: Option<PathBuf>,
    /// Parameter file: read at the start, written back at the end.
    #[arg(long, value_name = "FILE")]
    pub(crate) parameters: Option<PathBuf>,
    /// Decimals of each number behind those that rs274 lists.
    #[arg(long, value_name = "N", default_value_t = 0, hide = true)]
    pub(crate) more_decimals: u8,
}

/// `fix`
#[derive(clap::Args)]
pub(crate) struct Fix {
    /// The program.
    pub(crate) file: PathBuf,
    /// Only these rewrites (default: all that cure a reported finding).
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub(crate) rewrite: Vec<String>,
    /// How far the tip (ball tools: the ball's centre) may move, mm.
    #[arg(long, value_name = "MM")]
    pub(crate) tolerance_mm: Option<f64>,
    /// How far the tool axis may turn, degrees.
    #[arg(long, value_name = "DEG")]
    pub(crate) tolerance_deg: Option<f64>,
    /// Unified diff on standard output (the default).
    #[arg(long)]
    pub(crate) diff: bool,
    /// Replace the file: written beside it, flushed, renamed.
    #[arg(long)]
    pub(crate) write: bool,
    /// With --write: keep the original as FILE.bak.
    #[arg(long, requires = "write")]
    pub(crate) backup: bool,
    /// Write the result to this file.
    #[arg(short, long, value_name = "FILE", conflicts_with = "write")]
    pub(crate) output: Option<PathBuf>,
    /// Write the certificates (JSON) to this file.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) certificate: Option<PathBuf>,
}

/// `certify`
#[derive(clap::Args)]
pub(crate) struct Certify {
    /// The program before.
    pub(crate) before: PathBuf,
    /// The program after.
    pub(crate) after: PathBuf,
    /// What is claimed: that all is the same, or the geometry of the tool path alone.
    #[arg(long, value_enum, default_value = "all")]
    pub(crate) claim: ClaimOf,
    /// The certificate to re-check; without it the same tool path is proved or refuted.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) certificate: Option<PathBuf>,
    /// Without certificate: how far the tip may be off, mm.
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    pub(crate) tolerance_mm: f64,
    /// Without certificate: how far the tool axis may be off, degrees.
    #[arg(long, value_name = "DEG", default_value_t = 0.001)]
    pub(crate) tolerance_deg: f64,
}

/// What `certify` and `diff` compare.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ClaimOf {
    /// Path, feed, spindle, tool, offsets, coolant, stops, outputs and stored data.
    All,
    /// The geometry of the tool path.
    Path,
}

/// `explain`
#[derive(clap::Args)]
pub(crate) struct Explain {
    /// Name of a rule or rewrite.
    pub(crate) name: String,
}

/// `rules`
#[derive(clap::Args)]
pub(crate) struct Rules {
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: ListFormat,
}

/// Text for people or JSON for programs.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ListFormat {
    Text,
    Json,
}

/// `machine`
#[derive(clap::Args)]
pub(crate) struct Machine {
    #[command(subcommand)]
    pub(crate) command: MachineCommand,
}

#[derive(Subcommand)]
pub(crate) enum MachineCommand {
    /// Names of the embedded machines.
    List,
    /// Chain, signs and limits in words and numbers.
    Show {
        /// Embedded machine or TOML file.
        name: String,
    },
    /// Proves that forward kinematics after inverse is the identity on random poses, and says how well.
    Check {
        /// Embedded machine or TOML file.
        name: String,
        /// How many random poses.
        #[arg(long, default_value_t = 10_000)]
        poses: usize,
    },
    /// Where the tip goes when a control believes one machine file and another one is the truth: with a program, on its path; without,
    /// with the tip held still while the rotary axes sweep, and on random poses.
    Compare {
        /// The machine that the control believes in: embedded or TOML file.
        believed: String,
        /// The machine as it is, for instance as it was measured: embedded or TOML file.
        truth: String,
        /// A program to run on both.
        program: Option<PathBuf>,
        /// Differences of the tip up to this are not told as a finding, mm.
        #[arg(long, default_value_t = 0.02, value_name = "MM")]
        tolerance_mm: f64,
        /// Tool length of the sweep, mm.
        #[arg(long, default_value_t = 100.0, value_name = "MM")]
        tool_length: f64,
        /// Where the sweep holds the tip, part frame, mm.
        #[arg(long, default_value = "0,0,0", value_name = "X,Y,Z", allow_hyphen_values = true)]
        tip: String,
    },
    /// Writes a machine file from a LinuxCNC INI file or a FreeCAD machine (.fcm), and lists what they do not say.
    Import {
        /// The file to read.
        file: PathBuf,
        /// What it is (default: by its extension).
        #[arg(long, value_enum)]
        format: Option<ImportFormat>,
        /// Where to write the machine file (default: standard output).
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
        /// A value that the INI leaves to HAL files or panels, for instance nut-angle=55; may be repeated.
        #[arg(long, value_name = "PIN=VALUE")]
        set: Vec<String>,
    },
}

/// What `machine import` reads.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ImportFormat {
    /// LinuxCNC INI with its kinematics module and HALCMD lines.
    LinuxcncIni,
    /// Machine of FreeCAD's CAM workbench (.fcm, JSON).
    Freecad,
}

/// `parse`
#[derive(clap::Args)]
pub(crate) struct Parse {
    /// The program; `-` reads standard input.
    pub(crate) file: PathBuf,
    /// Tokens, one per line: offset, kind, text (default: the tree of blocks and words).
    #[arg(long)]
    pub(crate) tokens: bool,
    /// The tree of blocks and words (the default).
    #[arg(long, conflicts_with = "tokens")]
    pub(crate) tree: bool,
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: ListFormat,
}

/// `lsp`
#[derive(clap::Args)]
pub(crate) struct Lsp {
    /// Accepted for editors that pass it; standard input and output are the only transport.
    #[arg(long, hide = true)]
    pub(crate) stdio: bool,
}
