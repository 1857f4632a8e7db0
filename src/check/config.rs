//! Settings of a check: `trunnion.toml` and what the command line adds. No file is opened here.
mod control;
mod file;
mod fix;
mod format;
#[cfg(test)]
mod message_tests;
mod nose;
mod offsets;
mod readings;
mod tool;
mod variables;

pub use fix::{FixCost, FixPoint, FixSettings, FixSource};
pub use format::{FormatCase, FormatSettings, FormatSpacing, FormatZeros};
pub use tool::parse_tool_flag;
pub(crate) use variables::declaration;

use crate::{Assume, Severity};
use trunnion_dialect::{Dialect, Foreign};
use trunnion_geometry::rad;
use trunnion_interp::{ControlData, Interpreter, Setup, power_on_state};
use trunnion_machine::{Machine, Obstacle, Tolerances};

/// Level of a rule in `trunnion.toml`: `[rules] pole-flip = "error"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RuleLevel {
    /// Not reported.
    Allow,
    /// With this severity.
    At(Severity),
}

/// `trunnion.toml` as read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Config {
    /// `machine = "NAME"` or a path relative to the file.
    pub machine: Option<String>,
    /// `dialect = "NAME"`.
    pub dialect: Option<String>,
    /// `dialect_table = "FILE"`: a dialect table of your own, relative to the file, with its bytes in the file.
    pub dialect_table: Option<(String, core::ops::Range<usize>)>,
    /// `[rules]`.
    pub rules: Vec<(String, RuleLevel)>,
    /// `[tolerances]`, names as in [`TOLERANCES`]; they override the machine's.
    pub tolerances: Vec<(String, f64)>,
    /// `[[tool]]`, `[work_offsets]`, `[limits]`.
    pub setup: Setup,
    /// `subprogram_path`: folders of programs that a program may call, relative to the file, with their bytes in the file.
    pub subprogram_path: Vec<(String, core::ops::Range<usize>)>,
    /// `machine_path`: folders of machine files that a comment of a program may name, relative to the file, with their bytes in the file.
    pub machine_path: Vec<(String, core::ops::Range<usize>)>,
    /// `port_to`: dialects of the controls that the programs are meant to run on too.
    pub port_to: Vec<String>,
    /// `assume`: what is taken as zero although it is not declared.
    pub assume: Assume,
    /// `[format]`.
    pub format: FormatSettings,
    /// `[fix]`.
    pub fix: FixSettings,
    /// Axis letters in `[work_offsets]` with their bytes in the file.
    pub offset_axes: Vec<(u8, core::ops::Range<usize>)>,
    /// The bytes of the name of each entry in `[work_offsets]`, the name, and the axis letters that it gives.
    pub offsets: Vec<(core::ops::Range<usize>, String, Vec<u8>)>,
    /// `[[obstacle]]`: added to those of the machine, each with bytes in the file where an axis that the machine lacks is reported.
    pub obstacles: Vec<(Obstacle, core::ops::Range<usize>)>,
}

/// Why `trunnion.toml` cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the file.
    pub span: Option<core::ops::Range<usize>>,
}

impl core::fmt::Display for ConfigError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ConfigError {}

/// Names of `[tolerances]` with what they mean.
pub const TOLERANCES: &[(&str, &str)] = &[
    (
        "tip",
        "path-deviation: how far the tip may leave the programmed segment, mm",
    ),
    (
        "orientation",
        "orientation-deviation: how far the tool axis may leave the great circle, deg",
    ),
    (
        "swept",
        "swept-deviation: how far the upper end of the tool may leave its path, mm",
    ),
    (
        "rotary_ratio",
        "excess-rotary-travel: turn of the rotary axes divided by turn of the tool axis",
    ),
    (
        "linear_ratio",
        "excess-linear-travel: travel of the linear axes divided by travel of the tip",
    ),
    (
        "rapid_ratio",
        "excess-rapid-travel: travel of the rapid motions divided by the direct distance",
    ),
    (
        "pivot",
        "pivot-uncertainty: how far the uncertainty of the rotary axes may move the tip, mm",
    ),
    (
        "clearance",
        "rapid-through-obstacle, reroute-rapid: how far rapid motions stay away from obstacles, mm",
    ),
    ("pole_cone", "pole-flip: half angle of the cone around the pole, deg"),
    ("pole_angle", "pole-flip: change of the rotary axis, deg"),
    (
        "swap_excess",
        "branch-swap: rotary travel more than the cheapest move without a swap, deg",
    ),
    (
        "feed_drop_warning",
        "feed-drop: part of the programmed feed, 0 to 1, below which it is a warning",
    ),
    (
        "feed_drop_error",
        "feed-drop: part of the programmed feed, 0 to 1, below which it is an error",
    ),
];

