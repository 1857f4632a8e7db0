//! Programs for an Okuma OSP: written, read back, and written again for the first control.
use super::support::to;
use trunnion_convert::Options;

const PART: &str = "O1\nG21 G90 G94 G17 G54\nT1 M6\nS8000 M3\nG0 X10. Y-5.\nG43 H1 Z50.\nM8\nG1 Z-1. F300\nX20. F500\nG2 X30. Y-15. I0 J-10.\nG3 X20. Y-5. R10.\n\
                    G4 P500\nG1 Y10.\nG81 X10. Y10. Z-5. R2. F100\nX20.\nG80\nG0 Z50.\nM9\nM5\nM30\n";

#[test]
fn there_and_back_in_three_axes() {
    let options = Options::default();
    let okuma = to((PART, "fanuc-30i", "mill-3axis"), "okuma-osp", "mill-3axis", &options);
    let okuma = okuma.unwrap_or_else(|refused| panic!("{refused}"));
    let lines: Vec<&str> = okuma.text.lines().collect();
    for line in [
        "O0001",
        "G15 H1",
        "G0 G56 H1 X10. Y-5. Z50.",
        "G4 F0.5",
        "G17 G2 X30. Y-15. I0. J-10.",
        "M2",
    ] {
        assert!(lines.contains(&line), "{line} in {}", okuma.text);
    }
    // one control names its zero points otherwise: the report says which stands for which
    assert_eq!(okuma.renamed_offset, Some(("G54".to_owned(), "G15 H1".to_owned())));
    let back = to(
        (&okuma.text, "okuma-osp", "mill-3axis"),
        "fanuc-30i",
        "mill-3axis",
        &options,
    );
    let back = back.unwrap_or_else(|refused| panic!("{refused}"));
    assert_eq!(back.renamed_offset, Some(("G15 H1".to_owned(), "G54".to_owned())));
    assert_eq!(okuma.proof.motions_after, back.proof.motions_after);
    // the same control keeps the names
    let again = to(
        (&okuma.text, "okuma-osp", "mill-3axis"),
        "okuma-osp",
        "mill-3axis",
        &options,
    );
    assert_eq!(again.unwrap_or_else(|refused| panic!("{refused}")).renamed_offset, None);
}

#[test]
fn five_axes_under_tip_control() {
    let part = "O1\nG21 G90 G94 G17 G54\nT1 M6\nS8000 M3\nG0 A0 C0\nG43.4 H1\nG0 X0. Y0. Z60.\nG1 X10. A5. C20. F800\nX20. A8. C30.\nG0 Z80.\nG49\nM30\n";
    let from = (part, "fanuc-30i", "mikron-ucp710");
    let okuma = to(from, "okuma-osp", "mikron-ucp710", &Options::default());
    let okuma = okuma.unwrap_or_else(|refused| panic!("{refused}"));
    assert!(
        okuma.text.contains("G169 H1\n") && okuma.text.contains("G170\n"),
        "{}",
        okuma.text
    );
    assert!(okuma.proof.path_mm <= okuma.claim.path_mm);
}

#[test]
fn what_an_okuma_cannot_say_is_refused_by_name() {
    let part = PART.replace("G4 P500", "G61 G1 X30. F100");
    let refused = to(
        (&part, "fanuc-30i", "mill-3axis"),
        "okuma-osp",
        "mill-3axis",
        &Options::default(),
    );
    let message = refused.err().map(|refused| refused.to_string()).unwrap_or_default();
    assert!(message.contains("G61 sets how exactly"), "{message}");
    let inch = Options {
        units: trunnion_convert::Units::Inch,
        ..Options::default()
    };
    assert!(to((PART, "fanuc-30i", "mill-3axis"), "okuma-osp", "mill-3axis", &inch).is_err());
}
