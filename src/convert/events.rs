//! Events of a program: what its blocks contain apart from motions, in the order the control runs them.
use crate::comments::{LONGEST_COMMENT, comment, pieces};
use crate::events_spindle::Spindle;
use crate::job::{Coolant, Event, Job, Placed};
use crate::{Options, Post, Refused};
use trunnion_certify::conversion::{Ask, Asked, Own, Ran, Reading, Why, ZeroNames};
use trunnion_dialect::{Action, Dialect, PathMode};
use trunnion_interp::{AllClampCodes, Tool};
use trunnion_syntax::{Address, Block, BlockId, Format, Item, Program, TextRange, Value, Word};

/// What a block contains apart from its motions.
#[derive(Debug, Default)]
pub(crate) struct BlockEvents {
    /// Comments and messages.
    pub(crate) before: Vec<Event>,
    /// A tool is changed.
    pub(crate) tool_change: bool,
    /// Name of the program.
    pub(crate) name: Option<String>,
}

/// Why a block cannot be carried over, and where.
pub(crate) type Cannot = (TextRange, String);

/// All events of a program.
/// `clamps`: the codes of clamps, where they are written again. `post`: what the target can say; `None`: APT.
pub(crate) fn job(
    reading: &Reading,
    dialect: &Dialect,
    options: &Options,
    clamps: Option<&AllClampCodes>,
    post: Option<&Post>,
) -> Result<Job, Refused> {
    let program = &reading.program;
    if let Some(block) = reading.elsewhere {
        let message =
            "the program calls another file, whose M codes and comments are not carried over: convert a single file";
        return Err(Refused::at(program, block, message));
    }
    let mut teller = EventCollector {
        program,
        dialect: &reading.dialect,
        post,
        job: Job {
            name: options.program_name.clone(),
            ..Job::default()
        },
        spindle: Spindle::Unknown,
        speed: None,
        keeps_coolant: program.options().format == Format::Apt || dialect.quirks.rs274(),
        flowing: Vec::new(),
        tool: None,
        work_offset: None,
        options,
    };
    let (mut motions, mut next) = (0, 0);
    for (index, ran) in reading.blocks.iter().enumerate() {
        let block = program.block(ran.block);
        let said = match program.options().format {
            Format::Apt => crate::events_apt::said(&block, options),
            Format::Klartext => crate::events_klartext::said(&block),
            Format::Iso | Format::Osp => said(&block, dialect),
        }
        .map_err(|(range, message)| Refused::range(program, range, message))?;
        let count = reading.asks[next..]
            .iter()
            .take_while(|asked| asked.ran == index)
            .count();
        let asks = &reading.asks[next..next + count];
        next += count;
        let asked = teller.asked(reading, asks, options, clamps.is_some())?;
        teller.block(reading, ran, said, asked, motions)?;
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

pub(crate) struct EventCollector<'p> {
    pub(crate) program: &'p Program,
    dialect: &'p str,
    post: Option<&'p Post>,
    pub(crate) job: Job,
    pub(crate) spindle: Spindle,
    /// The speed that was written last, 1/min.
    pub(crate) speed: Option<f64>,
    /// Neither a stop nor a tool change ends the coolant in the original.
    keeps_coolant: bool,
    /// The coolants that the original has switched on.
    flowing: Vec<Coolant>,
    tool: Option<u32>,
    work_offset: Option<String>,
    options: &'p Options,
}

impl EventCollector<'_> {
    /// What is requested apart from motions: events before and after those of the block. What cannot be carried over is refused by name, or
    /// left out where the user wants it.
    fn asked(
        &mut self,
        reading: &Reading,
        asks: &[Asked],
        options: &Options,
        own_clamps: bool,
    ) -> Result<(Vec<Event>, Vec<Event>), Refused> {
        let (mut before, mut after) = (Vec::new(), Vec::new());
        for asked in asks {
            if let Ask::Coolant(coolant) = &asked.ask {
                match coolant {
                    Coolant::Off => self.flowing.clear(),
                    Coolant::ThruOff => self.flowing.retain(|on| *on != Coolant::Thru),
                    on if self.flowing.contains(on) => {}
                    on => self.flowing.push(*on),
                }
            }
            match &asked.ask {
                Ask::Coolant(coolant @ (Coolant::Off | Coolant::ThruOff)) => after.push(Event::Coolant(*coolant)),
                Ask::Coolant(coolant) => before.push(Event::Coolant(*coolant)),
                Ask::Stop { optional } => after.push(Event::Stop(*optional)),
                Ask::Auxiliary(number) => before.push(Event::Auxiliary(*number)),
                Ask::Path { mode, name } => self.path(asked, *mode, name, options, &mut before)?,
                Ask::Clamp(_) if own_clamps => {}
                Ask::Clamp(name) => self.own(asked, (name, name), Why::Machine, options)?,
                Ask::Idle(name) if WRITTEN.contains(&name.as_str()) => {}
                Ask::Idle(name) => self.job.leave_out(name, asked.block),
                Ask::Own(own) if self.has_same(own, &reading.blocks[asked.ran], options) => {
                    before.push(Event::Own(own.text.clone()));
                }
                Ask::Own(own) => self.own(asked, (&own.name, &own.text), own.why, options)?,
            }
        }
        Ok((before, after))
    }

    /// A mode of path control: written where the target has it. A permission to round corners may stay unused; what is demanded may not.
    fn path(
        &mut self,
        asked: &Asked,
        mode: PathMode,
        name: &str,
        options: &Options,
        before: &mut Vec<Event>,
    ) -> Result<(), Refused> {
        let dropped = options.drop.iter().any(|drop| drop.eq_ignore_ascii_case(name));
        let writes = self.post.is_some_and(|post| post.template(path_key(mode)).is_some());
        if writes && !dropped {
            before.push(Event::Path(mode));
            return Ok(());
        }
        if mode == PathMode::Continuous {
            self.job.leave_out(name, asked.block);
            return Ok(());
        }
        self.own(asked, (name, name), Why::PathControl, options)
    }

    /// Whether tolerances of path control are written in plain words, and the target is the same control with the same unit.
    fn has_same(&self, own: &Own, ran: &Ran, options: &Options) -> bool {
        let plain = |word: &str| word.get(1..).is_some_and(|number| number.parse::<f64>().is_ok());
        let dropped = options.drop.iter().any(|drop| drop.eq_ignore_ascii_case(&own.name));
        own.why == Why::PathControl
            && !dropped
            && self.post.is_some_and(|post| post.dialect == self.dialect)
            && ran.unit_mm == options.units.mm()
            // alone it may hold for its block only
            && own.text.starts_with('G')
            && own.text.contains(' ')
            && own.text.split(' ').all(plain)
    }

    fn own(&mut self, asked: &Asked, (name, text): (&str, &str), why: Why, options: &Options) -> Result<(), Refused> {
        let dropped = options.drop.iter().any(|drop| drop.eq_ignore_ascii_case(name));
        if dropped && why.may_be_dropped() {
            self.job.leave_out(name, asked.block);
            return Ok(());
        }
        Err(Refused::range(self.program, asked.range, refusal(name, text, why)))
    }

    fn block(
        &mut self,
        reading: &Reading,
        ran: &Ran,
        said: BlockEvents,
        (asked, after): (Vec<Event>, Vec<Event>),
        first: usize,
    ) -> Result<(), Refused> {
        let block = ran.block;
        let heard = |events: &[Event]| events.iter().any(|event| !matches!(event, Event::Comment(_)));
        if ran.motions_wait && (heard(&said.before) || heard(&asked) || heard(&after)) {
            let message = "an M code inside a contour with cutter radius compensation: where it belongs on the offset path is unknown";
            return Err(Refused::at(self.program, block, message));
        }
        self.job.name = self.job.name.take().or(said.name);
        let (comments, before): (Vec<_>, Vec<_>) = said
            .before
            .into_iter()
            .partition(|event| matches!(event, Event::Comment(_)));
        self.say(comments, block);
        self.tool(ran, said.tool_change)?;
        self.say(before, block);
        self.say(asked, block);
        let turns = ran.counter_clockwise.unwrap_or(false);
        for index in first..ran.motions {
            let motion = &reading.motions[index].motion;
            if motion.is_feed() && motion.spindle_on.is_none() {
                self.speed(motion.spindle_rpm, block);
            }
            self.spindle(motion.spindle_on, motion.spindle_rpm, turns, block)?;
            self.job.push(Event::Motion(index), block);
        }
        self.spindle(ran.spindle_on, ran.spindle_rpm, turns, block)?;
        let stops = after.iter().any(|event| matches!(event, Event::Stop(_)));
        self.say(after, block);
        if stops {
            // a stop may end it: the next motion starts it again, where it turns in the original
            self.spindle = Spindle::Unknown;
            self.flow_again(block);
        }
        Ok(())
    }

    fn say(&mut self, events: Vec<Event>, block: BlockId) {
        for event in events {
            match event {
                Event::Comment(text) if text.len() > LONGEST_COMMENT => {
                    for part in pieces(&text) {
                        self.job.push(Event::Comment(part), block);
                    }
                }
                event => self.job.push(event, block),
            }
        }
    }

    /// The coolant goes on after a stop or a tool change, where the original's language says so, and the target may end it.
    fn flow_again(&mut self, block: BlockId) {
        if self.keeps_coolant {
            for coolant in &self.flowing {
                self.job.push(Event::Coolant(*coolant), block);
            }
        }
    }

    /// Tool and work offset, if they changed.
    fn tool(&mut self, ran: &Ran, change: bool) -> Result<(), Refused> {
        let block = ran.block;
        if change && ran.tool.is_none() {
            let message = "a tool without a number: its place in the magazine of the other machine is unknown";
            return Err(Refused::at(self.program, block, message));
        }
        if let Some(number) = ran.tool.filter(|_| ran.tool != self.tool) {
            self.tool = ran.tool;
            // the change stops the spindle, or may do so: it is started again; a turret leaves it alone
            let target = self.post.and_then(|post| trunnion_dialect::builtin(&post.dialect));
            if target.is_some_and(|dialect| !dialect.quirks.tool_word.changes()) {
                self.spindle = Spindle::Unknown;
            }
            self.speed = None;
            self.job.push(Event::Tool(number), block);
            self.flow_again(block);
            self.job.tool_mut(number);
        }
        if let (Some(number), Some(data)) = (ran.tool, ran.tool_data) {
            *self.job.tool_mut(number) = Some(Tool { number, ..data });
        }
        let name = ran.work_offset.as_deref();
        if name.is_some() && name != self.work_offset.as_deref() {
            let before = std::mem::replace(&mut self.work_offset, name.map(str::to_owned));
            let name = name.unwrap_or_default();
            let stand_in = self.options.work_offset(self.post);
            let written = if ZeroNames::of(name) == ZeroNames::of(stand_in) {
                name.to_owned()
            } else {
                if let Some(other) = before.filter(|before| before != name) {
                    let message = format!(
                        "the program uses {other} and {name}, but the output can name one zero point for them (`--work-offset`): split the program"
                    );
                    return Err(Refused::at(self.program, block, message));
                }
                self.job.renamed_offset = Some((name.to_owned(), stand_in.to_owned()));
                stand_in.to_owned()
            };
            if self.post.is_some_and(|post| post.template("work-offset") == Some("")) {
                self.job.renamed_offset = Some((name.to_owned(), "the zero point that is active".to_owned()));
            }
            self.job.push(Event::WorkOffset(written), block);
        }
        Ok(())
    }
}

