//! The language server under many edits and on large nests: its findings are those of another server that is shown
//! the same text, and its memory stays within bounds. `TRUNNION_EDITS=10000` is the long form.
use crate::lsp_client::{Client, position};
use crate::random::Random;
use serde_json::json;

/// Edits of all programs together.
fn edits() -> usize {
    let asked = std::env::var("TRUNNION_EDITS").ok();
    asked.and_then(|n| n.parse().ok()).unwrap_or(300)
}

/// So many edits lie between two comparisons.
const BETWEEN: usize = 25;

/// Programs with loops, calls, compensation and five axes: what one line says may count to the end.
const PROGRAMS: [(&str, &str); 4] = [
    (
        "a.ngc",
        "(trunnion: dialect linuxcnc)\n(trunnion: machine mikron-ucp710)\no100 sub\nG1 X[#1 * 2] F100\no100 endsub\nG21 G90 G54\nT1 M6\nG43 H1\n#1 = 3\no101 while [#1 GT 0]\no100 call [#1]\nG1 Y#1 C[#1 * 40]\n#1 = [#1 - 1]\no101 endwhile\nG41.1 D4\nG1 X20\nG1 Y30\nG40\nG2 X10 Y30 I-5 J0\nM2\n",
    ),
    (
        "b.nc",
        "(trunnion: dialect fanuc-30i)\n(trunnion: machine mikron-ucp710)\nO1\nG21 G90 G17 G54\nT1 M6\nS1000 M3\nG43 H1 Z50.\n#1=0\nWHILE[#1LT3]DO1\nG1 X#1 A[#1*20.] F200.\n#1=#1+1\nEND1\nG81 Z-5. R2. F100.\nX10.\nX20.\nG80\nIF[#1EQ3]GOTO20\nG1 X99.\nN20 G43.4 H1\nG1 X1. A30. C200.\nM98 P2\nM30\nO2\nG1 Z1.\nM99\n",
    ),
    (
        "c.mpf",
        "; trunnion: dialect sinumerik-840d\n; trunnion: machine mikron-ucp710\nG90 G71 G54\nDEF REAL A=2\nR1=5\nT1 D1\nM6\nG0 X0 Y0 Z0\nTRAORI\nG1 X=R1*2 C=A*100 F500\nTRANS X10\nG1 X20 A20\nTRANS\nMCALL CYCLE81(10,0,2,-5)\nX10 Y10\nMCALL\nTRAFOOF\nM30\n",
    ),
    (
        "d.apt",
        "$$ trunnion: dialect apt\nPARTNO TEST\nMULTAX/ON\nUNITS/MM\nFEDRAT/100,MMPM\nSPINDL/1000,RPM,CLW\nLOADTL/1\nFROM/0,0,50,0,0,1\nGOTO/0,0,0,0,0,1\nGOTO/10,0,0,0.1,0,0.995\nCYCLE/DRILL,RAPTO,2,FEDTO,-5\nGOTO/20,0,0,0,0,1\nCYCLE/OFF\nFINI\n",
    ),
];

const SCRAPS: [&str; 22] = [
    "",
    "",
    "",
    "1",
    "-",
    ".",
    "X2.5 ",
    "\n",
    "G1",
    "( ",
    ")",
    "C-400",
    "G90 ",
    "M30\n",
    "[",
    "]",
    "#1=4\n",
    "o101 ",
    "END1\n",
    "GOTO20\n",
    "; \u{e4}\u{1f527}\n",
    "/",
];

