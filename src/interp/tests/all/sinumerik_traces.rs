//! Sinumerik programs with the traces of another interpreter.
use crate::sinumerik_values::zeroed;
use crate::support::{run_text, shared};

/// What an oracle computes that models expressions, fields, loops, jumps and TRANS; its traces are places with the programmable shift added.
/// Left out: basic_math (MOD of fractions), increment (an increment from an unknown place), trans2 (an increment after TRANS, which is setting
/// data), function_calls, axis_index_assignment, actual_position and edge_cases (machine data, and names of a machine), spline, whose poles are
/// no places, and defaults (an axis E), for_loop, repeat, custom_vars and tool, which move no linear axis to a known place. The traces of a flattened arc and B-spline
/// are compared in `sinumerik_splines`.
#[test]
fn programs_with_traces_of_another_interpreter() {
    let mut compared = 0;
    for name in [
        "arc",
        "arrays",
        "case",
        "case_insensitive_variables",
        "def_string",
        "goto",
        "if_statement",
        "logic_operators",
        "loop",
        "multiple_m_codes",
        "precedence",
        "r_param",
        "trans",
        "trans_ic",
        "trans_reset",
        "trig",
        "variables",
    ] {
        let folder = "controls/sinumerik/cead";
        let (Some(program), Some(trace)) = (
            shared(&format!("{folder}/{name}.mpf")),
            shared(&format!("{folder}/{name}.csv")),
        ) else {
            return;
        };
        let program = String::from_utf8_lossy(&program).into_owned();
        let trace = String::from_utf8_lossy(&trace).into_owned();
        let mut rows = trace.lines();
        let head: Vec<&str> = rows.next().expect("a head").trim().split(',').collect();
        let columns: Vec<(usize, usize)> = ["X", "Y", "Z"]
            .iter()
            .enumerate()
            .filter_map(|(axis, letter)| Some((axis, head.iter().position(|name| name == letter)?)))
            .collect();
        let mut theirs: Vec<Vec<(usize, f64)>> = rows
            .map(|row| {
                let cells: Vec<&str> = row.split(',').collect();
                let value = |&(axis, column): &(usize, usize)| Some((axis, cells.get(column)?.trim().parse().ok()?));
                columns.iter().filter_map(value).collect()
            })
            .filter(|row: &Vec<_>| !row.is_empty())
            .collect();
        theirs.dedup();
        // a start of which nothing is known, as there
        let log = run_text("sinumerik-840d", &format!("G90 G71 F100 S100 M3\n{program}\n"));
        let mut own: Vec<Vec<(usize, f64)>> = zeroed(&format!("G90 G71 F100 S100 M3\n{program}\n"))
            .iter()
            .map(|(motion, zero)| {
                let known = columns.iter().filter(|column| motion.end.known & (1 << column.0) != 0);
                known
                    .map(|&(axis, _)| (axis, motion.end.values[axis] + zero[axis]))
                    .collect()
            })
            .collect();
        own.dedup();
        let same = own.len() == theirs.len()
            && own.iter().zip(&theirs).all(|(a, b)| {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() <= 6e-4)
            });
        eprintln!("{name}: {} and {} places", own.len(), theirs.len());
        assert!(
            same,
            "{name}: {own:?}\n{theirs:?}\n{:?}",
            log.faults.iter().take(3).collect::<Vec<_>>()
        );
        compared += own.len();
    }
    eprintln!("{compared} places");
    assert!(compared > 270, "{compared}");
}