/// Requests that move nothing and are written, as comments, messages or the title.
const WRITTEN: &[&str] = &["MSG", "(MSG,...)", "PPRINT", "REMARK", "TITLES", "PARTNO", "DISPLY"];

/// The template that writes a mode of path control.
pub(crate) fn path_key(mode: PathMode) -> &'static str {
    match mode {
        PathMode::ExactStop => "exact-stop",
        PathMode::ExactPath => "exact-path",
        PathMode::Continuous => "continuous-path",
    }
}

/// What cannot be carried over, in words.
pub(crate) fn refusal(name: &str, text: &str, why: Why) -> String {
    let way_out = if why.may_be_dropped() {
        format!("; `--drop {name}` leaves it out")
    } else {
        String::new()
    };
    format!("{text} {}{way_out}", why.sentence())
}

/// The keywords of comments that LinuxCNC acts on.
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

/// The events of an ISO block.
fn said(block: &Block<'_>, dialect: &Dialect) -> Result<BlockEvents, Cannot> {
    let program = block.program();
    let mut said = BlockEvents::default();
    for item in block.items() {
        match item {
            Item::Comment(found) => {
                let text = program.text(found.inner);
                let head = text
                    .split_once(',')
                    .map(|(head, rest)| (head.trim().to_ascii_uppercase(), rest));
                match head {
                    Some((head, rest)) if dialect.quirks.rs274() && head == "MSG" => {
                        said.before.push(Event::Message(rest.trim().to_owned()));
                    }
                    Some((head, _)) if dialect.quirks.rs274() && ACTIVE.contains(&head.as_str()) => {}
                    _ => said.before.extend(comment(&text)),
                }
            }
            Item::Skip(_, range) => {
                let message = "block delete: whether the block runs depends on a switch; remove the `/` or the block";
                return Err((range, message.to_owned()));
            }
            Item::Word(word) => said.tool_change |= changes_tool(&word, dialect),
            Item::Call(call) if program.text(call.name).eq_ignore_ascii_case("MSG") => {
                let inside = call.arguments.map(|range| program.text(range)).unwrap_or_default();
                let text = inside.trim().trim_matches('"').to_owned();
                if !text.is_empty() {
                    said.before.push(Event::Message(text));
                }
            }
            _ => {}
        }
    }
    Ok(said)
}

/// Whether a word puts a tool into the spindle.
fn changes_tool(word: &Word, dialect: &Dialect) -> bool {
    let (Address::Letter(letter), Value::Number(number)) = (word.address, word.value) else {
        return false;
    };
    let tenths = (number.to_f64() * 10.0).round();
    match letter {
        b'T' => dialect.quirks.tool_word.changes(),
        b'M' if (0.0..1e6).contains(&tenths) => {
            let code = dialect.m(tenths as u32);
            code.is_some_and(|code| code.action == Action::ToolChange)
        }
        _ => false,
    }
}
