//! Blocks that something names by number stay, whether the run goes there or not.
use super::strategy_2::run;
use trunnion::check::Settings;
use trunnion::dialect::builtin;
use trunnion::interp::Setup;
use trunnion::machine;
use trunnion::rewrite::Options;

fn settings(dialect: &str) -> Settings<'static> {
    Settings::new(
        builtin(dialect).expect("built in"),
        machine::builtin("mill-3axis"),
        Setup::default(),
    )
}

const LINES: &str =
    "G0 X0 Y0 Z10\nG1 X10 Y0 Z0 F100\nN20 G1 X10 Y0 Z0 F100\nX20 Y0 Z0\nX30 Y0 Z0\nG1 X40 Y10 Z0 F200\n";

fn outcome(rewrite: &str, dialect: &str, text: &str) -> Result<Option<String>, String> {
    let attempt = run(rewrite, text, &settings(dialect), &Options::default());
    let proved = attempt.outcome()?;
    Ok(proved.map(|proved| String::from_utf8(proved.after).expect("UTF-8")))
}

#[test]
fn a_text_that_may_name_a_block_refuses_what_deletes_blocks() {
    for jump in [
        "EXECSTRING(\"GOTOB N20\")",
        "CYCLE95(\"N20:N40\",1)",
        "CYCLE62(\"\",2,\"N20\",\"N40\")",
    ] {
        let text = format!("G71 G17 G90 G94 G54\nS1000 M3\n{LINES}{jump}\nG0 Z10\nM30\n");
        for rewrite in ["drop-redundant", "fit-arcs", "renumber"] {
            let why = outcome(rewrite, "sinumerik-840d", &text).expect_err(rewrite);
            assert!(
                why.contains("line 9") && why.contains("may name a block"),
                "{rewrite}: {why}"
            );
        }
    }
    // a message is no jump
    let text = format!("G71 G17 G90 G94 G54\nS1000 M3\n{LINES}MSG(\"N20\")\nG0 Z10\nM30\n");
    let after = outcome("drop-redundant", "sinumerik-840d", &text).expect("proved");
    assert!(after.is_some_and(|after| !after.contains("N20 ")), "{text}");
}

#[test]
fn the_target_of_a_jump_that_is_not_taken_stays() {
    let lines = LINES.replace("Z10", "Z10.");
    let text = format!("G21 G17 G90 G94 G54\nS1000 M3\n#1=1\n{lines}IF[#1EQ5]GOTO20\nG0 Z10.\nM30\n");
    // where nothing is rewritten, the text is as it was
    let after = outcome("drop-redundant", "fanuc-30i", &text)
        .ok()
        .flatten()
        .unwrap_or(text);
    assert!(after.contains("\nN20 G1 X10 Y0 Z0 F100\n"), "{after}");
    let text = format!("G21 G17 G90 G94 G54\nS1000 M3\n{lines}M96 P20 Q3\nG0 Z10.\nM30\n");
    let why = outcome("drop-redundant", "haas-ngc", &text).expect_err("not proved");
    assert!(why.contains("M96"), "{why}");
}
