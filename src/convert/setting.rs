//! What is written and how: the target, checked before anything is read.
use crate::emit_apt::{self, AptWriter};
use crate::emit_code::Writer;
use crate::job::Job;
use crate::number::rounding;
use crate::plan::{Mode, Out};
use crate::{Options, OrientationWords, Post, Refused, Target};
use trunnion_certify::conversion::{ConversionClaim, Reading};
use trunnion_dialect::Dialect;
use trunnion_geometry::deg;
use trunnion_interp::Setup;
use trunnion_machine::{Machine, Side};

/// Tolerance where neither machine nor user names one, mm.
const TOLERANCE_MM: f64 = 0.01;

/// What is written, and how.
pub(crate) struct Setting<'a> {
    pub(crate) mode: Mode<'a>,
    pub(crate) post: Option<&'a Post>,
    pub(crate) machine: Option<&'a Machine>,
    pub(crate) dialect: &'static Dialect,
    pub(crate) vectors: bool,
    pub(crate) inch: bool,
}

impl<'a> Setting<'a> {
    pub(crate) fn new(target: &Target<'a>, options: &Options) -> Result<Self, Refused> {
        let inch = options.units == crate::Units::Inch;
        let named = |name: &str| {
            trunnion_dialect::builtin(name).ok_or_else(|| Refused::new(format!("no dialect is named {name}")))
        };
        let Target::Code { post, machine } = *target else {
            return Ok(Self {
                mode: Mode::Tip,
                post: None,
                machine: None,
                dialect: named("apt")?,
                vectors: false,
                inch,
            });
        };
        let vectors = options.orientation == OrientationWords::Vectors;
        let rotary = machine.is_some_and(|machine| !machine.rotary.is_empty());
        let lacks = |key: &str, what: &str| {
            let message = format!(
                "the post for {} has no {what} (`{key}`); use --no-tcp, or write one into a post of your own (--post)",
                post.dialect
            );
            Err(Refused::new(message))
        };
        if vectors && !options.tcp {
            return Err(Refused::new(
                "tool vectors need tool centre point control: leave --no-tcp out",
            ));
        }
        if vectors && (post.template("tcp-vectors-on").is_none() || post.template("vector").is_none()) {
            return lacks("tcp-vectors-on", "tool vectors");
        }
        let mode = match machine {
            _ if vectors => Mode::Tip,
            None => Mode::Tip,
            Some(machine) if rotary && options.tcp => {
                if post.template("tcp-words-on").is_none() {
                    return lacks("tcp-words-on", "tool centre point control");
                }
                Mode::TipRotary(machine)
            }
            Some(machine) => Mode::Joints(machine),
        };
        if let (Mode::Joints(machine), Some(_)) = (mode, machine)
            && machine.joint_of_letter[..3].contains(&None)
        {
            return Err(Refused::new(format!(
                "{} has no axes X Y Z to write words for",
                machine.id
            )));
        }
        Ok(Self {
            mode,
            post: Some(post),
            machine,
            dialect: named(&post.dialect)?,
            vectors,
            inch,
        })
    }

    /// Letters of the axes that codes clamp.
    pub(crate) fn clamps(&self) -> Vec<char> {
        let axes = self.machine.map_or(&[][..], |machine| &machine.axes);
        let clamped = axes.iter().filter(|axis| axis.extra.clamp_codes.is_some());
        clamped.map(|axis| char::from(axis.letter)).collect()
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.post.is_none_or(|post| post.template(key).is_some())
    }

    pub(crate) fn tolerance(&self) -> f64 {
        self.machine.map_or(TOLERANCE_MM, |machine| machine.tolerances.tip_mm)
    }

    /// Whether the tool's length is compensated in the output: by a code, or with the tool's change.
    pub(crate) fn compensates(&self) -> bool {
        let code = self.post.and_then(|post| post.template("length-on"));
        self.dialect.quirks.edge_at_tool_change || code.is_some_and(|code| !code.trim().is_empty())
    }

    /// Without tool centre point control a head that turns needs the tool's length.
    pub(crate) fn head_lengths(&self, reading: &Reading, job: &Job) -> Result<(), Refused> {
        let Mode::Joints(machine) = self.mode else {
            return Ok(());
        };
        let turns = machine
            .rotary
            .iter()
            .any(|&joint| machine.axes[joint].side == Side::Head);
        let unknown = job
            .tools
            .iter()
            .find(|(_, tool)| tool.is_none_or(|tool| tool.length_mm.is_none()));
        if turns && (unknown.is_some() || job.tools.is_empty()) {
            let which = unknown.map_or_else(|| "the tool".to_owned(), |(number, _)| format!("tool {number}"));
            let message = format!(
                "{} turns the tool, so that joints depend on the length of {which}, which is not declared: \
                 (trunnion: tool 1 ball diameter 10 length 100)",
                machine.id
            );
            return match reading.motions.first() {
                Some(posed) => Err(Refused::at(&reading.program, posed.motion.block, message)),
                None => Err(Refused::new(message)),
            };
        }
        Ok(())
    }

    pub(crate) fn write(
        &self,
        reading: &Reading,
        job: &Job,
        outs: &[Out],
        setup: &Setup,
        options: &Options,
    ) -> Result<(String, Vec<u32>), Refused> {
        match self.post {
            None => Ok((AptWriter::new(reading, options, outs).write(job, outs)?, Vec::new())),
            Some(post) => {
                let name = self.machine.map_or("", |machine| machine.name.as_str());
                Writer::new(reading, post, self.mode, options, setup, name).write(job, outs)
            }
        }
    }

    /// What the digits of the output can hold.
    pub(crate) fn claim(&self, options: &Options, path_mm: f64) -> ConversionClaim {
        let unit = options.units.mm();
        let (length, angle, vector, feed) = match self.post {
            None => (
                emit_apt::LENGTH[usize::from(self.inch)],
                0,
                emit_apt::VECTOR,
                emit_apt::FEED,
            ),
            Some(post) => (post.length[usize::from(self.inch)], post.angle, post.vector, post.feed),
        };
        let end_mm = 3f64.sqrt() * rounding(length) * unit * (1.0 + 1e-9) + 1e-9;
        let by_vector = deg(3f64.sqrt() * rounding(vector));
        let end_deg = match self.mode {
            Mode::TipRotary(_) | Mode::Joints(_) => 2.0 * rounding(angle),
            Mode::Tip => by_vector,
        };
        ConversionClaim {
            // rounded angles move the tip of a machine that runs its joints
            end_mm: if matches!(self.mode, Mode::Joints(_)) {
                path_mm
            } else {
                end_mm
            },
            end_deg: end_deg + 1e-7,
            path_mm: path_mm.max(end_mm),
            path_deg: None,
            feed_mm_min: rounding(feed) * unit * (1.0 + 1e-9) + 1e-9,
            time_share: 1e-4,
        }
    }
}
