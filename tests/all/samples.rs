//! The sample programs are what samples/README.md says of them.
use crate::cli::tools::all_findings;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

type Found = BTreeSet<(u64, String)>;

fn programs(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("samples/programs")
        .join(folder);
    let mut all: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    all.sort();
    all
}

/// Verdict of the command line, and the rules with their lines.
fn check(program: &Path, machine: Option<&str>) -> (String, Found, Value) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trunnion"));
    command.args(["check", "--format", "json"]).arg(program);
    if let Some(machine) = machine {
        command.args(["--machine", machine]);
    }
    let output = command.output().expect("the program runs");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let json: Value =
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}: {text}", program.display()));
    let file = json["files"][0].clone();
    let found = all_findings(&file);
    let found = found
        .into_iter()
        .map(|one| {
            (
                one["line"].as_u64().expect("a number"),
                one["rule"].as_str().expect("a text").to_owned(),
            )
        })
        .collect();
    (file["verdict"].as_str().expect("a text").to_owned(), found, file)
}

/// What the comments `expect RULE RULE` of a program announce for the lines after them.
fn expected(program: &Path) -> Found {
    let text = std::fs::read_to_string(program).expect("there");
    let mut expected = Found::new();
    for (i, line) in text.lines().enumerate() {
        let comment = line.trim_start_matches(['(', ';', '$', ' ']);
        if let Some(rules) = comment.strip_prefix("expect ") {
            let rules = rules.trim_end_matches(')').split_whitespace();
            expected.extend(rules.map(|rule| (i as u64 + 2, rule.to_owned())));
        }
    }
    expected
}

#[test]
fn good_programs_pass_and_bad_ones_fail_where_they_say() {
    let all = programs("rules");
    assert_eq!(all.len(), 10);
    for program in all {
        let (verdict, found, _) = check(&program, None);
        assert_eq!(found, expected(&program), "{}", program.display());
        let bad = program.to_str().expect("UTF-8").contains("-bad");
        assert_eq!(
            (verdict.as_str(), found.is_empty()),
            if bad { ("fail", false) } else { ("pass", true) }
        );
    }
}

fn data(folder: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../shared/data")
        .join(folder);
    folder.is_dir().then_some(folder)
}

fn holds(program: &Path, printed: &[u8]) -> bool {
    std::fs::read(program)
        .expect("there")
        .windows(printed.len())
        .any(|part| part == printed)
}

#[test]
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn printed_blocks_are_kept_byte_for_byte() {
    let (Some(vanes), Some(pocket)) = (data("guide-vane-2006"), data("pocket-1999")) else {
        eprintln!("skipped: no data of the papers beside the project");
        return;
    };
    for program in programs("guide-vane") {
        let printed = std::fs::read(vanes.join(program.file_name().expect("there"))).expect("there");
        assert!(holds(&program, &printed), "{}", program.display());
    }
    let printed = std::fs::read(pocket.join("pocket.nc")).expect("there");
    assert!(holds(&programs("pocket")[0], &printed));
}

#[test]
fn guide_vanes_flip_where_the_paper_prints_it() {
    // strategy: blocks with a pole flip, lowest reachable feed
    let known: [(&str, &[&str], f64); 4] = [
        ("strategy-1.mpf", &[], 1640.0),
        ("strategy-2.mpf", &["N2930", "N2940"], 33.0),
        ("strategy-3.mpf", &["N2480"], 205.0),
        ("strategy-4.mpf", &["N1910", "N1920"], 355.0),
    ];
    for (name, flips, feed) in known {
        let program = programs("guide-vane")
            .into_iter()
            .find(|path| path.ends_with(name))
            .expect("there");
        let (_, _, file) = check(&program, Some("mikron-ucp710"));
        let all = all_findings(&file);
        let of = |rule: &str| {
            all.iter()
                .filter(|one| one["rule"] == rule)
                .map(|one| (*one).clone())
                .collect::<Vec<Value>>()
        };
        let blocks: Vec<String> = of("pole-flip")
            .iter()
            .map(|one| one["block"].as_str().expect("a text").to_owned())
            .collect();
        assert_eq!(blocks, flips, "{name}");
        let feeds = of("axis-overspeed")
            .into_iter()
            .map(|one| one["values"]["feed_limit_mm_min"].as_f64().expect("a number"));
        let lowest = feeds.fold(f64::INFINITY, f64::min);
        assert!((lowest - feed).abs() <= 1.0, "{name}: {lowest}");
        let expected = [
            "pole-flip",
            "pole-crossing",
            "fast-pole",
            "axis-overspeed",
            "feed-drop",
            "excess-linear-travel",
            // the planned speed follows from the same event
            "axis-acceleration",
            "feed-oscillation",
            "dwell-mark",
        ];
        assert!(
            all.iter()
                .all(|one| expected.contains(&one["rule"].as_str().expect("a text"))),
            "{name}: {all:#?}"
        );
    }
}

