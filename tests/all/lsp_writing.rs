//! Help while writing in the language server over the wire: completion, signatures, folding, colours, hints, lenses, formatting, findings.
use crate::lsp_client::{Client, apply, position, text_of};
use crate::lsp_features::{MACRO, at, document, list, opened};
use serde_json::{Value, json};

fn labels(answer: &Value) -> Vec<String> {
    list(answer)
        .iter()
        .map(|item| item["label"].as_str().expect("a label").to_owned())
        .collect()
}

#[test]
fn completion_knows_dialect_and_context() {
    for (uri, text, wanted, not) in [
        ("untitled:/a.nc", "O1\nG43.", "G43.4", "G64"),
        (
            "untitled:/a.ngc",
            "(trunnion: dialect linuxcnc)\nG38.",
            "G38.3",
            "G43.4",
        ),
        ("untitled:/a.mpf", "G90 G71 G54\nTRAO", "TRAORI", "TRAO"),
        ("untitled:/a.nc", "O1\n#105=2\n#", "105", "G1"),
        ("untitled:/a.nc", "O1\nG83 X1. ", "Q", "I"),
        ("untitled:/a.apt", "PARTNO A\nGO", "GOTO", "LOADTL"),
        ("untitled:/a.nc", "O1\nIF[#1EQ1]GOTO7\nN7 G1\nGOTO ", "7", "G1"),
    ] {
        let mut client = opened(uri, text);
        let ask = json!({ "textDocument": document(uri), "position": position(text, text.len()) });
        let answer = client.request("textDocument/completion", ask);
        let found = labels(&answer);
        assert!(found.iter().any(|label| label == wanted), "{text}: {found:?}");
        assert!(!found.iter().any(|label| label == not), "{text}: {found:?}");
        client.finish();
    }
    let text = "O1\nG8";
    let mut client = opened("untitled:/a.nc", text);
    let ask = json!({ "textDocument": document("untitled:/a.nc"), "position": position(text, text.len()) });
    let answer = client.request("textDocument/completion", ask);
    let peck = list(&answer)
        .into_iter()
        .find(|item| item["label"] == "G83")
        .expect("listed");
    let docs = peck["documentation"]["value"].as_str().expect("documented");
    assert!(docs.contains("peck") && docs.contains("Fanuc"), "{docs}");
    assert_eq!(apply(text, &[peck["textEdit"].clone()]), "O1\nG83");
    client.finish();
}

#[test]
fn signatures_mark_the_word_at_the_cursor() {
    let text = "O1\nG83 X1. Z-5. R2. Q";
    let mut client = opened("untitled:/a.nc", text);
    let ask = json!({ "textDocument": document("untitled:/a.nc"), "position": position(text, text.len()) });
    let answer = client.request("textDocument/signatureHelp", ask);
    assert_eq!(answer["result"]["signatures"][0]["label"], "G83 R Q F K", "{answer}");
    assert_eq!(answer["result"]["activeParameter"], 1, "{answer}");
    client.finish();
}

#[test]
fn bodies_tools_and_programs_fold() {
    let mut client = opened("untitled:/a.nc", MACRO);
    let answer = client.request(
        "textDocument/foldingRange",
        json!({ "textDocument": document("untitled:/a.nc") }),
    );
    let found: Vec<_> = list(&answer)
        .iter()
        .map(|fold| (fold["startLine"].as_u64(), fold["endLine"].as_u64()))
        .collect();
    for wanted in [(5, 7), (3, 11), (12, 16)] {
        assert!(
            found.contains(&(Some(wanted.0), Some(wanted.1))),
            "{wanted:?} in {found:?}"
        );
    }
    client.finish();
}

/// A client that keeps few regions gets the longest of them, in the order of the text.
#[test]
fn the_longest_regions_fold() {
    let mut client = Client::start_able(&json!({ "textDocument": { "foldingRange": { "rangeLimit": 2 } } }));
    client.open("untitled:/a.nc", MACRO);
    let answer = client.request(
        "textDocument/foldingRange",
        json!({ "textDocument": document("untitled:/a.nc") }),
    );
    let found: Vec<_> = list(&answer)
        .iter()
        .map(|fold| [&fold["startLine"], &fold["endLine"]].map(Value::as_u64))
        .collect();
    // the program, and its first tool; the second tool and the loop are shorter
    assert_eq!(found, [[Some(0), Some(16)], [Some(3), Some(11)]]);
    client.finish();
}

#[test]
fn a_selection_grows_from_the_value_to_the_program() {
    let mut client = opened("untitled:/a.nc", MACRO);
    let at = position(MACRO, MACRO.find("X10. Z").expect("there") + 2);
    let ask = json!({ "textDocument": document("untitled:/a.nc"), "positions": [at] });
    let answer = client.request("textDocument/selectionRange", ask);
    let (mut step, mut found) = (list(&answer)[0].clone(), Vec::new());
    while step.is_object() {
        found.push(text_of(MACRO, &step["range"]).to_owned());
        step = step["parent"].clone();
    }
    assert_eq!(found[..3], ["10.", "X10.", "G81 X10. Z-5. R2. F100."], "{found:?}");
    assert_eq!(found.last().map(String::as_str), Some(MACRO));
    client.finish();
}

