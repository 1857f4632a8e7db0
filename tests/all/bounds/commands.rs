//! Every command that reads a program.
use super::measure::{Measured, Part};
use serde_json::{Value, json};
use std::path::Path;

/// A command of the matrix.
#[derive(Clone, Copy)]
pub(crate) struct Command {
    /// Its name in the table.
    pub(crate) name: &'static str,
    /// The arguments; `FILE` is the program, the names in [`BEGINNINGS`] are its beginning, and `OTHER` is a copy of `HALF` in which every second
    /// line has another number.
    arguments: &'static [&'static str],
    /// Standard output is one JSON document up to this exit status.
    pub(super) json: Option<i32>,
    /// The sample of the short form takes one command of each group for a program.
    pub(super) group: &'static str,
}

const fn command(group: &'static str, name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        name,
        arguments,
        json: None,
        group,
    }
}

const fn json_command(group: &'static str, name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        json: Some(1),
        ..command(group, name, arguments)
    }
}

/// The commands; those of a group stand together.
pub(crate) const COMMANDS: &[Command] = &[
    command("check", "check", &["check", "--format", "pretty", "FILE"]),
    json_command("check", "check-json", &["check", "--format", "json", "FILE"]),
    command("check", "report", &["report", "PAGE", "-o", "-"]),
    command("trace", "trace", &["trace", "LISTED"]),
    json_command("trace", "trace-json", &["trace", "--format", "json", "LISTED"]),
    command("trace", "canon", &["canon", "FILE"]),
    command("fmt", "fmt", &["fmt", "--diff", "SHORTER"]),
    command(
        "fmt",
        "fmt-renumber",
        &["fmt", "--check", "--renumber", "10", "SHORTER"],
    ),
    command("diff", "diff-itself", &["diff", "HALF", "HALF"]),
    json_command("diff", "diff-other", &["diff", "--format", "json", "HALF", "OTHER"]),
    command("diff", "certify", &["certify", "HALF", "HALF"]),
    command("diff", "certify-other", &["certify", "HALF", "OTHER"]),
    Command {
        // a program that is refused has no document
        json: Some(0),
        ..command(
            "convert",
            "convert-apt",
            &["convert", "FILE", "--to", "apt", "--format", "json"],
        )
    },
    command(
        "convert",
        "convert-code",
        &["convert", "FILE", "--to", "sinumerik-840d", "--no-tcp"],
    ),
    command(
        "convert",
        "convert-klartext",
        &["convert", "FILE", "--to", "heidenhain-klartext"],
    ),
    command("fix", "edit-unit", &["edit", "SHORTEST", "--unit", "inch"]),
    command("fix", "edit-rotate", &["edit", "SHORTEST", "--rotate", "Z=30"]),
    command("fix", "fix", &["fix", "SHORTEST"]),
    command(
        "fix",
        "fix-adapt-feed",
        &["fix", "SHORTEST", "--rewrite", "adapt-feed", "--feed", "5000"],
    ),
    json_command(
        "fix",
        "fix-all",
        &["fix", "SHORTEST", "--rewrite", "all", "--format", "json"],
    ),
    command("plot", "plot-joints", &["plot", "HALF", "--kind", "joints"]),
    command("plot", "plot-path", &["plot", "HALF", "--kind", "path"]),
    command("plot", "plot-deviation", &["plot", "HALF", "--kind", "deviation"]),
    command("plot", "plot-feed", &["plot", "HALF", "--kind", "feed"]),
    command("plot", "plot-axis-plane", &["plot", "HALF", "--kind", "axis-plane"]),
    command("plot", "plot-route", &["plot", "HALF", "--kind", "route"]),
    command(
        "plot",
        "plot-servo",
        &[
            "plot", "HALF", "--kind", "servo", "--at", "9", "--kv", "50", "--acc", "2000",
        ],
    ),
    json_command(
        "servo",
        "servo",
        &[
            "servo", "FILE", "--at", "9", "--kv", "50", "--acc", "2000", "--format", "json",
        ],
    ),
    json_command(
        "servo",
        "surface",
        &["surface", "FILE", "--required", "required.toml", "--format", "json"],
    ),
    command(
        "servo",
        "machine-compare",
        &["machine", "compare", "mikron-ucp710", "other-machine.toml", "HALF"],
    ),
    json_command("stats", "stats", &["stats", "--format", "json", "HALF"]),
    json_command("stats", "stats-time", &["stats", "--time", "--format", "json", "HALF"]),
    command("parse", "parse-tokens", &["parse", "--tokens", "FILE"]),
    json_command("parse", "parse", &["parse", "LISTED", "--format", "json"]),
    command("lsp", "lsp", &["lsp"]),
];

