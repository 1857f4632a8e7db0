//! Navigation in the language server over the wire: outline, definition, references, rename, calls, for programs of several controls.
use crate::lsp_client::{Client, apply, position, text_of};
use serde_json::{Value, json};

pub(crate) const MACRO: &str = "%\nO1000 (PLATE)\nG21 G90 G17 G54\nT1 M6 (FACE MILL)\n#100=5.\nWHILE[#100GT0]DO1\nG1 X[#100*2] F200.\n#100=#100-1\nEND1\nIF[#100EQ0]GOTO20\nG1 X99.\nN20 G0 Z50.\nT2 M6 (DRILL)\nG81 X10. Z-5. R2. F100.\nG80\nM98 P2000\nM30\nO2000\nG1 Z1.\nM99\n%\n";

const NGC: &str = "(trunnion: dialect linuxcnc)\no<pocket> sub\nG1 X[#<depth> * 2] F100\no<pocket> endsub\nG21 G90\n#<depth> = 3\n#<_side> = 4\no101 while [#<_side> GT 0]\n#<_side> = [#<_side> - 1]\no101 endwhile\no<pocket> call [1]\nM2\n";

const MPF: &str = "%_N_SHAFT_MPF\n; finish\nG90 G71 G54\nDEF REAL DEPTH=2\nR1=5\nT1 D1\nM6\nAGAIN:\nG1 X=R1*2 Z=-DEPTH F500\nR1=R1-1\nIF R1>0 GOTOB AGAIN\nM30\n";

const OSP: &str = "$A.MIN%\nO0001\nG15 H1\nG90 G0 X0 Y0 Z50\nS100 M3\nDEEP=5\nV1=0\nV2=3\nNLOP G1 X=V1 Z=-DEEP F100\nV1=V1+1\nIF [V1 LT V2] GOTO NLOP\nCALL OSUB\nM2\nOSUB\nG0 Z60\nRTS\n";

const KLARTEXT: &str = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S100\n2 L Z+50 R0 FMAX M3\n3 Q12 = 5\n4 FN 1: Q14 = Q12 + 1\n5 CALL LBL 7\n6 CALL LBL \"DRILL\"\n7 L M30\n8 LBL 7\n9 L X+Q12 Y+Q14 FMAX\n10 LBL 0\n11 LBL \"DRILL\"\n12 L Z+2 FMAX\n13 LBL 0\n14 END PGM A MM\n";

const APT: &str = "PARTNO TEST\nUNITS/MM\nLOADTL/1\nP1=POINT/1,2,3\nGOTO/P1\nLOADTL/2\nGOTO/1,2,3\nFINI\n";

pub(crate) fn document(uri: &str) -> Value {
    json!({ "uri": uri })
}

pub(crate) fn at(uri: &str, text: &str, needle: &str, plus: usize) -> Value {
    let byte = text.find(needle).expect("the text has it") + plus;
    json!({ "textDocument": document(uri), "position": position(text, byte) })
}

pub(crate) fn opened(uri: &str, text: &str) -> Client {
    let mut client = Client::start(&json!({}));
    client.open(uri, text);
    client
}

pub(crate) fn list(answer: &Value) -> Vec<Value> {
    answer["result"]
        .as_array()
        .unwrap_or_else(|| panic!("a list: {answer}"))
        .clone()
}

/// Names of the outline, children after their parents, with the depth in front.
fn tree(nodes: &[Value], depth: usize, found: &mut Vec<String>) {
    for node in nodes {
        let detail = node["detail"]
            .as_str()
            .map(|detail| format!(" {detail}"))
            .unwrap_or_default();
        found.push(format!(
            "{}{}{detail}",
            "  ".repeat(depth),
            node["name"].as_str().expect("a name")
        ));
        tree(node["children"].as_array().map_or(&[], Vec::as_slice), depth + 1, found);
    }
}

