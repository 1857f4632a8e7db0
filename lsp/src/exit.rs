//! Ends the process on `exit`: tower-lsp 0.20 would stay alive as long as the client keeps standard input open.
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    task::{Context, Poll},
};
use tower_lsp::jsonrpc::Request;
use tower_service::Service;

/// Wraps the service and watches for `exit`.
pub(crate) struct ExitOnExit<S> {
    inner: S,
    shutdown: Arc<AtomicBool>,
}

impl<S> ExitOnExit<S> {
    /// `shutdown` shows whether a `shutdown` request was seen before.
    pub(crate) fn new(inner: S, shutdown: Arc<AtomicBool>) -> Self {
        Self { inner, shutdown }
    }
}

impl<S: Service<Request>> Service<Request> for ExitOnExit<S> {
    type Response = S::Response;
    type Error = S::Error;
    type Future = S::Future;

    fn poll_ready(&mut self, context: &mut Context<'_>) -> Poll<Result<(), Self::Error>> {
        self.inner.poll_ready(context)
    }

    fn call(&mut self, request: Request) -> Self::Future {
        if request.method() == "exit" {
            std::process::exit(i32::from(!self.shutdown.load(Ordering::SeqCst)));
        }
        self.inner.call(request)
    }
}