/// The most bytes and lines.
type Size = (usize, usize);

/// The beginnings of a program that commands read by default which trace or print a tree (`LISTED`), compare (`HALF`), lay out (`SHORTER`), change
/// (`SHORTEST`) or report (`PAGE`).
const BEGINNINGS: &[(&str, Size)] = &[
    ("LISTED", (64_000_000, 600_000)),
    ("HALF", HALF),
    ("SHORTER", (16_000_000, 300_000)),
    ("SHORTEST", (16_000_000, 200_000)),
    ("PAGE", (16_000_000, 100_000)),
];

const HALF: Size = (32_000_000, 250_000);

/// Files that commands need beside the program.
pub(crate) fn write_helpers(folder: &Path) {
    let required =
        "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [100, 0, 0]], [[0, 100, 0], [100, 100, 0]]]\n";
    std::fs::write(folder.join("required.toml"), required).expect("written");
    let machine = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/machines/mikron-ucp710.toml");
    std::fs::copy(machine, folder.join("other-machine.toml")).expect("a sample");
}

/// The name of the path that the server writes for a viewer.
fn scene(file: &str) -> String {
    format!("scene-{file}")
}

/// The name of the changed copy of a program.
fn other(file: &str) -> String {
    format!("other-{file}")
}

/// The name of a beginning of a program.
fn beginning(named: &str, file: &str) -> String {
    format!("{}-{file}", named.to_ascii_lowercase())
}

/// The beginning that an argument names.
fn size_of(word: &str) -> Option<Size> {
    let found = BEGINNINGS.iter().find(|(named, _)| *named == word);
    found.map(|&(_, size)| size)
}

/// Writes a program and what commands read beside it: its beginnings, and the changed copy.
pub(crate) fn write_program(folder: &Path, file: &str, program: &[u8]) {
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.join(name), bytes).expect("written");
    let part = |(bytes, lines)| super::inputs::cut_off(program, bytes, lines);
    write(file, program);
    write(&other(file), &changed(part(HALF)));
    for &(named, size) in BEGINNINGS {
        write(&beginning(named, file), part(size));
    }
}

/// Removes them, and the path that the server wrote.
pub(crate) fn remove_program(folder: &Path, file: &str) {
    let beginnings = BEGINNINGS.iter().map(|(named, _)| beginning(named, file));
    for name in beginnings.chain([file.to_owned(), other(file)]) {
        std::fs::remove_file(folder.join(name)).expect("removed");
    }
    let _ = std::fs::remove_file(folder.join(scene(file)));
}

/// The changed copy: the last digit of every second line is another one.
fn changed(program: &[u8]) -> Vec<u8> {
    let mut copy = program.to_vec();
    for line in copy.split_mut(|&byte| byte == b'\n').skip(8).step_by(2) {
        if let Some(digit) = line.iter_mut().rev().find(|byte| byte.is_ascii_digit()) {
            *digit = b'0' + (*digit - b'0' + 1) % 10;
        }
    }
    copy
}

impl Command {
    /// The most bytes and lines that it is given of a program.
    pub(super) fn reads(&self) -> (usize, usize) {
        let mut words = self.arguments.iter();
        words
            .find_map(|word| size_of(word))
            .unwrap_or(super::inputs::Input::MOST)
    }

    /// The arguments for a program, in a dialect or in the one that it seems to be written in.
    pub(crate) fn arguments(&self, file: &str, dialect: Option<&str>) -> Vec<String> {
        let own = self.arguments.iter().map(|&word| match word {
            "FILE" => file.to_owned(),
            "OTHER" => other(file),
            word if size_of(word).is_some() => beginning(word, file),
            word => word.to_owned(),
        });
        let dialect = dialect.filter(|_| self.name != "lsp");
        let more = dialect.into_iter().flat_map(|dialect| ["--dialect", dialect]);
        own.chain(more.map(str::to_owned)).collect()
    }

