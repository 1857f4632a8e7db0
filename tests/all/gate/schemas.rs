//! The published schemas hold for what commands print and for the files of the repository, and refuse what is wrong.
use super::{check, flip, folder, on_mikron};
use crate::cli::tools::{json, status, str, text, trunnion, write};
use serde_json::{Value, json};
use std::{collections::BTreeSet, fs, path::Path};
use tempfile::TempDir;

const NAMES: [&str; 15] = [
    "check",
    "trace",
    "fix",
    "servo",
    "stats",
    "convert",
    "diff",
    "surface",
    "rules",
    "parse",
    "certificate",
    "conversion",
    "baseline",
    "machine",
    "settings",
];

fn schema(name: &str) -> Value {
    let output = trunnion(&["schema", name]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    json(&output)
}

/// What a document has wrong; the schema itself is checked, too.
fn wrong(name: &str, document: &Value) -> Option<String> {
    let (mut schemas, mut compiler) = (boon::Schemas::new(), boon::Compiler::new());
    compiler.add_resource("schema.json", schema(name)).expect("added");
    let index = compiler
        .compile("schema.json", &mut schemas)
        .unwrap_or_else(|error| panic!("{name}: {error:#}"));
    let wrong = schemas.validate(document, index).err();
    wrong.map(|error| format!("{error:#}"))
}

#[track_caller]
fn holds(name: &str, document: &Value) {
    assert_eq!(wrong(name, document), None, "{name}");
}

#[test]
fn all_are_schemas() {
    for name in NAMES {
        assert!(wrong(name, &json!(5)).is_some(), "{name}");
    }
}

#[test]
fn outputs_obey_them() {
    let folder = folder();
    holds(
        "check",
        &json(&check(
            &folder,
            &[".", "missing.nc", "--format", "json", "--statistics"],
        )),
    );
    check(&folder, &[".", "--write-baseline", "known.json"]);
    let known = fs::read(folder.path().join("known.json")).expect("written");
    holds("baseline", &serde_json::from_slice(&known).expect("JSON"));
    holds(
        "check",
        &json(&check(&folder, &[".", "--format", "json", "--baseline", "known.json"])),
    );

    let folder = TempDir::new().expect("a folder");
    let file = flip(&folder);
    let run = |command: &str, more: &[&str]| {
        let mut arguments = vec![command];
        arguments.extend(on_mikron(&file));
        arguments.extend(["--format", "json"]);
        arguments.extend(more);
        json(&trunnion(&arguments))
    };
    holds("check", &run("check", &[]));
    holds("trace", &run("trace", &[]));
    holds("stats", &run("stats", &[]));
    let certificate = folder.path().join("proof.json");
    let fixed = folder.path().join("fixed.nc");
    let more = [
        "--rewrite",
        "smooth-pole",
        "--tolerance-deg",
        "0.08",
        "-o",
        str(&fixed),
        "--certificate",
        str(&certificate),
    ];
    holds("fix", &run("fix", &more));
    holds(
        "certificate",
        &serde_json::from_slice(&fs::read(&certificate).expect("written")).expect("JSON"),
    );
}

const APT: &str = "PARTNO / A\nMACHIN / B\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 8000, CLW\nRAPID\nGOTO / 0, 0, 100\nFEDRAT / 500, MMPM\nGOTO / 0, 0, 0\nGOTO / 20, 0, 0\nFINI\n";
/// A plane 1 mm below the zero.
const PLANE: &str = "solid plane\nfacet normal 0 0 1\nouter loop\nvertex -100 -100 -1\nvertex 300 -100 -1\nvertex -100 300 -1\nendloop\nendfacet\nendsolid plane\n";

#[test]
fn conversions_and_comparisons_obey_them() {
    let folder = TempDir::new().expect("a folder");
    let apt = write(&folder, "a.apt", APT);
    let (out, proof) = (folder.path().join("a.mpf"), folder.path().join("proof.json"));
    let on = ["--machine", "mill-3axis", "--format", "json"];
    let to = ["convert", str(&apt), "--to", "sinumerik-840d"];
    let files = ["--machine", "mill-3axis", "-o", str(&out), "--certificate", str(&proof)];
    trunnion(&[&to[..], &files].concat());
    let converted = json(&trunnion(&[&to[..], &on].concat()));
    assert_eq!(converted["proof"]["motions_before"], json!(3), "{converted}");
    holds("convert", &converted);
    holds(
        "conversion",
        &serde_json::from_slice(&fs::read(&proof).expect("written")).expect("JSON"),
    );

    // each kind of difference, also in what is no motion, and programs that are not followed
    let program = |name: &str, text: &str| write(&folder, name, text);
    let first = program(
        "b.mpf",
        "N10 G17 G71 G90 G94 G54\nG0 X0 Y0 Z5\nG1 X10 F500\nMSG(\"a\")\nM8\nX20\nM30\n",
    );
    let second = program(
        "c.mpf",
        "G17 G71 G90 G94 G54\nG0 X0 Y0 Z5\nG1 X10 Y2 F600\nZ1\nX20 Y0\nG2 X30 I5 J0\nM30\n",
    );
    let endless = program("d.mpf", "G17 G71 G90 G94\nA:\nG91 G1 X1 F100\nGOTOB A\n");
    for pair in [
        [&first, &second],
        [&second, &first],
        [&first, &first],
        [&endless, &first],
    ] {
        holds(
            "diff",
            &json(&trunnion(&["diff", str(pair[0]), str(pair[1]), "--format", "json"])),
        );
    }
    let plane = write(&folder, "plane.stl", PLANE);
    let part = program(
        "e.mpf",
        "G17 G71 G90 G94 G54\nS1 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX20 Z-1.25\nM30\n",
    );
    let judged = trunnion(
        &[
            &["surface", str(&part), "--required", str(&plane), "--lines", "5"][..],
            &on,
        ]
        .concat(),
    );
    let judged = json(&judged);
    assert_eq!(judged["judged"], json!(1), "{judged}");
    holds("surface", &judged);
    holds("rules", &json(&trunnion(&["rules", "--format", "json"])));
}

#[test]
fn trees_and_tokens_obey_them() {
    let folder = TempDir::new().expect("a folder");
    for (name, text) in [
        (
            "a.mpf",
            "N10 G1 X=R1*(2+SIN(R[3])) A3=0 ; side\n/2 MSG(\"a, b\")\nL: CYCLE800(1,\"T\")\n%\n\"\n",
        ),
        (
            "a.nc",
            "%\nO1 (PART)\nG1 X#1 Y[2+#<_a>/3] Z Z1.2.3\n/G0\nM98 P2\n&?\n%\n",
        ),
        ("a.apt", APT),
        (
            "a.h",
            "0 BEGIN PGM A MM\n1 L X+0 Y+Q1 R0 FMAX\n2 LBL 1\n3 FN 0: Q1 = +2\n4 END PGM A MM\n",
        ),
    ] {
        let file = write(&folder, name, text);
        for more in [&[][..], &["--tokens"]] {
            holds(
                "parse",
                &json(&trunnion(
                    &[&["parse", str(&file), "--format", "json"][..], more].concat(),
                )),
            );
        }
    }
}

fn toml_files(folder: &str) -> Vec<std::path::PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = fs::read_dir(root)
        .expect("a folder")
        .flatten()
        .map(|entry| entry.path());
    files
        .filter(|path| path.extension().is_some_and(|own| own == "toml"))
        .collect()
}

