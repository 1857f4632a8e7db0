//! `surface`: how far the real path of the tool deviates from a required surface.
use super::{
    Done,
    args::{Global, ListFormat},
    failure::{Failure, remark},
    json::write_json,
    legs::each_leg,
    load::{self, Loaded},
    plot, waiting,
};
use crate::cli::out::Out;
use serde_json::{Value, json};
use std::{
    fmt::Write as _,
    io::Write,
    path::{Path, PathBuf},
};
use trunnion_machine::Machine;
use trunnion_plot::{Unit, height_map};
use trunnion_surface::{Errors, Found, Judge, MOST_LOOKS, Options, Required, required, required_stl};
use trunnion_syntax::{BlockId, LineIndex};

/// `surface`
#[derive(clap::Args)]
pub(crate) struct Surface {
    /// The program; `-` reads standard input.
    file: PathBuf,
    /// The required surface: TOML or JSON with grids of points and Bezier patches, or an STL; mm, in programmed coordinates.
    #[arg(long, value_name = "FILE.toml|.json|.stl")]
    required: PathBuf,
    /// The distance that the tip keeps from the surface, for a ball centre or a flank, in mm.
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    offset: f64,
    /// Feed blocks that start or end farther than this from the surface are taken as approach or retract, in mm.
    #[arg(long, value_name = "MM", default_value_t = 1.0)]
    reach: f64,
    /// Judge only the blocks of these lines, for example 100-250.
    #[arg(long, value_name = "FIRST[-LAST]", value_parser = super::args::lines::lines)]
    lines: Option<(u32, u32)>,
    /// Exit with status 1 if an error is larger than this, in mm.
    #[arg(long, value_name = "MM")]
    tolerance: Option<f64>,
    /// How close the proven bound must be to the largest error found, in mm.
    #[arg(long, value_name = "MM", default_value_t = 0.001)]
    close: f64,
    #[arg(long, value_enum, default_value = "text")]
    format: ListFormat,
    /// Also draw the error as a map, with the real path (SVG).
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

/// Samples of a block for a map.
const SPOTS: usize = 24;

/// Runs `surface`.
pub(super) fn run(global: &Global, command: &Surface) -> Result<Done, Failure> {
    for (name, value, least) in [
        ("offset", command.offset, 0.0),
        ("close", command.close, 1e-6),
        ("reach", command.reach, 0.0),
    ] {
        if !(value >= least && value <= 1000.0) {
            return Err(Failure::new(format!(
                "--{name} {value}: must be between {least} and 1000 mm"
            )));
        }
    }
    let loaded = load::load_for_steps(global, &command.file)?;
    let machine = loaded.machine_or_fail("surface")?;
    let mut outputs = loaded.outputs();
    outputs.input(&command.required);
    let picture = command
        .plot
        .as_ref()
        .map(|path| outputs.output("--plot", path))
        .transpose()?;
    let surface = read(&command.required, command.close)?;
    let lines = LineIndex::new(loaded.program.source());
    let (errors, unit) = waiting::during(global, "measuring", &command.file, || {
        judge(command, &loaded, machine, &surface, &lines)
    })?;
    if errors.judged == 0 {
        return Err(Failure::file(&command.file, nothing(command, &errors)));
    }
    let report = Report {
        command,
        loaded: &loaded,
        machine,
        surface: &surface,
        errors: &errors,
        lines: &lines,
    };
    let mut out = Out::standard();
    match command.format {
        ListFormat::Text => out.text(&report.text()),
        ListFormat::Json => write_json(&mut out, &report.json())?,
    }
    out.flush()?;
    if let Some(file) = &picture {
        let header = plot::header("Error of the trajectory surface", &loaded, machine);
        let text = height_map(&header, &errors, flattest(&surface), unit)
            .map_err(|error| Failure::file(&command.file, error))?;
        file.write(text.as_bytes(), None)?;
    }
    Ok(verdict(global, command, &errors))
}

/// Why nothing was compared.
fn nothing(command: &Surface, errors: &Errors) -> String {
    if errors.given_up > 0 {
        return format!("nothing could be compared: {}", beyond());
    }
    if errors.apart > 0 {
        return format!(
            "all {} feed blocks start or end farther than {} mm from the surface (up to {:.3} mm): check that both are in the same frame; \
             --reach MM raises this distance, --offset MM is for a tool that does not run on the surface itself",
            errors.apart, command.reach, errors.farthest_apart
        );
    }
    "no feed motion's path is known, so nothing can be compared".to_owned()
}

/// Why blocks are not judged although their paths are known, and what to do.
fn beyond() -> String {
    format!(
        "{MOST_LOOKS} boxes about triangles of the surface may be looked at for all blocks together, and there are more; --lines FIRST-LAST judges a part of the \
         program, and a surface without long, thin triangles takes less"
    )
}

/// With a tolerance: above it is found; between it and the bound, or with blocks that are not judged, it is unknown.
fn verdict(global: &Global, command: &Surface, errors: &Errors) -> Done {
    let (Some(tolerance), Some(found)) = (command.tolerance, &errors.from_surface) else {
        return Done::Clean;
    };
    if found.sampled > tolerance {
        return Done::Found;
    }
    if found.bound > tolerance || errors.not_judged > 0 || errors.given_up > 0 || errors.apart > 0 {
        let why = if errors.given_up > 0 {
            format!("{} feed blocks are not judged: {}", errors.given_up, beyond())
        } else if errors.not_judged > 0 {
            "the path of some feed blocks is unknown".to_owned()
        } else if errors.apart > 0 {
            format!(
                "{} feed blocks start or end off the surface; --lines FIRST-LAST leaves them out",
                errors.apart
            )
        } else if errors.first_loose.is_some() {
            format!(
                "it is not proven that the error stays within the tolerance: {}",
                beyond()
            )
        } else {
            "it is not proven that the error stays within the tolerance; --close 0.0001 computes a tighter bound"
                .to_owned()
        };
        remark(global.quiet, &format!("unknown: {why}"));
        return if global.strict { Done::Found } else { Done::Clean };
    }
    Done::Clean
}

/// Largest file of grids and patches: reading one takes up to 60 times as much memory.
const MOST_GRIDS_MIB: usize = 16;

fn read(path: &Path, close: f64) -> Result<Required, Failure> {
    let kind = path
        .extension()
        .map(|e| e.to_string_lossy().to_ascii_lowercase())
        .unwrap_or_default();
    if !["toml", "json", "stl"].contains(&kind.as_str()) {
        return Err(Failure::file(
            path,
            "--required takes the surface that the part must have: grids and patches in a file that ends in .toml or .json, or an STL that ends in \
             .stl; a program has no such surface",
        ));
    }
    let bytes = load::read(path)?;
    if kind != "stl" && bytes.len() > MOST_GRIDS_MIB << 20 {
        let what =
            format!("is larger than {MOST_GRIDS_MIB} MiB, the most for grids and patches; give the surface as an STL");
        return Err(Failure::file(path, what));
    }
    let read = if kind == "stl" {
        required_stl(&bytes)
    } else {
        let text =
            String::from_utf8(bytes).map_err(|_| Failure::file(path, "is not UTF-8 text; an STL must end in .stl"))?;
        required(&text, kind == "json", close)
    };
    read.map_err(|error| Failure::file(path, error))
}

/// The axis of the part along which the surface shows the most of itself.
fn flattest(surface: &Required) -> usize {
    let [low, high] = surface.extent();
    let size = high - low;
    // across the smallest extent; of equal ones along Z
    (0..3).rev().min_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(2)
}

/// The errors, and the unit in which people read lengths of the program.
fn judge(
    command: &Surface,
    loaded: &Loaded,
    machine: &Machine,
    surface: &Required,
    index: &LineIndex,
) -> Result<(Errors, Unit), Failure> {
    let options = Options {
        offset: command.offset,
        reach: command.reach,
        close: command.close,
        spots: if command.plot.is_some() { SPOTS } else { 0 },
        looks: MOST_LOOKS,
    };
    let lines = command.lines;
    let mut judge = Judge::new(surface, machine, options);
    let mut inch = false;
    let given_up = each_leg(loaded, machine, index, lines, |leg, _, state| {
        inch |= state.coordinates.is_inch();
        judge.leg(leg, leg.motion.other_length(state.tool.own_length_mm()).is_none());
    });
    if let Some(why) = given_up {
        // a part of the path proves nothing about the whole
        return Err(Failure::new(why));
    }
    Ok((judge.finish(), Unit::of_inch(inch)))
}

struct Report<'a> {
    command: &'a Surface,
    loaded: &'a Loaded,
    machine: &'a Machine,
    surface: &'a Required,
    errors: &'a Errors,
    lines: &'a LineIndex,
}

