//! Active comments: `(MSG,`, `(DEBUG,`, `(PRINT,`, `(LOG,`, `(LOGOPEN,`, `(LOGAPPEND,`, `(LOGCLOSE)`, `(ABORT,`, `(PY,`.
//!
//! Of the comments of a line only the last one in parentheses is active; text after `;` is not, unless it is
//! `;py,`. The comment is emitted before the line's block is run.
mod text;

use crate::flow::{Halt, Why};
use crate::read::Line;
use crate::{At, Canon, Class, Engine, Error, Problem, Sink};
use std::sync::Arc;
use trunnion_syntax::TextRange;

/// The program stops itself.
pub(crate) const ABORT: Problem = Problem {
    class: Class::Other,
    message: "Unknown error, bad error code",
    help: "The program itself stops here with (ABORT,...).",
};

/// Words that make a comment active, in lower case, with the treatment of the text after them.
const ACTIVE: [(&[u8], Kind); 7] = [
    (b"msg,", Kind::Message),
    (b"debug,", Kind::Debug),
    (b"print,", Kind::Print),
    (b"log,", Kind::Log),
    (b"logopen,", Kind::Open),
    (b"logappend,", Kind::Append),
    (b"abort,", Kind::Abort),
];

#[derive(Clone, Copy)]
enum Kind {
    Message,
    Debug,
    Print,
    Log,
    Open,
    Append,
    Abort,
}

/// Emits the comment of a line that was read.
#[inline]
pub(crate) fn run(engine: &mut Engine, line: &Line, at: At, sink: &mut dyn Sink) -> Result<(), Halt> {
    let source = &engine.files[at.file.0 as usize];
    if let Some(remark) = line.remark {
        let text = trim_start(&source.bytes()[remark.start as usize + 1..remark.end as usize]);
        if starts_with(text, b"py,") {
            return Err(python());
        }
    }
    let Some(range) = line.comment else {
        return Ok(());
    };
    let source = Arc::clone(source);
    tell(engine, source.bytes(), range, at, sink)
}

fn tell(engine: &mut Engine, source: &[u8], range: TextRange, at: At, sink: &mut dyn Sink) -> Result<(), Halt> {
    let inside = &source[range.start as usize + 1..range.end as usize - 1];
    if inside.is_empty() {
        return Ok(());
    }
    let inside = trim_start(inside);
    if inside.eq_ignore_ascii_case(b"logclose") {
        engine.emit(Canon::Log(Arc::from(b"LOGCLOSE()".as_slice())), at, sink);
        return Ok(());
    }
    if starts_with(inside, b"py,") {
        return Err(python());
    }
    let active = ACTIVE.iter().find(|(word, _)| starts_with(inside, word));
    let Some((word, kind)) = active else {
        engine.emit(Canon::Comment(Arc::from(inside)), at, sink);
        return Ok(());
    };
    let text = &inside[word.len()..];
    let call = match kind {
        Kind::Message => Canon::Message(Arc::from(text)),
        Kind::Debug => Canon::Message(Arc::from(text::fill(text, engine))),
        Kind::Print => Canon::Print(Arc::from(text::fill(text, engine))),
        Kind::Log => log("LOG", &text::fill(text, engine)),
        Kind::Open => log("LOGOPEN", text),
        Kind::Append => log("LOGAPPEND", text),
        Kind::Abort => {
            let text = text::fill(text, engine);
            return Err(Halt::from(if text.is_empty() {
                Error::new(&ABORT, range)
            } else {
                Error::with(&ABORT, range, String::from_utf8_lossy(&text).into_owned())
            }));
        }
    };
    engine.emit(call, at, sink);
    Ok(())
}

/// The text of a call that writes to a log.
fn log(name: &str, text: &[u8]) -> Canon {
    let mut call = Vec::with_capacity(name.len() + text.len() + 4);
    call.extend_from_slice(name.as_bytes());
    call.extend_from_slice(b"(\"");
    call.extend_from_slice(text);
    call.extend_from_slice(b"\")");
    Canon::Log(Arc::from(call))
}

fn python() -> Halt {
    Why::Undecided("this line runs Python, which may change anything; Trunnion does not run it".to_owned()).into()
}

fn starts_with(text: &[u8], word: &[u8]) -> bool {
    text.get(..word.len())
        .is_some_and(|head| head.eq_ignore_ascii_case(word))
}

fn trim_start(text: &[u8]) -> &[u8] {
    let blanks = text.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    &text[blanks..]
}
