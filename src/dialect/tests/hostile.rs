//! Broken tables are refused with the reason and the place.
use crate::{Action, Owner, load};

const HEAD: &str = "name = \"mine\"\ntitle = \"Mine\"\nsource = \"the shop's manual\"\nextends = \"iso-6983\"\n";

fn refusal(text: &str) -> (String, String) {
    let error = load(text).expect_err("the table must be refused");
    assert_eq!(error.to_string(), error.message);
    let place = error
        .span
        .map(|span| text.get(span).expect("the span lies inside the text").to_owned());
    (error.message, place.unwrap_or_default())
}

fn refused_with(body: &str, message: &str, place: &str) {
    let (said, at) = refusal(&format!("{HEAD}{body}"));
    assert!(said.contains(message), "{body}: said `{said}`, expected `{message}`");
    assert!(at.contains(place), "{body}: at `{at}`, expected `{place}`");
}

#[test]
fn a_table_of_ones_own_extends_a_built_in_one() {
    let body = "remove = [\"M60\", \"G80..G89\"]\n[groups]\nshop = \"shop codes\"\n[codes]\n\"G12.1\" = { group = \"shop\", action = \"no-motion\", doc = \"Door\" }\nM428 = { action = \"tcp-on\", doc = \"TCP\", source = \"builder\", owner = \"machine-builder\" }\nG0 = { group = \"motion\", action = \"rapid\", doc = \"Ours\" }\n";
    let dialect = load(&format!("{HEAD}{body}")).unwrap();
    assert_eq!(dialect.name, "mine");
    assert_eq!(dialect.g(121).unwrap().source, "the shop's manual");
    let m428 = dialect.m(4280).unwrap();
    assert_eq!(
        (m428.action, m428.source.as_str(), m428.owner),
        (Action::TcpOn, "builder", Owner::MachineBuilder)
    );
    assert_eq!(dialect.g(0).unwrap().doc, "Ours");
    assert_eq!(dialect.g(10).unwrap().action, Action::Linear);
    assert!(dialect.m(600).is_none());
    assert!(dialect.g(830).is_none());
    assert_eq!(dialect.codes().iter().filter(|code| code.id == "G0").count(), 1);
}

#[test]
fn the_table_in_the_readme_loads() {
    let readme = include_str!("../../../grammar/README.md");
    let table = readme.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let dialect = load(table).unwrap();
    assert_eq!(dialect.g(434).unwrap().source, "manual, volume 2");
    assert!(dialect.quirks.first_offset_at_start);
    assert!((dialect.arc_limit_mm(20.0, false) - 0.02).abs() < 1e-12);
}

#[test]
fn unknown_keys_and_values() {
    refused_with("colour = \"red\"\n", "unknown key `colour`", "colour");
    refused_with(
        "[codes]\nG0 = { action = \"rapid\", doc = \"x\", sorce = \"y\" }\n",
        "unknown key `sorce`",
        "sorce",
    );
    refused_with(
        "[codes]\nG0 = { action = \"rapidly\", doc = \"x\" }\n",
        "unknown value `rapidly`",
        "rapidly",
    );
    refused_with("[roles]\nX = \"axle\"\n", "unknown value `axle`", "axle");
    refused_with("[quirks]\nodd = true\n", "unknown key `odd`", "odd");
    refused_with(
        "[quirks]\narc-tolerance-relative = 0.5\n",
        "unknown key",
        "arc-tolerance-relative",
    );
    refused_with("[lex]\nformat = \"iso\"\n", "[lex] lacks `paren-comment`", "");
    refused_with("[codes]\nG0 = { action = \"rapid\" }\n", "[codes.G0] lacks `doc`", "");
    refused_with("[codes]\nG0 = 5\n", "must be a table", "5");
}

