//! Standard output of commands that end with a verdict.
use super::failure::{remark, shown};
use std::io::{self, Write};
use trunnion_files::{Patient, unless_closed};

/// Standard output. Where it cannot be written to, the command still ends with the status of its verdict: when the reader has gone away
/// (`| head`) the rest is dropped silently, and any other error is reported once, at the end.
pub(super) struct Out<W: Write = io::Stdout>(Patient<W>);

impl Out {
    /// The process's standard output.
    pub(super) fn standard() -> Self {
        Self(Patient::new(io::stdout()))
    }
}

impl<W: Write> Out<W> {
    /// Text for people: control characters are shown as escapes.
    pub(super) fn text(&mut self, text: &str) {
        // it keeps its errors for the end
        let _ = self.0.write_all(shown(text).as_bytes());
    }
}

impl<W: Write> Write for Out<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }
    #[inline]
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.write_all(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl<W: Write> Drop for Out<W> {
    fn drop(&mut self) {
        if let Err(error) = unless_closed(self.0.finish()) {
            remark(false, &format!("error: cannot write to standard output: {error}"));
        }
    }
}

/// Puts blanks before each line but the first.
pub(super) struct Indented<'w, W> {
    inner: &'w mut W,
    indent: &'static str,
}

impl<'w, W: Write> Indented<'w, W> {
    pub(super) fn new(inner: &'w mut W, indent: &'static str) -> Self {
        Self { inner, indent }
    }
}

impl<W: Write> Write for Indented<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        for line in bytes.split_inclusive(|&byte| byte == b'\n') {
            self.inner.write_all(line)?;
            if line.ends_with(b"\n") {
                self.inner.write_all(self.indent.as_bytes())?;
            }
        }
        Ok(bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_indented_but_the_first() {
        let mut written = Vec::new();
        let mut out = Indented::new(&mut written, "  ");
        out.write_all(b"{\n\"a\"").expect("written");
        out.write_all(b": 1\n}").expect("written");
        assert_eq!(written, b"{\n  \"a\": 1\n  }");
    }

    #[test]
    fn control_characters_are_shown() {
        let mut written = Vec::new();
        {
            let mut out = Out(Patient::new(&mut written));
            out.text("a\x1b[31m\u{202e}b\tc\n");
        }
        assert_eq!(written, b"a\\x1b[31m\\u{202e}b\tc\n");
    }
}
