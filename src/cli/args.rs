//! The command line arguments; docs/commands.md lists the commands.
mod bounds;
mod check;
mod fix;
pub(crate) mod lines;
mod people;

pub(crate) use check::{Check, CheckFormat};
pub(crate) use fix::Fix;
pub(crate) use people::{Completions, Init, Report, Schema};

use super::{
    convert::Convert, diff::Diff, edit::EditProgram, fmt::Fmt, plot::Plot, sample::Sample, servo::Servo, stats::Stats,
    surface::Surface,
};
use clap::{ArgAction, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use trunnion_check::Severity;

/// What the help ends with.
const EXAMPLES: &str = "\
Examples:
  trunnion init --machine mill-3axis            settings for the programs of this folder
  trunnion check part.nc                        the verdict on a program
  trunnion check . --format sarif -o out.sarif  a gate in CI
  trunnion report part.nc -o part.html          one page for people

Exit status: 0 nothing found at the --deny level, 1 something found, 2 the job could not be done.";

/// Checks NC programs against the machine that will run them.
#[derive(Parser)]
#[command(name = "trunnion", version, about, max_term_width = 110, after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) global: Global,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Options every command takes.
#[derive(clap::Args)]
#[command(next_help_heading = "Options of all commands")]
pub(crate) struct Global {
    /// The machine: the name of a built-in one (`trunnion machine list`) or a TOML file.
    #[arg(long, global = true, value_name = "NAME|FILE")]
    pub(crate) machine: Option<String>,
    /// The dialect of the program. Default: its modeline comment, then trunnion.toml, then typical words in its text, then a file extension
    /// that only one control uses, then the control of the machine.
    #[arg(long, global = true, value_name = "NAME")]
    pub(crate) dialect: Option<String>,
    /// The settings file. Default: trunnion.toml in the folder of the program or the nearest folder above it.
    #[arg(long, global = true, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// The tool in use: shape:diameter[:corner radius] in mm, for example ball:10.
    #[arg(long, global = true, value_name = "SHAPE:D[:R]")]
    pub(crate) tool: Option<String>,
    /// Exit with status 1 if there is a finding of this severity or worse.
    #[arg(long, global = true, value_enum, default_value = "error")]
    pub(crate) deny: Deny,
    /// Treat unknown verdicts as findings.
    #[arg(long, global = true)]
    pub(crate) strict: bool,
    /// Also report words that mean something else on this control (name of a dialect; may be repeated).
    #[arg(long, global = true, value_name = "DIALECT", action = ArgAction::Append)]
    pub(crate) port_to: Vec<String>,
    /// Treat undeclared work offsets and tool lengths as zero (work-offset, tool-length); take the usual state at power-on (power-on). Separate
    /// several with commas. The verdict lists what was assumed.
    #[arg(long, global = true, value_name = "WHAT", value_delimiter = ',')]
    pub(crate) assume: Vec<String>,
    /// Blocks that begin with `/`: run them (off) or skip them (on). Default: trunnion.toml; without it, check judges both.
    #[arg(long, global = true, value_enum, value_name = "STATE")]
    pub(crate) block_delete: Option<Switch>,
    /// Silence a rule (may be repeated).
    #[arg(long, global = true, value_name = "RULE", action = ArgAction::Append)]
    pub(crate) allow: Vec<String>,
    /// Refuse to read a program larger than this, in megabytes (all its blocks are kept in memory). Default: 64; diff, certify, machine, plot, stats:
    /// 32; fmt, fix, edit, report: 16.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) max_file_mb: Option<u64>,
    /// Refuse to read a program of more lines, empty ones included. Default: 1050000; trace, parse: 600000; fmt: 300000; diff, certify, machine, plot,
    /// stats: 250000; fix, edit: 200000; report: 100000.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) max_lines: Option<u64>,
    /// Stop a run that is compared, proved, converted, listed or drawn after this many executed blocks, in addition to one run of each block of the text.
    /// Default: `steps` of [limits] in trunnion.toml, else 150000.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) max_steps: Option<u64>,
    /// When to use colours.
    #[arg(long, global = true, value_enum, default_value = "auto")]
    pub(crate) color: Color,
    /// Print only findings and failures, no remarks and no progress bar.
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
    /// Print more: which dialect, machine and settings are used, and why.
    #[arg(short, long, global = true)]
    pub(crate) verbose: bool,
    /// Where the run of a long program is; watched where a terminal shows it.
    #[arg(skip)]
    pub(crate) progress: trunnion_interp::Progress,
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
    /// Check programs: syntax, motion and kinematics, with all rules.
    Check(Check),
    /// Print what the machine will do, one row per motion.
    Trace(Trace),
    /// Print the canonical calls of a LinuxCNC program in the format of rs274 -g.
    Canon(Canon),
    /// Propose rewrites, prove them, apply them.
    Fix(Fix),
    /// Re-check a certificate, or prove or refute that AFTER is the same tool path as BEFORE.
    Certify(Certify),
    /// Convert APT/CL to G-code, Klartext or Okuma OSP and back, or between dialects and machines. The result is proved motion by motion, or
    /// refused.
    Convert(Convert),
    /// Change the unit, absolute or incremental words, or shift, scale, mirror or turn the path. Proved motion by motion, or refused.
    Edit(EditProgram),
    /// Format the layout: spacing, case, indentation, block numbers. Proved not to change what the program does.
    Fmt(Fmt),
    /// Show where two programs move the tool differently, not where their text differs.
    Diff(Diff),
    /// Print blocks, motions, tools, distances, cycle time and extents per axis.
    Stats(Stats),
    /// Print the page of a rule or a rewrite.
    Explain(Explain),
    /// List all rules and rewrites.
    Rules(Rules),
    /// Print, test, compare or import a machine.
    Machine(Machine),
    /// Draw what the machine does, as SVG: axis positions, tool axis around the pole, deviation, feed, path, rapids past obstacles, a corner as
    /// the servo loops run it.
    Plot(Plot),
    /// Measure how far the real tool path deviates from a required surface.
    Surface(Surface),
    /// Say how far the servo loops cut a corner of a program: closed form, simulated, with and without a corner controller.
    Servo(Servo),
    /// Write test pieces with known answers, as cutter locations or programs, correct or with a deliberate fault.
    Sample(Box<Sample>),
    /// Print the tokens or the tree of a program.
    Parse(Parse),
    /// Write one self-contained HTML page about programs: verdict, findings, pictures, a replay in 3D, and a set-up sheet.
    Report(Report),
    /// Write a settings file for the programs of a folder.
    Init(Init),
    /// Print the JSON Schema of what a command prints or of a file.
    Schema(Schema),
    /// Print the completions for a shell.
    Completions(Completions),
    /// Print the manual page.
    Man,
    /// Run the language server on standard input and output.
    Lsp(Lsp),
}

/// `trace`
#[derive(clap::Args)]
pub(crate) struct Trace {
    /// The program; `-` reads standard input.
    pub(crate) file: PathBuf,
    #[arg(long, value_enum, default_value = "csv")]
    pub(crate) format: TraceFormat,
    /// Where to write. Default: standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
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
    /// The INI file of the machine.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) ini: Option<PathBuf>,
    /// The tool table. Default: the sample table of rs274.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) tool_table: Option<PathBuf>,
    /// The parameter file: read at the start, written back at the end.
    #[arg(long, value_name = "FILE")]
    pub(crate) parameters: Option<PathBuf>,
    /// Additional decimals of each number after those that rs274 prints.
    #[arg(long, value_name = "N", default_value_t = 0, hide = true)]
    pub(crate) more_decimals: u8,
    /// Where to write. Default: standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

/// `certify`
#[derive(clap::Args)]
pub(crate) struct Certify {
    /// The original program.
    pub(crate) before: PathBuf,
    /// The changed program.
    pub(crate) after: PathBuf,
    /// What is claimed: that all is the same, or the geometry of the tool path alone.
    #[arg(long, value_enum, default_value = "all")]
    pub(crate) claim: ClaimOf,
    /// The certificate to re-check, of `fix` or of `convert`; without it the same tool path is proved or refuted.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) certificate: Option<PathBuf>,
    /// For a certificate of `convert`: the machine that AFTER is for. Default: --machine.
    #[arg(long, value_name = "NAME|FILE", requires = "certificate")]
    pub(crate) to_machine: Option<String>,
    /// Without a certificate: how far the tip may be off, in mm.
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    pub(crate) tolerance_mm: f64,
    /// Without a certificate: how far the tool axis may be off, in degrees.
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
    /// The name of a rule or rewrite.
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
    /// List the built-in machines.
    List,
    /// Print the chain of axes, signs and limits in words and numbers.
    Show {
        /// The name of a built-in machine, or a TOML file.
        name: String,
        /// In words, or as the machine file itself: a start for your own.
        #[arg(long, value_enum, default_value = "text")]
        format: ShowFormat,
    },
    /// Test the kinematics: on random poses, forward after inverse kinematics must return the same pose.
    Check {
        /// The name of a built-in machine, or a TOML file.
        name: String,
        /// The number of random poses.
        #[arg(long, default_value_t = 10_000)]
        poses: usize,
    },
    /// Compare two machine files: how far the tip is off if the control assumes one and the other is true. With a program, along its path;
    /// without one, with the tip held still while the rotary axes sweep, and on random poses.
    Compare {
        /// The machine that the control assumes: the name of a built-in one, or a TOML file.
        #[arg(value_name = "ASSUMED")]
        believed: String,
        /// The machine as it really is, for example as measured: the name of a built-in one, or a TOML file.
        #[arg(value_name = "TRUE")]
        truth: String,
        /// A program to run on both machines.
        program: Option<PathBuf>,
        /// Tip differences up to this are not a finding, in mm.
        #[arg(long, default_value_t = 0.02, value_name = "MM")]
        tolerance_mm: f64,
        /// Tool length for the sweep, in mm.
        #[arg(long, default_value_t = 100.0, value_name = "MM")]
        tool_length: f64,
        /// The tip position during the sweep, in the part frame, in mm.
        #[arg(long, default_value = "0,0,0", value_name = "X,Y,Z", allow_hyphen_values = true)]
        tip: String,
    },
    /// Write a machine file from a LinuxCNC INI file or a FreeCAD machine (.fcm), and list what is missing there.
    Import {
        /// The file to import.
        file: PathBuf,
        /// Its format. Default: by its extension.
        #[arg(long, value_enum)]
        format: Option<ImportFormat>,
        /// Where to write the machine file. Default: standard output.
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
        /// A value that the INI file leaves to HAL files or panels, for example nut-angle=55 (may be repeated).
        #[arg(long, value_name = "PIN=VALUE")]
        set: Vec<String>,
    },
}

/// Formats of `machine show`.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShowFormat {
    Text,
    Toml,
}

/// What `machine import` reads.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ImportFormat {
    /// A LinuxCNC INI file with its kinematics module and HALCMD lines.
    LinuxcncIni,
    /// A machine of FreeCAD's CAM workbench (.fcm, JSON).
    Freecad,
}

/// `parse`
#[derive(clap::Args)]
pub(crate) struct Parse {
    /// The program; `-` reads standard input.
    pub(crate) file: PathBuf,
    /// Print tokens, one per line: offset, kind, text. Default: the tree of blocks and words.
    #[arg(long)]
    pub(crate) tokens: bool,
    /// Print the tree of blocks and words (the default).
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
