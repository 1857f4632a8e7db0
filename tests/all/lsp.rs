//! The language server over the wire: a real process, real frames, edits, requests and cancels interleaved.
use crate::lsp_client::{self, Client, position};
use serde_json::{Value, json};

const STRATEGY_2: &str = "\
; guide vane, tilted by 5 deg about X
G17 G90 G71 G94 G54
T1 M6
S12000 M3
TRAORI
G0 X-28.38 Y-2.5 Z80 A2.042 C3.358
G1 Z60 F2000
N2910 G1 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358
N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822
N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086
N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
TRAFOOF
M5
M30
";
const URI: &str = "untitled:/strategy-2.mpf";

fn with_rule<'a>(diagnostics: &'a [Value], rule: &str) -> Vec<&'a Value> {
    diagnostics.iter().filter(|d| d["code"] == rule).collect()
}

#[test]
fn a_pole_flip_is_underlined_where_c_is_written() {
    let mut client = Client::start(&json!({ "machine": "mikron-ucp710" }));
    client.open(URI, STRATEGY_2);
    let diagnostics = client.diagnostics(URI, 1);
    let flips = with_rule(&diagnostics, "pole-flip");
    let words: Vec<&str> = flips
        .iter()
        .map(|d| lsp_client::text_of(STRATEGY_2, &d["range"]))
        .collect();
    assert_eq!(words, ["C52.595", "C-3.086"]);
    assert!(
        flips[0]["message"].as_str().expect("there").contains("47.773"),
        "{}",
        flips[0]["message"]
    );
    client.finish();
}

#[test]
fn an_edit_is_judged_with_its_version() {
    let mut client = Client::start(&json!({ "machine": "mikron-ucp710" }));
    client.open(URI, STRATEGY_2);
    client.diagnostics(URI, 1);
    let start = STRATEGY_2.find("C52.595").expect("there");
    client.edit(URI, 2, STRATEGY_2, start..start + "C52.595".len(), "C4.9");
    let diagnostics = client.diagnostics(URI, 2);
    let changed = STRATEGY_2.replace("C52.595", "C4.9");
    let words: Vec<&str> = with_rule(&diagnostics, "pole-flip")
        .iter()
        .map(|d| lsp_client::text_of(&changed, &d["range"]))
        .collect();
    assert_eq!(words, Vec::<&str>::new(), "8 degrees are no flip");
    client.notify("textDocument/didClose", json!({ "textDocument": { "uri": URI } }));
    assert_eq!(client.any_diagnostics(URI), Vec::<Value>::new(), "closing clears");
    client.finish();
}

