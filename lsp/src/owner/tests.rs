//! Of many versions of a document the newest alone is read.
use super::Owner;
use crate::{event::Event, outbox::Outbox};
use tokio::{runtime::Builder, sync::mpsc::unbounded_channel};
use tower_lsp::lsp_types::{Position, Range, TextDocumentContentChangeEvent, Url};

#[test]
fn of_many_versions_that_wait_the_newest_alone_is_read() {
    let runtime = Builder::new_multi_thread()
        .worker_threads(1)
        .max_blocking_threads(1)
        .enable_time()
        .build()
        .expect("a runtime");
    let (inbox, mut events) = unbounded_channel();
    let mut owner = Owner::new(inbox.clone(), Outbox::default(), runtime.handle().clone());
    // the only thread that reads is busy until all edits are there
    let (release, held) = std::sync::mpsc::channel::<()>();
    runtime.spawn_blocking(move || held.recv());
    let uri = Url::parse("untitled:a.nc").expect("an address");
    owner.handle(Event::Open {
        uri: uri.clone(),
        version: 1,
        text: "G21 G90\n".to_owned(),
    });
    for _ in 0..200 {
        owner.handle(Event::Change {
            uri: uri.clone(),
            // some clients never count
            version: 1,
            changes: vec![TextDocumentContentChangeEvent {
                range: Some(Range::new(Position::new(0, 0), Position::new(0, 0))),
                range_length: None,
                text: "X1 ".to_owned(),
            }],
        });
    }
    drop(release);
    runtime.spawn_blocking(move || drop(inbox.send(Event::FilesChanged)));
    let mut read = Vec::new();
    while let Some(event) = events.blocking_recv() {
        match event {
            Event::Parsed(parsed) => read.push(parsed),
            Event::FilesChanged => break,
            _ => {}
        }
    }
    let lengths: Vec<usize> = read.iter().map(|parsed| parsed.text.len()).collect();
    assert_eq!(lengths, [608]);
    owner.handle(Event::Parsed(read.remove(0)));
    let document = owner.documents.get(&uri).expect("open");
    assert!(document.is_parsed());
}
