//! Every command that reads a program.
use serde_json::{Value, json};
use std::path::Path;

/// A command of the matrix.
pub(super) struct Command {
    /// Its name in the table.
    pub(super) name: &'static str,
    /// The arguments; `FILE` is the program.
    arguments: &'static [&'static str],
    /// Standard output is a JSON document.
    pub(super) json: bool,
}

const fn command(name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        name,
        arguments,
        json: false,
    }
}

const fn json_command(name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        name,
        arguments,
        json: true,
    }
}

/// The commands.
pub(super) const COMMANDS: &[Command] = &[
    command("check", &["check", "--format", "pretty", "FILE"]),
    json_command("check-json", &["check", "--format", "json", "FILE"]),
    command("trace", &["trace", "FILE"]),
    json_command("trace-json", &["trace", "--format", "json", "FILE"]),
    command("canon", &["canon", "FILE"]),
    command("fmt", &["fmt", "--diff", "FILE"]),
    command("fmt-renumber", &["fmt", "--check", "--renumber", "10", "FILE"]),
    command("diff-itself", &["diff", "FILE", "FILE"]),
    json_command("diff-other", &["diff", "--format", "json", "FILE", "plain.nc"]),
    command("certify", &["certify", "FILE", "FILE"]),
    command("certify-other", &["certify", "plain.nc", "FILE"]),
    command("convert-apt", &["convert", "FILE", "--to", "apt"]),
    command(
        "convert-code",
        &["convert", "FILE", "--to", "sinumerik-840d", "--no-tcp"],
    ),
    command("fix", &["fix", "FILE"]),
    command("plot-joints", &["plot", "FILE", "--kind", "joints"]),
    command("plot-path", &["plot", "FILE", "--kind", "path"]),
    command("plot-deviation", &["plot", "FILE", "--kind", "deviation"]),
    command("surface", &["surface", "FILE", "--required", "required.toml"]),
    json_command("stats", &["stats", "--format", "json", "FILE"]),
    command("parse-tokens", &["parse", "--tokens", "FILE"]),
    command("parse", &["parse", "FILE"]),
    command("lsp", &["lsp"]),
];

/// Files that commands need beside the program.
pub(super) fn write_helpers(folder: &Path) {
    let required = "[[grid]]\npoints = [[[0, 0, 0], [100, 0, 0]], [[0, 100, 0], [100, 100, 0]]]\n";
    std::fs::write(folder.join("required.toml"), required).expect("written");
    let plain = "G21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG43 H1\nF100.\nG1 X0. Y0. Z50.\nX1.\nX5.\nM30\n";
    std::fs::write(folder.join("plain.nc"), plain).expect("written");
}

impl Command {
    /// The arguments for a program in a dialect.
    pub(super) fn arguments(&self, file: &str, dialect: &str) -> Vec<String> {
        let own = self
            .arguments
            .iter()
            .map(|word| if *word == "FILE" { file } else { word });
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
        say(request(6, "shutdown", &Value::Null));
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
