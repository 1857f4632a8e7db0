//! Floor 8: the language server. Only this crate knows LSP, JSON-RPC and tokio.
//!
//! One thread owns all state (`owner`); handlers only put events into its inbox, so that edits stay in wire order, and
//! await an answer. Work that takes time runs on a pool with a snapshot; newest version wins, and of what is
//! to be read, judged or sent only the newest waits (`latest`, `outbox`).
mod analysis;
mod backend;
mod backplot;
mod call_hierarchy;
mod capabilities;
mod cheap;
mod code_action;
mod coloured;
mod document;
mod edits;
mod event;
mod exit;
mod folder;
mod frames;
mod hover;
mod large;
mod latest;
mod moved;
mod names;
mod navigate;
mod outbox;
mod owner;
mod part;
mod position;
mod rewrites;
mod settings;
mod snapshot;
mod status;
mod structure;
mod text;
mod to_proto;
mod writing;

use backend::Backend;
use exit::Outer;
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};
use tower_lsp::{LspService, Server};

/// How many handlers may wait at once; tower-lsp's default of 4 lets four slow requests block every edit.
const CONCURRENCY: usize = 256;

/// Runs the language server on standard input and output until the client says exit or closes the stream.
/// Returns the exit status: 0 after `shutdown`, else 1.
pub fn serve() -> i32 {
    let Ok(runtime) = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(2)
        .enable_all()
        .build()
    else {
        return 2;
    };
    let shutdown = Arc::new(AtomicBool::new(false));
    let seen = Arc::clone(&shutdown);
    runtime.block_on(async move {
        let (service, socket) = LspService::build(|client| Backend::start(client, Arc::clone(&seen)))
            .custom_method("trunnion/backplot", Backend::backplot)
            .custom_method("trunnion/edit", Backend::edit)
            .custom_method("trunnion/rewrite", Backend::rewrite)
            .finish();
        let service = Outer::new(service, Arc::clone(&seen));
        let (messages, input) = tokio::io::duplex(1 << 16);
        tokio::spawn(frames::pump(tokio::io::stdin(), messages));
        Server::new(input, tokio::io::stdout(), socket)
            .concurrency_level(CONCURRENCY)
            .serve(service)
            .await;
    });
    // A blocking read of standard input may still hang in the pool: do not wait for it.
    runtime.shutdown_background();
    i32::from(!shutdown.load(Ordering::SeqCst))
}