fn toml(path: &Path) -> Value {
    let table: toml::Value = toml::from_str(&fs::read_to_string(path).expect("read")).expect("TOML");
    serde_json::to_value(table).expect("JSON")
}

#[test]
fn machine_and_settings_files_obey_them() {
    let machines = toml_files("samples/machines");
    assert!(machines.len() > 20);
    for path in machines {
        holds("machine", &toml(&path));
    }
    for path in toml_files("samples") {
        holds("settings", &toml(&path));
    }
    holds(
        "settings",
        &toml(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/trunnion.toml")),
    );
}

#[test]
fn what_is_wrong_is_refused() {
    let refuses = |name: &str, document: &Value| wrong(name, document).is_some();
    assert!(refuses("settings", &json!({ "machin": "mill-3axis" })));
    assert!(refuses(
        "settings",
        &json!({ "tool": [{ "number": 1, "diametre": 3.0 }] })
    ));
    assert!(refuses(
        "machine",
        &json!({ "schema": "ncmachine/1", "axis": [{ "letter": 5 }] })
    ));
    let folder = folder();
    let mut document = json(&check(&folder, &[".", "--format", "json"]));
    document["files"][0]["verdict"] = json!("maybe");
    assert!(refuses("check", &document));
}

/// Names of the fields of all structs of a source, as serde reads them.
fn fields(source: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut inside = false;
    let mut renamed = None;
    for line in source.lines() {
        if line.contains("struct ") && line.ends_with('{') {
            inside = !line.starts_with(' ');
        } else if line.starts_with('}') {
            inside = false;
        } else if inside {
            let text = line.trim().trim_start_matches("pub(crate) ").trim_start_matches("pub ");
            if let Some((_, rest)) = text.split_once("rename = \"") {
                renamed = rest.split('"').next().map(str::to_owned);
            } else if let Some((name, _)) = text.split_once(": ")
                && !text.starts_with(['/', '#'])
            {
                found.insert(renamed.take().unwrap_or_else(|| name.to_owned()));
            }
        }
    }
    found
}

fn keys(schema: &Value, found: &mut BTreeSet<String>) {
    if let Some(properties) = schema["properties"].as_object() {
        found.extend(properties.keys().cloned());
    }
    let inner = schema.as_object().into_iter().flat_map(serde_json::Map::values);
    let inner = inner.chain(schema.as_array().into_iter().flatten());
    inner.for_each(|value| keys(value, found));
}

/// A key that a file may have and its schema does not know would be marked as wrong in editors.
#[test]
fn the_schemas_of_files_know_all_keys() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (name, sources) in [
        ("machine", ["src/machine/file/raw.rs", "src/machine/file/obstacle.rs"]),
        (
            "certificate",
            ["src/certify/certificate.rs", "src/certify/certificate.rs"],
        ),
    ] {
        let mut known = BTreeSet::new();
        keys(&schema(name), &mut known);
        let read = |path: &str| fs::read_to_string(root.join(path)).expect("read");
        let wanted: BTreeSet<String> = sources.iter().flat_map(|path| fields(&read(path))).collect();
        let missing: Vec<_> = wanted.difference(&known).collect();
        assert!(wanted.len() > 20 && missing.is_empty(), "{name}: {missing:?}");
    }
}

