//! What a program relies on that the control has at power-on: motion code, plane, distance mode, feed mode, unit of lengths.
//!
//! The state is that of the machine file (`[control] power_on`), else the dialect's. Whatever the program uses before it programs it is
//! listed among the assumptions.
mod reads;

use crate::Settings;
use crate::caller::Part;
use crate::sink::Reporter;
use crate::view::MotionView;
use trunnion_dialect::{Action, Dialect, Plane};
use trunnion_interp::{ControlData, FeedMode, MotionKind, declared_at_power_on, power_on_state};
use trunnion_syntax::{Address, Block, BlockId, Item, Program, Value};

const PLANES: [Action; 3] = [Action::PlaneXy, Action::PlaneZx, Action::PlaneYz];
const DISTANCES: [Action; 2] = [Action::Absolute, Action::Incremental];
const FEEDS: [Action; 3] = [
    Action::FeedPerMinute,
    Action::FeedPerRevolution,
    Action::FeedInverseTime,
];
const MOTIONS: [Action; 6] = [
    Action::Rapid,
    Action::Linear,
    Action::ArcClockwise,
    Action::ArcCounterClockwise,
    Action::Thread,
    Action::VariableThread,
];
const UNITS: [Action; 3] = [Action::Metric, Action::Inch, Action::InchLengthsOnly];

/// The first uses of what the control has at power-on.
pub(crate) struct Start {
    /// What the machine and the settings declare.
    declared: ControlData,
    /// The same with what is assumed.
    in_effect: ControlData,
    /// The first motion to coordinates of the program.
    motion: Option<BlockId>,
    /// The first feed motion.
    feed: Option<BlockId>,
    /// The first arc.
    arc: Option<BlockId>,
    /// The first motion with a length whose unit the program has not named, as far as that is known without its text.
    unit: Option<BlockId>,
    /// The settings assume the usual state.
    usual: bool,
}

impl Start {
    pub(crate) fn new(settings: &Settings<'_>) -> Self {
        Self {
            declared: settings.setup.control.clone(),
            in_effect: settings.control(),
            motion: None,
            feed: None,
            arc: None,
            unit: None,
            usual: settings.assume.power_on,
        }
    }

    /// Takes a motion.
    #[inline]
    pub(crate) fn add(&mut self, view: &MotionView<'_>) {
        if self.arc.is_some() && self.feed.is_some() {
            return;
        }
        let motion = view.motion;
        if matches!(motion.kind, MotionKind::Dwell(_)) {
            return;
        }
        // where the settings name a unit, the text says whether the program does, too
        if self.unit.is_none()
            && (!view.in_force.unit_programmed || self.declared.units.is_some())
            && view.changes_a_length()
        {
            self.unit = Some(motion.block);
        }
        if !motion.machine_coordinates {
            self.motion = self.motion.or(Some(motion.block));
        }
        if motion.is_feed() {
            self.feed = self.feed.or(Some(motion.block));
        }
        if matches!(motion.kind, MotionKind::Arc(_)) {
            self.arc = self.arc.or(Some(motion.block));
        }
    }

    /// The codes of the power-on state that the program relies on, and whether the machine declares them.
    pub(crate) fn relied(&self, program: &Program, dialect: &Dialect) -> [Vec<String>; 2] {
        let mut out = [Vec::new(), Vec::new()];
        if !program.options().format.has_words() {
            return out;
        }
        let state = power_on_state(dialect, &self.in_effect);
        let mut rely = |group: &[Action], own: Action| {
            let code = dialect.codes().iter().find(|code| code.action == own);
            let Some(code) = code else { return };
            let units = group == UNITS.as_slice() && self.declared.units.is_some();
            let declared = units || declared_at_power_on(dialect, &self.declared, group);
            out[usize::from(declared)].push(code.id.clone());
        };
        let mut uses = Uses::of(program, dialect, self);
        let [motion, plane, distance, feed, unit] = reads::reads_first(program, dialect);
        uses.motion |= motion;
        uses.plane |= plane;
        uses.distance |= distance;
        uses.feed |= feed;
        uses.unit |= unit;
        if let (true, Some(motion)) = (uses.motion, state.motion) {
            rely(&MOTIONS, motion);
        }
        if uses.plane {
            rely(
                &PLANES,
                match state.coordinates.plane() {
                    Plane::Xy => Action::PlaneXy,
                    Plane::Zx => Action::PlaneZx,
                    Plane::Yz => Action::PlaneYz,
                },
            );
        }
        if uses.unit {
            let inch = state.coordinates.unit_mm() != 1.0;
            rely(&UNITS, if inch { Action::Inch } else { Action::Metric });
        }
        if uses.distance {
            let incremental = state.coordinates.incremental();
            rely(
                &DISTANCES,
                if incremental {
                    Action::Incremental
                } else {
                    Action::Absolute
                },
            );
        }
        if uses.feed {
            rely(
                &FEEDS,
                match state.feed.mode() {
                    FeedMode::PerMinute => Action::FeedPerMinute,
                    FeedMode::PerRevolution => Action::FeedPerRevolution,
                    FeedMode::InverseTime => Action::FeedInverseTime,
                },
            );
        }
        out
    }

