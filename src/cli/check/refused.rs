//! Arguments that `check` does not understand: the document that was asked for is written all the same and says why nothing was checked, because a CI job
//! reads the document and not the terminal.
use super::{Tally, document::Document};
use crate::cli::{args::CheckFormat, failure::Failure, json::NotChecked, out::Out, walk};
use clap::ValueEnum;
use std::{
    io::Write,
    path::{Path, PathBuf},
};
use trunnion_files::Outputs;

/// Writes the document for arguments that were refused with `why`, if they ask for one.
pub(crate) fn write(arguments: &[String], why: &str) -> Result<(), Failure> {
    let format = last(arguments, "--format", None);
    let format = format.and_then(|(_, word)| CheckFormat::from_str(&word, false).ok());
    let Some(format) = format.filter(|format| !matches!(format, CheckFormat::Pretty | CheckFormat::Short)) else {
        return Ok(());
    };
    let mut tally = Tally::default();
    tally.not_checked.push(NotChecked::of(&Failure::new(why)));
    let mut text = Vec::new();
    let mut document = Document::new(format, &mut text);
    document.begin()?;
    document.end(&tally, false)?;
    let Some((at, path)) = last(arguments, "--output", Some("-o")) else {
        return Ok(Out::standard().write_all(&text)?);
    };
    let mut outputs = Outputs::new();
    for input in inputs(arguments, at) {
        outputs.input(&input);
    }
    Ok(outputs.output("-o", Path::new(&path))?.write(&text, None)?)
}

/// The value of an option where it stands last, and which word holds it.
fn last(arguments: &[String], long: &str, short: Option<&str>) -> Option<(usize, String)> {
    let end = arguments.iter().position(|word| word == "--");
    let words = &arguments[..end.unwrap_or(arguments.len())];
    let value = |(at, word): (usize, &String)| {
        if word == long || Some(word.as_str()) == short {
            // the next option is no value
            let next = words.get(at + 1).filter(|next| *next == "-" || !next.starts_with('-'));
            return Some((at + 1, next?.clone()));
        }
        let glued = match word.strip_prefix(long) {
            Some(rest) => rest.strip_prefix('=')?,
            None if word.starts_with("--") => return None,
            None => word.strip_prefix(short?)?.trim_start_matches('='),
        };
        Some((at, glued.to_owned()))
    };
    words.iter().enumerate().filter_map(value).next_back()
}

/// What the command may read: each file that a word but that of the output names, or that lies in a folder that one names.
fn inputs(arguments: &[String], output: usize) -> Vec<PathBuf> {
    let words = arguments.iter().enumerate().filter(|(at, _)| *at != output);
    let named = words.map(|(_, word)| PathBuf::from(word.split_once('=').map_or(word.as_str(), |(_, value)| value)));
    let named = named.filter(|path| path.exists());
    named.flat_map(|path| walk::search(&[path]).0.files).collect()
}

#[cfg(test)]
mod tests {
    use super::last;

    #[test]
    fn options_are_found_as_people_write_them() {
        let found = |line: &str| {
            let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
            last(&words, "--output", Some("-o"))
        };
        for line in [
            "-o a.xml",
            "x --output a.xml",
            "-oa.xml x",
            "-o=a.xml",
            "--output=a.xml",
            "-o b -o a.xml",
        ] {
            assert_eq!(found(line).map(|(_, value)| value).as_deref(), Some("a.xml"), "{line}");
        }
        for line in ["-o", "x -o --format", "x -- -o a.xml", "--only a.xml"] {
            assert_eq!(found(line), None, "{line}");
        }
    }
}
