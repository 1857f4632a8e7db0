//! The fuzz targets without a fuzzer: each of them on the seeds, and on mutations of them. `TRUNNION_MUTATIONS` sets how many.
use crate::mutated_formats::mutations;
use crate::random::Random;
use std::{fs, path::Path};

#[path = "../../fuzz/targets.rs"]
mod targets;

fn file(path: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("there")
}

/// The seeds, each with the byte in front that selects the dialect.
fn seeds() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .expect("there")
        .map(|entry| entry.expect("readable").path())
        .collect();
    paths.sort();
    let seeds: Vec<_> = paths.iter().map(|path| fs::read(path).expect("readable")).collect();
    assert!(seeds.len() > 20, "{} seeds", seeds.len());
    seeds
}

/// The first byte of a seed selects the dialect that its name says: a dialect that is added must not move the others.
#[test]
fn seeds_select_the_dialect_of_their_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds");
    let mut dialects = std::collections::BTreeSet::new();
    for entry in fs::read_dir(folder).expect("there") {
        let path = entry.expect("readable").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let first = fs::read(&path).expect("readable")[0];
        let dialect = targets::dialect_of(first);
        let (stem, _) = name.rsplit_once('-').expect("NAME-NUMBER");
        // the turned part among the seeds of a Fanuc is in code system A
        assert!(dialect.contains(stem) || name == "fanuc-7", "{name} selects {dialect}");
        dialects.insert(dialect);
    }
    for control in [
        "apt",
        "heidenhain-klartext",
        "okuma-osp",
        "sinumerik-840d",
        "fanuc-30i",
        "haas-ngc",
        "linuxcnc",
    ] {
        assert!(dialects.contains(control), "no seed for {control}");
    }
}

/// Files of each format, each with the byte in front that selects it.
fn formats() -> Vec<Vec<u8>> {
    let files: [Vec<u8>; 8] = [
        file("samples/machines/mikron-ucp710.toml"),
        b"machine = \"mikron-ucp710\"\n[limits]\nsteps = 5\n[[tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 10\n".to_vec(),
        file("grammar/dialects/iso-6983.toml"),
        br#"{"schema": "trunnion-certificate/2", "before": {"sha256": "00", "bytes": 1}, "motions": 1}"#.to_vec(),
        b"schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [10, 0, 0]], [[0, 10, 0], [10, 10, 1]]]\n".to_vec(),
        b"solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 1\nendloop\nendfacet\nendsolid s\n".to_vec(),
        b"[KINS]\nKINEMATICS = xyzac-trt-kins\nJOINTS = 5\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = mm\n[AXIS_X]\nMIN_LIMIT = -100\n".to_vec(),
        br#"{"machine": {"name": "m", "units": "metric", "axes": {"X": {"type": "linear", "min": 0, "max": 500}}}}"#.to_vec(),
    ];
    let named = files.into_iter().zip(0_u8..);
    named.map(|(file, format)| [vec![format], file].concat()).collect()
}

/// Runs a target on inputs and on mutations of them.
fn drive(target: fn(&[u8]), inputs: &[Vec<u8>], seed: u64) {
    let mut random = Random(seed);
    for input in inputs {
        target(input);
    }
    for number in 0..mutations() / 4 {
        let input = &inputs[number % inputs.len()];
        let mut data = random.mutate(input);
        // the first byte selects: it changes seldom by chance
        if let (Some(first), true) = (data.first_mut(), random.below(4) == 0) {
            *first = random.below(256) as u8;
        }
        target(&data);
    }
}

#[test]
fn parse_holds_for_mutated_seeds() {
    drive(targets::parse, &seeds(), 1);
}

#[test]
fn run_holds_for_mutated_seeds() {
    drive(targets::run, &seeds(), 2);
}

#[test]
fn canon_holds_for_mutated_seeds() {
    drive(targets::canon, &seeds(), 3);
}

#[test]
fn fmt_holds_for_mutated_seeds() {
    drive(targets::fmt, &seeds(), 4);
}

#[test]
fn formats_hold_for_mutated_files() {
    drive(targets::formats, &formats(), 5);
}
