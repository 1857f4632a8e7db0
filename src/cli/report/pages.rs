//! Where the pages go: one page for all programs, or a folder with an index and one page for each program.
use super::{
    Written,
    page::{self, Row},
};
use crate::cli::failure::Failure;
use std::{
    collections::{HashMap, HashSet},
    path::{MAIN_SEPARATOR, Path, PathBuf},
};
use trunnion_files::{Outputs, Target};

/// One page holds no more, bytes: a browser must open it, and it is in memory until it is written.
const MOST_BYTES: usize = 200_000_000;
/// The page of a folder that lists its programs.
const INDEX: &str = "index.html";
/// The longest name of a page without its ending, bytes: file systems take 255.
const LONGEST: usize = 150;

/// The pages of one report, written as the programs come.
pub(super) enum Pages {
    One {
        target: Target,
        bodies: Vec<String>,
        held: usize,
    },
    Folder {
        index: Target,
        /// Name and place of the page of each file.
        pages: Vec<(String, Target)>,
    },
}

impl Pages {
    /// As `-o` says: a folder if it is one or ends with a slash. None of the pages may replace an input.
    pub(super) fn new(output: &Path, files: &[PathBuf], outputs: &mut Outputs) -> Result<Self, Failure> {
        if !is_folder(output) {
            return Ok(Self::One {
                target: outputs.output("-o", output)?,
                bodies: Vec::new(),
                held: 0,
            });
        }
        trunnion_files::folder(output)?;
        let index = outputs.output("-o", &output.join(INDEX))?;
        let named = names(files).into_iter().map(|name| {
            let target = outputs.output("-o", &output.join(&name))?;
            Ok((name, target))
        });
        let pages = named.collect::<Result<_, Failure>>()?;
        Ok(Self::Folder { index, pages })
    }

    /// The page of a program in the folder, or its place on the one page.
    pub(super) fn link(&self, at: usize) -> String {
        match self {
            Self::One { .. } => format!("#p{at}"),
            Self::Folder { pages, .. } => pages.get(at).map_or_else(String::new, |(name, _)| name.clone()),
        }
    }

    /// Keeps a program for the one page, or writes its own.
    pub(super) fn put(&mut self, at: usize, files: usize, program: Written) -> Result<Row, Failure> {
        let Written { row, body, .. } = program;
        match self {
            Self::One { bodies, held, .. } => {
                *held += body.len();
                bodies.push(body);
                fits(*held, bodies.len(), files)?;
            }
            Self::Folder { pages, .. } => {
                if let Some((_, target)) = pages.get(at) {
                    let head = page::begin(&page::title(std::slice::from_ref(&row)), row.inch, Some(INDEX));
                    target.write(
                        [&head, &body, &page::end(true)].map(String::as_str).concat().as_bytes(),
                        None,
                    )?;
                }
            }
        }
        Ok(row)
    }

    /// Writes the one page, or the index.
    pub(super) fn finish(self, rows: &[Row], failures: &[String]) -> Result<(), Failure> {
        let title = page::title(rows);
        let inch = rows.iter().any(|row| row.inch);
        match self {
            Self::One { target, bodies, .. } => target.fill(|out| {
                let begin = page::begin(&title, inch, None);
                let overview = if rows.len() != 1 || !failures.is_empty() {
                    page::overview(rows, failures)
                } else {
                    String::new()
                };
                let end = page::end(true);
                let before = [begin, overview];
                for text in before.iter().chain(&bodies).chain([&end]) {
                    out.write_all(text.as_bytes())?;
                }
                Ok(())
            }),
            Self::Folder { index, .. } => {
                let title = page::counted(rows.len());
                let text = [
                    page::begin(&title, inch, None),
                    page::overview(rows, failures),
                    page::end(false),
                ];
                Ok(index.write(text.concat().as_bytes(), None)?)
            }
        }
    }
}

/// Whether `-o` names a folder.
fn is_folder(output: &Path) -> bool {
    let text = output.as_os_str().to_string_lossy();
    text != "-" && (text.ends_with(['/', MAIN_SEPARATOR]) || output.is_dir())
}

/// A name of a page for each file: its path in letters, digits, dots and dashes that every file system and browser takes, each name once.
fn names(files: &[PathBuf]) -> Vec<String> {
    let mut taken = HashSet::from([INDEX.to_owned()]);
    let mut numbers: HashMap<String, u32> = HashMap::new();
    let named = files.iter().map(|file| {
        let stem = stem(file);
        // some file systems do not tell a from A
        let number = numbers.entry(stem.to_ascii_lowercase()).or_default();
        loop {
            *number += 1;
            let name = match number {
                1 => format!("{stem}.html"),
                _ => format!("{stem}-{number}.html"),
            };
            if taken.insert(name.to_ascii_lowercase()) {
                return name;
            }
        }
    });
    named.collect()
}

fn stem(file: &Path) -> String {
    if file == Path::new("-") {
        return "stdin".to_owned();
    }
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() || c == '.' || c == '-' {
            c
        } else {
            '_'
        }
    };
    let text: String = file.to_string_lossy().chars().map(plain).collect();
    // a name that begins with a dot is hidden
    let text = text.trim_start_matches(['.', '_']);
    let tail = text.get(text.len().saturating_sub(LONGEST)..).unwrap_or(text);
    if tail.is_empty() {
        "program".to_owned()
    } else {
        tail.to_owned()
    }
}

/// An error where the first `done` of all programs are too much for one page.
fn fits(bytes: usize, done: usize, all: usize) -> Result<(), Failure> {
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    Err(Failure::new(format!(
        "the first {done} of {all} programs take more than {} MB, too much for one page: nothing was written; `-o FOLDER/` writes a page for each \
         program and an index",
        MOST_BYTES / 1_000_000
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_that_grows_too_large_is_refused_with_what_to_do() {
        assert!(fits(MOST_BYTES, 3, 9).is_ok());
        let refused = fits(MOST_BYTES + 1, 3, 9).expect_err("too large");
        let said = refused.message();
        assert!(
            said.contains("first 3 of 9 programs") && said.contains("200 MB") && said.contains("-o FOLDER/"),
            "{said}"
        );
    }

    #[test]
    fn each_program_has_a_page_with_a_plain_name() {
        let files = [
            "./parts/a b.nc",
            "parts/a_b.nc",
            "parts/A_B.nc",
            "../x<\"&.nc",
            "-",
            "index",
            "../..",
        ];
        let long = format!("{}.nc", "q".repeat(300));
        let mut paths: Vec<PathBuf> = files.iter().map(PathBuf::from).collect();
        paths.push(PathBuf::from(long));
        let named = names(&paths);
        let first = [
            "parts_a_b.nc.html",
            "parts_a_b.nc-2.html",
            "parts_A_B.nc-3.html",
            "x___.nc.html",
            "stdin.html",
            "index-2.html",
            "program.html",
        ];
        assert_eq!(named[..7], first);
        assert_eq!(named[7].len(), LONGEST + 5);
        assert!(named[7].ends_with("qqq.nc.html"));
    }
}
