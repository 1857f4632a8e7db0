//! Annotations of a workflow: what stands below them.
use super::{check, folder};
use crate::cli::tools::{text, write};

/// The file of `-o` has the verdicts, and what was not covered, below the annotations.
#[test]
fn annotations_in_a_file_say_what_was_not_covered() {
    let folder = folder();
    write(
        &folder,
        "sub.nc",
        &super::GOOD.replace("M30\n", "M30\nO7\nG1 X5. F100.\nM99\n"),
    );
    for arguments in [
        &[".", "--format", "github", "-o", "out.txt"][..],
        &["-q", ".", "--format", "github", "-o", "out.txt"],
    ] {
        check(&folder, arguments);
        let file = std::fs::read_to_string(folder.path().join("out.txt")).expect("written");
        for wanted in [
            "\nFAIL ./bad.nc",
            "\nPASS ./good.nc on mill-3axis: 9 of 9 blocks run",
            "\n  not judged: corner-error: the machine file does not declare ",
            "\n  not run: lines 11 to 13: subprogram-not-called\n",
            "\n  assumed: the length of tool 1 = 0",
            "\n3 files: ",
        ] {
            assert!(file.contains(wanted), "{wanted:?} {file}");
        }
    }
    let printed = text(&check(&folder, &[".", "--format", "github"]).stdout);
    assert!(printed.contains("\n  not judged: corner-error"), "{printed}");
}
