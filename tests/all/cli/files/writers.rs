//! Every command that writes files, each with a folder to work in: for kills, full disks and processes beside each other.
use super::{LOOSE, MACHINE, content, folder, names};
use crate::cli::tools::{FLIP, str, text, trunnion_in};
use std::{fmt::Write, fs, path::Path};
use tempfile::TempDir;

/// A command that writes.
pub(super) struct Writer {
    /// Its name in messages.
    pub(super) name: &'static str,
    /// The arguments, in the folder, with spaces between.
    arguments: &'static str,
    /// The files that it writes. Those that are among the inputs are replaced.
    pub(super) outputs: &'static [&'static str],
}

const fn writer(name: &'static str, arguments: &'static str, outputs: &'static [&'static str]) -> Writer {
    Writer {
        name,
        arguments,
        outputs,
    }
}

impl Writer {
    pub(super) fn arguments(&self) -> Vec<&'static str> {
        self.arguments.split_whitespace().collect()
    }
}

/// All of them. In the folder are `loose.nc` (a program whose layout changes), `flip.nc` (one that a rewrite improves), `piece.apt`,
/// `walk.ngc`, `parameters`, `required.toml` and `machine.ini`.
pub(super) const WRITERS: &[Writer] = &[
    writer("fmt", "fmt loose.nc", &["loose.nc"]),
    writer(
        "fix --write",
        "fix flip.nc --rewrite smooth-pole --tolerance-deg 0.08 --write",
        &["flip.nc"],
    ),
    writer(
        "fix --write --backup",
        "fix flip.nc --rewrite smooth-pole --tolerance-deg 0.08 --write --backup",
        &["flip.nc", "flip.nc.bak"],
    ),
    writer(
        "fix -o --certificate",
        "fix flip.nc --rewrite smooth-pole --tolerance-deg 0.08 -o fixed.nc --certificate proof.json",
        &["fixed.nc", "proof.json"],
    ),
    writer(
        "convert -o --certificate",
        "convert piece.apt --to fanuc-30i -o proved.nc --certificate conversion.json",
        &["proved.nc", "conversion.json"],
    ),
    writer(
        "convert -o",
        "convert piece.apt --to fanuc-30i -o piece.nc",
        &["piece.nc"],
    ),
    writer("plot -o", "plot flip.nc --kind joints -o flip.svg", &["flip.svg"]),
    writer(
        "surface --plot",
        "surface flip.nc --required required.toml --reach 1000 --plot map.svg",
        &["map.svg"],
    ),
    writer(
        "canon --parameters",
        "canon walk.ngc --parameters parameters",
        &["parameters", "parameters.bak"],
    ),
    writer("sample -o", "sample s-wall -o wall.apt", &["wall.apt"]),
    writer(
        "sample -o --required",
        "sample s-wall -o wall.apt --required wall.toml",
        &["wall.apt", "wall.toml"],
    ),
    writer(
        "fix --write --certificate",
        "fix flip.nc --rewrite smooth-pole --tolerance-deg 0.08 --write --certificate proof.json",
        &["flip.nc", "proof.json"],
    ),
    writer(
        "fix --rewrite retarget -o",
        "fix flip.nc --rewrite retarget --to sinumerik-840d -o other.mpf",
        &["other.mpf"],
    ),
    writer("report -o", "report flip.nc -o page.html", &["page.html"]),
    writer(
        "check -o",
        "check flip.nc --format sarif -o found.sarif",
        &["found.sarif"],
    ),
    writer(
        "check --write-baseline",
        "check flip.nc --write-baseline known.json",
        &["known.json"],
    ),
    writer("init", "init sub", &["sub/trunnion.toml"]),
    writer(
        "machine import -o",
        "machine import machine.ini -o machine.toml",
        &["machine.toml"],
    ),
];

/// A folder with the inputs of all writers. `lines` of `loose.nc` and `walk.ngc`: so large that a run takes a while.
pub(super) fn prepared(lines: usize) -> TempDir {
    let folder = folder();
    fill(folder.path(), lines);
    folder
}

