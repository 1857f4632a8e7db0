//! The language server under malformed messages: each is answered with an error or passed over, and the next one is served.
use crate::lsp_client::Client;
use serde_json::{Value, json};

const URI: &str = "untitled:/a.nc";
const PROGRAM: &str = "(trunnion: dialect fanuc-30i)\nG21 G90 G17 G54\nG1 X1.\nM30\n";

fn frame(body: &[u8]) -> Vec<u8> {
    [format!("Content-Length: {}\r\n\r\n", body.len()).as_bytes(), body].concat()
}

fn message(value: &Value) -> Vec<u8> {
    frame(value.to_string().as_bytes())
}

/// What the server does with a malformed message.
enum Then {
    /// It answers with this error code; the message has the number 900, or none that can be named.
    Error(i64),
    /// It says nothing, as to any notification.
    Nothing,
    /// It answers the request 900.
    Answer,
}

#[expect(clippy::too_many_lines, reason = "it is one list")]
fn malformed() -> Vec<(&'static str, Vec<u8>, Then)> {
    let request = |method: &str, params: Value| {
        message(&json!({ "jsonrpc": "2.0", "id": 900, "method": method, "params": params }))
    };
    let notice =
        |method: &str, params: Value| message(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    let at = |line: u64, character: u64| json!({ "line": line, "character": character });
    let change = |version: i64, changes: Value| {
        notice(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": URI, "version": version }, "contentChanges": changes }),
        )
    };
    let parse = || Then::Error(-32700);
    let invalid = || Then::Error(-32600);
    vec![
        ("no JSON", frame(b"G1 X1."), parse()),
        (
            "JSON that ends early",
            frame(br#"{"jsonrpc":"2.0","id":900,"method":"#),
            parse(),
        ),
        ("nothing", frame(b""), parse()),
        (
            "bytes that are not UTF-8",
            frame(b"{\"jsonrpc\":\"2.0\",\"method\":\"\xff\xfe\"}"),
            parse(),
        ),
        (
            "half a surrogate",
            frame(br#"{"jsonrpc":"2.0","method":"\ud800"}"#),
            parse(),
        ),
        (
            "deep nesting",
            frame(&[vec![b'['; 100_000], vec![b']'; 100_000]].concat()),
            invalid(),
        ),
        (
            "deep parameters",
            frame(
                &[
                    br#"{"jsonrpc":"2.0","method":"x","params":"#.to_vec(),
                    vec![b'['; 100_000],
                ]
                .concat(),
            ),
            parse(),
        ),
        ("no header", b"G1 X1. and no header\r\n\r\n".to_vec(), parse()),
        (
            "a header without length",
            b"Content-Type: application/json\r\n\r\n".to_vec(),
            parse(),
        ),
        (
            "a length that is no number",
            b"Content-Length: many\r\n\r\n".to_vec(),
            parse(),
        ),
        ("a negative length", b"Content-Length: -1\r\n\r\n".to_vec(), parse()),
        (
            "an absurd length",
            b"Content-Length: 999999999999999\r\n\r\n".to_vec(),
            parse(),
        ),
        (
            "a length beyond all numbers",
            b"Content-Length: 99999999999999999999999999\r\n\r\n".to_vec(),
            parse(),
        ),
        (
            "a long header line",
            [vec![b'x'; 100_000], b"\r\n\r\n".to_vec()].concat(),
            parse(),
        ),
        ("an empty batch", frame(b"[]"), invalid()),
        (
            "a batch",
            frame(br#"[{"jsonrpc":"2.0","id":900,"method":"shutdown"}]"#),
            invalid(),
        ),
        ("a number", frame(b"5"), invalid()),
        ("an empty object", frame(b"{}"), invalid()),
        (
            "another version of the protocol",
            message(&json!({ "jsonrpc": "1.0", "id": 900, "method": "shutdown" })),
            invalid(),
        ),
        (
            "a method that is a number",
            message(&json!({ "jsonrpc": "2.0", "id": 900, "method": 5 })),
            invalid(),
        ),
        (
            "an id that is an object",
            message(&json!({ "jsonrpc": "2.0", "id": {}, "method": "shutdown" })),
            invalid(),
        ),
        (
            "parameters that are a number",
            request("textDocument/hover", json!(5)),
            invalid(),
        ),
        (
            "null parameters",
            request("textDocument/hover", Value::Null),
            Then::Error(-32602),
        ),
        (
            "no parameters",
            message(&json!({ "jsonrpc": "2.0", "id": 900, "method": "textDocument/hover" })),
            Then::Error(-32602),
        ),
        (
            "parameters of another method",
            request("textDocument/hover", json!({ "command": "x" })),
            Then::Error(-32602),
        ),
        (
            "a line that is a text",
            request(
                "textDocument/hover",
                json!({ "textDocument": { "uri": URI }, "position": { "line": "1", "character": 0 } }),
            ),
            Then::Error(-32602),
        ),
        (
            "a negative line",
            request(
                "textDocument/hover",
                json!({ "textDocument": { "uri": URI }, "position": { "line": -1, "character": 0 } }),
            ),
            Then::Error(-32602),
        ),
        (
            "an address that is none",
            request(
                "textDocument/hover",
                json!({ "textDocument": { "uri": "no address" }, "position": at(0, 0) }),
            ),
            Then::Error(-32602),
        ),
        (
            "an unknown method",
            request("textDocument/teleport", json!({})),
            Then::Error(-32601),
        ),
        (
            "a second initialize",
            request("initialize", json!({ "capabilities": {} })),
            invalid(),
        ),
        (
            "an unknown notification",
            notice("$/teleport", json!({})),
            Then::Nothing,
        ),
        (
            "an answer to nothing",
            message(&json!({ "jsonrpc": "2.0", "id": 77, "result": null })),
            Then::Nothing,
        ),
        (
            "a change without a document",
            notice("textDocument/didChange", json!({ "contentChanges": [] })),
            Then::Nothing,
        ),
        (
            "a change of a document that is not open",
            notice(
                "textDocument/didChange",
                json!({ "textDocument": { "uri": "untitled:/no.nc", "version": 3 }, "contentChanges": [{ "text": "G1" }] }),
            ),
            Then::Nothing,
        ),
        (
            "a close of it",
            notice(
                "textDocument/didClose",
                json!({ "textDocument": { "uri": "untitled:/no.nc" } }),
            ),
            Then::Nothing,
        ),
        (
            "a range outside the document",
            change(
                2,
                json!([{ "range": { "start": at(4_000_000_000, 0), "end": at(4_000_000_000, 9) }, "text": "" }]),
            ),
            Then::Nothing,
        ),
        (
            "a range whose end is before its start",
            change(
                3,
                json!([{ "range": { "start": at(2, 3), "end": at(1, 0) }, "text": "" }]),
            ),
            Then::Nothing,
        ),
        (
            "a version that goes back",
            change(1, json!([{ "text": PROGRAM }])),
            Then::Nothing,
        ),
        (
            "a version below zero",
            change(-5, json!([{ "text": PROGRAM }])),
            Then::Nothing,
        ),
        (
            "a hover outside the document",
            request(
                "textDocument/hover",
                json!({ "textDocument": { "uri": URI }, "position": at(4_000_000_000, 4_000_000_000) }),
            ),
            Then::Answer,
        ),
        (
            "a hover in a document that is not open",
            request(
                "textDocument/hover",
                json!({ "textDocument": { "uri": "untitled:/no.nc" }, "position": at(0, 0) }),
            ),
            Then::Answer,
        ),
        (
            "a quick fix for a range outside the document",
            request(
                "textDocument/codeAction",
                json!({ "textDocument": { "uri": URI }, "range": { "start": at(99, 0), "end": at(98, 0) }, "context": { "diagnostics": [] } }),
            ),
            Then::Answer,
        ),
    ]
}

#[test]
fn each_malformed_message_is_answered_and_the_next_is_served() {
    let all = malformed();
    assert!(all.len() >= 40, "{}", all.len());
    let mut client = Client::start(&json!({}));
    client.open(URI, PROGRAM);
    let mut version = 100;
    for (name, bytes, then) in all {
        client.send_bytes(&bytes);
        match then {
            Then::Error(code) => {
                let answer = client.error();
                assert_eq!(answer["error"]["code"], code, "{name}: {answer}");
                let text = answer["error"]["message"].as_str().unwrap_or_default();
                assert!(!text.is_empty() && text.len() < 1000, "{name}: {answer}");
            }
            Then::Nothing => {}
            Then::Answer => {
                let answer = client.answer(900);
                assert!(
                    answer["error"].is_null() || answer["error"]["code"].is_i64(),
                    "{name}: {answer}"
                );
            }
        }
        // it goes on: the document is judged as it is now
        version += 1;
        client.change_all(URI, version, PROGRAM);
        let found = client.diagnostics(URI, version);
        assert!(
            found.iter().any(|finding| finding["code"] == "missing-feed"),
            "{name}: {found:?}"
        );
    }
    client.finish();
}
