//! `convert`: APT/CL to G-code and back, dialect to dialect, machine to machine.
use super::{
    Done,
    args::{Global, ListFormat},
    failure::{Failure, remark},
    load::{self, Loaded},
    waiting,
};
use clap::ValueEnum;
use std::path::PathBuf;
use trunnion_certify::Outcome;
use trunnion_certify::conversion::{Assume, Conversion, certify_conversion};
use trunnion_convert::{Converted, Options, OrientationWords, Source, Units, convert};
use trunnion_machine::Machine;

mod show;
mod target;
use show::document;
pub(crate) use show::summary;
pub(crate) use target::{Chosen, TargetArgs};

/// `convert`
#[derive(clap::Args)]
pub(crate) struct Convert {
    /// The program; `-` reads standard input.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    target: TargetArgs,
    /// Write the tool orientation as rotary words or as tool vectors.
    #[arg(long, value_enum, default_value = "words")]
    orientation: OrientationChoice,
    /// Write without tool centre point control: axis positions, with cuts linearised where rotary axes move.
    #[arg(long)]
    no_tcp: bool,
    /// How far the tip may deviate from the original inside a cut, in mm. Default: the tolerance of the machine.
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    tolerance_mm: Option<f64>,
    /// How far the tool axis may deviate from the original inside a cut, in degrees. Default: 0.5
    #[arg(long, value_name = "DEG")]
    tolerance_deg: Option<f64>,
    /// Allow cuts to change to the other posture or to wind back; each place is reported.
    #[arg(long)]
    allow_swap: bool,
    /// The units of the output.
    #[arg(long, value_enum, default_value = "mm")]
    units: UnitsChoice,
    /// Write arcs as lines.
    #[arg(long)]
    lines_only: bool,
    /// APT: treat INSERT records as remarks.
    #[arg(long)]
    insert_is_remark: bool,
    /// Leave these codes out, for example M10 (may be repeated).
    #[arg(long, value_delimiter = ',', value_name = "CODE")]
    drop: Vec<String>,
    /// For an excerpt: tool centre point control is on at its start.
    #[arg(long)]
    assume_tcp: bool,
    /// For an excerpt: the feed at its start, in mm/min.
    #[arg(long, value_name = "MM_MIN", allow_negative_numbers = true)]
    feed: Option<f64>,
    /// The name of the output program. Default: the name of the input program.
    #[arg(long, value_name = "TEXT")]
    name: Option<String>,
    /// The number of the output program (Fanuc, Haas: O).
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=99_999_999))]
    program_number: u32,
    /// The work offset, if the program names none, or names it as another kind of control does. Default: that of the post, G54, or G15 H1 on an Okuma.
    #[arg(long, value_name = "CODE")]
    work_offset: Option<String>,
    /// Write the program to this file. Default: standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the certificate (JSON) to this file: `certify BEFORE AFTER --certificate FILE.json` checks it again.
    #[arg(long, value_name = "FILE.json", conflicts_with = "insert_is_remark")]
    certificate: Option<PathBuf>,
    /// On standard output: the program, or one JSON document with program and proof. `-o` writes the program in both cases.
    #[arg(long, value_enum, default_value = "text")]
    format: ListFormat,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OrientationChoice {
    Words,
    Vectors,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum UnitsChoice {
    Mm,
    Inch,
}

/// Runs `convert`. A refused conversion makes the exit status 1; nothing is written then.
pub(super) fn run(global: &Global, command: &Convert) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.file)?;
    if global.verbose {
        remark(false, &loaded.explanation());
    }
    let mut outputs = loaded.outputs();
    command.target.files().for_each(|file| outputs.input(file));
    match command.format {
        ListFormat::Json => outputs.standard("the JSON document"),
        ListFormat::Text if command.output.is_none() => outputs.standard("the program"),
        ListFormat::Text => {}
    }
    let output = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    let certificate = command
        .certificate
        .as_ref()
        .map(|path| outputs.output("--certificate", path))
        .transpose()?;
    let chosen = command.target.choose(&loaded)?;
    let (target, target_machine) = (chosen.target(), chosen.machine.as_ref());
    let source = Source {
        text: loaded.program.source(),
        dialect: loaded.resolved.dialect,
        machine: loaded.resolved.machine.as_ref(),
        setup: &loaded.resolved.setup,
        assume: Assume {
            tcp: command.assume_tcp,
            feed_mm_min: command.feed,
        },
    };
    let options = options(command)?;
    let converted = match waiting::during(global, "converting", &command.file, || {
        convert(&source, &target, &options)
    }) {
        Ok(converted) => converted,
        Err(refused) => {
            let place = refused
                .place
                .map_or_else(String::new, |(line, column)| format!(":{line}:{column}"));
            remark(false, &format!("{}{place}: refused: {}", loaded.name, refused.message));
            return Ok(Done::Found);
        }
    };
    let certified = certificate
        .is_some()
        .then(|| certified(&loaded, loaded.program.source(), target_machine, &converted))
        .transpose()?;
    if output.is_some() || command.format == ListFormat::Text {
        load::put(output.as_ref(), converted.text.as_bytes())?;
    }
    if command.format == ListFormat::Json {
        load::put(None, document(&loaded, target_machine, &converted).as_bytes())?;
    }
    // after the program: a certificate next to an old program names the digest that does not fit
    if let (Some(target), Some(json)) = (&certificate, certified) {
        target.write(json.as_bytes(), None)?;
    }
    for line in summary(&loaded.name, &converted) {
        remark(global.quiet, &line);
    }
    if let Some(line) = load::assuming(&[&loaded]) {
        remark(global.quiet, &format!("{}: {line}", loaded.name));
    }
    Ok(Done::Clean)
}

