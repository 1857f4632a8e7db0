//! `--lines 12` and `--lines 12-40`, for all commands that look at a part of a program.

/// Reads `12` or `12-40`.
pub(crate) fn lines(text: &str) -> Result<(u32, u32), String> {
    let number = |text: &str| text.trim().parse::<u32>().ok().filter(|&line| line > 0);
    let range = match text.split_once('-') {
        Some((first, last)) => number(first).zip(number(last)),
        None => number(text).map(|line| (line, line)),
    };
    range
        .filter(|(first, last)| first <= last)
        .ok_or_else(|| "write a line, or the first and the last with `-` between them: 12 or 12-40".to_owned())
}
