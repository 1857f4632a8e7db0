//! What is written and how: the target, checked before anything is read.
use crate::clamps::Clamping;
use crate::emit_apt::{self, AptWriter};
use crate::emit_code::{Writer, Written};
use crate::job::Job;
use crate::number::rounding;
use crate::plan::{Mode, Out};
use crate::{Options, OrientationWords, Post, Refused, Target};
use trunnion_certify::conversion::{Ask, ConversionClaim, Reading};
use trunnion_dialect::{Action, Dialect};
use trunnion_geometry::deg;
use trunnion_interp::{AllClampCodes, ClampCodes, Setup};
use trunnion_machine::{Machine, Side};
use trunnion_syntax::Format;

/// Tolerance where neither machine nor user names one, mm.
const TOLERANCE_MM: f64 = 0.01;

/// Tolerance of the tool axis inside a cut where the user names none, deg.
const TOLERANCE_DEG: f64 = 0.5;

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
                "the post for {} has no {what} (`{key}`); use --no-tcp, or add one in a post of your own (--post)",
                post.dialect
            );
            Err(Refused::new(message))
        };
        if vectors && !options.tcp {
            return Err(Refused::new(
                "tool vectors need tool centre point control: remove --no-tcp",
            ));
        }
        if vectors && (post.template("tcp-vectors-on").is_none() || post.template("vector").is_none()) {
            return lacks("tcp-vectors-on", "tool vectors");
        }
        if inch && post.template("units-inch").is_none() {
            return Err(Refused::new(format!(
                "the post for {} writes no programs in inch: remove --units inch",
                post.dialect
            )));
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

    /// Whether blocks of Klartext are written.
    pub(crate) fn klartext(&self) -> bool {
        self.dialect.lex.format == Format::Klartext
    }

    /// Codes of the clamps of the machine, as far as they can be written: not if they mean something else on the control.
    pub(crate) fn clamp_codes(&self) -> AllClampCodes {
        let mut codes = self.machine.map(Machine::clamp_codes).unwrap_or_default();
        for slot in &mut codes {
            *slot = slot.filter(|codes| self.can_write(*codes));
        }
        codes
    }

    fn can_write(&self, codes: ClampCodes) -> bool {
        let free = |code: u16| {
            let known = self.dialect.m(u32::from(code) * 10);
            known.is_none_or(|code| {
                let grouped = code.group.as_deref();
                code.action == Action::NoMotion && grouped.is_none_or(|group| group == "clamp")
            })
        };
        let words = self.post.is_some_and(|post| post.template("auxiliary").is_some());
        words && free(codes.on) && free(codes.off)
    }

    /// Letters of the axes with a clamp whose codes are not written.
    pub(crate) fn clamps_left(&self) -> Vec<char> {
        let axes = self.machine.map_or(&[][..], |machine| &machine.axes);
        let left = axes.iter().filter(|axis| match axis.extra.clamp_codes {
            Some(codes) => !self.can_write(codes),
            None => axis.extra.clamp,
        });
        left.map(|axis| char::from(axis.letter)).collect()
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.post.is_none_or(|post| post.template(key).is_some())
    }

    /// What the post declares about codes that the dialect leaves to the machine builder.
    pub(crate) fn meanings(&self) -> Vec<(String, Option<Ask>)> {
        self.post.map(|post| post.meanings(self.dialect)).unwrap_or_default()
    }

    fn tolerance(&self) -> f64 {
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
                "{} turns the tool, so axis positions depend on the length of {which}, which is not declared: \
                 add (trunnion: tool 1 ball diameter 10 length 100)",
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
        (outs, stays): (&[Out], &[u16]),
        setup: &Setup,
        options: &Options,
    ) -> Result<Written, Refused> {
        let Some(post) = self.post else {
            return Ok(Written {
                text: AptWriter::new(reading, options, outs).write(job, outs)?,
                moved: Vec::new(),
                clamping: Clamping::default(),
            });
        };
        let write = |clamping| Writer::new((reading, stays), post, self, options, setup, clamping).write(job, outs);
        let written = write(Clamping::default())?;
        let codes = self.clamp_codes();
        if codes == AllClampCodes::default() {
            return Ok(written);
        }
        write(Clamping::planned(&codes, &written.clamping))
    }

    /// One unit of the last digit of lengths in the output, mm; 0 for CL data.
    pub(crate) fn length_step(&self, options: &Options) -> f64 {
        let inch = usize::from(options.units == crate::Units::Inch);
        self.post.map_or(0.0, |post| {
            options.units.mm() / 10f64.powi(i32::try_from(post.length[inch]).unwrap_or(i32::MAX))
        })
    }

    /// How far the tip (mm) and the tool axis (deg) may be from where they were inside a cut. `None`: CL data, which say nothing of the axis between
    /// their points, or tool vectors, which the control interpolates.
    pub(crate) fn tolerances(
        &self,
        source: Option<&Machine>,
        options: &Options,
    ) -> Result<(f64, Option<f64>), Refused> {
        let judged = source.is_some() && self.post.is_some() && self.mode.machine().is_some();
        if options.tolerance_deg.is_some() && !judged {
            let message = "a tolerance of the tool axis holds only where the rotary joints of a known machine are written: CL data and tool vectors say \
                           nothing of the axis between two points. Leave it out, or put points in between before, with `fix --rewrite insert-points`";
            return Err(Refused::new(message));
        }
        let degrees = judged.then(|| options.tolerance_deg.unwrap_or(TOLERANCE_DEG));
        let mm = options.tolerance_mm.unwrap_or_else(|| self.tolerance());
        let good = |value: f64| value.is_finite() && value > 0.0;
        if !good(mm) || !degrees.is_none_or(good) {
            let message =
                "the tolerance must be a positive number of millimetres, and that of the tool axis of degrees";
            return Err(Refused::new(message));
        }
        Ok((mm, degrees))
    }

    pub(crate) fn claim(&self, options: &Options, path_mm: f64, axis_deg: Option<f64>) -> ConversionClaim {
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
            path_deg: axis_deg,
            feed_mm_min: rounding(feed) * unit * (1.0 + 1e-9) + 1e-9,
            time_share: 1e-4,
        }
    }
}
