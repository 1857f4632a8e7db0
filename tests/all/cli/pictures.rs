//! `surface` and `plot`: the saddle's error in numbers, and pictures that are whole, labelled and small.
use super::tools::{FLIP, json, status, str, text, trunnion, write};
use std::path::PathBuf;
use tempfile::TempDir;

const MACHINE: &str = "mikron-ucp710";

fn saddle(folder: &TempDir, name: &str, windings: &str) -> (PathBuf, PathBuf) {
    let (file, part) = (folder.path().join(name), folder.path().join("saddle.toml"));
    let output = trunnion(&[
        "sample",
        "saddle",
        "--origin",
        "0,0,50",
        "--machine",
        MACHINE,
        "--style",
        "joints",
        "--posture",
        "positive",
        "--windings",
        windings,
        "--required",
        str(&part),
        "-o",
        str(&file),
    ]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    (file, part)
}

#[test]
fn the_saddle_in_numbers_and_as_a_map() {
    let folder = TempDir::new().expect("works");
    for (windings, middle) in [("naive", 104.155), ("nearest", 12.937)] {
        let (file, part) = saddle(&folder, "saddle.mpf", windings);
        let map = folder.path().join("map.svg");
        let common = [
            "surface",
            str(&file),
            "--required",
            str(&part),
            "--machine",
            MACHINE,
            "--close",
            "0.01",
        ];
        let output = trunnion(&[&common[..], &["--format", "json", "--plot", str(&map)]].concat());
        assert_eq!(status(&output), 0, "{}", text(&output.stderr));
        let errors = json(&output)["errors"].clone();
        let segment = errors["from_segment"]["sampled_mm"].as_f64().expect("a number");
        // the published value is that in the middle of the block
        assert!(
            segment >= middle - 1e-3 && segment < middle * 1.001,
            "{windings}: {segment}"
        );
        let number = |sense: &str, key: &str| errors[sense][key].as_f64().expect("a number");
        assert!(number("same_place", "sampled_mm") > segment);
        assert!(number("from_surface", "sampled_mm") < segment);
        for sense in ["from_surface", "same_place", "from_segment"] {
            assert!(number(sense, "bound_mm") >= number(sense, "sampled_mm"), "{sense}");
        }
        let picture = std::fs::read_to_string(&map).expect("written");
        assert!(picture.contains("error / mm") && picture.contains("Mikron UCP710") && picture.len() < 600_000);
        let strict = trunnion(&[&common[..], &["--tolerance", "0.05"]].concat());
        assert_eq!(status(&strict), 1);
    }
}

#[test]
fn surfaces_that_cannot_be_read_are_refused_with_their_place() {
    let folder = TempDir::new().expect("works");
    let (file, _) = saddle(&folder, "saddle.mpf", "nearest");
    for (name, content, word) in [
        (
            "a.toml",
            "schema = \"trunnion-surface/1\"\n[[grid]]\nrow = 1\n",
            "a.toml: 3:1: unknown field",
        ),
        ("a.json", "{", "a.json: 1:1"),
        ("a.stl", "solid\nfacet", "STL"),
    ] {
        let part = write(&folder, name, content);
        let output = trunnion(&["surface", str(&file), "--required", str(&part), "--machine", MACHINE]);
        assert_eq!(status(&output), 2, "{name}");
        assert!(text(&output.stderr).contains(word), "{name}: {}", text(&output.stderr));
    }
}

/// A plane 1 mm below the zero.
const PLANE: &str = "solid plane\nfacet normal 0 0 1\nouter loop\nvertex -100 -100 -1\nvertex 300 -100 -1\nvertex -100 300 -1\nendloop\nendfacet\nendsolid plane\n";

#[test]
fn an_stl_is_a_surface_too() {
    let folder = TempDir::new().expect("works");
    let part = write(&folder, "plane.stl", PLANE);
    let file = write(
        &folder,
        "a.nc",
        "G21 G90 G17 G94\nS1 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX20 Z-1.25\nM30\n",
    );
    let refused = trunnion(&[
        "surface",
        str(&file),
        "--required",
        str(&part),
        "--machine",
        "mill-3axis",
        "--dialect",
        "fanuc-30i",
        "--lines",
        "4-4",
    ]);
    assert!(
        text(&refused.stderr).contains("farther than 1 mm"),
        "{}",
        text(&refused.stderr)
    );
    let output = trunnion(&[
        "surface",
        str(&file),
        "--required",
        str(&part),
        "--machine",
        "mill-3axis",
        "--dialect",
        "fanuc-30i",
        "--format",
        "json",
    ]);
    let document = json(&output);
    let errors = document["errors"].clone();
    // the plunge starts 6 mm above and is not part of the surface
    assert_eq!(
        (document["apart"].as_u64(), document["farthest_apart_mm"].as_f64()),
        (Some(1), Some(6.0))
    );
    assert_eq!(errors["from_surface"]["sampled_mm"], 0.25);
    assert_eq!(errors["from_surface"]["side"], "gouge");
    assert!(errors["same_place"].is_null());
}

/// The tip of a tool whose length is not in effect is elsewhere than X Y Z say: nothing is judged from them.
#[test]
fn a_tool_of_another_length_is_not_held_against_a_surface() {
    let folder = TempDir::new().expect("works");
    let part = write(&folder, "plane.stl", PLANE);
    let judged = |length: &str| {
        let body = format!(
            "(trunnion: tool 1 length 80)\nG21 G90 G17 G94\nT1 M6\nS1 M3\n{length}G0 X0 Y0 Z-1\nG1 X20 F100\nM30\n"
        );
        let file = write(&folder, "a.nc", &body);
        let of = [
            "surface",
            str(&file),
            "--required",
            str(&part),
            "--machine",
            "mill-3axis",
        ];
        let output = trunnion(&[&of[..], &["--dialect", "fanuc-30i"]].concat());
        (text(&output.stdout), text(&output.stderr))
    };
    assert!(judged("G43 H1 ").0.contains("1 feed blocks judged, 0 unknown"));
    let (_, refused) = judged("");
    assert!(refused.contains("no feed motion's path is known"), "{refused}");
}

#[test]
fn pictures_are_whole_and_labelled() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    for (kind, words) in [
        (
            "joints",
            &[
                "C / deg",
                "X / mm",
                "travel of the tool tip / mm",
                "pole-flip",
                "limits",
            ][..],
        ),
        (
            "axis-plane",
            &[
                "i of the tool axis",
                "line 10",
                "pole cone 2 deg",
                "equal C",
                "pole-flip",
            ],
        ),
        ("path", &["Y / mm", "feed", "rapid"]),
    ] {
        let output = trunnion(&[
            "plot",
            str(&file),
            "--kind",
            kind,
            "--machine",
            MACHINE,
            "--dialect",
            "fanuc-30i",
        ]);
        assert_eq!(status(&output), 0, "{kind}: {}", text(&output.stderr));
        let picture = text(&output.stdout);
        assert!(picture.starts_with("<svg width=\"1200\" height=\"800\"") && picture.trim_end().ends_with("</svg>"));
        for word in words.iter().chain(&["flip.nc", "Mikron UCP710"]) {
            assert!(picture.contains(word), "{kind}: no {word}");
        }
        assert!(picture.len() < 200_000, "{kind}: {} bytes", picture.len());
    }
}

