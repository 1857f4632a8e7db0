//! `trunnion/backplot`: the path of a program in three dimensions, for a viewer. The numbers go into a file that the client names
//! (docs/scene.md), what describes them into the answer: a path of a million points is no JSON.
use crate::{analysis::Source, snapshot::Snapshot};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use tower_lsp::{
    jsonrpc::{Error, ErrorCode, Result},
    lsp_types::{TextDocumentIdentifier, Url},
};
use trunnion_check::{Report, Severity, Status};
use trunnion_files::Outputs;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Fault, FaultKind, Interpreter, ModalState, Motion, Sink, Tool};
use trunnion_machine::{AxisKind, Follower, Limits, Machine, Side};
use trunnion_scene::{Scene, Tracer, encode, thin};
use trunnion_syntax::{LineIndex, Program};

/// What the client asks for.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BackplotParams {
    /// The document.
    pub(crate) text_document: TextDocumentIdentifier,
    /// The file that is written.
    file: PathBuf,
    /// At most so many vertices; a level of detail.
    #[serde(default = "default_most")]
    most: usize,
    /// Another text that is run with the settings of the document: the program after a rewrite.
    #[serde(default)]
    text: Option<String>,
}

fn default_most() -> usize {
    200_000
}

/// The answer.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Backplot {
    /// Vertices in the file, and in the whole path.
    vertices: usize,
    whole: usize,
    /// A vertex that was left out lies at most so far from one that is there, mm; null: strands were left out.
    left_out_mm: Option<f64>,
    /// The program moves in inch: people read its lengths in inch. All numbers here are in mm.
    inch: bool,
    /// Motions that are not drawn because their path is not known.
    unknown: usize,
    /// Why the run did not reach the end of the program.
    given_up: Option<String>,
    /// What the vertices are relative to, and the lowest and highest tip of the cuts, mm.
    origin: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
    /// The machine; null: the programmed path is drawn.
    machine: Option<MachineSketch>,
    /// The tool in use at the end, as far as it is declared.
    tool: Option<ToolSketch>,
}

/// What a viewer needs to draw a machine.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct MachineSketch {
    id: String,
    name: String,
    /// From workpiece to tool.
    axes: Vec<AxisSketch>,
    /// Tolerance of the tip, mm.
    tip_tolerance_mm: f64,
}

/// One axis: limits in mm or deg, direction and point (mm) in the machine frame at home, `sign` as in machine files.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct AxisSketch {
    letter: char,
    rotary: bool,
    table: bool,
    direction: [f64; 3],
    point: [f64; 3],
    sign: f64,
    limits: Option<[f64; 2]>,
}

/// A tool, mm.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct ToolSketch {
    number: Option<u32>,
    diameter: Option<f64>,
    length: Option<f64>,
}

/// Records the path of the document, or of another text, and writes it.
pub(crate) fn backplot(snapshot: &Snapshot, params: &BackplotParams) -> Result<Backplot> {
    let (source, session) = snapshot
        .analysed
        .as_ref()
        .and_then(|analysed| analysed.judged())
        .ok_or_else(|| {
            Error::invalid_params("no path: the settings of the program cannot be used; see its findings")
        })?;
    let own;
    let program = match &params.text {
        None => &source.program,
        Some(text) => {
            own = trunnion_syntax::parse(text.as_bytes().to_vec(), source.resolved.dialect.lex);
            &own
        }
    };
    let machine = source.resolved.machine.as_ref();
    let index = LineIndex::new(program.source());
    let (run, tool) = record(source, program, &index);
    let scene = run.tracer.finish();
    let levels = if params.text.is_none() {
        levels(&session.report, &source.program, &index)
    } else {
        Vec::new()
    };
    let level = |line: u32| levels.get(line as usize).copied().unwrap_or(0);
    let (vertices, apart) = thin(&scene, params.most, |line| level(line) > 1);
    let (low, high) = scene.extent().unwrap_or((Vec3::zeros(), Vec3::zeros()));
    let origin = (low + high) * 0.5;
    let bytes = encode(&vertices, machine, &origin, level);
    write(&snapshot.parsed.uri, params, &bytes).map_err(|error| refused(&error))?;
    let Scene {
        vertices: all, unknown, ..
    } = scene;
    Ok(Backplot {
        vertices: vertices.len(),
        whole: all.len(),
        left_out_mm: apart.is_finite().then_some(apart),
        inch: run.inch,
        unknown,
        given_up: run.given_up,
        origin: origin.into(),
        low: low.into(),
        high: high.into(),
        machine: machine.map(sketch),
        tool,
    })
}

