//! PLANE AXIAL on machines: the tool stands on the plane, and lines along its X and Y move the axes that a machine of this kind moves.
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink, run};
use trunnion_machine::{Follower, Leg, Machine, builtin};
use trunnion_syntax::parse;

struct Legs<'m>(Follower<'m>, Vec<Leg>, Vec<String>);

impl Sink for Legs<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let leg = self.0.follow(motion);
        self.1.push(leg);
    }
    fn fault(&mut self, fault: Fault) {
        self.2.push(format!("{:?}", fault.kind));
    }
}

fn legs<'m>(machine: &'m Machine, text: &str) -> Legs<'m> {
    let dialect = trunnion_dialect::builtin("heidenhain-klartext").expect("built in");
    let program = parse(text.as_bytes().to_vec(), dialect.lex);
    let mut setup = Setup::default();
    Machine::tell(Some(machine), &mut setup.control);
    let mut found = Legs(Follower::new(machine), Vec::new(), Vec::new());
    run(&program, dialect, &setup, &mut found);
    found
}

/// Positions of the rotary axes in degrees, an order that a post writes, and whether both axes turn the table.
const CASES: [(&str, &str, bool); 8] = [
    ("mikron-ucp710", "A-45 C+30", true),
    ("mikron-ucp710", "A+20 C-170", true),
    ("trunnion-3plus2", "A-90 C+90", true),
    ("ferrari-bc", "B+30 C+45", false),
    ("fork-head-ca", "A+35 C-60", false),
    ("fork-head-ca", "A-15.5 C+12.25", false),
    ("head-table-bc", "B-25 C+200", false),
    ("mill-4axis-a", "A+37", true),
];

/// On a machine whose table alone turns, the plane keeps the directions of the machine: X of it moves the axis X and no other. On a
/// machine with a head, Z of it is the direction of the tool. Both hold for the positions of the joints, which know nothing of the plane.
#[test]
fn lines_of_the_plane_move_what_the_machine_moves() {
    for (name, words, table) in CASES {
        let machine = builtin(name).expect("built in");
        let home: Vec<String> = words.split(' ').map(|word| format!("{}+0", &word[..1])).collect();
        for way in ["TURN FMAX", "MOVE FMAX", "STAY"] {
            let turn = if way == "STAY" {
                format!("L {words} FMAX\n")
            } else {
                String::new()
            };
            let text = format!(
                "BEGIN PGM P MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+200 {} R0 FMAX M3\nPLANE AXIAL {words} {way}\n{turn}L X+0 Y+0 Z+50 FMAX\nL X+10 F500\nL Y+10 F500\nL Z+60 F500\nM30\nEND PGM P MM\n",
                home.join(" "),
            );
            let found = legs(machine, &text);
            let said = format!("{name} {words} {way}: {:?}", found.2);
            let lines = &found.1[found.1.len() - 3..];
            for (axis, leg) in lines.iter().enumerate() {
                let (start, end) = (leg.start.as_ref(), leg.end.as_ref());
                let (Some(start), Ok(end)) = (start, end) else {
                    panic!("{said}: {start:?} {end:?}")
                };
                let moved = end.tip - start.tip;
                assert!((moved.norm() - 10.0).abs() < 1e-9, "{said}: {moved}");
                for (joint, declared) in machine.axes.iter().enumerate() {
                    let by = end.joints[joint] - start.joints[joint];
                    if table {
                        let wanted = if declared.letter == b"XYZ"[axis] { 10.0 } else { 0.0 };
                        assert!(
                            (by - wanted).abs() < 1e-9,
                            "{said}: {} moved by {by}",
                            declared.letter as char
                        );
                    } else if !b"XYZ".contains(&declared.letter) {
                        assert!(by.abs() < 1e-12, "{said}: {} turned", declared.letter as char);
                    }
                }
                // along Z of the plane the tip moves along the tool, along X and Y square to it
                let along = moved.dot(&end.axis);
                let wanted = if axis == 2 { 10.0 } else { 0.0 };
                assert!((along - wanted).abs() < 1e-9, "{said}: {along}");
            }
        }
    }
}

/// A machine whose axes are not those of the formulas gives no plane, and the finding names why.
#[test]
fn a_nutating_head_gives_no_plane() {
    for (name, words) in [("nutating-head-b45", "B+30 C+10"), ("nutating-table-b45", "B+30 C+10")] {
        let machine = builtin(name).expect("built in");
        let text = format!(
            "BEGIN PGM P MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+200 R0 FMAX M3\nPLANE AXIAL {words} TURN FMAX\nL X+0 Y+0 Z+50 F500\nM30\nEND PGM P MM\n"
        );
        let found = legs(machine, &text);
        assert!(
            found
                .2
                .iter()
                .any(|fault| fault.contains("PLANE AXIAL: B is not parallel")),
            "{name}: {:?}",
            found.2
        );
        assert!(found.1.last().expect("a line").end.is_err(), "{name}");
    }
}