#[test]
fn the_outline_has_programs_tools_and_labels() {
    let mut found = Vec::new();
    for (uri, text) in [
        ("untitled:/a.nc", MACRO),
        ("untitled:/a.ngc", NGC),
        ("untitled:/a.mpf", MPF),
        ("untitled:/a.apt", APT),
    ] {
        let mut client = opened(uri, text);
        let answer = client.request("textDocument/documentSymbol", json!({ "textDocument": document(uri) }));
        found.push(uri.to_owned());
        tree(&list(&answer), 1, &mut found);
        client.finish();
    }
    insta::assert_snapshot!(found.join("\n"));
}

#[test]
fn definition_and_references_follow_every_kind_of_name() {
    for (uri, text, needle, plus, defined, places) in [
        ("untitled:/a.nc", MACRO, "GOTO20", 5, "20", 2),
        ("untitled:/a.nc", MACRO, "P2000", 3, "2000", 2),
        ("untitled:/a.nc", MACRO, "X[#100", 4, "100", 6),
        ("untitled:/a.ngc", NGC, "o<pocket> call", 3, "pocket", 3),
        ("untitled:/a.ngc", NGC, "o101 endwhile", 2, "101", 2),
        ("untitled:/a.ngc", NGC, "[#<_side> - 1]", 4, "_side", 4),
        ("untitled:/a.mpf", MPF, "GOTOB AGAIN", 7, "AGAIN", 2),
        ("untitled:/a.mpf", MPF, "=-DEPTH", 3, "DEPTH", 2),
        ("untitled:/a.mpf", MPF, "X=R1*2", 3, "1", 5),
        ("untitled:/a.apt", APT, "GOTO/P1", 6, "P1", 2),
        ("untitled:/a.min", OSP, "GOTO NLOP", 7, "LOP", 2),
        ("untitled:/a.min", OSP, "CALL OSUB", 7, "SUB", 2),
        ("untitled:/a.min", OSP, "Z=-DEEP", 4, "DEEP", 2),
        ("untitled:/a.min", OSP, "X=V1", 3, "V1", 5),
        ("untitled:/a.h", KLARTEXT, "CALL LBL 7", 9, "7", 2),
        ("untitled:/a.h", KLARTEXT, "CALL LBL \"DRILL\"", 12, "DRILL", 2),
        ("untitled:/a.h", KLARTEXT, "X+Q12", 4, "Q12", 3),
    ] {
        let mut client = opened(uri, text);
        let answer = client.request("textDocument/definition", at(uri, text, needle, plus));
        let found = list(&answer);
        assert_eq!(found.len(), 1, "{needle}: {answer}");
        assert_eq!(text_of(text, &found[0]["range"]), defined, "{needle}");
        let mut asked = at(uri, text, needle, plus);
        asked["context"] = json!({ "includeDeclaration": true });
        let answer = client.request("textDocument/references", asked);
        assert_eq!(list(&answer).len(), places, "{needle}: {answer}");
        let answer = client.request("textDocument/documentHighlight", at(uri, text, needle, plus));
        assert_eq!(list(&answer).len(), places, "{needle}: {answer}");
        client.finish();
    }
}

