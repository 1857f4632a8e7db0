//! What is wrong with a settings file, in words.
#[test]
fn what_is_wrong_is_said_with_its_key() {
    for (text, wanted) in [
        (
            "[tolerances]\ntip = \"0.02\"\n",
            "`tip` must be a number in mm: `tip = 0.02`",
        ),
        ("[tolerances]\ntip = \"small\"\n", "`tip` must be a number in mm"),
        (
            "[[tool]]\nnumber = 1\nshape = \"turning\"\nnose_radius = 0.8\n",
            "a turning tool needs its nose radius in mm and where its tip is: `nose_radius = 0.8`, `tip_direction = 3`",
        ),
        (
            "[[tool]]\nnumber = 1\nshape = \"turning\"\nnose_radius = 0.8\ntip_direction = 10\n",
            "`tip_direction` must be 0 to 9, the direction of the imaginary tool nose",
        ),
        (
            "[[tool]]\nnumber = 1\nnose_radius = 0.8\n",
            "`nose_radius` and `tip_direction` belong to a turning tool: add `shape = \"turning\"`",
        ),
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
