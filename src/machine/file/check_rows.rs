//! `[[check]]` rows of a machine file: what its axes must yield, written a second time. A wrong sign, point, order or limit contradicts
//! its row, and the file does not load.
use crate::file::raw::{Number, RawCheck, RawLimits, Word};
use crate::file::text::{number, triple};
use crate::file::validate::{Fault, finite, point, positive, unit_vector};
use crate::{AxisKind, Joints, Limits, MAX_AXES, Machine, Wrap, forward};
use std::collections::BTreeMap;
use toml::Spanned;
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg, rad};

/// How far the tip may be from the position in a row, mm, unless the row states it (`within`).
const TIP: f64 = 1e-4;
/// How far the tool axis may be from the direction in a row, rad.
const AXIS: f64 = 1e-6;
/// How far a limit may be from that in a row, relative.
const SHARE: f64 = 1e-9;

/// Checks every row. The error names the row, its value, the value by the axes, and where to look.
pub(crate) fn verify(rows: &[Spanned<RawCheck>], machine: &Machine) -> Result<(), Fault> {
    for row in rows {
        let written = row.get_ref();
        let about = match &written.say {
            Some(say) => format!("check {say:?}"),
            None => "check".to_owned(),
        };
        let limits = written.travel.len() + written.speed.len() + written.acceleration.len() + written.words.len();
        if written.tip.is_none() && written.axis.is_none() && limits == 0 {
            let message = format!("{about} is empty: add tip, axis, travel, speed, acceleration or words");
            return Err(Fault {
                message,
                span: row.span(),
            });
        }
        pose(&about, written, machine)?;
        travel(&about, &written.travel, machine)?;
        highest(&about, "speed", &written.speed, machine)?;
        highest(&about, "acceleration", &written.acceleration, machine)?;
        words(&about, &written.words, machine)?;
    }
    Ok(())
}

/// The joint of a letter in a row.
fn joint(word: &Word, machine: &Machine) -> Result<usize, Fault> {
    let joint = match word.get_ref().as_bytes() {
        [letter] => machine.axes.iter().position(|axis| axis.letter == *letter),
        _ => None,
    };
    joint.ok_or_else(|| Fault {
        message: format!("{:?} is not an axis of this machine", word.get_ref()),
        span: word.span(),
    })
}

/// mm stay mm, rad become degrees.
fn plain(machine: &Machine, joint: usize, value: f64) -> f64 {
    match machine.axes[joint].kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => deg(value),
    }
}

fn pose(about: &str, row: &RawCheck, machine: &Machine) -> Result<(), Fault> {
    let mut joints: Joints = [0.0; MAX_AXES];
    // a held axis that the row does not name is where it is held
    for (joint, value) in machine.held() {
        joints[joint] = value;
    }
    let mut moved = String::new();
    for (word, written) in &row.joints {
        let joint = joint(word, machine)?;
        let value = finite("a joint", written)?;
        joints[joint] = match machine.axes[joint].kind {
            AxisKind::Linear => value,
            AxisKind::Rotary => rad(value),
        };
        if value != 0.0 {
            moved.push_str(word.get_ref());
        }
    }
    let length = row
        .tool_length
        .as_ref()
        .map_or(Ok(0.0), |length| finite("tool_length", length))?;
    let within = positive("within", row.within.as_ref())?.unwrap_or(TIP);
    let found = forward(machine, &joints, length);
    let look = look(&moved);
    if let Some(written) = &row.tip {
        let wanted = point("tip", written)?;
        let off = (wanted - found.tip).norm();
        if off.is_nan() || off > within {
            let message = format!(
                "{about}: by this row the tip is at {} mm, by the axes of this file at {} mm, {} mm away; {look}",
                triple(&wanted),
                triple(&found.tip),
                number(off)
            );
            return Err(Fault {
                message,
                span: written.span(),
            });
        }
    }
    if let Some(written) = &row.axis {
        let wanted: Vec3 = unit_vector("axis", written)?;
        let off = angle_between(&wanted, &found.axis);
        if off.is_nan() || off > AXIS.max(within * 0.01) {
            let message = format!(
                "{about}: by this row the tool points along {}, by the axes of this file along {}, {} deg away; {look}",
                triple(&wanted),
                triple(&found.axis),
                number(deg(off))
            );
            return Err(Fault {
                message,
                span: written.span(),
            });
        }
    }
    Ok(())
}

