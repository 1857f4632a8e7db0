//! Events of a program: what its blocks say beside motions, in the order the control runs them.
use crate::job::{Coolant, Event, Job, Placed};
use crate::{Options, Refused};
use trunnion_certify::conversion::{Ran, Reading};
use trunnion_dialect::{Action, Dialect};
use trunnion_interp::{AllClampCodes, Tool};
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Program, TextRange, Value, Word};

/// What a block says beside its motions.
#[derive(Debug, Default)]
pub(crate) struct Said {
    pub(crate) before: Vec<Event>,
    pub(crate) after: Vec<Event>,
    /// Direction of the spindle: counter-clockwise.
    pub(crate) counter_clockwise: Option<bool>,
    /// A tool is changed.
    pub(crate) tool_change: bool,
    /// What has no counterpart and moves nothing.
    pub(crate) left_out: Vec<String>,
    /// Name of the program.
    pub(crate) name: Option<String>,
}

/// Why a block cannot be carried over, and where.
pub(crate) type Cannot = (TextRange, String);

/// All events of a program.
/// `clamps`: the codes of clamps, where they are written anew.
pub(crate) fn job(
    reading: &Reading,
    dialect: &Dialect,
    options: &Options,
    clamps: Option<&AllClampCodes>,
) -> Result<Job, Refused> {
    let program = &reading.program;
    if let Some(block) = reading.elsewhere {
        let message =
            "the program calls another file, whose M codes and comments are not carried over: convert a single file";
        return Err(Refused::at(program, block, message));
    }
    let mut teller = Teller {
        program,
        job: Job {
            name: options.program_name.clone(),
            ..Job::default()
        },
        spindle: Spindle::Unknown,
        counter_clockwise: false,
        tool: None,
        work_offset: None,
    };
    let mut motions = 0;
    for ran in &reading.blocks {
        let block = program.block(ran.block);
        let said = match program.options().format {
            Format::Apt => crate::events_apt::said(&block, options),
            Format::Iso => said(&block, dialect, options, clamps),
        }
        .map_err(|(range, message)| Refused::range(program, range, message))?;
        teller.block(reading, ran, said, motions)?;
        motions = ran.motions;
    }
    let mut job = teller.job;
    // G-code has no name of its own: the first comment is the title
    if job.name.is_none()
        && let Some(Placed {
            event: Event::Comment(title),
            ..
        }) = job.events.first()
    {
        job.name = Some(title.clone());
        job.events.remove(0);
    }
    Ok(job)
}

/// What was last said of the spindle.
#[derive(Clone, Copy, PartialEq)]
enum Spindle {
    Unknown,
    Off,
    /// Counter-clockwise, and its speed.
    On(bool, f64),
}

struct Teller<'p> {
    program: &'p Program,
    job: Job,
    spindle: Spindle,
    counter_clockwise: bool,
    tool: Option<u32>,
    work_offset: Option<String>,
}

