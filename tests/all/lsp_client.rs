//! A small language client for tests: frames over the pipes of a real `trunnion lsp`.
use serde_json::{Value, json};
use std::{
    collections::{HashMap, VecDeque},
    io::{BufRead, BufReader, Write},
    process::{Child, ChildStdin, Command, Stdio},
    sync::mpsc::{Receiver, channel},
    time::Duration,
};

/// A hang, not a slow machine.
const PATIENCE: Duration = Duration::from_mins(1);

pub(crate) struct Client {
    child: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    next: i64,
    answers: HashMap<i64, Value>,
    errors: VecDeque<Value>,
    published: Vec<Value>,
    pub(crate) last_status: Option<Value>,
}

impl Client {
    pub(crate) fn start(options: &Value) -> Self {
        Self::start_with(options, &json!(["utf-16"]))
    }

    pub(crate) fn start_with(options: &Value, encodings: &Value) -> Self {
        let capabilities = json!({ "general": { "positionEncodings": encodings } });
        Self::start_as(options, &capabilities, &Value::Null)
    }

    /// With what the client can do.
    pub(crate) fn start_able(capabilities: &Value) -> Self {
        Self::start_as(&json!({}), capabilities, &Value::Null)
    }

    /// With a folder.
    pub(crate) fn start_in(options: &Value, root: &str) -> Self {
        Self::start_as(options, &json!({}), &json!(root))
    }

    /// A server that nothing was said to yet.
    pub(crate) fn bare() -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_trunnion"))
            .arg("lsp")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the server starts");
        let output = BufReader::new(child.stdout.take().expect("piped"));
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            let mut output = output;
            while let Some(message) = read_frame(&mut output) {
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        let input = child.stdin.take();
        Self {
            child,
            input,
            messages,
            next: 0,
            answers: HashMap::new(),
            errors: VecDeque::new(),
            published: Vec::new(),
            last_status: None,
        }
    }

    fn start_as(options: &Value, capabilities: &Value, root: &Value) -> Self {
        let mut client = Self::bare();
        let params = json!({ "processId": null, "rootUri": root, "capabilities": capabilities,
                             "initializationOptions": options });
        let answer = client.request("initialize", params);
        assert_eq!(
            answer["result"]["capabilities"]["textDocumentSync"]["change"], 2,
            "incremental sync"
        );
        client.notify("initialized", json!({}));
        client
    }

    /// Numbers of requests go on from here.
    pub(crate) fn continue_at(&mut self, number: i64) {
        self.next = self.next.max(number);
    }

