//! A random part, without the words of any control.
use trunnion_geometry::math::{hypot, sin_cos};

/// How far above the last depth a rapid back into the hole ends, mm.
pub(super) const PECK_CLEARANCE: f64 = 0.5;

/// Datum shifts of parts; the first one is none.
pub(super) const SHIFTS: [[f64; 3]; 4] = [[0.0; 3], [120.0, -45.5, 7.25], [-60.125, 200.0, 0.0], [5.0, 5.0, -12.5]];

/// From a linear congruence (Knuth's MMIX).
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        random.below(2);
        random
    }
    pub(super) fn below(&mut self, bound: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
    /// mm with two decimals.
    fn length(&mut self, low: f64, high: f64) -> f64 {
        low + (self.below(((high - low) * 100.0) as u64 + 1)) as f64 / 100.0
    }
    fn place(&mut self) -> [f64; 3] {
        [
            self.length(-80.0, 80.0),
            self.length(-80.0, 80.0),
            self.length(5.0, 60.0),
        ]
    }
}

/// What is done at each place of a row of holes. Levels in mm: Z of the surface, clearance above it, depth below it.
#[derive(Clone, Debug)]
pub(super) struct Holes {
    pub(super) places: Vec<[f64; 2]>,
    pub(super) surface: f64,
    pub(super) clearance: f64,
    pub(super) depth: f64,
    /// Where the tool is before and after each hole.
    pub(super) level: f64,
    pub(super) feed: f64,
    pub(super) kind: Hole,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hole {
    /// Down in feed, a dwell in seconds (0: none), out in rapid.
    Drill(f64),
    /// In and out at the feed.
    Ream,
    /// Rigid: the pitch; the spindle turns at [`Part::SPEED`].
    Tap(f64),
    /// Steps of this depth, cleared each time.
    Peck(f64),
}

#[derive(Clone, Debug)]
pub(super) enum Op {
    /// In rapid, or at a feed.
    Line([f64; 3], Option<f64>),
    /// Only one axis is named.
    Axis(usize, f64, f64),
    /// In the plane of axes `plane` and `plane + 1`: centre and end in it, whether counter-clockwise.
    Arc {
        plane: usize,
        centre: [f64; 2],
        from: [f64; 2],
        end: [f64; 2],
        left: bool,
        feed: f64,
    },
    /// About a centre in X Y: degrees (less than a turn), rise in Z.
    Helix {
        centre: [f64; 2],
        from: [f64; 2],
        end: [f64; 2],
        degrees: f64,
        rise: f64,
        z: f64,
        feed: f64,
    },
    Holes(Holes),
    /// `times` lines in X, `step` farther each time, and back to Z `clear`.
    Loop {
        times: u32,
        from: [f64; 3],
        step: f64,
        depth: f64,
        feed: f64,
    },
    /// The subprogram.
    Call,
    /// A shift of [`SHIFTS`] for what is inside.
    Shifted(usize, Vec<Op>),
    /// Turned by spatial angles about the fixed X, Y, Z.
    Tilted([f64; 3], Vec<Op>),
}

/// A part.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) ops: Vec<Op>,
    pub(super) subprogram: Vec<Op>,
}

impl Part {
    /// 1/min.
    pub(super) const SPEED: f64 = 500.0;