#[test]
fn random_edits_leave_the_findings_of_a_cold_run() {
    let all = edits() / PROGRAMS.len();
    for (number, (name, program)) in PROGRAMS.iter().enumerate() {
        let mut client = Client::start(&json!({}));
        let mut random = Random(20_261_123 + number as u64);
        let uri = format!("untitled:/{name}");
        let mut text = (*program).to_owned();
        client.open(&uri, &text);
        let mut version = 1;
        for edit in 1..=all {
            // a text that was edited to pieces says little
            if edit % 200 == 0 {
                version += 1;
                client.change_all(&uri, version, program);
                text = (*program).to_owned();
            }
            let mut start = random.below(text.len() + 1);
            while !text.is_char_boundary(start) {
                start -= 1;
            }
            let mut end = (start + random.below(6)).min(text.len());
            while !text.is_char_boundary(end) {
                end += 1;
            }
            let new = SCRAPS[random.below(SCRAPS.len())];
            version += 1;
            client.edit(&uri, version, &text, start..end, new);
            text.replace_range(start..end, new);
            if edit % BETWEEN == 0 || edit == all {
                let found = client.diagnostics(&uri, version);
                // another server, so that nothing is left of what was there before
                let mut cold = Client::start(&json!({}));
                cold.open(&uri, &text);
                assert_eq!(found, cold.diagnostics(&uri, 1), "{name} after {edit} edits:\n{text}");
                cold.finish();
            }
        }
        client.finish();
    }
}

/// Requests about one place; what they answer does not matter here.
const ASKED: [&str; 16] = [
    "hover",
    "completion",
    "definition",
    "references",
    "documentHighlight",
    "prepareRename",
    "signatureHelp",
    "documentSymbol",
    "foldingRange",
    "codeLens",
    "semanticTokens/full",
    "documentLink",
    "inlayHint",
    "codeAction",
    "diagnostic",
    "formatting",
];

/// A request was cancelled, is about a version that is no longer there, or could not be done.
const FAILURES: [i64; 3] = [-32800, -32801, -32803];

#[test]
fn random_requests_and_cancels_between_edits_are_all_answered() {
    let all = edits() / PROGRAMS.len();
    for (number, (name, program)) in PROGRAMS.iter().enumerate() {
        let mut client = Client::start(&json!({}));
        let mut random = Random(20_261_124 + number as u64);
        let uri = format!("untitled:/{name}");
        let mut text = (*program).to_owned();
        client.open(&uri, &text);
        let (mut version, mut asked) = (1, Vec::new());
        for _ in 0..all {
            let mut at = random.below(text.len() + 1);
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            match random.below(4) {
                0 => {
                    let new = SCRAPS[random.below(SCRAPS.len())];
                    version += 1;
                    client.edit(&uri, version, &text, at..at, new);
                    text.insert_str(at, new);
                }
                kind => {
                    let place = position(&text, at);
                    let options = json!({ "tabSize": 2, "insertSpaces": true });
                    let params = json!({ "textDocument": { "uri": uri }, "position": place, "options": options,
                        "range": { "start": place, "end": place }, "context": { "includeDeclaration": true, "diagnostics": [], "triggerKind": 1, "isRetrigger": false } });
                    let method = format!("textDocument/{}", ASKED[random.below(ASKED.len())]);
                    let id = client.send_request(&method, params);
                    if kind == 1 {
                        client.notify("$/cancelRequest", json!({ "id": id }));
                    }
                    asked.push((id, method));
                }
            }
        }
        for (id, method) in asked {
            let answer = client.answer(id);
            let code = answer["error"]["code"].as_i64();
            assert!(code.is_none_or(|code| FAILURES.contains(&code)), "{method}: {answer}");
        }
        let found = client.diagnostics(&uri, version);
        let mut cold = Client::start(&json!({}));
        cold.open(&uri, &text);
        assert_eq!(found, cold.diagnostics(&uri, 1), "{name}:\n{text}");
        cold.finish();
        client.finish();
    }
}

#[cfg(target_os = "linux")]
#[test]
fn two_hundred_thousand_nested_ifs_take_less_than_500_mb() {
    const DEEP: usize = 200_000;
    let text = format!("G90\n{}{}M30\n", "IF R1==1\n".repeat(DEEP), "ENDIF\n".repeat(DEEP));
    let uri = "untitled:/deep.mpf";
    let mut client = Client::start(&json!({}));
    client.open(uri, &text);
    client.edit(uri, 2, &text, 4..4, "G71\n");
    client.diagnostics(uri, 2);
    let bytes = client.most_memory();
    assert!(bytes < 500_000_000, "{} MB", bytes / 1_000_000);
    client.finish();
}
