//! Writes G-code with a post.
use crate::clamps::{Clamping, Step, remark};
use crate::emit::{declaration, plain};
use crate::events::ACTIVE;
use crate::job::{Event, Job, Placed};
use crate::modal::Modal;
use crate::number::number;
use crate::plan::{Mode, Out};
use crate::setting::Setting;
use crate::template::fill;
use crate::{Options, Post, Refused};
use core::fmt::Write;
use trunnion_certify::conversion::Reading;
use trunnion_interp::Setup;
use trunnion_syntax::BlockId;

/// Names of words as the modal memory keeps them.
pub(crate) const WORDS: [&str; 9] = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];

/// Writes G-code.
pub(crate) struct Writer<'a> {
    pub(crate) reading: &'a Reading,
    pub(crate) post: &'a Post,
    pub(crate) mode: Mode<'a>,
    pub(crate) options: &'a Options,
    pub(crate) setup: &'a Setup,
    setting: &'a Setting<'a>,
    pub(crate) clamping: Clamping,
    text: String,
    pub(crate) modal: Modal,
    next_number: u32,
    /// Lines written so far, and which of them make motions of the original program.
    pub(crate) lines: u32,
    pub(crate) moved: Vec<u32>,
    /// Tool centre point control, or compensation of the tool's length, is on.
    pub(crate) ready: bool,
    /// A length was activated, and not cancelled since.
    pub(crate) length_set: bool,
    /// The code of the tool's length, before the first block that moves along the tool.
    pub(crate) length_waits: Option<String>,
    pub(crate) tool: Option<u32>,
    /// Coolant other than through the spindle is on.
    pub(crate) coolant_outside: bool,
    /// A plane other than G17 is in effect, for an arc.
    pub(crate) off_plane: bool,
    pub(crate) zero: [f64; 9],
    /// Axes that the motion at hand must not name, bits from X: see [`trunnion_certify::conversion::left_behind`].
    pub(crate) stays: u16,
    /// The same of each motion.
    pub(crate) all_stay: &'a [u16],
    /// Klartext is written.
    pub(crate) klartext: bool,
}

/// A program as it is written.
pub(crate) struct Written {
    pub(crate) text: String,
    /// Its lines (from 1, ascending) that make motions of the original program.
    pub(crate) moved: Vec<u32>,
    /// What was written that clamps depend on.
    pub(crate) clamping: Clamping,
}

impl<'a> Writer<'a> {
    pub(crate) fn new(
        (reading, all_stay): (&'a Reading, &'a [u16]),
        post: &'a Post,
        setting: &'a Setting<'a>,
        options: &'a Options,
        setup: &'a Setup,
        clamping: Clamping,
    ) -> Self {
        Self {
            reading,
            post,
            mode: setting.mode,
            options,
            setup,
            setting,
            clamping,
            text: String::new(),
            modal: Modal::default(),
            next_number: post.number_from,
            lines: 0,
            moved: Vec::new(),
            ready: false,
            length_set: false,
            length_waits: None,
            tool: None,
            coolant_outside: false,
            off_plane: false,
            zero: [0.0; 9],
            stays: 0,
            all_stay,
            klartext: setting.klartext(),
        }
    }

    pub(crate) fn write(mut self, job: &Job, outs: &[Out]) -> Result<Written, Refused> {
        self.header(job)?;
        for letter in self.setting.clamps_left() {
            let text = self.setting.machine.map(|machine| remark(machine, letter));
            self.comment(&text.unwrap_or_default())?;
        }
        self.joints_at_start()?;
        let names_offset = job
            .events
            .iter()
            .any(|placed| matches!(placed.event, Event::WorkOffset(_)));
        if !names_offset {
            let name = self.options.work_offset(Some(self.post)).to_owned();
            self.work_offset(&name, None)?;
        }
        for placed in &job.events {
            self.event(placed, outs)?;
        }
        self.not_ready()?;
        let (options, of) = (self.options, (self.post, self.klartext));
        let work_offset = options.work_offset(Some(self.post)).to_owned();
        self.template("footer", None, |name| self_name(name, job, &work_offset, options, of))?;
        Ok(Written {
            text: self.text,
            moved: self.moved,
            clamping: self.clamping,
        })
    }

    pub(crate) fn refuse(&self, block: Option<BlockId>, message: String) -> Refused {
        match block {
            Some(block) => Refused::at(&self.reading.program, block, message),
            None => Refused::new(message),
        }
    }

