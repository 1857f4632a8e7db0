//! `trunnion/backplot`: the path of an open program for a viewer.
use crate::lsp_client::Client;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

fn ask(client: &mut Client, uri: &str, file: &Path, more: &Value) -> Value {
    let mut params = json!({ "textDocument": { "uri": uri }, "file": file });
    for (key, value) in more.as_object().into_iter().flatten() {
        params[key] = value.clone();
    }
    client.request("trunnion/backplot", params)
}

fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

/// The lines of the vertices, and their flags.
fn lines(bytes: &[u8]) -> Vec<(u32, u32)> {
    let count = word(bytes, 8) as usize;
    let from = 40 + count * (12 + 12 + 16);
    (0..count)
        .map(|i| (word(bytes, from + 4 * i), word(bytes, from + 4 * (count + i))))
        .collect()
}

#[test]
fn the_path_of_a_program_on_its_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("path.bin");
    let text = include_str!("../../samples/programs/guide-vane/strategy-2.mpf");
    let mut client = Client::start(&json!({ "machine": "mikron-ucp710" }));
    client.open("untitled:/strategy-2.mpf", text);
    let answer = ask(&mut client, "untitled:/strategy-2.mpf", &file, &json!({}));
    let summary = &answer["result"];
    assert_eq!(summary["machine"]["id"], "mikron-ucp710", "{answer}");
    let letters: Vec<&str> = summary["machine"]["axes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|a| a["letter"].as_str().unwrap())
        .collect();
    let bytes = std::fs::read(&file).expect("written");
    assert_eq!(&bytes[..4], b"TRSC");
    assert_eq!(u64::from(word(&bytes, 8)), summary["vertices"].as_u64().unwrap());
    assert_eq!(word(&bytes, 12) as usize, letters.len());
    assert_eq!(summary["leftOutMm"], 0.0);
    // the block of the pole flip carries its finding: a warning or an error
    let flip = text.lines().position(|line| line.contains("C52.595")).unwrap() as u32 + 1;
    let marked: Vec<u32> = lines(&bytes)
        .iter()
        .filter(|(line, _)| *line == flip)
        .map(|(_, flags)| flags >> 8 & 3)
        .collect();
    assert!(
        !marked.is_empty() && marked.iter().all(|level| *level >= 2),
        "{marked:?}"
    );
    client.finish();
}

#[test]
fn levels_of_detail_another_text_and_no_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("path.bin");
    let mut text = String::from("(trunnion: dialect linuxcnc)\nG21 G90 G17 F500 S1000 M3\nG0 X0 Y0 Z0\n");
    for i in 1..=5000 {
        let _ = writeln!(text, "G1 X{}.{:02}", i / 100, i % 100);
    }
    text.push_str("M2\n");
    let mut client = Client::start(&json!({}));
    client.open("untitled:/long.ngc", &text);
    let whole = ask(&mut client, "untitled:/long.ngc", &file, &json!({}))["result"].clone();
    assert_eq!(whole["machine"], Value::Null);
    assert_eq!(
        (whole["whole"].as_u64(), whole["vertices"].as_u64()),
        (Some(5001), Some(5001))
    );
    let few = ask(&mut client, "untitled:/long.ngc", &file, &json!({ "most": 100 }))["result"].clone();
    assert!(
        few["vertices"].as_u64().unwrap() <= 100 && few["leftOutMm"].as_f64().unwrap() > 0.0,
        "{few}"
    );
    assert_eq!(whole["inch"], false);
    // a version after a rewrite, with the settings of the document
    let other = ask(
        &mut client,
        "untitled:/long.ngc",
        &file,
        &json!({ "text": "G21 G90\nG0 X0 Y0 Z0\nG1 X7 F100\nM2\n" }),
    );
    assert_eq!(other["result"]["vertices"], 2);
    assert_eq!(other["result"]["high"][0], 7.0);
    // an edit before the answer: the path of the new text
    client.change_all(
        "untitled:/long.ngc",
        2,
        "(trunnion: dialect linuxcnc)\nG21 G90 F100\nG0 X0 Y0 Z0\nG1 X3\nM2\n",
    );
    let edited = ask(&mut client, "untitled:/long.ngc", &file, &json!({}))["result"].clone();
    assert_eq!(edited["high"][0], 3.0);
    client.finish();
}

#[test]
fn a_backplot_replaces_no_program_and_says_why_it_cannot_be_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("a.ngc");
    let text = "G21 G90 F100\nG0 X0 Y0 Z0\nG1 X3\nM2\n";
    std::fs::write(&program, text).expect("written");
    let uri = format!("file://{}", program.display());
    let mut client = Client::start(&json!({}));
    client.open(&uri, text);
    let over = ask(&mut client, &uri, &program, &json!({}));
    assert!(
        over["error"]["message"].as_str().unwrap().contains("not written"),
        "{over}"
    );
    assert_eq!(std::fs::read_to_string(&program).unwrap(), text);
    let nowhere = ask(
        &mut client,
        &uri,
        &folder.path().join("no/such/folder/x.bin"),
        &json!({}),
    );
    assert!(
        nowhere["error"]["message"].as_str().unwrap().contains("no/such/folder"),
        "{nowhere}"
    );
    let unknown = ask(
        &mut client,
        "untitled:/never-opened",
        &folder.path().join("x.bin"),
        &json!({}),
    );
    assert!(!unknown["error"].is_null(), "{unknown}");
    client.finish();
}

#[test]
fn a_program_in_inch_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("path.bin");
    let mut client = Client::start(&json!({}));
    let text = "(trunnion: dialect linuxcnc)\nG20 G90 G17 F20 S1000 M3\nG0 X0 Y0 Z0\nG1 X2\nM2\n";
    client.open("untitled:/inch.ngc", text);
    let answer = ask(&mut client, "untitled:/inch.ngc", &file, &json!({}))["result"].clone();
    assert_eq!(answer["inch"], true, "{answer}");
    // numbers are in mm all the same
    assert_eq!(answer["high"][0], 50.8, "{answer}");
    client.finish();
}
