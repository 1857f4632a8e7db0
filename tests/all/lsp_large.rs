//! Long documents in the language server: what is visible is judged first, and in the end all is as in a cold run.
use crate::lsp_client::{Client, position};
use crate::random::Random;
use serde_json::{Value, json};
use std::fmt::Write;

/// More than 1 MB, so that the server reads it in parts.
const LINES: usize = 32_000;

/// A five-axis program with findings of the text and of the machine all along. `head` comes after the comments.
fn program(head: &str) -> String {
    let mut text = format!("(trunnion: dialect fanuc-30i)\n(trunnion: machine mikron-ucp710)\n{head}");
    text.push_str("G21 G90 G17 G54\nT1 M6\nS12000 M3\nG43.4 H1\nG0 X0. Y0. Z80. A0. C0.\n");
    for i in 0..LINES {
        let (x, y) = (i % 100, i / 100 % 100);
        let _ = match i % 2000 {
            700 => writeln!(text, "G1 X{x}. Y{y}. Z60. [A2. C1. F2000."),
            1350 => writeln!(text, "G1 X{x}. Y{y}. Z60. A20. C90. F2000. (C turns too fast)"),
            _ => writeln!(
                text,
                "N{} G1 X{x}. Y{y}. Z60.{} A20.{} C5.{} F2000.",
                i % 9000,
                i % 7,
                i % 5,
                i % 9
            ),
        };
    }
    text.push_str("M30\n");
    assert!(text.len() > 1 << 20);
    text
}

fn line_of(text: &str, line: usize) -> std::ops::Range<usize> {
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    start..start + text[start..].find('\n').expect("a line end")
}

fn at_line(found: &[Value], line: usize) -> Vec<&str> {
    let here = found.iter().filter(|one| one["range"]["start"]["line"] == line);
    here.map(|one| one["code"].as_str().expect("a rule")).collect()
}

#[test]
fn what_is_visible_comes_first_and_is_no_verdict() {
    let text = program("O1\n");
    let uri = "untitled:/long.nc";
    let mut client = Client::start(&json!({}));
    client.open(uri, &text);
    let first = client.first_diagnostics(uri, 1);
    let line = 8 + 1350;
    assert!(at_line(&first, line).contains(&"axis-overspeed"), "{first:?}");
    let all = client.diagnostics(uri, 1);
    // nothing that only the end decides, and nothing beyond the part
    assert!(
        first.len() > 3 && first.len() < all.len(),
        "{} of {}",
        first.len(),
        all.len()
    );
    for one in &first {
        let same = |other: &&Value| other["code"] == one["code"] && other["range"] == one["range"];
        assert!(all.iter().any(|other| same(&other)), "{one}");
    }
    client.finish();
}

#[test]
fn the_first_status_of_a_long_program_says_that_it_is_checked() {
    let mut client = Client::start(&json!({}));
    client.open("untitled:/long.nc", &program("O1\n"));
    assert_eq!(client.verdict(), "checking");
    assert_eq!(client.verdict(), "fail");
    client.finish();
}

#[test]
fn after_an_edit_the_part_has_the_new_finding_and_the_older_ones_have_moved() {
    let mut text = program("O1\n");
    let uri = "untitled:/long.nc";
    let mut client = Client::start(&json!({}));
    client.open(uri, &text);
    client.diagnostics(uri, 1);
    let line = 20_000;
    let place = line_of(&text, line);
    let new = "G1 X92.5 C95. F2000.\nG1 X93. C5. F2000.";
    client.edit(uri, 2, &text, place.clone(), new);
    let first = client.first_diagnostics(uri, 2);
    text.replace_range(place, new);
    assert!(at_line(&first, line).contains(&"axis-overspeed"), "it is new");
    let (before, behind) = (8 + 18_000 + 1350, 8 + 20_000 + 1350 + 1);
    assert!(at_line(&first, before).contains(&"axis-overspeed"), "it has not moved");
    assert!(
        at_line(&first, behind).contains(&"axis-overspeed"),
        "it has moved by a line"
    );
    let all = client.diagnostics(uri, 2);
    let mut cold = Client::start(&json!({}));
    cold.open(uri, &text);
    assert_eq!(all, cold.diagnostics(uri, 1));
    cold.finish();
    client.finish();
}

/// What a server answers about the lines round one.
fn answers(client: &mut Client, uri: &str, line: usize) -> [Value; 2] {
    let hover = json!({ "textDocument": { "uri": uri }, "position": { "line": line, "character": 1 } });
    let range = json!({ "start": { "line": line - 5, "character": 0 }, "end": { "line": line + 5, "character": 0 } });
    let tokens = json!({ "textDocument": { "uri": uri }, "range": range });
    [
        client.request("textDocument/semanticTokens/range", tokens)["result"].clone(),
        client.request("textDocument/hover", hover)["result"].clone(),
    ]
}