/// The saddle that deviates has a picture; five short lines that do not have a sentence.
#[test]
fn a_deviation_is_a_picture_or_a_sentence() {
    let folder = TempDir::new().expect("works");
    let (saddle, _) = saddle(&folder, "saddle.mpf", "naive");
    let flip = write(&folder, "flip.nc", FLIP);
    let drawn = |file: &PathBuf, dialect: &str| {
        let of = ["plot", str(file), "--kind", "deviation", "--machine", MACHINE];
        trunnion(&[&of[..], &["--dialect", dialect]].concat())
    };
    let picture = drawn(&saddle, "sinumerik-840d");
    assert_eq!(status(&picture), 0, "{}", text(&picture.stderr));
    let picture = text(&picture.stdout);
    assert!(picture.contains("travel of the tool tip / mm") && picture.contains("tolerance 0.01 mm"));
    let refused = drawn(&flip, "fanuc-30i");
    assert_eq!(status(&refused), 2);
    let said = text(&refused.stderr);
    assert!(
        said.contains("the tip stays within 0.0001 mm of the programmed segment"),
        "{said}"
    );
}

/// A second program over the first, and the neighbourhood of the pole alone.
#[test]
fn the_plane_of_the_tool_axis_before_and_after_and_near_the_pole() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    let calm = write(&folder, "calm.nc", &FLIP.replace("C52.595", "C5.1"));
    let common = [
        "plot",
        str(&file),
        "--kind",
        "axis-plane",
        "--machine",
        MACHINE,
        "--dialect",
        "fanuc-30i",
    ];
    let picture = |more: &[&str]| {
        let output = trunnion(&[&common[..], more].concat());
        assert_eq!(status(&output), 0, "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let both = picture(&["--after", str(&calm)]);
    assert!(both.contains("before") && both.contains("after"), "{both}");
    // one curve more, in its own colour (#009E73)
    let green = |picture: &str| picture.matches("#009E73").count();
    let alone = picture(&[]);
    assert!(!alone.contains("before") && green(&both) > green(&alone) + 4);
    // half a degree around the pole: sin 0.5 deg is 0.0087, so that no label of the axes is beyond it
    let near = picture(&["--around-pole", "0.5"]);
    assert!(near.contains("0.005") && !near.contains("0.02"), "{near}");
    for (more, word) in [
        (["--around-pole", "0"], "--around-pole"),
        (["--around-pole", "91"], "--around-pole"),
        (["--after", "nowhere.nc"], "nowhere.nc"),
    ] {
        let output = trunnion(&[&common[..], &more].concat());
        assert_eq!(status(&output), 2, "{more:?}");
        assert!(text(&output.stderr).contains(word), "{}", text(&output.stderr));
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_with_a_reason() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    let empty = write(&folder, "empty.nc", "G21\nM30\n");
    let common = ["--dialect", "fanuc-30i"];
    for (arguments, word) in [
        (
            vec!["plot", str(&file), "--kind", "axis-plane", "--machine", "mill-3axis"],
            "two rotary axes",
        ),
        (
            vec!["plot", str(&empty), "--kind", "path", "--machine", MACHINE],
            "nothing to draw",
        ),
        (vec!["plot", str(&file), "--kind", "path"], "needs a machine"),
        (
            vec![
                "plot",
                str(&file),
                "--kind",
                "path",
                "--machine",
                MACHINE,
                "--lines",
                "9-3",
            ],
            "--lines",
        ),
    ] {
        let output = trunnion(&[&arguments[..], &common[..]].concat());
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(text(&output.stderr).contains(word), "{}", text(&output.stderr));
    }
}
