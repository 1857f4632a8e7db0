//! `edit`: the edits that people ask for, each proved by running both programs.
use super::{
    Done,
    args::Global,
    failure::{Failure, remark},
    fix::print_diff,
    load, waiting,
};
use clap::ValueEnum;
use std::path::PathBuf;
use trunnion_convert::{Edit, Part, Positions, Shape, edit_part};
use trunnion_interp::LengthUnit;
use trunnion_syntax::{LineIndex, Program};

/// `edit`
#[derive(clap::Args)]
pub(crate) struct EditProgram {
    /// The program; `-` reads standard input.
    file: PathBuf,
    #[command(flatten)]
    asked: Asked,
    /// Edit these lines alone, counted from 1; all others do what they did. Not with --unit.
    #[arg(long, value_name = "FIRST[-LAST]", value_parser = super::args::lines::lines)]
    lines: Option<(u32, u32)>,
    /// Digits after the point of lengths that are rounded. Default: 3 in mm and 4 in inch; for --scale and --rotate as many as the program writes.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=9))]
    decimals: Option<u8>,
    /// Print a unified diff (the default).
    #[arg(long)]
    diff: bool,
    /// Replace the file safely: write a new file next to it, flush it, rename it.
    #[arg(long)]
    write: bool,
    /// With --write: keep the original as FILE.bak.
    #[arg(long, requires = "write")]
    backup: bool,
    /// Write the result to this file.
    #[arg(short, long, value_name = "FILE", conflicts_with = "write")]
    output: Option<PathBuf>,
}

