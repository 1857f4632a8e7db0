//! The exact bytes of small values, and the digests of some larger ones.
//!
//! The bytes were written by another program from the description of the format. They never change: certificates that people keep depend on
//! them. Another encoding needs another version of the certificate, and then new constants beside these.
//! The digests of what is built in change when its table says something else, and then only together with the table.
use super::{CanonicalV1, Encode};
use crate::certificate::{
    Certificate, MotionChange, MotionCounts, NamedDigest, RotaryChange, TextChange, TextDigest, Worst, WorstChanges,
};
use crate::claim::Claim;
use crate::digest::{dialect_digest, machine_digest, setup_digest};
use std::fmt::Write;
use trunnion_dialect::{Action, Code, CodeKind, Dialect, Owner, Role};
use trunnion_interp::{Setup, Tool, ToolShape, WorkOffset};
use trunnion_machine::Limits;
use trunnion_syntax::{Format, LexOptions};

const NUMBER: &str = "\
    030000000000000008bff8000000000000";
const ZERO: &str = "\
    0300000000000000080000000000000000";
const NAN: &str = "\
    0300000000000000087ff8000000000000";
const WHOLE: &str = "\
    0200000000000000080000000000000102";
const FLAGS: &str = "\
    05000000000000001c00000000000000020100000000000000010101000000000000000100";
const TEXT: &str = "\
    040000000000000003c39835";
const EMPTY: &str = "\
    0500000000000000080000000000000000";
const NOTHING: &str = "\
    05000000000000002200000000000000020000000000000000000300000000000000083ff0000000000000";
const TOOL: &str = "\
    060000000000000046000102000000000000000800000000000000070002070000000000000015000300010300000000000000083fe000000000000000040300\
    00000000000008405e100000000000";
const OFFSET: &str = "\
    0600000000000000ba000104000000000000000347353400020500000000000000a100000000000000090300000000000000083ff00000000000000300000000\
    00000008400000000000000003000000000000000840080000000000000300000000000000080000000000000000030000000000000008000000000000000003\
    00000000000000084056800000000000030000000000000008000000000000000003000000000000000800000000000000000300000000000000080000000000\
    000000";
const TRAVEL: &str = "\
    0500000000000000440000000000000002070000000000000002000107000000000000002800020001030000000000000008bff0000000000000000203000000\
    00000000084000000000000000";
const CODE: &str = "\
    060000000000000062000104000000000000000247310002070000000000000002000100030400000000000000066d6f74696f6e000405000000000000001200\
    00000000000001040000000000000001460005070000000000000002000200060700000000000000020001";
const LEX: &str = "\
    06000000000000003d00010700000000000000020001000201000000000000000100000301000000000000000101000401000000000000000100000501000000\
    000000000101";
const VARIABLES: &str = "\
    0500000000000000530000000000000002060000000000000013000102000000000000000800000000000001f406000000000000002600010200000000000000\
    0800000000000001f500020300000000000000083ff0000000000000";
const CLAIMS: &str = "\
    0500000000000000ae0000000000000003070000000000000028000100010300000000000000083ff00000000000000002030000000000000008400000000000\
    000007000000000000003b00020001030000000000000008401400000000000000020300000000000000083ff000000000000000030300000000000000084000\
    000000000000070000000000000028000300010300000000000000083ff000000000000000020300000000000000084000000000000000";
const REFITTED: &str = "\
    070000000000000022000700010300000000000000083ff000000000000000020700000000000000020002";
const INSERTED_RETRACTS: &str = "\
    070000000000000047000b00010300000000000000083ff00000000000000002030000000000000008400000000000000000030300000000000000084008000000000000000401000000000000000101";
const PROGRAMMED_CENTRE: &str = "\
    070000000000000028000900010300000000000000083ff000000000000000020300000000000000084000000000000000";