/// The pieces that colours name.
fn pieces(text: &str, data: &[Value], types: &[Value]) -> Vec<String> {
    let lines: Vec<&str> = text.split('\n').collect();
    let (mut line, mut column, mut found) = (0, 0, Vec::new());
    for token in data.chunks(5) {
        let number = |at: usize| token[at].as_u64().expect("a number") as usize;
        if number(0) > 0 {
            (line, column) = (line + number(0), 0);
        }
        column += number(1);
        let units: Vec<u16> = lines[line].encode_utf16().collect();
        let piece = String::from_utf16(&units[column..column + number(2)]).expect("text");
        found.push(format!("{piece}={}", types[number(3)].as_str().expect("a name")));
    }
    found
}

#[test]
fn colours_come_whole_in_part_and_as_a_difference() {
    let text = "(\u{1f527} tool) G1 X1.5\nG0 Z2 ; end\nM30\n";
    let uri = "untitled:/a.ngc";
    let mut client = opened(uri, text);
    let types = json!(trunnion_ide_types());
    let types = types.as_array().expect("a list");
    let whole = client.request(
        "textDocument/semanticTokens/full",
        json!({ "textDocument": document(uri) }),
    );
    let all = whole["result"]["data"].as_array().expect("numbers").clone();
    assert_eq!(
        pieces(text, &all, types),
        [
            "(\u{1f527} tool)=comment",
            "G1=keyword",
            "X=parameter",
            "1.5=number",
            "G0=keyword",
            "Z=parameter",
            "2=number",
            "; end=comment",
            "M30=function"
        ]
    );
    let range = json!({ "start": { "line": 1, "character": 0 }, "end": { "line": 1, "character": 3 } });
    let part = client.request(
        "textDocument/semanticTokens/range",
        json!({ "textDocument": document(uri), "range": range }),
    );
    let part = part["result"]["data"].as_array().expect("numbers").clone();
    assert_eq!(
        pieces(text, &part, types),
        ["G0=keyword", "Z=parameter", "2=number", "; end=comment"]
    );
    let at = text.find("Z2").expect("there");
    client.edit(uri, 2, text, at..at + 2, "X3 Y4");
    let changed = text.replace("Z2", "X3 Y4");
    let ask = json!({ "textDocument": document(uri), "previousResultId": whole["result"]["resultId"] });
    let answer = client.request("textDocument/semanticTokens/full/delta", ask);
    let mut data = all;
    for edit in answer["result"]["edits"].as_array().expect("a difference") {
        let (start, count) = (
            edit["start"].as_u64().expect("a number") as usize,
            edit["deleteCount"].as_u64().expect("a number") as usize,
        );
        data.splice(
            start..start + count,
            edit["data"].as_array().cloned().unwrap_or_default(),
        );
    }
    let fresh = client.request(
        "textDocument/semanticTokens/full",
        json!({ "textDocument": document(uri) }),
    );
    assert_eq!(data, *fresh["result"]["data"].as_array().expect("numbers"));
    assert!(pieces(&changed, &data, types).contains(&"Y=parameter".to_owned()));
    client.finish();
}

fn trunnion_ide_types() -> [&'static str; 10] {
    [
        "comment",
        "string",
        "number",
        "keyword",
        "function",
        "macro",
        "variable",
        "parameter",
        "label",
        "operator",
    ]
}

#[test]
fn hints_show_values_and_can_be_switched_off() {
    let uri = "untitled:/a.nc";
    let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let ask = json!({ "textDocument": document(uri), "range": range });
    let mut client = opened(uri, MACRO);
    let answer = client.request("textDocument/inlayHint", ask.clone());
    let found: Vec<_> = list(&answer)
        .iter()
        .map(|hint| hint["label"].as_str().expect("text").to_owned())
        .collect();
    assert_eq!(
        found,
        [
            "mm, absolute, G54, feed per minute",
            "= 10",
            "= 4",
            "mm, absolute, G54, feed per minute"
        ],
        "{answer}"
    );
    client.finish();
    let mut client = Client::start(&json!({ "hints": { "values": false, "modal": false } }));
    client.open(uri, MACRO);
    assert_eq!(
        list(&client.request("textDocument/inlayHint", ask)),
        Vec::<Value>::new()
    );
    client.finish();
}

#[test]
fn a_lens_states_the_time_of_an_operation() {
    // 3 axes: 100 mm at 100 mm/min are 60 s
    let text = "(trunnion: machine mill-3axis)\nG21 G90 G54\nT1 M6\nG43 H1\nG1 X0 Y0 Z50 F1000\nG1 X100 F100\nM30\n";
    let uri = "untitled:/a.nc";
    let mut client = opened(uri, text);
    let lenses = list(&client.request("textDocument/codeLens", json!({ "textDocument": document(uri) })));
    assert_eq!(lenses.len(), 1, "{lenses:?}");
    assert_eq!(lenses[0]["command"]["title"], "T1: 1 min 0 s", "{lenses:?}");
    client.finish();
}

