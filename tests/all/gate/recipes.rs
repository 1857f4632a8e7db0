//! The recipes for CI run here as they stand in the repository: they fail on a bad program and pass with the baseline.
use super::folder;
use crate::cli::tools::text;
use std::{fs, path::Path, process::Command};
use tempfile::TempDir;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A `PATH` on which `trunnion` is the one that was built.
fn path() -> std::ffi::OsString {
    let built = Path::new(env!("CARGO_BIN_EXE_trunnion")).parent().expect("a folder");
    let mut all = vec![built.to_owned()];
    all.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    std::env::join_paths(all).expect("a path")
}

/// Runs a shell script in a folder; its status and what it said.
fn shell(folder: &TempDir, script: &str, variables: &[(&str, &str)]) -> (i32, String) {
    let mut command = Command::new("bash");
    command
        .args(["-euo", "pipefail", "-c", script])
        .current_dir(folder.path())
        .env("PATH", path());
    let output = command.envs(variables.iter().copied()).output().expect("bash runs");
    (
        output.status.code().expect("not killed"),
        text(&output.stdout) + &text(&output.stderr),
    )
}

/// The script under `run: |` of the step with a name.
fn step(yaml: &str, name: &str) -> String {
    let after = yaml
        .split(&format!("- name: {name}"))
        .nth(1)
        .unwrap_or_else(|| panic!("no step {name}"));
    let body = after.split("run: |\n").nth(1).expect("a script");
    let indent = body.len() - body.trim_start().len();
    let lines = body
        .lines()
        .take_while(|line| line.trim().is_empty() || line.len() - line.trim_start().len() >= indent);
    lines
        .map(|line| line.get(indent..).unwrap_or_default())
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn the_github_action_fails_on_a_bad_program_and_passes_with_the_baseline() {
    let yaml = fs::read_to_string(root().join("action.yml")).expect("read");
    let script = step(&yaml, "Check the programs");
    let folder = folder();
    let variables = |baseline: &'static str| {
        [
            ("PATHS", "."),
            ("ARGUMENTS", ""),
            ("BASELINE", baseline),
            ("SARIF", "trunnion.sarif"),
            ("GITHUB_STEP_SUMMARY", "summary.md"),
        ]
    };
    let (status, said) = shell(&folder, &script, &variables(""));
    assert_eq!(status, 1, "{said}");
    assert!(said.contains("::error file=./bad.nc"), "{said}");
    assert!(folder.path().join("trunnion.sarif").is_file());
    assert!(
        fs::read_to_string(folder.path().join("summary.md"))
            .expect("written")
            .contains("FAIL")
    );
    shell(&folder, "trunnion check . --write-baseline known.json", &[]);
    let (status, said) = shell(&folder, &script, &variables("known.json"));
    assert_eq!(status, 0, "{said}");
    // a baseline that is not there: an annotation, and a file that the next step can upload
    fs::remove_file(folder.path().join("trunnion.sarif")).expect("removed");
    let (status, said) = shell(&folder, &script, &variables("wrong.json"));
    assert_eq!(status, 2, "{said}");
    assert!(
        said.contains("::error title=not checked::wrong.json: does not exist"),
        "{said}"
    );
    let written = fs::read_to_string(folder.path().join("trunnion.sarif")).expect("written");
    assert!(written.contains("\"executionSuccessful\":false"), "{written}");
}

#[test]
fn the_pre_commit_hook_fails_on_a_bad_program_and_passes_with_the_baseline() {
    let yaml = fs::read_to_string(root().join(".pre-commit-hooks.yaml")).expect("read");
    let entry = yaml
        .lines()
        .find_map(|line| line.trim().strip_prefix("entry: "))
        .expect("an entry");
    let types: Vec<&str> = yaml
        .lines()
        .filter_map(|line| line.trim().strip_prefix("files: "))
        .collect();
    assert_eq!(types.len(), yaml.matches("- id: ").count());
    let folder = folder();
    // pre-commit adds the names of the files
    let (status, said) = shell(&folder, &format!("{entry} bad.nc good.nc"), &[]);
    assert_eq!(status, 1, "{said}");
    assert_eq!(shell(&folder, &format!("{entry} good.nc"), &[]).0, 0);
    shell(&folder, "trunnion check . --write-baseline known.json", &[]);
    let (status, said) = shell(&folder, &format!("{entry} --baseline known.json bad.nc good.nc"), &[]);
    assert_eq!(status, 0, "{said}");
}