    /// Of a subprogram that is run alone: its first motion, and the codes of motion, plane and distance that it relies on. Nothing says what is in
    /// effect where it is called, unless the settings assume the usual state.
    pub(crate) fn of_caller(&self, out: &Reporter<'_>) -> Option<(BlockId, Vec<String>)> {
        let motion = self.motion.filter(|_| !self.usual && out.part() == Part::Called)?;
        let dialect = out.dialect();
        // a file that only defines subprograms has its own finding: it is entered with unknown arguments
        if dialect.quirks.rs274() && crate::caller::only_defines(out.program()) {
            return None;
        }
        let [codes, _] = self.relied(out.program(), dialect);
        let groups = [&MOTIONS[..], &PLANES, &DISTANCES];
        let modal = |id: &String| {
            let code = dialect.codes().iter().find(|code| code.id == *id);
            code.is_some_and(|code| groups.iter().any(|group| group.contains(&code.action)))
        };
        let codes: Vec<String> = codes.into_iter().filter(modal).collect();
        (!codes.is_empty()).then_some((motion, codes))
    }

    /// The same as assumptions: that of the unit, which all else depends on, and the others.
    pub(crate) fn assumptions(&self, program: &Program, dialect: &Dialect) -> [Vec<String>; 2] {
        let mut out = [Vec::new(), Vec::new()];
        let is_unit = |id: &String| {
            let code = dialect.codes().iter().find(|code| code.id == *id);
            code.is_some_and(|code| UNITS.contains(&code.action))
        };
        for (codes, how) in self
            .relied(program, dialect)
            .into_iter()
            .zip(["not declared", "declared"])
        {
            let (unit, rest): (Vec<_>, Vec<_>) = codes.into_iter().partition(is_unit);
            for (out, codes) in out.iter_mut().zip([unit, rest]) {
                if !codes.is_empty() {
                    out.push(format!("{} at power-on ({how})", codes.join(" ")));
                }
            }
        }
        out
    }
}

/// Which groups of codes a program uses before it programs one of them, in the order of its text.
struct Uses {
    motion: bool,
    plane: bool,
    distance: bool,
    feed: bool,
    unit: bool,
}

impl Uses {
    fn of(program: &Program, dialect: &Dialect, start: &Start) -> Self {
        let after = |first: Option<BlockId>, block: BlockId| first.is_none_or(|first| block.0 > first.0);
        let mut uses = Self {
            motion: start.motion.is_some(),
            plane: false,
            distance: start.motion.is_some(),
            feed: start.feed.is_some(),
            unit: start.unit.is_some(),
        };
        let mut plane_open = true;
        for block in program.blocks() {
            let id = block.id();
            let settled = [
                !plane_open,
                !(uses.distance || uses.motion) || after(start.motion, id),
                !uses.feed || after(start.feed, id),
                !uses.unit || after(start.unit, id) || start.declared.units.is_none(),
            ];
            if settled == [true; 4] {
                break;
            }
            let codes = actions(&block, dialect);
            let has = |group: &[Action]| codes.iter().any(|action| group.contains(action));
            if !settled[0] {
                let used = codes.iter().copied().any(needs_plane) || start.arc == Some(id);
                let programmed = has(&PLANES);
                uses.plane = used && !programmed;
                plane_open = !used && !programmed;
            }
            uses.motion &= settled[1] || !(has(&MOTIONS) || codes.iter().any(|code| moves_itself(*code)));
            uses.distance &= settled[1] || !has(&DISTANCES);
            uses.feed &= settled[2] || !has(&FEEDS);
            uses.unit &= settled[3] || !has(&UNITS);
        }
        uses
    }
}

/// Whether a code needs no motion code beside it.
fn moves_itself(action: Action) -> bool {
    action.is_hole_cycle()
        || action.is_pass_cycle()
        || matches!(
            action,
            Action::ReferenceReturn
                | Action::ReferenceReturnOther
                | Action::ReferenceFrom
                | Action::FixedPoint
                | Action::NotModelled
        )
}

/// Whether what a code does depends on the plane.
fn needs_plane(action: Action) -> bool {
    action.is_hole_cycle()
        || action.is_pass_cycle()
        || matches!(
            action,
            Action::CompensationLeft | Action::CompensationRight | Action::RotationOn | Action::PolarOn
        )
}

/// What the G codes of a block do.
fn actions(block: &Block<'_>, dialect: &Dialect) -> Vec<Action> {
    let code = |item| match item {
        Item::Word(word) if word.address == Address::Letter(b'G') => match word.value {
            Value::Number(number) => {
                let tenths = (number.to_f64() * 10.0).round();
                (0.0..10_000.0)
                    .contains(&tenths)
                    .then(|| dialect.g(tenths as u32))
                    .flatten()
            }
            _ => None,
        },
        _ => None,
    };
    block.items().filter_map(code).map(|code| code.action).collect()
}

#[cfg(test)]
mod tests;
