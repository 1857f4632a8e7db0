//! Certificates of several changes made one after the other: from the first program and the edits of each step, all can be checked again.
use crate::digest::setup_digest;
use crate::{Certificate, Outcome, recheck};
use serde::{Deserialize, Serialize};
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_machine::Machine;
use trunnion_syntax::{TextEdit, TextRange, apply_edits};

/// Schema of a chain.
pub const CHAIN_SCHEMA: &str = "trunnion-certificates/1";

/// A chain of certificates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    schema: String,
    /// In the order in which they are made.
    pub steps: Vec<ChainStep>,
}

/// One change and its proof.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChainStep {
    /// Who proposed it: nothing rests on it.
    pub rewrite: String,
    /// What it changes in the text that the steps before it leave, sorted.
    edits: Vec<Replaced>,
    /// The proof.
    pub certificate: Certificate,
}

/// Bytes `start..end` of a text, and what takes their place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Replaced {
    start: u32,
    end: u32,
    text: String,
}

impl ChainStep {
    /// A step.
    pub fn new(rewrite: impl Into<String>, edits: &[TextEdit], certificate: Certificate) -> Self {
        let replaced = |edit: &TextEdit| Replaced {
            start: edit.range.start,
            end: edit.range.end,
            text: edit.new_text.clone(),
        };
        Self {
            rewrite: rewrite.into(),
            edits: edits.iter().map(replaced).collect(),
            certificate,
        }
    }

    fn apply(&self, text: &[u8]) -> Option<Vec<u8>> {
        let edit = |edit: &Replaced| {
            let new_text = edit.text.clone();
            (edit.start <= edit.end).then(|| TextEdit {
                range: TextRange::new(edit.start, edit.end),
                new_text,
            })
        };
        apply_edits(text, &self.edits.iter().map(edit).collect::<Option<Vec<_>>>()?)
    }
}

impl Chain {
    /// A chain of these steps.
    pub fn new(steps: Vec<ChainStep>) -> Self {
        Self {
            schema: CHAIN_SCHEMA.to_owned(),
            steps,
        }
    }

    /// As JSON, indented, with a line end.
    pub fn to_json(&self) -> String {
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }

    /// Reads a chain, or one certificate as a chain of one step without edits. `Err` says what is wrong and where.
    pub fn from_json(json: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct Header {
            schema: String,
        }
        let header: Result<Header, _> = serde_json::from_str(json);
        if header.is_ok_and(|header| header.schema == CHAIN_SCHEMA) {
            return serde_json::from_str(json).map_err(|error| format!("not a chain of certificates: {error}"));
        }
        let certificate = Certificate::from_json(json)?;
        Ok(Self::new(vec![ChainStep {
            rewrite: String::new(),
            edits: Vec::new(),
            certificate,
        }]))
    }

    /// Checks every step again. `Err`: number of the step (from 1), and what its check gave; `Ok`: the fresh certificates, the last one apart.
    /// `assumed`: the setup with the undeclared values at zero that the user assumes to be; steps that were proved with it are checked with it.
    pub fn recheck(
        &self,
        before: &[u8],
        after: &[u8],
        dialect: &Dialect,
        machine: &Machine,
        (setup, assumed): (&Setup, &Setup),
    ) -> Result<(Vec<Certificate>, Certificate), (usize, Outcome)> {
        let mut text = before.to_vec();
        let mut fresh = Vec::with_capacity(self.steps.len());
        for (index, step) in self.steps.iter().enumerate() {
            let alone = self.steps.len() == 1 && step.edits.is_empty();
            let next = if alone {
                after.to_vec()
            } else {
                let next = step.apply(&text);
                next.ok_or_else(|| (index + 1, Outcome::refuted("its edits do not fit the program")))?
            };
            let with_zeros = step.certificate.setup_sha256 == setup_digest(assumed);
            let setup = if with_zeros { assumed } else { setup };
            match recheck(&step.certificate, &text, &next, dialect, machine, setup) {
                Outcome::Proved(certificate) => fresh.push(*certificate),
                other => return Err((index + 1, other)),
            }
            text = next;
        }
        if let Some(last) = fresh.pop().filter(|_| text == after) {
            return Ok((fresh, last));
        }
        let message = "the steps of the certificate do not lead to the changed program; the program was edited since, or the command that \
             writes both was stopped between them: run that command again, it writes both";
        Err((self.steps.len(), Outcome::refuted(message)))
    }
}