#[test]
fn formatting_is_proved_and_of_lines_alone_changes_only_them() {
    let text = "g21 g90\ng1  x1.   f100.\ng1 x2.\nm30\n";
    let uri = "untitled:/a.nc";
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let mut client = opened(uri, text);
    let answer = client.request(
        "textDocument/formatting",
        json!({ "textDocument": document(uri), "options": options }),
    );
    assert_eq!(apply(text, &list(&answer)), "G21 G90\nG1 X1. F100.\nG1 X2.\nM30\n");
    let range = json!({ "start": { "line": 1, "character": 0 }, "end": { "line": 1, "character": 4 } });
    let answer = client.request(
        "textDocument/rangeFormatting",
        json!({ "textDocument": document(uri), "range": range, "options": options }),
    );
    assert_eq!(apply(text, &list(&answer)), "g21 g90\nG1 X1. F100.\ng1 x2.\nm30\n");
    let ask = json!({ "textDocument": document(uri), "position": { "line": 3, "character": 0 }, "ch": "\n", "options": options });
    let answer = client.request("textDocument/onTypeFormatting", ask);
    assert_eq!(apply(text, &list(&answer)), "g21 g90\ng1  x1.   f100.\nG1 X2.\nm30\n");
    client.finish();
}

#[test]
fn findings_can_be_asked_for_and_are_the_same() {
    let uri = "untitled:/a.nc";
    let text = "O1\nG21 G90 G54\nG1 X1. Q\nG999\nM30\n";
    let mut client = Client::start(&json!({ "machine": "mill-3axis" }));
    client.open(uri, text);
    let pushed = client.diagnostics(uri, 1);
    let answer = client.request("textDocument/diagnostic", json!({ "textDocument": document(uri) }));
    assert_eq!(answer["result"]["kind"], "full", "{answer}");
    assert_eq!(answer["result"]["items"].as_array(), Some(&pushed));
    assert!(!pushed.is_empty());
    client.finish();
}

#[test]
fn what_the_text_says_comes_first_and_older_findings_keep_their_places() {
    let uri = "untitled:/a.nc";
    let text = "O1\nG21 G90 G54\nT1 M6\nG43 H1\nG1 X1. F100.\nG1 X100000.\nM30\n";
    let mut client = Client::start(&json!({ "machine": "mill-3axis" }));
    client.open(uri, text);
    let before = client.diagnostics(uri, 1);
    let of = |list: &[Value], rule: &str| list.iter().filter(|d| d["code"] == rule).cloned().collect::<Vec<_>>();
    let limits = of(&before, "axis-limit");
    assert_eq!(limits.len(), 1, "{before:?}");
    client.edit(uri, 2, text, 3..3, "G1 (\n");
    let first = client.first_diagnostics(uri, 2);
    let moved = of(&first, "axis-limit");
    assert_eq!(moved[0]["range"]["start"]["line"], 6, "{first:?}");
    assert!(first.iter().any(|d| d["code"] == "unclosed-comment"), "{first:?}");
    client.finish();
}

#[test]
fn settings_and_machine_files_have_findings_hover_and_completion() {
    let uri = "untitled:/trunnion.toml";
    let text = "machine = \"mikron-ucp710\"\n[control]\nunits = \"mm\"\npeck\n";
    let mut client = opened(uri, text);
    let found = client.first_diagnostics(uri, 1);
    assert_eq!(found[0]["range"]["start"]["line"], 3, "{found:?}");
    let ask = json!({ "textDocument": document(uri), "position": { "line": 3, "character": 4 } });
    let answer = client.request("textDocument/completion", ask);
    assert_eq!(labels(&answer), ["peck_clearance"]);
    let docs = list(&answer)[0]["documentation"]["value"]
        .as_str()
        .expect("documented")
        .to_owned();
    assert!(docs.contains("G83"), "{docs}");
    let hover = client.request("textDocument/hover", at(uri, text, "units", 2));
    assert!(
        hover["result"]["contents"]["value"]
            .as_str()
            .is_some_and(|text| text.contains("G20")),
        "{hover}"
    );
    client.finish();
    let uri = "untitled:/ours.toml";
    let text = "schema = \"ncmachine/1\"\n[[axis]]\nletter = \"X\"\nlim\n";
    let mut client = opened(uri, text);
    assert!(!client.first_diagnostics(uri, 1).is_empty());
    let ask = json!({ "textDocument": document(uri), "position": { "line": 3, "character": 3 } });
    let answer = client.request("textDocument/completion", ask);
    assert_eq!(labels(&answer), ["limit_margin", "limits"]);
    client.finish();
}

#[test]
fn workspace_symbols_are_those_of_all_its_programs() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("parts")).expect("made");
    std::fs::write(folder.path().join("parts/a.nc"), MACRO).expect("written");
    let root = format!("file://{}", folder.path().display());
    let mut client = Client::start_in(&json!({}), &root);
    let found = list(&client.request("workspace/symbol", json!({ "query": "drill" })));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["name"], "T2 DRILL");
    client.finish();
}