impl Config {
    /// Reads the text of a `trunnion.toml`.
    pub fn parse(toml: &str) -> Result<Self, ConfigError> {
        file::parse(toml)
    }

    /// Whether the machine that the file names has every axis that the file's work offsets and obstacles name.
    ///
    /// # Errors
    /// The first axis it lacks, with its place.
    pub fn check_axes(&self, machine: &Machine) -> Result<(), ConfigError> {
        let lacks = |letter: u8| machine.axes.iter().all(|axis| axis.letter != letter);
        let carriers = self
            .obstacles
            .iter()
            .filter_map(|(obstacle, span)| Some((obstacle.axis?, span)));
        let offsets = self.offset_axes.iter().map(|(letter, span)| (*letter, span));
        match offsets.chain(carriers).find(|(letter, _)| lacks(*letter)) {
            None => Ok(()),
            Some((letter, span)) => Err(ConfigError {
                message: format!("machine {} has no axis {}", machine.id, char::from(letter)),
                span: Some(span.clone()),
            }),
        }
    }

    /// Whether each work offset of the file gives all of X, Y and Z that the machine has: an axis that is left out would be taken as zero.
    ///
    /// # Errors
    /// The first offset that lacks one, with its place.
    pub fn check_offsets(&self, machine: &Machine) -> Result<(), ConfigError> {
        for (span, name, given) in &self.offsets {
            let has = |letter: &u8| machine.own_axes().any(|(_, axis)| axis.letter == *letter);
            let lacks: Vec<char> = [b'X', b'Y', b'Z']
                .into_iter()
                .filter(|letter| has(letter) && !given.contains(letter))
                .map(char::from)
                .collect();
            if let Some(first) = lacks.first() {
                let letters = lacks.iter().map(char::to_string).collect::<Vec<_>>().join(" and ");
                return Err(ConfigError {
                    message: format!(
                        "{name} lacks {letters}: {} has this axis, and a zero that is not declared is unknown; write for example `{first} = 0.0`",
                        machine.id
                    ),
                    span: Some(span.clone()),
                });
            }
        }
        Ok(())
    }

    /// The machine with this file's tolerances in place of its own, and its obstacles in addition to its own.
    pub fn machine_with_tolerances(&self, machine: &Machine) -> Machine {
        let mut machine = machine.clone();
        for (name, value) in &self.tolerances {
            apply(&mut machine.tolerances, name, *value);
        }
        let obstacles = self.obstacles.iter().map(|(obstacle, _)| obstacle.clone());
        machine.obstacles.0.extend(obstacles);
        machine.most_turned = self.setup.limits.turned();
        machine
    }
}

/// Sets one tolerance by its name in [`TOLERANCES`]; false when there is no such name.
fn apply(tolerances: &mut Tolerances, name: &str, value: f64) -> bool {
    match name {
        "tip" => tolerances.tip_mm = value,
        "orientation" => tolerances.orientation = rad(value),
        "swept" => tolerances.swept_mm = value,
        "rotary_ratio" => tolerances.rotary_ratio = value,
        "linear_ratio" => tolerances.linear_ratio = value,
        "rapid_ratio" => tolerances.rapid_ratio = value,
        "clearance" => tolerances.clearance_mm = Some(value),
        "pivot" => tolerances.pivot_mm = value,
        "pole_cone" => tolerances.pole_cone = rad(value),
        "pole_angle" => tolerances.pole_angle = rad(value),
        "swap_excess" => tolerances.swap_excess = rad(value),
        "feed_drop_warning" => tolerances.feed_drop_warning = value,
        "feed_drop_error" => tolerances.feed_drop_error = value,
        _ => return false,
    }
    true
}

