//! One small APT program for every control.
use crate::support::{text, to};
use trunnion_convert::{Options, OrientationWords};

const PIECE: &str = "PARTNO SMALL PIECE
UNITS/MM
MULTAX/ON
CUTTER/10,5
LOADTL/1,LENGTH,100
PPRINT ball nose, finishing
SPINDL/12000,RPM,CLW
COOLNT/FLOOD
RAPID
GOTO/0,0,50,0,0,1
RAPID
GOTO/0,0,2,0,0,1
FEDRAT/1000,MMPM
GOTO/0,0,0,0,0,1
GOTO/10,0,0,0.1,0,0.994987437
GOTO/20,0,0,0.1,0.1,0.989949494
DELAY/1.5
CIRCLE/20,10,0,0,0,1,10
GOTO/30,10,0,0.1,0.1,0.989949494
COOLNT/OFF
RAPID
GOTO/30,10,50,0.1,0.1,0.989949494
SPINDL/OFF
FINI
";

fn options(tcp: bool) -> Options {
    Options {
        tcp,
        ..Options::default()
    }
}

#[test]
fn every_control_has_its_words() {
    let mut all = String::new();
    for (dialect, tcp) in [
        ("sinumerik-840d", true),
        ("fanuc-30i", true),
        ("haas-ngc", true),
        ("linuxcnc", true),
    ] {
        let written = text(to((PIECE, "apt", ""), dialect, "mikron-ucp710", &options(tcp)));
        all.push_str(&format!("--- {dialect}\n{written}"));
    }
    println!("{all}");
    let vectors = Options {
        orientation: OrientationWords::Vectors,
        ..Options::default()
    };
    println!("{}", text(to((PIECE, "apt", ""), "sinumerik-840d", "mikron-ucp710", &vectors)));
    println!("{}", text(to((PIECE, "apt", ""), "fanuc-30i", "mikron-ucp710", &vectors)));
    let no = options(false);
    println!("{}", text(to((PIECE, "apt", ""), "linuxcnc", "mikron-ucp710", &no)).lines().count());
    println!("{}", text(to((PIECE, "apt", ""), "iso-6983", "ferrari-bc", &no)).lines().count());
    println!("{}", text(to((PIECE, "apt", ""), "apt", "", &no)));
}
