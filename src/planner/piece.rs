//! A piece of path on which the limits are constant.

/// What limits a speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Limit {
    /// The programmed feed is reached.
    Feed,
    /// The speed of an axis (its joint).
    Speed(u8),
    /// The acceleration that an axis needs where the path bends at a constant speed.
    Bend(u8),
    /// The acceleration of an axis along the path.
    Acceleration(u8),
    /// The jerk of the axes: one move from rest to rest that is too short for its acceleration.
    Jerk,
    /// The speed at a corner at the start or the end of the block.
    Corner,
    /// A stop at its start or its end.
    Stop,
    /// The time that the control takes for a block.
    BlockTime,
    /// The blocks that the control looks ahead.
    LookAhead,
    /// The block lasts as long as the program says: a dwell, a tool change.
    Wait,
}

/// Highest speed, what sets it, and the acceleration along the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// mm/s (deg/s where only rotary axes move).
    pub cap: f64,
    /// What sets it.
    pub by: Limit,
    /// mm/s^2; infinite where no axis declares one.
    pub acceleration: f64,
}

/// A piece of path. Lengths are mm of the path along which F counts; deg where only rotary axes move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// mm.
    pub length: f64,
    /// With all of the acceleration for either purpose, and without the control's own limits.
    pub optimistic: Bounds,
    /// With the acceleration shared between bends and the path, and with the control's limits.
    pub planned: Bounds,
    /// Jerk along the path, mm/s^3; infinite where no axis declares one.
    pub jerk: f64,
    /// Jerk of the axes over what they need in bends, mm^2/s^3: half of it times the length of a filter is the highest v^2. Infinite without bends.
    pub bend_jerk: f64,
    /// The path bends, or the rates of the axes change along it.
    pub bends: bool,
    /// The joint that limits the acceleration.
    pub slowest: u8,
    /// amax/jmax, the longest of the axes that move, s; 0 where no jerk is declared.
    pub jerk_time: f64,
    /// Highest speed at its start, optimistic and planned, mm/s; infinite where the path goes on smoothly.
    pub entry: [f64; 2],
    /// F, mm/s; infinite in rapid.
    pub feed: f64,
    /// Which motion it belongs to.
    pub motion: u32,
}
