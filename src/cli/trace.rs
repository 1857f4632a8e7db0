//! `trace`: one row per motion, what the machine will do, in numbers.
use super::{
    Done,
    args::{Global, Trace, TraceFormat},
    failure::{Failure, remark},
    legs::flat_setup,
    load::{self, Loaded},
    waiting,
};
use serde::Serializer as _;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::io::{BufWriter, Write};
use trunnion_interp::{AxisLetter, Fault, FaultKind, Interpreter, ModalState, Motion, Setup, Sink};
use trunnion_machine::{Leg, Machine, Row, row};
use trunnion_planner::{Listener, Timed, time};
use trunnion_syntax::{BlockId, LineIndex};

const COLUMNS: [&str; 17] = [
    "line",
    "block",
    "motion",
    "tcp",
    "x_mm",
    "y_mm",
    "z_mm",
    "i",
    "j",
    "k",
    "feed_mm_min",
    "duration_s",
    "branch",
    "pole_angle_deg",
    "tip_deviation_mm",
    "feed_limit_mm_min",
    "limiting_axis",
];

/// The last columns: planned time, highest feed and what holds it back.
const PLANNED: [&str; 3] = ["time_s", "reached_feed_mm_min", "limited_by"];

/// Runs `trace`.
pub(super) fn run(global: &Global, command: &Trace) -> Result<Done, Failure> {
    let loaded = load::load_for_steps(global, &command.file)?;
    if global.verbose {
        remark(false, &loaded.explanation());
    }
    let machine = loaded.machine_or_fail("trace")?;
    let mut outputs = loaded.outputs();
    let target = command
        .output
        .as_ref()
        .map(|path| outputs.output("-o", path))
        .transpose()?;
    let traced = match target {
        None => {
            let out = BufWriter::new(std::io::stdout().lock());
            let trace = || write(command, &loaded, machine, out);
            waiting::beside_output(global, "tracing", &command.file, trace)
        }
        Some(target) => waiting::during(global, "tracing", &command.file, || {
            target.fill(|out| write(command, &loaded, machine, BufWriter::new(out)))
        }),
    }?;
    Ok(traced.say(global, &loaded))
}

/// What there is to say about a trace that is written.
struct Traced {
    /// Problems of the program.
    problems: usize,
    /// Why it is incomplete.
    given_up: Option<String>,
}

impl Traced {
    fn say(self, global: &Global, loaded: &Loaded) -> Done {
        let problems = self.problems;
        if problems > 0 {
            let noun = if problems == 1 { "problem" } else { "problems" };
            let text = format!(
                "{}: {problems} {noun} in the program; see `trunnion check`",
                loaded.name
            );
            remark(global.quiet, &text);
        }
        if let Some(why) = self.given_up {
            remark(false, &why);
            return Done::Found;
        }
        // A trace shows what the machine does and judges nothing: it never reports a finding, whatever `check` would report.
        Done::Clean
    }
}

/// Writes all rows.
fn write<W: Write>(command: &Trace, loaded: &Loaded, machine: &Machine, out: W) -> Result<Traced, Failure> {
    let lines = LineIndex::new(loaded.program.source());
    let setup = flat_setup(loaded, machine);
    let mut tracer = Tracer {
        loaded,
        unnamed: unnamed(loaded, &setup),
        lines: &lines,
        machine,
        waiting: VecDeque::new(),
        writer: Rows::new(command.format, out, machine)?,
        error: None,
        faults: 0,
        given_up: None,
    };
    time(&loaded.program, loaded.resolved.dialect, &setup, machine, &mut tracer);
    if let Some(failure) = tracer.error {
        return Err(failure);
    }
    tracer.writer.finish()?;
    Ok(Traced {
        problems: tracer.faults + loaded.program.errors().len(),
        given_up: tracer.given_up,
    })
}

struct Tracer<'a, W: Write> {
    loaded: &'a Loaded,
    /// The axes that the program never names, bits as in a position: where they are is not shown.
    unnamed: u16,
    lines: &'a LineIndex,
    machine: &'a Machine,
    /// Rows whose time is not known yet: those since the last stop.
    waiting: VecDeque<(u32, String, Row)>,
    writer: Rows<W>,
    error: Option<Failure>,
    faults: usize,
    /// Why it is incomplete.
    given_up: Option<String>,
}

