//! Checks of single entries of a machine file, each with its place, and their conversion to mm, rad and s.
use crate::file::raw::{Number, RawAxis, RawKind, RawLimits, RawMode, RawSide, RawWrap, Triple, Word};
use crate::{Axis, AxisExtra, AxisKind, Limits, Side, Wrap};
use core::ops::Range;
use trunnion_geometry::{Vec3, rad};
use trunnion_interp::AXIS_LETTERS;
use trunnion_interp::ClampCodes;

/// Numbers above this (mm, deg, or per second) are taken for mistakes; it also keeps every formula far from overflow.
const LARGEST: f64 = 1e9;

/// What is wrong, and where.
pub(crate) struct Fault {
    pub(crate) message: String,
    pub(crate) span: Range<usize>,
}

/// A finite number of sensible size.
pub(crate) fn finite(name: &str, number: &Number) -> Result<f64, Fault> {
    let value = *number.get_ref();
    if value.is_finite() && value.abs() <= LARGEST {
        Ok(value)
    } else {
        let message = format!("{name} = {value}: write a number between -{LARGEST:e} and {LARGEST:e}");
        Err(Fault {
            message,
            span: number.span(),
        })
    }
}

/// A number above zero, if written.
pub(crate) fn positive(name: &str, number: Option<&Number>) -> Result<Option<f64>, Fault> {
    let Some(number) = number else { return Ok(None) };
    let value = finite(name, number)?;
    if value > 0.0 {
        Ok(Some(value))
    } else {
        Err(Fault {
            message: format!("{name} = {value} must be greater than zero"),
            span: number.span(),
        })
    }
}

/// A number that is zero or above, if written.
pub(crate) fn non_negative(name: &str, number: Option<&Number>) -> Result<Option<f64>, Fault> {
    let Some(number) = number else { return Ok(None) };
    let value = finite(name, number)?;
    if value >= 0.0 {
        Ok(Some(value))
    } else {
        Err(Fault {
            message: format!("{name} = {value} must not be negative"),
            span: number.span(),
        })
    }
}

/// A point, mm.
pub(crate) fn point(name: &str, triple: &Triple) -> Result<Vec3, Fault> {
    let values = *triple.get_ref();
    if values.iter().all(|value| value.is_finite() && value.abs() <= LARGEST) {
        Ok(Vec3::from(values))
    } else {
        let message = format!("{name} = {values:?}: write three numbers between -{LARGEST:e} and {LARGEST:e}");
        Err(Fault {
            message,
            span: triple.span(),
        })
    }
}

/// A direction that is a unit vector within 1e-6; returned with length 1 to the last digit.
pub(crate) fn unit_vector(name: &str, triple: &Triple) -> Result<Vec3, Fault> {
    let vector = point(name, triple)?;
    let norm = vector.norm();
    if norm < 1e-12 {
        let message = format!("{name} is the zero vector; write a direction, for example [0, 0, 1]");
        return Err(Fault {
            message,
            span: triple.span(),
        });
    }
    let unit = vector / norm;
    if (norm - 1.0).abs() > 1e-6 {
        let message = format!(
            "{name} has length {norm:.6}, not 1; write [{:.9}, {:.9}, {:.9}] if this direction is meant",
            unit.x, unit.y, unit.z
        );
        return Err(Fault {
            message,
            span: triple.span(),
        });
    }
    // a vector that is already exact is not changed
    Ok(if norm == 1.0 { vector } else { unit })
}

/// The letter of an axis, which must be written in upper case.
pub(crate) fn letter(word: &Word) -> Result<u8, Fault> {
    let text = word.get_ref();
    match text.as_bytes() {
        [byte] if AXIS_LETTERS.contains(byte) => Ok(*byte),
        [byte] if AXIS_LETTERS.contains(&byte.to_ascii_uppercase()) => {
            let upper = char::from(byte.to_ascii_uppercase());
            Err(Fault {
                message: format!("{text:?}: axis letters are written in upper case; write \"{upper}\""),
                span: word.span(),
            })
        }
        _ => {
            let message = format!("{text:?} is not an axis letter; use one of X Y Z A B C U V W");
            Err(Fault {
                message,
                span: word.span(),
            })
        }
    }
}