fn write(uri: &Url, params: &BackplotParams, bytes: &[u8]) -> std::result::Result<(), trunnion_files::FileError> {
    let mut outputs = Outputs::new();
    if let Ok(program) = uri.to_file_path() {
        outputs.input(&program);
    }
    outputs.output("file", &params.file)?.write(bytes, None)
}

fn refused(error: &trunnion_files::FileError) -> Error {
    Error {
        code: ErrorCode::InvalidParams,
        message: format!("the backplot was not written: {error}").into(),
        data: None,
    }
}

/// Runs a program with the settings of a document.
fn record<'a>(source: &'a Source, program: &'a Program, index: &'a LineIndex) -> (Run<'a>, Option<ToolSketch>) {
    let resolved = &source.resolved;
    let machine = resolved.machine.as_ref();
    let mut run = Run {
        program,
        index,
        machine: machine.map(|machine| (machine, Follower::new(machine))),
        tracer: Tracer::new(),
        given_up: None,
        inch: false,
    };
    let mut interpreter = Interpreter::new(resolved.dialect, &resolved.setup);
    while interpreter.advance(program, &mut run).is_some() {}
    let number = interpreter.state().tool.number();
    let tool = interpreter.tool().map(|tool: Tool| ToolSketch {
        number,
        diameter: tool.diameter_mm,
        length: tool.length_mm,
    });
    (run, tool)
}

struct Run<'a> {
    program: &'a Program,
    index: &'a LineIndex,
    machine: Option<(&'a Machine, Follower<'a>)>,
    tracer: Tracer,
    given_up: Option<String>,
    inch: bool,
}

impl Sink for Run<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.inch |= state.coordinates.is_inch();
        let start = self.program.block(motion.block).range().start;
        let line = self.index.line_column(self.program.source(), start).0;
        match &mut self.machine {
            Some((machine, follower)) => {
                let leg = follower.follow(motion);
                self.tracer.leg(machine, &leg, line);
            }
            None => self.tracer.motion(motion, line),
        }
    }
    fn fault(&mut self, fault: Fault) {
        if let FaultKind::EndlessLoop { blocks, proved } = fault.kind {
            let line = self.index.line_column(self.program.source(), fault.range.start).0;
            self.given_up.get_or_insert_with(|| {
                if proved {
                    format!("line {line}: this loop never ends; what comes after it is not drawn")
                } else {
                    format!("line {line}: stopped after {blocks} blocks; what comes after them is not drawn")
                }
            });
        }
    }
}

/// What was found, by line from 1: 1 info or unknown, 2 warning, 3 error.
fn levels(report: &Report, program: &Program, index: &LineIndex) -> Vec<u8> {
    let line = |at: u32| index.line_column(program.source(), at).0 as usize;
    let mut levels: Vec<u8> = Vec::new();
    for found in report.findings() {
        let level = match (found.status, found.severity) {
            (Status::Unknown, _) | (_, Severity::Info) => 1,
            (_, Severity::Warning) => 2,
            (_, Severity::Error) => 3,
        };
        let (from, to) = (line(found.range.start), line(found.last.start));
        let to = to.max(from);
        if levels.len() <= to {
            levels.resize(to + 1, 0);
        }
        for at in &mut levels[from..=to] {
            *at = (*at).max(level);
        }
    }
    levels
}

fn sketch(machine: &Machine) -> MachineSketch {
    let axes = machine.own_axes().map(|(_, axis)| {
        let rotary = axis.kind == AxisKind::Rotary;
        let shown = |value: f64| if rotary { deg(value) } else { value };
        AxisSketch {
            letter: char::from(axis.letter),
            rotary,
            table: axis.side == Side::Table,
            direction: axis.direction.into(),
            point: axis.point.into(),
            sign: axis.sign,
            limits: match axis.limits {
                Limits::Unbounded => None,
                Limits::Range(low, high) => Some([shown(low), shown(high)]),
            },
        }
    });
    MachineSketch {
        id: machine.id.clone(),
        name: machine.name.clone(),
        axes: axes.collect(),
        tip_tolerance_mm: machine.tolerances.tip_mm,
    }
}
