//! Rewrites that the user asks the language server for, with their certificates, and edits of some lines.
use crate::lsp_client::{Client, apply};
use crate::lsp_features::{document, list};
use serde_json::{Value, json};

const URI: &str = "untitled:/part.mpf";
/// Strategy 2 of the guide vane: the path crosses the pole.
const FLIP: &str = include_str!("../../vscode-extension/tests/e2e/programs/strategy-2.mpf");
/// Two points lie on the line between their neighbours.
const EVEN: &str = "G21 G90 G17 G94 G54\nG0 X0. Y0. Z5.\nG1 X10. F100.\nG1 X20.\nG1 X30.\nG1 Y10.\nM30\n";

fn opened(options: &Value, text: &str) -> Client {
    let mut client = Client::start(options);
    client.open(URI, text);
    client.diagnostics(URI, 1);
    client
}

fn rewrite(client: &mut Client, name: &str, range: &Value) -> Value {
    client.request(
        "trunnion/rewrite",
        json!({ "textDocument": document(URI), "rewrite": name, "range": range }),
    )
}

fn actions(client: &mut Client, range: &Value, only: &Value) -> Vec<Value> {
    let context = json!({ "diagnostics": [], "only": only, "triggerKind": 1 });
    let ask = json!({ "textDocument": document(URI), "range": range, "context": context });
    list(&client.request("textDocument/codeAction", ask))
}

fn lines(first: u32, last: u32) -> Value {
    json!({ "start": { "line": first, "character": 0 }, "end": { "line": last, "character": 0 } })
}

#[test]
fn a_rewrite_comes_with_a_certificate_that_fits_its_texts() {
    let options = json!({ "machine": "mikron-ucp710", "tool": "ball:10", "dialect": "sinumerik-840d" });
    let mut client = opened(&options, FLIP);
    let answer = rewrite(&mut client, "smooth-pole", &Value::Null);
    let result = &answer["result"];
    let edits = result["edits"].as_array().unwrap_or_else(|| panic!("{answer}"));
    assert!(
        result["summary"]
            .as_str()
            .is_some_and(|said| said.starts_with("smooth-pole: ")),
        "{answer}"
    );
    // the certificate is checked by the command line, with the texts
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path
    };
    let before = file("before.mpf", FLIP);
    let after = file("after.mpf", &apply(FLIP, edits));
    let certificate = file("certificate.json", result["certificate"].as_str().expect("a text"));
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args([
            "certify",
            "--machine",
            "mikron-ucp710",
            "--dialect",
            "sinumerik-840d",
            "--tool",
            "ball:10",
        ])
        .arg(&before)
        .arg(&after)
        .arg("--certificate")
        .arg(&certificate)
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&run.stderr).into_owned() + &String::from_utf8_lossy(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{said}");
    client.finish();
}

#[test]
fn what_is_refused_says_why() {
    let mut client = opened(&json!({ "machine": "mill-3axis", "dialect": "fanuc-30i" }), EVEN);
    for (name, reason) in [
        ("smooth-pole", "nothing to change"),
        ("retarget", "there is no rewrite"),
        ("polish", "there is no rewrite `polish`"),
    ] {
        let answer = rewrite(&mut client, name, &Value::Null);
        assert_eq!(answer["error"]["code"], -32803, "{answer}");
        let said = answer["error"]["message"].as_str().unwrap_or_default();
        assert!(said.contains(reason), "{name}: {said}");
    }
    client.finish();
}

/// Each rewrite that finds something is offered on request, for all of the program and for the lines alone; clients that know the command can show more.
#[test]
fn rewrites_without_a_finding_are_offered_on_request() {
    let text = EVEN.replace("M30", "G0 Z5.\nG1 X0.\nG1 X-10.\nG1 X-20.\nM30");
    let settings = json!({ "machine": "mill-3axis", "dialect": "fanuc-30i", "commands": true });
    let mut client = opened(&settings, &text);
    let found = actions(&mut client, &lines(2, 5), &json!(["refactor.rewrite"]));
    let titles: Vec<&str> = found.iter().filter_map(|action| action["title"].as_str()).collect();
    let here = found
        .iter()
        .find(|action| action["title"] == "drop-redundant: here only (proved)");
    let here = here.unwrap_or_else(|| panic!("{titles:?}"));
    let after = apply(&text, here["edit"]["changes"][URI].as_array().expect("edits"));
    assert!(
        !after.contains("X20.\nG1 X30.") && after.contains("G1 X-10.\n"),
        "{after}"
    );
    let whole = found.iter().find(|action| {
        let title = action["title"].as_str().unwrap_or_default();
        title.starts_with("drop-redundant: ") && title.ends_with("(proved)") && !title.contains("here only")
    });
    let whole = whole.unwrap_or_else(|| panic!("{titles:?}"));
    let after = apply(&text, whole["edit"]["changes"][URI].as_array().expect("edits"));
    assert!(!after.contains("G1 X-10.\n"), "{after}");
    let shows = |action: &Value| action["command"]["arguments"][0] == "drop-redundant";
    let show: Vec<_> = found.iter().filter(|action| shows(action)).collect();
    assert_eq!(show.len(), 2, "{titles:?}");
    assert_eq!(show[0]["command"]["arguments"][1], lines(2, 5));
    assert_eq!(show[1]["command"]["arguments"][1], Value::Null);
    client.finish();

    // a client that says nothing of commands gets none
    let mut client = opened(&json!({ "machine": "mill-3axis", "dialect": "fanuc-30i" }), &text);
    let found = actions(&mut client, &lines(2, 5), &json!(["refactor.rewrite"]));
    assert!(found.iter().all(|action| action["command"].is_null()), "{found:?}");
    client.finish();
}

#[test]
fn chosen_lines_are_edited_alone() {
    let mut client = opened(&json!({ "dialect": "fanuc-30i" }), EVEN);
    let edit = json!({ "kind": "positions", "positions": "incremental" });
    let mut ask = |edit: &Value, range: Value| {
        let params = json!({ "textDocument": document(URI), "edit": edit, "range": range });
        client.request("trunnion/edit", params)
    };
    let answer = ask(&edit, lines(3, 5));
    let after = apply(
        EVEN,
        answer["result"]["edits"]
            .as_array()
            .unwrap_or_else(|| panic!("{answer}")),
    );
    assert_eq!(
        after,
        EVEN.replace("G1 X20.\nG1 X30.\nG1 Y10.", "G1 G91 X10.\nG1 X10.\nG1 G90 Y10.")
    );
    let refused = ask(&json!({ "kind": "shift", "by": [1, 0, 0] }), lines(3, 4));
    let said = refused["error"]["message"].as_str().unwrap_or_default();
    assert!(said.contains("where this cut begins in X"), "{refused}");
    // the same as a code action
    let found = actions(&mut client, &lines(3, 5), &json!(["refactor"]));
    let title = "write incremental positions (G91) in the chosen lines (proved)";
    assert!(found.iter().any(|action| action["title"] == title), "{found:?}");
    client.finish();
}

/// A TOML file of something else is no program and gets no findings.
#[test]
fn other_toml_files_are_left_alone() {
    let mut client = Client::start(&json!({}));
    let uri = "untitled:/Cargo.toml";
    client.open(uri, "[package]\nname = \"G1 X1\"\n");
    assert_eq!(client.first_diagnostics(uri, 1), Vec::<Value>::new());
    let at = json!({ "textDocument": document(uri), "position": { "line": 1, "character": 1 } });
    assert_eq!(client.request("textDocument/hover", at)["result"], Value::Null);
    client.finish();
}