#[test]
fn hover_tells_joints_posture_and_reachable_feed() {
    let mut client = Client::start(&json!({ "machine": "mikron-ucp710" }));
    client.open(URI, STRATEGY_2);
    let at = position(STRATEGY_2, STRATEGY_2.find("C52.595").expect("there"));
    let hover = client.request(
        "textDocument/hover",
        json!({ "textDocument": { "uri": URI }, "position": at }),
    );
    let text = hover["result"]["contents"]["value"].as_str().expect("there").to_owned();
    for part in [
        "mikron-ucp710",
        "52.5950 deg",
        "highest possible feed 46 mm/min, limited by C",
        "posture \u{2212}",
        "2000.0 mm/min",
        "**pole-flip**",
        "trunnion explain pole-flip",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    let at = position(STRATEGY_2, STRATEGY_2.find("TRAORI").expect("there"));
    let hover = client.request(
        "textDocument/hover",
        json!({ "textDocument": { "uri": URI }, "position": at }),
    );
    let text = hover["result"]["contents"]["value"].as_str().expect("there");
    assert!(text.contains("TRAORI") && text.contains("TCP on"), "{text}");
    client.finish();
}

#[test]
fn a_quick_fix_is_offered_when_proved_and_refused_with_its_reason() {
    let mut client = Client::start(&json!({ "machine": "mikron-ucp710" }));
    client.open(URI, STRATEGY_2);
    let diagnostics = client.diagnostics(URI, 1);
    let flip = with_rule(&diagnostics, "pole-flip")[0].clone();
    let ask = |uri: &str| json!({ "textDocument": { "uri": uri }, "range": flip["range"], "context": { "diagnostics": [flip] } });
    let answer = client.request("textDocument/codeAction", ask(URI));
    let refused = answer["result"]
        .as_array()
        .expect("there")
        .iter()
        .find(|a| a["title"].to_string().contains("smooth-pole"));
    let reason = refused.expect("listed")["disabled"]["reason"]
        .as_str()
        .expect("refused: no tool shape is declared");
    assert!(reason.contains("tool"), "{reason}");

    let declared = STRATEGY_2.replace(
        "guide vane, tilted by 5 deg about X",
        "trunnion: tool 1 ball diameter 10     ",
    );
    let uri = "untitled:/declared.mpf";
    client.open(uri, &declared);
    client.diagnostics(uri, 1);
    let answer = client.request("textDocument/codeAction", ask(uri));
    let fix = answer["result"]
        .as_array()
        .expect("there")
        .iter()
        .find(|a| a["title"].to_string().contains("smooth-pole"));
    let edits = fix.expect("offered")["edit"]["changes"][uri]
        .as_array()
        .expect("edits")
        .clone();
    let fixed = lsp_client::apply(&declared, &edits);
    client.change_all(uri, 2, &fixed);
    let after = client.diagnostics(uri, 2);
    assert_eq!(with_rule(&after, "pole-flip").len(), 0, "{fixed}");
    client.finish();
}

#[test]
fn utf16_and_utf8_clients_see_the_same_place() {
    let text = "(\u{1f527}\u{e4}) G1 X1 F100 G999\nM30\n";
    for (encodings, character) in [(json!(["utf-16"]), 17), (json!(["utf-8", "utf-16"]), 20)] {
        let mut client = Client::start_with(&json!({ "dialect": "linuxcnc" }), &encodings);
        client.open("untitled:/a.ngc", text);
        let diagnostics = client.diagnostics("untitled:/a.ngc", 1);
        let unknown = with_rule(&diagnostics, "unknown-code");
        assert_eq!(
            unknown[0]["range"]["start"],
            json!({ "line": 0, "character": character })
        );
        client.finish();
    }
}

#[test]
fn settings_that_cannot_be_used_are_said_and_can_be_mended() {
    let mut client = Client::start(&json!({ "machine": "no-such-machine" }));
    client.open(URI, STRATEGY_2);
    let diagnostics = client.diagnostics(URI, 1);
    assert_eq!(diagnostics.len(), 1);
    assert!(
        diagnostics[0]["message"]
            .as_str()
            .expect("there")
            .contains("mikron-ucp710"),
        "names what there is"
    );
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": { "trunnion": { "machine": "mikron-ucp710" } } }),
    );
    let diagnostics = client.diagnostics(URI, 1);
    assert_eq!(with_rule(&diagnostics, "pole-flip").len(), 2);
    let status = client.last_status.clone().expect("a status was sent");
    assert_eq!(
        (status["machine"].as_str(), status["verdict"].as_str()),
        (Some("mikron-ucp710"), Some("fail"))
    );
    client.finish();
}

