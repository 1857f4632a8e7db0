//! The document of all files, written file by file in the format that was asked for.
use super::{Tally, github, junit, one::Checked, sarif};
use crate::cli::args::CheckFormat;
use serde_json::json;
use std::io::{self, Write};

/// A document that is being written.
pub(super) struct Document<'o> {
    format: CheckFormat,
    out: &'o mut dyn Write,
    first: bool,
    /// SARIF: the files, which stand after the results.
    about: Vec<String>,
}

impl<'o> Document<'o> {
    /// Nothing written.
    pub(super) fn new(format: CheckFormat, out: &'o mut dyn Write) -> Self {
        Self {
            format,
            out,
            first: true,
            about: Vec::new(),
        }
    }

    /// What stands before the first file.
    pub(super) fn begin(&mut self) -> io::Result<()> {
        match self.format {
            CheckFormat::Json => write!(
                self.out,
                "{{\n  \"schema\": \"{}\",\n  \"version\": \"{}\",\n  \"files\": [",
                trunnion_document::SCHEMA,
                env!("CARGO_PKG_VERSION")
            ),
            CheckFormat::Sarif => self.out.write_all(sarif::head().as_bytes()),
            CheckFormat::Junit => {
                writeln!(
                    self.out,
                    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"trunnion\">"
                )
            }
            CheckFormat::Pretty | CheckFormat::Short | CheckFormat::Github => Ok(()),
        }
    }

    /// One file.
    pub(super) fn file(&mut self, file: &Checked) -> io::Result<()> {
        let comma = match self.format {
            CheckFormat::Json if self.first => "\n    ",
            CheckFormat::Json => ",\n    ",
            CheckFormat::Sarif if file.text.is_empty() => "",
            CheckFormat::Sarif if self.first => "\n",
            CheckFormat::Sarif => ",\n",
            _ => "",
        };
        if self.format == CheckFormat::Sarif {
            self.about.push(file.about.clone());
        }
        if !file.text.is_empty() {
            self.first = false;
        }
        self.out.write_all(comma.as_bytes())?;
        self.out.write_all(file.text.as_bytes())
    }

    /// What stands after the last file.
    pub(super) fn end(&mut self, tally: &Tally, statistics: bool) -> io::Result<()> {
        match self.format {
            CheckFormat::Json => {
                let mut rest = json!({
                    "machine": tally.machine, "not_checked": tally.not_checked,
                    "summary": {
                        "files": tally.files, "blocks": tally.summary.blocks, "motions": tally.summary.motions,
                        "errors": tally.summary.errors, "warnings": tally.summary.warnings, "infos": tally.summary.infos,
                        "unknown": tally.summary.unknown, "accepted": tally.summary.accepted,
                    },
                });
                if statistics {
                    rest["statistics"] = tally.statistics.json();
                }
                let rest = serde_json::to_string_pretty(&rest)?;
                // its opening brace is that of the document
                writeln!(self.out, "\n  ],{}", &rest[1..])
            }
            CheckFormat::Sarif => {
                self.out.write_all(b"\n],\n\"artifacts\": [")?;
                for (at, about) in self.about.iter().enumerate() {
                    write!(self.out, "{}{about}", if at == 0 { "\n" } else { ",\n" })?;
                }
                self.out.write_all(sarif::tail(tally, statistics).as_bytes())
            }
            CheckFormat::Junit => {
                self.out.write_all(junit::not_checked(&tally.not_checked).as_bytes())?;
                if statistics {
                    self.out.write_all(junit::statistics(&tally.statistics).as_bytes())?;
                }
                writeln!(self.out, "</testsuites>")
            }
            CheckFormat::Github | CheckFormat::Pretty | CheckFormat::Short => {
                if self.format == CheckFormat::Github {
                    for failed in &tally.not_checked {
                        self.out.write_all(github::not_checked(failed).as_bytes())?;
                    }
                }
                if statistics {
                    self.out.write_all(tally.statistics.table().as_bytes())?;
                }
                Ok(())
            }
        }
    }

    /// A line of text.
    pub(super) fn line(&mut self, line: &str) -> io::Result<()> {
        writeln!(self.out, "{line}")
    }

    /// Hands on what was written, so that it stands before a remark on standard error.
    pub(super) fn flush(&mut self) {
        // standard output keeps its errors for the end
        let _ = self.out.flush();
    }
}
