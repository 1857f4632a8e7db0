//! Every command that reads a program.
use serde_json::{Value, json};
use std::path::Path;

/// A command of the matrix.
#[derive(Clone, Copy)]
pub(super) struct Command {
    /// Its name in the table.
    pub(super) name: &'static str,
    /// The arguments; `FILE` is the program, `OTHER` a copy in which every second line has another number, `SHORTER` its beginning.
    arguments: &'static [&'static str],
    /// Standard output is a JSON document.
    pub(super) json: bool,
    /// The sample of the short form takes one command of each group for a program.
    pub(super) group: &'static str,
}

const fn command(group: &'static str, name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        name,
        arguments,
        json: false,
        group,
    }
}

const fn json_command(group: &'static str, name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        json: true,
        ..command(group, name, arguments)
    }
}

/// The commands; those of a group stand together.
pub(super) const COMMANDS: &[Command] = &[
    command("check", "check", &["check", "--format", "pretty", "FILE"]),
    json_command("check", "check-json", &["check", "--format", "json", "FILE"]),
    command("check", "report", &["report", "FILE", "-o", "-"]),
    command("trace", "trace", &["trace", "FILE"]),
    json_command("trace", "trace-json", &["trace", "--format", "json", "FILE"]),
    command("trace", "canon", &["canon", "FILE"]),
    command("fmt", "fmt", &["fmt", "--diff", "SHORTER"]),
    command(
        "fmt",
        "fmt-renumber",
        &["fmt", "--check", "--renumber", "10", "SHORTER"],
    ),
    command("diff", "diff-itself", &["diff", "FILE", "FILE"]),
    json_command("diff", "diff-other", &["diff", "--format", "json", "FILE", "OTHER"]),
    command("diff", "certify", &["certify", "FILE", "FILE"]),
    command("diff", "certify-other", &["certify", "FILE", "OTHER"]),
    command("convert", "convert-apt", &["convert", "FILE", "--to", "apt"]),
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
    command("fix", "edit-unit", &["edit", "SHORTER", "--unit", "inch"]),
    command("fix", "edit-rotate", &["edit", "SHORTER", "--rotate", "Z=30"]),
    command("fix", "fix", &["fix", "SHORTER"]),
    command(
        "fix",
        "fix-adapt-feed",
        &["fix", "SHORTER", "--rewrite", "adapt-feed", "--feed", "5000"],
    ),
    command("fix", "fix-all", &["fix", "SHORTER", "--rewrite", "all"]),
    command("plot", "plot-joints", &["plot", "FILE", "--kind", "joints"]),
    command("plot", "plot-path", &["plot", "FILE", "--kind", "path"]),
    command("plot", "plot-deviation", &["plot", "FILE", "--kind", "deviation"]),
    command("plot", "plot-feed", &["plot", "FILE", "--kind", "feed"]),
    command("plot", "plot-axis-plane", &["plot", "FILE", "--kind", "axis-plane"]),
    command("plot", "plot-route", &["plot", "FILE", "--kind", "route"]),
    command(
        "plot",
        "plot-servo",
        &[
            "plot", "FILE", "--kind", "servo", "--at", "9", "--kv", "50", "--acc", "2000",
        ],
    ),
    json_command(
        "servo",
        "servo",
        &[
            "servo", "FILE", "--at", "9", "--kv", "50", "--acc", "2000", "--format", "json",
        ],
    ),
    command("servo", "surface", &["surface", "FILE", "--required", "required.toml"]),
    command(
        "servo",
        "machine-compare",
        &["machine", "compare", "mikron-ucp710", "other-machine.toml", "FILE"],
    ),
    json_command("stats", "stats", &["stats", "--format", "json", "FILE"]),
    json_command("stats", "stats-time", &["stats", "--time", "--format", "json", "FILE"]),
    command("parse", "parse-tokens", &["parse", "--tokens", "FILE"]),
    command("parse", "parse", &["parse", "FILE"]),
    command("lsp", "lsp", &["lsp"]),
];

/// Files that commands need beside the program.
pub(super) fn write_helpers(folder: &Path) {
    let required =
        "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [100, 0, 0]], [[0, 100, 0], [100, 100, 0]]]\n";
    std::fs::write(folder.join("required.toml"), required).expect("written");
    let machine = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/machines/mikron-ucp710.toml");
    std::fs::copy(machine, folder.join("other-machine.toml")).expect("a sample");
}

/// The name of the path that the server writes for a viewer.
pub(super) fn scene(file: &str) -> String {
    format!("scene-{file}")
}

/// The name of the changed copy of a program.
pub(super) fn other(file: &str) -> String {
    format!("other-{file}")
}

/// The name of the beginning of a program.
pub(super) fn shorter(file: &str) -> String {
    format!("shorter-{file}")
}

/// The beginning of a program, as much as `fmt` reads by default.
pub(super) fn beginning(program: &[u8]) -> &[u8] {
    super::inputs::cut_off(program, 16_000_000, 400_000)
}

/// The changed copy: the last digit of every second line is another one.
pub(super) fn changed(program: &[u8]) -> Vec<u8> {
    let mut copy = program.to_vec();
    for line in copy.split_mut(|&byte| byte == b'\n').skip(8).step_by(2) {
        if let Some(digit) = line.iter_mut().rev().find(|byte| byte.is_ascii_digit()) {
            *digit = b'0' + (*digit - b'0' + 1) % 10;
        }
    }
    copy
}

impl Command {
    /// The arguments for a program in a dialect.
    pub(super) fn arguments(&self, file: &str, dialect: &str) -> Vec<String> {
        let (other, shorter) = (other(file), shorter(file));
        let own = self.arguments.iter().map(|word| match *word {
            "FILE" => file,
            "OTHER" => other.as_str(),
            "SHORTER" => shorter.as_str(),
            word => word,
        });
        let more: &[&str] = if self.name == "lsp" {
            &[]
        } else {
            &["--dialect", dialect]
        };
        own.chain(more.iter().copied()).map(str::to_owned).collect()
    }

    /// What is said to the command on standard input: a session with the program for the server, else nothing.
    pub(super) fn talks(&self, folder: &Path, file: &str) -> Vec<u8> {
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
            out.extend(format!("Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes());
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
        say(request(13, "shutdown", &Value::Null));
        say(notice("exit", &Value::Null));
        out
    }
}

fn request(id: u32, method: &str, params: &Value) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params })
}

fn notice(method: &str, params: &Value) -> Value {
    json!({ "jsonrpc": "2.0", "method": method, "params": params })
}
