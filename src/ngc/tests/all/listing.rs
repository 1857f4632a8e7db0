//! Runs a program and lists its calls as `rs274 -g` does.
use std::sync::Arc;
use trunnion_ngc::{At, Canon, Engine, Error, Listing, Setup, Sink, Source, State};

/// What a run emits, as text.
#[derive(Default)]
pub(crate) struct Listed {
    listing: Listing,
    text: Vec<u8>,
    /// Messages of the refused lines.
    pub(crate) errors: Vec<String>,
}

impl Sink for Listed {
    fn call(&mut self, call: &Canon, _: At, _: &State) {
        self.listing
            .write(call, b".....", &mut self.text)
            .expect("memory takes all");
    }
    fn error(&mut self, error: &Error, _: At) {
        self.errors.push(error.message().to_owned());
    }
}

impl Listed {
    /// The calls, one a line, without counter, sequence number and the resets of the program `rs274`.
    pub(crate) fn lines(&self) -> Vec<String> {
        let text = String::from_utf8_lossy(&self.text);
        text.lines()
            .map(bare)
            .filter(|line| !line.is_empty() && line != "ON_RESET()")
            .collect()
    }
}

/// A listed line without counter, sequence number and the resets of the program `rs274`.
pub(crate) fn bare(line: &str) -> String {
    let line = line.trim_start();
    let numbered = line.split_once(' ').filter(|(count, _)| count.parse::<u32>().is_ok());
    let line = numbered.map_or(line, |(_, rest)| rest.trim_start());
    let number = line.strip_prefix('N').map_or(0, |rest| {
        rest.bytes()
            .take_while(|byte| byte.is_ascii_digit() || *byte == b'.')
            .count()
    });
    let line = if number > 0 { &line[number + 1..] } else { line };
    line.trim().to_owned()
}

/// Runs a program with a setup to its first error.
pub(crate) fn list_with(program: &str, setup: &Setup) -> Listed {
    let source = Source::new(String::new(), Arc::from(program.as_bytes()));
    let mut engine = Engine::new(Arc::new(source), setup);
    let mut listed = Listed::default();
    engine.run(true, &mut listed);
    listed
}

/// Two listed calls are the same but for a last decimal that was rounded in the other direction.
pub(crate) fn same(ours: &str, theirs: &str) -> bool {
    if ours == theirs {
        return true;
    }
    let parts = |line: &str| -> Vec<String> { line.split(&[' ', ',', '(', ')'][..]).map(str::to_owned).collect() };
    let (ours, theirs) = (parts(ours), parts(theirs));
    ours.len() == theirs.len()
        && ours.iter().zip(&theirs).all(|(a, b)| {
            a == b
                || match (a.parse::<f64>(), b.parse::<f64>()) {
                    (Ok(a), Ok(b)) => (a - b).abs() < 1.5e-4,
                    _ => false,
                }
        })
}
