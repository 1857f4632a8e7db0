//! Away from the part and back in another posture: the posture, the heights, and the poses in the digits of the program.
use crate::Change;
use crate::slots::{Scheme, Styles};
use crate::style::NumberStyle;
use core::f64::consts::PI;
use trunnion_geometry::{Vec3, deg, rad};
use trunnion_interp::{Feed, MotionKind, Tool};
use trunnion_machine::{
    Joints, Leg, Limits, Machine, Nearness, Orientations, RapidPath, Stance, ToolBody, inverse, linear_steps,
    nearness_with_part, orientations, windings,
};
use trunnion_syntax::Decimal;

/// The first height that is tried, mm, and by how much the next ones are higher.
const LOWEST_MM: f64 = 1.0;
const HIGHER: f64 = 1.25;

/// No height is more, mm.
const HIGHEST_MM: f64 = 2000.0;

/// So many heights just above one are looked at for the one that the digits of the program hit best, and how far above it the last of them is.
const TRIED: u32 = 64;
const ABOVE: f64 = 0.05;

/// Of the tolerance beside the tool axis, what the ramp may use by its lift, and what all of it may be after rounding.
const LIFT_SHARE: f64 = 0.25;
const SHARE: f64 = 0.9;

/// The ramp is no higher than this, mm, nor than this part of its length; one that is lower than the last length is not worth it.
const RAMP_MM: f64 = 1.0;
const RAMP_SLOPE: f64 = 0.25;
const LEAST_RAMP_MM: f64 = 0.002;

/// The feed is not to drop so far that it would be an error, nor near that.
const MARGIN: f64 = 1.25;

/// A cut that turns the machine over, and the cut before it.
pub(crate) struct Flip {
    pub(crate) leg: Leg,
    /// The cut before: a line under tool centre point control.
    pub(crate) last: Option<Box<Leg>>,
    /// X Y Z and the two rotary axes as programmed at its start, mm and deg.
    pub(crate) words: [Option<f64>; 5],
    pub(crate) unit_mm: f64,
    pub(crate) tool: Option<Tool>,
    /// Why it cannot be changed, if so.
    pub(crate) fixed: Option<Change>,
}

/// A pose of the machine: words as text, and joints.
#[derive(Clone, Debug)]
pub(crate) struct Pose {
    pub(crate) texts: [String; 5],
    pub(crate) stance: Stance,
}

/// The poses of an excursion, in their order.
pub(crate) struct Excursion {
    /// Above the part, as it was left.
    pub(crate) out: Pose,
    /// Turned, in the air.
    pub(crate) turned: Pose,
    /// Where the ramp begins.
    pub(crate) ramp: Option<Pose>,
    /// Where the part was left.
    pub(crate) back: Pose,
    /// The tool leaves the part at rapid; else at feed, where the axes of a rapid may leave the tool's axis.
    pub(crate) leaves_at_rapid: bool,
    /// The axes turn at rapid; else at feed, where it is not certain what the axes of a rapid pass.
    pub(crate) at_rapid: bool,
    /// Height, mm.
    pub(crate) height_mm: f64,
}

/// Plans excursions of one program.
pub(crate) struct Planner<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) scheme: Scheme,
    pub(crate) styles: &'a Styles,
    pub(crate) tolerance_mm: f64,
}

fn refused(why: impl Into<String>) -> Change {
    Change::Refused(why.into())
}

