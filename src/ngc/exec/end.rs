//! The calls before the first line, stops, and what M2 and M30 reset.
use super::{After, access, frame, tools};
use crate::{
    At, Block, Canon, Coolant, DistanceMode, Engine, Error, FeedMode, Plane, Side, Sink, SpindleMode, SpindleTurn,
    Start, Stop, Switch,
};

/// The calls before the first line: parameters and tool table take effect.
pub(crate) fn start(engine: &mut Engine, sink: &mut dyn Sink) {
    let at = At::default();
    engine.state.tools = engine.setup.tool_rows();
    engine.state.wrapped = engine.setup.wrapped_axes();
    engine.state.current_row = 1;
    if engine.setup.tools.spindle.is_some() {
        engine.state.spindle_pocket = 0;
    }
    if !engine.setup.g92_persists() && engine.setup.start == Start::Zero {
        engine.store_pose(access::G92, &[0.0; 9]);
        engine.set_parameter(access::G92_ON, 0.0);
    }
    let index = engine.parameter(5220);
    // 0: unknown which one is in effect
    engine.state.origin_index = if index.is_nan() { 0 } else { (index as i32).clamp(1, 9) };
    let (origin, mut rotation) = engine.stored_origin(engine.state.origin_index.max(1));
    if !engine.setup.g92_persists() {
        // observed: with this switch the control begins with the rotation of G54 in any system
        rotation = engine.stored_origin(1).1;
    }
    let unknown = engine.state.origin_index == 0;
    engine.state.origin_offset = if unknown { [f64::NAN; 9] } else { origin };
    engine.state.rotation_xy = if unknown { f64::NAN } else { rotation };
    engine.state.axis_offset = engine.stored_axis_offset();
    if engine.setup.start == Start::Zero {
        // machine zero in program coordinates; as on the control the rotation is not used here, nor are the offsets of U V W
        let offsets = frame::sum(&engine.state.origin_offset, &engine.state.axis_offset);
        engine.state.current = std::array::from_fn(|axis| if axis < 6 { 0.0 - offsets[axis] } else { 0.0 });
        engine.state.compensated = engine.state.current;
    }
    tools::start(engine);
    engine.state.told = crate::state::ReceiverPosition::at(
        engine.state.current,
        engine.state.origin_offset,
        engine.state.axis_offset,
    );
    engine.refresh_parameters();
    let state = engine.state.clone();
    for call in [
        Canon::Units(state.units),
        Canon::G5xOffset(state.origin_index, state.origin_offset),
        Canon::G92Offset(state.axis_offset),
        Canon::XyRotation(state.rotation_xy),
        Canon::FeedReference,
    ] {
        engine.emit(call, at, sink);
    }
}

/// M0, M1, M60, M2, M30.
pub(crate) fn stop(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<After, Error> {
    let code = block.m[4];
    if !matches!(code, 0 | 1 | 2 | 30 | 60) {
        return Ok(After::Go);
    }
    super::flush(engine, block, sink)?;
    match code {
        0 => engine.emit(Canon::Stop(Stop::Program), at, sink),
        1 => engine.emit(Canon::Stop(Stop::Optional), at, sink),
        60 => {
            engine.emit(Canon::PalletShuttle, at, sink);
            engine.emit(Canon::Stop(Stop::Program), at, sink);
        }
        _ => {
            reset(engine, at, sink);
            if code == 30 {
                engine.emit(Canon::PalletShuttle, at, sink);
            }
            engine.state.ended = true;
            engine.emit(Canon::Stop(Stop::End), at, sink);
            engine.refresh_parameters();
            return Ok(After::Ended);
        }
    }
    Ok(After::Go)
}

/// What the end of a program resets.
fn reset(engine: &mut Engine, at: At, sink: &mut dyn Sink) {
    let (origin, rotation) = engine.stored_origin(1);
    frame::change_origin(&mut engine.state, origin, rotation);
    engine.set_parameter(5220, 1.0);
    engine.state.origin_index = 1;
    engine.emit(Canon::G5xOffset(1, origin), at, sink);
    engine.emit(Canon::XyRotation(rotation), at, sink);
    if engine.state.plane != Plane::Xy {
        engine.state.plane = Plane::Xy;
        engine.emit(Canon::Plane(Plane::Xy), at, sink);
    }
    let state = &mut engine.state;
    state.distance = DistanceMode::Absolute;
    state.feed_mode = FeedMode::PerMinute;
    state.feed_rate = 0.0;
    state.side = Side::Off;
    state.motion = 10;
    engine.emit(Canon::FeedMode(0, 0), at, sink);
    engine.emit(Canon::FeedRate(0.0), at, sink);
    if !engine.state.feed_override {
        engine.state.feed_override = true;
        engine.emit(Canon::Switch(Switch::FeedOverride, true), at, sink);
    }
    for spindle in 0..engine.setup.spindles() {
        engine.state.turning[spindle] = 0;
        engine.state.spindle_mode[spindle] = SpindleMode::ConstantRpm;
        engine.emit(Canon::Spindle(spindle as i32, SpindleTurn::Stop), at, sink);
        engine.emit(Canon::SpindleMode(spindle as i32, 0.0), at, sink);
    }
    if engine.state.mist {
        engine.state.mist = false;
        engine.emit(Canon::Coolant(Coolant::MistOff), at, sink);
    }
    if engine.state.flood {
        engine.state.flood = false;
        engine.emit(Canon::Coolant(Coolant::FloodOff), at, sink);
    }
}
