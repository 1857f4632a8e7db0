//! The tutorials as a new user follows them: each command runs, and a page says which of them end with status 1.
use std::{fs, path::Path, process::Command};
use tempfile::TempDir;

/// The commands of a page: for each block of them its text, and whether the sentence before it says that it ends with status 1.
fn blocks(page: &str) -> Vec<(String, bool)> {
    let mut found = Vec::new();
    let mut before = "";
    for (at, part) in page.split("```").enumerate() {
        if at.is_multiple_of(2) {
            before = part.trim().rsplit("\n\n").next().unwrap_or_default();
        } else if let Some(text) = part.strip_prefix("sh\n") {
            found.push((text.to_owned(), before.contains("status 1")));
        }
    }
    found
}

fn follow(name: &str, own_folder: bool) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("docs/tutorials").join(name)).expect("read");
    let folder = TempDir::new().expect("a folder");
    if !own_folder {
        // the files that the page names, without the repository being written to
        let samples = folder.path().join("samples/programs/guide-vane");
        fs::create_dir_all(&samples).expect("made");
        for entry in fs::read_dir(root.join("samples/programs/guide-vane"))
            .expect("read")
            .flatten()
        {
            fs::copy(entry.path(), samples.join(entry.file_name())).expect("copied");
        }
    }
    let built = Path::new(env!("CARGO_BIN_EXE_trunnion")).parent().expect("a folder");
    let mut script = format!("PATH='{}':$PATH\n", built.display());
    let blocks = blocks(&page);
    assert!(blocks.len() >= 4, "{name}: {} blocks", blocks.len());
    for (text, fails) in &blocks {
        let last = text.trim_end();
        let line = if *fails {
            let shown = last.replace('"', "'");
            format!(
                "status=0\n{last} || status=$?\n[ $status = 1 ] || {{ echo \"status $status: {shown}\"; exit 9; }}\n"
            )
        } else {
            format!("{last}\n")
        };
        script.push_str(&line);
    }
    let output = Command::new("bash")
        .args(["-e", "-c", &script])
        .current_dir(folder.path())
        .output()
        .expect("bash runs");
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {said}\n{script}");
}

#[test]
fn three_axes() {
    follow("three-axis.md", true);
}

#[test]
fn five_axes() {
    follow("five-axis.md", false);
}

#[test]
fn a_gate_in_ci() {
    follow("ci.md", true);
}