/// The direction that ISO 841 gives a letter: A turns about X, U moves along X, and so on.
pub(crate) fn usual_direction(letter: u8) -> Vec3 {
    match letter {
        b'X' | b'A' | b'U' => Vec3::x(),
        b'Y' | b'B' | b'V' => Vec3::y(),
        _ => Vec3::z(),
    }
}

/// Values that an importer could not know must be filled in first.
fn all_known(raw: &RawAxis, letter: u8) -> Result<(), Fault> {
    if let Some(first) = raw.unknown.first() {
        let keys: Vec<&str> = raw.unknown.iter().map(|word| word.get_ref().as_str()).collect();
        let message = format!(
            "axis {}: {} unknown; find out, write {} and remove the list `unknown`",
            char::from(letter),
            if keys.len() == 1 {
                format!("`{}` is", keys[0])
            } else {
                format!("`{}` are", keys.join("`, `"))
            },
            if keys.len() == 1 { "it" } else { "them" }
        );
        return Err(Fault {
            message,
            span: first.span(),
        });
    }
    Ok(())
}

/// One axis, angles in rad.
pub(crate) fn axis(raw: &RawAxis) -> Result<Axis, Fault> {
    let letter = letter(&raw.letter)?;
    all_known(raw, letter)?;
    let usual = if (b'A'..=b'C').contains(&letter) {
        RawKind::Rotary
    } else {
        RawKind::Linear
    };
    let kind = match raw.kind.unwrap_or(usual) {
        RawKind::Linear => AxisKind::Linear,
        RawKind::Rotary => AxisKind::Rotary,
    };
    let side = match (raw.side, kind) {
        (Some(RawSide::Table), _) => Side::Table,
        (Some(RawSide::Head), _) | (None, AxisKind::Linear) => Side::Head,
        (None, AxisKind::Rotary) => {
            let message = format!("axis {} needs side = \"table\" or \"head\"", char::from(letter));
            return Err(Fault {
                message,
                span: raw.letter.span(),
            });
        }
    };
    let direction = match &raw.dir {
        Some(vector) => unit_vector("dir", vector)?,
        None => usual_direction(letter),
    };
    let place = match &raw.point {
        Some(vector) => point("point", vector)?,
        None => Vec3::zeros(),
    };
    let sign = match &raw.sign {
        // an axis that mirrors another one is not a joint and has no formula
        None if raw.follow.is_some() => 1.0,
        None => {
            let message = format!(
                "axis {} declares no sign: write sign = 1 (ISO 841: a positive word moves the tool positively relative to the part) or \
                 sign = -1 (reversed)",
                char::from(letter)
            );
            return Err(Fault {
                message,
                span: raw.letter.span(),
            });
        }
        Some(number) if number.get_ref().abs() == 1.0 => *number.get_ref(),
        Some(number) => {
            let message = "sign must be 1 (ISO 841: the tool moves relative to the part) or -1 (reversed)".to_owned();
            return Err(Fault {
                message,
                span: number.span(),
            });
        }
    };
    let scale = |value: f64| if kind == AxisKind::Rotary { rad(value) } else { value };
    Ok(Axis {
        letter,
        kind,
        side,
        direction,
        point: place,
        sign,
        limits: limits(raw, scale)?,
        max_speed: positive("vmax", raw.dynamics.vmax.as_ref())?.map(scale),
        max_acceleration: positive("amax", raw.dynamics.amax.as_ref())?.map(scale),
        note: raw.note.clone(),
        source: raw.source.clone(),
        extra: extra(raw, kind, scale)?,
    })
}

fn limits(raw: &RawAxis, scale: impl Fn(f64) -> f64) -> Result<Limits, Fault> {
    let Some(written) = &raw.limits else {
        return Ok(Limits::Unbounded);
    };
    match *written.get_ref() {
        RawLimits::Unbounded => Ok(Limits::Unbounded),
        RawLimits::Range(min, max) if min < max && min.abs() <= LARGEST && max.abs() <= LARGEST => {
            Ok(Limits::Range(scale(min), scale(max)))
        }
        RawLimits::Range(min, max) => {
            let message = format!("limits [{min}, {max}]: the lower limit must be below the upper one, both finite");
            Err(Fault {
                message,
                span: written.span(),
            })
        }
    }
}

