//! The machine file (TOML, schema `ncmachine/1`, kinematics notes 7): read, checked, turned into mm, rad and s, with clear errors.
use crate::file::absent::complete;
use crate::file::check_rows::verify;
use crate::file::control::control;
use crate::file::gantry::Rails;
use crate::file::obstacle::obstacles;
use crate::file::raw::{Number, RawBody, RawMachine, RawTolerances, RawUnits};
use crate::file::unused_keys::{not_judged, not_used};
use crate::file::validate::{Fault, axis, non_negative, point, positive, unit_vector, usual_direction};
use crate::kinematics::held_axes::Carried;
use crate::{Axis, AxisKind, Body, Constants, Gantry, Home, MAX_AXES, Machine, Side, Tolerances};
use core::ops::Range;
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::AXIS_LETTERS;

/// [`Machine::most_turned`] unless the settings say otherwise.
const MOST_TURNED: u64 = 150_000;

/// Two directions nearer than this are taken as parallel, rad.
const PARALLEL: f64 = 1e-3;

/// Above this condition number of the linear axes the machine is warned about (docs/kinematics.md#linear-axes-for-a-given-tip).
const ILL_CONDITIONED: f64 = 1e3;

/// Why a machine file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the file, where known.
    pub span: Option<Range<usize>>,
}

impl core::fmt::Display for MachineError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for MachineError {}

/// Loads and validates a machine file. `id` is its name for reports (file stem).
pub fn load(id: &str, toml: &str) -> Result<Machine, MachineError> {
    let raw: RawMachine = toml::from_str(toml).map_err(|error| MachineError {
        message: trunnion_dialect::plain_toml(
            Some(trunnion_dialect::KeyFile::Machine),
            toml,
            error.message(),
            error.span(),
        ),
        span: error.span(),
    })?;
    build(id, &raw).map_err(|fault| MachineError {
        message: fault.message,
        span: Some(fault.span),
    })
}

fn build(id: &str, raw: &RawMachine) -> Result<Machine, Fault> {
    if raw.schema.get_ref() != "ncmachine/1" {
        let message = format!(
            "unknown schema {:?}; this program reads \"ncmachine/1\"",
            raw.schema.get_ref()
        );
        return Err(Fault {
            message,
            span: raw.schema.span(),
        });
    }
    units(&raw.units)?;
    if let Some(first) = raw.unknown.first() {
        let message = format!(
            "`{}` of this machine is unknown; find it out, correct the file and remove the list `unknown`",
            first.get_ref()
        );
        return Err(Fault {
            message,
            span: first.span(),
        });
    }
    let tool_axis = match &raw.spindle.tool_axis {
        Some(vector) => unit_vector("tool_axis", vector)?,
        None => Vec3::z(),
    };
    let gauge_point = match &raw.spindle.gauge_point {
        Some(vector) => point("gauge_point", vector)?,
        None => Vec3::zeros(),
    };
    let chain = Chain::new(raw, &tool_axis)?;
    let mut joint_of_letter = [None; 9];
    for (joint, axis) in chain.axes.iter().enumerate() {
        if let Some(slot) = AXIS_LETTERS.iter().position(|&l| l == axis.letter) {
            joint_of_letter[slot] = Some(joint as u8);
        }
    }
    let of_kind = |kind| {
        (0..chain.axes.len())
            .filter(|&joint| chain.axes[joint].kind == kind && chain.axes[joint].extra.hold.is_none())
            .collect::<Vec<_>>()
    };
    let (rotary, linear) = (of_kind(AxisKind::Rotary), of_kind(AxisKind::Linear));
    let sources = raw
        .sources
        .iter()
        .cloned()
        .chain(raw.spindle.source.iter().map(|text| format!("spindle: {text}")))
        .chain(raw.spindle.note.iter().map(|text| format!("spindle: {text}")))
        .collect();
    let carried = Carried::by(&chain.axes);
    let mut machine = Machine {
        not_used: not_used(raw),
        not_judged: not_judged(raw),
        most_turned: MOST_TURNED,
        id: id.to_owned(),
        name: raw.name.clone().unwrap_or_else(|| id.to_owned()),
        tool_axis: carried.turn(&tool_axis),
        gauge_point: carried.place(&gauge_point),
        home: Home { tool_axis, gauge_point },
        warnings: warnings(&chain.axes, &chain.constants),
        checks: raw.check.len(),
        control: control(&raw.control, &chain.axes[..chain.written])?,
        tolerances: tolerances(&raw.tolerances)?,
        sources,
        rotary,
        linear,
        joint_of_letter,
        constants: chain.constants,
        bodies: bodies(&raw.body, &chain.axes[..chain.written])?,
        obstacles: crate::Obstacles::default(),
        absent: chain.absent,
        gantries: chain.gantries,
        axes: chain.axes,
    };
    verify(&raw.check, &machine)?;
    machine.obstacles = crate::Obstacles(obstacles(&raw.obstacle, &machine)?);
    Ok(machine)
}

