//! The machine file as it is written: the shape of schema `ncmachine/1`, units as in the file. Unknown keys are errors.
use crate::file::obstacle::RawObstacle;
use core::fmt;
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use std::collections::BTreeMap;
use toml::Spanned;

/// A number and its place in the file.
pub(crate) type Number = Spanned<f64>;
/// A word and its place in the file.
pub(crate) type Word = Spanned<String>;
/// A vector and its place in the file.
pub(crate) type Triple = Spanned<[f64; 3]>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMachine {
    pub(crate) schema: Word,
    pub(crate) name: Option<String>,
    #[serde(default)]
    pub(crate) sources: Vec<String>,
    #[serde(default)]
    pub(crate) units: RawUnits,
    #[serde(default)]
    pub(crate) spindle: RawSpindle,
    pub(crate) axis: Spanned<Vec<Spanned<RawAxis>>>,
    #[serde(default)]
    pub(crate) control: RawControl,
    #[serde(default)]
    pub(crate) tolerances: RawTolerances,
    #[serde(default)]
    pub(crate) body: Vec<RawBody>,
    #[serde(default)]
    pub(crate) obstacle: Vec<Spanned<RawObstacle>>,
    #[serde(default)]
    pub(crate) check: Vec<Spanned<RawCheck>>,
    #[serde(default)]
    pub(crate) unknown: Vec<Word>,
}

