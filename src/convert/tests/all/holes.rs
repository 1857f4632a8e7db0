//! Hole cycles of APT: written as the motions that they are, or refused by name.
use crate::support::{refusal, text, to};
use trunnion_convert::Options;

fn program(cycle: &str) -> String {
    format!(
        "PARTNO/T\nUNITS/MM\nMULTAX/OFF\nLOADTL/1,LENGTH,100\nSPINDL/1000,CLW\nRAPID\nGOTO/0,0,50\n{cycle}\nGOTO/10,0,0\nGOTO/20,0,0\n\
         CYCLE/OFF\nRAPID\nGOTO/0,0,50\nSPINDL/OFF\nFINI\n"
    )
}

#[test]
fn holes_are_written_as_their_motions() {
    for (cycle, feed, hole) in [
        (
            "CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2",
            "F100.",
            &["Z2.", "G1 Z-10.", "G0 Z2."][..],
        ),
        (
            "CYCLE/DRILL,DEPTH,10,IPM,4,CLEAR,2",
            "F101.6",
            &["Z2.", "G1 Z-10.", "G0 Z2."],
        ),
        (
            "CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2,DWELL,1",
            "F100.",
            &["Z2.", "G1 Z-10.", "G4 P1000", "G0 Z2."],
        ),
    ] {
        let written = text(to(
            (&program(cycle), "apt", ""),
            "fanuc-30i",
            "mill-3axis",
            &Options::default(),
        ));
        let blocks: Vec<&str> = written
            .lines()
            .filter_map(|line| line.strip_prefix('N')?.split_once(' ').map(|(_, words)| words))
            .collect();
        // F is written where it changes, with the first hole
        let first: Vec<String> = hole
            .iter()
            .map(|words| {
                if words.starts_with("G1") {
                    format!("{words} {feed}")
                } else {
                    (*words).to_owned()
                }
            })
            .collect();
        let at = blocks
            .iter()
            .position(|words| *words == "X10.")
            .expect("the first hole");
        assert_eq!(blocks[at + 1..=at + hole.len()], first, "{cycle}\n{written}");
        let at = blocks
            .iter()
            .position(|words| *words == "X20.")
            .expect("the second hole");
        // the tool is at the clearance already
        assert_eq!(blocks[at + 1..at + hole.len()], hole[1..], "{cycle}\n{written}");
    }
}

#[test]
fn what_is_no_plain_motion_or_is_unknown_is_refused() {
    for (cycle, line, why) in [
        (
            "CYCLE/TAP,DEPTH,10,MMPR,1.5,CLEAR,2",
            8,
            "couples the motion to the spindle",
        ),
        (
            "CYCLE/BORE,DEPTH,10,MMPM,100,CLEAR,2",
            9,
            "whether the tool goes back at the feed",
        ),
        ("CYCLE/THRU,DEPTH,10,MMPM,100,CLEAR,2", 8, "not modelled: CYCLE/THRU"),
        ("CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2,FOO,3", 8, "with FOO"),
    ] {
        let refused = refusal(to(
            (&program(cycle), "apt", ""),
            "fanuc-30i",
            "mill-3axis",
            &Options::default(),
        ));
        assert!(refused.message.contains(why), "{cycle}: {}", refused.message);
        assert_eq!(refused.place.map(|(line, _)| line), Some(line), "{cycle}");
    }
}
