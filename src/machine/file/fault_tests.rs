//! Every complaint about a machine file: what it says and the place it points at.
use crate::load;

/// One fault per line: where the text goes, the text, what the error must point at, a part of its message. `axes`: the list of
/// axes, `XYZ` being three sound linear ones; `head` and `tail`: lines before and after a sound list; `;;` is a new line.
const FAULTS: &str = r#"
head | nmae = "x" | nmae | unknown key `nmae`
head | units = { length = "inch" } | "inch" | write "mm"
head | units = { angle = "rad" } | "rad" | write "deg"
head | units = { time = "min" } | "min" | write "s"
head | spindle = { tool_axis = [0, 0, 2] } | [0, 0, 2] | [0.000000000, 0.000000000, 1.000000000]
head | spindle = { tool_axis = [0, 0, 0] } | [0, 0, 0] | zero vector
head | spindle = { gauge_point = [0, nan, 0] } | [0, nan, 0] | three numbers
head | spindle = { gauge_point = [0, 0] } | [0, 0] | in [spindle] must be a list of three numbers
axes | {letter="Q", sign=1} | "Q" | not an axis letter
axes | {letter="XY"} | "XY" | not an axis letter
axes | {letter="C", sign=1} | "C" | side =
axes | {letter="X", sign=1,side="tail"} | "tail" | unknown value
axes | {letter="X", sign=1,dir=[1,1,0]} | [1,1,0] | [0.707106781, 0.707106781, 0.000000000]
axes | {letter="X",sign=2} | 2 | sign must be 1
axes | {letter="X", sign=1,limits=[5,-5]} | [5,-5] | below the upper
axes | {letter="X", sign=1,limits=[0,inf]} | [0,inf] | finite
axes | {letter="X", sign=1,limits="none"} | "none" | "unbounded" or [min, max]
axes | {letter="X", sign=1,limits=[1,2,3]} | [1,2,3] | [min, max]
axes | {letter="X", sign=1,limit_margin=-1} | -1 | negative
axes | {letter="X", sign=1,resolution=0} | 0 | greater than zero
axes | {letter="X", sign=1,dyn={vmax=0}} | 0 | greater than zero
axes | {letter="X", sign=1,dyn={vmax=-1}} | -1 | greater than zero
axes | {letter="X", sign=1,dyn={vmax=nan}} | nan | a number
axes | {letter="X", sign=1,dyn={vmax="fast"}} | "fast" | must be a number
axes | {letter="X", sign=1,dyn={speed=1}} | speed | unknown key
axes | {letter="X", sign=1,dyn={kff=1.5}} | 1.5 | must be at most 1
axes | {letter="A", sign=1,side="head",mode="diameter"} | "diameter" | linear axis
axes | XYZ,{letter="X", sign=-1} | "X" | listed twice
axes | {letter="x", sign=1} | "x" | write "X"
axes | XYZ,{letter="V",follow="y"} | "y" | write "Y"
axes | {letter="X"} | "X" | write sign = 1 (ISO 841
axes | {letter="C",side="table"} | "C" | sign = -1 (reversed)
axes | XYZ,{letter="V",follow="U"} | "U" | not an axis of this machine
axes | {letter="V",follow="V"} | "V" | cannot follow itself
axes | XYZ,{letter="C", sign=1,side="table"} | "C" | from workpiece to tool
axes | {letter="X", sign=1},{letter="Z", sign=1},{letter="C", sign=1,side="head"} | [{letter="X", sign=1},{letter="Z", sign=1},{letter="C", sign=1,side="head"}] | there are X, Z
axes | {letter="Z", sign=1},{letter="W", sign=1} | [{letter="Z", sign=1},{letter="W", sign=1}] | there are Z, W
axes |  | [] | there is none
axes | {letter="X", sign=1},{letter="Y", sign=1},{letter="Z", sign=1,dir=[0,1,0]} | [{letter="X", sign=1},{letter="Y", sign=1},{letter="Z", sign=1,dir=[0,1,0]}] | in independent directions
axes | {letter="C", sign=1,side="table"},{letter="A", sign=1,side="table",dir=[0,0,-1]},XYZ | {letter="A", sign=1,side="table",dir=[0,0,-1]} | C and A are parallel
axes | {letter="A", sign=1,side="table"},{letter="C", sign=1,side="table"},XYZ | {letter="C", sign=1,side="table"} | about the tool axis itself
axes | {letter="C", sign=1,side="table"},{letter="A", sign=1,side="table"},{letter="B", sign=1,side="table"},XYZ | {letter="B", sign=1,side="table"} | at most 2
axes | {letter="A", sign=1,side="table",hold=0,limits=[10,20]},XYZ | 0 | outside the limits
axes | {letter="X", sign=1,hold=0},{letter="Y", sign=1},{letter="Z", sign=1} | 0 | only for a rotary axis
axes | {letter="A",side="table",unknown=["sign","point"]},XYZ | "sign" | `sign`, `point` are unknown
axes | {letter="A",unknown=["side"]},XYZ | "side" | `side` is unknown
axes | XYZ,{letter="V",follow="Y",limits=[0,10]},{letter="U",follow="Y",limits=[20,30]} | "Y" | within the limits of both
axes | {letter="C", sign=1,side="table"},XYZ,{letter="A",sign=1,side="table",follow="X"} | "X" | linear and the other rotary
head | unknown = ["order"] | "order" | `order` of this machine is unknown
tail | [[check]];;joints = { A = 90 };;tool_length = 10;;tip = [0, 1, 0] | [0, 1, 0] | check sign, dir, point, kind and position in the list of axis A
tail | [[check]];;tip = [0, 1, 0] | [0, 1, 0] | only tool_axis, gauge_point and hold
tail | [[check]];;joints = { A = 90 };;axis = [0, 1, 0] | [0, 1, 0] | 180 deg away
tail | [[check]];;joints = { Q = 90 };;axis = [0, 1, 0] | Q | not an axis
tail | [[check]];;travel = { A = [0, 1] } | [0, 1] | not declared
tail | [[check]];;speed = { A = 1 } | 1 | not declared
tail | [[check]];;words = { A = "shortest" } | "shortest" | "literal" at the axis
tail | [[check]];;say = "x" | [[check]] | is empty
tail | [[check]];;axis = [0, 2, 0] | [0, 2, 0] | length 2
tail | [control];;family = "siemens" | "siemens" | known: generic
tail | [control];;rapid = "fast" | "fast" | unknown value
tail | [control];;tcp = { path = "round" } | "round" | known: tip-linear
tail | [control];;tcp = { orientation = "round" } | "round" | unknown value
tail | [control];;branch = { order = ["move3"] } | "move3" | known: time, move1
tail | [control];;branch = { rule = "nearest" } | "nearest" | known: generic
tail | [control];;branch = { range = { X = [0, 1] } } | X | linear axis
tail | [control];;feed = "tip" | "tip" | known: xyz
tail | [control];;pole = { action = "hold" } | "hold" | needs a cone
tail | [control];;branch = { range = { Q = [0, 1] } } | Q | not an axis
tail | [control];;branch = { range = { A = [1, 1] } } | [1, 1] | below the upper
tail | [control];;pole = { passing_type = 3 } | 3 | write 1 or 2
tail | [control];;pole = { action = "jump" } | "jump" | known: through
tail | [control];;corner = { model = "round" } | "round" | known: axis-jump
tail | [control];;units = "cm" | "cm" | units
tail | [control];;power_on = ["G177"] | "G177" | did you mean `G17`
tail | [control];;family = "fanuc-30i";;power_on = ["G710"] | "G710" | fanuc-30i has no G code `G710`
tail | [control];;reference_points = [{ Q = 1 }] | Q | not an axis
tail | [control];;reference_points = [{ X = inf }] | inf | reference_points
tail | [control];;tool_change = { Q = 1 } | Q | not an axis
tail | [control];;power_on = ["M3"] | "M3" | is not a G code
tail | [control];;power_on = "G17" | "G17" | must be a list
tail | [control];;peck_clearence = 1 | peck_clearence | did you mean `peck_clearance`?
tail | [control];;peck_clearance = "1" | "1" | `peck_clearance = 1`
tail | [control];;family = "fanuc-30" | "fanuc-30" | did you mean `fanuc-30i`?
tail | [control];;peck_clearance = -1 | -1 | negative
tail | [control];;tcp_codes = { on = ["428"] } | "428" | is not a code
tail | [control];;tcp_codes = { on = ["M428"], off = ["M428"] } | "M428" | both on and off
tail | [control];;planner = { block_time = -1 } | -1 | negative
tail | [control];;planner = { lookahead = 1.5 } | 1.5 | whole
tail | [control];;planner = { m_times = { S3 = 1 } } | S3 | not an M code
tail | [control];;corner = { model = "grbl" } | "grbl" | needs `deviation`
tail | [control];;corner = { model = "axis-jump", dv = { Q = 1 } } | Q | not an axis
tail | [control];;servo = { bandwidth = 0 } | 0 | greater than zero
tail | [tolerances];;tip = -0.1 | -0.1 | greater than zero
tail | [tolerances];;feed_drop = 2 | 2 | at most 1
tail | [tolerances];;tipp = 1 | tipp | unknown key
tail | [[body]];;carrier = "Q";;mesh = "a" | "Q" | cannot carry a body
"#;

const SCHEMA: &str = "schema = \"ncmachine/1\"\n";
const XYZ: &str = "{letter=\"X\", sign=1},{letter=\"Y\", sign=1},{letter=\"Z\", sign=1}";

fn file(place: &str, text: &str) -> String {
    let sound =
        format!("axis = [{{letter=\"C\", sign=1,side=\"table\"}},{{letter=\"A\", sign=1,side=\"table\"}},{XYZ}]\n");
    let text = text.replace(";;", "\n").replace("XYZ", XYZ);
    match place {
        "axes" => format!("{SCHEMA}axis = [{text}]\n"),
        "head" => format!("{SCHEMA}{text}\n{sound}"),
        _ => format!("{SCHEMA}{sound}{text}\n"),
    }
}

#[test]
fn every_fault_is_named_and_located() {
    let mut seen = 0;
    for line in FAULTS.lines().filter(|line| !line.is_empty()) {
        let [place, text, span, message] = line.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let toml = file(place, text);
        let error = load("bad", &toml).expect_err(line);
        let range = error
            .span
            .clone()
            .unwrap_or_else(|| panic!("no place for {error} in {line}"));
        assert_eq!(&toml[range], span, "{error} in {line}");
        assert!(error.message.contains(message), "{error} in {line}");
        seen += 1;
    }
    assert!(seen > 50);
}

#[test]
fn the_schema_comes_first() {
    let missing = load("bad", "axis = []").expect_err("no schema");
    assert!(missing.message.contains("the file lacks `schema`"), "{missing}");
    let text = "schema = \"ncmachine/2\"\naxis=[]";
    let other = load("bad", text).expect_err("another schema");
    assert_eq!(&text[other.span.clone().expect("a place")], "\"ncmachine/2\"");
    assert!(other.message.contains("reads \"ncmachine/1\""), "{other}");
}

/// As many obstacles as are judged, and one more.
#[test]
fn too_many_obstacles_are_told_at_the_first_of_them() {
    let boxes = |count: usize| "[[obstacle]]\nbox = [[0, 0, 0], [1, 1, 1]]\n".repeat(count);
    let machine = load("good", &file("tail", &boxes(1000))).expect("as many as may be");
    assert_eq!(machine.obstacles.0.len(), 1000);
    let text = file("tail", &boxes(1001));
    let error = load("bad", &text).expect_err("too many");
    assert!(
        error.message.starts_with("more than 1000 obstacles are declared; put "),
        "{error}"
    );
    let start = error.span.expect("a place").start;
    assert_eq!(text[..start].matches("[[obstacle]]").count(), 1000);
}
