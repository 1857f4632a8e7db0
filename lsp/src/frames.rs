//! What the client sends, cut into messages. tower-lsp 0.20 stops at the first malformed message; here each one is answered with an error
//! and the next message is looked for.
//!
//! Source: Language Server Protocol 3.17, base protocol; JSON-RPC 2.0, section 5.1 (error codes).
use serde::Deserialize;
use serde_json::{Value, json};
use std::borrow::Cow;
use tokio::io::{AsyncBufRead, AsyncBufReadExt, AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt, BufReader};

/// A message in place of a malformed one: the service answers it with the error in its parameters.
pub(crate) const MALFORMED: &str = "$/malformed";
/// JSON-RPC: the text is not JSON, or its frame is broken.
const PARSE_ERROR: i64 = -32700;
/// JSON-RPC: the JSON is not a request or an answer.
const INVALID_REQUEST: i64 = -32600;
/// Longest message, bytes: the largest program that the command line reads by default, with its JSON escapes.
const LONGEST: u64 = 600_000_000;
/// Longest header line, bytes.
const LONGEST_LINE: u64 = 4096;

/// Passes on each well-formed message, and for each malformed one a [`MALFORMED`] message, until the input ends.
pub(crate) async fn pump(input: impl AsyncRead + Unpin, mut output: impl AsyncWrite + Unpin) {
    let mut input = BufReader::new(input);
    // an error of reading or writing ends the conversation, as its end does
    while let Ok(Some(body)) = next(&mut input).await {
        let header = format!("Content-Length: {}\r\n\r\n", body.len());
        if output.write_all(header.as_bytes()).await.is_err() || output.write_all(&body).await.is_err() {
            return;
        }
    }
}

/// The next message, or the one in place of a malformed one; `None` at the end of the input.
async fn next(input: &mut (impl AsyncBufRead + Unpin)) -> std::io::Result<Option<Vec<u8>>> {
    let length = match header(input).await? {
        Header::End => return Ok(None),
        Header::Malformed(why) => return Ok(Some(malformed(PARSE_ERROR, &why))),
        Header::Length(length) => length,
    };
    let mut body = Vec::new();
    // grows as bytes come, so that a length alone takes no memory
    (&mut *input).take(length).read_to_end(&mut body).await?;
    if (body.len() as u64) < length {
        return Ok(None);
    }
    Ok(Some(match judged(&body) {
        Ok(()) => body,
        Err((code, why)) => malformed(code, &why),
    }))
}

/// What a header says.
enum Header {
    Length(u64),
    Malformed(String),
    End,
}

/// Reads a header up to its empty line. Lines before it that do not belong to a header are skipped as one malformed message.
async fn header(input: &mut (impl AsyncBufRead + Unpin)) -> std::io::Result<Header> {
    let mut stray = false;
    loop {
        let Some(line) = line(input).await? else {
            return Ok(Header::End);
        };
        let Some(value) = content_length(&line) else {
            stray |= !line.is_empty();
            if stray && line.is_empty() {
                return Ok(Header::Malformed("a header without Content-Length".to_owned()));
            }
            continue;
        };
        // the rest of the header: Content-Type contains nothing new
        loop {
            match self::line(input).await? {
                None => return Ok(Header::End),
                Some(more) if more.is_empty() => break,
                Some(_) => {}
            }
        }
        return Ok(match value.parse::<u64>() {
            Ok(length) if length <= LONGEST => Header::Length(length),
            Ok(length) => Header::Malformed(format!(
                "a message of {length} bytes is longer than the limit of {LONGEST} bytes"
            )),
            Err(_) => Header::Malformed(format!("Content-Length is not a number: `{value}`")),
        });
    }
}

/// A line without its end; longer lines come in pieces.
async fn line(input: &mut (impl AsyncBufRead + Unpin)) -> std::io::Result<Option<String>> {
    let mut bytes = Vec::new();
    if (&mut *input).take(LONGEST_LINE).read_until(b'\n', &mut bytes).await? == 0 {
        return Ok(None);
    }
    Ok(Some(String::from_utf8_lossy(&bytes).trim().to_owned()))
}

/// The value of Content-Length in a line. After a message that was longer than it said, the line begins with its rest.
fn content_length(line: &str) -> Option<&str> {
    const NAME: &[u8] = b"content-length:";
    let at = line
        .as_bytes()
        .windows(NAME.len())
        .rposition(|window| window.eq_ignore_ascii_case(NAME))?;
    Some(line[at + NAME.len()..].trim())
}

