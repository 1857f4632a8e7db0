//! Edits of the whole program that the user asks the language server for: code actions, and the request with numbers.
use crate::lsp_client::{Client, apply};
use crate::lsp_features::{document, list, opened};
use serde_json::{Value, json};

const URI: &str = "untitled:/part.nc";
const PART: &str = "%\nO1\nG21 G90 G17\nG54 M3 S1000\nG0 X25.4 Y50.8 Z5.08\nG1 Z-2.54 F254.\nM30\n%\n";

fn actions(client: &mut Client, context: &Value) -> Vec<Value> {
    let zero = json!({ "line": 0, "character": 0 });
    let ask = json!({ "textDocument": document(URI), "range": { "start": zero, "end": zero }, "context": context });
    list(&client.request("textDocument/codeAction", ask))
}

#[test]
fn unit_and_positions_are_offered_proved_or_disabled_with_the_reason() {
    let mut client = opened(URI, PART);
    let asked = json!({ "diagnostics": [], "only": ["refactor"] });
    let found = actions(&mut client, &asked);
    let named = |title: &str| found.iter().find(|action| action["title"] == title).cloned();
    let inch = named("write in inch (proved)").unwrap_or_else(|| panic!("{found:?}"));
    let edits = inch["edit"]["changes"][URI].as_array().expect("edits").clone();
    let text = apply(PART, &edits);
    assert!(
        text.contains("G20 G90") && text.contains("X1. Y2. Z0.2") && text.contains("Z-0.1 F10."),
        "{text}"
    );
    // there is nothing to do
    assert!(named("write in mm (proved)").is_none(), "{found:?}");
    // not at each move of the cursor
    let quiet = actions(&mut client, &json!({ "diagnostics": [], "triggerKind": 2 }));
    assert!(
        quiet.iter().all(|action| action["kind"] != "refactor.rewrite"),
        "{quiet:?}"
    );
    client.finish();

    let mut client = opened(URI, &PART.replace("Z-2.54", "Z#1"));
    let found = actions(&mut client, &asked);
    let refused = found.iter().find(|action| {
        action["title"]
            .as_str()
            .is_some_and(|title| title.starts_with("write in inch: not offered"))
    });
    let reason = refused
        .map(|action| action["disabled"]["reason"].to_string())
        .unwrap_or_default();
    assert!(reason.contains("line 6: ") && reason.contains("Z#1"), "{found:?}");
    client.finish();
}

#[test]
fn an_edit_with_numbers_is_answered_or_refused() {
    let mut client = opened(URI, PART);
    let mut ask = |edit: Value| client.request("trunnion/edit", json!({ "textDocument": document(URI), "edit": edit }));
    let answer = ask(json!({ "kind": "shift", "by": [10, 0, -1] }));
    let edits = answer["result"]["edits"]
        .as_array()
        .unwrap_or_else(|| panic!("{answer}"))
        .clone();
    let text = apply(PART, &edits);
    assert!(
        text.contains("G0 X35.4 Y50.8 Z4.08") && text.contains("Z-3.54 F254."),
        "{text}"
    );
    assert!(
        answer["result"]["summary"]
            .as_str()
            .is_some_and(|summary| summary.contains("proved")),
        "{answer}"
    );
    let answer = ask(json!({ "kind": "rotate", "axis": "Z", "degrees": 90 }));
    let edits = answer["result"]["edits"]
        .as_array()
        .unwrap_or_else(|| panic!("{answer}"))
        .clone();
    assert!(apply(PART, &edits).contains("G0 X-50.8 Y25.4 Z5.08"), "{answer}");
    let answer = ask(json!({ "kind": "mirror", "axis": "Z" }));
    assert_eq!(answer["error"]["code"], -32803, "{answer}");
    assert!(
        answer["error"]["message"]
            .as_str()
            .is_some_and(|message| message.contains("along the tool")),
        "{answer}"
    );
    let answer = ask(json!({ "kind": "twist" }));
    assert!(answer["error"]["code"].is_i64(), "{answer}");
    client.finish();
}
