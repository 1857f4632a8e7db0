//! The tool goes through a declared obstacle, or passes it in rapid nearer than the clearance.
//!
//! # Why
//! A tool that meets a clamp breaks, and often the spindle with it. The drawing of the part does not show where clamps, vices and stops are, so a program that
//! was right on one table can be wrong on another.
//!
//! # Example
//! ```gcode mill-3axis+wall
//! (trunnion: tool 1 flat diameter 8)
//! N10 T1 M6
//! N20 G0 G43 H1 X0 Y0 Z10
//! N30 G0 X90
//! ;   ^^^^^^ rapid-through-obstacle: the tool goes through wall in rapid
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis+wall
//! (trunnion: tool 1 flat diameter 8)
//! N10 T1 M6
//! N20 G0 G43 H1 X0 Y0 Z40
//! N30 G0 X90
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for the obstacles that are declared (`[[obstacle]]` in trunnion.toml or in the machine file): silence is a proof. An upright tool on a
//! straight line is judged exactly, as a column from its tip to the spindle, with its holder where `[[tool]] holder` declares one. While rotary axes
//! turn, on arcs, and where the tool is tilted against the obstacle it is a cylinder of its length, and each point of it is bounded over the whole
//! block. Where that does not settle it, where the diameter of the tool, its length or the work offset is not declared, or where the axes of
//! a rapid may arrive one after the other, the verdict is unknown. In a cut the tool may come as near as it likes, as long as it does not touch.
//!
//! # Thresholds
//! `clearance`: 1 mm, for rapid motions; nearer than that is a warning, touching is an error.
//!
//! # Sources
//! * docs/kinematics.md#obstacles
use crate::prelude::*;
use trunnion_interp::MotionKind;
use trunnion_machine::{Nearness, ToolBody, nearness};

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Passing(check)]);

/// Keys for merging: one for each obstacle and kind of finding.
const THROUGH: u64 = 1 << 32;
const NEAR: u64 = 2 << 32;
const UNDECIDED: u64 = 3 << 32;
const UNDECLARED: u64 = 4 << 32;
const SPENT: u64 = 5 << 32;

/// Pieces of motions that are looked at, for each of `[limits] steps`: a piece takes about half a microsecond.
const FOR_EACH_STEP: u64 = 64;

fn check(leg: &facts::Passing<'_>, out: &mut Reporter<'_>) {
    let rapid = leg.motion().kind == MotionKind::Rapid;
    let keep = if rapid {
        leg.machine.tolerances.clearance_mm()
    } else {
        // the lines that stand for a curve must be clear by as much as it may leave them
        leg.motion().slack_mm
    };
    let declared = leg.trail.tool.as_ref().and_then(ToolBody::of);
    // a tool of no width: what it meets, every tool meets
    let body = declared.unwrap_or(ToolBody {
        radius_mm: 0.0,
        holder_mm: None,
        length_mm: leg.trail.own_length_mm,
    });
    let most = leg.machine.most_turned.saturating_mul(FOR_EACH_STEP);
    if !out.may_look(most) {
        return spent(leg, out, most);
    }
    let undeclared = leg.trail.undeclared;
    let found = nearness(leg.machine, leg.leg, &body, keep);
    out.looked_at(found.iter().map(|near| near.pieces).sum());
    for near in found {
        let name = &leg.machine.obstacles[near.obstacle].name;
        let key = near.obstacle as u64;
        if undeclared.zero & 0b111 != 0 || undeclared.length {
            let what = if undeclared.length {
                "the tool length"
            } else {
                "the work offset"
            };
            not_known(
                leg,
                out,
                UNDECLARED,
                &format!("{what} is not declared, so it is unknown where the tool is relative to {name}"),
            );
            return;
        }
        match near.nearness {
            Nearness::Clear(mm) if declared.is_none() && mm.is_finite() => {
                not_known(
                    leg,
                    out,
                    UNDECLARED | 1,
                    "the diameter of the tool is not declared, so it is unknown whether it passes the obstacles",
                );
                return;
            }
            Nearness::Clear(_) => {}
            Nearness::Through => through(leg, out, (name.as_str(), THROUGH | key), rapid),
            Nearness::Near(_) if !rapid => {
                let what = format!(
                    "this curve is followed as lines that it leaves by at most {} mm, and they come nearer than that to {name}",
                    number(keep)
                );
                not_known(leg, out, UNDECIDED | key, &what);
            }
            Nearness::Near(by) => passes(
                leg,
                out,
                (name.as_str(), NEAR | key),
                (by.filter(|_| declared.is_some()), keep),
            ),
            Nearness::Unknown(why) => {
                out.unknown(leg, Merge::run(UNDECIDED | key, 0.0), |draft| {
                    draft
                        .say(format!("it is unknown whether the tool clears {name}: {why}"))
                        .value_text("obstacle", name.clone());
                });
            }
        }
    }
}

