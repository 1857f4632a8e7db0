//! The part of `[control]` that is about time: corners, look-ahead, times of M codes, servo loops.
use crate::file::control::{known_axis, one_of};
use crate::file::raw::{Number, RawControl, RawCorner, Word};
use crate::file::validate::{Fault, non_negative, positive};
use crate::{Axis, AxisKind, Planning};
use trunnion_geometry::rad;

/// Names that the model of corners may have, and the key that each needs.
const MODELS: [(&str, &str); 6] = [
    ("axis-jump", "dv"),
    ("grbl", "deviation"),
    ("klipper", "speed"),
    ("linuxcnc-g64", ""),
    ("exact-stop", ""),
    ("servo", "tolerance"),
];

/// The model of corners, which must have the number that it needs.
pub(crate) fn corner_model(corner: &RawCorner) -> Result<Option<String>, Fault> {
    let model = one_of("model", corner.model.as_ref(), &MODELS.map(|(name, _)| name))?;
    let needed = MODELS.iter().find(|(name, _)| model.as_deref() == Some(*name));
    let there = match needed.map_or("", |(_, key)| key) {
        "dv" => !corner.dv.is_empty(),
        "deviation" => corner.deviation.is_some(),
        "speed" => corner.speed.is_some(),
        "tolerance" => corner.tolerance.is_some(),
        _ => true,
    };
    match (there, needed, &corner.model) {
        (false, Some((name, key)), Some(word)) => Err(Fault {
            message: format!("model {name:?} needs `{key}`"),
            span: word.span(),
        }),
        _ => Ok(model),
    }
}

/// Everything of the control that is about time.
pub(crate) fn planning(raw: &RawControl, axes: &[Axis]) -> Result<Planning, Fault> {
    let mut planning = Planning::default();
    if let Some(corner) = &raw.corner {
        for (letter, jump) in &corner.dv {
            known_axis(letter, axes)?;
            let value = positive("dv", Some(jump))?;
            for (slot, axis) in planning.corner_jump.iter_mut().zip(axes) {
                if letter.get_ref().as_bytes() == [axis.letter] {
                    *slot = value.map(|value| {
                        if axis.kind == AxisKind::Rotary {
                            rad(value)
                        } else {
                            value
                        }
                    });
                }
            }
        }
        planning.corner_deviation = positive("deviation", corner.deviation.as_ref())?;
        planning.corner_speed = positive("speed", corner.speed.as_ref())?;
        planning.corner_tolerance = positive("tolerance", corner.tolerance.as_ref())?;
    }
    if let Some(planner) = &raw.planner {
        planning.lookahead = planner.lookahead.as_ref().map(blocks).transpose()?;
        planning.filter_time = non_negative("filter_time", planner.filter_time.as_ref())?;
        planning.tool_change_time = non_negative("tool_change_time", planner.tool_change_time.as_ref())?;
        for (code, time) in &planner.m_times {
            if let Some(seconds) = non_negative("m_times", Some(time))? {
                planning.m_times.push((m_code(code)?, seconds));
            }
        }
    }
    if let Some(servo) = &raw.servo {
        planning.servo_bandwidth_hz = positive("bandwidth", servo.bandwidth.as_ref())?;
        planning.servo_sample = positive("sample_time", servo.sample_time.as_ref())?;
    }
    Ok(planning)
}

/// A number of blocks: whole, at least 1.
fn blocks(number: &Number) -> Result<u32, Fault> {
    let value = *number.get_ref();
    if (1.0..=1e6).contains(&value) && value.fract() == 0.0 {
        return Ok(value as u32);
    }
    Err(Fault {
        message: format!("lookahead = {value}: must be positive and whole, at most 1000000"),
        span: number.span(),
    })
}

/// `M6`.
fn m_code(word: &Word) -> Result<u16, Fault> {
    let number = word.get_ref().strip_prefix('M').and_then(|number| number.parse().ok());
    number.ok_or_else(|| Fault {
        message: format!(
            "{:?} is not an M code: write M and its number, for example \"M3\"",
            word.get_ref()
        ),
        span: word.span(),
    })
}