/// The certificate: both texts are read again, and the proof is made again without the converter.
pub(super) fn certified(
    loaded: &Loaded,
    before: &[u8],
    target: Option<&Machine>,
    converted: &Converted,
) -> Result<String, Failure> {
    let is_apt = converted.dialect.lex.format == trunnion_syntax::Format::Apt;
    let conversion = Conversion {
        texts: [before, converted.text.as_bytes()],
        dialects: [loaded.resolved.dialect, converted.dialect],
        // CL data are for no machine
        machines: [loaded.resolved.machine.as_ref(), target.filter(|_| !is_apt)],
        setup: &loaded.resolved.setup,
    };
    certify_conversion(&conversion, &converted.told, &converted.claim)
        .map(|certificate| certificate.to_json())
        .map_err(|outcome| match outcome {
            Outcome::Refuted(witness) => Failure::new(format!("the conversion is not certified: {witness}")),
            Outcome::Unknown(gap) => Failure::new(format!("the conversion is not certified: {gap}")),
            Outcome::Proved(_) => Failure::new("the conversion is not certified"),
        })
}

fn options(command: &Convert) -> Result<Options, Failure> {
    for (name, value) in [
        ("--tolerance-mm", command.tolerance_mm),
        ("--tolerance-deg", command.tolerance_deg),
        ("--feed", command.feed),
    ] {
        if value.is_some_and(|value| !(value.is_finite() && value > 0.0)) {
            return Err(Failure::new(format!("{name} must be a positive number")));
        }
    }
    Ok(Options {
        units: match command.units {
            UnitsChoice::Mm => Units::Mm,
            UnitsChoice::Inch => Units::Inch,
        },
        orientation: match command.orientation {
            OrientationChoice::Words => OrientationWords::Rotary,
            OrientationChoice::Vectors => OrientationWords::Vectors,
        },
        tcp: !command.no_tcp,
        tolerance_mm: command.tolerance_mm,
        tolerance_deg: command.tolerance_deg,
        allow_swap: command.allow_swap,
        insert_is_remark: command.insert_is_remark,
        drop: command.drop.clone(),
        lines_only: command.lines_only,
        program_name: command.name.clone(),
        program_number: command.program_number,
        work_offset: command.work_offset.clone(),
    })
}