impl<W: Write> Listener for Tracer<'_, W> {
    fn leg(&mut self, leg: &Leg, _: &ModalState, _: u32) {
        if self.error.is_none() {
            let (line, block) = place(self.loaded, self.lines, leg.motion.block);
            let mut row = row(self.machine, leg);
            self.hide_unnamed(&mut row);
            self.waiting.push_back((line, block, row));
        }
    }
    fn timed(&mut self, timed: &Timed, wait: bool) {
        if wait || self.error.is_some() {
            return;
        }
        let Some((line, block, row)) = self.waiting.pop_front() else {
            return;
        };
        if let Err(failure) = self.writer.write(line, &block, &row, &planned(self.machine, timed)) {
            self.error = Some(failure);
        }
    }
    fn fault(&mut self, fault: Fault) {
        self.given_up = self.given_up.take().or_else(|| load::not_followed(self.loaded, &fault));
        // an undeclared offset or length is no problem of the program
        let undeclared = matches!(
            fault.kind,
            FaultKind::WorkOffsetUnset { .. } | FaultKind::ToolLengthUnset { .. }
        );
        self.faults += usize::from(!undeclared);
    }
}

impl<W: Write> Tracer<'_, W> {
    /// Leaves out where an axis is that the program never names.
    fn hide_unnamed(&self, row: &mut Row) {
        let is_unnamed = |axis: usize| self.unnamed & (1 << axis) != 0;
        for (axis, value) in row.tip_mm.iter_mut().flatten().enumerate() {
            if is_unnamed(axis) {
                *value = f64::NAN;
            }
        }
        for (value, (_, axis)) in row.joints.iter_mut().zip(self.machine.own_axes()) {
            *value = value.take_if(|_| !AxisLetter::new(axis.letter).is_some_and(|letter| is_unnamed(letter.0.into())));
        }
    }
}

/// The axes of X, Y and Z that the program never names, while they stand.
fn unnamed(loaded: &Loaded, setup: &Setup) -> u16 {
    struct Nothing;
    impl Sink for Nothing {
        fn motion(&mut self, _: &Motion, _: &ModalState) {}
        fn fault(&mut self, _: Fault) {}
    }
    if setup.control.absent_axis.is_some() {
        return 0;
    }
    let mut interpreter = Interpreter::new(loaded.resolved.dialect, setup);
    let _ = interpreter.advance(&loaded.program, &mut Nothing);
    interpreter.standing()
}

/// Planned time, highest feed, what holds it back.
fn planned(machine: &Machine, timed: &Timed) -> [Value; 3] {
    let known = timed.seconds[1].filter(|_| !timed.from_nowhere);
    let number = |value: Option<f64>| value.map_or(Value::Null, |value| json!(tidy(value)));
    let moves = timed.length > 0.0 && known.is_some();
    [
        number(known),
        number(timed.reached.filter(|_| moves)),
        if moves {
            json!(timed.limited_by(machine))
        } else {
            Value::Null
        },
    ]
}

fn place(loaded: &Loaded, lines: &LineIndex, id: BlockId) -> (u32, String) {
    let block = loaded.program.block(id);
    let (line, _) = lines.line_column(loaded.program.source(), block.range().start);
    let number = block
        .number()
        .map_or_else(String::new, |range| loaded.program.text(range).into_owned());
    (line, number)
}

/// Where rows go.
enum Rows<W: Write> {
    Csv {
        writer: Box<csv::Writer<W>>,
        columns: usize,
    },
    Json {
        out: W,
        /// Columns and their names, in the order of the names.
        names: Vec<(usize, String)>,
        first: bool,
    },
}