/// What is suspicious but usable.
fn warnings(axes: &[Axis], constants: &Constants) -> Vec<String> {
    let mut out = Vec::new();
    let condition = constants.condition();
    if condition > ILL_CONDITIONED {
        out.push(format!(
            "the directions of the three linear axes lie nearly in a plane (condition number {condition:.0}): small errors of the tip \
             become large motions"
        ));
    }
    for axis in axes {
        let usual = usual_direction(axis.letter);
        let along = usual.dot(&axis.direction);
        if along < -1e-9 && axis.kind == AxisKind::Rotary {
            out.push(format!(
                "axis {}: `dir` is opposite to the usual direction, which reverses the meaning of `sign`; reverse `dir` and change `sign` instead",
                char::from(axis.letter)
            ));
        }
    }
    out
}

/// The axes of a file, proved usable.
struct Chain {
    axes: Vec<Axis>,
    /// How many of them the file lists.
    written: usize,
    /// The letter of the one that was added.
    absent: Option<u8>,
    gantries: Vec<Gantry>,
    constants: Constants,
}

impl Chain {
    fn new(raw: &RawMachine, tool_axis: &Vec3) -> Result<Self, Fault> {
        let (mut axes, mut spans, mut rails) = (Vec::<Axis>::new(), Vec::new(), Rails::default());
        let mut letters = Vec::new();
        for entry in raw.axis.get_ref() {
            let (span, written) = (entry.span(), entry.get_ref());
            let axis = axis(written)?;
            if letters.contains(&axis.letter) {
                let message = format!(
                    "axis {} is listed twice; list each letter once",
                    char::from(axis.letter)
                );
                return Err(Fault {
                    message,
                    span: written.letter.span(),
                });
            }
            letters.push(axis.letter);
            if let Some(leader) = &written.follow {
                rails.add(axis, written, leader)?;
                continue;
            }
            if axis.side == Side::Table && axes.iter().any(|other| other.side == Side::Head) {
                let message = format!(
                    "axis {} moves the table but comes after an axis of the head; list the axes from workpiece to tool",
                    char::from(axis.letter)
                );
                return Err(Fault {
                    message,
                    span: written.letter.span(),
                });
            }
            axes.push(axis);
            spans.push(span);
        }
        rails.bind(&mut axes)?;
        let written = axes.len();
        let absent = complete(&mut axes);
        spans.resize(axes.len(), raw.axis.span());
        let constants = check_chain(&axes, &spans, raw.axis.span(), tool_axis)?;
        Ok(Self {
            axes,
            written,
            absent,
            gantries: rails.gantries(),
            constants,
        })
    }
}

/// Number of axes, rank of the linear ones, and that each rotary axis can turn the tool (docs/kinematics.md#machine-model).
fn check_chain(axes: &[Axis], spans: &[Range<usize>], all: Range<usize>, k0: &Vec3) -> Result<Constants, Fault> {
    let moves = |axis: &Axis| axis.kind == AxisKind::Rotary && axis.extra.hold.is_none();
    let rotary: Vec<usize> = (0..axes.len()).filter(|&i| moves(&axes[i])).collect();
    if axes.len() > MAX_AXES {
        return Err(Fault {
            message: format!("this machine has {} axes; at most {MAX_AXES} are possible", axes.len()),
            span: all,
        });
    }
    if let Some(&third) = rotary.get(2) {
        let message = format!(
            "this machine has {} rotary axes, but kinematics are solved for at most 2. Add `hold = ANGLE` to those that do not move while cutting ({} is the third)",
            rotary.len(),
            char::from(axes[third].letter)
        );
        return Err(Fault {
            message,
            span: spans[third].clone(),
        });
    }
    if let [first, second] = rotary[..] {
        let parallel = |a: &Vec3, b: &Vec3| {
            let angle = angle_between(a, b);
            !(PARALLEL..=core::f64::consts::PI - PARALLEL).contains(&angle)
        };
        // a held axis turns what follows it in the chain
        let turned = |joint: usize| Carried::by(&axes[..joint]).turn(&axes[joint].direction);
        let (e1, e2, k0) = (&turned(first), &turned(second), &Carried::by(axes).turn(k0));
        let (l1, l2) = (char::from(axes[first].letter), char::from(axes[second].letter));
        if parallel(e1, e2) {
            let message = format!(
                "the rotary axes {l1} and {l2} are parallel; together they turn the tool about one direction only"
            );
            return Err(Fault {
                message,
                span: spans[second].clone(),
            });
        }
        if parallel(e2, k0) {
            let message = format!(
                "axis {l2} turns about the tool axis itself and cannot tilt it; check its `dir` or the spindle's `tool_axis`"
            );
            return Err(Fault {
                message,
                span: spans[second].clone(),
            });
        }
    }
    Constants::new(axes, k0).ok_or_else(|| {
        let letters: Vec<String> = axes
            .iter()
            .filter(|axis| axis.kind == AxisKind::Linear)
            .map(|axis| char::from(axis.letter).to_string())
            .collect();
        let has = if letters.is_empty() {
            "there is none".to_owned()
        } else {
            format!("there are {}", letters.join(", "))
        };
        let message = format!(
            "linear axes in independent directions are needed: three, or two and no rotary axis (a lathe, a laser); {has}"
        );
        Fault { message, span: all }
    })
}

