//! Messages to the client, in order: only one task sends.
use crate::analysis::Version;
use serde::{Deserialize, Serialize};
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};
use tokio::sync::{Notify, oneshot};
use tower_lsp::{
    Client,
    lsp_types::{
        Diagnostic, ProgressParams, ProgressParamsValue, ProgressToken, Url, WorkDoneProgress, WorkDoneProgressBegin,
        WorkDoneProgressCreateParams, WorkDoneProgressEnd,
        notification::{Notification, Progress as ProgressNotification},
        request::WorkDoneProgressCreate,
    },
};

/// State of a document for a status bar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Status {
    /// Document.
    pub(crate) uri: Url,
    /// Machine, if one is named.
    pub(crate) machine: Option<String>,
    /// Dialect.
    pub(crate) dialect: Option<String>,
    /// Why this dialect; or what is wrong with the settings.
    pub(crate) reason: String,
    /// pass, fail or unknown; checking: only a part of a long program is judged so far, and the counts are zero.
    pub(crate) verdict: String,
    /// Count.
    pub(crate) errors: u64,
    /// Count.
    pub(crate) warnings: u64,
    /// Count.
    pub(crate) unknown: u64,
    /// The version of the text that was judged.
    pub(crate) version: i32,
    /// Blocks with content, and those of them that were run.
    pub(crate) blocks: u64,
    /// See `blocks`.
    pub(crate) blocks_run: u64,
    /// Lowest and highest time of the program, s, where it is known.
    pub(crate) cycle_time_s: Option<[f64; 2]>,
}

/// `trunnion/status`: sent after each analysis.
pub(crate) enum StatusNotification {}

impl Notification for StatusNotification {
    type Params = Status;
    const METHOD: &'static str = "trunnion/status";
}

/// One message to the client.
pub(crate) enum Message {
    /// Findings of a version of a document.
    Diagnostics(Url, Vec<Diagnostic>, Option<Version>),
    /// State of a version of a document.
    Status(Box<Status>, Version),
    /// Work that takes time, with its title; it ends when the channel does.
    Progress(i32, String, oneshot::Receiver<()>),
    /// Hints and lenses are to be asked for again.
    Refresh,
}

impl Message {
    /// The document and the version that it speaks of; no version: the document is closed.
    fn subject(&self) -> Option<(&Url, Option<Version>)> {
        match self {
            Self::Diagnostics(uri, _, version) => Some((uri, *version)),
            Self::Status(status, version) => Some((&status.uri, Some(*version))),
            Self::Progress(..) | Self::Refresh => None,
        }
    }
}

/// Messages that wait to be sent. What they say of a version of a document is dropped when there is something to say of a newer one, so that for a
/// client that reads slowly no more waits than there are documents.
#[derive(Clone, Default)]
pub(crate) struct Outbox(Arc<Waiting>);

#[derive(Default)]
struct Waiting {
    messages: Mutex<VecDeque<Message>>,
    come: Notify,
}

impl Outbox {
    /// Adds a message.
    pub(crate) fn send(&self, message: Message) {
        let mut messages = self.0.messages.lock().unwrap_or_else(PoisonError::into_inner);
        let new = message.subject();
        messages.retain(|old| match (old.subject(), new) {
            (Some((of, before)), Some((uri, version))) => of != uri || before == version,
            _ => !matches!((old, &message), (Message::Refresh, Message::Refresh)),
        });
        messages.push_back(message);
        drop(messages);
        self.0.come.notify_one();
    }

    fn first(&self) -> Option<Message> {
        let mut messages = self.0.messages.lock().unwrap_or_else(PoisonError::into_inner);
        messages.pop_front()
    }
}

/// Reports that the check of a document runs, until `done` is there. The client must know the token first, and nothing waits for that.
async fn progress(client: Client, number: i32, title: String, done: oneshot::Receiver<()>) {
    let token = ProgressToken::Number(number);
    let params = WorkDoneProgressCreateParams { token: token.clone() };
    if client.send_request::<WorkDoneProgressCreate>(params).await.is_err() {
        return;
    }
    let report = |value| ProgressParams {
        token: token.clone(),
        value: ProgressParamsValue::WorkDone(value),
    };
    let begin = WorkDoneProgress::Begin(WorkDoneProgressBegin {
        title,
        ..WorkDoneProgressBegin::default()
    });
    client.send_notification::<ProgressNotification>(report(begin)).await;
    // dropped without a word: the check was given up
    let _ = done.await;
    let end = WorkDoneProgress::End(WorkDoneProgressEnd { message: None });
    client.send_notification::<ProgressNotification>(report(end)).await;
}

/// Sends messages one after the other as long as the server runs.
pub(crate) async fn run(client: Client, outbox: Outbox) {
    loop {
        let Some(message) = outbox.first() else {
            outbox.0.come.notified().await;
            continue;
        };
        match message {
            Message::Diagnostics(uri, diagnostics, version) => {
                client
                    .publish_diagnostics(uri, diagnostics, version.map(|version| version.client))
                    .await;
            }
            Message::Status(status, _) => client.send_notification::<StatusNotification>(*status).await,
            Message::Progress(number, title, done) => {
                tokio::spawn(progress(client.clone(), number, title, done));
            }
            Message::Refresh => {
                // the answers come when the client likes: nothing waits for them
                let client = client.clone();
                tokio::spawn(async move {
                    let _ = client.inlay_hint_refresh().await;
                    let _ = client.code_lens_refresh().await;
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_waits_speaks_of_the_newest_version_alone() {
        let outbox = Outbox::default();
        let uris = ["file:///a.nc", "file:///b.nc"].map(|uri| Url::parse(uri).expect("an address"));
        for own in 0..1000 {
            // this client gives each version the same number
            let version = Version { client: 2, own };
            for uri in &uris {
                for _ in 0..2 {
                    outbox.send(Message::Diagnostics(uri.clone(), Vec::new(), Some(version)));
                }
                outbox.send(Message::Refresh);
            }
        }
        outbox.send(Message::Diagnostics(uris[1].clone(), Vec::new(), None));
        let mut left = Vec::new();
        while let Some(message) = outbox.first() {
            let subject = message
                .subject()
                .map(|(uri, version)| (uri.clone(), version.map(|version| version.own)));
            left.push(subject);
        }
        let first = Some((uris[0].clone(), Some(999)));
        assert_eq!(left, [first.clone(), first, None, Some((uris[1].clone(), None))]);
    }
}