impl<W: Write> Rows<W> {
    fn new(format: TraceFormat, mut out: W, machine: &Machine) -> Result<Self, Failure> {
        let joints = machine
            .own_axes()
            .map(|(_, axis)| format!("joint_{}", char::from(axis.letter.to_ascii_lowercase())));
        // an undecided posture: why, and the other one that the control may take
        let others = machine
            .rotary
            .iter()
            .map(|&axis| format!("other_{}", char::from(machine.axes[axis].letter.to_ascii_lowercase())));
        let open = core::iter::once("open_posture".to_owned()).chain(others);
        let columns = COLUMNS.iter().map(|&name| name.to_owned());
        let planned = PLANNED.iter().map(|&name| name.to_owned());
        let names: Vec<String> = columns.chain(joints).chain(open).chain(planned).collect();
        match format {
            TraceFormat::Csv => {
                let mut writer = csv::Writer::from_writer(out);
                writer.write_record(&names).map_err(csv_failure)?;
                Ok(Self::Csv {
                    writer: Box::new(writer),
                    columns: names.len(),
                })
            }
            TraceFormat::Json => {
                let id = serde_json::to_string(&machine.id).unwrap_or_default();
                write!(out, "{{\"schema\":\"trunnion-trace/1\",\"machine\":{id},\"rows\":[")?;
                let mut names: Vec<(usize, String)> = names.into_iter().enumerate().collect();
                names.sort_by(|(_, a), (_, b)| a.cmp(b));
                Ok(Self::Json {
                    out,
                    names,
                    first: true,
                })
            }
        }
    }

    fn write(&mut self, line: u32, block: &str, row: &Row, planned: &[Value; 3]) -> Result<(), Failure> {
        let mut cells = cells(line, block, row);
        let others = self.names().saturating_sub(cells.len() + 1 + PLANNED.len());
        cells.push(row.open.map_or(Value::Null, |(why, _)| json!(why)));
        cells.extend((0..others).map(|index| {
            let other = row.open.and_then(|(_, q)| q.get(index).copied());
            other.map_or(Value::Null, |value| json!(tidy(value)))
        }));
        cells.extend(planned.iter().cloned());
        match self {
            Self::Csv { writer, .. } => writer.write_record(cells.iter().map(text)).map_err(csv_failure),
            Self::Json { out, names, first } => {
                out.write_all(if *first { b"\n" } else { b",\n" })?;
                *first = false;
                let members = names.iter().map(|(column, name)| (name, &cells[*column]));
                let mut serializer = serde_json::Serializer::new(&mut *out);
                serializer.collect_map(members).map_err(std::io::Error::from)?;
                Ok(())
            }
        }
    }

    /// How many columns there are.
    fn names(&self) -> usize {
        match self {
            Self::Csv { columns, .. } => *columns,
            Self::Json { names, .. } => names.len(),
        }
    }

    fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Csv { mut writer, .. } => writer.flush()?,
            Self::Json { mut out, .. } => {
                out.write_all(b"\n]}\n")?;
                out.flush()?;
            }
        }
        Ok(())
    }
}

/// Rounded to 1e-9 of its unit: finer than any control resolves, and without the noise of the last bits.
fn tidy(value: f64) -> f64 {
    (value * 1e9).round() / 1e9 + 0.0
}

/// Empty where a value has no meaning.
fn cells(line: u32, block: &str, row: &Row) -> Vec<Value> {
    let number = |value: Option<f64>| value.filter(|v| v.is_finite()).map_or(Value::Null, |v| json!(tidy(v)));
    let part = |vector: Option<[f64; 3]>, i: usize| number(vector.map(|v| v[i]));
    let mut cells = vec![
        json!(line),
        if block.is_empty() { Value::Null } else { json!(block) },
        json!(row.motion),
        json!(row.tcp),
    ];
    cells.extend((0..3).map(|i| part(row.tip_mm, i)));
    cells.extend((0..3).map(|i| part(row.axis, i)));
    cells.extend([
        number(row.feed_mm_min),
        number(row.duration_s),
        row.branch.map_or(Value::Null, |b| json!(b)),
    ]);
    cells.extend([
        number(row.pole_angle_deg),
        number(row.tip_deviation_mm.map(|bound| (bound * 1e9).ceil() / 1e9)),
        number(row.feed_limit_mm_min),
    ]);
    cells.push(
        row.limiting_axis
            .map_or(Value::Null, |letter| json!(letter.to_string())),
    );
    cells.extend(row.joints.iter().map(|&joint| number(joint)));
    cells
}

fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

fn csv_failure(error: csv::Error) -> Failure {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => Failure::from(error),
        other => Failure::new(format!("cannot write CSV: {other:?}")),
    }
}
