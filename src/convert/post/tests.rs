//! Posts as they are loaded.
use super::*;

#[test]
fn every_built_in_post_loads_and_names_its_dialect() {
    for (index, name) in BUILTIN_POSTS.iter().enumerate() {
        let post = load_post(TEXTS[index]).unwrap_or_else(|error| panic!("{name}: {}", error.message));
        assert_eq!(post.dialect, *name);
    }
}

fn error(text: &str) -> (String, String) {
    let error = load_post(text).expect_err("refused");
    let at = error.span.map_or(String::new(), |span| text[span].to_owned());
    (error.message, at)
}

#[test]
fn unknown_names_are_told_with_their_place() {
    let (message, at) =
        error("extends = \"fanuc-30i\"\n[templates]\nheader = \"\"\"\n%\nO{number} {porgram}\n\"\"\"\n");
    assert!(
        message.contains("{porgram}") && message.contains("{program}"),
        "{message}"
    );
    assert_eq!(at, "{porgram");
    let (message, at) = error("extends = \"grbl\"\n[templates]\nheadr = \"\"\n");
    assert!(message.contains("no template is named \"headr\""), "{message}");
    assert_eq!(at, "headr");
    assert_eq!(error("extends = \"grbel\"\n").1, "\"grbel\"");
    assert_eq!(error("extends = \"grbl\"\n[numbers]\nangle = 40\n").1, "40");
    assert!(error("extension = \"nc\"\n").0.contains("names its `dialect`"));
    assert!(
        error("extends = \"grbl\"\n[without]\ntemplates = [\"vector\"]\n")
            .0
            .contains("vector")
    );
    assert!(error("dialect = \"apt\"\n").0.contains("no dialect of G-code"));
}

/// A template that names a value again and again makes each comment as long as the template times the comment.
#[test]
fn a_template_is_of_a_size_that_a_program_needs() {
    let post =
        |key: &str, value: &str| load_post(&format!("extends = \"fanuc-30i\"\n[templates]\n{key} = '{value}'\n"));
    for (key, name, times) in [
        ("comment", "text", 2),
        ("tool-change", "tool", 8),
        ("footer", "number", 4),
    ] {
        assert!(post(key, &format!("({{{name}}})").repeat(times)).is_ok(), "{key}");
        let error = post(key, &format!("({{{name}}})").repeat(times + 1)).expect_err("too often");
        let wanted = format!("names {{{name}}} {} times; {times} times are the most", times + 1);
        assert!(error.message.contains(&wanted), "{}", error.message);
        assert!(error.span.is_some());
    }
    for (key, most) in [("comment", 250), ("stop", 2000), ("header", 20_000)] {
        assert!(post(key, &"x".repeat(most)).is_ok(), "{key}");
        let error = post(key, &"x".repeat(most + 1)).expect_err("too long");
        assert!(
            error.message.contains(&format!("{most} are the most")),
            "{}",
            error.message
        );
    }
    // a name as long as the file is not shown whole
    let error = post("header", &format!("{{{}}}", "x".repeat(1_000_000))).expect_err("unknown");
    assert!(error.message.len() < 300, "{}", error.message.len());
}
