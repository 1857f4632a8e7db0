//! The pages of the site as a new user follows them: each command runs in an empty folder, a page says which of them end with status 1, and
//! what it shows as output is what they print.
use std::{
    collections::BTreeMap,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
    process::Command,
};
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

/// The Markdown and Rust files below a folder.
fn texts(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("read").flatten() {
        let path = entry.path();
        if path.is_dir() {
            texts(&path, found);
        } else if path.extension().is_some_and(|end| end == "md" || end == "rs") {
            found.push(path);
        }
    }
}

/// A command in a sentence of a page, of a message or of a help text that the program does not know would send a reader astray. Each is parsed with
/// `--help` behind, which ends with status 0 where the command and its options exist.
#[test]
fn commands_in_sentences_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![
        root.join("README.md"),
        root.join("CONTRIBUTING.md"),
        root.join("action.yml"),
    ];
    for folder in ["docs", "src"] {
        texts(&root.join(folder), &mut files);
    }
    let mut commands = BTreeMap::new();
    for file in files
        .iter()
        .filter(|file| !file.components().any(|part| part.as_os_str() == "decisions"))
    {
        let text = fs::read_to_string(file).expect("read");
        let spans = text.split("`trunnion ").skip(1).filter_map(|rest| rest.split_once('`'));
        for (command, _) in spans {
            // a value of the moment in a message, several commands in one span
            let is_whole = !command.contains(['\n', '{', '|']);
            if is_whole && !command.starts_with("COMMAND") && !command.starts_with("help ") {
                commands.entry(command.trim().to_owned()).or_insert(file);
            }
        }
    }
    assert!(commands.len() > 40, "{commands:?}");
    for (command, file) in commands {
        let Err(said) = help_of(&command) else { continue };
        // an option is named without its value, or with the name of its value
        let mut words = command.split(' ');
        let is_named = said.contains("a value is required for")
            || words.any(|word| word == word.to_uppercase() && said.contains(&format!("invalid value '{word}'")));
        assert!(is_named, "{}: `trunnion {command}`: {said}", file.display());
    }
}

/// What a command prints with `--help` behind; what is wrong with it where it does not exist.
fn help_of(command: &str) -> Result<String, String> {
    let mut run = Command::new(env!("CARGO_BIN_EXE_trunnion"));
    let words = command.split_whitespace().take_while(|word| *word != ">");
    let output = run.args(words).arg("--help").output().expect("runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() {
        Ok(text(&output.stdout))
    } else {
        Err(text(&output.stderr))
    }
}

/// The help of each command that takes arguments ends with examples, which are commands.
#[test]
fn the_help_of_a_command_has_examples() {
    let help = help_of("").expect("help");
    let names = help
        .split("Commands:\n")
        .nth(1)
        .and_then(|rest| rest.split("\n\n").next());
    let names = names.expect("a list of commands").lines();
    let names: Vec<&str> = names
        .filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')))
        .filter_map(|line| line.split(' ').next())
        .filter(|name| *name != "help")
        .collect();
    assert!(names.len() > 20, "{help}");
    for name in names {
        let help = help_of(name).expect("a command");
        let examples: Vec<&str> = help
            .lines()
            .filter_map(|line| line.strip_prefix("  trunnion "))
            .collect();
        let without = ["rules", "man", "lsp"];
        assert_eq!(examples.is_empty(), without.contains(&name), "{name}: {help}");
        // none is so long that it is wrapped
        let shown = help.split("Example").nth(1).unwrap_or_default().lines().skip(1);
        assert_eq!(
            shown.take_while(|line| !line.is_empty()).count(),
            examples.len(),
            "{help}"
        );
        for example in examples {
            let command = example.split("    ").next().unwrap_or_default();
            help_of(command).unwrap_or_else(|said| panic!("{name}: {command}: {said}"));
            assert!(command.starts_with(name), "{name}: {command}");
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
