//! The corner at the start of a line: directions of travel of the linear axes on both sides, and the feeds.
use crate::cli::{failure::Failure, legs::each_leg, load::Loaded};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::hypot;
use trunnion_interp::{Feed, MotionKind};
use trunnion_machine::{BlockPath, Joints, Leg, Machine, NO_TURN};
use trunnion_servo::Corner;
use trunnion_syntax::LineIndex;

/// A corner of a program.
pub(crate) struct Found {
    /// In the space of the linear axes.
    pub(crate) corner: Corner,
    /// Line of the leg in and of the leg out.
    pub(crate) lines: [u32; 2],
    /// Feed of the leg in and out, mm/s.
    pub(crate) feeds: [f64; 2],
    /// Their lengths, mm.
    pub(crate) lengths: [f64; 2],
    /// The linear axes that the directions are in.
    pub(crate) joints: [usize; 3],
    /// The program is in inch there.
    pub(crate) inch: bool,
    /// What was assumed.
    pub(crate) notes: Vec<String>,
}

impl Found {
    /// The acceleration along both legs that the axes allow, mm/s^2; `None` where one that moves declares none.
    pub(super) fn acceleration(&self, machine: &Machine) -> Option<f64> {
        let mut least = f64::INFINITY;
        for direction in [self.corner.before, self.corner.after] {
            for (share, &joint) in direction.iter().zip(&self.joints) {
                if share.abs() > 1e-9 {
                    least = least.min(machine.axes[joint].max_acceleration? / share.abs());
                }
            }
        }
        least.is_finite().then_some(least)
    }
}

/// One side of a corner.
#[derive(Clone, Copy)]
struct Side {
    line: u32,
    /// Rates at the start and at the end, mm per block.
    rates: [Vec3; 2],
    length: f64,
    feed: Result<f64, &'static str>,
    turns: bool,
    bends: bool,
}

/// The three linear axes.
fn linear(machine: &Machine) -> Result<[usize; 3], Failure> {
    let joints = machine
        .linear
        .get(..3)
        .and_then(|three| three.try_into().ok())
        .ok_or_else(|| Failure::new(format!("machine {} does not have three linear axes", machine.id)))?;
    if machine.linear.len() > 3 {
        return Err(Failure::new(format!(
            "machine {} has more than three linear axes: corners of such machines are not judged",
            machine.id
        )));
    }
    Ok(joints)
}

/// The corner at the start of the first motion of a line.
pub(super) fn find(loaded: &Loaded, machine: &Machine, line: u32) -> Result<Found, Failure> {
    let joints = linear(machine)?;
    let index = LineIndex::new(loaded.program.source());
    let last = index
        .line_column(
            loaded.program.source(),
            loaded.program.source().trim_ascii_end().len() as u32,
        )
        .0;
    if !(1..=last).contains(&line) {
        return Err(Failure::new(format!(
            "--at {line}: {} has the lines 1 to {last}; name the line of the motion after the corner",
            loaded.name
        )));
    }
    let (mut before, mut after): (Option<Side>, Option<Side>) = (None, None);
    let mut known: (Joints, u16) = ([0.0; _], 0);
    let mut stopped = None;
    let mut inch = false;
    each_leg(loaded, machine, &index, None, |leg, at, state| {
        if after.is_some() {
            return;
        }
        let side = side(machine, joints, leg, &known, at);
        known = leg.known_joints;
        inch = state.coordinates.is_inch();
        if at == line {
            match side {
                Some(side) if stopped.is_none() => after = Some(side),
                _ if matches!(leg.motion.kind, MotionKind::Dwell(_)) => {}
                _ => {}
            }
        } else {
            stopped = matches!(leg.motion.kind, MotionKind::Dwell(_)).then_some(at);
            if let Some(side) = side {
                before = Some(side);
                stopped = None;
            } else if stopped.is_none() {
                before = None;
            }
        }
    });
    let fail = |why: String| Err(Failure::new(format!("line {line}: {why}")));
    let Some(after) = after else {
        return fail(match stopped {
            Some(dwell) => format!(
                "the motion follows a dwell (line {dwell}): the axes are at rest before it, and no corner is cut"
            ),
            None => "no motion with a known path starts in this line; name the line of the motion after the corner"
                .to_owned(),
        });
    };
    let Some(before) = before else {
        return fail("there is no motion with a known path before it, so there is no corner at its start".to_owned());
    };
    if before.turns || after.turns {
        return fail("rotary axes turn at this corner: the servo model knows corners of linear axes only".to_owned());
    }
    let feed = |side: &Side| {
        side.feed
            .map_err(|why| Failure::new(format!("line {}: {why}", side.line)))
    };
    let Some(corner) = Corner::new(&before.rates[1], &after.rates[0]) else {
        return fail("the linear axes do not move on one side of this corner".to_owned());
    };
    Ok(Found {
        corner,
        lines: [before.line, after.line],
        feeds: [feed(&before)?, feed(&after)?],
        lengths: [before.length, after.length],
        joints,
        inch,
        notes: bent(&[&before, &after]),
    })
}

