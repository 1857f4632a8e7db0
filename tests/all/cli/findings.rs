//! How findings are worded on the command line, how they are silenced, and dialect tables of your own.

use super::tools::{json, status, str, text, trunnion, write};
use std::path::Path;
use tempfile::TempDir;

const LOOP: &str = "\
G21 G90 G17 G94
#1=0
O1 WHILE [#1 LT 4]
 X[#1*10.] G1
#1=[#1+1]
O1 ENDWHILE
G2 X1. Y1. R1.
G2 X2. Y2. R1.
M2
";

/// Exit status and findings; `a.ngc` is read as LinuxCNC, `a.nc` as Fanuc.
fn check(folder: &TempDir, name: &str, program: &str, more: &[&str]) -> (i32, String) {
    let file = write(folder, name, program);
    let ngc = file.extension().is_some_and(|end| end == "ngc");
    let dialect = if ngc { "linuxcnc" } else { "fanuc-30i" };
    let output = trunnion(&[&["check", "-q", str(&file), "--dialect", dialect], more].concat());
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    (status(&output), text(&output.stdout).replace(str(&file), name))
}

#[test]
fn what_a_loop_repeats_is_counted_by_times() {
    let folder = TempDir::new().expect("works");
    let (code, found) = check(&folder, "a.ngc", LOOP, &["--format", "short"]);
    assert_eq!(code, 1);
    let line = found.lines().find(|line| line.starts_with("a.ngc:4:")).expect("there");
    assert!(
        line.contains("[missing-feed]") && line.ends_with("(4 times)"),
        "{found}"
    );
    let (_, found) = check(&folder, "a.ngc", LOOP, &["--format", "pretty"]);
    assert!(found.contains("(4 times)") && !found.contains("in a row"), "{found}");
}

#[test]
fn the_place_above_an_excerpt_is_that_of_the_finding() {
    let folder = TempDir::new().expect("works");
    let (_, short) = check(&folder, "a.ngc", LOOP, &["--format", "short"]);
    let (_, pretty) = check(&folder, "a.ngc", LOOP, &["--format", "pretty"]);
    let places = short
        .lines()
        .filter_map(|line| line.split_once(": ").map(|(place, _)| place));
    // above an excerpt, or before the message of a finding that has none
    let shown = pretty.lines().filter_map(|line| {
        let excerpt = || line.split_once("\u{256d}\u{2500}[")?.1.strip_suffix(']');
        let compact = || {
            let (head, rest) = line.split_once("] ")?;
            (!head.starts_with(' ') && head.contains('[')).then(|| rest.split_once(": "))?
        };
        excerpt().or_else(|| compact().map(|(place, _)| place))
    });
    assert_eq!(places.collect::<Vec<_>>(), shown.collect::<Vec<_>>(), "{pretty}");
}

#[test]
fn a_finding_is_silenced_with_a_reason_only() {
    let folder = TempDir::new().expect("works");
    let program = |comment: &str| format!("G21 G90 G17 G94 S900 M3\nG1 X1. {comment}\nM30\n");
    let run = |comment: &str| {
        let (code, found) = check(&folder, "a.nc", &program(comment), &["--allow", "machine-unset"]);
        let rule = |line: &str| line.split(['[', ']']).nth(1).map(str::to_owned);
        (code, found.lines().filter_map(rule).collect::<Vec<_>>())
    };
    let rules = |rules: &[&str]| rules.iter().map(|&rule| rule.to_owned()).collect::<Vec<_>>();
    assert_eq!(run(""), (1, rules(&["missing-feed"])));
    assert_eq!(
        run("(trunnion: allow missing-feed because the loader sets F)"),
        (0, rules(&[]))
    );
    assert_eq!(
        run("(trunnion: allow missing-feed)"),
        (1, rules(&["missing-feed", "broken-directive"]))
    );
    assert_eq!(
        run("(trunnion: allow no-such-rule because of this)"),
        (1, rules(&["missing-feed", "broken-directive"]))
    );
}

fn sample(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("samples/dialects")
        .join(path);
    str(&path).to_owned()
}

#[test]
fn dialect_tables_of_one_s_own_add_the_builder_s_codes() {
    // file, dialect, the base's name, lines that the base does not know
    let samples: [(&str, &str, &str, &[u64]); 2] = [
        ("fanuc-shop/conveyor.nc", "shop-mill", "fanuc-30i", &[8, 9, 14]),
        // one finding for both blocks with M410
        ("linuxcnc-shop/pallet.ngc", "shop-linuxcnc", "linuxcnc", &[4, 7]),
    ];
    for (name, dialect, base, lines) in samples {
        let file = sample(name);
        let output = trunnion(&["check", "--strict", "--format", "json", &file]);
        let document = json(&output);
        assert_eq!(document["files"][0]["dialect"], dialect);
        assert_eq!(document["files"][0]["verdict"], "pass", "{document:#}");
        assert_eq!(document["files"][0]["diagnostics"], serde_json::json!([]), "{name}");
        let document = json(&trunnion(&["check", "--format", "json", "--dialect", base, &file]));
        let unknown = document["files"][0]["diagnostics"].as_array().expect("a list").iter();
        let unknown = unknown.filter(|one| one["rule"] == "unknown-code");
        let found: Vec<u64> = unknown.map(|one| one["line"].as_u64().expect("a line")).collect();
        assert_eq!(found, lines, "{name}");
    }
}

#[test]
fn a_remap_that_is_not_modelled_leaves_the_verdict_open() {
    let folder = TempDir::new().expect("works");
    let file = write(
        &folder,
        "a.ngc",
        "g21 g90 g17 g94 g54\ng0 x0 y0 z5\ng88.1 x1 y2 z-3 r1 p2\nm2\n",
    );
    write(
        &folder,
        "trunnion.toml",
        &format!("dialect_table = {:?}\n", sample("shop-linuxcnc.toml")),
    );
    let document = json(&trunnion(&["check", "--format", "json", str(&file)]));
    let found = document["files"][0]["diagnostics"].as_array().expect("a list").iter();
    let found: Vec<_> = found.filter(|one| one["rule"] != "machine-unset").collect();
    assert_eq!(found.len(), 1, "{document:#}");
    assert_eq!(
        (&found[0]["rule"], &found[0]["line"]),
        (&"not-modelled".into(), &3.into())
    );
}
