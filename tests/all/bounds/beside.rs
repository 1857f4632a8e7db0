//! Hostile files beside a program: machines, settings, dialect tables, posts, surfaces, certificates, baselines, tool tables, parameters, INI
//! and FreeCAD files. Each is read or refused with a message.
use super::inputs::Input;
use super::{MOST_BYTES, MOST_SECONDS, measure};
use std::{path::Path, time::Duration};
use tempfile::TempDir;

/// A file beside a program.
struct Beside {
    name: &'static str,
    /// Its name in the folder, which says what it is.
    file: &'static str,
    make: fn(usize) -> Vec<u8>,
}

const fn beside(file: &'static str, name: &'static str, make: fn(usize) -> Vec<u8>) -> Beside {
    Beside { name, file, make }
}

/// What reads it.
fn arguments(file: &str) -> Vec<Vec<&str>> {
    match file {
        "machine.toml" => vec![
            vec!["machine", "show", "machine.toml"],
            vec!["machine", "check", "machine.toml"],
            vec!["machine", "compare", "machine.toml", "mikron-ucp710"],
            vec!["check", "p.nc", "--machine", "machine.toml"],
        ],
        "settings.toml" => vec![
            vec!["check", "p.nc", "--config", "settings.toml"],
            vec!["stats", "p.nc", "--config", "settings.toml"],
        ],
        "table.toml" => vec![vec!["check", "p.nc", "--config", "names-table.toml"]],
        "post.toml" => vec![vec!["convert", "p.nc", "--to", "fanuc-30i", "--post", "post.toml"]],
        "required.toml" => vec![vec!["surface", "p.nc", "--required", "required.toml"]],
        "required.stl" => vec![vec!["surface", "p.nc", "--required", "required.stl"]],
        "certificate.json" => vec![vec!["certify", "p.nc", "p.nc", "--certificate", "certificate.json"]],
        "baseline.json" => vec![vec!["check", "p.nc", "--baseline", "baseline.json"]],
        "tools.tbl" => vec![vec!["canon", "p.nc", "--tool-table", "tools.tbl"]],
        "parameters" => vec![vec!["canon", "p.nc", "--parameters", "parameters"]],
        "machine.ini" => vec![
            vec!["machine", "import", "machine.ini"],
            vec!["canon", "p.nc", "--ini", "machine.ini"],
        ],
        "machine.fcm" => vec![vec!["machine", "import", "machine.fcm"]],
        other => panic!("nothing reads {other}"),
    }
}

/// The sample machine, and more.
fn machine(more: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/machines/mikron-ucp710.toml");
    let own = std::fs::read_to_string(path).expect("a sample");
    format!("{own}\n{more}").into()
}

fn many(n: usize, line: impl Fn(usize) -> String) -> String {
    super::inputs::lines(n, line)
}

fn nested(open: &str, inside: &str, close: &str, n: usize) -> String {
    format!("{}{inside}{}", open.repeat(n), close.repeat(n))
}

const KINS: &str = "[KINS]\nKINEMATICS = xyzac-trt-kins\nJOINTS = 5\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\n";