    pub(crate) fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.send_bytes(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    /// Sends bytes as they are.
    pub(crate) fn send_bytes(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().expect("open");
        input.write_all(bytes).expect("the server reads");
        input.flush().expect("the server reads");
    }

    /// The next error that the server answers, to a request or to a message without a number that could be named.
    pub(crate) fn error(&mut self) -> Value {
        loop {
            if let Some(error) = self.errors.pop_front() {
                self.answers.retain(|_, answer| *answer != error);
                return error;
            }
            self.pump();
        }
    }

    pub(crate) fn notify(&mut self, method: &str, params: Value) {
        let mut message = json!({ "jsonrpc": "2.0", "method": method });
        if !params.is_null() {
            message["params"] = params;
        }
        self.send(&message);
    }

    pub(crate) fn send_request(&mut self, method: &str, params: Value) -> i64 {
        self.next += 1;
        let id = self.next;
        let mut message = json!({ "jsonrpc": "2.0", "id": id, "method": method });
        if !params.is_null() {
            message["params"] = params;
        }
        self.send(&message);
        id
    }

    pub(crate) fn request(&mut self, method: &str, params: Value) -> Value {
        let id = self.send_request(method, params);
        self.answer(id)
    }

    fn pump(&mut self) {
        let message = self.messages.recv_timeout(PATIENCE).expect("the server answers");
        if !message["error"].is_null() {
            self.errors.push_back(message.clone());
        }
        match (message["method"].as_str(), message["id"].as_i64()) {
            (Some("textDocument/publishDiagnostics"), _) => {
                // Its status follows; an older one says nothing about it.
                if self
                    .last_status
                    .as_ref()
                    .is_some_and(|s| s["uri"] == message["params"]["uri"])
                {
                    self.last_status = None;
                }
                self.published.push(message["params"].clone());
            }
            (Some("trunnion/status"), _) => self.last_status = Some(message["params"].clone()),
            (Some(_), _) => {}
            (None, Some(id)) => drop(self.answers.insert(id, message)),
            (None, None) if !message["error"].is_null() => {}
            (None, None) => panic!("neither request nor answer: {message}"),
        }
    }

    pub(crate) fn answer(&mut self, id: i64) -> Value {
        loop {
            if let Some(answer) = self.answers.remove(&id) {
                return answer;
            }
            self.pump();
        }
    }

    /// All findings of a version of a document. What the text alone says may be published before; the status follows the last ones.
    pub(crate) fn diagnostics(&mut self, uri: &str, version: i64) -> Vec<Value> {
        loop {
            let done = self
                .last_status
                .as_ref()
                .is_some_and(|s| s["uri"] == uri && s["version"] == version && s["verdict"] != "checking");
            let at = self
                .published
                .iter()
                .rposition(|p| p["uri"] == uri && p["version"] == version);
            if let (true, Some(at)) = (done, at) {
                let found = self.published[at]["diagnostics"].as_array().expect("a list").clone();
                self.published.drain(..=at);
                return found;
            }
            self.pump();
        }
    }

    /// The verdict of the next status.
    pub(crate) fn verdict(&mut self) -> String {
        self.last_status = None;
        while self.last_status.is_none() {
            self.pump();
        }
        let status = self.last_status.as_ref().expect("there");
        status["verdict"].as_str().expect("a text").to_owned()
    }

    /// The next findings published of a version of a document, whether they are all or not.
    pub(crate) fn first_diagnostics(&mut self, uri: &str, version: i64) -> Vec<Value> {
        loop {
            let at = self
                .published
                .iter()
                .position(|p| p["uri"] == uri && p["version"] == version);
            if let Some(at) = at {
                return self.published.remove(at)["diagnostics"]
                    .as_array()
                    .expect("a list")
                    .clone();
            }
            self.pump();
        }
    }

    /// The next findings published without a version.
    pub(crate) fn any_diagnostics(&mut self, uri: &str) -> Vec<Value> {
        loop {
            if let Some(at) = self
                .published
                .iter()
                .position(|p| p["uri"] == uri && p["version"].is_null())
            {
                return self.published.remove(at)["diagnostics"]
                    .as_array()
                    .expect("a list")
                    .clone();
            }
            self.pump();
        }
    }

    pub(crate) fn open(&mut self, uri: &str, text: &str) {
        let document = json!({ "uri": uri, "languageId": "gcode", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    pub(crate) fn edit(&mut self, uri: &str, version: i64, before: &str, bytes: std::ops::Range<usize>, new: &str) {
        let range = json!({ "start": position(before, bytes.start), "end": position(before, bytes.end) });
        self.notify(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": uri, "version": version },
                    "contentChanges": [{ "range": range, "text": new }] }),
        );
    }

    pub(crate) fn change_all(&mut self, uri: &str, version: i64, text: &str) {
        self.notify(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": [{ "text": text }] }),
        );
    }

    /// Clean shutdown: the answer to `shutdown`, then status 0 though the pipe stays open.
    pub(crate) fn finish(mut self) {
        let answer = self.request("shutdown", Value::Null);
        assert!(answer.get("error").is_none(), "{answer}");
        self.notify("exit", Value::Null);
        assert_eq!(self.wait(), Some(0));
    }

    /// The most memory that the server held at once, bytes.
    #[cfg(target_os = "linux")]
    pub(crate) fn most_memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).expect("it runs");
        let line = status
            .lines()
            .find_map(|line| line.strip_prefix("VmHWM:"))
            .expect("there");
        let kilobytes: u64 = line.trim().trim_end_matches("kB").trim().parse().expect("a number");
        kilobytes * 1024
    }

    pub(crate) fn wait(&mut self) -> Option<i32> {
        for _ in 0..600 {
            if let Some(status) = self.child.try_wait().expect("a child of ours") {
                return status.code();
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        self.child.kill().ok();
        panic!("the server did not exit");
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.child.kill().ok();
        self.child.wait().ok();
    }
}

fn read_frame(output: &mut impl BufRead) -> Option<Value> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).ok()? == 0 {
            return None;
        }
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some(value) = line.strip_prefix("Content-Length:") {
            length = value.trim().parse::<usize>().ok();
        }
    }
    let mut body = vec![0; length?];
    output.read_exact(&mut body).ok()?;
    serde_json::from_slice(&body).ok()
}

/// UTF-16 position of a byte; `\n`, `\r\n` and `\r` end lines.
pub(crate) fn position(text: &str, byte: usize) -> Value {
    let mut byte = byte;
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    let before = &text[..byte];
    let line = before.matches('\n').count();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    json!({ "line": line, "character": before[start..].encode_utf16().count() })
}

pub(crate) fn byte(text: &str, position: &Value) -> usize {
    let line = position["line"].as_u64().expect("a number") as usize;
    let character = position["character"].as_u64().expect("a number") as usize;
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let mut units = 0;
    for (at, c) in text[start..].char_indices() {
        if units >= character {
            return start + at;
        }
        units += c.len_utf16();
    }
    text.len()
}

pub(crate) fn text_of<'a>(text: &'a str, range: &Value) -> &'a str {
    &text[byte(text, &range["start"])..byte(text, &range["end"])]
}

/// The text after the edits of a workspace edit.
pub(crate) fn apply(text: &str, edits: &[Value]) -> String {
    let mut spans: Vec<_> = edits
        .iter()
        .map(|e| {
            let range = byte(text, &e["range"]["start"])..byte(text, &e["range"]["end"]);
            (range, e["newText"].as_str().expect("a text"))
        })
        .collect();
    spans.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    let mut out = text.to_owned();
    for (range, new) in spans {
        out.replace_range(range, new);
    }
    out
}
