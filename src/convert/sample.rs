//! Poses along a motion as words of the target: how many equal parts keep the tip within tolerance, and what each ends with.
use crate::posture::nearest;
use trunnion_certify::conversion::{Track, joint_bend};
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg};
use trunnion_machine::{Joints, MAX_AXES, Machine, inverse, tool_axis_at};

/// What turns joints into words: zero point and active tool length in the output program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Work offset, mm and deg, order of `AXIS_LETTERS`.
    pub(crate) zero: [f64; 9],
    /// Compensated tool length, mm.
    pub(crate) length: f64,
}

/// Most parts of one motion.
const MOST_PARTS: usize = 20_000;

/// Share of the tolerance that linearisation may use; the rest is for rounding.
const SHARE: f64 = 0.8;

/// Share of the tolerance of the tool axis: the bound of the proof is wider than what is found halfway.
const AXIS_SHARE: f64 = 0.4;

/// All joints of a pose: rotary ones given, linear ones solved for the tip (programmed coordinates).
pub(crate) fn joints(machine: &Machine, q: [f64; 2], tip: &Vec3, frame: &Frame) -> Option<Joints> {
    let mut joints = held(machine);
    for (&joint, value) in machine.rotary.iter().zip(q) {
        joints[joint] = value;
    }
    let zero = Vec3::new(frame.zero[0], frame.zero[1], frame.zero[2]);
    inverse(machine, &mut joints, &(tip + zero), frame.length)?;
    Some(joints)
}

/// All joints at zero, except those that the machine file holds at another position.
fn held(machine: &Machine) -> Joints {
    let mut joints = [0.0; MAX_AXES];
    for (joint, axis) in joints.iter_mut().zip(&machine.axes) {
        *joint = axis.extra.hold.unwrap_or(0.0);
    }
    joints
}

/// X Y Z of joints, mm: without the zero point and without what the tool's length adds along its axis at home.
pub(crate) fn words(machine: &Machine, joints: &Joints, frame: &Frame) -> Option<Vec3> {
    let (mut with, mut without) = (held(machine), held(machine));
    inverse(machine, &mut with, &Vec3::zeros(), frame.length)?;
    inverse(machine, &mut without, &Vec3::zeros(), 0.0)?;
    let mut words = Vec3::zeros();
    for (letter, slot) in words.iter_mut().enumerate() {
        let joint = usize::from(machine.joint_of_letter[letter]?);
        *slot = joints[joint] - frame.zero[letter] - (with[joint] - without[joint]);
    }
    Some(words)
}

/// The end of a part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartEnd {
    pub(crate) tip: Vec3,
    pub(crate) axis: Vec3,
    pub(crate) q: [f64; 2],
    pub(crate) joints: Option<Joints>,
}

/// How rotary joints are found inside a motion.
pub(crate) struct Between<'a> {
    pub(crate) machine: Option<&'a Machine>,
    /// Rotary joints at the motion's ends.
    pub(crate) from: [f64; 2],
    pub(crate) to: [f64; 2],
    /// The original program runs on the same machine, with words: its own joints are kept.
    pub(crate) keep: bool,
    pub(crate) frame: Frame,
}

