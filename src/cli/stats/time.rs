//! How long a program takes: in all, by tool and operation, where it is slow, and why.
use crate::cli::{legs::flat_setup, load::Loaded, verdict::counted};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use trunnion_interp::ModalState;
use trunnion_machine::{Leg, Machine, RapidPath};
use trunnion_planner::{Listener, Timed, time};
use trunnion_syntax::{BlockId, LineIndex};

/// How many slow places are shown.
const WORST: usize = 10;
/// Most operations that are kept apart.
const OPERATIONS: usize = 2000;

/// Optimistic and planned time, s; `None` where some motion's is unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    low: f64,
    high: Option<f64>,
    low_known: bool,
}

impl Default for Span {
    fn default() -> Self {
        Self {
            low: 0.0,
            high: Some(0.0),
            low_known: true,
        }
    }
}

impl Span {
    fn add(&mut self, timed: &Timed) {
        match timed.seconds[0] {
            Some(low) => self.low += low,
            None => self.low_known = false,
        }
        self.high = self.high.zip(timed.seconds[1]).map(|(a, b)| a + b);
    }

    /// Both ends, s.
    pub(super) fn interval(&self) -> Option<[f64; 2]> {
        let high = self.high.filter(|high| self.low_known && high.is_finite())?;
        Some([self.low.min(high), high])
    }

    fn json(&self) -> [Option<f64>; 2] {
        [self.low_known.then_some(self.low), self.high]
    }

    fn text(&self) -> String {
        match (self.low_known, self.high) {
            (true, Some(high)) => format!("{} to {}", seconds(self.low), seconds(high)),
            (true, None) => format!("at least {}; not planned, see below", seconds(self.low)),
            _ => format!("unknown; at least {}", seconds(self.low)),
        }
    }
}

/// Motions with one tool, spindle speed and zero point, one after the other.
#[derive(Clone, Debug, Default)]
struct Operation {
    line: u32,
    last_line: u32,
    tool: Option<u32>,
    spindle_rpm: Option<f64>,
    span: Span,
}

/// A stretch of feed motions that run below 80 % of F.
#[derive(Clone, Debug)]
struct Place {
    line: u32,
    last_line: u32,
    /// More than at F, s.
    lost: f64,
    share: f64,
    reached: f64,
    feed: f64,
    limited_by: String,
    turns_only: bool,
}

/// What is remembered of a leg until its time is known.
struct Before {
    tool: Option<u32>,
    rpm: Option<f64>,
    zero: [f64; 9],
}

/// The times of a program.
pub(super) struct Times<'a> {
    machine: &'a Machine,
    loaded: &'a Loaded,
    index: LineIndex,
    whole: Span,
    tools: BTreeMap<Option<u32>, Span>,
    operations: Vec<Operation>,
    zero: [f64; 9],
    waiting: std::collections::VecDeque<Before>,
    feed_seconds: f64,
    below: f64,
    places: Vec<Place>,
    place: Option<(Place, u32)>,
    unknown: u64,
    first_unknown: Option<u32>,
    unplanned: u64,
    from_nowhere: u64,
    waits: f64,
}

impl<'a> Times<'a> {
    /// Runs the program.
    pub(super) fn of(loaded: &'a Loaded, machine: &'a Machine) -> Self {
        let mut times = Self {
            machine,
            loaded,
            index: LineIndex::new(loaded.program.source()),
            whole: Span::default(),
            tools: BTreeMap::new(),
            operations: Vec::new(),
            zero: [0.0; 9],
            waiting: std::collections::VecDeque::new(),
            feed_seconds: 0.0,
            below: 0.0,
            places: Vec::new(),
            place: None,
            unknown: 0,
            first_unknown: None,
            unplanned: 0,
            from_nowhere: 0,
            waits: 0.0,
        };
        let resolved = &loaded.resolved;
        let setup = flat_setup(loaded, machine);
        time(&loaded.program, resolved.dialect, &setup, machine, &mut times);
        times.close();
        times
    }

    /// Lowest and highest time of the program, s.
    pub(super) fn interval(&self) -> Option<[f64; 2]> {
        self.whole.interval()
    }

