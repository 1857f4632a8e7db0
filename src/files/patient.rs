//! A writer whose errors wait for the end.
use std::io::{self, BufWriter, Write};

/// Writes through a buffer. After the first error it writes nothing more and keeps the error, so that a command goes on to its verdict and
/// reports the error once.
#[derive(Debug)]
pub struct Patient<W: Write> {
    inner: BufWriter<W>,
    failed: Option<io::Error>,
}

impl<W: Write> Patient<W> {
    /// Nothing written.
    pub fn new(inner: W) -> Self {
        Self {
            inner: BufWriter::new(inner),
            failed: None,
        }
    }

    /// Writes what the buffer still holds.
    ///
    /// # Errors
    /// The first error of all writes.
    pub fn finish(&mut self) -> io::Result<()> {
        let _ = self.flush();
        self.failed.take().map_or(Ok(()), Err)
    }

    #[inline]
    fn keep(&mut self, write: impl FnOnce(&mut BufWriter<W>) -> io::Result<()>) {
        if self.failed.is_none()
            && let Err(error) = write(&mut self.inner)
        {
            self.failed = Some(error);
        }
    }
}

impl<W: Write> Write for Patient<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.keep(|inner| inner.write_all(bytes));
        Ok(bytes.len())
    }
    // a document is written in pieces of a few bytes
    #[inline]
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.keep(|inner| inner.write_all(bytes));
        Ok(())
    }
    fn flush(&mut self) -> io::Result<()> {
        self.keep(BufWriter::flush);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Full;

    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::Error::from(io::ErrorKind::StorageFull))
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn an_error_is_kept_for_the_end() {
        let mut out = Patient::new(Full);
        assert!(writeln!(out, "verdict").is_ok());
        assert!(out.flush().is_ok());
        assert!(writeln!(out, "more").is_ok());
        let error = out.finish().expect_err("full");
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    }
}
