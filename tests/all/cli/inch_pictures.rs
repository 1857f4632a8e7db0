//! Pictures of programs in inch are in inch; those of programs in mm are in mm.
use super::tools::{status, str, text, trunnion, write};
use tempfile::TempDir;

/// The same path in mm and in inch on the same machine: pictures are in the unit of the program.
#[test]
fn pictures_of_an_inch_program_are_in_inch() {
    let folder = TempDir::new().expect("a folder");
    let mm = "G21 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG0 X0. Y0. Z25.4\nG1 Z-2.54 F254.\nX50.8 Y25.4\nM30\n";
    let inch = "G20 G90 G17 G94 G54\nT1 M6\nS1000 M3\nG0 X0. Y0. Z1.\nG1 Z-.1 F10.\nX2. Y1.\nM30\n";
    let drawn = |name: &str, program: &str, kind: &str| {
        let file = write(&folder, name, program);
        let output = trunnion(&[
            "plot",
            str(&file),
            "--machine",
            "mill-3axis",
            "--dialect",
            "fanuc-30i",
            "--assume",
            "work-offset,tool-length",
            "--kind",
            kind,
        ]);
        assert_eq!(status(&output), 0, "{kind}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    // what stands in the picture of the inch program, besides the unit
    for (kind, only_in_inch) in [
        ("path", "X / in"),
        ("joints", "Z / in"),
        ("feed", "feed of the tip / in/min"),
    ] {
        let (metric, imperial) = (drawn("mm.nc", mm, kind), drawn("inch.nc", inch, kind));
        assert!(imperial.contains(only_in_inch), "{kind}: {imperial}");
        assert!(!imperial.contains(" mm") && !metric.contains("/ in"), "{kind}");
        assert!(metric.contains("mm") && !metric.contains(only_in_inch), "{kind}");
    }
    // straight lines of three axes do not deviate: a sentence says so
    let refused = |name: &str| {
        let file = folder.path().join(name);
        let of = ["plot", str(&file), "--machine", "mill-3axis", "--dialect", "fanuc-30i"];
        let output = trunnion(&[&of[..], &["--assume", "work-offset,tool-length", "--kind", "deviation"]].concat());
        assert_eq!(status(&output), 2);
        text(&output.stderr)
    };
    let (metric, imperial) = (refused("mm.nc"), refused("inch.nc"));
    assert!(
        metric.contains("stays within 0.0001 mm") && metric.contains("tolerance 0.01 mm"),
        "{metric}"
    );
    assert!(
        imperial.contains("tolerance 0.0003937 in") && !imperial.contains(" mm"),
        "{imperial}"
    );
    let page = folder.path().join("page.html");
    let file = folder.path().join("inch.nc");
    let output = trunnion(&[
        "report",
        str(&file),
        "--machine",
        "mill-3axis",
        "--dialect",
        "fanuc-30i",
        "-o",
        str(&page),
    ]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let page = std::fs::read_to_string(&page).expect("written");
    let (_, data) = page.split_once("type=\"application/json\">").expect("a replay");
    let (data, _) = data.split_once("</script>").expect("it ends");
    let data: serde_json::Value = serde_json::from_str(data).expect("JSON");
    let last = data["points"]
        .as_array()
        .expect("a list")
        .rchunks(7)
        .next()
        .expect("a point");
    assert_eq!(
        (data["unit"].as_str(), &last[..2]),
        (Some("in"), &[2.0.into(), 1.0.into()][..])
    );
    let joints = data["joints"]
        .as_array()
        .expect("a list")
        .rchunks(3)
        .next()
        .expect("joints");
    assert_eq!(joints[0], 2.0);
}

/// A corner and the map of a surface, too; errors at a corner are in thousandths of an inch.
#[test]
fn corners_and_maps_of_an_inch_program_are_in_inch() {
    let folder = TempDir::new().expect("a folder");
    let grid = "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [50.8, 0, 0]], [[0, 50.8, 0], [50.8, 50.8, 0]]]\n";
    let required = write(&folder, "required.toml", grid);
    let map = folder.path().join("map.svg");
    let program = |unit: &str, x: &str, feed: &str| {
        format!("{unit} G90 G17 G94 G54\nG0 X0. Y0. Z0.\nG1 X{x} F{feed}\nY{x}\nM30\n")
    };
    let inch = write(&folder, "inch.nc", &program("G20", "2.", "40."));
    let mm = write(&folder, "mm.nc", &program("G21", "50.8", "1016."));
    let machine = [
        "--machine",
        "mill-3axis",
        "--dialect",
        "fanuc-30i",
        "--assume",
        "work-offset,tool-length",
    ];
    let corner = |file: &std::path::Path| {
        let picture = [
            "plot",
            str(file),
            "--kind",
            "servo",
            "--at",
            "4",
            "--kv",
            "50",
            "--acc",
            "2000",
        ];
        let output = trunnion(&[&picture[..], &machine].concat());
        assert_eq!(status(&output), 0, "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let drawn = |file: &std::path::Path| {
        let picture = ["surface", str(file), "--required", str(&required), "--plot", str(&map)];
        let output = trunnion(&[&picture[..], &machine].concat());
        assert_eq!(status(&output), 0, "{}", text(&output.stderr));
        std::fs::read_to_string(&map).expect("written")
    };
    for (metric, imperial, in_mm, in_inch) in [
        (
            corner(&mm),
            corner(&inch),
            ["across / mm", "error / um"],
            ["across / in", "error / 0.001 in"],
        ),
        (
            drawn(&mm),
            drawn(&inch),
            ["X / mm", "error / mm"],
            ["X / in", "error / in"],
        ),
    ] {
        assert!(in_mm.iter().all(|text| metric.contains(text)), "{metric}");
        assert!(in_inch.iter().all(|text| imperial.contains(text)), "{imperial}");
        assert!(!imperial.contains(" mm") && !imperial.contains(" um"), "{imperial}");
        assert!(!metric.contains(" in<") && !metric.contains("/ in"), "{metric}");
    }
}
