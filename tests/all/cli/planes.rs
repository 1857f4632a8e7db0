//! Where the tool is after a tilted plane of Klartext ends.
use super::tools::{status, str, text, trunnion, write};
use tempfile::TempDir;

const TURNED: &str = "BEGIN PGM T MM\nTOOL CALL 1 Z S1000 F500\nM3\nL Z+100 R0 FMAX\nL X+0 Y+0 A+0 C+0 R0 FMAX\n\
    PLANE SPATIAL SPA+20 SPB+10 SPC+30 TURN FMAX\nL X+10 Y+5 Z+50 R0 FMAX\n";
const SETTINGS: &str = "[[tool]]\nnumber = 1\nlength = 80\n[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n";

/// X, Y, Z of the part and the joints C and A at the last motion.
fn last(blocks: &str) -> [f64; 5] {
    let folder = TempDir::new().expect("works");
    write(&folder, "trunnion.toml", SETTINGS);
    let file = write(
        &folder,
        "t.h",
        &format!("{TURNED}{blocks}L X+30 Y+0 Z-3 F500\nM30\nEND PGM T MM\n"),
    );
    let output = trunnion(&["trace", str(&file), "--machine", "mikron-ucp710"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let table = text(&output.stdout);
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let row: Vec<&str> = lines.last().expect("a row").split(',').collect();
    ["x_mm", "y_mm", "z_mm", "joint_c", "joint_a"].map(|name| {
        let column = names.iter().position(|known| *known == name).expect("a column");
        row[column].parse().unwrap_or(f64::NAN)
    })
}

fn near(found: [f64; 5], wanted: [f64; 5]) -> bool {
    found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-3)
}

/// PLANE RESET with TURN or MOVE turns the rotary axes back to 0: X Y Z are where the program says.
#[test]
fn a_reset_turns_back_to_zero() {
    for reset in ["TURN FMAX", "MOVE DIST50 FMAX"] {
        let found = last(&format!("PLANE RESET {reset}\n"));
        assert!(near(found, [30.0, 0.0, -3.0, 0.0, 0.0]), "{reset}: {found:?}");
    }
}

/// Zero angles are a plane: on an axis that stays turned they follow the part, as angles near zero do.
#[test]
fn zero_angles_are_a_plane() {
    for angle in ["0", "0.000001"] {
        let found = last(&format!("PLANE SPATIAL SPA+0 SPB+0 SPC+{angle} TURN FMAX\n"));
        let turned = found[3];
        assert!(
            turned.abs() > 1.0 && near(found, [30.0, 0.0, -3.0, turned, 0.0]),
            "{angle}: {found:?}"
        );
    }
}
