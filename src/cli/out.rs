//! Standard output of commands that end with a verdict.
use super::failure::{remark, shown};
use std::io::{self, BufWriter, Write};

/// Standard output. Where it cannot be written to, the command still ends with the status of its verdict: when the reader has gone away
/// (`| head`) the rest is dropped silently, and any other error is reported once, at the end.
pub(super) struct Out<W: Write = io::Stdout> {
    inner: BufWriter<W>,
    failed: Option<io::Error>,
}

impl Out {
    /// The process's standard output.
    pub(super) fn standard() -> Self {
        Self::to(io::stdout())
    }
}

impl<W: Write> Out<W> {
    fn to(inner: W) -> Self {
        Self {
            inner: BufWriter::new(inner),
            failed: None,
        }
    }

    /// Text for people: control characters are shown as escapes.
    pub(super) fn text(&mut self, text: &str) {
        // `write_all` of this type keeps the error for the end
        let _ = self.write_all(shown(text).as_bytes());
    }
}

impl<W: Write> Write for Out<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.failed.is_none()
            && let Err(error) = self.inner.write_all(bytes)
        {
            self.failed = Some(error);
        }
        Ok(bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        if self.failed.is_none()
            && let Err(error) = self.inner.flush()
        {
            self.failed = Some(error);
        }
        Ok(())
    }
}

impl<W: Write> Drop for Out<W> {
    fn drop(&mut self) {
        let _ = self.flush();
        match &self.failed {
            Some(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                remark(false, &format!("error: cannot write to standard output: {error}"));
            }
            _ => {}
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

    struct Full;

    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::Error::from(io::ErrorKind::BrokenPipe))
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_closed_output_is_no_error_of_the_command() {
        let mut out = Out::to(Full);
        assert!(writeln!(out, "verdict").is_ok());
        assert!(out.flush().is_ok());
        assert!(out.failed.is_some());
        assert!(writeln!(out, "more").is_ok());
    }

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
            let mut out = Out::to(&mut written);
            out.text("a\x1b[31m\u{202e}b\tc\n");
        }
        assert_eq!(written, b"a\\x1b[31m\\u{202e}b\tc\n");
    }
}