/// What the axes must yield: a pose, or travels and speeds written a second time.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCheck {
    pub(crate) say: Option<String>,
    #[serde(default)]
    pub(crate) joints: BTreeMap<Word, Number>,
    pub(crate) tool_length: Option<Number>,
    pub(crate) tip: Option<Triple>,
    pub(crate) axis: Option<Triple>,
    pub(crate) within: Option<Number>,
    #[serde(default)]
    pub(crate) travel: BTreeMap<Word, Spanned<RawLimits>>,
    #[serde(default)]
    pub(crate) speed: BTreeMap<Word, Number>,
    #[serde(default)]
    pub(crate) acceleration: BTreeMap<Word, Number>,
    #[serde(default)]
    pub(crate) words: BTreeMap<Word, Word>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawUnits {
    pub(crate) length: Option<Word>,
    pub(crate) angle: Option<Word>,
    pub(crate) time: Option<Word>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSpindle {
    pub(crate) tool_axis: Option<Triple>,
    pub(crate) gauge_point: Option<Triple>,
    pub(crate) note: Option<String>,
    pub(crate) source: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawAxis {
    pub(crate) letter: Word,
    pub(crate) kind: Option<RawKind>,
    pub(crate) side: Option<RawSide>,
    pub(crate) dir: Option<Triple>,
    pub(crate) point: Option<Triple>,
    pub(crate) sign: Option<Number>,
    pub(crate) limits: Option<Spanned<RawLimits>>,
    pub(crate) limit_margin: Option<Number>,
    #[serde(default)]
    pub(crate) wrap: RawWrap,
    #[serde(default, rename = "dyn")]
    pub(crate) dynamics: RawDynamics,
    #[serde(default)]
    pub(crate) clamp: bool,
    pub(crate) clamp_codes: Option<RawClampCodes>,
    #[serde(default)]
    pub(crate) cable: bool,
    #[serde(default)]
    pub(crate) spindle: bool,
    pub(crate) mode: Option<Spanned<RawMode>>,
    pub(crate) follow: Option<Word>,
    pub(crate) hold: Option<Number>,
    #[serde(default)]
    pub(crate) unknown: Vec<Word>,
    pub(crate) resolution: Option<Number>,
    #[serde(default)]
    pub(crate) uncertainty: RawUncertainty,
    pub(crate) note: Option<String>,
    pub(crate) source: Option<String>,
}

/// Codes that clamp an axis and release it: `{ on = "M10", off = "M11" }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawClampCodes {
    pub(crate) on: Word,
    pub(crate) off: Word,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawKind {
    Linear,
    Rotary,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawSide {
    Table,
    Head,
}

#[derive(Deserialize, Clone, Copy, Default)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawWrap {
    #[default]
    Literal,
    Shortest,
    ModuloSign,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawMode {
    Radius,
    Diameter,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDynamics {
    pub(crate) vmax: Option<Number>,
    pub(crate) amax: Option<Number>,
    pub(crate) jmax: Option<Number>,
    pub(crate) kv: Option<Number>,
    pub(crate) kff: Option<Number>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawUncertainty {
    pub(crate) point: Option<Number>,
    pub(crate) dir_arcsec: Option<Number>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawControl {
    pub(crate) family: Option<Word>,
    pub(crate) tcp: Option<RawTcp>,
    pub(crate) branch: Option<RawBranch>,
    pub(crate) pole: Option<RawPole>,
    pub(crate) rapid: Option<RawRapid>,
    pub(crate) feed: Option<Word>,
    pub(crate) corner: Option<RawCorner>,
    pub(crate) planner: Option<RawPlanner>,
    pub(crate) servo: Option<RawServo>,
    pub(crate) tcp_codes: Option<RawTcpCodes>,
    #[serde(default)]
    pub(crate) posture_words: RawPostureWords,
    pub(crate) units: Option<Word>,
    pub(crate) reference_points: Option<Vec<BTreeMap<Word, Number>>>,
    pub(crate) fixed_points: Option<Vec<BTreeMap<Word, Number>>>,
    pub(crate) peck_clearance: Option<Number>,
    pub(crate) chip_break_retract: Option<Number>,
    pub(crate) main_spindle: Option<Number>,
    pub(crate) drilling_axis: Option<Word>,
    pub(crate) roughing_escape: Option<Word>,
    pub(crate) thread_pull_out: Option<Number>,
    pub(crate) roughing_retract: Option<Number>,
    pub(crate) thread_least_cut: Option<Number>,
    pub(crate) thread_finish: Option<Number>,
    pub(crate) spline_arcs: Option<Number>,
    pub(crate) tool_change: Option<BTreeMap<Word, Number>>,
    pub(crate) power_on: Option<Vec<Word>>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPostureWords {
    #[serde(default)]
    pub(crate) turn: BTreeMap<Word, Number>,
    pub(crate) status: Option<RawStatusBit>,
    #[serde(default)]
    pub(crate) solutions: BTreeMap<Word, Word>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStatusBit {
    pub(crate) bit: Number,
    pub(crate) axis: Word,
    pub(crate) set: Word,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTcpCodes {
    #[serde(default)]
    pub(crate) on: Vec<Word>,
    #[serde(default)]
    pub(crate) off: Vec<Word>,
    #[serde(default)]
    pub(crate) at_start: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTcp {
    pub(crate) path: Option<Word>,
    pub(crate) orientation: Option<RawOrientation>,
    pub(crate) feed: Option<Word>,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawOrientation {
    Joint,
    GreatCircle,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBranch {
    pub(crate) rule: Option<Word>,
    #[serde(default)]
    pub(crate) order: Vec<Word>,
    #[serde(default)]
    pub(crate) range: BTreeMap<Word, Spanned<[f64; 2]>>,
    pub(crate) seq: Option<Word>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPole {
    pub(crate) cone: Option<Number>,
    pub(crate) action: Option<Word>,
    pub(crate) passing_type: Option<Number>,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawRapid {
    Synchronous,
    Dogleg,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCorner {
    pub(crate) model: Option<Word>,
    #[serde(default)]
    pub(crate) dv: BTreeMap<Word, Number>,
    pub(crate) deviation: Option<Number>,
    pub(crate) speed: Option<Number>,
    pub(crate) tolerance: Option<Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPlanner {
    pub(crate) lookahead: Option<Number>,
    pub(crate) block_time: Option<Number>,
    pub(crate) filter_time: Option<Number>,
    pub(crate) tool_change_time: Option<Number>,
    #[serde(default)]
    pub(crate) m_times: BTreeMap<Word, Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawServo {
    pub(crate) bandwidth: Option<Number>,
    pub(crate) sample_time: Option<Number>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTolerances {
    pub(crate) tip: Option<Number>,
    pub(crate) orientation: Option<Number>,
    pub(crate) swept: Option<Number>,
    pub(crate) rotary_ratio: Option<Number>,
    pub(crate) linear_ratio: Option<Number>,
    pub(crate) rapid_ratio: Option<Number>,
    pub(crate) pivot: Option<Number>,
    pub(crate) collision_near: Option<Number>,
    pub(crate) clearance: Option<Number>,
    pub(crate) pole_cone: Option<Number>,
    pub(crate) pole_angle: Option<Number>,
    pub(crate) swap_excess: Option<Number>,
    pub(crate) feed_drop: Option<Number>,
    pub(crate) feed_drop_error: Option<Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBody {
    pub(crate) carrier: Word,
    pub(crate) mesh: Word,
}

/// `"unbounded"` or `[min, max]`.
#[derive(Clone, Copy)]
pub(crate) enum RawLimits {
    Unbounded,
    Range(f64, f64),
}

impl<'de> Deserialize<'de> for RawLimits {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct LimitsVisitor;
        impl<'de> Visitor<'de> for LimitsVisitor {
            type Value = RawLimits;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("limits: \"unbounded\" or [min, max]")
            }
            fn visit_str<E: de::Error>(self, word: &str) -> Result<RawLimits, E> {
                if word == "unbounded" {
                    Ok(RawLimits::Unbounded)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(word), &self))
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<RawLimits, A::Error> {
                let min = seq.next_element()?.ok_or_else(|| de::Error::invalid_length(0, &self))?;
                let max = seq.next_element()?.ok_or_else(|| de::Error::invalid_length(1, &self))?;
                if seq.next_element::<de::IgnoredAny>()?.is_some() {
                    return Err(de::Error::invalid_length(3, &self));
                }
                Ok(RawLimits::Range(min, max))
            }
        }
        deserializer.deserialize_any(LimitsVisitor)
    }
}