    /// Fills a template and writes its lines. A template that the post does not have refuses.
    pub(crate) fn template(
        &mut self,
        key: &str,
        block: Option<BlockId>,
        value: impl Fn(&str) -> Option<String>,
    ) -> Result<(), Refused> {
        let Some(template) = self.post.template(key) else {
            let message = format!(
                "the post for {} has no `{key}`: add it in a post of your own (--post), or remove it from the program",
                self.post.dialect
            );
            return Err(self.refuse(block, message));
        };
        let filled = fill(template, value).map_err(str::to_owned);
        let filled = filled.map_err(|name| {
            let what = if name == "tool" {
                "the number of the tool: load one before the first motion".to_owned()
            } else {
                format!("{{{name}}}")
            };
            self.refuse(
                block,
                format!("the post's `{key}` needs {what}, which the program does not give"),
            )
        })?;
        for line in filled.lines().map(str::trim).filter(|line| !line.is_empty()) {
            self.line(line);
        }
        Ok(())
    }

    /// A line; codes get a block number.
    pub(crate) fn line(&mut self, line: &str) {
        let comment = self.post.template("comment").unwrap_or_default();
        let opens = comment.chars().next();
        let first = line.chars().next();
        let is_code = first.is_some_and(|c| c.is_ascii_alphabetic()) && !line.starts_with('O') && first != opens;
        if self.klartext && self.post.number_step > 0 {
            // every block has its number
            let _ = write!(self.text, "{} ", self.next_number);
            self.next_number += self.post.number_step;
        } else if is_code && self.post.number_step > 0 {
            let _ = write!(self.text, "N{} ", self.next_number);
            self.next_number += self.post.number_step;
        }
        self.text.push_str(line);
        self.text.push('\n');
        self.lines += 1;
    }

    fn comment_text(&self, text: &str) -> String {
        let text = plain(text);
        let text: String = if self.post.template("comment").unwrap_or_default().contains('(') {
            text.chars()
                .map(|c| match c {
                    '(' => '[',
                    ')' => ']',
                    c => c,
                })
                .collect()
        } else {
            text
        };
        // a comment must not command the control: (ABORT,...)
        let head = text.split(',').next().unwrap_or_default().trim().to_ascii_uppercase();
        let linuxcnc = self.post.dialect == "linuxcnc" && text.contains(',');
        // at the end of a line `~` would continue the block
        let text = if self.klartext { text.replace('~', "-") } else { text };
        let speaks = linuxcnc && (ACTIVE.contains(&head.as_str()) || head == "PY") || text.starts_with('$');
        let text = if speaks { format!("- {text}") } else { text };
        if self.post.upper_case {
            text.to_ascii_uppercase()
        } else {
            text
        }
    }

    fn comment(&mut self, text: &str) -> Result<(), Refused> {
        let text = self.comment_text(text);
        self.template("comment", None, |name| (name == "text").then(|| text.clone()))
    }

    fn title(&self, text: &str) -> String {
        let text = self.comment_text(text);
        let template = self.post.template("comment").unwrap_or_default();
        if text.is_empty() {
            return text;
        }
        fill(template, |name| (name == "text").then(|| text.clone())).unwrap_or_default()
    }

    fn header(&mut self, job: &Job) -> Result<(), Refused> {
        let tools: Vec<String> = job
            .tools
            .iter()
            .map(|(number, tool)| self.title(&declaration(*number, tool.as_ref())))
            .collect();
        let units = match self.options.units {
            crate::Units::Mm => "units-mm",
            crate::Units::Inch => "units-inch",
        };
        let units = self.post.template(units).unwrap_or_default().to_owned();
        let feed_mode = self.post.template("feed-per-minute").unwrap_or_default().to_owned();
        let title = self.title(job.name.as_deref().unwrap_or_default());
        let machine = plain(self.setting.machine.map_or("", |machine| machine.name.as_str()));
        let (options, post, klartext) = (self.options, self.post, self.klartext);
        let work_offset = options.work_offset(Some(self.post)).to_owned();
        self.template("header", None, |name| match name {
            "tools" => Some(tools.join("\n")),
            "units" => Some(units.clone()),
            "feed_mode" => Some(feed_mode.clone()),
            "title" => Some(title.clone()),
            "machine" => Some(machine.clone()),
            _ => self_name(name, job, &work_offset, options, (post, klartext)),
        })?;
        self.modal.set("mode", feed_mode);
        Ok(())
    }