impl Between<'_> {
    /// `count` equal parts of a motion. `Err`: why a pose inside cannot be reached.
    pub(crate) fn ends(&self, track: &Track<'_>, count: usize, joints_too: bool) -> Result<Vec<PartEnd>, String> {
        let mut ends = Vec::with_capacity(count);
        let mut before = self.from;
        for index in 1..=count {
            let share = index as f64 / count as f64;
            let pose = track.at(share);
            let q = match self.machine {
                None => [0.0; 2],
                Some(_) if index == count => self.to,
                Some(machine) => track
                    .rotary_at(share)
                    .filter(|_| self.keep)
                    .or_else(|| nearest(machine, &pose.axis, before))
                    .ok_or("a tool axis inside the motion cannot be reached")?,
            };
            before = q;
            let joints = match self.machine.filter(|_| joints_too) {
                Some(machine) => {
                    Some(joints(machine, q, &pose.tip, &self.frame).ok_or("the linear axes do not span space there")?)
                }
                None => None,
            };
            ends.push(PartEnd {
                tip: pose.tip,
                axis: pose.axis,
                q,
                joints,
            });
        }
        Ok(ends)
    }

    /// Parts after which the tip, straight between their ends, stays within tolerance of a curved path, and the tool axis, turned by another
    /// machine, within its tolerance (deg) halfway between them; the proof bounds it everywhere.
    pub(crate) fn chords(
        &self,
        track: &Track<'_>,
        tolerance_mm: f64,
        axis_deg: Option<f64>,
    ) -> Result<Vec<PartEnd>, String> {
        let mut wanted = (track.bend().0 / (8.0 * SHARE * tolerance_mm)).sqrt().ceil().max(1.0);
        let mut worst = 0.0;
        loop {
            if wanted > MOST_PARTS as f64 {
                return Err(if worst > 0.0 {
                    format!(
                        "the rotary axes of the target would turn another way than those of the original inside this cut: between the ends the tool axis \
                         would be {worst:.3} deg away. Split the cut, or retract before it"
                    )
                } else {
                    too_many(wanted)
                });
            }
            let ends = self.ends(track, wanted as usize, false)?;
            worst = self.axis_apart(track, &ends);
            let Some(room) = axis_deg.map(|limit| AXIS_SHARE * limit).filter(|room| worst > *room) else {
                return Ok(ends);
            };
            wanted = (wanted * (worst / room).sqrt().min(8.0)).ceil().max(wanted + 1.0);
        }
    }

    /// How far the tool axis is from that of the track halfway through each part, where the rotary joints run linearly: the worst, deg.
    fn axis_apart(&self, track: &Track<'_>, ends: &[PartEnd]) -> f64 {
        let Some(machine) = self.machine.filter(|_| !self.keep) else {
            return 0.0;
        };
        let mut before = self.from;
        let mut worst = 0.0f64;
        for (index, end) in ends.iter().enumerate() {
            let half = [0, 1].map(|joint| 0.5 * (before[joint] + end.q[joint]));
            let share = (index as f64 + 0.5) / ends.len() as f64;
            worst = worst.max(deg(angle_between(&tool_axis_at(machine, half), &track.at(share).axis)));
            before = end.q;
        }
        worst
    }

    /// Parts in which the joints run linearly and the tip stays within tolerance: the bound Q h^2 / 8 of both paths (kinematics notes 3).
    pub(crate) fn joint_parts(
        &self,
        track: &Track<'_>,
        start: &Joints,
        tolerance_mm: f64,
    ) -> Result<Vec<PartEnd>, String> {
        let Some(machine) = self.machine else {
            return self.chords(track, tolerance_mm, None);
        };
        let room = SHARE * tolerance_mm;
        let mut count = 1;
        loop {
            let ends = self.ends(track, count, true)?;
            let own = track.bend().0 / (count as f64 * count as f64);
            let mut worst = 0.0f64;
            let mut before = *start;
            for end in &ends {
                let Some(joints) = end.joints else { continue };
                let bend = joint_bend(machine, &[before, joints], self.frame.length);
                worst = worst.max((bend + own) / 8.0);
                before = joints;
            }
            if worst <= room {
                return Ok(ends);
            }
            let wanted = (count as f64 * (worst / room).sqrt()).ceil().max(count as f64 + 1.0);
            if wanted > MOST_PARTS as f64 {
                return Err(too_many(wanted));
            }
            count = wanted as usize;
        }
    }
}

fn too_many(wanted: f64) -> String {
    format!(
        "it would take {wanted:.0} blocks to keep the tolerance (at most {MOST_PARTS}): the rotary axes turn too far here; \
         allow more with --tolerance-mm, or use tool centre point control"
    )
}