impl Teller<'_> {
    fn block(&mut self, reading: &Reading, ran: &Ran, said: Said, first: usize) -> Result<(), Refused> {
        let block = ran.block;
        self.counter_clockwise = said.counter_clockwise.unwrap_or(self.counter_clockwise);
        let heard = |events: &[Event]| events.iter().any(|event| !matches!(event, Event::Comment(_)));
        if ran.motions_wait && (heard(&said.before) || heard(&said.after)) {
            let message = "an M code inside a contour with cutter radius compensation: where on the offset path it belongs is not known";
            return Err(Refused::at(self.program, block, message));
        }
        for what in &said.left_out {
            self.job.leave_out(what, block);
        }
        self.job.name = self.job.name.take().or(said.name);
        let (comments, before): (Vec<_>, Vec<_>) = said
            .before
            .into_iter()
            .partition(|event| matches!(event, Event::Comment(_)));
        self.say(comments, block);
        self.tool(ran, said.tool_change)?;
        self.say(before, block);
        for index in first..ran.motions {
            let motion = &reading.motions[index].motion;
            self.spindle(motion.spindle_on, motion.spindle_rpm, block)?;
            self.job.push(Event::Motion(index), block);
        }
        self.spindle(ran.spindle_on, ran.spindle_rpm, block)?;
        self.say(said.after, block);
        Ok(())
    }

    fn say(&mut self, events: Vec<Event>, block: BlockId) {
        for event in events {
            self.job.push(event, block);
        }
    }

    /// Tool and work offset, where they are others now.
    fn tool(&mut self, ran: &Ran, change: bool) -> Result<(), Refused> {
        let block = ran.block;
        if change && ran.tool.is_none() {
            let message = "a tool without number: its place in the magazine of another control is not known";
            return Err(Refused::at(self.program, block, message));
        }
        if let Some(number) = ran.tool.filter(|_| ran.tool != self.tool) {
            self.tool = ran.tool;
            self.job.push(Event::Tool(number), block);
            if !self.job.tools.iter().any(|(known, _)| *known == number) {
                self.job.tools.push((number, None));
            }
        }
        if let (Some(number), Some(data)) = (ran.tool, ran.tool_data) {
            let known = self.job.tools.iter_mut().find(|(known, _)| *known == number);
            if let Some((_, slot)) = known {
                *slot = Some(Tool { number, ..data });
            }
        }
        let name = ran.work_offset.as_deref();
        if name.is_some() && name != self.work_offset.as_deref() {
            self.work_offset = name.map(str::to_owned);
            self.job
                .push(Event::WorkOffset(name.unwrap_or_default().to_owned()), block);
        }
        Ok(())
    }

    fn spindle(&mut self, on: Option<bool>, rpm: Option<f64>, block: BlockId) -> Result<(), Refused> {
        let wanted = match (on, rpm) {
            (None, _) => return Ok(()),
            (Some(false), _) => Spindle::Off,
            (Some(true), Some(rpm)) => Spindle::On(self.counter_clockwise, rpm),
            (Some(true), None) => {
                let message =
                    "the spindle turns with a speed that is not known (none is programmed, or a cutting speed)";
                return Err(Refused::at(self.program, block, message));
            }
        };
        if self.spindle != wanted {
            self.spindle = wanted;
            let event = match wanted {
                Spindle::On(ccw, rpm) => Event::SpindleOn(ccw, rpm),
                Spindle::Off | Spindle::Unknown => Event::SpindleOff,
            };
            self.job.push(event, block);
        }
        Ok(())
    }
}

/// A comment as an event; machine-readable marks and what speaks of another dialect are left out.
pub(crate) fn comment(text: &str) -> Option<Event> {
    let text = text.trim();
    let lower = text.to_ascii_lowercase();
    let ours = lower.strip_prefix("trunnion:").map(str::trim_start);
    let other = ours.is_some_and(|rest| !rest.starts_with("allow"));
    if text.is_empty() || other || text.starts_with("->") || text.starts_with('*') || text.starts_with("$PATH") {
        return None;
    }
    Some(Event::Comment(text.to_owned()))
}

/// The words by which a comment speaks to LinuxCNC.
pub(crate) const ACTIVE: &[&str] = &[
    "MSG",
    "DEBUG",
    "PRINT",
    "LOG",
    "LOGOPEN",
    "LOGAPPEND",
    "LOGCLOSE",
    "PROBEOPEN",
    "PROBECLOSE",
    "ABORT",
];

