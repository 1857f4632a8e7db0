//! Modal changes of a block: feed mode, F, units, plane, path control, distance and retract modes, diameters.
use super::{frame, problems};
use crate::state::said;
use crate::{
    At, Block, Canon, DistanceMode, Engine, Error, FeedMode, MotionMode, Plane, Problem, RetractMode, Side, Sink,
    SpindleMode, Start, Units,
};
use std::sync::Arc;

/// The interpreter's own remark on a modal change.
pub(crate) fn remark(engine: &mut Engine, text: &'static str, at: At, sink: &mut dyn Sink) {
    engine.emit(Canon::Comment(Arc::from(text.as_bytes())), at, sink);
}

/// G93, G94, G95.
pub(crate) fn feed_mode(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(5) else { return Ok(()) };
    let spindle = choose_spindle(engine, block, &problems::SPINDLE_RANGE_FEED)?;
    let (mode, text) = match code {
        930 => (FeedMode::InverseTime, "interpreter: feed mode set to inverse time"),
        940 => (FeedMode::PerMinute, "interpreter: feed mode set to units per minute"),
        _ => (
            FeedMode::PerRevolution,
            "interpreter: feed mode set to units per revolution",
        ),
    };
    remark(engine, text, at, sink);
    let per_revolution = i32::from(mode == FeedMode::PerRevolution);
    engine.state.feed_mode = mode;
    let of_spindle = if mode == FeedMode::PerRevolution { spindle } else { 0 };
    engine.emit(Canon::FeedMode(of_spindle as i32, per_revolution), at, sink);
    if mode != FeedMode::InverseTime {
        // an F of another mode would have another meaning: it must be written again
        engine.state.feed_rate = 0.0;
        engine.emit(Canon::FeedRate(0.0), at, sink);
    }
    Ok(())
}

/// F; under G93 it belongs to its motion alone.
pub(crate) fn feed_rate(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    if engine.state.feed_mode == FeedMode::InverseTime {
        return;
    }
    if let Some(rate) = block.word(b'F') {
        engine.state.feed_rate = rate;
        engine.emit(Canon::FeedRate(rate), at, sink);
    }
}

/// G17-G19.1.
pub(crate) fn plane(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(2) else { return Ok(()) };
    let plane = match code {
        170 => Plane::Xy,
        180 => Plane::Xz,
        190 => Plane::Yz,
        171 => Plane::Uv,
        181 => Plane::Uw,
        _ => Plane::Vw,
    };
    let other = engine.state.side != Side::Off && plane != engine.state.plane;
    if other && matches!(plane, Plane::Uv | Plane::Uw | Plane::Vw) {
        return Err(Error::new(&problems::UVW_COMPENSATION, block.g_range(2)));
    }
    if other {
        return Err(Error::new(&problems::PLANE_COMPENSATION, block.g_range(2)));
    }
    engine.state.plane = plane;
    engine.emit(Canon::Plane(plane), at, sink);
    Ok(())
}

/// G20, G21: what is active is expressed in the new units.
pub(crate) fn units(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    let Some(code) = block.g_code(6) else { return };
    let units = if code == 200 { Units::Inch } else { Units::Millimetre };
    engine.emit(Canon::Units(units), at, sink);
    change_units(engine, units);
}

/// Lengths of the state in other units. `rs274` keeps the number of the tool offset and of F; on a machine the interpreter reads both again
/// from what the machine has, in the new units (LinuxCNC,
/// interp_convert.cc, remarks on convert_length_units). Words that cycles keep have their numbers on both.
fn change_units(engine: &mut Engine, units: Units) {
    let state = &mut engine.state;
    if state.units == units {
        return;
    }
    let factor = state.units.mm() / units.mm();
    engine.queue.scale(factor);
    let state = &mut engine.state;
    for pose in [
        &mut state.current,
        &mut state.compensated,
        &mut state.axis_offset,
        &mut state.origin_offset,
    ] {
        for axis in [0, 1, 2, 6, 7, 8] {
            pose[axis] *= factor;
        }
    }
    state.radius *= factor;
    state.units = units;
    if engine.setup.start == Start::Unknown {
        for axis in [0, 1, 2, 6, 7, 8] {
            state.tool_offset[axis] *= factor;
        }
        // per revolution the number stays
        if state.feed_mode != FeedMode::PerRevolution {
            state.feed_rate *= factor;
        }
    }
}

/// G61, G61.1, G64 P Q.
pub(crate) fn control_mode(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(13) else { return Ok(()) };
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::CONTROL_COMPENSATION, block.g_range(13)));
    }
    let mode = match code {
        610 => MotionMode::ExactPath,
        611 => MotionMode::ExactStop,
        _ => MotionMode::Continuous(positive(block.word(b'P')).unwrap_or(0.0)),
    };
    engine.state.motion_mode = mode;
    engine.emit(Canon::MotionMode(mode), at, sink);
    if let MotionMode::Continuous(tolerance) = mode {
        let naive = positive(block.word(b'Q')).unwrap_or(tolerance);
        engine.state.naive_tolerance = naive;
        engine.state.tolerance_units = engine.state.units;
        engine.emit(Canon::NaiveCamTolerance(naive), at, sink);
    }
    Ok(())
}

