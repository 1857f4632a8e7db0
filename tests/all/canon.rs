//! `canon` against the expected texts of LinuxCNC's own test programs (../shared/data/linuxcnc-interp, made with `rs274 -g`).
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};
use tempfile::TempDir;

#[expect(clippy::print_stdout, reason = "a test that is skipped says so")]
fn data() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/linuxcnc-interp");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: {} is not there", folder.display());
    None
}

/// A row of runs.tsv.
struct Run<'t> {
    case: &'t str,
    program: &'t str,
    ini: Option<&'t str>,
    tool_table: Option<&'t str>,
    parameters: Option<&'t str>,
    heading: Option<&'t str>,
    output: &'t str,
    exit: &'t str,
}

fn runs(table: &str) -> Vec<Run<'_>> {
    let rows = table.lines().skip(1).filter(|line| !line.is_empty());
    rows.map(|line| {
        let mut fields = line.split('\t').map(|field| (field != "-").then_some(field));
        let mut next = || fields.next().flatten();
        Run {
            case: next().expect("a case"),
            program: next().expect("a program"),
            ini: next(),
            tool_table: next(),
            parameters: next(),
            heading: next(),
            output: next().expect("how the output is treated"),
            exit: next().expect("an exit status"),
        }
    })
    .collect()
}

/// Runs `trunnion canon` in a folder; with `together`, standard error goes where standard output goes.
fn canon(folder: &Path, arguments: &[&str], together: bool) -> (String, Output) {
    let binary = env!("CARGO_BIN_EXE_trunnion");
    let mut command = if together {
        let mut shell = Command::new("sh");
        shell.args(["-c", "exec \"$0\" \"$@\" 2>&1", binary]);
        shell
    } else {
        Command::new(binary)
    };
    let output = command
        .arg("canon")
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .expect("the binary runs");
    (String::from_utf8_lossy(&output.stdout).into_owned(), output)
}

/// Treats an output as the table says.
fn treated(output: &str, text: &str) -> String {
    let zero = |text: &str| text.replace("-0.0000", "0.0000");
    let without_number = |text: &str| -> String {
        let lines = text.lines().map(|line| {
            let fields: Vec<&str> = line.split_whitespace().skip(1).collect();
            [" ", &fields.join(" "), "\n"].concat()
        });
        lines.collect()
    };
    match output {
        "plain" | "both" => text.to_owned(),
        "nonum" => without_number(text),
        "zero" => zero(text),
        "msg0" => {
            let messages = text.lines().filter(|line| line.contains("MESSAGE"));
            let messages = messages.collect::<Vec<_>>().join("\n");
            zero(&without_number(&messages))
        }
        "trim" => text
            .lines()
            .map(|line| {
                let rest = line.trim_start().trim_start_matches(|c: char| c.is_ascii_digit());
                let line = if rest.len() < line.trim_start().len() {
                    rest.strip_prefix(' ').unwrap_or(rest)
                } else {
                    line
                };
                [line, "\n"].concat()
            })
            .collect(),
        other => panic!("runs.tsv names the treatment {other}"),
    }
}

/// A copy of a case's folder: some runs write their parameter file.
fn copy(case: &Path) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    for entry in fs::read_dir(case).expect("the case is there").flatten() {
        if entry.path().is_file() {
            let to = folder.path().join(entry.file_name());
            fs::write(to, fs::read(entry.path()).expect("readable")).expect("writable");
        }
    }
    let template = folder.path().join("g92_offsets.var.template");
    if template.exists() {
        fs::copy(&template, folder.path().join("g92_offsets.var")).expect("writable");
    }
    folder
}

