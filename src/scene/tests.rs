//! Scenes of whole programs.
use crate::{Kind, Scene, Tracer, Vertex, encode, thin};
use std::fmt::Write;
use trunnion_geometry::Vec3;
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink};
use trunnion_machine::{Follower, Machine, builtin};
use trunnion_syntax::{LineIndex, Program};

struct Run<'a> {
    program: &'a Program,
    index: LineIndex,
    follower: Option<Follower<'a>>,
    machine: Option<&'a Machine>,
    tracer: Tracer,
}

impl Sink for Run<'_> {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        let start = self.program.block(motion.block).range().start;
        let line = self.index.line_column(self.program.source(), start).0;
        match (&mut self.follower, self.machine) {
            (Some(follower), Some(machine)) => {
                let leg = follower.follow(motion);
                self.tracer.leg(machine, &leg, line);
            }
            _ => self.tracer.motion(motion, line),
        }
    }
    fn fault(&mut self, _: Fault) {}
}

fn scene(text: &str, dialect: &str, machine: Option<&str>) -> Scene {
    let dialect = trunnion_dialect::builtin(dialect).expect("a dialect of the tables");
    let machine = machine.map(|name| builtin(name).expect("an embedded machine"));
    let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
    let mut setup = Setup::default();
    Machine::tell(machine, &mut setup.control);
    let mut run = Run {
        program: &program,
        index: LineIndex::new(program.source()),
        follower: machine.map(Follower::new),
        machine,
        tracer: Tracer::new(),
    };
    trunnion_interp::run(&program, dialect, &setup, &mut run);
    run.tracer.finish()
}

/// A square with a rounded corner; the centre of the arc is at X 8 Y 2.
const SQUARE: &str = "G21 G90 G17\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX8 F600\nG3 X10 Y2 I0 J2\nG1 Y10\nG0 Z5\nM30\n";

#[test]
fn without_a_machine_the_programmed_path_is_drawn() {
    let scene = scene(SQUARE, "linuxcnc", None);
    assert_eq!(scene.unknown, 0);
    // the first rapid has no known start
    let first = scene.vertices[0];
    assert_eq!(
        (first.kind, first.tip, first.line),
        (Kind::Start, Vec3::new(0.0, 0.0, 5.0), 3)
    );
    let on_arc: Vec<&Vertex> = scene.vertices.iter().filter(|vertex| vertex.line == 5).collect();
    assert!(on_arc.len() > 5, "{} vertices on the arc", on_arc.len());
    for vertex in &on_arc {
        let radius = (vertex.tip - Vec3::new(8.0, 2.0, -1.0)).norm();
        assert!((radius - 2.0).abs() < 1e-9, "{radius}");
    }
    assert_eq!(
        scene
            .vertices
            .iter()
            .filter(|vertex| vertex.kind == Kind::Rapid)
            .count(),
        1
    );
    // 6 mm at 100 mm/min, then 8 + pi + 8 mm at 600 mm/min
    let feeds = scene
        .vertices
        .iter()
        .rfind(|vertex| vertex.kind == Kind::Feed)
        .expect("feed motions");
    let expected = 6.0 / 100.0 * 60.0 + (16.0 + core::f64::consts::PI) / 600.0 * 60.0;
    assert!((feeds.time - expected).abs() < 1e-9, "{} s", feeds.time);
    let ends = scene
        .vertices
        .iter()
        .filter(|vertex| vertex.ends_block && vertex.kind != Kind::Start);
    assert_eq!(ends.count(), 5);
}

#[test]
fn on_a_machine_vertices_carry_joints_posture_and_bounds() {
    let text = "G90 G71 G54\nT1 D1\nTRAORI\nG0 X0 Y0 Z50 A10 C0\nG1 X0 Y0 Z0 F1000\nG1 X10 A20 C40\nM30\n";
    let scene = scene(text, "sinumerik-840d", Some("mikron-ucp710"));
    let last = scene
        .vertices
        .iter()
        .rfind(|vertex| vertex.kind == Kind::Feed)
        .expect("feed motions");
    assert_eq!(last.line, 6);
    assert!(last.posture.is_some(), "a posture on a machine with two rotary axes");
    assert!(last.feed_limit.is_finite() && last.feed == 1000.0);
    assert!(
        last.deviation < 1e-6,
        "the control guides the tip: {} mm",
        last.deviation
    );
    let machine = builtin("mikron-ucp710").unwrap();
    let c = machine.joint(b'C').unwrap();
    assert!(
        (last.joints[c].abs() - 40f64.to_radians()).abs() < 1e-9,
        "C {}",
        last.joints[c]
    );
    assert!((last.tip - Vec3::new(10.0, 0.0, 0.0)).norm() < 1e-6, "{:?}", last.tip);
    let steps = scene.vertices.iter().filter(|vertex| vertex.line == 6).count();
    assert!(steps >= 7, "40 degrees of C in {steps} steps");
}

#[test]
fn an_unknown_motion_ends_the_strand_and_is_counted() {
    let scene = scene(
        "G21 G90\nG0 X0 Y0 Z0\nG1 X10 F100\nG28 Z0\nG0 X20 Y0 Z0\nG1 X30\nM30\n",
        "fanuc-30i",
        None,
    );
    assert!(scene.unknown > 0);
    assert!(
        scene
            .vertices
            .iter()
            .filter(|vertex| vertex.kind == Kind::Start)
            .count()
            >= 2
    );
    // nothing is drawn between X10 and X20, where the path is not known
    let crossing = scene
        .vertices
        .windows(2)
        .any(|pair| pair[1].kind != Kind::Start && pair[0].tip.x <= 10.0 && pair[1].tip.x >= 20.0);
    assert!(!crossing);
}

#[test]
fn a_thinned_scene_keeps_ends_and_what_is_asked_for() {
    let mut text = String::from("G21 G90\nG0 X0 Y0 Z0\n");
    for i in 1..=20_000 {
        let (x, y) = (f64::from(i) * 0.01, f64::from(i % 7) * 0.001);
        let _ = writeln!(text, "G1 X{x:.3} Y{y:.3} F500");
    }
    text.push_str("M30\n");
    let scene = scene(&text, "linuxcnc", None);
    assert!(scene.vertices.len() > 20_000);
    let (all, off) = thin(&scene, 1_000_000, |_| false);
    assert_eq!((all.len(), off), (scene.vertices.len(), 0.0));
    let (few, apart) = thin(&scene, 500, |line| line == 12_345);
    assert!(few.len() <= 500 && few.len() > 100, "{}", few.len());
    assert!(few.iter().any(|vertex| vertex.line == 12_345));
    assert_eq!(few.last().unwrap().tip, scene.vertices.last().unwrap().tip);
    assert_eq!(few[0].kind, Kind::Start);
    // each vertex that was left out lies within the distance that is given
    for vertex in &scene.vertices {
        let nearest = few
            .iter()
            .map(|kept| (kept.tip - vertex.tip).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest <= apart, "{nearest} mm, {apart} mm were promised");
    }
}

#[test]
fn many_short_strands_still_fit() {
    let mut text = String::from("G21 G90\n");
    for i in 0..3_000 {
        let _ = writeln!(text, "G0 X{i} Y0 Z0\nG1 Z-1 F100\nG28 Z0");
    }
    let scene = scene(&text, "fanuc-30i", None);
    let (few, _) = thin(&scene, 200, |_| true);
    assert!(!few.is_empty() && few.len() <= 400, "{}", few.len());
    assert_eq!(few[0].kind, Kind::Start);
    assert!(!encode(&few, None, &Vec3::zeros(), |_| 0).is_empty());
}
