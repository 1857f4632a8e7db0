//! Files beside the program (machine, settings, dialect table, certificate, surface, STL, INI, FreeCAD machine, tool table, parameters),
//! changed at random places: each is read or refused with a message, and nothing panics. `fuzz/fuzz_targets/formats.rs` is the long form.
use crate::random::Random;
use std::{fs, path::Path};
use trunnion::{certify::Certificate, check::Config, dialect::Dialect, machine, ngc, surface};

/// Mutations of each format; `TRUNNION_MUTATIONS` sets another number.
pub(crate) fn mutations() -> usize {
    std::env::var("TRUNNION_MUTATIONS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(400)
}

impl Random {
    /// One to four places changed: a byte, a scrap put in, a stretch taken out or said twice.
    pub(crate) fn mutate(&mut self, source: &[u8]) -> Vec<u8> {
        const SCRAPS: [&str; 16] = [
            "\"",
            "[",
            "]",
            "{",
            "}",
            "=",
            "-",
            "1e999",
            "nan",
            "inf",
            "\n",
            "0",
            "99999999999999999999",
            "\u{0}",
            "é",
            "[[axis]]\n",
        ];
        let mut text = source.to_vec();
        for _ in 0..=self.below(4) {
            let at = self.below(text.len() + 1);
            match self.below(4) {
                0 if at < text.len() => text[at] = self.below(256) as u8,
                1 => {
                    let scrap = SCRAPS[self.below(SCRAPS.len())].bytes();
                    text.splice(at..at, scrap);
                }
                2 => {
                    let end = (at + self.below(40)).min(text.len());
                    text.drain(at..end);
                }
                _ => {
                    let end = (at + self.below(200)).min(text.len());
                    let twice = text[at..end].to_vec();
                    text.splice(at..at, twice);
                }
            }
        }
        text
    }
}

fn file(path: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("there")
}

/// Reads the bytes as one format; whether they were taken.
type Reader = fn(&[u8]) -> Result<(), String>;

fn text(bytes: &[u8]) -> Result<&str, String> {
    std::str::from_utf8(bytes).map_err(|error| error.to_string())
}

fn formats() -> Vec<(&'static str, Vec<u8>, Reader)> {
    let stl = b"solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 1\nendloop\nendfacet\nendsolid s\n";
    let grid =
        b"schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [10, 0, 0]], [[0, 10, 0], [10, 10, 1]]]\n";
    let ini = b"[KINS]\nKINEMATICS = xyzac-trt-kins\nJOINTS = 5\n[TRAJ]\nCOORDINATES = XYZAC\nLINEAR_UNITS = mm\nANGULAR_UNITS = degree\n[AXIS_X]\nMIN_LIMIT = -100\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\n";
    let fcm = br#"{"machine": {"name": "m", "units": "metric", "axes": {"X": {"type": "linear", "min": 0, "max": 500}, "C": {"type": "rotary"}}}}"#;
    vec![
        ("machine", file("samples/machines/mikron-ucp710.toml"), |bytes| {
            machine::load("m", text(bytes)?)
                .map(drop)
                .map_err(|error| error.message)
        }),
        ("settings", file("samples/trunnion.toml"), |bytes| {
            Config::parse(text(bytes)?).map(drop).map_err(|error| error.message)
        }),
        ("dialect table", file("grammar/dialects/grbl.toml"), |bytes| {
            Dialect::from_table(text(bytes)?, "t")
                .map(drop)
                .map_err(|error| error.message)
        }),
        ("certificate", file("tests/golden/certificate.json"), |bytes| {
            Certificate::from_json(text(bytes)?).map(drop)
        }),
        ("surface", grid.to_vec(), |bytes| {
            surface::required(text(bytes)?, false, 0.001)
                .map(drop)
                .map_err(|error| error.to_string())
        }),
        ("STL", stl.to_vec(), |bytes| {
            surface::required_stl(bytes)
                .map(drop)
                .map_err(|error| error.to_string())
        }),
        ("INI", ini.to_vec(), |bytes| {
            machine::import_linuxcnc("m.ini", text(bytes)?, &[])
                .map(drop)
                .map_err(|error| error.message)
        }),
        ("FreeCAD machine", fcm.to_vec(), |bytes| {
            machine::import_freecad("m.fcm", text(bytes)?)
                .map(drop)
                .map_err(|error| error.message)
        }),
        ("tool table", b"T1 P1 D3 Z+10.5 ;a tool\nT2 P2 D6\n".to_vec(), |bytes| {
            let (_, bad) = ngc::ToolTable::parse(bytes);
            bad.into_iter().next().map_or(Ok(()), |bad| Err(bad.message))
        }),
        ("parameters", b"5161\t0.0\n5220\t1.0\n5221\t12.5\n".to_vec(), |bytes| {
            ngc::Parameters::parse(bytes).map(drop).map_err(|bad| bad.message)
        }),
    ]
}

#[test]
fn changed_files_of_every_format_are_read_or_refused_with_a_message() {
    for (name, source, read) in formats() {
        let mut random = Random(20_261_123);
        let (mut taken, mut refused) = (0, 0);
        for number in 0..mutations() {
            let bytes = random.mutate(&source);
            let Ok(outcome) = std::panic::catch_unwind(|| read(&bytes)) else {
                panic!("{name}, mutation {number}: {:?}", String::from_utf8_lossy(&bytes));
            };
            match outcome {
                Ok(()) => taken += 1,
                Err(message) => {
                    assert!(
                        !message.is_empty(),
                        "{name}, mutation {number}: refused without a message"
                    );
                    refused += 1;
                }
            }
        }
        assert!(
            taken + refused == mutations() && refused > 0,
            "{name}: {taken} read, {refused} refused"
        );
    }
}