const CERTIFICATE: &str = "\
    06000000000000052800010400000000000000167472756e6e696f6e2d63657274696669636174652f3200020400000000000000013000030600000000000000\
    1f00010400000000000000016200020200000000000000080000000000000001000406000000000000001f000104000000000000000161000202000000000000\
    00080000000000000002000506000000000000001800010400000000000000016400020400000000000000013100060600000000000000180001040000000000\
    0000016d000204000000000000000132000704000000000000000173000805000000000000002c000000000000000106000000000000001b0001040000000000\
    000004393030310002040000000000000001330009070000000000000028000100010300000000000000083ff000000000000000020300000000000000084000\
    000000000000000a0600000000000000450001020000000000000008000000000000000100020200000000000000080000000000000002000302000000000000\
    00080000000000000003000401000000000000000101000b06000000000000004c00010200000000000000080000000000000004000202000000000000000800\
    000000000000050003020000000000000008000000000000000600040200000000000000080000000000000007000c0600000000000001dc0001060000000000\
    00003900010300000000000000083fe0000000000000000202000000000000000800000000000000010003020000000000000008000000000000000200020600\
    00000000000039000103000000000000000800000000000000000002020000000000000008000000000000000000030200000000000000080000000000000000\
    00030600000000000000390001030000000000000008000000000000000000020200000000000000080000000000000000000302000000000000000800000000\
    00000000000406000000000000003900010300000000000000080000000000000000000202000000000000000800000000000000000003020000000000000008\
    00000000000000000005060000000000000039000103000000000000000800000000000000000002020000000000000008000000000000000000030200000000\
    00000008000000000000000000060600000000000000390001030000000000000008000000000000000000020200000000000000080000000000000000000302\
    00000000000000080000000000000000000706000000000000003900010300000000000000080000000000000000000202000000000000000800000000000000\
    0000030200000000000000080000000000000000000d050000000000000069000000000000000106000000000000005800010400000000000000014300020300\
    000000000000083ff000000000000000030300000000000000084000000000000000000403000000000000000840080000000000000005030000000000000008\
    4010000000000000000e0500000000000000de00000000000000010600000000000000cd00010200000000000000080000000000000001000202000000000000\
    0008000000000000000200030300000000000000083fe000000000000000040300000000000000083ff000000000000000050300000000000000084000000000\
    000000000605000000000000002a0000000000000002030000000000000008407680000000000003000000000000000800000000000000000007030000000000\
    00000840080000000000000008030000000000000008401000000000000000090300000000000000084014000000000000";
/// Names in dialect tables; the first has tag 1.
const ACTIONS: &str = "\
    rapid linear arc-clockwise arc-counter-clockwise dwell plane-xy plane-zx plane-yz absolute incremental arc-centre-absolute \
    arc-centre-incremental inch inch-lengths-only metric feed-inverse-time feed-per-minute feed-per-revolution compensation-off \
    compensation-left compensation-right tool-length-on tool-length-off tcp-on tcp-vector-on tcp-off kinematics machine-coordinates \
    work-offset work-offset-none spindle-clockwise spindle-counter-clockwise spindle-stop tool-change program-stop program-end \
    no-motion path-mode not-modelled not-followed frame-change frame-lost diameter-switch programmable-shift frame-reset tilted-plane \
    tilted-plane-turn tilted-plane-turn-tip swivel-cycle declaration hole-call drill-cycle drill-dwell-cycle peck-cycle \
    chip-break-cycle tap-cycle tap-left-cycle bore-cycle bore-stop-cycle bore-manual-cycle fine-bore-cycle back-bore-cycle \
    return-initial return-to-r local-shift position-set position-preset rotation-on rotation-off scaling-on scaling-off mirror-on \
    mirror-off polar-on polar-off data-entry data-entry-end reference-check reference-return reference-store reference-store-other \
    reference-return-other reference-from thread variable-thread skip circle-pocket bolt-circle bolt-arc bolt-line turning-cycle \
    facing-cycle threading-cycle finish-cycle rough-turn-cycle rough-face-cycle pattern-repeat-cycle thread-repeat-cycle \
    face-peck-cycle groove-peck-cycle canned-cycle cycle-off constant-surface-speed constant-spindle-speed subprogram-call \
    orientation-axes orientation-vector point-to-point point-to-point-rapid continuous-path";