/// Notes about legs that are arcs.
fn bent(sides: &[&Side]) -> Vec<String> {
    let bent = sides.iter().filter(|side| side.bends);
    bent.map(|side| {
        format!(
            "the motion of line {} is bent, and is taken as its tangent at the corner",
            side.line
        )
    })
    .collect()
}

/// `None` where the leg does not move, or its path is not known.
fn side(machine: &Machine, joints: [usize; 3], leg: &Leg, known: &(Joints, u16), line: u32) -> Option<Side> {
    let path = BlockPath::new(machine, leg);
    let three = |all: &Joints| Vec3::from(joints.map(|joint| all[joint]));
    let rates = match &path {
        Some(path) => [path.rates(0.0), path.rates(1.0)].map(|rates| three(&rates)),
        None => [change(joints, leg, known)?; 2],
    };
    let speed = rates[0].norm().max(rates[1].norm());
    if speed <= 0.0 || !speed.is_finite() {
        return None;
    }
    let length = if path.is_some() && leg.length > 0.0 {
        leg.length
    } else {
        speed
    };
    Some(Side {
        line,
        rates,
        length,
        feed: feed(machine, joints, leg, &rates[1], length),
        turns: hypot(leg.rotary_change[0], leg.rotary_change[1]) > NO_TURN,
        bends: matches!(leg.motion.kind, MotionKind::Arc(_)),
    })
}

/// The change of the linear axes of a straight motion that leaves out axes whose position is unknown.
fn change(joints: [usize; 3], leg: &Leg, known: &(Joints, u16)) -> Option<Vec3> {
    if !matches!(leg.motion.kind, MotionKind::Linear | MotionKind::Rapid) || leg.motion.tcp {
        return None;
    }
    let mut change = Vec3::zeros();
    for (slot, joint) in joints.into_iter().enumerate() {
        match [known.1, leg.known_joints.1].map(|bits| bits & (1 << joint) != 0) {
            [true, true] => change[slot] = leg.known_joints.0[joint] - known.0[joint],
            // not positioned so far, and not by this motion
            [false, false] => {}
            _ => return None,
        }
    }
    Some(change)
}

/// Speed along the leg, mm/s.
fn feed(machine: &Machine, joints: [usize; 3], leg: &Leg, rates: &Vec3, length: f64) -> Result<f64, &'static str> {
    let motion = &leg.motion;
    let per_minute = match motion.feed {
        Feed::PerMinute(feed) => feed,
        Feed::PerRevolution(feed) => {
            feed * motion
                .mean_rpm()
                .ok_or("F is per revolution, and the spindle speed is not known")?
        }
        Feed::InverseTime(per_minute) => per_minute * length,
        Feed::Unknown => return Err("the feed is not known"),
        Feed::Rapid => {
            let mut fastest = f64::INFINITY;
            for (rate, joint) in rates.iter().zip(joints) {
                if rate.abs() > 1e-12 * rates.norm() {
                    let speed = machine.axes[joint]
                        .max_speed
                        .ok_or("an axis moves in rapid, and its speed is not declared")?;
                    fastest = fastest.min(speed * rates.norm() / rate.abs());
                }
            }
            fastest * 60.0
        }
    };
    let speed = per_minute / 60.0;
    (speed > 0.0 && speed.is_finite())
        .then_some(speed)
        .ok_or("the feed is zero")
}