#[test]
fn duplicates() {
    let row = "{ action = \"rapid\", doc = \"x\" }";
    refused_with(
        &format!("[codes]\nG0 = {row}\nG0 = {row}\n"),
        "`G0` is declared twice",
        "G0",
    );
    refused_with(&format!("[codes]\nG0 = {row}\nG00 = {row}\n"), "leading zero", "G00");
    refused_with("[roles]\nX = \"axis\"\nX = \"axis\"\n", "`X` is declared twice", "X");
}

#[test]
fn bad_ids() {
    let row = "{ action = \"rapid\", doc = \"x\" }";
    for id in [
        "g0",
        "G1000",
        "G1.25",
        "G1.",
        "G1.0",
        "G-1",
        "M007",
        "",
        "TRA ORI",
        "traori",
        "1G",
        "G5..G3",
        "G5..M7",
        "G1..",
        "..G5",
        "X=",
        "\u{dc}BER",
    ] {
        let (message, place) = refusal(&format!("{HEAD}[codes]\n\"{id}\" = {row}\n"));
        assert!(message.contains("code"), "{id}: {message}");
        assert!(place.contains(id), "{id}: {place}");
    }
}

#[test]
fn groups_documentation_and_sources() {
    refused_with(
        "[codes]\nG0 = { group = \"moves\", action = \"rapid\", doc = \"x\" }\n",
        "has no group `moves`",
        "\"moves\"",
    );
    refused_with(
        "[codes]\nG0 = { action = \"rapid\", doc = \" \" }\n",
        "one line",
        "\" \"",
    );
    refused_with(
        "[codes]\nG0 = { action = \"rapid\", doc = \"a\\nb\" }\n",
        "one line",
        "a\\nb",
    );
    refused_with(
        "[codes]\nG0 = { action = \"rapid\", doc = \"x\", source = \"\" }\n",
        "the source is empty",
        "\"\"",
    );
    refused_with(
        "[codes]\nG187 = { action = \"path-mode\", words = [\"P\"], lengths = [\"E\"], doc = \"x\" }\n",
        "`E` of `lengths` is not among its `words`",
        "\"E\"",
    );
    refused_with("[groups]\n\"Big Group\" = \"x\"\n", "lower-case", "Big Group");
}

#[test]
fn base_names_letters_and_lists() {
    let other = HEAD.replace("iso-6983", "iso");
    let (message, place) = refusal(&other);
    assert!(
        message.contains("unknown built-in dialect `iso`") && message.contains("sinumerik-840d"),
        "{message}"
    );
    assert_eq!(place, "\"iso\"");
    assert!(refusal(&HEAD.replace("mine", "iso-6983")).0.contains("extend itself"));
    assert!(refusal(&HEAD.replace("mine", "My Table")).0.contains("lower-case"));
    assert!(
        refusal("name = \"mine\"\ntitle = \"t\"\nsource = \"s\"\n")
            .0
            .contains("[lex]")
    );
    let lex = "[lex]\nformat = \"iso\"\nparen-comment = true\nsemicolon-comment = true\nslash-star-comment = true\nblanks-in-numbers = false\n";
    assert!(
        refusal(&format!("name = \"mine\"\ntitle = \"t\"\nsource = \"s\"\n{lex}"))
            .0
            .contains("[arc-tolerance]")
    );
    refused_with("remove = [\"G77\"]\n", "there is nothing to remove", "\"G77\"");
    refused_with("remove = [\"G01\"]\n", "leading zero", "\"G01\"");
    refused_with("builder-codes = [\"TRAORI\"]\n", "only G and M", "\"TRAORI\"");
    refused_with("extensions = [\".nc\"]\n", "without the dot", "\".nc\"");
    refused_with("[roles]\nx = \"axis\"\n", "one upper-case letter", "x");
    refused_with("[roles]\nXY = \"axis\"\n", "upper-case letter", "XY");
    refused_with("[addresses]\n\"AB#\" = \"axis\"\n", "AB#", "AB#");
    refused_with("[addresses]\n\"\" = \"axis\"\n", "upper-case name", "");
    refused_with("[arc-tolerance]\nmm = 0\nsource = \"s\"\n", "greater than 0", "0");
    refused_with("[arc-tolerance]\nmm = nan\nsource = \"s\"\n", "greater than 0", "nan");
    refused_with(
        "[arc-tolerance]\nmm = 0.1\nrelative = inf\nsource = \"s\"\n",
        "greater than 0",
        "inf",
    );
    refused_with(
        "[arc-tolerance]\nmm = 0.1\nsource = \"\"\n",
        "the source of the tolerance",
        "\"\"",
    );
    assert!(
        refusal(&HEAD.replace("the shop's manual", "")).0.is_empty()
            || load(&HEAD.replace("the shop's manual", "")).is_err()
    );
}

