//! Messages to the client, in order: only one task sends.
use serde::{Deserialize, Serialize};
use tokio::sync::{mpsc, oneshot};
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
    Diagnostics(Url, Vec<Diagnostic>, Option<i32>),
    /// State of a document.
    Status(Box<Status>),
    /// Work that takes time, with its title; it ends when the channel does.
    Progress(i32, String, oneshot::Receiver<()>),
    /// Hints and lenses are to be asked for again.
    Refresh,
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

/// Sends messages one after the other until the senders are gone.
pub(crate) async fn run(client: Client, mut inbox: mpsc::UnboundedReceiver<Message>) {
    while let Some(message) = inbox.recv().await {
        match message {
            Message::Diagnostics(uri, diagnostics, version) => {
                client.publish_diagnostics(uri, diagnostics, version).await;
            }
            Message::Status(status) => client.send_notification::<StatusNotification>(*status).await,
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
