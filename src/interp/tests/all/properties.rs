//! Laws that hold for all programs.
use crate::support::{position, run_bytes, shared};
use proptest::prelude::*;
use trunnion_dialect::BUILTIN_NAMES;
use trunnion_interp::{MotionKind, Setup};

/// Pieces that programs are made of, so that random text is nearly a program.
const PIECES: &[&str] = &[
    "G0",
    "G1",
    "G2",
    "G3",
    "G4",
    "G17",
    "G18",
    "G19",
    "G20",
    "G21",
    "G28",
    "G40",
    "G41",
    "G43",
    "G43.4",
    "G43.5",
    "G49",
    "G53",
    "G54",
    "G68.2",
    "G69",
    "G70",
    "G80",
    "G81",
    "G90",
    "G91",
    "G90.1",
    "G93",
    "G94",
    "G95",
    "G96",
    "M3",
    "M5",
    "M6",
    "M30",
    "M99",
    "X1",
    "Y-2.5",
    "Z3",
    "A10",
    "B-90",
    "C=DC(20)",
    "C=IC(5)",
    "I1",
    "J0",
    "K-1",
    "R5",
    "R-5",
    "CR=4",
    "TURN=3",
    "F100",
    "F0",
    "S500",
    "T1",
    "T=\"A\"",
    "H1",
    "D1",
    "P2",
    "X=R1",
    "X#1",
    "X[1+2]",
    "A3=0",
    "B3=1",
    "C3=0",
    "TRAORI",
    "TRAFOOF",
    "TRANS",
    "CYCLE800(1)",
    "CYCLE800()",
    "MCALL",
    "SUPA",
    "DEF REAL A",
    "IF",
    "(c)",
    ";c",
    "%",
    "/",
    "\n",
    "\n",
    "\n",
    "N10",
    "O1",
    "GOTO/1,2,3",
    "GOTO/1,2,3,0,0,1",
    "CIRCLE/0,0,0,0,0,1,2",
    "RAPID",
    "FEDRAT/100",
    "MULTAX/ON",
    "CUTTER/10,5",
    "LOADTL/1",
    "CYCLE/OFF",
    "CSYS/1,0",
    "X1e99",
    "X99999999999999999999",
    "(trunnion: tool 1 ball diameter 10)",
];

fn program() -> impl Strategy<Value = String> {
    proptest::collection::vec(proptest::sample::select(PIECES), 0..60).prop_map(|pieces| pieces.join(" "))
}

/// Runs under every dialect: nothing panics, numbers are finite, faults lie in the file.
fn is_total(source: &[u8]) {
    for dialect in BUILTIN_NAMES {
        let (program, log) = run_bytes(dialect, source, &Setup::default());
        for fault in &log.faults {
            assert!(
                fault.range.start <= fault.range.end && fault.range.end as usize <= source.len(),
                "{fault:?}"
            );
            assert!((fault.block.0 as usize) < program.block_count());
        }
        for motion in &log.motions {
            let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
            assert!(
                finite(&motion.start.values) && finite(&motion.end.values) && finite(&motion.zero),
                "{motion:?}"
            );
            if let MotionKind::Arc(Some(arc)) = motion.kind {
                assert!(arc.sweep.is_finite() && finite(arc.centre.as_slice()), "{arc:?}");
            }
        }
    }
}

