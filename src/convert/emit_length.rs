//! Tool centre point control and the tool's length, switched where the motions of the original program need them.
use crate::emit_code::Writer;
use crate::plan::Mode;
use crate::template::fill;
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

    /// If tool centre point control is on from the start, it is switched off: until a tool is in the spindle, or for the whole program.
    pub(crate) fn joints_at_start(&mut self) -> Result<(), Refused> {
        let Some(machine) = self.mode.machine() else {
            return Ok(());
        };
        let codes = machine.control.tcp_codes.as_ref().filter(|codes| codes.at_start);
        match codes.map(|codes| codes.off.first()) {
            Some(Some(off)) => self.line(off),
            Some(None) if matches!(self.mode, Mode::Joints(_)) => {
                let message = format!(
                    "{} starts programs with tool centre point control on, and its file names no code that switches it off: remove --no-tcp",
                    machine.id
                );
                return Err(self.refuse(None, message));
            }
            _ => {}
        }
        Ok(())
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
            let value = |name: &str| match name {
                "tool" => tool.clone(),
                "tcp_on" => code.clone(),
                _ => None,
            };
            let template = self.post.template(key).unwrap_or_default();
            let one_code = key == "length-on" && !template.trim().is_empty() && !template.trim().contains('\n');
            match fill(template, value).ok().filter(|_| one_code) {
                Some(length) => self.length_waits = Some(length.trim().to_owned()),
                None => self.template(key, Some(block), value)?,
            }
        }
        self.forget_coordinates();
        self.modal.forget("motion");
        Ok(())
    }

    /// Writes the length that waits into a block that moves along the tool, at this place among its words. In a block of its own, or with other axes, it would be
    /// the setting of the control whether the tool travels its length there.
    pub(crate) fn join_length(&mut self, words: &mut Vec<String>, at: usize) {
        if words[at..].iter().any(|word| word.starts_with('Z'))
            && let Some(length) = self.length_waits.take()
        {
            words.insert(at, length);
        }
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
        self.length_waits = None;
        if std::mem::take(&mut self.length_set) && self.post.template("length-off").is_some() {
            self.template("length-off", Some(block), |_| None)?;
            self.forget_coordinates();
        }
        Ok(())
    }

    pub(crate) fn not_ready(&mut self) -> Result<(), Refused> {
        self.length_waits = None;
        if std::mem::take(&mut self.ready) && self.guides_tip() {
            let code = self.post.tcp_code(self.mode.machine(), false);
            self.template("tcp-off", None, |name| code.clone().filter(|_| name == "tcp_off"))?;
        }
        Ok(())
    }
}
