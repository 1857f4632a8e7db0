//! What is wrong with a settings file, in words.
#[test]
fn what_is_wrong_is_said_with_its_key() {
    for (text, wanted) in [
        (
            "[tolerances]\ntip = \"0.02\"\n",
            "`tip` must be a number in mm: `tip = 0.02`",
        ),
        ("[tolerances]\ntip = \"small\"\n", "`tip` must be a number in mm"),
        ("machine = 3\n", "`machine` must be a text in quotes"),
        ("[limits]\nblocks = 0.5\n", "`blocks` must be a whole number"),
        ("[limits]\nblock = 5\n", "unknown key `block`; did you mean `blocks`?"),
        (
            "machin = \"mill-3axis\"\n",
            "unknown key `machin`; did you mean `machine`?",
        ),
    ] {
        let error = crate::config::Config::parse(text).expect_err(text);
        assert_eq!(error.message, wanted, "{text}");
    }
}