/// Random edits, requests and cancels; afterwards the server must judge the same text as a fresh document, and every
/// request must have been answered.
#[test]
fn edits_requests_and_cancels_interleaved_leave_the_right_text() {
    let mut client = Client::start(&json!({ "machine": "mikron-ucp710" }));
    let mut text = STRATEGY_2.to_owned();
    client.open(URI, &text);
    let mut seed = 20_261_121_u64;
    let mut random = move |n: usize| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % n.max(1)
    };
    let mut open_requests = Vec::new();
    let mut version = 1;
    for _ in 0..400 {
        let start = random(text.len() + 1);
        let end = (start + random(6)).min(text.len());
        let new = ["", "1", "X2.5 ", "\n", "G1", "( ", ")", "C-400", "; \u{e4}\u{1f527}\n"][random(9)];
        if !text.is_char_boundary(start) || !text.is_char_boundary(end) {
            continue;
        }
        version += 1;
        client.edit(URI, version, &text, start..end, new);
        text.replace_range(start..end, new);
        if random(3) == 0 {
            let at = position(&text, random(text.len()));
            let id = client.send_request(
                "textDocument/hover",
                json!({ "textDocument": { "uri": URI }, "position": at }),
            );
            open_requests.push(id);
            if random(2) == 0 {
                client.notify("$/cancelRequest", json!({ "id": id }));
            }
        }
    }
    let storm = client.diagnostics(URI, version);
    for id in open_requests {
        let answer = client.answer(id);
        let code = answer["error"]["code"].as_i64();
        assert!(matches!(code, None | Some(-32800 | -32801)), "{answer}");
    }
    let fresh_uri = "untitled:/fresh.mpf";
    client.open(fresh_uri, &text);
    let fresh = client.diagnostics(fresh_uri, 1);
    // notes name the document that they are in
    let plain = |found: &dyn std::fmt::Debug| format!("{found:?}").replace(fresh_uri, URI);
    assert_eq!(plain(&storm), plain(&fresh), "{text}");
    client.finish();
}

#[test]
fn exit_without_shutdown_is_an_error() {
    let mut client = Client::start(&json!({}));
    client.notify("exit", Value::Null);
    assert_eq!(client.wait(), Some(1));
}

const LOOP: &str = "\
g21 g90 g17 g94 g54 f500
o100 sub
  #2 = [#1 * 10]
  g1 x#2
