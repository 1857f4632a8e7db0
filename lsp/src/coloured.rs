//! The colours that a client has, so that it is sent only what is different.
use std::{
    collections::BTreeMap,
    sync::{
        Arc, Mutex,
        atomic::{AtomicU64, Ordering},
    },
};
use tower_lsp::lsp_types::{
    SemanticToken, SemanticTokens, SemanticTokensDelta, SemanticTokensEdit, SemanticTokensFullDeltaResult, Url,
};

/// The name of an answer, and its colours.
type Answer = (String, Arc<Vec<SemanticToken>>);

/// The last answer for each document.
#[derive(Clone, Default)]
pub(crate) struct Coloured {
    last: Arc<Mutex<BTreeMap<Url, Answer>>>,
    next: Arc<AtomicU64>,
}

impl Coloured {
    /// All colours, with a name for them.
    pub(crate) fn whole(&self, uri: &Url, data: Vec<SemanticToken>) -> SemanticTokens {
        let id = self.next.fetch_add(1, Ordering::SeqCst).to_string();
        let answer = SemanticTokens {
            result_id: Some(id.clone()),
            data: data.clone(),
        };
        if let Ok(mut last) = self.last.lock() {
            last.insert(uri.clone(), (id, Arc::new(data)));
        }
        answer
    }

    /// What is different from the answer with that name; all colours where that is not the last one.
    pub(crate) fn since(&self, uri: &Url, before: &str, data: Vec<SemanticToken>) -> SemanticTokensFullDeltaResult {
        let known = self.last.lock().ok().and_then(|last| last.get(uri).cloned());
        let Some((_, old)) = known.filter(|(id, _)| id == before) else {
            return SemanticTokensFullDeltaResult::Tokens(self.whole(uri, data));
        };
        let head = old.iter().zip(&data).take_while(|(a, b)| a == b).count();
        let most = old.len().min(data.len()) - head;
        let tail = old
            .iter()
            .rev()
            .zip(data.iter().rev())
            .take(most)
            .take_while(|(a, b)| a == b)
            .count();
        let edit = SemanticTokensEdit {
            // a token is five numbers
            start: head as u32 * 5,
            delete_count: (old.len() - tail - head) as u32 * 5,
            data: Some(data[head..data.len() - tail].to_vec()),
        };
        let same = edit.delete_count == 0 && edit.data.as_ref().is_some_and(Vec::is_empty);
        SemanticTokensFullDeltaResult::TokensDelta(SemanticTokensDelta {
            result_id: self.whole(uri, data).result_id,
            edits: if same { Vec::new() } else { vec![edit] },
        })
    }

    /// A document is closed.
    pub(crate) fn forget(&self, uri: &Url) {
        if let Ok(mut last) = self.last.lock() {
            last.remove(uri);
        }
    }
}
