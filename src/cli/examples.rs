//! What the help of a command ends with: how people use it. `tests/all/gate/tutorials.rs` parses each of them.

/// Commands, each with its examples: what is written, and what it is for (may be empty).
const EXAMPLES: &[(&str, &[[&str; 2]])] = &[
    (
        "trace",
        &[
            ["trace part.mpf --machine mikron-ucp710 > part.csv", "for a spreadsheet"],
            [
                "trace part.mpf --machine own.toml --format json",
                "for your own programs",
            ],
        ],
    ),
    (
        "canon",
        &[[
            "canon part.ngc --ini mill.ini --tool-table tool.tbl",
            "as `rs274 -g` lists it",
        ]],
    ),
    (
        "fmt",
        &[
            ["fmt part.nc --diff", "what would change"],
            ["fmt programs", "all programs of a folder"],
            ["fmt programs --check", "in CI: status 1 where a file would change"],
            ["fmt part.nc --renumber 10,10", "new block numbers, and jumps follow"],
        ],
    ),
    (
        "diff",
        &[
            ["diff old.nc new.nc", "what the two do differently"],
            ["diff old.nc new.nc --claim path", "the geometry alone"],
        ],
    ),
    (
        "convert",
        &[
            [
                "convert part.apt --to-machine mikron-ucp710 -o part.mpf",
                "APT/CL for a machine",
            ],
            ["convert part.nc --to heidenhain-klartext -o part.h", "another control"],
        ],
    ),
    (
        "edit",
        &[
            ["edit part.nc --unit inch", "shows a diff"],
            ["edit part.nc --shift X=10,Z=-2 -o shifted.nc", ""],
            ["edit part.nc --mirror X --write --backup", "keeps part.nc.bak"],
        ],
    ),
    (
        "stats",
        &[
            ["stats part.nc", ""],
            ["stats part.nc --machine mill-3axis --time", "where the time goes"],
        ],
    ),
    (
        "plot",
        &[
            ["plot part.nc --kind path --machine mill-3axis -o path.svg", ""],
            [
                "plot part.mpf --kind joints --lines 100-250 -o joints.svg",
                "a part of a program",
            ],
        ],
    ),
    (
        "surface",
        &[[
            "surface part.mpf --required part.stl --machine own.toml --plot map.svg",
            "",
        ]],
    ),
    (
        "servo",
        &[[
            "servo part.nc --at 120 --machine own.toml",
            "the corner at the start of line 120",
        ]],
    ),
    (
        "sample",
        &[["sample cone --machine mikron-ucp710 --tilt 20 -o cone.mpf", ""]],
    ),
    (
        "fix",
        &[
            ["fix part.mpf", "shows a diff of what cures the findings"],
            [
                "fix part.mpf --rewrite smooth-pole -o new.mpf --certificate new.json",
                "",
            ],
        ],
    ),
    (
        "certify",
        &[
            [
                "certify part.mpf new.mpf --certificate new.json",
                "checks a proof again",
            ],
            ["certify part.nc new.nc", "whether both do the same"],
        ],
    ),
    (
        "report",
        &[["report programs -o programs.html", "one page for a folder"]],
    ),
    (
        "init",
        &[["init programs --machine mill-3axis", "writes programs/trunnion.toml"]],
    ),
    (
        "machine",
        &[
            ["machine list", "the built-in machines"],
            ["machine show mikron-ucp710 --format toml > own.toml", "to begin with"],
            ["machine check own.toml", "tests it"],
        ],
    ),
    ("explain", &[["explain pole-flip", ""]]),
    ("schema", &[["schema settings > settings.schema.json", ""]]),
    (
        "completions",
        &[[
            "completions bash > ~/.local/share/bash-completion/completions/trunnion",
            "",
        ]],
    ),
    ("parse", &[["parse part.nc --tree", "blocks, words and expressions"]]),
];

/// The examples of a command as its help shows them.
pub(super) fn of(command: &str) -> Option<String> {
    let (_, examples) = EXAMPLES.iter().find(|(name, _)| *name == command)?;
    let told = examples.iter().filter(|[_, what]| !what.is_empty());
    let width = told.map(|[written, _]| written.len()).max().unwrap_or_default();
    let lines = examples.iter().map(|[written, what]| {
        let line = format!("  trunnion {written:width$}    {what}");
        line.trim_end().to_owned()
    });
    let lines: Vec<String> = lines.collect();
    let title = if lines.len() == 1 { "Example" } else { "Examples" };
    Some(format!("{title}:\n{}", lines.join("\n")))
}
