//! The pages of the site as a new user follows them: each command runs in an empty folder, a page says which of them end with status 1, and
//! what it shows as output is what they print.
use std::{fmt::Write, fs, path::Path, process::Command};
use tempfile::TempDir;

/// Commands of a page.
struct Block {
    commands: String,
    /// The sentence before it says that it ends with status 1.
    fails: bool,
    /// The block of text that follows it: what it prints.
    output: Option<String>,
}

/// The commands of a page, in order.
fn blocks(page: &str) -> Vec<Block> {
    let mut found: Vec<Block> = Vec::new();
    let mut before = "";
    for (at, part) in page.split("```").enumerate() {
        if at.is_multiple_of(2) {
            before = part.trim();
        } else if let Some(text) = part.strip_prefix("sh\n") {
            found.push(Block {
                commands: text.to_owned(),
                fails: before.rsplit("\n\n").next().unwrap_or_default().contains("status 1"),
                output: None,
            });
        } else if let (Some(text), true, Some(last)) =
            (part.strip_prefix("text\n"), before.is_empty(), found.last_mut())
        {
            last.output = Some(text.to_owned());
        }
    }
    found
}

/// Whether `line` is `shown`, in which `...` stands for any text.
fn is_like(line: &str, shown: &str) -> bool {
    let mut parts = shown.split("...");
    let Some(mut rest) = line.strip_prefix(parts.next().unwrap_or_default()) else {
        return false;
    };
    let mut last = None;
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
        last = Some(part);
    }
    // the last part stands at the end of the line
    rest.is_empty() || last.is_some_and(|part| part.is_empty() || (line.ends_with(part) && line.len() >= part.len()))
}

/// Whether the lines are those that are shown, where a line `...` stands for any lines.
fn are_like(lines: &[&str], shown: &[&str]) -> bool {
    match shown.split_first() {
        None => lines.is_empty(),
        Some((&"...", rest)) => (0..=lines.len()).any(|skip| are_like(&lines[skip..], rest)),
        Some((first, rest)) => lines
            .split_first()
            .is_some_and(|(line, others)| is_like(line, first) && are_like(others, rest)),
    }
}

/// Prints this before a block, with its number behind.
const MARK: &str = "@@ block ";

/// A script that runs all blocks in one shell, as a user does.
fn script(blocks: &[Block]) -> String {
    let built = Path::new(env!("CARGO_BIN_EXE_trunnion")).parent().expect("a folder");
    let mut script = format!("exec 2>&1\nPATH='{}':$PATH\n", built.display());
    for (number, block) in blocks.iter().enumerate() {
        // what the toolchain does is the user's: these tests have built the program already
        let commands: Vec<&str> = block
            .commands
            .lines()
            .filter(|line| !line.starts_with("cargo "))
            .collect();
        let commands = commands.join("\n").replace("target/release/trunnion", "trunnion");
        let _ = write!(script, "echo '{MARK}{number}'\n{commands}");
        script.push_str(if block.fails {
            " || status=$?\n[ \"${status:-0}\" = 1 ] || { echo \"ended with status ${status:-0}\"; exit 9; }\nstatus=0\n"
        } else {
            "\n"
        });
    }
    script
}

/// Follows a page of the repository; `samples`: it begins in a folder with the samples.
fn follow(name: &str, samples: bool) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join(name)).expect("read");
    let folder = TempDir::new().expect("a folder");
    if samples {
        let from = root.join("samples");
        let copied = Command::new("cp")
            .arg("-r")
            .arg(from)
            .arg(folder.path())
            .status()
            .expect("cp runs");
        assert!(copied.success());
    }
    let blocks = blocks(&page);
    assert!(!blocks.is_empty(), "{name}: no commands");
    let script = script(&blocks);
    let output = Command::new("bash")
        .args(["-e", "-c", &script])
        .current_dir(folder.path())
        .output()
        .expect("bash runs");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{name}: {said}\n{script}");
    let printed: Vec<&str> = said.split(MARK).skip(1).collect();
    assert_eq!(printed.len(), blocks.len(), "{name}: {said}");
    for (block, printed) in blocks.iter().zip(printed) {
        let Some(shown) = &block.output else { continue };
        let lines: Vec<&str> = printed.lines().skip(1).collect();
        let shown: Vec<&str> = shown.lines().collect();
        assert!(
            are_like(&lines, &shown),
            "{name}: the page shows\n{}\nand\n{}\nprints\n{}",
            shown.join("\n"),
            block.commands,
            lines.join("\n")
        );
    }
}

#[test]
fn three_axes() {
    follow("docs/tutorials/three-axis.md", false);
}

#[test]
fn five_axes() {
    follow("docs/tutorials/five-axis.md", false);
}

#[test]
fn a_gate_in_ci() {
    follow("docs/tutorials/ci.md", false);
}

#[test]
fn machines_and_dialects() {
    follow("docs/machines.md", false);
    follow("docs/dialects.md", false);
}

#[test]
fn the_readme() {
    follow("README.md", true);
}

/// A page with commands that no test follows would grow stale.
#[test]
fn every_page_with_commands_is_followed() {
    let followed = ["ci.md", "five-axis.md", "three-axis.md", "machines.md", "dialects.md"];
    // what these install is installed by CI: scripts/release.sh, .ci/wheel.sh and .ci/wasm.sh
    let installing = ["install.md", "wasm.md"];
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for folder in [
        docs.clone(),
        docs.join("tutorials"),
        docs.join("rules"),
        docs.join("rewrites"),
    ] {
        for entry in fs::read_dir(folder)
            .expect("read")
            .flatten()
            .filter(|entry| entry.path().is_file())
        {
            let name = entry.file_name().to_string_lossy().into_owned();
            let text = fs::read_to_string(entry.path()).unwrap_or_default();
            if !followed.contains(&name.as_str()) && !installing.contains(&name.as_str()) {
                assert!(!text.contains("```sh"), "{name} has commands that no test runs");
            }
        }
    }
}

#[test]
fn output_is_compared_line_by_line() {
    assert!(is_like("a.nc: 5 of 7", "a.nc: ... of 7") && is_like("abc", "a...") && is_like("", ""));
    assert!(!is_like("a.nc: 5 of 8", "a.nc: ... of 7") && !is_like("ab", "a") && !is_like("a", "ab"));
    assert!(are_like(&["a", "b", "c"], &["...", "c"]) && are_like(&["a"], &["...", "a"]));
    assert!(!are_like(&["a", "b"], &["a"]) && !are_like(&["a"], &["a", "b"]));
}