/// pre-commit hands over the files whose names match: each kind of file in which `check` looks for programs.
#[test]
fn the_pre_commit_hook_gets_every_program() {
    let yaml = fs::read_to_string(root().join(".pre-commit-hooks.yaml")).expect("read");
    let mut known = trunnion_dialect::program_extensions();
    known.sort_unstable();
    known.dedup();
    assert!(
        known
            .iter()
            .all(|ending| ending.bytes().all(|byte| byte.is_ascii_alphanumeric()))
    );
    let wanted = format!(r"  files: (?i)\.({})(\.[0-9]+)?$", known.join("|"));
    assert!(yaml.lines().any(|line| line == wanted), "the pattern must be\n{wanted}");
}

#[test]
fn the_hook_after_posting_reports_what_it_found() {
    let hook = root().join("integrations/freecad/trunnion_check.py");
    let folder = folder();
    let run = |name: &str, arguments: &str| {
        shell(
            &folder,
            &format!("python3 '{}' {name} {arguments}", hook.display()),
            &[],
        )
    };
    let (status, said) = run("bad.nc", "");
    assert_eq!(status, 1, "{said}");
    assert!(said.contains("missing-feed"), "{said}");
    assert_eq!(run("good.nc", "").0, 0);
    shell(&folder, "trunnion check . --write-baseline known.json", &[]);
    assert_eq!(run("bad.nc", "--baseline known.json").0, 0);
}

/// The macro in FreeCAD, started with a document as on Windows. Its modules are stood in for: a dialog that answers, a console that is read.
#[test]
fn the_macro_in_freecad_asks_for_the_program_and_writes_into_the_report_view() {
    let hook = root().join("integrations/freecad/trunnion_check.py");
    let folder = folder();
    let stand_in = r#"
import runpy, sys, types
def module(name, **what):
    sys.modules[name] = types.SimpleNamespace(**what)
write = lambda kind: lambda text: print(kind, text)
console = types.SimpleNamespace(PrintMessage=write("message:"), PrintError=write("error:"))
module("FreeCAD", Console=console)
dialog = types.SimpleNamespace(getOpenFileName=lambda *_: (NAME, ""))
module("PySide", QtGui=types.SimpleNamespace(QFileDialog=dialog))
sys.argv = ["C:/FreeCAD/bin/FreeCAD.exe", "part.FCStd"]
runpy.run_path(HOOK, run_name="__main__")
"#;
    for (name, kind) in [("bad.nc", "error:"), ("good.nc", "message:")] {
        let code = stand_in
            .replace("NAME", &format!("{name:?}"))
            .replace("HOOK", &format!("{:?}", hook.display().to_string()));
        fs::write(folder.path().join("macro.py"), code).expect("written");
        let (status, said) = shell(&folder, "python3 macro.py", &[]);
        assert!(status == 0 && said.starts_with(kind), "{status}: {said}");
        assert_eq!(said.contains("missing-feed"), name == "bad.nc", "{said}");
    }
}

/// The job of the page for GitLab, as it stands there.
#[test]
fn the_gitlab_job_fails_on_a_bad_program_and_passes_with_the_baseline() {
    let page = fs::read_to_string(root().join("docs/ci.md")).expect("read");
    let job = page.split("## GitLab").nth(1).and_then(|rest| rest.split("```").nth(1));
    let script: Vec<&str> = job
        .expect("a job")
        .lines()
        .filter_map(|line| line.trim().strip_prefix("- "))
        .collect();
    assert_eq!(script.len(), 1, "{script:?}");
    let folder = folder();
    let programs = folder.path().join("programs");
    fs::create_dir(&programs).expect("made");
    fs::rename(folder.path().join("bad.nc"), programs.join("bad.nc")).expect("moved");
    // nothing is accepted yet
    let good = "trunnion check good.nc --write-baseline programs/baseline.json";
    shell(&folder, good, &[]);
    let (status, said) = shell(&folder, script[0], &[]);
    assert_eq!(status, 1, "{said}");
    let report = fs::read_to_string(folder.path().join("trunnion.xml")).expect("written");
    assert!(report.contains("<failure"), "{report}");
    // as the tutorial does, in the folder of the programs
    let tutorial = fs::read_to_string(root().join("docs/tutorials/ci.md")).expect("read");
    let accept = tutorial.lines().find(|line| line.contains("--write-baseline"));
    let accept = format!("cd programs && {}", accept.expect("a command"));
    assert_eq!(shell(&folder, &accept, &[]).0, 0);
    let (status, said) = shell(&folder, script[0], &[]);
    assert_eq!(status, 0, "{said}");
    // a mistake in the job: the report says so
    let (status, _) = shell(&folder, &script[0].replace("--baseline", "--base-line"), &[]);
    assert_eq!(status, 2);
    let report = fs::read_to_string(folder.path().join("trunnion.xml")).expect("written");
    assert!(report.contains("<error type=\"not-checked\""), "{report}");
    // the other recipes of the page name the same baseline
    assert_eq!(page.matches("programs/baseline.json").count(), 3);
}
