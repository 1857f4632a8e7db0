//! Tool centre point control and the tool's length, switched where the motions of the original program need them.
use crate::emit_code::Writer;
use crate::plan::Mode;
use crate::{OrientationWords, Refused};
use trunnion_interp::LengthOf;
use trunnion_syntax::{BlockId, Format};

impl Writer<'_> {
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
