//! INI files as LinuxCNC reads them: sections, `KEY = VALUE`, comments on separate lines, keys that repeat.
use crate::MachineError;
use core::ops::Range;

/// One `KEY = VALUE`.
#[derive(Clone, Debug)]
pub(super) struct Entry<'a> {
    pub(super) section: &'a str,
    pub(super) key: &'a str,
    pub(super) value: &'a str,
    /// Bytes of the value.
    pub(super) span: Range<usize>,
}

/// A file.
#[derive(Clone, Debug, Default)]
pub(super) struct Ini<'a> {
    pub(super) entries: Vec<Entry<'a>>,
    /// Files named by `#INCLUDE`, which are not read.
    pub(super) includes: Vec<&'a str>,
}

impl<'a> Ini<'a> {
    /// # Errors
    /// A section without its closing bracket, or a line that is neither section, entry nor comment.
    pub(super) fn read(text: &'a str) -> Result<Self, MachineError> {
        let mut ini = Self::default();
        let mut section = "";
        let mut start = 0;
        let mut continued = false;
        if let Some(at) = lone_return(text) {
            return Err(MachineError {
                message: "a line ends in CR alone, which the control does not take for the end of a line: save the file with line ends LF or CR LF"
                    .to_owned(),
                span: Some(at..at + 1),
            });
        }
        for raw in text.split_inclusive('\n') {
            let at = start + (raw.len() - raw.trim_start().len());
            let line = raw.trim();
            start += raw.len();
            let goes_on = line.ends_with('\\');
            if core::mem::replace(&mut continued, goes_on) {
                // the rest of a value; no key that is read here is written on several lines
                continue;
            }
            let error = |message: &str| MachineError {
                message: format!("{message}: \"{}\"", super::short(line).escape_debug()),
                span: Some(at..at + line.len()),
            };
            if let Some(name) = line.strip_prefix("#INCLUDE") {
                ini.includes.push(name.trim());
            } else if line.is_empty() || line.starts_with(['#', ';']) {
            } else if let Some(name) = line.strip_prefix('[') {
                let Some((name, _)) = name.split_once(']') else {
                    return Err(error("this section has no closing bracket"));
                };
                section = name.trim();
            } else if let Some((key, value)) = line.split_once('=') {
                let value_at = at + line.len() - value.trim_start().len();
                let value = value.trim();
                ini.entries.push(Entry {
                    section,
                    key: key.trim(),
                    value,
                    span: value_at..value_at + value.len(),
                });
            } else {
                return Err(error("expected [SECTION], KEY = VALUE or a comment"));
            }
        }
        Ok(ini)
    }

    /// The first entry of a key in a section.
    pub(super) fn get(&self, section: &str, key: &str) -> Option<&Entry<'a>> {
        self.entries
            .iter()
            .find(|entry| entry.section == section && entry.key == key)
    }

    /// Its number: the first word of the value.
    pub(super) fn number(&self, section: &str, key: &str) -> Result<Option<f64>, MachineError> {
        self.get(section, key).map(Entry::number).transpose()
    }
}

/// The first CR that no LF follows, except at the end of the file.
fn lone_return(text: &str) -> Option<usize> {
    let returns = text.match_indices('\r').map(|(at, _)| at);
    let mut lone = returns.filter(|at| !matches!(text.as_bytes().get(at + 1), None | Some(b'\n')));
    lone.next()
}

impl Entry<'_> {
    /// The first word as a number.
    pub(super) fn number(&self) -> Result<f64, MachineError> {
        let word = self.value.split_whitespace().next().unwrap_or("");
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(MachineError {
                message: format!(
                    "{} = {:?} of [{}] is not a number",
                    super::short(self.key),
                    super::short(self.value),
                    super::short(self.section)
                ),
                span: Some(self.span.clone()),
            }),
        }
    }
}