/// Where the fault must be if the row is right.
fn look(moved: &str) -> String {
    match moved.len() {
        0 => "with all axes at zero only tool_axis, gauge_point and hold matter".to_owned(),
        1 => format!("if the row is right, check sign, dir, point, kind and position in the list of axis {moved}"),
        _ => {
            let letters: Vec<String> = moved.chars().map(String::from).collect();
            format!(
                "if the row is right, check sign, dir and point of {}, and the order of the axes",
                letters.join(", ")
            )
        }
    }
}

fn travel(about: &str, rows: &BTreeMap<Word, Spanned<RawLimits>>, machine: &Machine) -> Result<(), Fault> {
    for (word, written) in rows {
        let joint = joint(word, machine)?;
        let axis = &machine.axes[joint];
        let same = match (*written.get_ref(), axis.limits) {
            (RawLimits::Unbounded, Limits::Unbounded) => axis.extra.limits_declared,
            (RawLimits::Range(low, high), Limits::Range(min, max)) => {
                near(low, plain(machine, joint, min)) && near(high, plain(machine, joint, max))
            }
            _ => false,
        };
        if !same {
            let own = match axis.limits {
                Limits::Range(min, max) => format!(
                    "[{}, {}]",
                    number(plain(machine, joint, min)),
                    number(plain(machine, joint, max))
                ),
                Limits::Unbounded if axis.extra.limits_declared => "\"unbounded\"".to_owned(),
                Limits::Unbounded => "not declared".to_owned(),
            };
            let message = format!(
                "{about}: the travel of {} differs from its limits: {own}; one of them is wrong",
                word.get_ref()
            );
            return Err(Fault {
                message,
                span: written.span(),
            });
        }
    }
    Ok(())
}

fn highest(about: &str, what: &str, rows: &BTreeMap<Word, Number>, machine: &Machine) -> Result<(), Fault> {
    for (word, written) in rows {
        let joint = joint(word, machine)?;
        let axis = &machine.axes[joint];
        let own = if what == "speed" {
            axis.max_speed
        } else {
            axis.max_acceleration
        };
        let own = own.map(|value| plain(machine, joint, value));
        let wanted = finite(what, written)?;
        if !own.is_some_and(|own| near(wanted, own)) {
            let own = own.map_or_else(|| "not declared".to_owned(), number);
            let message = format!(
                "{about}: the {what} of {} differs from its `dyn`: {own}; one of them is wrong",
                word.get_ref()
            );
            return Err(Fault {
                message,
                span: written.span(),
            });
        }
    }
    Ok(())
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= SHARE * (1.0 + a.abs())
}

/// What the words of an axis mean: radius or diameter, and literal, shortest or modulo-sign.
fn words(about: &str, rows: &BTreeMap<Word, Word>, machine: &Machine) -> Result<(), Fault> {
    for (word, written) in rows {
        let axis = &machine.axes[joint(word, machine)?];
        let own = match (axis.kind, axis.extra.wrap) {
            (AxisKind::Linear, _) if axis.extra.diameter => "diameter",
            (AxisKind::Linear, _) => "radius",
            (AxisKind::Rotary, Wrap::Literal) => "literal",
            (AxisKind::Rotary, Wrap::Shortest) => "shortest",
            (AxisKind::Rotary, Wrap::ModuloSign) => "modulo-sign",
        };
        if written.get_ref() != own {
            let message = format!(
                "{about}: the words of {} are {:?} here but {own:?} at the axis; one of them is wrong",
                word.get_ref(),
                written.get_ref()
            );
            return Err(Fault {
                message,
                span: written.span(),
            });
        }
    }
    Ok(())
}