/// The same of the roles of letters.
const ROLES: &str = "\
    block-number program-number g m axis arc-centre arc-radius arc-turns tool-vector posture-status posture-turn feed speed tool \
    length-offset edge-offset parameter increment variable not-followed not-modelled";
fn hex(value: &(impl Encode + ?Sized)) -> String {
    CanonicalV1::bytes_of(value)
        .iter()
        .fold(String::new(), |mut hex, byte| {
            let _ = write!(hex, "{byte:02x}");
            hex
        })
}

#[test]
fn numbers_texts_and_lists() {
    assert_eq!(hex(&-1.5), NUMBER);
    assert_eq!(hex(&-0.0), ZERO);
    assert_eq!(hex(&-f64::NAN), NAN);
    assert_eq!(hex(&258_u16), WHOLE);
    assert_eq!(hex(&[true, false]), FLAGS);
    assert_eq!(hex("Ø5"), TEXT);
    assert_eq!(hex(&Vec::<u8>::new()), EMPTY);
    assert_eq!(hex(&[None, Some(1.0)]), NOTHING);
}

#[test]
fn tools_offsets_and_variables() {
    let tool = Tool {
        number: 7,
        shape: Some(ToolShape::Bull(0.5)),
        diameter_mm: None,
        length_mm: Some(120.25),
        holder_mm: None,
    };
    assert_eq!(hex(&tool), TOOL);
    let offset = WorkOffset {
        name: "G54".into(),
        values: [1.0, 2.0, 3.0, 0.0, 0.0, 90.0, 0.0, 0.0, 0.0],
    };
    assert_eq!(hex(&offset), OFFSET);
    assert_eq!(hex(&[(500_u32, None), (501, Some(1.0))]), VARIABLES);
}

#[test]
fn travels_codes_and_notations() {
    assert_eq!(hex(&[Limits::Unbounded, Limits::Range(-1.0, 2.0)]), TRAVEL);
    let code = Code {
        id: "G1".into(),
        kind: CodeKind::G,
        group: Some("motion".into()),
        words: vec!["F".into()],
        action: Action::Linear,
        doc: "not a fact".into(),
        source: "not a fact".into(),
        owner: Owner::Control,
        path: None,
        feed: None,
        lengths: None,
    };
    assert_eq!(hex(&code), CODE);
    let lex = LexOptions {
        format: Format::Iso,
        paren_comment: false,
        semicolon_comment: true,
        slash_star_comment: false,
        blanks_in_numbers: true,
    };
    assert_eq!(hex(&lex), LEX);
}

fn same_poses() -> Claim {
    Claim::SamePoses {
        tolerance_mm: 1.0,
        tolerance_deg: 2.0,
    }
}

#[test]
fn claims() {
    let claims = [
        same_poses(),
        Claim::SameBallCentre {
            ball_radius_mm: 5.0,
            tolerance_mm: 1.0,
            tolerance_deg: 2.0,
        },
        Claim::SameToolPath {
            tolerance_mm: 1.0,
            tolerance_deg: 2.0,
        },
    ];
    assert_eq!(hex(&claims), CLAIMS);
    let refitted = Claim::RefittedPath {
        tolerance_mm: 1.0,
        source: crate::RefitSource::Chords,
    };
    assert_eq!(hex(&refitted), REFITTED);
    let centre = Claim::SameProgrammedCentre {
        tolerance_mm: 1.0,
        tolerance_deg: 2.0,
    };
    assert_eq!(hex(&centre), PROGRAMMED_CENTRE);
    let retracts = Claim::InsertedRetracts {
        tolerance_mm: 1.0,
        tolerance_deg: 2.0,
        clearance_mm: 3.0,
        assumed_zeros: true,
    };
    assert_eq!(hex(&retracts), INSERTED_RETRACTS);
}