/// The tool passes an obstacle in rapid at `by`, mm, where that is known; `keep`: the clearance, mm.
fn passes(leg: &facts::Passing<'_>, out: &mut Reporter<'_>, (name, key): (&str, u64), (by, keep): (Option<f64>, f64)) {
    let distance = by.map_or_else(
        || "nearer than the clearance".to_owned(),
        |by| format!("at {}, measured horizontally,", mm(by)),
    );
    out.finding_as(Warning, leg, Merge::runs(key, -by.unwrap_or(0.0)), |draft| {
        draft
            .say(format!(
                "the tool passes {name} {distance} in rapid; {} is to be kept",
                mm(keep)
            ))
            .help("go farther round it, or set `clearance` in [tolerances]")
            .fix_rapid(leg)
            .value("limit_mm", keep)
            .value_text("obstacle", name.to_owned());
        if let Some(by) = by {
            draft.value("value_mm", by);
        }
    });
}

/// The tool goes through an obstacle.
fn through(leg: &facts::Passing<'_>, out: &mut Reporter<'_>, (name, key): (&str, u64), rapid: bool) {
    let how = if rapid { "in rapid" } else { "while cutting" };
    out.finding(leg, Merge::runs(key, 0.0), |draft| {
        draft
            .say(format!("the tool goes through {name} {how}"))
            .help("go round it or above it; if it is elsewhere, correct its [[obstacle]]")
            .value_text("obstacle", name.to_owned());
        if rapid {
            draft.fix_rapid(leg);
        }
    });
}

/// No further motion is judged.
fn spent(leg: &LegView<'_>, out: &mut Reporter<'_>, most: u64) {
    out.unknown(leg, Merge::once(SPENT), |draft| {
        draft
            .say(format!(
                "more than {most} pieces of motions near obstacles, {FOR_EACH_STEP} times `[limits] steps`: no further motion is judged"
            ))
            .help("divide the program, declare fewer obstacles, or raise `[limits] steps` in trunnion.toml (--max-steps)");
    });
}

