//! A file that only defines subprograms, judged alone: each is entered as if it were called with unknown arguments.
use super::Call;
use super::labels::{Place, Style};
use crate::{Engine, FileId, Sink};

/// `#1` to `#30`.
const ARGUMENTS: usize = 30;

impl Engine {
    /// Where the main program has done nothing but define subprograms (and end, with `words` lines of words), goes to the first line of the
    /// next one that did not run; where it ends, the next step continues at the end of the file.
    pub(super) fn enter_next_definition(&mut self, words: u64, sink: &mut dyn Sink) -> bool {
        let idle = self.flow.did <= words && !self.flow.called;
        if !self.setup.enter_definitions || (self.flow.entered == 0 && !idle) {
            return false;
        }
        while !self.flow.calls.is_empty() {
            self.abandon_call();
        }
        while let Some(name) = self.flow.defined.get(self.flow.entered).copied() {
            self.flow.entered += 1;
            let Some(known) = self.flow.labels.subprogram(name) else {
                continue;
            };
            let body = known.body;
            if body.file() != FileId::MAIN || self.flow.lines(FileId::MAIN).has_run(body.line()) {
                continue;
            }
            (self.flow.at.file, self.flow.at.line) = (known.place.file(), known.place.line());
            sink.entered(self.flow.labels.text(name), self.flow.at);
            self.store.enter(&[f64::NAN; ARGUMENTS]);
            self.store.alone = true;
            // position and F are those of the caller
            self.state.current = [f64::NAN; 9];
            self.state.compensated = [f64::NAN; 9];
            self.state.feed_rate = f64::NAN;
            self.flow.calls.push(Call {
                back: self.end_of_main(),
                site: self.flow.at,
                sub: self.flow.sub,
                style: self.flow.style,
                chain: self.flow.chain,
                body: Some(body),
                rounds: 1,
                context: None,
            });
            self.flow.sub = name;
            self.flow.style = Style::Sub;
            self.flow.called = true;
            self.flow.here = body;
            return true;
        }
        false
    }
    /// Whether the arguments of the outermost call are unknown.
    pub(super) fn entered_alone(&self) -> bool {
        self.flow.entered > 0
    }
    fn end_of_main(&self) -> Place {
        let bytes = self.files[FileId::MAIN.0 as usize].bytes();
        let lines = memchr::memchr_iter(b'\n', bytes).count() as u32;
        Place::new(FileId::MAIN, lines, bytes.len() as u32)
    }
}