fn units(raw: &RawUnits) -> Result<(), Fault> {
    let known = [
        (&raw.length, "length", "mm"),
        (&raw.angle, "angle", "deg"),
        (&raw.time, "time", "s"),
    ];
    for (word, what, unit) in known {
        if let Some(word) = word
            && word.get_ref() != unit
        {
            let message = format!(
                "unit {:?} for {what} is not supported; convert the numbers and write \"{unit}\"",
                word.get_ref()
            );
            return Err(Fault {
                message,
                span: word.span(),
            });
        }
    }
    Ok(())
}

fn tolerances(raw: &RawTolerances) -> Result<Tolerances, Fault> {
    let default = Tolerances::default();
    let angle = |name, written, value: f64| Ok(rad(positive(name, written)?.unwrap_or(deg(value))));
    let share = |name, written: Option<&Number>, value: f64| match positive(name, written)? {
        Some(share) if share > 1.0 => Err(Fault {
            message: format!("{name} is a part of the programmed feed, at most 1, not {share}"),
            span: written.map_or(0..0, toml::Spanned::span),
        }),
        share => Ok(share.unwrap_or(value)),
    };
    let ratio = |name, written: Option<&Number>, value: f64| match positive(name, written)? {
        Some(ratio) if ratio < 1.0 => Err(Fault {
            message: format!("{name} is a ratio to the direct distance, at least 1, not {ratio}"),
            span: written.map_or(0..0, toml::Spanned::span),
        }),
        ratio => Ok(ratio.unwrap_or(value)),
    };
    Ok(Tolerances {
        tip_mm: positive("tip", raw.tip.as_ref())?.unwrap_or(default.tip_mm),
        orientation: angle("orientation", raw.orientation.as_ref(), default.orientation)?,
        swept_mm: positive("swept", raw.swept.as_ref())?.unwrap_or(default.swept_mm),
        rotary_ratio: ratio("rotary_ratio", raw.rotary_ratio.as_ref(), default.rotary_ratio)?,
        linear_ratio: ratio("linear_ratio", raw.linear_ratio.as_ref(), default.linear_ratio)?,
        rapid_ratio: ratio("rapid_ratio", raw.rapid_ratio.as_ref(), default.rapid_ratio)?,
        pivot_mm: positive("pivot", raw.pivot.as_ref())?.unwrap_or(default.pivot_mm),
        clearance_mm: non_negative("clearance", raw.clearance.as_ref())?,
        near_mm: positive("collision_near", raw.collision_near.as_ref())?.unwrap_or(default.near_mm),
        pole_cone: angle("pole_cone", raw.pole_cone.as_ref(), default.pole_cone)?,
        pole_angle: angle("pole_angle", raw.pole_angle.as_ref(), default.pole_angle)?,
        swap_excess: angle("swap_excess", raw.swap_excess.as_ref(), default.swap_excess)?,
        feed_drop_warning: share("feed_drop", raw.feed_drop.as_ref(), default.feed_drop_warning)?,
        feed_drop_error: share("feed_drop_error", raw.feed_drop_error.as_ref(), default.feed_drop_error)?,
    })
}

fn bodies(raw: &[RawBody], axes: &[Axis]) -> Result<Vec<Body>, Fault> {
    let known = |name: &str| {
        matches!(name, "base" | "spindle" | "workpiece") || axes.iter().any(|axis| name.as_bytes() == [axis.letter])
    };
    raw.iter()
        .map(|body| {
            if known(body.carrier.get_ref()) {
                Ok(Body {
                    carrier: body.carrier.get_ref().clone(),
                    mesh: body.mesh.get_ref().clone(),
                })
            } else {
                let message = format!(
                    "{:?} cannot carry a body: name an axis, base, spindle or workpiece",
                    body.carrier.get_ref()
                );
                Err(Fault {
                    message,
                    span: body.carrier.span(),
                })
            }
        })
        .collect()
}
