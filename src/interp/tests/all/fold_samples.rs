//! The sample programs for Fanuc and Haas run as their comments say.
use crate::support::{line, run_bytes};
use trunnion_interp::{FaultKind, MotionKind, Setup};

fn sample(path: &str) -> Vec<u8> {
    let file = format!("{}/../../samples/programs/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(file).expect("a sample")
}

#[test]
fn samples_run_as_they_should() {
    let programs = [
        ("fanuc-30i", "fanuc/drill-plate.nc"),
        ("fanuc-30i", "fanuc/pocket-frames.nc"),
        ("fanuc-30i-lathe-a", "fanuc/turn-shaft.nc"),
        ("haas-ngc", "haas/flange.nc"),
        ("haas-ngc", "haas/slot-scaled.nc"),
    ];
    let mut text = String::new();
    for (dialect, path) in programs {
        let source = sample(path);
        assert_eq!(
            trunnion_dialect::detect(None, &source, None).dialect.name,
            dialect,
            "{path}"
        );
        let (program, log) = run_bytes(dialect, &source, &Setup::default());
        text += &format!("{path}\n");
        for fault in &log.faults {
            assert!(!matches!(fault.kind, FaultKind::Rejected { .. }), "{path}: {fault:?}");
            text += &format!("  ! {}\n", crate::support::fault_line(&program, fault));
        }
        for motion in &log.motions {
            text += &format!("  {}: {}\n", motion.block.0 + 1, line(motion));
        }
        let unknown = log
            .motions
            .iter()
            .filter(|motion| motion.kind == MotionKind::Unknown)
            .count();
        text += &format!("  {} motions, {unknown} unknown\n", log.motions.len());
    }
    insta::assert_snapshot!("fold_samples", text);
}
