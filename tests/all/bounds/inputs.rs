//! Hostile programs, made by code: each takes a size, so that CI runs them small and the long form large.
mod bytes;
mod cycles;
mod flow;
mod klartext;
mod many;
mod mistaken;
mod nesting;
mod okuma;
mod repeated;
mod tools;

/// A hostile program.
pub(super) struct Input {
    /// Its name, as the table of the long form prints it.
    pub(super) name: &'static str,
    /// The dialect that it is written in: the sample meets no other. `None`: it meets all of them in turn.
    pub(super) dialect: Option<&'static str>,
    /// Makes it: `size` elements of whatever it has many of, cut off at [`Input::MOST_BYTES`].
    make: fn(usize) -> Vec<u8>,
}

impl Input {
    /// No file is larger, and none has more lines: `--max-file-mb` and `--max-lines` refuse more by default.
    pub(super) const MOST_BYTES: usize = 64_000_000;
    const MOST_LINES: usize = 1_050_000;
    /// Both.
    pub(super) const MOST: (usize, usize) = (Self::MOST_BYTES, Self::MOST_LINES);

    const fn new(name: &'static str, make: fn(usize) -> Vec<u8>) -> Self {
        Self {
            name,
            dialect: None,
            make,
        }
    }

    /// One for a dialect.
    const fn of(dialect: &'static str, name: &'static str, make: fn(usize) -> Vec<u8>) -> Self {
        Self {
            name,
            dialect: Some(dialect),
            make,
        }
    }

    /// The program.
    pub(super) fn bytes(&self, size: usize) -> Vec<u8> {
        let mut bytes = (self.make)(size);
        let length = cut_off(&bytes, Self::MOST_BYTES, Self::MOST_LINES).len();
        bytes.truncate(length);
        bytes
    }
}

/// The beginning of a program: no more bytes and lines than that.
pub(super) fn cut_off(program: &[u8], bytes: usize, lines: usize) -> &[u8] {
    let program = &program[..program.len().min(bytes)];
    let mut ends = program
        .iter()
        .enumerate()
        .filter(|(_, byte)| matches!(byte, b'\n' | b'\r'));
    match ends.nth(lines - 2) {
        Some((end, _)) => &program[..end],
        None => program,
    }
}

/// All of them.
pub(super) fn all() -> Vec<Input> {
    let mut all = nesting::inputs();
    all.extend(bytes::inputs());
    all.extend(many::inputs());
    all.extend(flow::inputs());
    all.extend(cycles::inputs());
    all.extend(klartext::inputs());
    all.extend(okuma::inputs());
    // new ones at the end: the dialect that a program meets depends on its place, and a journal goes on where it was
    all.extend(tools::inputs());
    all.extend(repeated::inputs());
    all.extend(mistaken::inputs());
    all
}

/// What a program starts with so that positions, feed and tool are known.
const HEAD: &str = "G21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG43 H1\nF100.\nG1 X0. Y0. Z50.\n";

/// A program with a known position, then `body`.
fn cut(body: &str) -> Vec<u8> {
    format!("{HEAD}{body}\nM30\n").into_bytes()
}

/// `size` lines, each made from its number, no more than the largest file holds.
pub(super) fn lines(size: usize, line: impl Fn(usize) -> String) -> String {
    let mut out = String::new();
    for i in 0..size {
        out.push_str(&line(i));
        out.push('\n');
        if out.len() > Input::MOST_BYTES {
            break;
        }
    }
    out
}

/// As often as asked, or as the largest file holds.
fn repeat(text: &str, size: usize) -> String {
    text.repeat(size.min(Input::MOST_BYTES / text.len()))
}