#[test]
fn both_notations_of_a_guide_vane_find_the_same() {
    let all = programs("guide-vane");
    for strategy in 1..=4 {
        let rules = |extension: &str| {
            let program = all
                .iter()
                .find(|path| path.ends_with(format!("strategy-{strategy}.{extension}")))
                .expect("there");
            let (verdict, found, _) = check(program, Some("mikron-ucp710"));
            let mut rules: Vec<String> = found.into_iter().map(|(_, rule)| rule).collect();
            rules.sort();
            (verdict, rules)
        };
        // words are run as they are written; vectors mean the great circle, from which axes that run evenly stray
        let (verdict, mut of_vectors) = rules("apt");
        of_vectors.retain(|rule| rule != "orientation-deviation" && rule != "swept-deviation");
        assert_eq!(rules("mpf"), (verdict, of_vectors), "strategy {strategy}");
    }
}

#[test]
fn the_pocket_runs_on_three_axes() {
    let (verdict, found, file) = check(&programs("pocket")[0], Some("mill-3axis"));
    // the print says G0 in N256 and no G1 until N325: the wall in between is run at rapid
    let rapid = (340, "excess-rapid-travel".to_owned());
    assert_eq!((verdict.as_str(), found), ("pass", Found::from([rapid])));
    // 1405 of the printed blocks move, and three around them
    assert_eq!(file["motions"], 1408);
}

/// With what stands below Z -0.2 in declared as a body, the wall is found: N257 to N323 run in it with both ends (67 rapids), N256 goes down into it and N324 comes
/// out of it.
#[test]
fn the_wall_of_the_pocket_is_cut_in_rapid() {
    let folder = tempfile::TempDir::new().expect("works");
    let program = folder.path().join("pocket.nc");
    std::fs::copy(&programs("pocket")[0], &program).expect("copied");
    let stock = "[[obstacle]]\nname = \"stock\"\nbox = [[-50, -50, -50], [150, 150, -5.08]]\n";
    let assumed = "assume = [\"work-offset\", \"tool-length\"]\n";
    std::fs::write(folder.path().join("trunnion.toml"), format!("{assumed}{stock}")).expect("written");
    let (verdict, _, file) = check(&program, Some("mill-3axis"));
    assert_eq!(verdict, "fail");
    let text = std::fs::read_to_string(&program).expect("there");
    let line = |number: &str| text.lines().position(|line| line.starts_with(number)).expect("there") as u64 + 1;
    let wall: Vec<&Value> = all_findings(&file)
        .into_iter()
        .filter(|found| {
            let at = found["line"].as_u64().expect("a number");
            found["rule"] == "rapid-through-obstacle" && (line("N256")..=line("N324")).contains(&at)
        })
        .collect();
    let [wall] = &wall[..] else { panic!("{wall:?}") };
    assert_eq!(
        (wall["line"].as_u64(), wall["count"].as_u64()),
        (Some(line("N256")), Some(69))
    );
    assert_eq!(wall["severity"], "error");
}

#[test]
fn every_sample_is_named_in_the_readme() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    let readme = std::fs::read_to_string(root.join("README.md")).expect("there");
    let machines = std::fs::read_dir(root.join("machines"))
        .expect("there")
        .map(|entry| entry.expect("an entry").path());
    for path in ["rules", "guide-vane", "pocket"]
        .into_iter()
        .flat_map(programs)
        .chain(machines)
    {
        let name = path
            .strip_prefix(&root)
            .expect("there")
            .to_str()
            .expect("UTF-8")
            .to_owned();
        assert!(
            readme.contains(&name),
            "samples/README.md does not say where {name} comes from"
        );
    }
}
