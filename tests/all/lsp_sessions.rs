//! Recorded sessions of editors, played again: each request is answered, the findings are those of a cold run, and the server ends as it should.
//! CONTRIBUTING.md says how they are recorded.
use crate::lsp_client::{Client, apply, byte};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// What a client has sent, message by message; `$ROOT` is its folder, `$TMP` a file of its own.
fn recorded(session: &str, root: &str) -> Vec<Value> {
    let place = |line: &str| line.replace("$ROOT", root).replace("$TMP", &format!("{root}/path.bin"));
    session
        .lines()
        .map(|line| serde_json::from_str(&place(line)).expect("a message"))
        .collect()
}

/// A text after the changes of a client.
fn changed(text: &str, changes: &[Value]) -> String {
    changes.iter().fold(text.to_owned(), |text, change| {
        let new = change["text"].as_str().expect("a text");
        if change["range"].is_null() {
            return new.to_owned();
        }
        apply(&text, &[json!({ "range": change["range"], "newText": new })])
    })
}

/// The documents as they stand at some place of the session: text and version.
fn follow(open: &mut BTreeMap<String, (String, i64)>, message: &Value) {
    let document = &message["params"]["textDocument"];
    let uri = || document["uri"].as_str().expect("a URI").to_owned();
    let version = || document["version"].as_i64().expect("a number");
    match message["method"].as_str() {
        Some("textDocument/didOpen") => {
            open.insert(
                uri(),
                (document["text"].as_str().expect("a text").to_owned(), version()),
            );
        }
        Some("textDocument/didChange") => {
            let known = open.get_mut(&uri()).expect("it is open");
            let changes = message["params"]["contentChanges"].as_array().expect("a list");
            *known = (changed(&known.0, changes), version());
        }
        Some("textDocument/didClose") => drop(open.remove(&uri())),
        _ => {}
    }
}

/// A finding without what may come in another order.
fn finding(found: &Value) -> String {
    json!([found["range"], found["code"], found["severity"], found["message"]]).to_string()
}

fn findings(client: &mut Client, uri: &str, version: i64) -> BTreeSet<String> {
    client.diagnostics(uri, version).iter().map(finding).collect()
}

/// Clients wait for the answers to these before they go on: what they do next comes of it.
const WAITED_FOR: [&str; 5] = [
    "initialize",
    "textDocument/formatting",
    "textDocument/rename",
    "trunnion/backplot",
    "trunnion/rewrite",
];

/// Plays a session; says which kinds of requests it had.
fn play(session: &str, files: &[(&str, &str)]) -> BTreeSet<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().to_str().expect("text").to_owned();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let messages = recorded(session, &root);
    let initialize = &messages[0];
    assert_eq!(initialize["method"], "initialize");
    let mut client = Client::bare();
    let mut open = BTreeMap::new();
    let mut asked: BTreeMap<i64, String> = BTreeMap::new();
    let mut answered = BTreeSet::new();
    for message in &messages {
        follow(&mut open, message);
        match (message["method"].as_str(), message["id"].as_i64()) {
            // the end is ours, and so are the answers to the server
            (Some("shutdown" | "exit") | None, _) => continue,
            (Some(method), Some(id)) => drop(asked.insert(id, method.to_owned())),
            (Some(_), None) => {}
        }
        client.send(message);
        if let (Some(method), Some(id)) = (message["method"].as_str(), message["id"].as_i64())
            && WAITED_FOR.contains(&method)
        {
            let answer = client.answer(id);
            assert!(answer["error"].is_null(), "{method}: {answer}");
            answered.insert(method.to_owned());
            asked.remove(&id);
        }
    }
    for (id, method) in &asked {
        let answer = client.answer(*id);
        // cancelled, or asked of a text that was changed before the answer
        let late = matches!(answer["error"]["code"].as_i64(), Some(-32800 | -32801));
        assert!(answer["error"].is_null() || late, "{method}: {answer}");
    }
    compare(client, initialize, &open);
    answered.extend(asked.into_values());
    answered
}

/// The findings after the session against those of a new server that opens the last texts.
fn compare(mut client: Client, initialize: &Value, open: &BTreeMap<String, (String, i64)>) {
    let mut cold = Client::bare();
    cold.send(initialize);
    cold.answer(initialize["id"].as_i64().expect("a number"));
    cold.send(&json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }));
    let programs: Vec<_> = open.iter().filter(|(uri, _)| !uri.contains("trunnion.toml")).collect();
    assert!(!programs.is_empty(), "the session ends with an open program");
    for (uri, (text, version)) in programs {
        // the last change once more, so that its findings come after all answers
        client.change_all(uri, version + 1, text);
        let warm = findings(&mut client, uri, version + 1);
        cold.open(uri, text);
        assert_eq!(warm, findings(&mut cold, uri, 1), "{uri}");
        let hover = |client: &mut Client| {
            let ask = json!({ "textDocument": { "uri": uri }, "position": { "line": 4, "character": 2 } });
            client.request("textDocument/hover", ask)["result"].clone()
        };
        client.continue_at(1_000_000);
        cold.continue_at(1_000_000);
        assert_eq!(hover(&mut client), hover(&mut cold), "{uri}");
    }
    client.finish();
    cold.finish();
}

/// What lies in the folder when a session begins.
const FILES: [(&str, &str); 2] = [
    (
        "part.nc",
        include_str!("../../vscode-extension/tests/e2e/programs/part.nc"),
    ),
    ("trunnion.toml", "machine = \"mill-3axis\"\n"),
];

#[test]
fn a_session_of_vs_code() {
    let session = include_str!("../sessions/vscode.jsonl");
    let kinds = play(session, &FILES);
    for kind in [
        "textDocument/codeAction",
        "textDocument/completion",
        "textDocument/documentSymbol",
        "textDocument/formatting",
        "textDocument/hover",
        "textDocument/inlayHint",
        "textDocument/rename",
        "textDocument/semanticTokens/range",
        "trunnion/backplot",
        "trunnion/rewrite",
    ] {
        assert!(kinds.contains(kind), "{kind} is not in the session: {kinds:?}");
    }
}

#[test]
fn a_session_of_neovim() {
    let session = include_str!("../sessions/neovim.jsonl");
    let kinds = play(session, &FILES);
    for kind in [
        "textDocument/codeAction",
        "textDocument/completion",
        "textDocument/definition",
        "textDocument/documentSymbol",
        "textDocument/formatting",
        "textDocument/hover",
        "textDocument/references",
        "textDocument/rename",
    ] {
        assert!(kinds.contains(kind), "{kind} is not in the session: {kinds:?}");
    }
}

#[test]
fn changes_are_followed_as_clients_mean_them() {
    let range = |from: u32, to: u32| json!({ "start": { "line": 1, "character": from }, "end": { "line": 1, "character": to } });
    let text = changed(
        "G0 X1\n(\u{e4}\u{1f6e0}) Y2\n",
        &[
            json!({ "range": range(6, 8), "text": "Z3" }),
            json!({ "range": range(0, 0), "text": "N1 " }),
        ],
    );
    assert_eq!(text, "G0 X1\nN1 (\u{e4}\u{1f6e0}) Z3\n");
    assert_eq!(
        byte(&text, &json!({ "line": 1, "character": 7 })),
        "G0 X1\nN1 (\u{e4}\u{1f6e0}".len()
    );
}