impl Report<'_> {
    fn line(&self, block: BlockId) -> u32 {
        let program = &self.loaded.program;
        self.lines
            .line_column(program.source(), program.block(block).range().start)
            .0
    }

    /// The three errors by name.
    fn all(&self) -> [(&'static str, &'static str, Option<&Found>); 3] {
        let errors = self.errors;
        [
            (
                "from_surface",
                "nearest point of the surface",
                errors.from_surface.as_ref(),
            ),
            (
                "same_place",
                "point it should be at (same u, v)",
                errors.same_place.as_ref(),
            ),
            ("from_segment", "programmed segment", errors.from_segment.as_ref()),
        ]
    }

    fn kind(&self) -> &'static str {
        if self.surface.sheets().is_empty() {
            "stl"
        } else {
            "sheets"
        }
    }

    fn text(&self) -> String {
        let errors = self.errors;
        let mut text = format!(
            "{} on {}, compared with {}\n",
            self.loaded.name,
            self.machine.id,
            self.command.required.display()
        );
        let _ = writeln!(
            text,
            "  {} feed blocks judged, {} unknown; surface of {} triangles, at most {:.6} mm off",
            errors.judged,
            errors.not_judged + errors.given_up,
            self.surface.triangles(),
            self.surface.off
        );
        if let Some(block) = errors.first_apart {
            let _ = writeln!(
                text,
                "  {} feed blocks start or end up to {:.3} mm off the surface, the first at line {}: taken as approach or retract",
                errors.apart,
                errors.farthest_apart,
                self.line(block)
            );
        }
        if let Some(block) = errors.first_not_judged {
            let _ = writeln!(
                text,
                "  the path of line {} (and perhaps of others) is unknown: see `trunnion check`",
                self.line(block)
            );
        }
        if let Some(block) = errors.first_given_up {
            let _ = writeln!(
                text,
                "  {} feed blocks, the first at line {}, are not judged: {}",
                errors.given_up,
                self.line(block),
                beyond()
            );
        }
        if let Some(block) = errors.first_loose {
            let (line, why) = (self.line(block), beyond());
            let _ = writeln!(text, "  from line {line} on the bounds are loose: {why}");
        }
        text.push_str("  largest distance of the tip from the\n");
        for (_, name, found) in self.all() {
            let Some(found) = found else {
                let _ = writeln!(
                    text,
                    "    {name:34} unknown: the path is not on one sheet of the surface"
                );
                continue;
            };
            let side = match found.side {
                1 => ", on the spindle's side (material left)",
                -1 => ", beyond the surface (gouge)",
                _ => "",
            };
            let _ = writeln!(
                text,
                "    {name:34} {:.4} mm (proven below {:.4}) at line {}, {:.1} % of the block, X {:.3} Y {:.3} Z {:.3}{side}",
                found.sampled,
                above(found.bound),
                self.line(found.block),
                100.0 * found.at,
                found.point.x,
                found.point.y,
                found.point.z
            );
        }
        if errors.placed < errors.judged && errors.placed > 0 {
            let _ = writeln!(
                text,
                "  only {} of the blocks have both ends on the surface",
                errors.placed
            );
        }
        text
    }

    fn json(&self) -> Value {
        let errors = self.errors;
        let one = |found: Option<&Found>| {
            found.map_or(Value::Null, |found| {
                json!({
                    "sampled_mm": found.sampled,
                    "bound_mm": found.bound,
                    "line": self.line(found.block),
                    "share": found.at,
                    "point_mm": [found.point.x, found.point.y, found.point.z],
                    "side": match found.side { 1 => "material-left", -1 => "gouge", _ => "none" },
                })
            })
        };
        let all: serde_json::Map<String, Value> = self
            .all()
            .into_iter()
            .map(|(key, _, found)| (key.to_owned(), one(found)))
            .collect();
        json!({
            "schema": "trunnion-surface-error/1",
            "version": env!("CARGO_PKG_VERSION"),
            "path": self.loaded.name,
            "machine": self.machine.id,
            "required": { "path": self.command.required.display().to_string(), "kind": self.kind(),
                          "triangles": self.surface.triangles(), "off_mm": self.surface.off },
            "offset_mm": self.command.offset,
            "judged": errors.judged,
            "not_judged": errors.not_judged + errors.given_up,
            "given_up": errors.given_up,
            "apart": errors.apart,
            "farthest_apart_mm": errors.farthest_apart,
            "on_surface": errors.placed,
            "errors": all,
        })
    }
}

/// A bound is never shown below itself.
fn above(bound: f64) -> f64 {
    (bound * 1e4).ceil() / 1e4
}
