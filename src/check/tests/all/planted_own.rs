//! A parameter that is not set, a label that is not there and a loop that does not end, in Klartext and for an Okuma: each is found in its block, and the
//! twin without the mistake gives no alarm. The same mistakes on Fanuc, LinuxCNC and Sinumerik are in the planted corpus of the root package.
use trunnion_check::{Diagnostic, Settings, Severity, Status, check};
use trunnion_interp::{Setup, Tool, WorkOffset};
use trunnion_syntax::parse;

fn program(dialect: &str, cut: &str) -> String {
    if dialect == "okuma-osp" {
        return format!(
            "$P.MIN%\nG15 H1\nG17 G90 G94 G40\nT1 M6\nG0 X0 Y0 S3000 M3\nG56 H1 Z50\nZ2\nG1 Z-1 F200\n{cut}Y40\nG0 Z50\nM5\nM30\n"
        );
    }
    format!(
        "0 BEGIN PGM P MM\n1 TOOL CALL 1 Z S3000 F300\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 L Z+2 FMAX\n4 L Z-1 F200\n{cut}L Y+40\nL Z+50 FMAX M5\nL M30\nEND PGM P MM\n"
    )
}

fn findings(dialect: &str, text: &str) -> Vec<Diagnostic> {
    let table = trunnion_dialect::builtin(dialect).expect("built in");
    let mut setup = Setup::default();
    setup.work_offsets.push(WorkOffset {
        name: "G15 H1".into(),
        values: [0.0; 9],
    });
    setup.tools.push(Tool {
        number: 1,
        shape: None,
        diameter_mm: None,
        length_mm: Some(50.0),
        holder_mm: None,
    });
    let settings = Settings {
        assume: trunnion_check::Assume::ALL,
        ..Settings::new(table, trunnion_machine::builtin("mill-3axis"), setup)
    };
    check(&parse(text.into(), table.lex), &settings).diagnostics
}

#[test]
fn three_mistakes_of_flow_are_found() {
    for (dialect, rule, status, faulty, twin) in [
        (
            "heidenhain-klartext",
            "not-modelled",
            Status::Unknown,
            "L X+Q5\n",
            "Q5 = 40\nL X+Q5\n",
        ),
        (
            "heidenhain-klartext",
            "missing-label",
            Status::Fail,
            "CALL LBL 7\nL X+40\n",
            "LBL 7\nL X+40\nLBL 8\n",
        ),
        (
            "heidenhain-klartext",
            "missing-label",
            Status::Fail,
            "LBL 7\nL X+40\nLBL 7\n",
            "LBL 7\nL X+40\nLBL 8\n",
        ),
        (
            "heidenhain-klartext",
            "missing-label",
            Status::Fail,
            "FN 9: IF +1 EQU +1 GOTO LBL \"END\"\nL X+40\n",
            "FN 9: IF +1 EQU +2 GOTO LBL \"END\"\nL X+40\nLBL \"END\"\n",
        ),
        (
            "heidenhain-klartext",
            "endless-loop",
            Status::Fail,
            "Q1 = 1\nLBL 1\nL X+40\nFN 12: IF +Q1 LT +3 GOTO LBL 1\n",
            "Q1 = 1\nLBL 1\nL X+40\nQ1 = Q1 + 1\nFN 12: IF +Q1 LT +3 GOTO LBL 1\n",
        ),
        ("okuma-osp", "not-modelled", Status::Unknown, "X=V5\n", "V5=40\nX=V5\n"),
        (
            "okuma-osp",
            "not-modelled",
            Status::Unknown,
            "X=ABC\n",
            "ABC=40\nX=ABC\n",
        ),
        (
            "okuma-osp",
            "missing-label",
            Status::Fail,
            "GOTO NX\nX40\n",
            "GOTO NX\nNX X40\n",
        ),
        (
            "okuma-osp",
            "endless-loop",
            Status::Fail,
            "V1=1\nNA X40\nIF [V1 LT 3] NA\n",
            "V1=1\nNA X40\nV1=V1+1\nIF [V1 LT 3] NA\n",
        ),
    ] {
        let found = findings(dialect, &program(dialect, faulty));
        let is_it = |finding: &Diagnostic| finding.rule == rule && finding.status == status;
        assert!(found.iter().any(is_it), "{dialect} {faulty}: {found:#?}");
        let alarms: Vec<Diagnostic> = findings(dialect, &program(dialect, twin))
            .into_iter()
            .filter(|finding| finding.severity != Severity::Info || finding.status == Status::Unknown)
            .collect();
        assert!(alarms.is_empty(), "{dialect} {twin}: {alarms:#?}");
    }
}
