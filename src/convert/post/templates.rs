//! The templates of a post: which there are, the names in them, and how much one line of a program may become.
use super::{PostError, fault};
use crate::template::names;
use toml::Spanned;

/// Templates and the names that they may use.
pub(super) const TEMPLATES: &[(&str, &[&str])] = &[
    (
        "header",
        &[
            "program",
            "title",
            "number",
            "tools",
            "machine",
            "units",
            "feed_mode",
            "work_offset",
        ],
    ),
    ("footer", &["program", "title", "number"]),
    ("comment", &["text"]),
    ("message", &["text"]),
    ("work-offset", &["work_offset"]),
    ("tool-change", &["tool"]),
    ("spindle-clockwise", &["speed"]),
    ("spindle-counter-clockwise", &["speed"]),
    ("spindle-speed", &["speed"]),
    ("spindle-stop", &[]),
    ("coolant-flood", &[]),
    ("coolant-mist", &[]),
    ("coolant-thru", &[]),
    ("coolant-thru-off", &[]),
    ("coolant-air", &[]),
    ("coolant-off", &[]),
    ("exact-stop", &[]),
    ("exact-path", &[]),
    ("continuous-path", &[]),
    ("stop", &[]),
    ("optional-stop", &[]),
    ("auxiliary", &["number"]),
    ("dwell", &["seconds", "milliseconds"]),
    ("units-mm", &[]),
    ("units-inch", &[]),
    ("feed-per-minute", &[]),
    ("feed-inverse-time", &[]),
    ("feed-per-revolution", &[]),
    ("length-on", &["tool"]),
    ("length-off", &[]),
    ("tcp-words-on", &["tool", "tcp_on"]),
    ("tcp-vectors-on", &["tool", "tcp_on"]),
    ("tcp-off", &["tcp_off"]),
    ("vector", &["i", "j", "k"]),
    ("arc-radius", &["radius"]),
];

/// So many characters of an unknown name are shown.
const SHOWN: usize = 40;

/// Most characters of a template, and how often it may name one value. A template is written for each place of the program that needs it: those
/// for every comment are shorter than those that are written once.
fn most(key: &str) -> (usize, usize) {
    match key {
        "header" | "footer" => (20_000, 4),
        "comment" | "message" => (250, 2),
        _ => (2000, 8),
    }
}

/// A template must be of a size that a program needs.
fn bounded(key: &str, value: &Spanned<String>) -> Result<(), PostError> {
    let (length, times) = most(key);
    let written = value.get_ref().chars().count();
    if written > length {
        let message = format!(
            "the template {key} has {written} characters; {length} are the most: leave out what the control does not need"
        );
        return Err(fault(value.span(), message));
    }
    for (_, name) in names(value.get_ref()) {
        let count = names(value.get_ref()).filter(|(_, other)| *other == name).count();
        if count > times {
            let message = format!(
                "the template {key} names {{{name}}} {count} times; {times} times are the most: leave out the others"
            );
            return Err(fault(value.span(), message));
        }
    }
    Ok(())
}

/// A template must be known, and so must the names in it.
pub(super) fn check_template(text: &str, key: &Spanned<String>, value: &Spanned<String>) -> Result<(), PostError> {
    let Some((_, allowed)) = TEMPLATES.iter().find(|(known, _)| known == key.get_ref()) else {
        let known: Vec<&str> = TEMPLATES.iter().map(|(known, _)| *known).collect();
        let message = format!(
            "no template is named {:?}; there are {}",
            key.get_ref(),
            known.join(", ")
        );
        return Err(fault(key.span(), message));
    };
    let mut unknown = names(value.get_ref()).filter(|(_, name)| !allowed.contains(name));
    let Some((_, name)) = unknown.next() else {
        return bounded(key.get_ref(), value);
    };
    // a name may be as long as the template
    let (name, more) = match name.char_indices().nth(SHOWN) {
        Some((at, _)) => (&name[..at], "..."),
        None => (name, ""),
    };
    // the place in the file: escapes may shift offsets, so the name itself is looked for
    let span = value.span();
    let wanted = format!("{{{name}");
    let at = text[span.clone()]
        .find(&wanted)
        .map_or(span.start, |at| span.start + at);
    let may = if allowed.is_empty() {
        "it takes none".to_owned()
    } else {
        format!(
            "it takes {}",
            allowed
                .iter()
                .map(|name| format!("{{{name}}}"))
                .collect::<Vec<_>>()
                .join(" ")
        )
    };
    Err(fault(
        at..at + wanted.len(),
        format!(
            "the template {} has the unknown name {{{name}{more}}}; {may}",
            key.get_ref()
        ),
    ))
}
