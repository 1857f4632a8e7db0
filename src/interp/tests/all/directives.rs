//! Comments that address Trunnion.
use trunnion_dialect::builtin;
use trunnion_interp::{Directive, Tool, ToolShape, directives};
use trunnion_syntax::parse;

fn read(dialect: &str, source: &str) -> Vec<Directive> {
    let program = parse(
        source.as_bytes().to_vec(),
        builtin(dialect).expect("a built-in dialect").lex,
    );
    let found = directives(&program);
    for (range, _) in &found {
        assert!(program.text(*range).to_ascii_lowercase().contains("trunnion:"));
    }
    found.into_iter().map(|(_, directive)| directive).collect()
}

fn tool(number: u32, shape: Option<ToolShape>, diameter_mm: Option<f64>, length_mm: Option<f64>) -> Directive {
    Directive::Tool(Tool {
        number,
        shape,
        diameter_mm,
        length_mm,
        holder_mm: None,
    })
}

#[test]
fn tools() {
    let one = |text: &str| read("iso-6983", &format!("({text})\n"));
    assert_eq!(
        one("trunnion: tool 1 ball diameter 10"),
        [tool(1, Some(ToolShape::Ball), Some(10.0), None)]
    );
    assert_eq!(
        one("TRUNNION:tool 2 Bull diameter 10 radius 0.5 length 80"),
        [tool(2, Some(ToolShape::Bull(0.5)), Some(10.0), Some(80.0))]
    );
    assert_eq!(
        one(" trunnion: tool 3 flat length 80.5 diameter 6 "),
        [tool(3, Some(ToolShape::Flat), Some(6.0), Some(80.5))]
    );
    assert_eq!(one("trunnion: tool 4 length 80"), [tool(4, None, None, Some(80.0))]);
    assert_eq!(
        one("trunnion: tool 1 ball diameter 10 radius 5"),
        [tool(1, Some(ToolShape::Ball), Some(10.0), None)]
    );
}

#[test]
fn broken_directives() {
    for text in [
        "tool 1 ball",
        "tool ball diameter 10",
        "tool 1 ball diameter",
        "tool 1 ball diameter ten",
        "tool 1 ball diameter -10",
        "tool 1 ball diameter 10 diameter 10",
        "tool 1 bull diameter 10",
        "tool 1 bull diameter 10 radius 6",
        "tool 1 ball diameter 10 radius 0.5",
        "tool 1",
        "allow",
        "dialect",
        "turned",
        "turned by 0.1",
        "turned -0.1",
        "turned 0",
        "frobnicate",
        "",
    ] {
        let got = read("iso-6983", &format!("(trunnion: {text})\n"));
        assert!(matches!(&got[..], [Directive::Broken(_)]), "{text}: {got:?}");
    }
}

#[test]
fn obstacles_are_read_elsewhere() {
    let keys = "name = \"clamp\", box = [[0, 0, 0], [4, 2, 3]]";
    for (dialect, text) in [
        ("fanuc-30i", format!("G1 X1 (trunnion: obstacle {keys})\n")),
        ("sinumerik-840d", format!(";TRUNNION:OBSTACLE {keys}\n")),
    ] {
        assert!(trunnion_interp::may_declare_obstacles(text.as_bytes()));
        assert_eq!(read(dialect, &text), [Directive::Obstacle(keys.to_owned())]);
    }
    assert!(!trunnion_interp::may_declare_obstacles(
        b"(trunnion: tool 1 ball diameter 10)\n(obstacle)"
    ));
}

#[test]
fn turned_tool_axes() {
    assert_eq!(
        read("iso-6983", "X1 (trunnion: turned 0.1)\n"),
        [Directive::Turned(0.1)]
    );
    assert_eq!(read("apt", "$$ Trunnion: TURNED 1\n"), [Directive::Turned(1.0)]);
    assert_eq!(trunnion_interp::turned_deg(" trunnion: turned 0.25 "), Some(0.25));
    assert_eq!(trunnion_interp::turned_deg("turned 0.25"), None);
    assert_eq!(trunnion_interp::turned_deg("trunnion: tool 1 ball diameter 10"), None);
}

#[test]
fn allow_and_modes() {
    let allow = |rule: &str, reason: &str| Directive::Allow {
        rule: rule.to_owned(),
        reason: reason.to_owned(),
    };
    let mode = |key: &str, value: &str| Directive::Mode {
        key: key.to_owned(),
        value: value.to_owned(),
    };
    let source = "; trunnion: dialect sinumerik-840d\n;trunnion: machine my/mill.toml\nG1 X1 ; trunnion: allow pole-flip because the tool is out of the cut\n\
                  ; trunnion: allow axis-limit\nMSG(\"trunnion: tool 1\")\n; no trunnion: allow x\n";
    assert_eq!(
        read("sinumerik-840d", source),
        [
            mode("dialect", "sinumerik-840d"),
            mode("machine", "my/mill.toml"),
            allow("pole-flip", "the tool is out of the cut"),
            allow("axis-limit", ""),
        ]
    );
}

#[test]
fn apt_comments() {
    let source = "$$ trunnion: tool 5 ball diameter 12\nGOTO/1,2,3 $$ trunnion: allow missing-feed because a test\n";
    assert_eq!(read("apt", source).len(), 2);
}
