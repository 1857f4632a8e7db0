//! What is wrong with a settings file, in words.
#[test]
fn what_is_wrong_is_said_with_its_key() {
    says(&[
        (
            "[tolerances]\ntip = \"0.02\"\n",
            "`tip` in [tolerances] must be a number (`path-deviation`: how far the tip may leave the programmed segment, mm): `tip = 0.02`",
        ),
        (
            "[tolerances]\ntip = 0.02 mm\n",
            "`tip` in [tolerances] must be a number without its unit (`path-deviation`: how far the tip may leave the programmed segment, mm): `tip = 0.02`",
        ),
        (
            "machine = mill-3axis\n",
            "`machine` must be a text in quotes: `machine = \"mill-3axis\"`",
        ),
        (
            "[tolerances]\ntip = \"small\"\n",
            "`tip` in [tolerances] must be a number (`path-deviation`: how far the tip may leave the programmed segment, mm): `tip = 1.0`",
        ),
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
        (
            "machine = 3\n",
            "`machine` must be a text in quotes (The machine: name of a built-in one (`trunnion machine list`), or a file relative to this one): \
             `machine = \"mill-3axis\"`",
        ),
        (
            "[limits]\nblocks = 0.5\n",
            "`blocks` in [limits] must be a whole number (Executed blocks in addition to those of the text, after which `check` reports a loop as \
             endless, from 1): `blocks = 3000000`",
        ),
        (
            "dialect = \"fanuc-30i\"\n[control]\npower_on = [\"G17\", \"G177\"]\n",
            "`power_on`: fanuc-30i has no G code `G177`; did you mean `G17`?",
        ),
        (
            "[limits]\nblock = 5\n",
            "unknown key `block` in [limits]; did you mean `blocks`?",
        ),
    ]);
}

/// Each text is refused with the message.
#[track_caller]
fn says(all: &[(&str, &str)]) {
    for (text, wanted) in all {
        let error = crate::config::Config::parse(text).expect_err(text);
        assert_eq!(error.message, *wanted, "{text}");
    }
}

/// A key that is missing or in the wrong table, and a value of another kind, get a line that is right.
#[test]
fn a_line_that_is_right_is_shown() {
    says(&[
        (
            "[[tool]]\ndiameter = 5\n",
            "[[tool]] lacks `number` (Number of the tool, each once): add `number = 1`",
        ),
        (
            "tool = [{ diameter = 5 }]\n",
            "[[tool]] lacks `number` (Number of the tool, each once): add `number = 1`",
        ),
        (
            "[[tool]]\nnumber = 1\ntip = 3\n",
            "unknown key `tip` in [[tool]]: it belongs in [tolerances] (`path-deviation`: how far the tip may leave the programmed segment, mm)",
        ),
        ("diameter = 5\n", "unknown key `diameter`: it belongs in [[tool]] (mm)"),
        (
            "[work_offsets]\nG54 = [0, -10.5, 0]\n",
            "`G54` in [work_offsets] must be a table: `G54 = { X = 0, Y = -10.5, Z = 0 }`",
        ),
        (
            "[work_offsets]\n\"G54.1 P1\" = 0\n",
            "`G54.1 P1` in [work_offsets] must be a table: `\"G54.1 P1\" = { X = 0, Y = 0, Z = 0 }`",
        ),
        (
            "[work_offsets]\nG54 = { X = \"5\" }\n",
            "`X` in [work_offsets] G54 must be a number: `X = 5`",
        ),
        (
            "limits = 5\n",
            "`limits` must be a table (Bounds of a run): write `[limits]` on a line of its own and its keys below, for example `blocks`",
        ),
        (
            "[control]\ntcp_codes = 5\n",
            "`tcp_codes` in [control] must be a table (LinuxCNC: codes of the machine builder that switch the kinematics): write \
             `[control.tcp_codes]` on a line of its own and its keys below, for example `at_start`",
        ),
        (
            "tool = 5\n",
            "`tool` must be a list of tables (The tools): write `[[tool]]` on a line of its own and its keys below, for example `number`",
        ),
        (
            "port_to = [5]\n",
            "an entry of `port_to` must be a text in quotes (Dialects of other controls: the rule `porting` reports what would change its meaning there): \
             `port_to = [\"haas-ngc\"]`",
        ),
        (
            "[format]\ncase = 5\n",
            "`case` in [format] must be \"upper\" or \"lower\" or \"keep\" (Case of letters: \"upper\" (default), \"lower\" or \"keep\"): `case = \"upper\"`",
        ),
        (
            "machin = \"mill-3axis\"\n",
            "unknown key `machin`; did you mean `machine`?",
        ),
    ]);
}

/// Brackets, braces and dots without end: the reader of TOML says `recursion limit`.
#[test]
fn what_is_nested_too_deeply_is_told() {
    for text in [
        format!("a = {}", "[".repeat(100_000)),
        format!("a = {}", "{a = ".repeat(1000)),
        format!("a = {}{}", "[".repeat(100), "]".repeat(100)),
        format!("a{} = 1", ".a".repeat(100_000)),
    ] {
        let error = crate::config::Config::parse(&text).expect_err("too deep");
        assert!(error.message.contains("remove the brackets, braces or dots"), "{error}");
    }
}

/// As many obstacles as are judged, and one more.
#[test]
fn too_many_obstacles_are_told_at_the_first_of_them() {
    let boxes = |count: usize| "[[obstacle]]\nbox = [[0, 0, 0], [1, 1, 1]]\n".repeat(count);
    let most = trunnion_machine::MOST_OBSTACLES;
    let config = crate::config::Config::parse(&boxes(most)).expect("as many as may be");
    assert_eq!(config.obstacles.len(), most);
    let text = boxes(most + 5);
    let error = crate::config::Config::parse(&text).expect_err("too many");
    assert!(
        error.message.starts_with("more than 1000 obstacles are declared; put "),
        "{error}"
    );
    assert_eq!(error.span.expect("a place").start, boxes(most).len());
}
