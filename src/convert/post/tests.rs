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