/// How much of a program is judged. Each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scope {
    /// The text, and what the control refuses.
    Language,
    /// The programmed motions.
    Motion,
    /// What the axes of the machine do.
    Machine,
}

impl Scope {
    /// `language`, `motion` or `machine`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Language => "language",
            Self::Motion => "motion",
            Self::Machine => "machine",
        }
    }
}

/// Everything one check needs.
#[derive(Clone)]
pub struct Settings<'a> {
    /// The dialect. Tables live as long as the process, so that a session can be kept without them.
    pub dialect: &'static Dialect,
    /// The machine with tolerances applied, if any.
    pub machine: Option<&'a Machine>,
    /// Tools and offsets.
    pub setup: Setup,
    /// Rule levels, last wins (config, then command line).
    pub rules: Vec<(String, RuleLevel)>,
    /// Dialects that the program is to be ported to: the rule `porting` says what would change its meaning there.
    pub port_to: Vec<String>,
    /// How much is judged, if somebody says so. Default: all that the machine allows, and without a machine the motions.
    pub scope: Option<Scope>,
    /// The dialect is declared, or the text shows it. Where it is the core for want of better, a code of another control is no mistake.
    pub control_known: bool,
    /// The text is not for a control that is supported: it gets one finding and is not read.
    pub foreign: Option<Foreign>,
    /// What is taken as zero although it is not declared.
    pub assume: Assume,
}

impl<'a> Settings<'a> {
    /// Every rule at its own level, no other dialect to be carried over to, and nothing assumed.
    pub fn new(dialect: &'static Dialect, machine: Option<&'a Machine>, setup: Setup) -> Self {
        Self {
            dialect,
            machine,
            setup,
            rules: Vec::new(),
            port_to: Vec::new(),
            scope: None,
            control_known: true,
            foreign: None,
            assume: Assume::default(),
        }
    }

    /// How much is judged.
    pub fn scope(&self) -> Scope {
        self.scope.unwrap_or(if self.machine.is_some() {
            Scope::Machine
        } else {
            Scope::Motion
        })
    }

    /// The machine whose axes are judged.
    pub(crate) fn judged_machine(&self) -> Option<&'a Machine> {
        self.machine.filter(|_| self.scope() == Scope::Machine)
    }

    /// What is known of the control. Where the state at power-on is assumed, a program begins in rapid, as controls are delivered, unless
    /// the machine or the dialect says otherwise.
    pub(crate) fn control(&self) -> ControlData {
        let mut control = self.setup.control.clone();
        // not in the setup itself: programs are compared with what their own words say alone
        control.tool_change = self.machine.and_then(|machine| machine.control.tool_change);
        if self.assume.power_on && power_on_state(self.dialect, &control).motion.is_none() {
            control.power_on.get_or_insert_default().push("G0".to_owned());
        }
        control
    }

    /// At the start of a program, as the machine declares its codes. Without a machine, axes that the program never names stand still.
    pub fn interpreter(&self) -> Interpreter<'static> {
        let codes = self.machine.map(Machine::clamp_codes).unwrap_or_default();
        let unnamed_stand = self.machine.is_none();
        let same = codes == self.setup.control.clamp_codes
            && unnamed_stand == self.setup.unnamed_stand
            && self.setup.enter_definitions;
        let moves = self
            .machine
            .is_some_and(|machine| machine.control.tool_change.is_some());
        if same && !moves && !self.assume.power_on {
            return Interpreter::new(self.dialect, &self.setup);
        }
        let mut setup = self.setup.clone();
        setup.control = self.control();
        setup.control.clamp_codes = codes;
        setup.unnamed_stand = unnamed_stand;
        setup.enter_definitions = true;
        Interpreter::new(self.dialect, &setup)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_tolerance_can_be_set() {
        for (name, _) in TOLERANCES {
            assert!(apply(&mut Tolerances::default(), name, 1.5), "{name}");
        }
        assert!(!apply(&mut Tolerances::default(), "tipp", 0.5));
    }
}
