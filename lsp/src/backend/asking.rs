//! How a handler asks the owner and waits for the answer.
use super::Backend;
use crate::{
    event::Event,
    snapshot::{Need, Snapshot},
};
use core::ops::Range;
use tokio::sync::oneshot;
use tower_lsp::{
    jsonrpc::{Error, Result},
    lsp_types::Url,
};

impl Backend {
    /// Answers from a snapshot on a worker. A cancelled request drops this future, and its work is not begun.
    pub(super) async fn ask<T: Send + 'static>(
        &self,
        uri: &Url,
        need: Need,
        work: impl FnOnce(&Snapshot) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        self.ask_near(uri, need, None, work).await
    }

    /// The same for a request about these lines alone.
    pub(super) async fn ask_near<T: Send + 'static>(
        &self,
        uri: &Url,
        need: Need,
        near: Option<Range<usize>>,
        work: impl FnOnce(&Snapshot) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        let (sender, answer) = oneshot::channel();
        let work = move |snapshot: Option<Snapshot>| {
            if !sender.is_closed() {
                let _ =
                    sender.send(snapshot.map_or_else(|| Err(Error::content_modified()), |snapshot| work(&snapshot)));
            }
        };
        self.post(Event::Ask {
            uri: uri.clone(),
            need,
            near,
            work: Box::new(work),
        });
        answer.await.unwrap_or_else(|_| Err(Error::content_modified()))
    }

    /// The same for an answer that is always there.
    pub(super) async fn show<T: Send + 'static>(
        &self,
        uri: &Url,
        need: Need,
        work: impl FnOnce(&Snapshot) -> T + Send + 'static,
    ) -> Result<T> {
        self.ask(uri, need, move |snapshot| Ok(work(snapshot))).await
    }

    /// For the file of a call hierarchy, which need not be open: then one that is open beside it has the same folder.
    pub(super) async fn near<T: Send + 'static>(
        &self,
        uri: &Url,
        work: impl FnOnce(&Snapshot) -> T + Send + 'static,
    ) -> Result<Option<T>> {
        let (sender, answer) = oneshot::channel();
        let uri = uri.clone();
        self.post(Event::AskAll(Box::new(move |folder, encoding| {
            if !sender.is_closed() {
                let _ = sender.send(Snapshot::of_file(&uri, folder, encoding).map(|snapshot| work(&snapshot)));
            }
        })));
        answer.await.map_err(|_| Error::internal_error())
    }
}
