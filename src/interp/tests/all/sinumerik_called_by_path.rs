//! Sinumerik: programs that are called by a path, from outside, and in ISO language.
use crate::sinumerik_calls::run;

/// Motions of a program that calls another one by a path, about which nothing else is said.
fn called(source: &str) -> Vec<String> {
    let (lines, said) = run(source);
    let of_path = |said: &String| said.contains("the file of the last name is taken");
    let by_path = source.contains(['/', '\\']) || source.contains("EXTCALL");
    assert!(
        said.iter().all(of_path) && said.len() == usize::from(by_path),
        "{source}: {said:?}"
    );
    lines
}

/// Of a path only the last name is looked for; an ending says which sort of program is meant.
#[test]
fn a_path_leads_to_the_file_of_its_last_name() {
    for (call, y) in [
        ("PCALL /_N_SPF_DIR/_N_PLAIN_SPF", "1"),
        ("PCALL PLAIN", "1"),
        ("CALL \"/_N_WKS_DIR/_N_PART_WPD/_N_PLAIN_SPF\"", "1"),
        ("EXTCALL(\"C:/WORK/PLAIN.SPF\")", "1"),
        ("EXTCALL \"PLAIN\"", "1"),
        ("EXTCALL(\"MAINP\")", "7"),
        ("EXTCALL(\"MAINP.SPF\")", "8"),
        ("CALL \"_N_MAINP_SPF\"", "8"),
        ("PCALL /_N_MPF_DIR/_N_MAINP_MPF", "7"),
    ] {
        let made = called(&format!("G0 X1\n{call}\nX2\nM30\n"));
        assert_eq!(made, ["R X1", &format!("R X1 Y{y}"), &format!("R X2 Y{y}")], "{call}");
    }
    // the programs of the same text are others
    let (made, _) = run("%_N_MAIN_MPF\nG0 X1\nPCALL /DIR/_N_INNER_SPF\nX2\nM30\n%_N_INNER_SPF\nX9\nM17\n");
    assert!(!made.iter().any(|line| line.contains("X9")), "{made:?}");
    assert_eq!(called("PCALL /_N_SPF_DIR/_N_L140_SPF(7)\nM30\n"), ["R Z7"]);
    let text = "DEF STRING[20] NAME=\"C:/PLAIN\"\nG0 X1\nEXTCALL(NAME<<\".SPF\")\nM30\n";
    assert_eq!(called(text), ["R X1", "R X1 Y1"]);
    for call in [
        "PCALL /DIR/NOSUCH",
        "CALL \"/DIR/NOSUCH\"",
        "EXTCALL \"NOSUCH\"",
        "EXTCALL(\"C:/L140.MPF\")",
    ] {
        let (made, said) = run(&format!("R1=4\nG0 X1 Y1\n{call}\nX2\nX=R1\nM30\n"));
        assert!(
            said.len() == 2 && said[0].contains("no file of that name was found"),
            "{call}: {said:?}"
        );
        assert_eq!(made[..2], ["R X1 Y1", "R X2"], "{call}");
    }
}

/// Blocks of an ISO language are not read, so that codes in effect, positions and variables are unknown after them.
#[test]
fn a_program_in_iso_language_is_unknown() {
    for call in ["ISOCALL PLAIN", "ISOCALL NOSUCH", "ISOCALL \"PLAIN\""] {
        let (made, said) = run(&format!("R1=4\nG0 X1 Y1\n{call}\nG90 X2\nG1 X=R1 F100\nM30\n"));
        assert!(
            said[0].contains("ISOCALL: ISO language, as after G291, is not read"),
            "{call}: {said:?}"
        );
        assert!(!said.iter().any(|said| said.contains("no code")), "{call}: {said:?}");
        assert!(
            said.iter().any(|said| said.contains("R1: jumps or calls")),
            "{call}: {said:?}"
        );
        assert_eq!(made[0], "R X1 Y1");
        assert!(made[1..].iter().all(|line| !line.contains('X')), "{call}: {made:?}");
    }
}