#[test]
fn a_rename_changes_every_place() {
    for (uri, text, needle, plus, new, changed) in [
        (
            "untitled:/a.nc",
            MACRO,
            "GOTO20",
            5,
            "30",
            [("GOTO20", "GOTO30"), ("N20", "N30")].as_slice(),
        ),
        ("untitled:/a.nc", MACRO, "#100=5", 2, "101", &[("#100", "#101")]),
        ("untitled:/a.nc", MACRO, "P2000", 3, "2001", &[("2000", "2001")]),
        (
            "untitled:/a.ngc",
            NGC,
            "#<_side> = 4",
            4,
            "_width",
            &[("_side", "_width")],
        ),
        (
            "untitled:/a.ngc",
            NGC,
            "o<pocket> call",
            3,
            "groove",
            &[("pocket", "groove")],
        ),
        ("untitled:/a.mpf", MPF, "AGAIN:", 1, "MORE", &[("AGAIN", "MORE")]),
        ("untitled:/a.mpf", MPF, "=-DEPTH", 3, "LEVEL", &[("DEPTH", "LEVEL")]),
        ("untitled:/a.min", OSP, "GOTO NLOP", 7, "NEXT", &[("NLOP", "NNEXT")]),
        ("untitled:/a.min", OSP, "CALL OSUB", 7, "PART", &[("OSUB", "OPART")]),
        ("untitled:/a.min", OSP, "V1=V1+1", 1, "V7", &[("V1", "V7")]),
        ("untitled:/a.min", OSP, "Z=-DEEP", 4, "TIEF", &[("DEEP", "TIEF")]),
        ("untitled:/a.h", KLARTEXT, "CALL LBL 7", 9, "8", &[("LBL 7", "LBL 8")]),
        (
            "untitled:/a.h",
            KLARTEXT,
            "LBL \"DRILL\"",
            6,
            "BORE",
            &[("DRILL", "BORE")],
        ),
        ("untitled:/a.h", KLARTEXT, "X+Q12", 4, "Q13", &[("Q12", "Q13")]),
    ] {
        let mut client = opened(uri, text);
        let answer = client.request("textDocument/prepareRename", at(uri, text, needle, plus));
        assert!(answer["result"]["placeholder"].is_string(), "{needle}: {answer}");
        let mut asked = at(uri, text, needle, plus);
        asked["newName"] = json!(new);
        let answer = client.request("textDocument/rename", asked);
        let edits = answer["result"]["changes"][uri]
            .as_array()
            .unwrap_or_else(|| panic!("{needle}: {answer}"));
        let wanted = changed
            .iter()
            .fold(text.to_owned(), |text, (from, to)| text.replace(from, to));
        assert_eq!(apply(text, edits), wanted, "{needle}");
        client.finish();
    }
}

/// Each place takes 2 kB of a message: half a million took 1.8 GB.
#[test]
fn references_of_too_many_places_are_refused() {
    let of = |count: usize| format!("O1\nIF[#1EQ1]GOTO20\n{}N20 M30\n", "GOTO20\n".repeat(count - 2));
    for (count, refused) in [(50_000, false), (50_001, true)] {
        let (uri, text) = ("untitled:/a.nc", of(count));
        let mut client = Client::start(&json!({ "dialect": "fanuc-30i" }));
        client.open(uri, &text);
        let at = json!({ "textDocument": { "uri": uri }, "position": position(&text, text.find("GOTO20").expect("a jump") + 5) });
        let mut asked = at.clone();
        asked["context"] = json!({ "includeDeclaration": true });
        let listed = client.request("textDocument/references", asked);
        let highlighted = client.request("textDocument/documentHighlight", at.clone());
        let mut renamed = at;
        renamed["newName"] = json!("30");
        let renamed = client.request("textDocument/rename", renamed);
        if refused {
            for (answer, what) in [(&listed, "not listed"), (&renamed, "not renamed")] {
                let why = answer["error"]["message"].as_str().expect("a refusal");
                assert!(
                    why.starts_with(what) && why.contains("more than 50000 places name `20`"),
                    "{why}"
                );
            }
            assert_eq!(list(&highlighted).len(), 0);
        } else {
            assert_eq!((list(&listed).len(), list(&highlighted).len()), (count, count));
            let edits = renamed["result"]["changes"][uri].as_array().expect("edits");
            assert_eq!(edits.len(), count);
        }
        client.finish();
    }
}