/// Writes the inputs.
pub(super) fn fill(folder: &Path, lines: usize) {
    let mut loose = LOOSE.replace("M30\n%\n", "");
    let mut walk = String::from("g21 g90 f100\n#31=1\n");
    for i in 0..lines {
        let _ = writeln!(loose, "X{}Y{}", i % 300, i % 170);
        let _ = writeln!(walk, "g1 x{} y{}", i % 300, i % 170);
    }
    loose.push_str("M30\n%\n");
    walk.push_str("m2\n");
    let piece = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs/apt/small-piece.apt"));
    let files: [(&str, Vec<u8>); 8] = [
        (
            "trunnion.toml",
            format!("machine = \"{MACHINE}\"\n[work_offsets]\nG54 = {{ X = 0, Y = 0, Z = 0 }}\n").into(),
        ),
        ("loose.nc", loose.into()),
        ("flip.nc", FLIP.into()),
        ("piece.apt", piece.expect("a sample")),
        ("walk.ngc", walk.into()),
        ("parameters", b"5161\t0.0\n5220\t1.0\n5221\t0.0\n".to_vec()),
        (
            "required.toml",
            b"schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[-100, -100, 50], [100, -100, 50]], [[-100, 100, 50], [100, 100, 50]]]\n".to_vec(),
        ),
        (
            "machine.ini",
            b"[KINS]\nKINEMATICS = xyzac-trt-kins\nJOINTS = 5\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\n"
                .to_vec(),
        ),
    ];
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).expect("written");
    }
    fs::create_dir_all(folder.join("sub")).expect("made");
    fs::write(folder.join("sub/flip.nc"), FLIP).expect("written");
}

/// The outputs of a writer now; `None`: the file is not there.
pub(super) fn outputs(writer: &Writer, folder: &Path) -> Vec<Option<String>> {
    writer
        .outputs
        .iter()
        .map(|name| folder.join(name))
        .map(|path| path.exists().then(|| content(&path)))
        .collect()
}

/// Runs it to its end; its outputs then, all there.
pub(super) fn finished(writer: &Writer, folder: &Path) -> Vec<Option<String>> {
    let output = trunnion_in(folder, &writer.arguments());
    let written = outputs(writer, folder);
    let missing: Vec<_> = writer
        .outputs
        .iter()
        .zip(&written)
        .filter(|(_, text)| text.is_none())
        .collect();
    assert!(
        missing.is_empty(),
        "{}: {missing:?} {}",
        writer.name,
        text(&output.stderr)
    );
    written
}

/// Whether a name is that of a temporary file.
pub(super) fn is_temporary(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".trunnion-tmp")
}

/// Temporary files in a folder and in `sub`.
pub(super) fn temporaries(folder: &Path) -> usize {
    all_names(folder).iter().filter(|name| is_temporary(name)).count()
}

/// Names in a folder and in `sub`.
pub(super) fn all_names(folder: &Path) -> Vec<String> {
    let sub = folder.join("sub");
    let mut all = names(folder);
    if sub.is_dir() {
        all.extend(names(&sub));
    }
    all
}

#[test]
fn every_writer_writes_what_it_names() {
    for writer in WRITERS {
        let folder = prepared(10);
        let before = all_names(folder.path());
        finished(writer, folder.path());
        let named = |name: &String| {
            let written = writer.outputs.iter().map(|path| path.rsplit('/').next());
            written.flatten().any(|own| own == name)
        };
        let new: Vec<_> = all_names(folder.path())
            .into_iter()
            .filter(|name| !before.contains(name))
            .collect();
        assert!(new.iter().all(named), "{}: {new:?}", writer.name);
        // and a second time over what is there
        finished(writer, folder.path());
        assert_eq!(temporaries(folder.path()), 0, "{}", str(folder.path()));
    }
}
