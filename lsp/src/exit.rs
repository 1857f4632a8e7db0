//! What tower-lsp 0.20 does not do: it ends the process on `exit`, which would otherwise live as long as the client keeps standard input
//! open, and it answers malformed messages.
use crate::frames::MALFORMED;
use std::{
    borrow::Cow,
    future::{Future, Ready, ready},
    pin::Pin,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    task::{Context, Poll},
};
use tower_lsp::jsonrpc::{Error, ErrorCode, Id, Request, Response};
use tower_service::Service;

/// Wraps the service.
pub(crate) struct Outer<S> {
    inner: S,
    shutdown: Arc<AtomicBool>,
}

impl<S> Outer<S> {
    /// `shutdown` shows whether a `shutdown` request was seen before.
    pub(crate) fn new(inner: S, shutdown: Arc<AtomicBool>) -> Self {
        Self { inner, shutdown }
    }
}

/// An answer at once, or that of the service.
pub(crate) enum Answer<F, E> {
    Now(Ready<Result<Option<Response>, E>>),
    Later(Pin<Box<F>>),
}

impl<F: Future<Output = Result<Option<Response>, E>>, E: Unpin> Future for Answer<F, E> {
    type Output = F::Output;
    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        match self.get_mut() {
            Self::Now(answer) => Pin::new(answer).poll(context),
            Self::Later(answer) => answer.as_mut().poll(context),
        }
    }
}

impl<S> Service<Request> for Outer<S>
where
    S: Service<Request, Response = Option<Response>>,
    S::Error: Unpin,
{
    type Response = S::Response;
    type Error = S::Error;
    type Future = Answer<S::Future, S::Error>;

    fn poll_ready(&mut self, context: &mut Context<'_>) -> Poll<Result<(), Self::Error>> {
        self.inner.poll_ready(context)
    }

    fn call(&mut self, request: Request) -> Self::Future {
        match request.method() {
            "exit" => std::process::exit(i32::from(!self.shutdown.load(Ordering::SeqCst))),
            MALFORMED => Answer::Now(ready(Ok(Some(refusal(&request))))),
            _ => Answer::Later(Box::pin(self.inner.call(request))),
        }
    }
}

/// The answer to a malformed message. It has no id that could be named.
fn refusal(request: &Request) -> Response {
    let params = request.params();
    let code = params.and_then(|params| params["code"].as_i64());
    let why = params
        .and_then(|params| params["message"].as_str())
        .unwrap_or("malformed message");
    let error = Error {
        code: code.map_or(ErrorCode::ParseError, ErrorCode::from),
        message: Cow::Owned(why.to_owned()),
        data: None,
    };
    Response::from_error(Id::Null, error)
}