#[expect(clippy::too_many_lines, reason = "it is one list")]
fn all() -> Vec<Beside> {
    let mut all = vec![
        beside("machine.toml", "axes", |n| {
            machine(&many(n, |_| {
                "[[axis]]\nletter = \"X\"\nkind = \"linear\"\nside = \"head\"\ndir = [1, 0, 0]".to_owned()
            }))
        }),
        beside("machine.toml", "checks", |n| {
            machine(&many(n, |i| {
                format!(
                    "[[check]]\nsay = \"c{i}\"\njoints = {{ X = {0} }}\ntool_length = 100\ntip = [{0}, 0, -100]",
                    i % 300
                )
            }))
        }),
        beside("machine.toml", "obstacles", |n| {
            machine(&many(n, |i| {
                format!(
                    "[[obstacle]]\nname = \"o{i}\"\naxis = \"C\"\nbox = [[{0}, 50, 0], [{1}, 60, 9]]",
                    i % 300,
                    i % 300 + 1
                )
            }))
        }),
        beside("machine.toml", "a-polygon", |n| {
            let corners = many(n, |i| format!("[{}, {}],", 50 + i % 300, i));
            machine(&format!("[[obstacle]]\npolygon = [\n{corners}]\nz = [0, 30]\n"))
        }),
        beside("machine.toml", "sources", |n| {
            format!("sources = [\n{}]\n", many(n, |i| format!("\"source {i}\","))).into()
        }),
        beside("machine.toml", "far-numbers", |n| {
            machine(&many(n, |i| format!("[t{i}]\na = {i}e999\nb = -inf\nc = nan")))
        }),
        beside("settings.toml", "tools", |n| {
            many(n, |i| {
                format!("[[tool]]\nnumber = {i}\nshape = \"ball\"\ndiameter = 10\nlength = 100")
            })
            .into()
        }),
        beside("settings.toml", "offsets", |n| {
            format!(
                "[work_offsets]\n{}",
                many(n, |i| format!("G{i} = {{ X = {i}, Y = 0, Z = 0 }}"))
            )
            .into()
        }),
        beside("settings.toml", "obstacles", |n| {
            many(n, |i| {
                format!(
                    "[[obstacle]]\ncylinder = {{ centre = [{}, 80], radius = 12.5, z = [0, 60] }}",
                    i % 300
                )
            })
            .into()
        }),
        beside("settings.toml", "variables", |n| {
            format!("[variables]\n{}", many(n, |i| format!("\"#{}\" = {i}", i + 500))).into()
        }),
        beside("settings.toml", "rules", |n| {
            format!("[rules]\n{}", many(n, |i| format!("missing-feed{i} = \"allow\""))).into()
        }),
        beside("settings.toml", "paths", |n| {
            format!("subprogram_path = [\n{}]\n", many(n, |i| format!("\"folder/{i}/..\","))).into()
        }),
        beside("table.toml", "codes", |n| {
            format!(
                "name = \"own\"\ntitle = \"own\"\nsource = \"own\"\nextends = \"fanuc-30i\"\n[codes]\n{}",
                many(n, |i| format!(
                    "M{} = {{ action = \"no-motion\", words = [\"Q\"], doc = \"d\" }}",
                    i + 1000
                ))
            )
            .into()
        }),
        beside("table.toml", "extends-itself", |_| {
            b"name = \"own\"\nextends = \"own\"\n".to_vec()
        }),
        beside("post.toml", "templates", |n| {
            format!(
                "dialect = \"fanuc-30i\"\nextends = \"fanuc-30i\"\nextension = \"nc\"\nsource = \"own\"\n[templates]\nheader = \"\"\"\n{}\"\"\"\n",
                many(n, |i| format!("({{title}} {i})"))
            )
            .into()
        }),
        beside("required.toml", "rows", |n| {
            let rows = many(n, |i| format!("[[{i}, 0, 0], [{i}, 1, 0]],"));
            format!("schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [\n{rows}]\n").into()
        }),
        beside("required.toml", "grids", |n| {
            let grids = many(n, |i| {
                format!("[[grid]]\nrows = [[[{i}, 0, 0], [{i}, 9, 0]], [[1, 0, 0], [1, 9, 1e300]]]")
            });
            format!("schema = \"trunnion-surface/1\"\n{grids}").into()
        }),
        beside("required.stl", "facets", |n| {
            let facets = many(n, |i| {
                format!(
                    "facet normal 0 0 1\nouter loop\nvertex {} 0 0\nvertex 10 0 0\nvertex 0 10 {}\nendloop\nendfacet",
                    i % 100,
                    i % 7
                )
            });
            format!("solid s\n{facets}endsolid s\n").into()
        }),
        beside("required.stl", "a-count-that-lies", |n| {
            [vec![b'b'; 80], u32::MAX.to_le_bytes().to_vec(), vec![1; n]].concat()
        }),
        beside("required.stl", "binary", |n| {
            let mut bytes = vec![b'b'; 80];
            bytes.extend((n as u32).to_le_bytes());
            for i in 0..n {
                for value in [
                    0.0,
                    0.0,
                    1.0,
                    (i % 99) as f32,
                    0.0,
                    0.0,
                    1.0,
                    0.0,
                    0.0,
                    0.0,
                    1.0,
                    f32::MAX,
                ] {
                    bytes.extend(value.to_le_bytes());
                }
                bytes.extend([0, 0]);
            }
            bytes
        }),
        beside("certificate.json", "steps", |n| {
            let step = r#"{"rewrite": "x", "edits": [{"start": 0, "end": 0, "text": "a"}], "certificate": {}},"#;
            format!(
                "{{\"schema\": \"trunnion-certificates/1\", \"steps\": [{}null]}}",
                step.repeat(n)
            )
            .into()
        }),
        beside("certificate.json", "keys", |n| {
            format!(
                "{{\"schema\": \"trunnion-certificate/2\", {} \"a\": 1}}",
                many(n, |i| format!("\"k{i}\": {i},"))
            )
            .into()
        }),
        beside("baseline.json", "findings", |n| {
            let finding = r#"{"path": "p.nc", "rule": "missing-feed", "block": "0", "count": 1},"#;
            format!(
                "{{\"schema\": \"trunnion-baseline/1\", \"findings\": [{}null]}}",
                finding.repeat(n)
            )
            .into()
        }),
        beside("tools.tbl", "tools", |n| {
            many(n, |i| format!("T{i} P{i} D3.{i} Z+10.5 ;tool {i}")).into()
        }),
        beside("parameters", "parameters", |n| {
            many(n, |i| format!("{}\t{i}.0", i + 1)).into()
        }),
        beside("machine.ini", "sections", |n| {
            format!(
                "{KINS}{}",
                many(n, |i| format!("[AXIS_{i}]\nMIN_LIMIT = -{i}\nMAX_LIMIT = 1e999"))
            )
            .into()
        }),
        beside("machine.ini", "one-section-many-times", |n| {
            format!(
                "{KINS}{}",
                "[AXIS_X]\nMIN_LIMIT = -1\n[JOINT_0]\nMAX_VELOCITY = 1\n".repeat(n)
            )
            .into()
        }),
        beside("machine.ini", "commands", |n| {
            format!(
                "{KINS}[HAL]\n{}",
                many(n, |i| format!(
                    "HALCMD = setp xyzac-trt-kins.x-offset {i}\nHALFILE = a{i}.hal"
                ))
            )
            .into()
        }),
        beside("machine.ini", "includes-itself", |n| {
            format!("{KINS}{}", "#INCLUDE machine.ini\n".repeat(n)).into()
        }),
        beside("machine.ini", "continued", |n| {
            format!("{KINS}A = 1 {}\n", "\\\n".repeat(n)).into()
        }),
        beside("machine.fcm", "axes", |n| {
            let axes = many(n, |i| {
                format!("\"X{i}\": {{\"type\": \"linear\", \"min\": 0, \"max\": 1e999}},")
            });
            format!("{{\"machine\": {{\"name\": \"m\", \"units\": \"metric\", \"axes\": {{{axes} \"X\": null}}}}}}")
                .into()
        }),
    ];
    for file in [
        "machine.toml",
        "settings.toml",
        "table.toml",
        "post.toml",
        "required.toml",
        "required.stl",
        "certificate.json",
        "baseline.json",
        "tools.tbl",
        "parameters",
        "machine.ini",
        "machine.fcm",
    ] {
        all.extend([
            beside(file, "nothing", |_| Vec::new()),
            beside(file, "nul-bytes", |n| vec![0; 10 * n]),
            beside(file, "no-text", |n| vec![0xff; 10 * n]),
            beside(file, "newlines", |n| vec![b'\n'; 10 * n]),
            beside(file, "one-line", |n| vec![b'a'; 10 * n]),
            beside(file, "arrays-in-arrays", |n| {
                format!("a = {}", nested("[", "1", "]", n)).into()
            }),
            beside(file, "tables-in-tables", |n| {
                format!("a = {}", nested("{ a = ", "1", " }", n)).into()
            }),
            beside(file, "objects-in-objects", |n| nested("{\"a\":", "1", "}", n).into()),
            beside(file, "open-lists", |n| "[".repeat(n).into()),
            beside(file, "dotted-keys", |n| format!("{}a = 1\n", "a.".repeat(n)).into()),
            beside(file, "dotted-headers", |n| {
                format!("[{}a]\nb = 1\n", "a.".repeat(n)).into()
            }),
            beside(file, "unknown-keys", |n| many(n, |i| format!("key{i} = {i}")).into()),
            beside(file, "unknown-tables", |n| {
                many(n, |i| format!("[[table{}]]\na = {i}", i % 9)).into()
            }),
            beside(file, "a-long-text", |n| {
                format!("name = \"{}\"\n", "é".repeat(n)).into()
            }),
            beside(file, "an-open-text", |n| {
                format!("name = \"\"\"{}", "x\n".repeat(n)).into()
            }),
            beside(file, "digits", |n| format!("schema = {}\n", "1".repeat(n)).into()),
        ]);
    }
    all
}