    fn line(&self, block: BlockId) -> u32 {
        let program = &self.loaded.program;
        self.index
            .line_column(program.source(), program.block(block).range().start)
            .0
    }

    fn close(&mut self) {
        if let Some((place, _)) = self.place.take() {
            self.places.push(place);
            self.places.sort_by(|a, b| b.lost.total_cmp(&a.lost));
            self.places.truncate(WORST);
        }
    }

    /// A slow motion joins the place before it, or opens one.
    fn slow(&mut self, timed: &Timed, line: u32) {
        let (Some(share), Some(feed), Some(reached), Some(own)) =
            (timed.share(), timed.feed, timed.reached, timed.seconds[1])
        else {
            return self.close();
        };
        if share >= 0.8 {
            return self.close();
        }
        let lost = own - timed.length / (feed / 60.0);
        let limited_by = timed.limited_by(self.machine);
        match &mut self.place {
            Some((place, last)) if *last + 1 == timed.motion => {
                place.last_line = line;
                place.lost += lost;
                if share < place.share {
                    (place.share, place.reached, place.feed, place.limited_by) = (share, reached, feed, limited_by);
                }
                *last = timed.motion;
            }
            _ => {
                self.close();
                let turns_only = timed.turns_only;
                let place = Place {
                    line,
                    last_line: line,
                    lost,
                    share,
                    reached,
                    feed,
                    limited_by,
                    turns_only,
                };
                self.place = Some((place, timed.motion));
            }
        }
    }

    pub(super) fn json(&self) -> Value {
        let tools = self
            .tools
            .iter()
            .map(|(tool, span)| json!({ "tool": tool, "time_s": span.json() }));
        let operations = self.operations.iter().map(|operation| {
            json!({
                "line": operation.line,
                "last_line": operation.last_line,
                "tool": operation.tool,
                "spindle_rpm": operation.spindle_rpm,
                "time_s": operation.span.json(),
            })
        });
        let places = self.places.iter().map(|place| {
            let unit = if place.turns_only { "deg_min" } else { "mm_min" };
            json!({
                "line": place.line,
                "last_line": place.last_line,
                "lost_s": place.lost,
                "share": place.share,
                format!("feed_{unit}"): place.feed,
                format!("reached_feed_{unit}"): place.reached,
                "limited_by": place.limited_by,
            })
        });
        json!({
            "time_s": self.whole.json(),
            "waits_s": self.waits,
            "feed_time_s": self.feed_seconds,
            "below_80_percent_s": self.below,
            "below_80_percent_share": (self.feed_seconds > 0.0).then(|| self.below / self.feed_seconds),
            "tools": tools.collect::<Vec<_>>(),
            "operations": operations.collect::<Vec<_>>(),
            "worst": places.collect::<Vec<_>>(),
            "motions_of_unknown_time": self.unknown,
            "motions_not_planned": self.unplanned,
            "motions_from_unknown_position": self.from_nowhere,
            "not_declared": self.not_declared(),
        })
    }

    /// What the machine file leaves open, one sentence each.
    fn not_declared(&self) -> Vec<String> {
        let mut out = Vec::new();
        let letters = |missing: &dyn Fn(&trunnion_machine::Axis) -> bool| -> String {
            let axes = self.machine.own_axes().filter(|(_, axis)| missing(axis));
            axes.map(|(_, axis)| char::from(axis.letter).to_string())
                .collect::<Vec<_>>()
                .join(" ")
        };
        let mut say = |letters: String, what: &str| {
            if !letters.is_empty() {
                out.push(format!("{what} of {letters}"));
            }
        };
        let acceleration = letters(&|axis| axis.max_acceleration.is_none());
        say(acceleration, "the acceleration (amax)");
        let jerk = letters(&|axis| axis.extra.max_jerk.is_none());
        say(jerk, "the jerk (jmax; taken as unlimited)");
        let control = &self.machine.control;
        if control.corner_model.is_none() {
            out.push("the model of corners ([control] corner): anything from full speed to a stop".to_owned());
        }
        if control.rapid == RapidPath::Undeclared {
            out.push(
                "how axes move in a rapid ([control] rapid): between each at its own speed and all together".to_owned(),
            );
        }
        if control.planning.tool_change_time.is_none() {
            out.push("the time of a tool change ([control] planner.tool_change_time): taken as none".to_owned());
        }
        out
    }

