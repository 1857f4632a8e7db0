//! switch-angles: published numbers, exhaustive search on short random programs, and certificates that were tampered with.
use super::strategy_2::{ROWS, certified, refused, run, settings, sinumerik};
use crate::random::Random;
use std::fmt::Write;
use trunnion::certify::postures::PostureCost;
use trunnion::certify::{Certificate, Claim, Outcome, certify, recheck};
use trunnion::check::{Assume, Settings};
use trunnion::geometry::rad;
use trunnion::interp::Setup;
use trunnion::machine::{self, Limits, Machine};
use trunnion::rewrite::{Attempt, Options, Proved};

fn switch(text: &str, settings: &Settings<'_>, cost: PostureCost) -> Attempt {
    run(
        "switch-angles",
        text,
        settings,
        &Options {
            cost,
            ..Options::default()
        },
    )
}

/// mikron-ucp710 with other travel of A and C, deg.
fn mikron(a: (f64, f64), c: Option<(f64, f64)>) -> Machine {
    let mut machine = machine::builtin("mikron-ucp710").expect("built in").clone();
    let (tilt, turn) = (machine.joint(b'A').expect("A"), machine.joint(b'C').expect("C"));
    machine.axes[tilt].limits = Limits::Range(rad(a.0), rad(a.1));
    machine.axes[turn].limits = c.map_or(Limits::Unbounded, |(low, high)| Limits::Range(rad(low), rad(high)));
    machine
}

fn on(machine: &Machine) -> Settings<'_> {
    let mut settings = settings("sinumerik-840d", Setup::default());
    settings.machine = Some(machine);
    settings.assume = Assume::ALL;
    settings
}

/// The published rows with every A positive are what a post without look-ahead writes; the published ones are the best.
#[test]
fn the_published_postures_are_found_again() {
    let machine = mikron((-30.0, 120.0), None);
    let flipped = ROWS
        .replace("A-0.79 C-3.086", "A0.79 C176.914")
        .replace("A-1.676 C-0.905", "A1.676 C179.095");
    for cost in [PostureCost::Travel, PostureCost::Time] {
        let (after, certificate) = certified(switch(&sinumerik(&flipped), &on(&machine), cost));
        assert_eq!(after, sinumerik(ROWS), "{}", cost.name());
        let costs = certificate.postures.expect("a proof about postures");
        assert_eq!((costs.stations, costs.switches_before, costs.switches_after), (5, 0, 1));
        assert!(matches!(switch(&after, &on(&machine), cost).outcome(), Ok(None)));
    }
    // with tool centre point control the tip never deviates, so there is nothing to gain
    assert!(matches!(
        switch(&sinumerik(ROWS), &on(&machine), PostureCost::Deviation).outcome(),
        Ok(None)
    ));
}

/// The greedy choice turns C by 352 deg: the first winding is free.
#[test]
fn the_first_winding_is_chosen_for_what_comes() {
    let machine = mikron((-30.0, 120.0), Some((-360.0, 360.0)));
    let text = sinumerik("G0 X10 Y0 Z50 A10 C340\nG1 X9 C355\nX8 C3\nX7 C20\nX6 C100\n");
    let (after, certificate) = certified(switch(&text, &on(&machine), PostureCost::Travel));
    assert_eq!(after, text.replace("C340", "C-20").replace("C355", "C-5"));
    let costs = certificate.postures.expect("a proof about postures");
    assert!(
        (costs.before - 464.0).abs() < 1e-6 && (costs.after - 120.0).abs() < 1e-6,
        "{costs:?}"
    );
}