/// The keys of a schema with their descriptions: those at the top and those of each definition once.
fn described(schema: &Value) -> Vec<(String, String)> {
    let definitions = schema["$defs"]
        .as_object()
        .into_iter()
        .flat_map(serde_json::Map::values);
    let tables = std::iter::once(schema).chain(definitions);
    let all = tables.filter_map(|table| table["properties"].as_object()).flatten();
    let mut all: Vec<_> = all
        .map(|(name, key)| (name.clone(), key["description"].as_str().unwrap_or_default().to_owned()))
        .collect();
    all.sort();
    all
}

/// The pages list exactly the keys of the schemas, with their descriptions, and every key has one.
#[test]
fn the_pages_list_the_keys_of_the_schemas() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (name, page) in [("settings", "docs/settings.md"), ("machine", "docs/machines.md")] {
        let wanted = described(&schema(name));
        assert!(wanted.len() > 60, "{name}");
        let bare: Vec<_> = wanted.iter().filter(|(_, said)| said.is_empty()).collect();
        assert!(bare.is_empty(), "{name}: no description of {bare:?}");
        let text = fs::read_to_string(root.join(page)).expect("read");
        let table = text.split("## All keys").nth(1).expect("the table");
        let row = |line: &str| {
            let (key, said) = line.strip_prefix("| `")?.split_once("` | ")?;
            Some((key.to_owned(), said.strip_suffix(" |")?.to_owned()))
        };
        let mut listed: Vec<_> = table.lines().filter_map(row).collect();
        listed.sort();
        let missing: Vec<_> = wanted.iter().filter(|key| !listed.contains(key)).collect();
        let foreign: Vec<_> = listed.iter().filter(|key| !wanted.contains(key)).collect();
        assert!(
            missing.is_empty() && foreign.is_empty(),
            "{page}: missing {missing:?}; not in the schema {foreign:?}"
        );
        assert_eq!(listed.len(), wanted.len(), "{page}: a key is listed twice");
    }
}
