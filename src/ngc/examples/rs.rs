//! Prints what a program does.
use std::io::Write;
use std::sync::Arc;
use trunnion_ngc::*;
struct Out {
    listing: Listing,
    text: Vec<u8>,
    source: Arc<Source>,
    quiet: bool,
    errors: Vec<String>,
    calls: u64,
}
impl Sink for Out {
    fn call(&mut self, call: &Canon, at: At, _state: &State) {
        self.calls += 1;
        if self.quiet {
            return;
        }
        let mut number = b".....".to_vec();
        if self.calls > 6
            && at.file == FileId::MAIN
            && let Some(range) = self.source.line(at.line)
        {
            let line: Vec<u8> = self.source.bytes()[range.start as usize..range.end as usize]
                .iter()
                .copied()
                .filter(|b| !b.is_ascii_whitespace())
                .collect();
            let line = line.strip_prefix(b"/").unwrap_or(&line);
            if matches!(line.first(), Some(b'N' | b'n')) {
                number = line[1..].iter().copied().take_while(u8::is_ascii_digit).collect();
            }
        }
        self.listing.write(call, &number, &mut self.text).unwrap();
    }
    fn error(&mut self, error: &Error, at: At) {
        let text = String::from_utf8_lossy(
            &self.source.bytes()[error.range.start.min(self.source.bytes().len() as u32) as usize
                ..(error.range.end as usize).min(self.source.bytes().len())],
        )
        .into_owned();
        self.errors.push(format!(
            "{}\t{}:{} `{}`",
            error.message(),
            at.line + 1,
            error.range.start,
            text.escape_debug()
        ));
    }
}
struct Folder(std::path::PathBuf);
impl Files for Folder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<String>> {
        let path = self.0.join(format!("{name}.ngc"));
        match std::fs::read(&path) {
            Ok(bytes) => Ok(Loaded {
                path: format!("{name}.ngc"),
                bytes: bytes.into(),
            }),
            Err(_) => Err(vec![]),
        }
    }
}
fn main() {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let mut flag = |name: &str| {
        let at = args.iter().position(|a| a == name);
        if let Some(at) = at {
            args.remove(at);
        }
        at.is_some()
    };
    let (all, quiet, unknown) = (flag("-a"), flag("-q"), flag("-u"));
    for file in &args {
        let path = std::path::Path::new(file);
        let bytes: Arc<[u8]> = std::fs::read(path).unwrap().into();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let source = Arc::new(Source::new(name, bytes));
        let mut setup = Setup::default();
        if unknown {
            setup.start = Start::Unknown;
        }
        if !quiet { setup.limits.blocks = 100_000; }
        setup.files = Some(Arc::new(Folder(path.parent().unwrap().to_path_buf())));
        let mut out = Out {
            listing: Listing::default(),
            text: vec![],
            source: source.clone(),
            quiet,
            errors: vec![],
            calls: 0,
        };
        let mut engine = Engine::new(source, &setup);
        let begin = std::time::Instant::now();
        let step = engine.run(!all, &mut out);
        let took = begin.elapsed();
        if all {
            engine.read_rest(&mut out);
        }
        let mut so = std::io::stdout().lock();
        so.write_all(&out.text).unwrap();
        for e in &out.errors {
            writeln!(so, "ERROR {e}").unwrap();
            if !all {
                break;
            }
        }
        writeln!(
            so,
            "STEP {step:?} {}",
            if let Step::OutOfFuel(at) = &step {
                format!("line {}", at.line + 1)
            } else {
                String::new()
            }
        )
        .unwrap();
        if quiet {
            writeln!(so, "{took:?} {} calls", out.calls).unwrap();
        }
        writeln!(so, "=====").unwrap();
    }
}