/// Where the same posture would need more than half a turn, a cut does not change the posture instead: the pole is not inside it.
#[test]
fn no_posture_is_changed_in_a_cut_for_want_of_turns() {
    let machine = mikron((-20.0, 60.0), Some((-500.0, 400.0)));
    let rows: [Row; 6] = [
        (40.045, 247.152, false),
        (-12.39, -317.368, false),
        (-15.629, -350.0, true),
        (-17.124, -313.442, true),
        (19.831, 40.199, false),
        (22.613, -0.279, true),
    ];
    let (_, certificate) = certified(switch(&text_of(&rows), &on(&machine), PostureCost::Travel));
    let costs = certificate.postures.expect("a proof about postures");
    // found by a program that shares nothing with this one
    assert!((costs.after - 311.536_215).abs() < 1e-5, "{costs:?}");
}

/// Words that the next block leaves out must still say what they said.
#[test]
fn words_left_out_are_written_where_they_are_needed() {
    let machine = mikron((-120.0, 120.0), None);
    let text = sinumerik("G0 X0 Y0 Z50 A3 C0\nG1 X1 A2 C1\nX1.5 A0.1 C5\nX2 C170\nX3 A2\nX4\nG0 Z100\n");
    let (after, _) = certified(switch(&text, &on(&machine), PostureCost::Travel));
    assert_eq!(
        after,
        sinumerik("G0 X0 Y0 Z50 A3 C0\nG1 X1 A2 C1\nX1.5 A0.1 C5\nX2 A-0.1 C-10\nX3 A-2\nX4\nG0 Z100\n")
    );
}

#[test]
fn what_the_rewrite_cannot_know_it_refuses() {
    let machine = mikron((-120.0, 120.0), None);
    let mut undeclared = on(&machine);
    undeclared.assume = Assume::default();
    let joints = "G54\nT1 M6\nD1\nS8000 M3\nF2000\nG0 X0 Y0 Z50 A2 C0\nG1 X1 A0.1 C5\nX2 A0.1 C170\nX3 A2\nM30\n";
    let reason = refused(switch(joints, &undeclared, PostureCost::Travel));
    assert!(
        reason.contains("not declared") && reason.contains("--assume"),
        "{reason}"
    );
    let incremental = sinumerik("G0 X0 Y0 Z50 A2 C0\nG1 X1 A0.1 C5\nG91 X1 C165\nG90 X3 A2\n");
    let reason = refused(switch(&incremental, &on(&machine), PostureCost::Travel));
    assert!(reason.contains("G91"), "{reason}");
    let vectors = sinumerik("G0 X0 Y0 Z50 A3=0 B3=0.1 C3=1\nG1 X1 A3=0 B3=-0.1 C3=1\n");
    let reason = refused(switch(&vectors, &on(&machine), PostureCost::Travel));
    assert!(reason.contains("tool vectors"), "{reason}");
    let mut slow = machine.clone();
    let turn = slow.joint(b'C').expect("C");
    slow.axes[turn].max_speed = None;
    let reason = refused(switch(&sinumerik(ROWS), &on(&slow), PostureCost::Time));
    assert!(reason.contains("highest speed of C"), "{reason}");
    let outside = sinumerik("G0 X0 Y0 Z50 A130 C0\nG1 X1 A131 C5\n");
    let reason = refused(switch(&outside, &on(&machine), PostureCost::Travel));
    assert!(reason.contains("no posture"), "{reason}");
}

