//! What a program or code that is not modelled could read at its place: the modal state, and the variables that are known.
use crate::{Argument, FeedMode, ModalState};
use trunnion_dialect::Plane;

/// The state before and after a block. Two runs do the same at something that is not modelled only if both states are the same.
#[derive(Clone, Debug)]
pub struct Situation {
    state: ModalState,
    to_r: bool,
    /// How the coordinates are turned, scaled or polar: [`crate::Interpreter::turned`].
    turned: Vec<f64>,
    /// What the active cycle has kept.
    cycle: Vec<Argument>,
}

impl Situation {
    pub(crate) fn new(state: &ModalState, to_r: bool, turned: Vec<f64>, cycle: Vec<Argument>) -> Self {
        let state = state.clone();
        Self {
            state,
            to_r,
            turned,
            cycle,
        }
    }

    /// The first setting that differs: name, before, after. `feed_counts`: whether F must be the same.
    pub fn difference(&self, other: &Self, feed_counts: bool) -> Option<(&'static str, String, String)> {
        if self.equals(other) {
            return None;
        }
        let (a, b) = (self.settings(feed_counts), other.settings(feed_counts));
        a.into_iter()
            .zip(b)
            .find(|((_, a), (_, b))| a != b)
            .map(|((name, a), (_, b))| (name, written(&a), written(&b)))
    }

    /// Whether every setting is the same number, as it is nearly always: nothing is put into words for that.
    fn equals(&self, other: &Self) -> bool {
        let (a, b) = (&self.state, &other.state);
        (self.to_r, &self.turned, &self.cycle) == (other.to_r, &other.turned, &other.cycle)
            && (a.motion, a.compensation, a.tool.number()) == (b.motion, b.compensation, b.tool.number())
            && (a.coordinates, a.tool_axis) == (b.coordinates, b.tool_axis)
            && (a.feed, a.length, a.spindle.rpm()) == (b.feed, b.length, b.spindle.rpm())
            && a.zero == b.zero
    }

    /// Each setting by name. Numbers are compared to a relative 1e-9; unknown values are equal.
    fn settings(&self, feed_counts: bool) -> Vec<(&'static str, Vec<Argument>)> {
        let state = &self.state;
        let flag = |is_on: bool| vec![Argument::code(if is_on { "on" } else { "off" })];
        let number = |value: Option<f64>| vec![Argument::number("", value.unwrap_or(f64::NAN))];
        let mut settings = vec![
            ("incremental programming", flag(state.coordinates.incremental())),
            ("absolute arc centres", flag(state.coordinates.arc_centre_absolute())),
            ("the unit of lengths", number(Some(state.coordinates.unit_mm()))),
            ("the unit of feeds", number(Some(state.feed.unit_mm()))),
            (
                "the working plane",
                vec![Argument::code(plane(state.coordinates.plane()))],
            ),
            (
                "the motion code",
                vec![Argument::code(
                    state.motion.map_or("none", trunnion_dialect::Action::name),
                )],
            ),
            (
                "the return level of cycles",
                vec![Argument::code(if self.to_r { "R" } else { "initial" })],
            ),
            (
                "the side of the cutter radius compensation",
                number(Some(f64::from(state.compensation))),
            ),
            (
                "the work offset",
                vec![Argument::code(state.zero.offset().unwrap_or("none").to_owned())],
            ),
            (
                "the zero point",
                state
                    .zero
                    .values()
                    .iter()
                    .map(|value| Argument::number("", *value))
                    .collect(),
            ),
            (
                "the turn or scale of the coordinates",
                self.turned.iter().map(|value| Argument::number("", *value)).collect(),
            ),
            ("the data of the active cycle", self.cycle.clone()),
            ("the active tool length", number(state.length.mm())),
            (
                "which tool's length is active",
                vec![Argument::code(state.length.of().to_string())],
            ),
            ("the tool", number(state.tool.number().map(f64::from))),
            ("tool centre point control", flag(state.tool_axis.tcp())),
            ("programming by tool vectors", flag(state.tool_axis.vectors())),
            ("the spindle's speed", number(state.spindle.rpm())),
        ];
        if feed_counts {
            settings.push(("the meaning of F", vec![Argument::code(mode(state.feed.mode()))]));
            settings.push(("the feed", number(state.feed.value())));
        }
        settings
    }
}

fn written(words: &[Argument]) -> String {
    words.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

fn plane(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "G17",
        Plane::Zx => "G18",
        Plane::Yz => "G19",
    }
}

fn mode(mode: FeedMode) -> &'static str {
    match mode {
        FeedMode::PerMinute => "per minute",
        FeedMode::PerRevolution => "per revolution",
        FeedMode::InverseTime => "inverse time",
    }
}