#[test]
fn every_run_gives_the_expected_text() {
    let Some(data) = data() else { return };
    let table = fs::read_to_string(data.join("runs.tsv")).expect("runs.tsv is text");
    let runs = runs(&table);
    let mut cases: Vec<&str> = runs.iter().map(|run| run.case).collect();
    cases.dedup();
    let mut wrong = Vec::new();
    for case in &cases {
        let folder = copy(&data.join(case));
        let mut text = String::new();
        for run in runs.iter().filter(|run| run.case == *case) {
            let mut arguments = vec![run.program];
            for (name, value) in [
                ("--ini", run.ini),
                ("--tool-table", run.tool_table),
                ("--parameters", run.parameters),
            ] {
                arguments.extend(value.into_iter().flat_map(|value| [name, value]));
            }
            let (printed, output) = canon(folder.path(), &arguments, matches!(run.output, "both" | "trim"));
            if let Some(heading) = run.heading {
                text.push_str(heading);
                text.push('\n');
            }
            text.push_str(&treated(run.output, &printed));
            let status = output.status.code().expect("it was not killed");
            let fits = match run.exit {
                "zero" => status == 0,
                "nonzero" => status == 1,
                _ => status < 2,
            };
            if !fits {
                wrong.push(format!("{case}: {} ends with status {status}", run.program));
            }
        }
        let expected = fs::read_to_string(data.join(case).join("expected")).expect("expected is text");
        if let Some(difference) = first_difference(&expected, &text) {
            wrong.push(format!("{case}: {difference}"));
        }
    }
    assert!(cases.len() >= 29, "runs.tsv has {} cases", cases.len());
    assert!(
        wrong.is_empty(),
        "{} of {} cases:\n{}",
        wrong.len(),
        cases.len(),
        wrong.join("\n")
    );
}

/// Two lines are the same but for the sign of a zero, or for a fourth decimal that a tie in the fifth rounded in the other direction: there the
/// last bit of a double decides, which depends on the order of additions.
fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.split([' ', ',', '(', ')']), b.split([' ', ',', '(', ')']));
    let number = |text: &str| text.contains('.').then(|| text.parse::<f64>().ok()).flatten();
    a.clone().count() == b.clone().count()
        && a.zip(b)
            .all(|(a, b)| a == b || matches!((number(a), number(b)), (Some(a), Some(b)) if (a - b).abs() < 1.01e-4))
}

/// The first line that differs, for people.
fn first_difference(expected: &str, text: &str) -> Option<String> {
    if expected == text {
        return None;
    }
    let (mut a, mut b) = (expected.lines(), text.lines());
    for line in 1.. {
        match (a.next(), b.next()) {
            (None, None) => break,
            (a, b) if a == b => {}
            (Some(a), Some(b)) if same(a, b) => {}
            (a, b) => return Some(format!("line {line}\n  expected {a:?}\n  printed  {b:?}")),
        }
    }
    None
}

fn programs(folder: &Path) -> Vec<PathBuf> {
    let mut programs: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder is there")
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "ngc"))
        .collect();
    programs.sort();
    programs
}

#[test]
fn bad_programs_are_refused_with_the_message_of_their_first_line() {
    let Some(data) = data() else { return };
    let programs = programs(&data.join("bad"));
    assert!(programs.len() >= 9, "{} bad programs", programs.len());
    for program in programs {
        let text = fs::read_to_string(&program).expect("text");
        let first = text.lines().next().expect("a first line");
        let wanted = first
            .strip_prefix(';')
            .or_else(|| first.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')))
            .expect("a comment");
        let (_, output) = canon(&data, &[program.to_str().expect("a name")], false);
        let errors = String::from_utf8_lossy(&output.stderr);
        let message = errors.lines().find(|line| *line != "executing");
        assert_eq!(message, Some(wanted), "{}", program.display());
        assert_eq!(output.status.code(), Some(1), "{}", program.display());
    }
}

#[test]
fn good_programs_give_their_expected_text() {
    let Some(data) = data() else { return };
    let programs = programs(&data.join("good"));
    assert!(programs.len() >= 2, "{} good programs", programs.len());
    for program in programs {
        let expected = fs::read_to_string(program.with_extension("expected"))
            .or_else(|_| fs::read_to_string(format!("{}.expected", program.display())))
            .expect("an expected text");
        let (printed, output) = canon(&data, &[program.to_str().expect("a name")], false);
        assert_eq!(first_difference(&expected, &printed), None, "{}", program.display());
        assert_eq!(output.status.code(), Some(0), "{}", program.display());
    }
}

#[test]
fn an_unreadable_file_ends_with_status_2() {
    let folder = TempDir::new().expect("a folder");
    let (printed, output) = canon(folder.path(), &["absent.ngc"], false);
    assert_eq!((printed.as_str(), output.status.code()), ("", Some(2)));
    fs::write(folder.path().join("a.ngc"), "m2\n").expect("writable");
    fs::write(folder.path().join("a.var"), "5162 1\n5161 2\n").expect("writable");
    let (_, output) = canon(folder.path(), &["a.ngc", "--parameters", "a.var"], false);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("line 2: Parameter file out of order"));
}