/// A label that is too high or too low, another cost, another file: each is noticed.
#[test]
fn a_certificate_that_was_changed_is_refused() {
    let machine = mikron((-30.0, 120.0), None);
    let before = sinumerik(
        &ROWS
            .replace("A-0.79 C-3.086", "A0.79 C176.914")
            .replace("A-1.676 C-0.905", "A1.676 C179.095"),
    );
    let (after, certificate) = certified(switch(&before, &on(&machine), PostureCost::Travel));
    let dialect = trunnion::dialect::builtin("sinumerik-840d").expect("built in");
    let again = |certificate: &_, after: &str| {
        recheck(
            certificate,
            before.as_bytes(),
            after.as_bytes(),
            dialect,
            &machine,
            &Setup::default(),
        )
    };
    assert!(matches!(again(&certificate, &after), Outcome::Proved(_)));
    let Claim::LeastPostures { labels, .. } = &certificate.claim else {
        panic!("{:?}", certificate.claim)
    };
    for index in 0..labels.len() {
        for change in [-1_000_000_i64, 1_000_000] {
            let mut forged = certificate.clone();
            let Claim::LeastPostures { labels, .. } = &mut forged.claim else {
                unreachable!("as above")
            };
            let Some(label) = &mut labels[index] else { continue };
            *label = label.saturating_add_signed(change);
            if labels[index] == Some(0) {
                continue;
            }
            assert!(
                matches!(again(&forged, &after), Outcome::Refuted(_)),
                "label {index} by {change}"
            );
        }
    }
    let mut forged = certificate.clone();
    let Claim::LeastPostures { cost, .. } = &mut forged.claim else {
        unreachable!("as above")
    };
    *cost = PostureCost::Time;
    assert!(matches!(again(&forged, &after), Outcome::Refuted(_)));
    // the program as it was has the same poses, and is not the cheapest
    assert!(matches!(again(&certificate, &before), Outcome::Refuted(_)));
    let mut own = certificate.clone();
    own.after = own.before.clone();
    assert!(matches!(again(&own, &before), Outcome::Refuted(_)));
}

/// A claim about a program that moves nothing, and labels for another program: refused, with a line.
#[test]
fn labels_that_do_not_fit_are_refused() {
    let machine = mikron((-30.0, 120.0), None);
    let dialect = trunnion::dialect::builtin("sinumerik-840d").expect("built in");
    for (text, labels) in [("M30\n".to_owned(), vec![]), (sinumerik(ROWS), vec![Some(0); 3])] {
        let claim = Claim::LeastPostures {
            tolerance_mm: 0.001,
            tolerance_deg: 0.1,
            cost: PostureCost::Travel,
            labels,
        };
        let bytes = text.as_bytes();
        let found = certify(bytes, bytes, dialect, &machine, &Setup::default(), &claim);
        assert!(
            matches!(&found, Outcome::Refuted(witness) if witness.line.is_some() && witness.message.contains("labels")),
            "{found:?}"
        );
    }
}

/// One position of a random program: A and C as written, and whether it is reached in a cut.
type Row = (f64, f64, bool);

/// A program whose cuts stay away from the pole, with jumps in rapids.
fn random_rows(random: &mut Random) -> Vec<Row> {
    let (mut a, mut c) = (random.between(10.0, 50.0), random.between(-300.0, 300.0));
    let mut rows = vec![(a, c, false)];
    for _ in 0..5 {
        let cut = !random.one_in(3);
        if cut {
            let size = (a.abs() + random.between(-8.0, 8.0)).clamp(10.0, 58.0);
            a = size.copysign(a);
            c = (c + random.between(-60.0, 60.0)).clamp(-350.0, 350.0);
        } else {
            a = random.between(10.0, 58.0) * if random.one_in(2) { 1.0 } else { -1.0 };
            c = random.between(-350.0, 350.0);
        }
        rows.push((a, c, cut));
    }
    rows
}

fn text_of(rows: &[Row]) -> String {
    let mut text = String::new();
    for (index, (a, c, cut)) in rows.iter().enumerate() {
        let _ = writeln!(text, "G{} X{index} Y0 Z50 A{a:.3} C{c:.3}", i32::from(*cut));
    }
    sinumerik(&text)
}

/// The least travel from a position to the end, deg.
fn walk(rows: &[Row], states: &dyn Fn(&Row) -> Vec<(f64, f64)>, at: (f64, f64), index: usize) -> f64 {
    let Some(row) = rows.get(index) else { return 0.0 };
    let mut least = f64::INFINITY;
    for (a, c) in states(row) {
        let (da, dc) = (a - at.0, c - at.1);
        let as_written = (at.0, at.1) == (rows[index - 1].0, rows[index - 1].1) && (a, c) == (row.0, row.1);
        if row.2 && !as_written && (a * at.0 < 0.0 || da.abs() > 180.0 || dc.abs() > 180.0) {
            continue;
        }
        let rest = walk(rows, states, (a, c), index + 1);
        least = least.min((da * da + dc * dc).sqrt() + rest);
    }
    least
}