    pub(super) fn text(&self) -> String {
        let mut out = String::new();
        let mut row = |name: &str, text: &str| {
            let _ = writeln!(out, "  {name:<12}  {text}");
        };
        row("planned", &self.whole.text());
        if self.waits > 0.0 {
            row(
                "",
                &format!("{} of it for tool changes and M codes", seconds(self.waits)),
            );
        }
        if self.feed_seconds > 0.0 {
            let share = 100.0 * self.below / self.feed_seconds;
            row("", &format!("{share:.1} % of the time in feed is below 80 % of F"));
        }
        for (tool, span) in &self.tools {
            let name = tool.map_or("no tool".to_owned(), |tool| format!("T{tool}"));
            row(&name, &span.text());
        }
        let shown = self.operations.len().min(20);
        for operation in &self.operations[..shown] {
            let tool = operation.tool.map_or(String::new(), |tool| format!("T{tool} "));
            let speed = operation.spindle_rpm.map_or(String::new(), |rpm| format!("S{rpm} "));
            let name = format!("{}-{}", operation.line, operation.last_line);
            row(&name, &format!("{tool}{speed}{}", operation.span.text()));
        }
        if shown < self.operations.len() {
            row("", &format!("and {} more operations", self.operations.len() - shown));
        }
        for (index, place) in self.places.iter().enumerate() {
            let lines = if place.line == place.last_line {
                format!("line {}", place.line)
            } else {
                format!("lines {}-{}", place.line, place.last_line)
            };
            let unit = if place.turns_only { "deg/min" } else { "mm/min" };
            let text = format!(
                "{lines}: {} lost, down to {:.0} % of F{:.0} {unit}, limited by {}",
                seconds(place.lost),
                100.0 * place.share,
                place.feed,
                place.limited_by
            );
            row(if index == 0 { "slowest" } else { "" }, &text);
        }
        if let Some(line) = self.first_unknown {
            let motions = counted(self.unknown, "motion");
            row("unknown", &format!("the time of {motions}, the first in line {line}"));
        }
        for (index, missing) in self.not_declared().iter().enumerate() {
            row(if index == 0 { "not declared" } else { "" }, missing);
        }
        out
    }
}

/// Enough digits for a short program.
fn seconds(value: f64) -> String {
    if value < 59.95 {
        format!("{value:.3} s")
    } else {
        super::show::duration(value)
    }
}

impl Listener for Times<'_> {
    fn leg(&mut self, leg: &Leg, _: &ModalState, _: u32) {
        let motion = &leg.motion;
        self.waiting.push_back(Before {
            tool: motion.tool,
            rpm: motion.mean_rpm(),
            zero: motion.zero,
        });
    }

    fn timed(&mut self, timed: &Timed, wait: bool) {
        self.whole.add(timed);
        let line = self.line(timed.block);
        if wait {
            self.waits += timed.seconds[1].unwrap_or(0.0);
            return;
        }
        let Some(before) = self.waiting.pop_front() else { return };
        self.tools.entry(before.tool).or_default().add(timed);
        let same = self
            .operations
            .last()
            .is_some_and(|last| last.tool == before.tool && last.spindle_rpm == before.rpm && self.zero == before.zero);
        if !same && self.operations.len() < OPERATIONS {
            self.operations.push(Operation {
                line,
                tool: before.tool,
                spindle_rpm: before.rpm,
                ..Operation::default()
            });
        }
        self.zero = before.zero;
        if let Some(operation) = self.operations.last_mut() {
            operation.last_line = line;
            operation.span.add(timed);
        }
        if timed.from_nowhere {
            self.from_nowhere += 1;
        }
        match timed.seconds {
            [None, _] => {
                self.unknown += 1;
                self.first_unknown.get_or_insert(line);
            }
            [_, None] => self.unplanned += 1,
            [_, Some(own)] if timed.feed.is_some() => {
                self.feed_seconds += own;
                self.below += timed.below;
            }
            _ => {}
        }
        self.slow(timed, line);
    }

    fn reads_faults(&self) -> bool {
        false
    }
}
