//! Real programs.
use crate::support::{fault_line, line, run_bytes, shared};
use std::collections::BTreeMap;
use trunnion_interp::{Feed, MotionKind, Setup};

/// The words of a block of the pocket program, read in the simplest way: a letter and a number, again and again.
fn words(block: &str) -> Vec<(char, f64)> {
    let mut words = Vec::new();
    let mut rest = block.trim();
    while let Some(letter) = rest.chars().next() {
        let tail = &rest[1..];
        let end = tail.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(tail.len());
        words.push((letter, tail[..end].trim().parse().expect("a number")));
        rest = &tail[end..];
    }
    words
}

#[test]
fn every_block_of_the_pocket_program_is_the_motion_it_says() {
    let Some(source) = shared("pocket-1999/pocket.nc") else {
        return;
    };
    let (program, log) = run_bytes("iso-6983", &source, &Setup::default());
    let mut motions = log.motions.iter();
    let mut at: BTreeMap<char, f64> = BTreeMap::new();
    let (mut rapid, mut blocks) = (false, 0);
    let mut feed = None;
    for (number, text) in String::from_utf8(source).expect("plain text").lines().enumerate() {
        if !text.starts_with('N') {
            continue;
        }
        blocks += 1;
        let words = words(text);
        let mut moves = false;
        for &(letter, value) in &words {
            match letter {
                'G' if value == 0.0 => rapid = true,
                'G' if value == 1.0 => rapid = false,
                'F' => feed = Some(value),
                'X' | 'Y' | 'Z' => {
                    moves = true;
                    at.insert(letter, value);
                }
                _ => {}
            }
        }
        if !moves {
            continue;
        }
        let motion = motions.next().expect("a motion for every block with coordinates");
        assert_eq!(motion.block.0 as usize, number);
        let kind = if rapid { MotionKind::Rapid } else { MotionKind::Linear };
        assert_eq!(motion.kind, kind, "{text}");
        let end = [motion.end.get(0), motion.end.get(1), motion.end.get(2)];
        assert_eq!(end, ['X', 'Y', 'Z'].map(|axis| at.get(&axis).copied()), "{text}");
        let want = if rapid {
            Feed::Rapid
        } else {
            Feed::PerMinute(feed.expect("a feed before the first cut"))
        };
        assert_eq!(motion.feed, want, "{text}");
        assert_eq!(motion.spindle_on, Some(true), "M3 stands in the first block");
    }
    assert_eq!(blocks, 1407);
    assert!(motions.next().is_none());
    let faults: Vec<_> = log.faults.iter().map(|fault| fault_line(&program, fault)).collect();
    assert_eq!(
        faults,
        [
            "2: G5: UnknownCode { machine_builder: false }",
            "1411: N1406M05: MissingProgramEnd"
        ],
        "what is really odd in it"
    );
}

#[test]
fn guide_vane_blocks_are_the_motions_they_say() {
    for (file, dialect) in [("strategy-2.mpf", "sinumerik-840d"), ("strategy-2.apt", "apt")] {
        let Some(source) = shared(&format!("guide-vane-2006/{file}")) else {
            return;
        };
        let (_, log) = run_bytes(dialect, &source, &Setup::default());
        let got: Vec<_> = log.motions.iter().map(line).collect();
        assert_eq!(got.len(), 5);
        let want = if dialect == "apt" {
            "L X-28.38709 Y-1.53565 Z59.93222 tcp <0.001071 -0.000819 0.999999>"
        } else {
            "L X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595"
        };
        assert_eq!(got[2], want);
    }
}

/// Two posts of one part have the same targets.
#[test]
fn fanuc_and_siemens_posts_agree() {
    let files = [
        ("fanuc/5X_MILLING.NC", "fanuc-30i"),
        ("siemens/5X_Milling.mpf", "sinumerik-840d"),
    ];
    let runs = files.map(|(file, dialect)| {
        let source = shared(&format!("four-controls/{file}"))?;
        Some(run_bytes(dialect, &source, &Setup::default()).1)
    });
    let [Some(fanuc), Some(siemens)] = runs else { return };
    let targets = |log: &crate::support::Log| -> Vec<String> {
        log.motions.iter().filter(|motion| motion.tcp).map(line).collect()
    };
    let (fanuc, siemens) = (targets(&fanuc), targets(&siemens));
    assert!(fanuc.len() > 44_000, "{}", fanuc.len());
    assert_eq!(fanuc, siemens);
}

#[test]
fn faults_of_real_sinumerik_programs() {
    let files = [
        ("sinumerik/CAM_TEST.MPF", "sinumerik-840d"),
        ("sinumerik/m02-five-axis.MPF", "sinumerik-840d"),
        ("five-axis-pairs/test_5ax_ac_sin840d.mpf", "sinumerik-840d"),
        ("five-axis-pairs/impeller_part1.mpf", "sinumerik-840d"),
        ("five-axis-pairs/test_5ax_ac_fanuc.nc", "fanuc-30i"),
    ];
    let mut text = String::new();
    for (file, dialect) in files {
        let Some(source) = shared(file) else { return };
        let (program, log) = run_bytes(dialect, &source, &Setup::default());
        text += &format!("{file}: {} motions\n", log.motions.len());
        for fault in &log.faults {
            text += &format!("  {}\n", fault_line(&program, fault));
        }
    }
    insta::assert_snapshot!(text);
}

/// No file of the data makes the run stop, and every fault is inside its file.
#[test]
fn every_shared_program_runs() {
    let cases = [
        ("linuxcnc-5axis/impeller-7bl-xyzac.ngc", "linuxcnc", 4492),
        ("linuxcnc-5axis/boat-xyzac.ngc", "linuxcnc", 1833),
        ("apt/creo/schruppen_1.ncl.1", "apt", 5590),
        ("apt/solidworks-cam/boss/boss.apt", "apt", 9814),
    ];
    for (file, dialect, motions) in cases {
        let Some(source) = shared(file) else { return };
        let (_, log) = run_bytes(dialect, &source, &Setup::default());
        assert_eq!(log.motions.len(), motions, "{file}");
        assert!(log.faults.iter().all(|fault| fault.range.end as usize <= source.len()));
    }
}