fn extra(raw: &RawAxis, kind: AxisKind, scale: impl Fn(f64) -> f64) -> Result<AxisExtra, Fault> {
    if let Some(mode) = &raw.mode
        && kind == AxisKind::Rotary
    {
        let message = "mode = \"radius\" or \"diameter\" belongs to a linear axis".to_owned();
        return Err(Fault {
            message,
            span: mode.span(),
        });
    }
    let feed_forward = non_negative("kff", raw.dynamics.kff.as_ref())?;
    if let (Some(share), Some(written)) = (feed_forward, &raw.dynamics.kff)
        && share > 1.0
    {
        return Err(Fault {
            message: format!("kff = {share} must be at most 1"),
            span: written.span(),
        });
    }
    Ok(AxisExtra {
        wrap: match raw.wrap {
            RawWrap::Literal => Wrap::Literal,
            RawWrap::Shortest => Wrap::Shortest,
            RawWrap::ModuloSign => Wrap::ModuloSign,
        },
        clamp: raw.clamp,
        clamp_codes: clamp_codes(raw, kind)?,
        cable: raw.cable,
        spindle: raw.spindle,
        diameter: raw
            .mode
            .as_ref()
            .is_some_and(|mode| *mode.get_ref() == RawMode::Diameter),
        limits_declared: raw.limits.is_some(),
        limit_margin: non_negative("limit_margin", raw.limit_margin.as_ref())?.map(&scale),
        resolution: positive("resolution", raw.resolution.as_ref())?.map(&scale),
        max_jerk: positive("jmax", raw.dynamics.jmax.as_ref())?.map(&scale),
        position_gain: positive("kv", raw.dynamics.kv.as_ref())?,
        feed_forward,
        point_uncertainty: non_negative("point", raw.uncertainty.point.as_ref())?,
        direction_uncertainty: non_negative("dir_arcsec", raw.uncertainty.dir_arcsec.as_ref())?
            .map(|seconds| rad(seconds / 3600.0)),
        hold: hold(raw, kind)?.map(&scale),
    })
}

/// The M codes that clamp a rotary axis and release it.
fn clamp_codes(raw: &RawAxis, kind: AxisKind) -> Result<Option<ClampCodes>, Fault> {
    let Some(written) = &raw.clamp_codes else {
        return Ok(None);
    };
    let fault = |word: &Word, why: &str| Fault {
        message: format!("{:?} {why}", word.get_ref()),
        span: word.span(),
    };
    let number = |word: &Word| match word.get_ref().strip_prefix('M').map(str::parse) {
        Some(Ok(number)) => Ok(number),
        _ => Err(fault(
            word,
            "is not an M code: write M and a number, for example \"M10\"",
        )),
    };
    let codes = ClampCodes {
        on: number(&written.on)?,
        off: number(&written.off)?,
    };
    if kind == AxisKind::Linear {
        return Err(fault(
            &written.on,
            "is for rotary axes: linear axes cannot be clamped by codes here",
        ));
    }
    if codes.on == codes.off {
        return Err(fault(&written.off, "cannot both clamp and release the axis"));
    }
    Ok(Some(codes))
}

/// The value that a rotary axis is held at, deg.
fn hold(raw: &RawAxis, kind: AxisKind) -> Result<Option<f64>, Fault> {
    let Some(written) = &raw.hold else { return Ok(None) };
    if kind == AxisKind::Linear || raw.follow.is_some() {
        let message = "`hold` is only for a rotary axis beyond the two that are solved".to_owned();
        return Err(Fault {
            message,
            span: written.span(),
        });
    }
    let value = finite("hold", written)?;
    if let Some(limits) = &raw.limits
        && let RawLimits::Range(min, max) = *limits.get_ref()
        && !(min..=max).contains(&value)
    {
        return Err(Fault {
            message: format!("hold = {value} is outside the limits [{min}, {max}]"),
            span: written.span(),
        });
    }
    Ok(Some(value))
}
