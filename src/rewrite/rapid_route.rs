//! The way of a run of rapid motions past obstacles: what of the run is kept, the cheapest way for the rest, and its points in the digits of the program.
use crate::rapid_rounding::rounded;
use crate::rapid_runs::Rapid;
use trunnion_geometry::Vec3;
use trunnion_machine::{Joints, Machine, Nearness, NoRoute, Space, Stance, ToolBody, TravelLevel, forward, nearness};

/// Coordinates that differ by no more are the same, mm.
pub(crate) const SAME_MM: f64 = 1e-9;

/// A way is left alone if another one is cheaper by no more than this part of it, or by no more than rounding to the digits of the program may add (mm).
const LEAST_GAIN: f64 = 1e-3;
const LEAST_GAIN_MM: f64 = 0.01;

/// A place is at a level if it is no farther below it, mm: heights are computed.
const LEVEL_MM: f64 = 1e-7;

/// What a way costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// Length of the tip's path, mm.
    Length,
    /// Time of the slowest axis, s.
    Time,
}

/// A new way.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    /// The motions of the run that it replaces, by index.
    pub replaced: core::ops::RangeInclusive<usize>,
    /// Programmed X Y Z of its points, mm: the last one is where the last of these motions ended.
    pub points: Vec<Vec3>,
    /// Length of what is replaced and of the way, mm.
    pub length: [f64; 2],
}

/// Why a run that is not clear, or too long, stays as it is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Stay {
    /// Something is not declared.
    Missing(String),
    /// Nothing would help.
    Refused(String),
}

impl From<&str> for Stay {
    fn from(why: &str) -> Self {
        Self::Refused(why.to_owned())
    }
}

impl From<String> for Stay {
    fn from(why: String) -> Self {
        Self::Refused(why)
    }
}

/// How points are rounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// One unit of the last digit, mm.
    pub step_mm: f64,
}

/// A run with what is needed to plan it.
pub(crate) struct Planner<'a> {
    pub machine: &'a Machine,
    pub run: &'a [Rapid],
    /// The highest level at which the rapids since the last cut go across the tool.
    pub level: Option<TravelLevel>,
    pub keep: f64,
    pub measure: Measure,
}

/// The linear map from programmed coordinates to the space: it only turns about the height.
pub(crate) struct Frame {
    turn: [f64; 2],
    at: [Vec3; 2],
}

impl Frame {
    /// From a programmed position to the space.
    pub(crate) fn to_space(&self, words: &Vec3) -> Vec3 {
        let [cos, sin] = self.turn;
        let way = words - self.at[0];
        self.at[1] + Vec3::new(cos * way.x - sin * way.y, sin * way.x + cos * way.y, way.z)
    }
    /// And back.
    pub(crate) fn to_words(&self, place: &Vec3) -> Vec3 {
        let [cos, sin] = self.turn;
        let way = place - self.at[1];
        self.at[0] + Vec3::new(cos * way.x + sin * way.y, cos * way.y - sin * way.x, way.z)
    }
}