impl Planner<'_> {
    /// The excursion before a cut.
    pub(crate) fn plan(&self, flip: &Flip) -> Result<Excursion, Change> {
        let (Some(start), Ok(end)) = (&flip.leg.start, &flip.leg.end) else {
            return Err(refused("a position is unknown"));
        };
        let Some(body) = flip
            .tool
            .as_ref()
            .filter(|tool| tool.shape.is_some())
            .and_then(ToolBody::of)
        else {
            return Err(Change::Possible(
                "shape and diameter of the tool are not declared: [[tool]] shape and diameter in trunnion.toml".into(),
            ));
        };
        let q = self.posture(&start.axis, end)?;
        let back = self.pose(flip, start, q, 0.0)?;
        let ramp = self.ramp(flip, &back)?;
        let (base, base_q) = match &ramp {
            Some((_, base)) => (*base, self.rotary(base)),
            None => (back.stance, self.rotary(&back.stance)),
        };
        // rapids first: the time at the part is the same, and what F means for a turn alone depends on the control
        for kind in [MotionKind::Rapid, MotionKind::Linear] {
            let mut height = LOWEST_MM;
            while height <= HIGHEST_MM {
                let out = self.lifted(flip, start, self.rotary(start), height)?;
                let mut turned = self.lifted(flip, &base, base_q, height)?;
                if kind == MotionKind::Linear {
                    let farther = self.farther(flip, &out.stance, &turned.stance);
                    if farther > 0.0 {
                        turned = self.lifted(flip, &base, base_q, height + farther)?;
                    }
                }
                if !self.inside(&out.stance) || !self.inside(&turned.stance) {
                    break;
                }
                let leaves_at_rapid = self.rapid_keeps_to_axis(start, &out.stance);
                if kind == MotionKind::Rapid && !leaves_at_rapid {
                    break;
                }
                if self.is_clear(flip, (&out.stance, &turned.stance), &body, kind) {
                    return Ok(Excursion {
                        leaves_at_rapid,
                        at_rapid: kind == MotionKind::Rapid,
                        out,
                        turned,
                        ramp: ramp.map(|(pose, _)| pose),
                        back,
                        height_mm: height,
                    });
                }
                height *= HIGHER;
            }
        }
        Err(Change::Possible(format!(
            "at no height along the tool axis inside the travel of the axes is it proved that the tool clears all obstacles by {} mm while the axes turn",
            self.machine.tolerances.clearance_mm()
        )))
    }

    /// How much higher than it left the part the tool is to be turned at feed, mm: the tip must move so far that F says how fast, and that the axes need not
    /// make it much slower.
    fn farther(&self, flip: &Flip, out: &Stance, turned: &Stance) -> f64 {
        let Feed::PerMinute(feed) = flip.leg.motion.feed else {
            return 0.0;
        };
        let axes = self.machine.axes.iter().enumerate();
        let times = axes.filter_map(|(joint, axis)| {
            let speed = axis.max_speed.filter(|speed| *speed > 0.0)?;
            Some((turned.joints[joint] - out.joints[joint]).abs() / speed)
        });
        let needed = feed / 60.0 * times.fold(0.0, f64::max);
        let drops = self.machine.tolerances.feed_drop_error * MARGIN;
        let short = out.tip_distance_to(turned) < drops * needed;
        if short { needed } else { 0.0 }
    }

    /// Whether a rapid out along the tool axis stays on it, whenever its axes arrive, as `certify` will judge it.
    fn rapid_keeps_to_axis(&self, start: &Stance, out: &Stance) -> bool {
        let steps = linear_steps(self.machine, (&start.joints, &out.joints), out.tool_length, 0);
        let off: f64 = steps
            .map(|step| (step - start.axis * step.dot(&start.axis)).norm())
            .sum();
        self.machine.control.rapid == RapidPath::Synchronous || off <= SHARE * self.tolerance_mm
    }

    /// Whether the tool is in the air all along: then it may turn over there.
    pub(crate) fn is_in_the_air(&self, flip: &Flip) -> bool {
        let body = flip.tool.as_ref().and_then(ToolBody::of);
        match (&flip.leg.start, &flip.leg.end, body) {
            (Some(start), Ok(end), Some(body)) => self.is_clear(flip, (start, end), &body, flip.leg.motion.kind),
            _ => false,
        }
    }

    /// Rotary joints that give `axis` nearest to those at the end of the cut, in its posture, rad.
    fn posture(&self, axis: &Vec3, end: &Stance) -> Result<[f64; 2], Change> {
        let Orientations::Postures(postures) = orientations(self.machine, axis) else {
            return Err(refused("the tool axis is at the pole where the cut begins"));
        };
        let mut best: Option<(f64, [f64; 2])> = None;
        for posture in postures.iter().filter(|posture| posture.branch * end.branch >= 0) {
            let mut q = [0.0; 2];
            let mut turn = 0.0f64;
            for (index, &joint) in self.machine.rotary.iter().enumerate() {
                let near = end.joints[joint];
                let Some(&value) = windings(self.machine, joint, posture.q[index], near).first() else {
                    turn = f64::INFINITY;
                    break;
                };
                q[index] = value;
                turn = turn.max((value - near).abs());
            }
            if turn <= PI && best.is_none_or(|(known, _)| turn < known) {
                best = Some((turn, q));
            }
        }
        best.map(|(_, q)| q).ok_or_else(|| {
            refused("from no posture inside the travel of the axes can the cut be made without a change of posture")
        })
    }

    fn rotary(&self, stance: &Stance) -> [f64; 2] {
        let mut q = [0.0; 2];
        for (slot, &joint) in q.iter_mut().zip(&self.machine.rotary) {
            *slot = stance.joints[joint];
        }
        q
    }

    /// A pose at a height of about this along the tool axis, mm: of the heights nearby the one that the digits of the program hit best.
    fn lifted(&self, flip: &Flip, at: &Stance, q: [f64; 2], height: f64) -> Result<Pose, Change> {
        let mut best: Option<(f64, Pose)> = None;
        for step in 0..TRIED {
            let height = height * (1.0 + ABOVE * f64::from(step) / f64::from(TRIED));
            let pose = self.pose(flip, at, q, height)?;
            let way = pose.stance.tip - at.tip;
            let beside = (way - at.axis * way.dot(&at.axis)).norm();
            if best.as_ref().is_none_or(|(known, _)| beside < *known) {
                best = Some((beside, pose));
            }
        }
        best.map(|(_, pose)| pose).ok_or_else(|| refused("no height"))
    }

    /// The pose with the tip and tool axis of `at`, lifted along it, with these rotary joints, in the digits of the program.
    fn pose(&self, flip: &Flip, at: &Stance, q: [f64; 2], height_mm: f64) -> Result<Pose, Change> {
        let (Some(start), motion) = (&flip.leg.start, &flip.leg.motion) else {
            return Err(refused("a position is unknown"));
        };
        let mut texts: [String; 5] = Default::default();
        let mut joints: Joints = start.joints;
        for (index, &joint) in self.machine.rotary.iter().enumerate() {
            let word = flip.words[3 + index].ok_or_else(|| refused("a rotary position is unknown"))?;
            let value = word + deg(q[index] - start.joints[joint]);
            let (text, value) = self.number(3 + index, value, flip.unit_mm)?;
            joints[joint] = start.joints[joint] + rad(value - word);
            texts[3 + index] = text;
        }
        let zero = Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2]);
        let tip = at.tip + at.axis * height_mm;
        let mut linear = [0.0; 3];
        if !motion.tcp {
            inverse(self.machine, &mut joints, &(tip + zero), start.tool_length)
                .ok_or_else(|| refused("the linear axes cannot follow"))?;
        }
        for (index, value) in linear.iter_mut().enumerate() {
            let word = flip.words[index].ok_or_else(|| refused("a position is unknown"))?;
            let joint = self.machine.joint(b"XYZ"[index]);
            let change = match joint {
                _ if motion.tcp => tip[index] - start.tip[index],
                Some(joint) => joints[joint] - start.joints[joint],
                None => return Err(refused("the machine lacks a linear axis")),
            };
            let (text, rounded) = self.number(index, word + change, flip.unit_mm)?;
            *value = rounded - word;
            texts[index] = text;
        }
        if motion.tcp {
            let tip = start.tip + Vec3::new(linear[0], linear[1], linear[2]);
            inverse(self.machine, &mut joints, &(tip + zero), start.tool_length)
                .ok_or_else(|| refused("the linear axes cannot follow"))?;
        } else {
            for (letter, value) in b"XYZ".iter().zip(linear) {
                if let Some(joint) = self.machine.joint(*letter) {
                    joints[joint] = start.joints[joint] + value;
                }
            }
        }
        Ok(Pose {
            texts,
            stance: Stance::at(self.machine, &joints, start.tool_length, &zero),
        })
    }

    /// A number in the digits of the program, and its value, mm or deg.
    fn number(&self, index: usize, value: f64, unit_mm: f64) -> Result<(String, f64), Change> {
        let unit = if index < 3 { unit_mm } else { 1.0 };
        let style = self.styles[index].ok_or_else(|| {
            refused(format!(
                "the program never writes {} as a plain number",
                self.scheme.name(index)
            ))
        })?;
        let least = if index < 3 && unit > 1.0 { 4 } else { 3 };
        let style = NumberStyle {
            decimals: style.decimals.max(least),
            ..style
        };
        let text = style.write(value / unit, false);
        let value = Decimal::parse(text.as_bytes()).map(Decimal::to_f64);
        let value = value.ok_or_else(|| refused("a number has too many digits"))?;
        Ok((text, value * unit))
    }

    /// Where a ramp above the cut before begins, and the pose of that cut below it; `None`: there is no room for one.
    fn ramp(&self, flip: &Flip, back: &Pose) -> Result<Option<(Pose, Stance)>, Change> {
        let Some(last) = flip.last.as_ref().filter(|_| flip.leg.motion.tcp) else {
            return Ok(None);
        };
        let Some(from) = &last.start else { return Ok(None) };
        let Ok(q) = self.posture(&from.axis, &back.stance) else {
            return Ok(None);
        };
        let base = self.pose(flip, from, q, 0.0)?;
        let left = flip.leg.start.as_ref().map_or(q, |start| self.rotary(start));
        let turned = self.rotary(&base.stance);
        if left.iter().zip(turned).any(|(was, is)| (was - is).abs() > PI + 1e-9) {
            // `angle-wrap` would rightly ask why
            return Ok(None);
        }
        let turn: f64 = last.rotary_change.iter().sum();
        let length = from.tip_distance_to(&back.stance);
        let height = (LIFT_SHARE * self.tolerance_mm / turn.max(1e-9))
            .min(RAMP_MM)
            .min(RAMP_SLOPE * length);
        if height < LEAST_RAMP_MM {
            return Ok(None);
        }
        let pose = self.lifted(flip, from, self.rotary(&base.stance), height)?;
        // as `certify` will judge it
        let lift = pose.stance.tip - from.tip;
        let up = lift.dot(&from.axis);
        let beside = (lift - from.axis * up).norm() + lift.norm() * turn;
        Ok((up > 0.0 && beside <= SHARE * self.tolerance_mm).then_some((pose, base.stance)))
    }

    fn inside(&self, stance: &Stance) -> bool {
        let mut axes = self.machine.axes.iter().zip(stance.joints);
        axes.all(|(axis, value)| match axis.limits {
            Limits::Unbounded => true,
            Limits::Range(low, high) => value >= low && value <= high,
        })
    }

    /// Whether the tool clears all obstacles while the axes turn, as `certify` will judge it.
    fn is_clear(&self, flip: &Flip, (from, to): (&Stance, &Stance), body: &ToolBody, kind: MotionKind) -> bool {
        let mut leg = flip.leg.clone();
        leg.motion.kind = kind;
        for (change, &joint) in leg.rotary_change.iter_mut().zip(&self.machine.rotary) {
            *change = (to.joints[joint] - from.joints[joint]).abs();
        }
        leg.start = Some(*from);
        leg.end = Ok(*to);
        let keep = self.machine.tolerances.clearance_mm();
        let found = nearness_with_part(self.machine, &leg, body, keep);
        found.iter().all(|near| matches!(near.nearness, Nearness::Clear(_)))
    }
}
