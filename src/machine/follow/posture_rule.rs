//! The documented rules by which controls pick one of several postures for a tool vector.
//!
//! * generic: no control, but Trunnion's own rule: the posture that the slowest rotary axis reaches soonest; ties by the smaller first,
//!   then the smaller second move, then the value nearer zero.
//! * fanuc: the smaller move of the master axis, then of the slave, then the master nearer 0 (modulo 360 deg), then the slave; the
//!   master carries the slave, and on a machine with one axis on each side the table comes first (Series 30i operator's manual, tool
//!   centre point control type 2, and the same order for G53.1).
//! * mitsubishi: passing type 1 keeps the sign of the tilting axis (from the pole: the wider stroke, then minus), passing type 2 takes the
//!   smaller move of the other axis (M700V programming manual, G43.4/G43.5, movement near the singular point).
//! * heidenhain: of the postures within the travel the one with the shortest path from the present position (TNC7 user's manual, tilting
//!   solution without SYM or SEQ); taken as the one whose moves are both no larger, since the manual does not say how moves of two axes
//!   are weighed. SEQ+ and SEQ- are in [`crate::follow::requests`].
//! * shortest: the posture whose moves are both the smaller ones; where neither is, the rule says nothing.
use crate::{Machine, Side};
use core::cmp::Ordering;

/// Differences below this are ties, rad or s: rounding must not choose a posture.
pub(crate) const TIE: f64 = 1e-9;

/// The rule by which a control picks a posture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PostureRule {
    /// Trunnion's own.
    Generic,
    /// The posture whose moves are both the smaller ones.
    Shortest,
    /// Fanuc's four steps.
    Fanuc,
    /// Mitsubishi's two types of passing the pole.
    Mitsubishi,
    /// Heidenhain's tilting solution.
    Heidenhain,
}

impl PostureRule {
    /// By its name in a machine file.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::NAMES
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, rule)| *rule)
    }
    /// The names in machine files.
    pub(crate) const NAMES: [(&'static str, Self); 5] = [
        ("generic", Self::Generic),
        ("shortest", Self::Shortest),
        ("fanuc", Self::Fanuc),
        ("mitsubishi", Self::Mitsubishi),
        ("heidenhain", Self::Heidenhain),
    ];
    /// The name.
    pub(crate) fn name(self) -> &'static str {
        Self::NAMES
            .iter()
            .find(|(_, rule)| *rule == self)
            .map_or("", |(name, _)| name)
    }
    /// The rule that a control family documents; `None` where nothing is documented, or where the family is programmed without vectors.
    /// A family that is not a control has the generic rule.
    pub(crate) fn of_family(family: &str) -> Option<Self> {
        match family {
            "generic" | "iso-6983" | "apt" => Some(Self::Generic),
            "fanuc-30i" => Some(Self::Fanuc),
            "mitsubishi-m700" => Some(Self::Mitsubishi),
            "heidenhain-klartext" => Some(Self::Heidenhain),
            _ => None,
        }
    }
}

/// The criteria by which two postures are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Time of the slower axis.
    Time,
    /// Move of the rule's first (0) or second (1) axis.
    Move(usize),
    /// Distance from zero of that axis.
    Value(usize),
}

/// How a control picks postures.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The rule; `None`: neither declared nor documented for the family.
    pub rule: Option<PostureRule>,
    /// Whether the machine file names the rule.
    pub declared: bool,
    /// Comparisons that the machine file gives in place of the rule's own; empty: the rule's own.
    pub order: Vec<Criterion>,
    /// Ranges in which the control looks for rotary values: letter, lowest, highest, rad.
    pub range: Vec<(u8, f64, f64)>,
    /// Mitsubishi: type of passing the pole, 1 or 2; `None`: not declared.
    pub passing_type: Option<u8>,
    /// Heidenhain: SEQ- (`true`) or SEQ+; `None`: not set, the shortest path.
    pub solution_negative: Option<bool>,
}

impl Default for Branch {
    fn default() -> Self {
        Self {
            rule: Some(PostureRule::Generic),
            declared: false,
            order: Vec::new(),
            range: Vec::new(),
            passing_type: None,
            solution_negative: None,
        }
    }
}

/// The rotary axes in the order in which a rule looks at them: indices of `Constants::rotary`.
pub(crate) fn precedence(machine: &Machine, rule: PostureRule) -> [usize; 2] {
    let on_table = |index: usize| {
        let rotary = machine.constants.rotary().get(index);
        rotary.is_some_and(|rotary| machine.axes[rotary.joint].side == Side::Table)
    };
    // the master carries the slave: on a table the axis nearer the machine's bed, which is the second from the workpiece
    let both_on_table = on_table(0) && on_table(1);
    if rule == PostureRule::Fanuc && both_on_table {
        [1, 0]
    } else {
        [0, 1]
    }
}

/// A posture with its windings and the cost of moving there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) q: [f64; 2],
    pub(crate) moves: [f64; 2],
    time: f64,
}

impl Candidate {
    /// A place holder.
    pub(crate) const NOWHERE: Self = Self {
        q: [0.0; 2],
        moves: [0.0; 2],
        time: 0.0,
    };

    pub(crate) fn new(machine: &Machine, q: [f64; 2], from: [f64; 2]) -> Self {
        let moves = [(q[0] - from[0]).abs(), (q[1] - from[1]).abs()];
        let slowness = slowness(machine);
        Self {
            q,
            moves,
            time: (moves[0] * slowness[0]).max(moves[1] * slowness[1]),
        }
    }
    fn cost(&self, by: Criterion, axes: [usize; 2], modulo: bool) -> f64 {
        match by {
            Criterion::Time => self.time,
            Criterion::Move(which) => self.moves[axes[which & 1]],
            Criterion::Value(which) => {
                let value = self.q[axes[which & 1]];
                let turn = core::f64::consts::TAU;
                if modulo {
                    (value - turn * (value / turn).round()).abs()
                } else {
                    value.abs()
                }
            }
        }
    }
    /// Lexicographic; differences below [`TIE`] are ties.
    pub(crate) fn compare(&self, other: &Self, order: &[Criterion], axes: [usize; 2], modulo: bool) -> Ordering {
        for &by in order {
            let (mine, theirs) = (self.cost(by, axes, modulo), other.cost(by, axes, modulo));
            if (mine - theirs).abs() > TIE {
                return mine.total_cmp(&theirs);
            }
        }
        Ordering::Equal
    }
    /// Largest difference of a rotary value, rad.
    pub(crate) fn differs(&self, other: &Self) -> f64 {
        (self.q[0] - other.q[0]).abs().max((self.q[1] - other.q[1]).abs())
    }
}

/// Seconds per rad of the rotary axes; 1 for all where a speed is not declared.
fn slowness(machine: &Machine) -> [f64; 2] {
    let mut out = [1.0; 2];
    for (slot, rotary) in out.iter_mut().zip(machine.constants.rotary()) {
        match machine.axes[rotary.joint].max_speed {
            Some(speed) if speed > 0.0 => *slot = 1.0 / speed,
            _ => return [1.0; 2],
        }
    }
    out
}

/// The comparisons of a rule, and whether values count modulo a turn.
pub(crate) fn comparisons(rule: PostureRule) -> (&'static [Criterion], bool) {
    use Criterion::{Move, Time, Value};
    match rule {
        PostureRule::Generic => (&[Time, Move(0), Move(1), Value(0), Value(1)], false),
        PostureRule::Fanuc => (&[Move(0), Move(1), Value(0), Value(1)], true),
        PostureRule::Shortest | PostureRule::Mitsubishi | PostureRule::Heidenhain => (&[], false),
    }
}