/// What is asked for: one edit.
#[derive(clap::Args)]
#[group(required = true, multiple = false)]
struct Asked {
    /// Write lengths and feeds in this unit.
    #[arg(long, value_enum, value_name = "UNIT")]
    unit: Option<UnitOf>,
    /// Write positions as absolute (G90) or incremental (G91) words.
    #[arg(long, value_enum, value_name = "HOW")]
    positions: Option<PositionsOf>,
    /// Shift the path along axes, in the unit of the program: X=10,Z=-2.
    #[arg(long, value_name = "AXIS=BY,...", value_parser = shift, allow_hyphen_values = true)]
    shift: Option<[f64; 3]>,
    /// Scale the path about the zero point by one factor.
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true)]
    scale: Option<f64>,
    /// Mirror the path: turn the sign of this axis.
    #[arg(long, value_name = "AXIS", value_parser = axis)]
    mirror: Option<usize>,
    /// Turn the path about the axis of the tool through the zero point, by degrees counter-clockwise: Z=90.
    #[arg(long, value_name = "AXIS=DEG", value_parser = turn, allow_hyphen_values = true)]
    rotate: Option<(usize, f64)>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum UnitOf {
    Mm,
    Inch,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PositionsOf {
    Absolute,
    Incremental,
}

/// `X`, `Y` or `Z`.
fn axis(text: &str) -> Result<usize, String> {
    let letters = ["X", "Y", "Z"];
    let found = letters
        .iter()
        .position(|letter| text.trim().eq_ignore_ascii_case(letter));
    found.ok_or_else(|| format!("`{text}` is not X, Y or Z"))
}

fn number(text: &str) -> Result<f64, String> {
    let value = text
        .trim()
        .parse::<f64>()
        .ok()
        .filter(|value| value.is_finite() && value.abs() < 1e6);
    value.ok_or_else(|| format!("`{text}` is not a number below 1000000"))
}

/// `X=10,Z=-2`.
fn shift(text: &str) -> Result<[f64; 3], String> {
    let mut by = [None; 3];
    for part in text.split(',') {
        let (letter, value) = part
            .split_once('=')
            .ok_or_else(|| format!("`{part}` has no `=`: write X=10,Z=-2"))?;
        let place = axis(letter)?;
        if by[place].replace(number(value)?).is_some() {
            return Err(format!("{} is given twice", letter.trim()));
        }
    }
    Ok(by.map(Option::unwrap_or_default))
}

/// `Z=90`.
fn turn(text: &str) -> Result<(usize, f64), String> {
    let (letter, value) = text
        .split_once('=')
        .ok_or_else(|| format!("`{text}` has no `=`: write Z=90"))?;
    Ok((axis(letter)?, number(value)?))
}

/// The blocks of these lines.
fn part(program: &Program, (first, last): (u32, u32)) -> Result<Part, Failure> {
    let index = LineIndex::new(program.source());
    let line = |at: u32| index.line_column(program.source(), at).0;
    let within = program.blocks().filter(|block| {
        let range = block.range();
        line(range.start) <= last && line(range.end.saturating_sub(1).max(range.start)) >= first
    });
    let mut blocks = within.map(|block| block.id());
    let start = blocks.next();
    start
        .map(|start| Part {
            first: start,
            last: blocks.last().unwrap_or(start),
        })
        .ok_or_else(|| Failure::new(format!("--lines {first}-{last}: the program has no such lines")))
}

impl Asked {
    fn edit(&self) -> Edit {
        let unit = |unit| match unit {
            UnitOf::Mm => LengthUnit::Millimetre,
            UnitOf::Inch => LengthUnit::Inch,
        };
        let positions = |positions| match positions {
            PositionsOf::Absolute => Positions::Absolute,
            PositionsOf::Incremental => Positions::Incremental,
        };
        let found = [
            self.unit.map(|asked| Edit::Unit(unit(asked))),
            self.positions.map(|asked| Edit::Positions(positions(asked))),
            self.shift.map(|by| Edit::Shape(Shape::Shift(by))),
            self.scale.map(|factor| Edit::Shape(Shape::Scale(factor))),
            self.mirror.map(|axis| Edit::Shape(Shape::Mirror(axis))),
            self.rotate
                .map(|(axis, degrees)| Edit::Shape(Shape::Rotate(axis, degrees))),
        ];
        // clap asks for exactly one
        found
            .into_iter()
            .flatten()
            .next()
            .unwrap_or(Edit::Shape(Shape::Scale(1.0)))
    }
}

/// Runs `edit`. A refused edit makes the exit status 1; nothing is written then.
pub(super) fn run(global: &Global, command: &EditProgram) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.file)?;
    if load::is_stdin(&command.file) && command.write {
        return Err(Failure::new(
            "--write needs a file, because standard input cannot be replaced; use -o FILE",
        ));
    }
    if global.verbose {
        remark(false, &loaded.explanation());
    }
    let mut outputs = loaded.outputs();
    let shows_diff = command.diff || !(command.write || command.output.is_some());
    if shows_diff {
        outputs.standard("the diff");
    }
    let output = command.output.as_ref();
    let output = output.map(|path| outputs.output("-o", path)).transpose()?;
    let backup = command
        .backup
        .then(|| outputs.backup("--backup", &command.file))
        .transpose()?;
    if command.write {
        trunnion_files::sweep_beside(&command.file);
    }
    let resolved = &loaded.resolved;
    let decimals = command.decimals.map(usize::from);
    let asked = command.asked.edit();
    let part = command.lines.map(|lines| part(&loaded.program, lines)).transpose()?;
    let edited = match waiting::during(global, "editing", &command.file, || {
        edit_part(
            &loaded.program,
            resolved.dialect,
            &resolved.setup,
            asked,
            decimals,
            part,
        )
    }) {
        Ok(edited) => edited,
        Err(refused) if refused.is_nothing => {
            remark(global.quiet, &format!("{}: {}", loaded.name, refused.message));
            if let Some(target) = &output {
                target.write(loaded.program.source(), None)?;
            }
            return Ok(Done::Clean);
        }
        Err(refused) => {
            let place = refused.place;
            let place = place.map_or_else(String::new, |(line, column)| format!(":{line}:{column}"));
            remark(false, &format!("{}{place}: refused: {}", loaded.name, refused.message));
            return Ok(Done::Found);
        }
    };
    let before = loaded.program.source();
    if shows_diff {
        print_diff(&loaded.name, before, &edited.text)?;
    }
    if let Some(target) = &output {
        target.write(&edited.text, None)?;
    } else if command.write {
        if let Some(backup) = &backup {
            backup.write(before, None)?;
        }
        load::replace(&command.file, loaded.seen.as_ref(), before, &edited.text)?;
    }
    for line in std::iter::once(edited.summary()).chain(edited.notes) {
        remark(global.quiet, &format!("{}: {line}", loaded.name));
    }
    Ok(Done::Clean)
}