/// A program that uses what the files declare.
const PROGRAM: &str = "G21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG43 H1\nF100.\nG1 X0. Y0. Z50.\nX10.\nM2\n";

#[test]
fn every_file_beside_a_program_is_read_or_refused() {
    let form = super::Form::asked();
    // settings and tables have no bound of elements: the large form is as large as a file may be
    let size = if form.long { 400_000 } else { 300 };
    let folder = TempDir::new().expect("a folder");
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("written");
    write("p.nc", PROGRAM.as_bytes());
    write("trunnion.toml", super::SETTINGS.as_bytes());
    write("names-table.toml", b"dialect_table = \"table.toml\"\n");
    let (mut wrong, mut taken, mut results) = (Vec::new(), [0; 3], Vec::new());
    for beside in all() {
        let mut bytes = (beside.make)(size);
        bytes.truncate(Input::MOST_BYTES);
        write(beside.file, &bytes);
        for arguments in arguments(beside.file) {
            let name = format!("{} {} {}", arguments[..2].join(" "), beside.name, beside.file);
            if !form.asks_for(&name) {
                continue;
            }
            let arguments: Vec<String> = arguments.into_iter().map(str::to_owned).collect();
            let patience = Duration::from_secs(if form.long { 30 } else { 300 });
            let measured = measure::run(folder.path(), &arguments, Vec::new(), patience);
            let said = &measured.said;
            let fault = match measured.status {
                Some(status @ 0..=2) if !said.contains("panicked") => {
                    taken[status as usize] += 1;
                    if status == 2 && !said.contains("error:") {
                        Some("exit status 2 without a message".to_owned())
                    } else if form.long && measured.seconds > MOST_SECONDS {
                        Some(format!("took {:.1} s", measured.seconds))
                    } else if form.long && measured.bytes > MOST_BYTES {
                        Some(format!("took {} MB", measured.bytes / 1_000_000))
                    } else {
                        None
                    }
                }
                status => Some(format!("exit status {status:?}: {said}")),
            };
            wrong.extend(fault.map(|fault| format!("{name}: {fault}")));
            results.push((name, measured.seconds, measured.bytes));
        }
        std::fs::remove_file(folder.path().join(beside.file)).expect("removed");
    }
    if form.long {
        super::table(results);
    }
    assert!(wrong.is_empty(), "{} files:\n{}", wrong.len(), wrong.join("\n"));
    if form.only.is_none() {
        // most are refused, and some of each sort are read
        assert!(taken[2] > 100 && taken[0] + taken[1] > 20, "{taken:?}");
    }
}