o100 endsub
#<n> = 1
o101 while [#<n> le 3]
  o100 call [#<n>]
  #<n> = [#<n> + 1]
o101 endwhile
g0 x0
m2
";

fn hover(client: &mut Client, uri: &str, text: &str, at: usize) -> Option<String> {
    let params = json!({ "textDocument": { "uri": uri }, "position": position(text, at) });
    let answer = client.request("textDocument/hover", params);
    answer["result"]["contents"]["value"].as_str().map(str::to_owned)
}

#[test]
fn hover_inside_loops_and_subprograms_tells_of_the_first_time() {
    let mut client = Client::start(&json!({ "machine": "mill-3axis" }));
    let uri = "untitled:/loop.ngc";
    client.open(uri, LOOP);
    client.diagnostics(uri, 1);
    let mut at = |what: &str| hover(&mut client, uri, LOOP, LOOP.find(what).expect("there")).expect("an answer");
    // 1 * 10 in the first of three turns
    let text = at("g1 x#2");
    assert!(text.contains("10.0000 mm") && !text.contains("does not run"), "{text}");
    assert!(text.contains("500.0 mm/min"), "{text}");
    for (what, told) in [
        ("#1 * 10", "**#1** = 1 before this block"),
        ("#2 =", "**#2** = 0 before this block, = 10 after it"),
        ("o101 while", "**o101**\n* line 7: while\n* line 10: endwhile"),
        (
            "o100 call",
            "**o100** subprogram, starts on line 2\n* line 2: sub\n* line 5: endsub\n* line 8: call",
        ),
        ("o100 sub", "**o100** subprogram, starts on line 2"),
        ("#<n> = [#<n> + 1]", "**#<n>** = 1 before this block, = 2 after it"),
        ("o101 endwhile", "* line 10: endwhile"),
        ("g0 x0", "Rapid"),
    ] {
        let text = at(what);
        assert!(text.contains(told), "{what}: {text}");
        assert!(
            text.contains("**Active:**") && !text.contains("does not run"),
            "{what}: {text}"
        );
    }
    client.finish();
}

#[test]
fn several_mistakes_of_a_linuxcnc_program_are_told_once_each() {
    let program =
        "g21 g90 g17 g94\ng1 x10\no<nosuch> call [1]\n#<a> = [1 + ]\ng0 x[acos[2]]\ng0 y#<undef>\no1 if [1]\nm2\n";
    let mut client = Client::start(&json!({}));
    let uri = "untitled:/wrong.ngc";
    client.open(uri, program);
    let diagnostics = client.diagnostics(uri, 1);
    let errors = diagnostics.iter().filter(|d| d["severity"] == 1);
    let found: Vec<(u64, &str)> = errors
        .map(|d| {
            (
                d["range"]["start"]["line"].as_u64().expect("a line"),
                d["code"].as_str().expect("a rule"),
            )
        })
        .collect();
    assert_eq!(
        found,
        [
            (1, "missing-feed"),
            (2, "missing-subprogram"),
            (3, "syntax-error"),
            (4, "bad-expression"),
            (5, "undefined-variable"),
        ]
    );
    client.finish();
}

#[test]
fn a_finding_of_a_loop_says_how_often_and_an_endless_one_how_long() {
    let program = "g21 g90 g17 g94\n#1 = 0\no1 while [#1 lt 4]\n  g1 x#1\n  #1 = [#1 + 1]\no1 endwhile\n#2 = 0\no2 while [1]\n  #2 = [#2 + 1]\no2 endwhile\nm2\n";
    let mut client = Client::start(&json!({}));
    let uri = "untitled:/again.ngc";
    client.open(uri, program);
    let diagnostics = client.diagnostics(uri, 1);
    let message = |rule: &str| {
        let found = with_rule(&diagnostics, rule);
        assert_eq!(found.len(), 1, "{rule}: {diagnostics:?}");
        found[0]["message"].as_str().expect("there").to_owned()
    };
    assert!(
        message("missing-feed").contains("(4 times)"),
        "{}",
        message("missing-feed")
    );
    // the server gives up sooner than the command line
    assert!(
        message("endless-loop").contains("within 150000 executed blocks"),
        "{}",
        message("endless-loop")
    );
    client.finish();
}

/// A letter O for a zero and a misspelt name: the editor offers the word that was meant, for the finding at its place.
#[test]
fn the_word_that_was_meant_is_offered() {
    let mut client = Client::start(&json!({}));
    for (uri, text, wrong, meant) in [
        ("untitled:/o.ngc", "G21 G0 X5O. Y0\nM2\n", "X5O.", "X50."),
        ("untitled:/go.nc", "GO X0 Y0\nM30\n", "GO", "G0"),
        (
            "untitled:/name.mpf",
            "G71 G17\nTRAORY\nG0 X1\nTRAFOOF\nM30\n",
            "TRAORY",
            "TRAORI",
        ),
    ] {
        client.open(uri, text);
        let diagnostics = client.diagnostics(uri, 1);
        let own = diagnostics
            .iter()
            .find(|d| lsp_client::text_of(text, &d["range"]) == wrong);
        let own = own.unwrap_or_else(|| panic!("{wrong}: {diagnostics:?}"));
        let ask = json!({ "textDocument": { "uri": uri }, "range": own["range"], "context": { "diagnostics": [own] } });
        let answer = client.request("textDocument/codeAction", ask);
        let actions = answer["result"].as_array().expect("a list");
        let title = format!("write {meant}");
        let action = actions.iter().find(|action| action["title"] == title.as_str());
        let action = action.unwrap_or_else(|| panic!("{wrong}: {actions:?}"));
        let edit = &action["edit"]["changes"][uri][0];
        assert_eq!((&edit["newText"], &edit["range"]), (&json!(meant), &own["range"]));
        assert_eq!(action["diagnostics"][0]["range"], own["range"]);
    }
    client.finish();
}