/// Bytes of real programs, one changed, lost or doubled at a time.
#[test]
fn runs_are_total_on_mutated_files() {
    let files = [
        "five-axis-pairs/test_5ax_ac_sin840d.mpf",
        "five-axis-pairs/macro_b.nc",
        "sinumerik/s03-sub.SPF",
        "linuxcnc-5axis/trsrn-demos/square.ngc",
        "apt/postprocessor-words/test.apt",
        "apt/creo/bohren_1.ncl.8",
    ];
    // a linear congruential generator (Knuth's MMIX constants): the same mutations in every run
    let mut seed = 1u64;
    let mut next = move |below: usize| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    for file in files {
        let Some(source) = shared(file) else { return };
        for _ in 0..60 {
            let mut mutated = source.clone();
            let at = next(mutated.len());
            match next(3) {
                0 => mutated[at] = next(256) as u8,
                1 => drop(mutated.remove(at)),
                _ => mutated.insert(at, source[next(source.len())]),
            }
            is_total(&mutated);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn runs_are_total_on_bytes(source in proptest::collection::vec(any::<u8>(), 0..400)) {
        is_total(&source);
    }

    #[test]
    fn runs_are_total_on_programs(source in program()) {
        is_total(source.as_bytes());
    }

    #[test]
    fn runs_are_total_on_mutations(source in program(), at in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let mut source = source.into_bytes();
        if !source.is_empty() {
            let at = at.index(source.len());
            source[at] = byte;
        }
        is_total(&source);
    }

    #[test]
    fn incremental_is_absolute(steps in proptest::collection::vec((0usize..4, -500i32..500, -500i32..500), 1..30)) {
        let (mut absolute, mut incremental) = (String::new(), String::new());
        let mut at = [0i32; 2];
        let start = "F100 G0 X0 Y0 Z0\n";
        for (kind, dx, dy) in steps {
            at = [at[0] + dx, at[1] + dy];
            let tail = match kind { 0 => "G0", 1 => "G1", 2 => "G2 R999", _ => "G3 R-999" };
            // hundredths, so that both spellings are exact to the last printed digit
            absolute += &format!("{tail} X{} Y{}\n", f64::from(at[0]) / 100.0, f64::from(at[1]) / 100.0);
            incremental += &format!("{tail} X{} Y{}\n", f64::from(dx) / 100.0, f64::from(dy) / 100.0);
        }
        let a = run_bytes("linuxcnc", format!("G90 {start}{absolute}M2\n").as_bytes(), &Setup::default()).1;
        let i = run_bytes("linuxcnc", format!("{start}G91\n{incremental}M2\n").as_bytes(), &Setup::default()).1;
        prop_assert_eq!(a.motions.len(), i.motions.len());
        for (a, i) in a.motions.iter().zip(&i.motions) {
            prop_assert_eq!(position(&a.end), position(&i.end));
            if let (MotionKind::Arc(Some(a)), MotionKind::Arc(Some(i))) = (a.kind, i.kind) {
                prop_assert!((a.centre - i.centre).norm() < 1e-6 && (a.sweep - i.sweep).abs() < 1e-6);
            } else {
                prop_assert_eq!(std::mem::discriminant(&a.kind), std::mem::discriminant(&i.kind));
            }
        }
    }

    #[test]
    fn inch_is_metric_scaled(steps in proptest::collection::vec((0usize..4, -500i32..500, -500i32..500), 1..30)) {
        let mut body = String::new();
        for (kind, x, y) in steps {
            let tail = match kind { 0 => "G0", 1 => "G1", 2 => "G2 R999", _ => "G3 I3 J4" };
            body += &format!("{tail} X{x} Y{y} C{x} F{}\n", y.abs() + 1);
        }
        let run = |unit: &str| run_bytes("linuxcnc", format!("{unit} G0 X0 Y0 Z0\n{body}M2\n").as_bytes(), &Setup::default()).1;
        let (inch, metric) = (run("G20"), run("G21"));
        prop_assert_eq!(inch.motions.len(), metric.motions.len());
        for (i, m) in inch.motions.iter().zip(&metric.motions) {
            for axis in 0..3 {
                prop_assert!((i.end.values[axis] - 25.4 * m.end.values[axis]).abs() < 1e-9);
            }
            prop_assert_eq!(i.end.values[5], m.end.values[5]);
            if let (MotionKind::Arc(Some(i)), MotionKind::Arc(Some(m))) = (i.kind, m.kind) {
                prop_assert!((i.centre - m.centre * 25.4).norm() < 1e-6 && (i.sweep - m.sweep).abs() < 1e-9);
            }
            if let (trunnion_interp::Feed::PerMinute(i), trunnion_interp::Feed::PerMinute(m)) = (i.feed, m.feed) {
                prop_assert!((i - 25.4 * m).abs() < 1e-9);
            }
        }
    }
}