    fn work_offset(&mut self, name: &str, block: Option<BlockId>) -> Result<(), Refused> {
        self.template("work-offset", block, |key| {
            (key == "work_offset").then(|| name.to_owned())
        })?;
        let declared = self.setup.work_offsets.iter();
        let mut declared = declared.filter(|offset| offset.name.eq_ignore_ascii_case(name));
        self.zero = declared.next().map_or([0.0; 9], |offset| offset.values);
        self.forget_coordinates();
        Ok(())
    }

    pub(crate) fn forget_coordinates(&mut self) {
        for word in WORDS.into_iter().chain(["vector"]) {
            self.modal.forget(word);
        }
    }

    fn event(&mut self, placed: &Placed, outs: &[Out]) -> Result<(), Refused> {
        let block = Some(placed.block);
        let speed = |rpm: f64| number(rpm, self.post.speed, false);
        match &placed.event {
            Event::Comment(text) => self.comment(text),
            Event::Message(text) if self.post.template("message").is_none() => self.comment(text),
            Event::Message(text) => {
                let text = plain(text).replace(['(', ')', '"'], "'");
                self.template("message", block, |name| (name == "text").then(|| text.clone()))
            }
            Event::Tool(tool) => {
                self.not_ready()?;
                if let Some(plane) = self.usual_plane() {
                    self.line(&plane);
                }
                self.template("tool-change", block, |name| (name == "tool").then(|| tool.to_string()))?;
                self.tool = Some(*tool);
                self.modal_reset();
                Ok(())
            }
            Event::SpindleOn(ccw, rpm) => {
                let (key, rpm) = (
                    if *ccw {
                        "spindle-counter-clockwise"
                    } else {
                        "spindle-clockwise"
                    },
                    speed(*rpm),
                );
                self.template(key, block, |name| (name == "speed").then(|| rpm.clone()))
            }
            Event::Speed(rpm) => {
                let rpm = speed(*rpm);
                self.template("spindle-speed", block, |name| (name == "speed").then(|| rpm.clone()))
            }
            Event::SpindleOff => self.template("spindle-stop", block, |_| None),
            Event::Coolant(coolant) => self.coolant(*coolant, block),
            Event::Path(mode) => self.template(crate::events::path_key(*mode), block, |_| None),
            Event::Own(text) => {
                self.line(text);
                Ok(())
            }
            Event::Stop(optional) => {
                let key = if *optional { "optional-stop" } else { "stop" };
                self.template(key, block, |_| None)
            }
            Event::Auxiliary(code) => {
                self.clamp(Step::Code(*code), placed.block)?;
                self.template("auxiliary", block, |name| (name == "number").then(|| code.to_string()))
            }
            Event::WorkOffset(name) => self.work_offset(name, block),
            Event::Motion(index) => self.motion(&outs[*index], *index, placed.block),
        }
    }

    fn modal_reset(&mut self) {
        self.modal.forget_all();
        let mode = self.post.template("feed-per-minute").unwrap_or_default().to_owned();
        self.modal.set("mode", mode);
    }

    fn motion(&mut self, out: &Out, index: usize, block: BlockId) -> Result<(), Refused> {
        self.stays = self.stays_in(index, block)?;
        match out {
            Out::Left => Ok(()),
            Out::Words { known, led, length } => self.plain_rapid(known, (*led, *length), block),
            Out::Dwell(seconds) => {
                let (s, ms) = (number(*seconds, 3, self.post.point), number(seconds * 1000.0, 0, false));
                self.template("dwell", Some(block), |name| match name {
                    "seconds" => Some(s.clone()),
                    "milliseconds" => Some(ms.clone()),
                    _ => None,
                })?;
                self.moved.push(self.lines);
                Ok(())
            }
            Out::Moves(moves) => {
                if self.waits(index) {
                    self.length_off(block)?;
                } else {
                    self.get_ready(block)?;
                }
                for one in moves {
                    self.one(one, block)?;
                }
                Ok(())
            }
        }
    }
}

/// Names that every header and footer may use.
fn self_name(
    name: &str,
    job: &Job,
    work_offset: &str,
    options: &Options,
    (post, klartext): (&Post, bool),
) -> Option<String> {
    match name {
        "program" => {
            let text = plain(job.name.as_deref().unwrap_or_default());
            Some(if klartext {
                crate::emit_klartext::program_name(&text)
            } else if post.upper_case {
                text.to_ascii_uppercase()
            } else {
                text
            })
        }
        "title" => Some(String::new()),
        "number" => Some(format!("{:04}", options.program_number)),
        "work_offset" => Some(work_offset.to_owned()),
        _ => None,
    }
}