    /// What a run may not do, however long it took: end by a signal, panic, say nothing where it has no answer, print half a document.
    pub(crate) fn broken(&self, measured: &Measured) -> Option<String> {
        let said = &measured.said;
        let Some(status) = measured.status else {
            return Some(format!("ended by a signal, or did not end: {said}"));
        };
        if !(0..=2).contains(&status) || said.contains("panicked") {
            return Some(format!("exit status {status}: {said}"));
        }
        if self.name == "lsp" && status != 0 {
            return Some(format!("the session ended with status {status}: {said}"));
        }
        let silent = said.trim().is_empty();
        if silent && (status == 2 || status == 1 && measured.printed() == 0) {
            return Some(format!("exit status {status} without a message"));
        }
        let document = self.json.is_some_and(|most| status <= most);
        (document && !measured.is_json()).then(|| "the output is not JSON".to_owned())
    }

    /// What is said to the command on standard input: a session with the program for the server, else nothing.
    pub(crate) fn talks(&self, folder: &Path, file: &str) -> Vec<Part> {
        if self.name != "lsp" {
            return Vec::new();
        }
        let path = folder.join(file);
        let bytes = std::fs::read(&path).expect("readable");
        let uri = format!("file://{}", path.display());
        let document = json!({ "uri": uri });
        let here = json!({ "line": 7, "character": 1 });
        let mut out = Vec::new();
        let mut say = |message: Value| {
            let body = message.to_string();
            out.push(Part {
                bytes: format!("Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes(),
                request: message["id"].as_u64(),
            });
        };
        say(request(
            1,
            "initialize",
            &json!({ "processId": null, "rootUri": null, "capabilities": {} }),
        ));
        say(notice("initialized", &json!({})));
        let text = String::from_utf8_lossy(&bytes);
        say(notice(
            "textDocument/didOpen",
            &json!({ "textDocument": { "uri": uri, "languageId": "gcode", "version": 1, "text": text } }),
        ));
        say(request(
            2,
            "textDocument/hover",
            &json!({ "textDocument": document, "position": here }),
        ));
        let edit = json!([{ "range": { "start": here, "end": here }, "text": " " }]);
        say(notice(
            "textDocument/didChange",
            &json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": edit }),
        ));
        say(request(
            3,
            "textDocument/documentSymbol",
            &json!({ "textDocument": document }),
        ));
        say(request(
            4,
            "textDocument/formatting",
            &json!({ "textDocument": document, "options": { "tabSize": 4, "insertSpaces": true } }),
        ));
        say(request(
            5,
            "textDocument/codeAction",
            &json!({ "textDocument": document, "range": { "start": here, "end": here }, "context": { "diagnostics": [] } }),
        ));
        for (id, method) in [
            (6, "textDocument/semanticTokens/full"),
            (7, "textDocument/foldingRange"),
            (8, "textDocument/codeLens"),
            (9, "textDocument/diagnostic"),
        ] {
            say(request(id, method, &json!({ "textDocument": document })));
        }
        let all = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 4_000_000, "character": 0 } });
        say(request(
            10,
            "textDocument/inlayHint",
            &json!({ "textDocument": document, "range": all }),
        ));
        say(request(
            11,
            "textDocument/references",
            &json!({ "textDocument": document, "position": here, "context": { "includeDeclaration": true } }),
        ));
        let scene = folder.join(scene(file));
        say(request(
            12,
            "trunnion/backplot",
            &json!({ "textDocument": document, "file": scene }),
        ));
        // these have no parameters, not even null
        say(json!({ "jsonrpc": "2.0", "id": 1013, "method": "shutdown" }));
        say(json!({ "jsonrpc": "2.0", "method": "exit" }));
        out
    }
}

/// The server has requests of its own, with numbers from 0.
fn request(id: u32, method: &str, params: &Value) -> Value {
    json!({ "jsonrpc": "2.0", "id": 1000 + id, "method": method, "params": params })
}

fn notice(method: &str, params: &Value) -> Value {
    json!({ "jsonrpc": "2.0", "method": method, "params": params })
}
