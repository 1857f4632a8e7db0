//! Every command that reads a program.
use serde_json::{Value, json};
use std::path::Path;

/// A command of the matrix.
#[derive(Clone, Copy)]
pub(super) struct Command {
    /// Its name in the table.
    pub(super) name: &'static str,
    /// The arguments; `FILE` is the program, `OTHER` a copy in which every second line has another number.
    arguments: &'static [&'static str],
    /// Standard output is a JSON document.
    pub(super) json: bool,
    /// The command beside it in the list is another form of it: one has an even place, the other an odd one.
    pub(super) has_twin: bool,
}

const fn command(name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        name,
        arguments,
        json: false,
        has_twin: false,
    }
}

const fn json_command(name: &'static str, arguments: &'static [&'static str]) -> Command {
    Command {
        name,
        arguments,
        json: true,
        has_twin: false,
    }
}

const fn twin(command: Command) -> Command {
    Command {
        has_twin: true,
        ..command
    }
}

/// The commands.
pub(super) const COMMANDS: &[Command] = &[
    twin(command("check", &["check", "--format", "pretty", "FILE"])),
    twin(json_command("check-json", &["check", "--format", "json", "FILE"])),
    twin(command("trace", &["trace", "FILE"])),
    twin(json_command("trace-json", &["trace", "--format", "json", "FILE"])),
    command("canon", &["canon", "FILE"]),
    twin(command("fmt", &["fmt", "--diff", "FILE"])),
    twin(command("fmt-renumber", &["fmt", "--check", "--renumber", "10", "FILE"])),
    twin(command("diff-itself", &["diff", "FILE", "FILE"])),
    twin(json_command(
        "diff-other",
        &["diff", "--format", "json", "FILE", "OTHER"],
    )),
    twin(command("certify", &["certify", "FILE", "FILE"])),
    twin(command("certify-other", &["certify", "FILE", "OTHER"])),
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
    twin(command("parse-tokens", &["parse", "--tokens", "FILE"])),
    twin(command("parse", &["parse", "FILE"])),
    command("lsp", &["lsp"]),
];

/// Files that commands need beside the program.
pub(super) fn write_helpers(folder: &Path) {
    let required =
        "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [100, 0, 0]], [[0, 100, 0], [100, 100, 0]]]\n";
    std::fs::write(folder.join("required.toml"), required).expect("written");
}

/// The name of the changed copy of a program.
pub(super) fn other(file: &str) -> String {
    format!("other-{file}")
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
        let other = other(file);
        let own = self.arguments.iter().map(|word| match *word {
            "FILE" => file,
            "OTHER" => other.as_str(),
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
