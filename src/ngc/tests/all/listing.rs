//! Runs a program and lists its calls as `rs274 -g` does.
use std::sync::Arc;
use trunnion_ngc::{At, Canon, Engine, Error, Listing, Setup, Sink, Source, State};

/// What a run tells, as text.
#[derive(Default)]
pub struct Listed {
    listing: Listing,
    text: Vec<u8>,
    /// Messages of the refused lines.
    pub errors: Vec<String>,
    /// Text of the bytes that each error points at.
    pub ranges: Vec<(u32, u32)>,
}

impl Sink for Listed {
    fn call(&mut self, call: &Canon, _: At, _: &State) {
        self.listing.write(call, b".....", &mut self.text).unwrap();
    }
    fn error(&mut self, error: &Error, _: At) {
        self.errors.push(error.message().to_owned());
        self.ranges.push((error.range.start, error.range.end));
    }
}

impl Listed {
    /// The calls, one a line, without counter and sequence number.
    pub fn lines(&self) -> Vec<String> {
        let text = String::from_utf8_lossy(&self.text);
        let call = |line: &str| {
            let line = line.trim_start();
            let numbered = line.split_once(' ').filter(|(count, _)| count.parse::<u32>().is_ok());
            let line = numbered.map_or(line, |(_, rest)| rest.trim_start());
            line.strip_prefix("N..... ").unwrap_or(line).trim().to_owned()
        };
        text.lines().map(call).filter(|line| !line.is_empty()).collect()
    }
}

/// Runs a program to its first error.
pub fn list(program: &str) -> Listed {
    let source = Source::new(String::new(), Arc::from(program.as_bytes()));
    let mut engine = Engine::new(Arc::new(source), &Setup::default());
    let mut listed = Listed::default();
    engine.run(true, &mut listed);
    listed
}

/// Two listed calls are the same but for a last decimal that was rounded the other way.
pub fn same(ours: &str, theirs: &str) -> bool {
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