    pub(super) fn random(random: &mut Random, may_tilt: bool) -> Self {
        let subprogram = ops(random, 3, Inside::Frame);
        let count = 4 + random.below(6);
        let inside = if may_tilt { Inside::Tilting } else { Inside::Part };
        Self {
            ops: ops(random, count, inside),
            subprogram,
        }
    }
    pub(super) fn tilts(&self) -> bool {
        fn any(ops: &[Op]) -> bool {
            ops.iter().any(|op| match op {
                Op::Tilted(..) => true,
                Op::Shifted(_, inside) => any(inside),
                _ => false,
            })
        }
        any(&self.ops)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Inside {
    Part,
    Tilting,
    /// A shift, a tilted plane or the subprogram: no further one.
    Frame,
}

/// Each list begins with a rapid to a place that is named whole.
fn ops(random: &mut Random, count: u64, inside: Inside) -> Vec<Op> {
    let mut at = random.place();
    let mut found = vec![Op::Line(at, None)];
    for _ in 0..count {
        let feed = 50.0 * (1 + random.below(20)) as f64;
        match random.below(if inside == Inside::Frame { 7 } else { 10 }) {
            0 | 1 => {
                at = random.place();
                found.push(Op::Line(at, (random.below(3) > 0).then_some(feed)));
            }
            2 => {
                let axis = random.below(3) as usize;
                at[axis] = random.place()[axis];
                found.push(Op::Axis(axis, at[axis], feed));
            }
            3 => found.push(arc(random, &mut at, feed)),
            4 => found.push(helix(random, &mut at, feed)),
            5 => {
                let holes = holes(random, feed);
                let last = holes.places[holes.places.len() - 1];
                at = [last[0], last[1], holes.level];
                found.push(Op::Line([holes.places[0][0], holes.places[0][1], holes.level], None));
                found.push(Op::Holes(holes));
            }
            6 => {
                let (from, step, times) = (random.place(), random.length(0.5, 9.0), 1 + random.below(4) as u32);
                found.push(Op::Loop {
                    times,
                    from,
                    step,
                    depth: random.length(1.0, 4.0),
                    feed,
                });
                at = [from[0] + step * f64::from(times - 1), from[1], from[2]];
            }
            7 => {
                found.push(Op::Call);
                at = random.place();
                found.push(Op::Line(at, None));
            }
            8 => {
                let shift = 1 + random.below(SHIFTS.len() as u64 - 1) as usize;
                let within = if inside == Inside::Tilting && random.below(2) == 0 {
                    vec![tilted(random)]
                } else {
                    ops(random, 3, Inside::Frame)
                };
                found.push(Op::Shifted(shift, within));
                at = random.place();
                found.push(Op::Line(at, None));
            }
            _ => {
                if inside == Inside::Tilting {
                    found.push(tilted(random));
                    at = random.place();
                    found.push(Op::Line(at, None));
                }
            }
        }
    }
    found
}

fn tilted(random: &mut Random) -> Op {
    let angles = [0; 3].map(|_| random.below(3) as f64 * random.length(-80.0, 80.0) / 2.0);
    Op::Tilted(angles, ops(random, 4, Inside::Frame))
}

/// The arm from the centre, turned.
fn turned(arm: [f64; 2], degrees: f64) -> [f64; 2] {
    let (sin, cos) = sin_cos(degrees.to_radians());
    [arm[0] * cos - arm[1] * sin, arm[0] * sin + arm[1] * cos]
}

fn centre(random: &mut Random, from: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    loop {
        let arm = [random.length(-20.0, 20.0), random.length(-20.0, 20.0)];
        if hypot(arm[0], arm[1]) > 1.0 {
            return ([from[0] - arm[0], from[1] - arm[1]], arm);
        }
    }
}

fn arc(random: &mut Random, at: &mut [f64; 3], feed: f64) -> Op {
    let plane = random.below(3) as usize;
    let axes = [plane, (plane + 1) % 3];
    let from = axes.map(|axis| at[axis]);
    let (centre, arm) = centre(random, from);
    let left = random.below(2) == 0;
    let full = random.below(6) == 0;
    let degrees = random.length(10.0, 350.0) * if left { 1.0 } else { -1.0 };
    let arm = turned(arm, degrees);
    let end = if full {
        from
    } else {
        [centre[0] + arm[0], centre[1] + arm[1]]
    };
    (at[axes[0]], at[axes[1]]) = (end[0], end[1]);
    Op::Arc {
        plane,
        centre,
        from,
        end,
        left,
        feed,
    }
}

fn helix(random: &mut Random, at: &mut [f64; 3], feed: f64) -> Op {
    let from = [at[0], at[1]];
    let (centre, arm) = centre(random, from);
    let degrees = random.length(10.0, 350.0) * if random.below(2) == 0 { 1.0 } else { -1.0 };
    let arm = turned(arm, degrees);
    let end = [centre[0] + arm[0], centre[1] + arm[1]];
    let rise = random.length(-4.0, 8.0);
    *at = [end[0], end[1], at[2] + rise];
    Op::Helix {
        centre,
        from,
        end,
        degrees,
        rise,
        z: at[2],
        feed,
    }
}

fn holes(random: &mut Random, feed: f64) -> Holes {
    let count = 1 + random.below(4);
    let places = (0..count)
        .map(|_| [random.length(-80.0, 80.0), random.length(-80.0, 80.0)])
        .collect();
    let surface = random.length(-5.0, 5.0);
    let clearance = random.length(1.0, 3.0);
    let (kind, depth) = match random.below(5) {
        0 => (Hole::Drill(0.0), random.length(2.0, 20.0)),
        1 => (
            Hole::Drill(0.25 * (1 + random.below(8)) as f64),
            random.length(2.0, 20.0),
        ),
        2 => (Hole::Ream, random.length(2.0, 20.0)),
        3 => (Hole::Tap(0.25 * (2 + random.below(6)) as f64), random.length(2.0, 20.0)),
        _ => {
            let step = 0.5 * (2 + random.below(6)) as f64;
            (Hole::Peck(step), step * (1 + random.below(5)) as f64)
        }
    };
    Holes {
        places,
        surface,
        clearance,
        depth,
        level: surface + clearance + random.length(0.0, 20.0),
        feed,
        kind,
    }
}
