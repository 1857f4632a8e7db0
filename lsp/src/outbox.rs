//! Messages to the client, in order: only one task sends.
use serde::{Deserialize, Serialize};
use tokio::sync::mpsc;
use tower_lsp::{
    Client,
    lsp_types::{Diagnostic, Url, notification::Notification},
};

/// State of a document for a status bar.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Status {
    /// Document.
    pub(crate) uri: Url,
    /// Machine, if one is named.
    pub(crate) machine: Option<String>,
    /// Dialect.
    pub(crate) dialect: Option<String>,
    /// Why this dialect; or what is wrong with the settings.
    pub(crate) reason: String,
    /// pass, fail or unknown.
    pub(crate) verdict: String,
    /// Count.
    pub(crate) errors: u64,
    /// Count.
    pub(crate) warnings: u64,
    /// Count.
    pub(crate) unknown: u64,
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
}

/// Sends messages one after the other until the senders are gone.
pub(crate) async fn run(client: Client, mut inbox: mpsc::UnboundedReceiver<Message>) {
    while let Some(message) = inbox.recv().await {
        match message {
            Message::Diagnostics(uri, diagnostics, version) => {
                client.publish_diagnostics(uri, diagnostics, version).await;
            }
            Message::Status(status) => client.send_notification::<StatusNotification>(*status).await,
        }
    }
}
