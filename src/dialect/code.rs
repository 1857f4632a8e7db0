//! One code of a dialect and its documentation.
use crate::{Action, Owner, PathMode};
use core::fmt::Write;

/// Whether a code is a G code, an M code or a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CodeKind {
    /// G with a number.
    G,
    /// M with a number.
    M,
    /// A name such as TRAORI or CYCLE800.
    Name,
}

/// One code of a dialect.
#[derive(Clone, Debug)]
pub struct Code {
    /// As people write it: `G43.4`, `M6`, `TRAORI`.
    pub id: String,
    /// G, M or name.
    pub kind: CodeKind,
    /// Modal group's name; two codes of one group in a block contradict each other. `None`: belongs to no group.
    pub group: Option<String>,
    /// Addresses the code reads in addition to the axes.
    pub words: Vec<String>,
    /// Those of them that are lengths in the unit of the program, where the table says that of its words.
    pub lengths: Option<Vec<String>>,
    /// What it does.
    pub action: Action,
    /// What it demands at the end of a block; `None`: it is no mode of path control, or the sources leave it open.
    pub path: Option<PathMode>,
    /// What F means from here on, as one of the codes whose action that is, where the code decides this beside its action (G96 of a Sinumerik).
    pub feed: Option<Action>,
    /// One line for people.
    pub doc: String,
    /// Where that is written down.
    pub source: String,
    /// Who gives it that meaning.
    pub owner: Owner,
}

impl Code {
    /// Markdown for an editor: what the code does, its modal group, the words it reads, what is not modelled, and its source.
    pub fn hover(&self) -> String {
        let mut text = format!("**{}** {}\n", self.id, self.doc);
        if let Some(group) = &self.group {
            let _ = write!(text, "\nModal group: {group}\n");
        }
        if !self.words.is_empty() {
            let _ = write!(text, "\nReads: {}\n", self.words.join(" "));
        }
        if self.owner == Owner::MachineBuilder {
            text.push_str("\nDefined by the machine builder: your machine may differ.\n");
        }
        match self.action {
            Action::NotModelled | Action::CannedCycle | Action::SubprogramCall => {
                text.push_str(
                    "\nIts effect is not modelled: what it changes is unknown until it is programmed again.\n",
                );
            }
            Action::FrameChange => text.push_str(
                "\nThe change of coordinates is not modelled: machine positions are unknown until it ends.\n",
            ),
            Action::CompensationLeft | Action::CompensationRight => {
                text.push_str(
                    "\nThe compensated path is modelled on Fanuc and Haas mills if the radius of D is declared.\n",
                );
            }
            _ => {}
        }
        let _ = write!(text, "\n*{}*", self.source);
        text
    }
}

/// Order of codes: G, M, names; numbers by value, names by text.
pub(crate) fn sort_key(code: &Code) -> (u8, u32, &str) {
    let number = crate::pattern::number_tenths(&code.id).unwrap_or(0);
    match code.kind {
        CodeKind::G => (0, number, ""),
        CodeKind::M => (1, number, ""),
        CodeKind::Name => (2, 0, &code.id),
    }
}
