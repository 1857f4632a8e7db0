//! How large a program a command reads by default.
use super::{Command, Global, Parse};

/// Megabytes and lines of a program.
#[derive(Clone, Copy)]
pub(crate) struct TextBounds {
    /// `--max-file-mb`.
    pub(crate) megabytes: u64,
    /// `--max-lines`.
    pub(crate) lines: u64,
}

impl TextBounds {
    const DEFAULT: Self = Self {
        megabytes: 64,
        lines: 1_050_000,
    };
    /// A trace prints a line for each motion and for each of its faults, a tree up to a hundred times the text.
    const LISTS: Self = Self {
        megabytes: 64,
        lines: 600_000,
    };
    /// What compares programs or machines runs two texts, twice where they differ; a picture and statistics run one text up to four times.
    const RUNS_OFTEN: Self = Self {
        megabytes: 32,
        lines: 250_000,
    };
    /// Layout reads both texts and compares what they say.
    const LAYS_OUT: Self = Self {
        megabytes: 16,
        lines: 300_000,
    };
    /// What changes programs runs the old and the new text, each up to a dozen times, and compares each step.
    const CHANGES: Self = Self {
        megabytes: 16,
        lines: 200_000,
    };
    /// A page needs a check, three more runs, and pictures.
    const REPORTS: Self = Self {
        megabytes: 16,
        lines: 100_000,
    };
}

impl Global {
    /// Sets the bounds of the command where none are given.
    pub(crate) fn bound_text(&mut self, command: &Command) {
        let most = match command {
            Command::Fmt(_) => TextBounds::LAYS_OUT,
            Command::Fix(_) | Command::Edit(_) => TextBounds::CHANGES,
            Command::Report(_) => TextBounds::REPORTS,
            Command::Trace(_) | Command::Parse(Parse { tokens: false, .. }) => TextBounds::LISTS,
            Command::Certify(_) | Command::Diff(_) | Command::Machine(_) | Command::Plot(_) | Command::Stats(_) => {
                TextBounds::RUNS_OFTEN
            }
            _ => TextBounds::DEFAULT,
        };
        self.max_file_mb.get_or_insert(most.megabytes);
        self.max_lines.get_or_insert(most.lines);
    }

    /// How large a program is read.
    pub(crate) fn text_bounds(&self) -> TextBounds {
        TextBounds {
            megabytes: self.max_file_mb.unwrap_or(TextBounds::DEFAULT.megabytes),
            lines: self.max_lines.unwrap_or(TextBounds::DEFAULT.lines),
        }
    }
}