/// What an ISO block says.
fn said(
    block: &Block<'_>,
    dialect: &Dialect,
    options: &Options,
    clamps: Option<&AllClampCodes>,
) -> Result<Said, Cannot> {
    let program = block.program();
    let mut said = Said::default();
    for item in block.items() {
        match item {
            Item::Comment(found) => {
                let text = program.text(found.inner);
                let head = text
                    .split_once(',')
                    .map(|(head, rest)| (head.trim().to_ascii_uppercase(), rest));
                match head {
                    Some((head, rest)) if dialect.quirks.rs274 && head == "MSG" => {
                        said.before.push(Event::Message(rest.trim().to_owned()));
                    }
                    Some((head, _)) if dialect.quirks.rs274 && ACTIVE.contains(&head.as_str()) => {
                        said.left_out.push(format!("({head},...)"));
                    }
                    _ => said.before.extend(comment(&text)),
                }
            }
            Item::Skip(_, range) => {
                let message =
                    "block delete: whether the block runs depends on a switch; take the `/` or the block away";
                return Err((range, message.to_owned()));
            }
            Item::Word(word) if clamps.is_some_and(|clamps| is_clamp(&word, clamps)) => {}
            Item::Word(word) => said_by_word(&word, program, dialect, options, &mut said)?,
            Item::Call(call) => {
                let name = program.text(call.name);
                if name.eq_ignore_ascii_case("MSG") {
                    let inside = call.arguments.map(|range| program.text(range)).unwrap_or_default();
                    let text = inside.trim().trim_matches('"').to_owned();
                    if !text.is_empty() {
                        said.before.push(Event::Message(text));
                    }
                } else if let Some(code) = dialect.name(&name)
                    && matches!(code.action, Action::PathMode | Action::NoMotion | Action::NotFollowed)
                {
                    said.left_out.push(name.to_string());
                }
            }
            _ => {}
        }
    }
    Ok(said)
}

/// Whether a word is the code of a clamp.
fn is_clamp(word: &Word, clamps: &AllClampCodes) -> bool {
    let (Address::Letter(b'M'), Value::Number(number)) = (word.address, word.value) else {
        return false;
    };
    let is = |code: u16| number.to_f64().total_cmp(&f64::from(code)).is_eq();
    clamps.iter().flatten().any(|codes| is(codes.on) || is(codes.off))
}

fn said_by_word(
    word: &Word,
    program: &Program,
    dialect: &Dialect,
    options: &Options,
    said: &mut Said,
) -> Result<(), Cannot> {
    let (Address::Letter(letter @ (b'G' | b'M' | b'T')), Value::Number(number)) = (word.address, word.value) else {
        return Ok(());
    };
    let tenths = (number.to_f64() * 10.0).round();
    if !(0.0..1e6).contains(&tenths) {
        return Ok(());
    }
    let tenths = tenths as u32;
    match letter {
        b'T' => said.tool_change |= dialect.quirks.tool_word_changes,
        b'G' => {
            let passing = |code: &&trunnion_dialect::Code| matches!(code.action, Action::PathMode | Action::NoMotion);
            if let Some(code) = dialect.g(tenths).filter(passing) {
                said.left_out.push(code.id.clone());
            }
        }
        _ => return m_code(tenths, word.range, program, dialect, options, said),
    }
    Ok(())
}

fn m_code(
    tenths: u32,
    range: TextRange,
    program: &Program,
    dialect: &Dialect,
    options: &Options,
    said: &mut Said,
) -> Result<(), Cannot> {
    let code = dialect.m(tenths);
    match code.map(|code| code.action) {
        Some(Action::SpindleClockwise) => said.counter_clockwise = Some(false),
        Some(Action::SpindleCounterClockwise) => said.counter_clockwise = Some(true),
        Some(Action::ToolChange) => said.tool_change = true,
        Some(Action::ProgramStop) => said.after.push(Event::Stop(tenths == 10)),
        Some(Action::NoMotion) | None => match (tenths, code.and_then(|code| code.group.as_deref())) {
            // by custom on controls that leave them to the builder of the machine
            (70, _) => said.before.push(Event::Coolant(Coolant::Mist)),
            (80, _) => said.before.push(Event::Coolant(Coolant::Flood)),
            (90, _) | (890, Some("coolant")) => said.after.push(Event::Coolant(Coolant::Off)),
            (880, Some("coolant")) => said.before.push(Event::Coolant(Coolant::Thru)),
            _ => {
                let written = program.text(range).to_ascii_uppercase();
                if !options.drop.iter().any(|drop| drop.eq_ignore_ascii_case(&written)) {
                    let message = format!(
                        "{written} has no counterpart: what it does is up to the machine; `--drop {written}` leaves it out"
                    );
                    return Err((range, message));
                }
                said.left_out.push(written);
            }
        },
        _ => {}
    }
    Ok(())
}