#[test]
fn broken_toml_says_where() {
    for text in [
        "name = ",
        "name = \"a",
        "[codes\n",
        "= 5",
        "name = 5",
        "\u{0}",
        "[[codes]]",
        "codes = []",
        "name.x = 1",
    ] {
        assert!(!load(text).expect_err(text).message.is_empty(), "{text}");
    }
    let (_, place) = refusal("title = \"t\"\nname = 17\n");
    assert_eq!(place, "17");
}

proptest::proptest! {
    #[test]
    fn any_text_is_loaded_or_refused(text in "\\PC*") {
        let _ = load(&text);
    }
    #[test]
    fn any_damage_to_a_table_is_loaded_or_refused(at in 0_usize..20_000, with in "[ -~]{0,3}") {
        let table = include_str!("../../../grammar/dialects/sinumerik-840d.toml");
        let at = at % table.len();
        if table.is_char_boundary(at) && table.is_char_boundary(at + 1) {
            let damaged = format!("{}{with}{}", &table[..at], &table[at + 1..]);
            if let Err(error) = load(&damaged) {
                let span = error.span.unwrap_or(0..0);
                proptest::prop_assert!(span.end <= damaged.len());
            }
        }
    }
}

#[test]
fn a_shop_table_adds_to_a_control() {
    let text = "name = \"shop\"\nextends = \"fanuc-30i\"\n\n[codes]\nM60 = { action = \"tool-change\", doc = \"Pallet change with tool\", owner = \"machine-builder\" }\n";
    let dialect = crate::Dialect::from_table(text, "shop.toml").unwrap();
    assert_eq!(dialect.m(600).unwrap().owner, Owner::MachineBuilder);
    assert_eq!(dialect.m(600).unwrap().source, "the table shop");
    // what the table does not say is as in the control that it extends
    assert!(dialect.quirks.dwell_in_ms && dialect.quirks.whole_numbers.lengths_ambiguous());
    assert!(dialect.builder_may_own(crate::CodeKind::M, 1230));
    assert_eq!(dialect.alarm("peck-missing").unwrap().number, "PS0045");
    let own = crate::Dialect::from_table(
        "name = \"shop\"\nextends = \"fanuc-30i\"\n[quirks]\ntool-word = \"changes\"\n",
        "shop.toml",
    );
    assert!(own.is_ok_and(|own| own.quirks.tool_word.changes() && own.quirks.dwell_in_ms));
}

#[test]
fn a_broken_shop_table_is_told_with_line_and_column() {
    let text = "name = \"shop\"\nextends = \"fanuc-30i\"\n[codes]\nM60 = { akction = \"rapid\", doc = \"x\" }\n";
    let error = crate::Dialect::from_table(text, "shop.toml").unwrap_err();
    assert_eq!((error.line, error.column), (Some(4), Some(9)));
    assert!(
        error.to_string().starts_with("shop.toml:4:9: unknown key `akction`"),
        "{error}"
    );
    let axis = "name = \"shop\"\nextends = \"fanuc-30i\"\n[roles]\nE = \"axis\"\n";
    let error = crate::Dialect::from_table(axis, "shop.toml").unwrap_err();
    assert_eq!(
        error.to_string(),
        "shop.toml:4:1: `E` is not an axis; the axes are X Y Z A B C U V W"
    );
}
