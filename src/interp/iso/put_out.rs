//! The motions of a block on their way out: through corners and compensation, with the feed that FGROUP makes of F, out of a tilted plane.
use crate::core::Report;
use crate::iso::Iso;
use crate::{Motion, Sink};
use trunnion_syntax::{Block, TextRange};

impl Iso<'_> {
    /// Emits the motions of a block.
    #[inline]
    pub(super) fn put_out(&mut self, motion: Option<&Motion>, block: &Block<'_>, sink: &mut impl Sink) {
        let memory = &self.memory;
        if memory.compensation.is_busy() || !memory.compensation.ready.is_empty() || memory.corners.is_busy() {
            self.put_out_compensated(motion, block, sink);
            return;
        }
        if memory.own.feed_group.acts() {
            self.put_out_measured(motion, block, sink);
            return;
        }
        if !self.memory.out.is_empty() {
            for motion in &self.memory.out {
                sink.motion(&self.untilted(motion), &self.core.state);
            }
            self.memory.out.clear();
        }
        if let Some(motion) = motion {
            sink.motion(&self.untilted(motion), &self.core.state);
        }
    }

    /// The same where F may be measured along other axes than X, Y and Z.
    #[cold]
    fn put_out_measured(&mut self, motion: Option<&Motion>, block: &Block<'_>, sink: &mut impl Sink) {
        let out = std::mem::take(&mut self.memory.out);
        for motion in out.iter().chain(motion) {
            let measured = self.measured(motion);
            sink.motion(&self.untilted(&measured), &self.core.state);
        }
        self.open_feeds(block, sink);
    }

    /// Reports that F of motions is not known.
    fn open_feeds(&mut self, block: &Block<'_>, sink: &mut impl Sink) {
        if let Some(kind) = self.memory.own.feed_group.take_open() {
            let mut report = Report {
                program: block.program(),
                block: block.id(),
                record: None,
                faults: &mut |fault| sink.fault(fault),
            };
            report.fault(TextRange::default(), kind);
        }
    }

    /// The same while cutter compensation holds motions back.
    #[cold]
    fn put_out_compensated(&mut self, motion: Option<&Motion>, block: &Block<'_>, sink: &mut impl Sink) {
        let mut report = Report {
            program: block.program(),
            block: block.id(),
            record: None,
            faults: &mut |fault| sink.fault(fault),
        };
        let out = std::mem::take(&mut self.memory.out);
        if out.is_empty() && motion.is_none() {
            self.note_still_block(block);
        }
        let mut on = Vec::new();
        for motion in out.iter().chain(motion) {
            self.round_corner(motion, &mut on, &mut report);
        }
        if self.core.state.ended {
            self.end_corners(&mut on, &mut report);
        }
        for told in on {
            if self.memory.compensation.is_busy() {
                self.compensate(told, &mut report);
            } else {
                self.memory.compensation.ready.push(told);
            }
        }
        if self.core.state.ended {
            self.end_compensation(&mut report);
        }
        let ready = std::mem::take(&mut self.memory.compensation.ready);
        let measures = self.memory.own.feed_group.acts();
        for (mut motion, state) in ready {
            if measures {
                motion = self.measured(&motion);
            }
            sink.motion(&self.untilted(&motion), &state);
        }
        self.open_feeds(block, sink);
    }

    /// What is pending at the end of a program without an end code.
    pub(crate) fn put_out_rest(&mut self, block: &Block<'_>, sink: &mut impl Sink) {
        if self.memory.own.splines.course.is_some() {
            let mut report = Report {
                program: block.program(),
                block: block.id(),
                record: None,
                faults: &mut |fault| sink.fault(fault),
            };
            self.spline_ends(&mut report);
        }
        let waits = !self.memory.compensation.ready.is_empty();
        if waits || self.memory.compensation.is_busy() || self.memory.corners.is_busy() {
            self.core.state.ended = true;
            self.put_out_compensated(None, block, sink);
        }
    }
}