/// A word whose negative values are taken as absent.
fn positive(value: Option<f64>) -> Option<f64> {
    value.filter(|value| value.is_nan() || *value >= 0.0)
}

/// G90, G91.
pub(crate) fn distance(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    let Some(code) = block.g_code(3) else { return };
    let mode = distance_of(code == 900);
    if engine.state.distance != mode {
        let text = match mode {
            DistanceMode::Absolute => "interpreter: distance mode changed to absolute",
            DistanceMode::Incremental => "interpreter: distance mode changed to incremental",
        };
        remark(engine, text, at, sink);
        engine.state.distance = mode;
    }
}

/// G90.1, G91.1.
pub(crate) fn arc_distance(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    let Some(code) = block.g_code(4) else { return };
    let mode = distance_of(code == 901);
    if engine.state.arc_distance != mode {
        let text = match mode {
            DistanceMode::Absolute => "interpreter: IJK distance mode changed to absolute",
            DistanceMode::Incremental => "interpreter: IJK distance mode changed to incremental",
        };
        remark(engine, text, at, sink);
        engine.state.arc_distance = mode;
    }
}

fn distance_of(absolute: bool) -> DistanceMode {
    if absolute {
        DistanceMode::Absolute
    } else {
        DistanceMode::Incremental
    }
}

/// G7, G8.
pub(crate) fn diameters(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    let Some(code) = block.g_code(15) else { return };
    let on = code == 70;
    if engine.state.lathe_diameter != on {
        let text = if on {
            "interpreter: Lathe diameter mode changed to diameter"
        } else {
            "interpreter: Lathe diameter mode changed to radius"
        };
        remark(engine, text, at, sink);
        engine.state.lathe_diameter = on;
    }
}

/// G98, G99.
pub(crate) fn retract(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(10) else { return Ok(()) };
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::RETRACT_COMPENSATION, block.g_range(10)));
    }
    let (mode, text) = if code == 980 {
        (RetractMode::OldZ, "interpreter: retract mode set to old_z")
    } else {
        (RetractMode::RPlane, "interpreter: retract mode set to r_plane")
    };
    remark(engine, text, at, sink);
    engine.state.retract = mode;
    Ok(())
}

/// G54-G59.3.
pub(crate) fn coordinate_system(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(12) else { return Ok(()) };
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::G5X_COMPENSATION, block.g_range(12)));
    }
    let index = match code {
        540..=590 => (code - 530) / 10,
        _ => code - 584,
    };
    let index = i32::from(index);
    engine.state.said |= said::SYSTEM;
    if index == engine.state.origin_index {
        remark(
            engine,
            "interpreter: continuing to use same coordinate system",
            at,
            sink,
        );
        return Ok(());
    }
    engine.state.origin_index = index;
    engine.set_parameter(5220, f64::from(index));
    let (origin, rotation) = engine.stored_origin(index);
    frame::move_origin(&mut engine.state, origin, rotation);
    engine.emit(Canon::G5xOffset(index, origin), at, sink);
    let axis_offset = engine.state.axis_offset;
    engine.emit(Canon::G92Offset(axis_offset), at, sink);
    engine.emit(Canon::XyRotation(rotation), at, sink);
    Ok(())
}

/// The spindle that a mode names: the first if it names none. Threads and feed per revolution follow it from then on.
fn choose_spindle(engine: &mut Engine, block: &Block, problem: &'static Problem) -> Result<usize, Error> {
    let number = block.spindle.unwrap_or(0);
    if !engine.setup.has_spindle(number) {
        return Err(Error::new(problem, block.range));
    }
    let spindle = number.unsigned_abs() as usize;
    engine.state.chosen_spindle = spindle;
    Ok(spindle)
}

/// G96, G97.
pub(crate) fn spindle_mode(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(14) else { return Ok(()) };
    let spindle = choose_spindle(engine, block, &problems::SPINDLE_RANGE_MODE)?;
    let mode = if code == 970 {
        SpindleMode::ConstantRpm
    } else {
        // no D: no ceiling, emitted as the largest number that the control uses for it
        SpindleMode::ConstantSurface(block.word(b'D').map_or(1e30, f64::abs))
    };
    engine.state.spindle_mode[spindle] = mode;
    let ceiling = match mode {
        SpindleMode::ConstantRpm => 0.0,
        SpindleMode::ConstantSurface(ceiling) => ceiling,
    };
    engine.emit(Canon::SpindleMode(spindle as i32, ceiling), at, sink);
    Ok(())
}