impl Planner<'_> {
    /// A new way; `None` where the run is clear and no other is shorter. `Err`: it is not clear, and why it stays.
    pub(crate) fn plan(&self, grid: Grid) -> Result<Option<Way>, Stay> {
        let first = &self.run[0];
        if first.leg.start.is_none() {
            // nothing is checked from a position that is unknown
            return Ok(None);
        }
        let stances = self.stances()?;
        if let Some(why) = first.fixed {
            return self.only_if_clear(why);
        }
        let Some(body) = first.tool.as_ref().and_then(ToolBody::of) else {
            return Err(Stay::Missing(
                "the diameter of the tool is not declared: [[tool]] diameter in trunnion.toml".into(),
            ));
        };
        if !first.declared {
            return Err(Stay::Missing(
                "the work offset or the tool length is not declared, so it is unknown where the obstacles are: [work_offsets] and [[tool]] length in trunnion.toml".into(),
            ));
        }
        let tool_length = stances[stances.len() - 1].tool_length;
        let space = match Space::with_part(self.machine, &stances[0].joints, tool_length, &body, self.keep) {
            Ok(space) => space,
            Err(why) => return self.only_if_clear(&why),
        };
        let places: Vec<Vec3> = stances
            .iter()
            .map(|stance| space.tip(self.machine, &stance.joints))
            .collect();
        let level = self.level_in(&space, &stances[0].joints);
        let middle = self.middle(&space, &places, (level, &body))?;
        if middle.is_empty() {
            return Ok(None);
        }
        let (from, to) = (places[middle.start], places[middle.end]);
        let clear = middle.clone().all(|index| self.is_clear(index, &body));
        let cost = |way: &Vec3| self.cost(&space, &stances[0].joints, way);
        let was: f64 = places[middle.start..=middle.end]
            .windows(2)
            .map(|pair| cost(&(pair[1] - pair[0])))
            .sum();
        let route = self.route(&space, (&from, &to), level, &cost);
        let (mut points, is) = match route {
            Ok(found) => found,
            Err(_) if clear => return Ok(None),
            Err(why) => return Err(why.into()),
        };
        if clear && was - is <= was * LEAST_GAIN + LEAST_GAIN_MM * cost(&Vec3::x()).max(cost(&Vec3::y())) * 4.0 {
            return Ok(None);
        }
        let frame = self.frame(&space, middle.clone())?;
        points = rounded(&space, &frame, &points, grid, &cost)
            .ok_or("no path past the obstacles could be written in the digits of the program")?;
        let length = |points: &[Vec3]| points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>();
        let lengths = [length(&places[middle.start..=middle.end]), length(&points)];
        let words = points[1..].iter().map(|point| frame.to_words(point)).collect();
        Ok(Some(Way {
            replaced: middle.start..=middle.end - 1,
            points: words,
            length: lengths,
        }))
    }

    /// The level below which nothing but the obstacles is declared, in the space.
    fn level_in(&self, space: &Space, joints: &Joints) -> f64 {
        let height = |level: TravelLevel| {
            let here = forward(self.machine, joints, level.tool_length());
            Some(level.height()? - here.axis.dot(&here.tip) + space.tip(self.machine, joints).z)
        };
        self.level.and_then(height).unwrap_or(f64::NEG_INFINITY)
    }

    /// What of a run may be replaced. What leads up to the level and down from it stays, and so does what runs straight along the tool at both ends: it
    /// leaves and enters what is not declared. Where the former is not clear, the tool rises and comes down along its axis instead.
    fn middle(
        &self,
        space: &Space,
        places: &[Vec3],
        (level, body): (f64, &ToolBody),
    ) -> Result<core::ops::Range<usize>, String> {
        let vertical = |pair: &[Vec3]| (pair[1] - pair[0]).xy().norm() <= SAME_MM;
        let legs: Vec<&[Vec3]> = places.windows(2).collect();
        let high = |place: &Vec3| place.z >= level - LEVEL_MM;
        let up = |leg: &&&[Vec3]| vertical(leg) && leg[1].z > leg[0].z;
        let mut leading = legs.iter().take_while(up).count();
        let first = places.iter().position(high).unwrap_or_default().max(leading);
        if (0..first).all(|index| self.is_clear(index, body)) {
            leading = first;
        }
        let down = |leg: &&&[Vec3]| vertical(leg) && leg[1].z < leg[0].z;
        let mut end = legs.len() - legs[leading..].iter().rev().take_while(down).count();
        let last = places.iter().rposition(high).unwrap_or(end).min(end).max(leading);
        if (last..legs.len()).all(|index| self.is_clear(index, body)) {
            end = last;
        }
        for (index, leg) in legs
            .iter()
            .enumerate()
            .filter(|(index, _)| !(leading..end).contains(index))
        {
            let line = if index < leading { "retract" } else { "approach" };
            if let Some(which) = space.blocked_by(&leg[0], &leg[1]) {
                return Err(format!(
                    "the {line} along the tool is inside the clearance of {}",
                    space.obstacles()[which].name
                ));
            }
        }
        Ok(leading..end)
    }

    /// The positions before the run and after each motion.
    fn stances(&self) -> Result<Vec<Stance>, String> {
        let mut stances = Vec::new();
        for rapid in self.run {
            if stances.is_empty() {
                stances.push(rapid.leg.start.ok_or("the position before it is unknown")?);
            }
            stances.push(*rapid.leg.end.as_ref().map_err(|_| "its end is unknown")?);
        }
        Ok(stances)
    }

    /// A run that cannot be changed: nothing to say if it is clear.
    fn only_if_clear(&self, why: &str) -> Result<Option<Way>, Stay> {
        let body = self.run[0].tool.as_ref().and_then(ToolBody::of);
        let clear = body.is_some_and(|body| (0..self.run.len()).all(|index| self.is_clear(index, &body)));
        if clear { Ok(None) } else { Err(why.into()) }
    }

    fn is_clear(&self, index: usize, body: &ToolBody) -> bool {
        let near = nearness(self.machine, &self.run[index].leg, body, self.keep);
        near.iter().all(|near| matches!(near.nearness, Nearness::Clear(_)))
    }

    /// What a straight leg costs.
    fn cost(&self, space: &Space, joints: &Joints, way: &Vec3) -> f64 {
        match self.measure {
            Measure::Length => way.norm(),
            Measure::Time => space.travel(self.machine, joints, way).map_or(way.norm(), |joints| {
                let speed = |(joint, travel): &(usize, f64)| {
                    travel.abs() / self.machine.axes[*joint].max_speed.unwrap_or(f64::INFINITY)
                };
                joints.iter().map(speed).fold(0.0, f64::max)
            }),
        }
    }

    /// The cheapest way: up, past the obstacles at one height, down.
    fn route(
        &self,
        space: &Space,
        ends: (&Vec3, &Vec3),
        level: f64,
        cost: &impl Fn(&Vec3) -> f64,
    ) -> Result<(Vec<Vec3>, f64), String> {
        space
            .way(ends, level, cost, |height| self.reaches(space, height))
            .map_err(|no| match no {
                NoRoute::EndInside(which, end) => {
                    let end = if end == 0 { "start" } else { "end" };
                    format!("the {end} is inside the clearance of {}", space.obstacles()[which].name)
                }
                NoRoute::Enclosed => "no path past the obstacles stays inside the travel of the axes".to_owned(),
            })
    }

    /// Whether the axes reach a height.
    fn reaches(&self, space: &Space, height: f64) -> bool {
        let Some(start) = self.run[0].leg.start else {
            return false;
        };
        let here = space.tip(self.machine, &start.joints);
        let rise = Vec3::new(0.0, 0.0, height - here.z);
        let Some(travel) = space.travel(self.machine, &start.joints, &rise) else {
            return true;
        };
        travel
            .iter()
            .all(|(joint, travel)| match self.machine.axes[*joint].limits {
                trunnion_machine::Limits::Range(low, high) => {
                    (low - SAME_MM..=high + SAME_MM).contains(&(start.joints[*joint] + travel)) || height <= here.z
                }
                trunnion_machine::Limits::Unbounded => true,
            })
    }

    /// How programmed coordinates lie in the space.
    fn frame(&self, space: &Space, middle: core::ops::Range<usize>) -> Result<Frame, String> {
        let last = &self.run[middle.end - 1].leg;
        let words = last.motion.end.xyz().ok_or("X, Y or Z is unknown")?;
        let Ok(end) = &last.end else {
            return Err("its end is unknown".into());
        };
        let place = space.tip(self.machine, &end.joints);
        let mut frame = Frame {
            turn: [1.0, 0.0],
            at: [words, place],
        };
        let tip = self.run[0].leg.motion.tcp;
        let (across, beside, up) = space
            .directions(self.machine, &end.joints, tip)
            .ok_or("programmed coordinates are tilted against the obstacles")?;
        let upright = (up - Vec3::z()).norm() <= SAME_MM && across.z.abs() <= SAME_MM && beside.z.abs() <= SAME_MM;
        let turned =
            (beside - Vec3::new(-across.y, across.x, 0.0)).norm() <= SAME_MM && (across.norm() - 1.0).abs() <= SAME_MM;
        if !upright || !turned {
            return Err("programmed coordinates are tilted against the obstacles".into());
        }
        frame.turn = [across.x, across.y];
        // every programmed position of the run is where this says it is
        for rapid in &self.run[middle] {
            let (Some(words), Ok(end)) = (rapid.leg.motion.end.xyz(), &rapid.leg.end) else {
                return Err("X, Y or Z is unknown".into());
            };
            if (frame.to_space(&words) - space.tip(self.machine, &end.joints)).norm() > 1e-6 {
                return Err("programmed coordinates do not follow the tip".into());
            }
        }
        Ok(frame)
    }
}
