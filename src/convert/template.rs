//! Templates with names in braces.

/// The names in braces in a text, with the offset of the opening brace.
pub(crate) fn names(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    core::iter::from_fn(move || {
        let open = at + text.get(at..)?.find('{')?;
        let length = text[open..].find('}').unwrap_or(text.len() - open);
        at = open + length;
        Some((open, &text[open + 1..at]))
    })
}

/// The text with each name replaced by what `value` gives.
///
/// # Errors
/// The first name without a value.
pub(crate) fn fill(text: &str, value: impl Fn(&str) -> Option<String>) -> Result<String, &str> {
    let mut out = String::new();
    let mut from = 0;
    for (open, name) in names(text) {
        out.push_str(&text[from..open]);
        out.push_str(&value(name).ok_or(name)?);
        from = (open + name.len() + 2).min(text.len());
    }
    out.push_str(&text[from..]);
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_and_filled() {
        let filled = fill("T{tool} M6 ({tool})", |name| (name == "tool").then(|| "7".to_owned()));
        assert_eq!(filled.as_deref(), Ok("T7 M6 (7)"));
        assert_eq!(fill("S{sped}", |_| None), Err("sped"));
        assert_eq!(fill("open {", |_| None), Err(""));
        assert_eq!(names("a{b}{c}").collect::<Vec<_>>(), [(1, "b"), (4, "c")]);
    }
}