/// The least travel of all sequences of postures and turns, deg, found by trying each of them. The postures are those of the table by
/// hand: (A, C) and (-A, C + 180).
fn by_hand(rows: &[Row], a_travel: (f64, f64), c_travel: (f64, f64)) -> f64 {
    let states = |&(a, c, _): &Row| -> Vec<(f64, f64)> {
        let mut found = Vec::new();
        for (a, c) in [(a, c), (-a, c + 180.0)] {
            for turns in -4..=4 {
                let c = c + 360.0 * f64::from(turns);
                let inside = |value: f64, (low, high): (f64, f64)| value >= low - 1e-9 && value <= high + 1e-9;
                if inside(a, a_travel) && inside(c, c_travel) {
                    found.push((a, c));
                }
            }
        }
        found
    };
    let first = states(&rows[0]);
    first
        .into_iter()
        .map(|at| walk(rows, &states, at, 1))
        .fold(f64::INFINITY, f64::min)
}

/// The certificate holds, and no longer once one of its labels is lower: a cheaper course would be claimed.
fn checked_again(certificate: &Certificate, before: &str, after: &[u8], machine: &Machine) {
    let dialect = trunnion::dialect::builtin("sinumerik-840d").expect("built in");
    let again = |certificate: &Certificate| {
        recheck(
            certificate,
            before.as_bytes(),
            after,
            dialect,
            machine,
            &Setup::default(),
        )
    };
    assert!(matches!(again(certificate), Outcome::Proved(_)), "{before}");
    let mut forged = certificate.clone();
    let Claim::LeastPostures { labels, .. } = &mut forged.claim else {
        panic!("{:?}", certificate.claim)
    };
    let label = labels.iter_mut().rev().flatten().next().expect("a label");
    *label = label.saturating_sub(1_000_000);
    assert!(matches!(again(&forged), Outcome::Refuted(_)), "{before}");
}

#[test]
fn no_sequence_of_postures_is_cheaper() {
    let mut random = Random(2026);
    let (mut better, mut kept) = (0, 0);
    for case in 0..1000 {
        let (a, c) = if case % 2 == 0 {
            ((-60.0, 60.0), (-360.0, 360.0))
        } else {
            ((-20.0, 60.0), (-500.0, 400.0))
        };
        let machine = mikron(a, Some(c));
        let rows: Vec<Row> = random_rows(&mut random)
            .into_iter()
            .map(|(tilt, turn, cut)| (tilt.max(a.0), turn, cut))
            .collect();
        let (text, least) = (text_of(&rows), by_hand(&rows, a, c));
        let as_written: f64 = rows
            .windows(2)
            .map(|pair| ((pair[1].0 - pair[0].0).powi(2) + (pair[1].1 - pair[0].1).powi(2)).sqrt())
            .sum();
        match switch(&text, &on(&machine), PostureCost::Travel).outcome() {
            Ok(None) => {
                kept += 1;
                assert!((as_written - least).abs() < 1e-6, "{text}\n{as_written} {least}");
            }
            Ok(Some(Proved { certificate, after, .. })) => {
                better += 1;
                checked_again(&certificate, &text, &after, &machine);
                let costs = certificate.postures.expect("a proof about postures");
                assert!((costs.before - as_written).abs() < 1e-6, "{text}");
                assert!((costs.after - least).abs() < 1e-6, "{text}\n{} {least}", costs.after);
            }
            Err(reason) => panic!("{reason}\n{text}"),
        }
    }
    assert!(better > 250 && kept > 25, "{better} {kept}");
}