#[test]
fn right_after_an_edit_hover_and_colours_are_those_of_the_new_text() {
    let mut text = program("O1\n");
    let uri = "untitled:/long.nc";
    let mut client = Client::start(&json!({}));
    client.open(uri, &text);
    client.diagnostics(uri, 1);
    let mut version = 1;
    for (line, new) in [
        (15_000, "G1 X77.5 Y1. Z61. A21. C3. F2000. (new)"),
        (15_002, "S500\nG1 X1.\nG0 Z99."),
        (14_990, ""),
        (300, "G0 C90."),
    ] {
        let place = line_of(&text, line);
        version += 1;
        client.edit(uri, version, &text, place.clone(), new);
        text.replace_range(place, new);
        let near = answers(&mut client, uri, line + 1);
        client.diagnostics(uri, version);
        let whole = answers(&mut client, uri, line + 1);
        assert_eq!(near, whole, "{line} {new:?}");
        assert!(
            near[1]["contents"]["value"]
                .as_str()
                .is_some_and(|text| text.contains("**Active:**"))
        );
    }
    client.finish();
}

#[test]
fn random_edits_of_a_long_text_leave_the_findings_of_a_cold_run() {
    const SCRAPS: [&str; 12] = [
        "",
        "",
        "\n",
        "X2.5 ",
        "G1",
        "( ",
        ")",
        "C-400.",
        "M98 P7\n",
        "GOTO 100\n",
        "(trunnion: allow feed-drop because I say so)\n",
        "; \u{e4}\u{1f527}\n",
    ];
    // each comparison takes as long as hundreds of those of lsp_edits
    let asked = std::env::var("TRUNNION_EDITS").ok().and_then(|n| n.parse().ok());
    let edits: usize = asked.map_or(60, |asked: usize| (asked / 20).max(60));
    let original = program("O1\nG91 G28 Z0.\nG90\n(\u{e4}\u{1f527})\n");
    let uri = "untitled:/long.nc";
    let mut client = Client::start(&json!({}));
    let mut random = Random(20_261_126);
    let mut text = original.clone();
    client.open(uri, &text);
    let mut version = 1;
    for edit in 1..=edits {
        let near = text.len() / 2;
        let mut start = match random.below(4) {
            0 => random.below(text.len()),
            1 => random.below(2000),
            _ => near + random.below(3000),
        };
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        let mut end = (start + random.below(60)).min(text.len());
        while !text.is_char_boundary(end) {
            end += 1;
        }
        let new = SCRAPS[random.below(SCRAPS.len())];
        version += 1;
        client.edit(uri, version, &text, start..end, new);
        text.replace_range(start..end, new);
        let at = position(&text, start);
        let hover = json!({ "textDocument": { "uri": uri }, "position": at });
        let asked = client.send_request("textDocument/hover", hover);
        if random.below(2) == 0 {
            client.notify("$/cancelRequest", json!({ "id": asked }));
        }
        client.answer(asked);
        if edit % 20 == 0 || edit == edits {
            let found = client.diagnostics(uri, version);
            let mut cold = Client::start(&json!({}));
            cold.open(uri, &text);
            assert_eq!(found, cold.diagnostics(uri, 1), "after {edit} edits");
            cold.finish();
            version += 1;
            client.change_all(uri, version, &original);
            text.clone_from(&original);
        }
    }
    client.finish();
}

/// The colours of a text of 5 MB would take 200 MB: the server sends those of the lines that are shown, and none for the whole text.
#[test]
fn a_text_of_megabytes_is_coloured_where_it_is_shown() {
    let line = "G1 X1.5 Y2.5 Z3.5 F2000.\n";
    let text = line.repeat((5 << 20) / line.len());
    let uri = "untitled:/long.nc";
    let mut client = Client::start(&json!({}));
    client.open(uri, &text);
    let document = json!({ "uri": uri });
    let whole = client.request("textDocument/semanticTokens/full", json!({ "textDocument": document }));
    assert_eq!(whole.get("result"), Some(&Value::Null), "no error, no colours");
    let delta = json!({ "textDocument": document, "previousResultId": "0" });
    let whole = client.request("textDocument/semanticTokens/full/delta", delta);
    assert_eq!(whole.get("result"), Some(&Value::Null));
    let [shown, _] = answers(&mut client, uri, 100_000);
    let numbers = shown["data"].as_array().expect("colours").len();
    assert_eq!(numbers, 11 * 9 * 5, "eleven lines of nine pieces of five numbers");
    client.finish();
}

/// As `fmt` does: the message names the command and the options that lay the program out.
#[test]
fn more_lines_than_fmt_reads_are_not_laid_out() {
    let uri = "untitled:/long.nc";
    let mut client = Client::start(&json!({}));
    client.open(uri, &format!("G21 G90\n{}M30\n", "\n".repeat(300_000)));
    let ask = json!({ "textDocument": { "uri": uri }, "options": { "tabSize": 4, "insertSpaces": true } });
    let answer = client.request("textDocument/formatting", ask);
    let said = answer["error"]["message"].as_str().expect("an error");
    assert!(
        said.contains("300002 lines") && said.contains("trunnion fmt --max-lines 300003"),
        "{said}"
    );
    client.finish();
}