#[test]
fn a_rename_is_refused_where_it_is_not_certain() {
    for (uri, text, needle, plus, new, why) in [
        ("untitled:/a.nc", MACRO, "#100=5", 2, "5", "another kind"),
        ("untitled:/a.nc", MACRO, "#100=5", 2, "depth", "whole number"),
        ("untitled:/a.ngc", NGC, "#<depth> = 3", 3, "_depth", "global"),
        ("untitled:/a.mpf", MPF, "AGAIN:", 1, "TRAORI", "word of the control"),
        ("untitled:/a.min", OSP, "GOTO NLOP", 7, "LONGER", "at most 4"),
        ("untitled:/a.min", OSP, "V1=V1+1", 1, "V2", "in use"),
        ("untitled:/a.h", KLARTEXT, "X+Q12", 4, "Q200", "read differently"),
        ("untitled:/a.h", KLARTEXT, "X+Q12", 4, "QL12", "read differently"),
        ("untitled:/a.h", KLARTEXT, "CALL LBL 7", 9, "NAME", "whole number"),
        (
            "untitled:/b.nc",
            "O1\n#100=1\n#101=2\nG1 X#100\n#[#101]=3\nM30\n",
            "#100=1",
            2,
            "102",
            "not certain",
        ),
        (
            "untitled:/b.nc",
            "O1\n#100=1\n#101=2\nG1 X#100\nM30\n",
            "#100=1",
            2,
            "101",
            "in use",
        ),
    ] {
        let mut client = opened(uri, text);
        let mut asked = at(uri, text, needle, plus);
        asked["newName"] = json!(new);
        let answer = client.request("textDocument/rename", asked);
        let message = answer["error"]["message"]
            .as_str()
            .unwrap_or_else(|| panic!("{needle} to {new}: {answer}"));
        assert!(message.contains(why), "{message}");
        client.finish();
    }
}

#[test]
fn names_reach_across_the_files_of_a_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let main = "O1\nG21 G90\n#500=3.\nM98 P2000\nM30\n";
    let sub = "O2000\nG1 X#500 F100.\nM99\n";
    for (name, text) in [("main.nc", main), ("sub.nc", sub)] {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    let (own, other) = (uri("main.nc"), uri("sub.nc"));
    let mut client = opened(&own, main);
    let answer = client.request("textDocument/definition", at(&own, main, "P2000", 3));
    assert_eq!(list(&answer)[0]["uri"], other, "{answer}");
    let mut asked = at(&own, main, "#500", 2);
    asked["newName"] = json!("501");
    let answer = client.request("textDocument/rename", asked);
    // the value reaches the program that is called, and two files are not proved together
    let refusal = answer["error"]["message"].as_str().expect("a refusal");
    assert!(refusal.contains("would not do the same"), "{refusal}");
    assert!(refusal.contains("are not proved together"), "{refusal}");
    let answer = client.request("textDocument/documentLink", json!({ "textDocument": document(&own) }));
    assert_eq!(
        list(&answer).len(),
        0,
        "a program that has a number is found by it: {answer}"
    );
    let prepared = client.request("textDocument/prepareCallHierarchy", at(&own, main, "P2000", 3));
    let item = list(&prepared)[0].clone();
    assert_eq!(item["uri"], other, "{prepared}");
    let callers = list(&client.request("callHierarchy/incomingCalls", json!({ "item": item })));
    assert_eq!(
        (&callers[0]["from"]["name"], &callers[0]["from"]["uri"]),
        (&json!("1"), &json!(own)),
        "{callers:?}"
    );
    let calls = list(&client.request("callHierarchy/outgoingCalls", json!({ "item": callers[0]["from"] })));
    assert_eq!(calls[0]["to"]["name"], "2000", "{calls:?}");
    client.finish();
}

#[test]
fn a_call_of_another_file_is_a_link() {
    let folder = tempfile::tempdir().expect("a folder");
    let main = "G90\nG1 X1 F100\nPOCKET_A\nM30\n";
    std::fs::write(folder.path().join("main.mpf"), main).expect("written");
    std::fs::write(folder.path().join("POCKET_A.SPF"), "G1 X2\nM17\n").expect("written");
    let own = format!("file://{}", folder.path().join("main.mpf").display());
    let mut client = opened(&own, main);
    let links = list(&client.request("textDocument/documentLink", json!({ "textDocument": document(&own) })));
    assert_eq!(text_of(main, &links[0]["range"]), "POCKET_A", "{links:?}");
    assert!(
        links[0]["target"]
            .as_str()
            .is_some_and(|target| target.ends_with("POCKET_A.SPF")),
        "{links:?}"
    );
    client.finish();
}