/// Something is missing for all obstacles.
fn not_known(leg: &LegView<'_>, out: &mut Reporter<'_>, key: u64, why: &str) {
    out.unknown(leg, Merge::once(key), |draft| {
        draft
            .say(why)
            .help("declare it in trunnion.toml: [work_offsets], [[tool]] diameter and length");
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::{assert_drawn, check_on};
    use crate::{Severity, Status};

    const TOOL: &str = "(trunnion: tool 1 flat diameter 8)\nT1 M6\n";

    #[test]
    fn beside_above_and_through() {
        assert_drawn(
            "gcode mill-3axis+wall",
            &format!(
                "{TOOL}G0 G43 H1 X0 Y0 Z36\nG0 X90\nG0 Z35.5\nG0 X0\n;^^^^ rapid-through-obstacle: the tool goes through wall in rapid\nG0 X35.5 Z10\n;^^^^^^^^^^^ rapid-through-obstacle: the tool passes wall at 0.5 mm, measured horizontally, in rapid; 1 mm is to be kept\nM30\n"
            ),
        );
    }

    /// A cut may come as near as it likes.
    #[test]
    fn a_cut_may_touch_and_not_enter() {
        assert_drawn(
            "gcode mill-3axis+wall",
            &format!(
                "{TOOL}G0 G43 H1 X30 Y0 Z10\nG1 X36 F500\nX36.001\n;^^^^^^ rapid-through-obstacle: the tool goes through wall while cutting\nM30\n"
            ),
        );
    }

    #[test]
    fn what_is_not_declared_is_unknown_once() {
        let machine = crate::fixture::machine("mill-3axis+wall").unwrap();
        let report = check_on(&machine, "iso-6983", "G0 X0 Y0 Z10\nG0 Y10\nG0 Y20\nG0 X90\nM30\n");
        let own: Vec<_> = report
            .diagnostics
            .iter()
            .filter(|d| d.rule == "rapid-through-obstacle")
            .collect();
        assert_eq!(
            (own.len(), own[0].status, own[1].status),
            (2, Status::Unknown, Status::Fail),
            "{own:?}"
        );
        // a tool without a known width goes through where one of no width does
        assert_eq!(own[1].own_severity(), Severity::Error);
    }

    /// While the table turns, the tool is bounded as a cylinder; a wall that does not turn is cleared or met.
    #[test]
    fn a_turning_table_is_bounded() {
        let machine = crate::fixture::machine("mikron-ucp710+wall").unwrap();
        let program = |x: f64| {
            format!(
                "(trunnion: tool 1 flat diameter 8 length 80)\nT1 M6\nG43 H1 G0 X{x} Y0 Z20 A0 C0\nG1 A10 C30 F500\nM30\n"
            )
        };
        let found = |x: f64| {
            let report = check_on(&machine, "linuxcnc", &program(x));
            let own = report
                .diagnostics
                .into_iter()
                .filter(|d| d.rule == "rapid-through-obstacle");
            own.map(|d| d.status).collect::<Vec<_>>()
        };
        assert_eq!(found(-100.0), []);
        assert_eq!(found(50.0), [Status::Fail]);
    }

    /// Near an obstacle a motion is cut into pieces; they are counted over the whole run.
    #[test]
    fn a_run_looks_at_so_many_pieces_and_says_where_it_stops() {
        let mut machine = crate::fixture::machine("mikron-ucp710+wall").unwrap();
        let text = "(trunnion: tool 1 flat diameter 8 length 80)\nT1 M6\nG43 H1 G0 X-60 Y0 Z20 A0 C0\nG1 A10 C30 F500\nA20 C60\nA10 C30\nM30\n";
        let mut stops = |most: u64| {
            machine.most_turned = most;
            let report = check_on(&machine, "linuxcnc", text);
            let spent = report
                .diagnostics
                .iter()
                .find(|d| d.message.contains("pieces of motions"));
            spent.map(|d| (d.status, d.message.clone()))
        };
        assert_eq!(stops(150_000), None);
        let (status, message) = stops(0).expect("no piece is allowed");
        assert_eq!(status, Status::Unknown);
        assert!(message.starts_with("more than 0 pieces"), "{message}");
    }

    /// The program of the thesis cuts its wall at rapid: N257 to N323 run in the material, N256 enters and N324 leaves it.
    #[test]
    fn the_wall_of_the_thesis_is_cut_at_rapid() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../../shared/data/pocket-1999/pocket.nc"
        );
        let Ok(text) = std::fs::read_to_string(path) else {
            return;
        };
        let mut machine = crate::fixture::machine("mill-3axis+wall").unwrap();
        let inch = 25.4;
        let corners = [[0.0, 0.0], [2.5, 0.0], [2.5, 2.5], [0.0, 2.5]]
            .map(|[x, y]| trunnion_geometry::plane::Point::new(x * inch, y * inch));
        let stock = &mut machine.obstacles.0[0];
        stock.footprint =
            trunnion_machine::Footprint::Polygon(trunnion_geometry::plane::Polygon::new(&corners).unwrap());
        (stock.bottom, stock.top) = (-inch, -0.2 * inch);
        let setup = trunnion_interp::Setup {
            tools: vec![crate::config::parse_tool_flag("ball:3.175").unwrap()],
            control: trunnion_interp::ControlData {
                units: Some(trunnion_interp::LengthUnit::Inch),
                ..Default::default()
            },
            ..Default::default()
        };
        let report = crate::fixture::check_with(&machine, "iso-6983", &text, setup);
        let line = |number: &str| {
            text.lines()
                .position(|line| line.starts_with(number))
                .map(|at| at as u32 + 1)
                .unwrap()
        };
        let wall = report
            .diagnostics
            .iter()
            .find(|d| d.rule == "rapid-through-obstacle" && d.count > 60 && d.message.contains("in rapid"));
        let wall = wall.expect("the wall");
        let index = trunnion_syntax::LineIndex::new(text.as_bytes());
        let first = index.line_column(text.as_bytes(), wall.range.start).0;
        assert_eq!((first, wall.count), (line("N256"), 69));
    }
}