/// The fields that identify a request or an answer; all others are skipped.
#[derive(Deserialize)]
struct Head<'a> {
    #[serde(borrow)]
    jsonrpc: Option<Cow<'a, str>>,
    #[serde(borrow)]
    method: Option<Cow<'a, str>>,
    id: Option<Value>,
    #[serde(borrow)]
    params: Option<&'a serde_json::value::RawValue>,
}

/// Whether a message is one that the service understands; otherwise the error code and the reason.
fn judged(body: &[u8]) -> Result<(), (i64, String)> {
    let text = std::str::from_utf8(body).map_err(|error| (PARSE_ERROR, error.to_string()))?;
    let head: Head<'_> = serde_json::from_str(text).map_err(|error| {
        let code = if error.is_data() { INVALID_REQUEST } else { PARSE_ERROR };
        (code, error.to_string())
    })?;
    let id = head.id.as_ref().is_none_or(|id| id.is_i64() || id.is_string());
    let known = head.method.is_some() || head.id.is_some();
    if head.jsonrpc.as_deref() != Some("2.0") || !id || !known {
        return Err((INVALID_REQUEST, "not a JSON-RPC 2.0 message".to_owned()));
    }
    if head.params.is_some_and(|params| !params.get().starts_with(['{', '['])) {
        return Err((INVALID_REQUEST, "params must be an object or a list".to_owned()));
    }
    Ok(())
}

fn malformed(code: i64, why: &str) -> Vec<u8> {
    let message = json!({ "jsonrpc": "2.0", "method": MALFORMED, "params": { "code": code, "message": why } });
    message.to_string().into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Methods of the messages that come through.
    fn methods(input: &[u8]) -> Vec<String> {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .build()
            .expect("a runtime");
        runtime.block_on(async {
            let mut input = input;
            let mut methods = Vec::new();
            while let Ok(Some(body)) = next(&mut input).await {
                let message: Value = serde_json::from_slice(&body).expect("JSON");
                methods.push(message["method"].as_str().unwrap_or("answer").to_owned());
            }
            methods
        })
    }

    fn frame(body: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{body}", body.len())
    }

    const GOOD: &str = r#"{"jsonrpc":"2.0","method":"ok","params":{}}"#;

    #[test]
    fn a_malformed_message_is_answered_and_the_next_is_read() {
        for bad in [
            frame("not JSON"),
            frame(r#"{"jsonrpc":"2.0","id":5,"method":"#),
            frame("[]"),
            frame("{}"),
            frame("null"),
            frame(r#"{"jsonrpc":"1.0","method":"x"}"#),
            frame(r#"{"jsonrpc":"2.0","method":"x","params":5}"#),
            frame(r#"{"jsonrpc":"2.0","method":"x","id":{}}"#),
            frame(""),
            "Content-Length: many\r\n\r\n".to_owned(),
            "Content-Length: -5\r\n\r\n".to_owned(),
            "Content-Length: 99999999999999\r\n\r\n".to_owned(),
            "Content-Type: text\r\n\r\n".to_owned(),
            "noise\r\n\r\n".to_owned(),
        ] {
            let input = format!("{bad}{}", frame(GOOD));
            assert_eq!(methods(input.as_bytes()), [MALFORMED, "ok"], "{bad}");
        }
    }

    #[test]
    fn a_length_that_is_too_short_costs_one_message() {
        let short = format!("Content-Length: {}\r\n\r\n{GOOD}", GOOD.len() - 3);
        let input = format!("{short}{}{}", frame(GOOD), frame(GOOD));
        assert_eq!(methods(input.as_bytes()), [MALFORMED, "ok", "ok"]);
    }

    #[test]
    fn bytes_that_are_not_utf_8_are_malformed() {
        let mut input = b"Content-Length: 2\r\n\r\n\xff\xfe".to_vec();
        input.extend(frame(GOOD).into_bytes());
        assert_eq!(methods(&input), [MALFORMED, "ok"]);
    }

    #[test]
    fn headers_are_read_in_any_case_and_order() {
        let input = format!("content-type: x\r\ncontent-length: {}\r\n\r\n{GOOD}", GOOD.len());
        assert_eq!(methods(input.as_bytes()), ["ok"]);
        let answer = frame(r#"{"jsonrpc":"2.0","id":1,"result":null}"#);
        assert_eq!(methods(answer.as_bytes()), ["answer"]);
    }
}
