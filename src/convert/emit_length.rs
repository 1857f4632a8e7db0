//! Tool centre point control and the tool's length, switched where the motions of the original program need them.
use crate::emit_code::Writer;
use crate::plan::Mode;
use crate::{OrientationWords, Refused};
use trunnion_interp::LengthOf;
use trunnion_syntax::{BlockId, Format};

/// Coordinates that differ by less are the same, mm.
const SAME_MM: f64 = 1e-6;

impl Writer<'_> {
    /// Axes that a motion must not name, bits from X. Refused where one of them moves: no word says where to.
    pub(crate) fn stays_in(&self, index: usize, block: BlockId) -> Result<u16, Refused> {
        let stays = self.all_stay.get(index).copied().unwrap_or(0);
        let motion = &self.reading.motions[index].motion;
        if let (1.., Some(start), Some(end)) = (stays, motion.start.xyz(), motion.end.xyz())
            && let Some(axis) =
                (0..3).find(|axis| stays & 1 << axis != 0 && (end[*axis] - start[*axis]).abs() > SAME_MM)
        {
            let message = format!(
                "where {} is after the change of the zero point depends on values that nobody declares: declare the zero points in [work_offsets], or \
                 program X, Y and Z after the change",
                crate::emit_code::WORDS[axis]
            );
            return Err(self.refuse(Some(block), message));
        }
        Ok(stays)
    }

    /// Tool centre point control on, or the tool's length.
    pub(crate) fn get_ready(&mut self, block: BlockId) -> Result<(), Refused> {
        if self.ready {
            return Ok(());
        }
        let vectors = self.options.orientation == OrientationWords::Vectors;
        let key = match self.mode {
            Mode::TipRotary(_) => "tcp-words-on",
            Mode::Tip if vectors => "tcp-vectors-on",
            Mode::Tip | Mode::Joints(_) => "length-on",
        };
        self.ready = true;
        self.length_set = true;
        let tool = self.tool.map(|tool| tool.to_string());
        // a length is compensated where there is a tool; without one the words are those of the spindle's nose
        if key != "length-on" || tool.is_some() && self.post.template(key).is_some() {
            let code = self.post.tcp_code(self.mode.machine(), true);
            self.template(key, Some(block), |name| match name {
                "tool" => tool.clone(),
                "tcp_on" => code.clone(),
                _ => None,
            })?;
        }
        self.forget_coordinates();
        self.modal.forget("motion");
        Ok(())
    }

    /// Whether a motion comes before the tool's length is active, and that length is not declared: then X Y Z are written as they are, since what the
    /// length would add is unknown.
    pub(crate) fn waits(&self, index: usize) -> bool {
        let posed = &self.reading.motions[index];
        !self.ready
            && !self.guides_tip()
            && self.reading.tells_lengths
            && posed.length_of == LengthOf::Nothing
            && posed.tool_length == 0.0
            && self.reading.program.options().format != Format::Apt
    }

    /// Whether the output runs under tool centre point control.
    fn guides_tip(&self) -> bool {
        match self.mode {
            Mode::TipRotary(_) => true,
            Mode::Tip => self.options.orientation == OrientationWords::Vectors,
            Mode::Joints(_) => false,
        }
    }

    /// The tool's length, where tool centre point control stays off.
    pub(crate) fn length_on(&mut self, block: BlockId) -> Result<(), Refused> {
        if !self.guides_tip() {
            return self.get_ready(block);
        }
        self.not_ready()?;
        let tool = self.tool.map(|tool| tool.to_string());
        if tool.is_some() && self.post.template("length-on").is_some() {
            self.template("length-on", Some(block), |name| tool.clone().filter(|_| name == "tool"))?;
        }
        self.length_set = true;
        Ok(())
    }

    /// No length, for motions that the original program makes without one.
    pub(crate) fn length_off(&mut self, block: BlockId) -> Result<(), Refused> {
        if std::mem::take(&mut self.length_set) && self.post.template("length-off").is_some() {
            self.template("length-off", Some(block), |_| None)?;
            self.forget_coordinates();
        }
        Ok(())
    }

    pub(crate) fn not_ready(&mut self) -> Result<(), Refused> {
        if std::mem::take(&mut self.ready) && self.guides_tip() {
            let code = self.post.tcp_code(self.mode.machine(), false);
            self.template("tcp-off", None, |name| code.clone().filter(|_| name == "tcp_off"))?;
        }
        Ok(())
    }
}