#[test]
fn a_certificate_without_its_seal() {
    let named = |name: &str, sha256: &str| NamedDigest {
        name: name.into(),
        sha256: sha256.into(),
    };
    let text = |sha256: &str, bytes| TextDigest {
        sha256: sha256.into(),
        bytes,
    };
    let certificate = Certificate {
        after_dialect: None,
        schema: "trunnion-certificate/2".into(),
        tool_version: "0".into(),
        before: text("b", 1),
        after: text("a", 2),
        dialect: named("d", "1"),
        machine: named("m", "2"),
        setup_sha256: "s".into(),
        library: vec![named("9001", "3")],
        claim: same_poses(),
        text: TextChange {
            numbers_changed: 1,
            words_inserted: 2,
            bytes_changed: 3,
            rest_identical: true,
        },
        motions: MotionCounts {
            total: 4,
            changed: 5,
            unknown: 6,
            process_changed: 7,
        },
        worst: WorstChanges {
            point_shift_mm: Worst {
                value: 0.5,
                motion: 1,
                line: 2,
            },
            ..WorstChanges::default()
        },
        rotary: vec![RotaryChange {
            axis: "C".into(),
            step_before_deg: 1.0,
            step_after_deg: 2.0,
            travel_before_deg: 3.0,
            travel_after_deg: 4.0,
        }],
        postures: None,
        rapids: None,
        changes: vec![MotionChange {
            motion: 1,
            line: 2,
            point_shift_mm: 0.5,
            tip_shift_mm: 1.0,
            axis_change_deg: 2.0,
            rotary_change_deg: vec![360.0, 0.0],
            path_sampled_mm: 3.0,
            path_bound_mm: 4.0,
            path_axis_bound_deg: 5.0,
        }],
        seal_sha256: "not part of it".into(),
    };
    assert_eq!(hex(&certificate), CERTIFICATE);
}

#[test]
fn tags_of_actions_and_roles() {
    let tagged = |tag: usize| format!("070000000000000002{tag:04x}");
    for (index, name) in ACTIONS.split_whitespace().enumerate() {
        let action = Action::named(name).expect("an action");
        assert_eq!(hex(&action), tagged(index + 1), "{name}");
    }
    for (index, name) in ROLES.split_whitespace().enumerate() {
        let role: Role = serde_json::from_value(name.into()).expect("a role");
        assert_eq!(hex(&role), tagged(index + 1), "{name}");
    }
}

/// Of the frozen inputs in `tests/golden`, and of a setup that declares nothing: they never change.
const FROZEN: [&str; 3] = [
    "2430e93ae61a2f1102d1f6616f01c2a80c7b7175a2d81bf8a9eb837270181239",
    "e2580ca8e75586bb6626e8a7d9d7b68545cda43bcd79269325fd4063e1c27090",
    "a362201961e5bb0fcba9c6e6902fc0ed9938c368af8b2127badf8993ee0bbeb3",
];
/// Of what is built in: they change with the table or the machine file, and with nothing else.
const BUILT_IN: [&str; 2] = [
    "e3a3a381461aefe1c3a8e0474e6073498b9045e757f9a1c9cf11877d9ef19dc9",
    "6962dfc0030859d6631a747cd2e789021aa521592cbd0995c35a1e7713fa493e",
];

#[test]
fn digests_of_a_dialect_a_machine_and_a_setup() {
    let dialect = Dialect::from_table(include_str!("../../../tests/golden/dialect.toml"), "dialect.toml");
    let machine = trunnion_machine::load("machine", include_str!("../../../tests/golden/machine.toml"));
    let found = [
        dialect_digest(&dialect.expect("a dialect")),
        machine_digest(&machine.expect("a machine")),
        setup_digest(&Setup::default()),
    ];
    assert_eq!(found, FROZEN);
}

#[test]
fn digests_of_what_is_built_in() {
    let dialect = trunnion_dialect::builtin("iso-6983").expect("built in");
    let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
    assert_eq!([dialect_digest(dialect), machine_digest(machine)], BUILT_IN);
}
