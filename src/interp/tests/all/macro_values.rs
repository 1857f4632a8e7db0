//! Macro B: values of expressions and variables, checked by hand.
use crate::macro_flow::said;
use crate::support::{lines, number, run_bytes, run_text, shared};
use trunnion_interp::{FaultKind, Setup, WorkOffset};

const FANUC: &str = "fanuc-30i";

/// X of `G0X#1` after the statements, none of which may be wrong.
fn value(statements: &str) -> String {
    let source = format!("{statements}\nG0X#1\nM30\n");
    assert_eq!(said(&source), [""; 0], "{source}");
    lines(FANUC, &source)[0].clone()
}

#[test]
fn operators_bind_as_in_macro_b() {
    for (expression, expected) in [
        ("2+3*4", "14"),
        ("[2+3]*4", "20"),
        ("-2+5", "3"),
        ("10-4-3", "3"),
        ("2*3+4*5-6/2", "23"),
        ("7 MOD 4 + 1", "4"),
        ("1 OR 2 AND 2", "3"),
        ("6 XOR 3", "5"),
        ("SIN[30]*2", "1"),
        ("ATAN[1]/[1]", "45"),
        ("FIX[-2.8]", "-2"),
        ("FUP[-2.2]", "-3"),
        ("ROUND[2.5]", "3"),
        ("ABS[-3.25]", "3.25"),
        ("SQRT[16]+1", "5"),
        ("[[1+2]*[3+4]]", "21"),
        ("1EQ1", "1"),
        ("[2GT3]+5", "5"),
    ] {
        assert_eq!(
            value(&format!("#1={expression}")),
            format!("R X{expected}"),
            "{expression}"
        );
    }
}

/// Fanuc parameter 6004 bit 0 (NAT) decides which angle ASIN and ATAN give below zero.
#[test]
fn angles_below_zero_are_those_that_the_settings_declare() {
    let run = |text: &str, declared: Option<bool>| {
        let mut setup = Setup::default();
        setup.control.positive_angles = declared;
        let log = run_bytes(FANUC, format!("{text}\nG0 X#1\nM30\n").as_bytes(), &setup).1;
        let open = |fault: &trunnion_interp::Fault| matches!(&fault.kind, FaultKind::NotModelled { what } if what.contains("positive_angles"));
        (log.motions[0].end.get(0).map(f64::round), log.faults.iter().any(open))
    };
    for (text, from_zero, negative) in [("#1=ASIN[-.5]", 330.0, -30.0), ("#1=ATAN[-1]/[-1]", 225.0, -135.0)] {
        assert_eq!(run(text, Some(true)), (Some(from_zero), false), "{text}");
        assert_eq!(run(text, Some(false)), (Some(negative), false), "{text}");
        assert_eq!(run(text, None), (None, true), "{text}");
    }
    for (text, angle) in [
        ("#1=ASIN[.5]", 30.0),
        ("#1=ATAN[1]/[-1]", 135.0),
        ("#1=ATAN[-1]", -45.0),
    ] {
        assert_eq!(run(text, None), (Some(angle), false), "{text}");
    }
}

#[test]
fn variables_by_number_by_reckoning_and_by_name() {
    assert_eq!(value("#2=100\n#[#2+1]=7.5\n#1=#101"), "R X7.5");
    assert_eq!(value("#2=3\n#3=9\n#1=##2"), "R X9");
    assert_eq!(value("#_DEPTH=4.5\n#1=#_DEPTH*2"), "R X9");
}

#[test]
fn a_vacant_word_is_not_there() {
    assert_eq!(lines(FANUC, "G0X1.Y1.\nX#5Y2.\nM30\n"), ["R X1 Y1", "R X1 Y2"]);
    assert_eq!(
        lines(FANUC, "G0X1.Y1.\n#5=#0\nX[#5+2]Y#5\nM30\n"),
        ["R X1 Y1", "R X2 Y1"]
    );
    // B-63684EN: EQ and NE tell vacant from zero, arithmetic does not
    let compare = "#1=0\nIF[#2EQ0]THEN#1=1\nIF[#2EQ#0]THEN#1=#1+2\nIF[#2NE0]THEN#1=#1+4\nIF[#2GE0]THEN#1=#1+8\n#9=#1";
    assert_eq!(value(compare), "R X14");
}

#[test]
fn mistakes_of_expressions_have_their_alarms_and_columns() {
    for (source, expected) in [
        ("#1=1/0\nM30\n", "1 `1/0` Expression PS0112"),
        ("#2=-4\n#1=SQRT[#2]\nM30\n", "2 `SQRT[#2]` Expression PS0119"),
        ("#1=[1+*2]\nM30\n", "1 `*` Expression PS0114"),
        ("#1=#60\nM30\n", "1 `#60` Variable PS0115"),
        ("#60=1\nM30\n", "1 `#60=1` Variable PS0115"),
        ("#0=1\nM30\n", "1 `#0=1` Variable PS0116"),
        ("#1=FOO[1]\nM30\n", "1 `FOO` Expression PS0114"),
    ] {
        let got = said(source);
        assert_eq!(got.len(), 1, "{source}: {got:?}");
        let same_alarm = got[0].rsplit(' ').next() == expected.rsplit(' ').next();
        assert!(
            same_alarm && got[0].starts_with(&expected[..2]),
            "{source}: {got:?}, expected {expected}"
        );
    }
}

#[test]
fn the_control_tells_what_is_in_force_and_where_it_is() {
    // 90 + 18 / 1000 + 20 * 1000 = 20090.018 inch
    assert_eq!(value("G90G18G20\n#1=#4003+#4002/1000+#4006*1000"), "R X510286.4572");
    assert_eq!(
        lines(FANUC, "G0X3.Y4.Z5.\nX[#5001+1]Y[#5002*2]Z#5003\nM30\n")[1],
        "R X4 Y8 Z5"
    );
    assert_eq!(lines(FANUC, "G1X1.F250.S900\nG0X#4109Y#4119\nM30\n")[1], "R X250 Y900");
    let mut values = [0.0; 9];
    (values[0], values[2]) = (100.0, -50.0);
    let setup = Setup {
        work_offsets: vec![WorkOffset {
            name: "G54".to_owned(),
            values,
        }],
        ..Setup::default()
    };
    let source = b"G54G0X1.Z2.\nX#5221Z#5223\nX#5021\nM30\n";
    let log = run_bytes(FANUC, source, &setup).1;
    let ends: Vec<_> = log.motions.iter().map(|motion| motion.end.get(0).map(number)).collect();
    assert_eq!(
        ends,
        [Some("1".to_owned()), Some("100".to_owned()), Some("200".to_owned())]
    );
}

/// #4008 and #5081 to #5083: which length is in force. What it makes of #5021 and #5041 is known where it is declared.
#[test]
fn the_length_in_force() {
    let mut setup = Setup {
        work_offsets: vec![WorkOffset {
            name: "G54".to_owned(),
            values: [100.0, 0.0, -50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        }],
        ..Setup::default()
    };
    let of = |text: &str, setup: &Setup| {
        let source = format!("G54G90G21G0X1.Y2.Z3.\n{text}\nM30\n");
        let log = run_bytes(FANUC, source.as_bytes(), setup).1;
        log.motions.last().expect("a motion").end.get(0)
    };
    assert_eq!(of("G49\nX#4008", &setup), Some(49.0));
    assert_eq!(of("G49\nX[#5083+7.]", &setup), Some(7.0));
    assert_eq!(of("G49\nX#5023", &setup), Some(-47.0));
    // nothing declares the length
    assert_eq!(of("T1M6\nG43H1Z3.\nX#4008", &setup), Some(43.0));
    for name in ["#5083", "#5023", "#5043"] {
        assert_eq!(
            of(&format!("T1M6\nG0X1.Y2.Z3.\nG43H1Z3.\nX{name}"), &setup),
            None,
            "{name}"
        );
    }
    setup.tools.push(crate::tools::tool(1, None, None, Some(80.0)));
    for (name, x) in [
        ("#5083", 80.0),
        ("#5081", 0.0),
        ("#5023", 33.0),
        ("#5043", 83.0),
        ("#5003", 3.0),
    ] {
        assert_eq!(
            of(&format!("T1M6\nG0X1.Y2.Z3.\nG43H1Z3.\nX{name}"), &setup),
            Some(x),
            "{name}"
        );
        assert_eq!(of("T1M6\nG0X1.Y2.Z3.\nG43.4H1Z3.\nX#4008", &setup), None);
    }
    // the zero point is not declared
    setup.work_offsets.clear();
    assert_eq!(of("G49\nX#5021", &setup), None);
    assert_eq!(of("G49\nX[#5041+1.]", &setup), Some(2.0));
}

/// #7001 and up: 20 numbers for each additional offset; #4010, #4009, #4111.
#[test]
fn additional_offsets_and_more_of_what_is_in_force() {
    let offset = |name: &str, values: [f64; 3]| WorkOffset {
        name: name.to_owned(),
        values: [values[0], values[1], values[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    let setup = Setup {
        work_offsets: vec![
            offset("G54.1 P1", [1.0, 2.0, 3.0]),
            offset("G54.1 P2", [11.0, 12.0, 13.0]),
            offset("G54.1 P48", [0.0, 7.0, 0.0]),
        ],
        ..Setup::default()
    };
    // #7003 is Z of P1, #7023 of P2
    let found = run_bytes(FANUC, b"G0X#7003Y#7023\nM30\n", &setup).1;
    let end = found.motions[0].end;
    assert_eq!((end.get(0), end.get(1)), (Some(3.0), Some(13.0)));
    let source = b"G0X#7003Y#7942\n#7022=5.\nX#7022\nM30\n";
    let log = run_bytes(FANUC, source, &setup).1;
    let ends: Vec<_> = log
        .motions
        .iter()
        .map(|motion| (motion.end.get(0), motion.end.get(1)))
        .collect();
    assert_eq!(ends, [(Some(3.0), Some(7.0)), (Some(5.0), Some(7.0))]);
    // what the program writes counts when it selects the offset
    let written = lines(FANUC, "G54G0X10.Y1.\n#7001=3.\nG54.1P1\nG0X1.\nM30\n");
    assert_eq!(written, ["R X10 Y1", "R X1 Y1"]);
    // not declared, a fourth axis, behind the last one, and of a Haas another place
    for (dialect, source) in [
        (FANUC, "G0X#7003\nM30\n"),
        (FANUC, "#7001=1.\nG0X#7004\nM30\n"),
        (FANUC, "G0X#7961\nM30\n"),
        ("haas-ngc", "#7001=1.\nG0X#7001\nM30\n"),
    ] {
        let log = run_bytes(dialect, source.as_bytes(), &Setup::default()).1;
        assert_eq!(log.motions[0].end.get(0), None, "{dialect}: {source}");
    }
    for (source, x) in [
        ("G99\nG0X#4010", 99.0),
        ("G98G0X#4010", 98.0),
        ("G0X1.\nX#4009", 80.0),
        ("G43H7Z1.\nG0X#4111", 7.0),
        ("G0X1.Y1.Z5.\nG83X2.Z-1.R1.Q1.F10.\n#1=#4009\nG80\nG0X#1", 83.0),
    ] {
        let log = run_text(FANUC, &format!("{source}\nM30\n"));
        assert_eq!(
            log.motions.last().and_then(|motion| motion.end.get(0)),
            Some(x),
            "{source}"
        );
    }
}

#[test]
fn writing_a_zero_point_moves_the_coordinates() {
    // the machine stays: what was X10 over a zero at 0 is X7 over one at 3
    let source = "G54G0X10.Y1.\n#5221=3.\nY2.\n#1=#5221\nX#1\nM30\n";
    assert_eq!(lines(FANUC, source), ["R X10 Y1", "R X7 Y2", "R X3 Y2"]);
}

#[test]
fn codes_and_words_take_variables() {
    let source = "#1=1\n#2=3\nG#1X5.F[100*#2]\nM#2S1000\nG#1X6.\nG4P#3\nM30\n";
    assert_eq!(lines(FANUC, source)[..2], ["L X5 F300", "L X6 F300"]);
    let log = run_bytes(FANUC, source.as_bytes(), &Setup::default()).1;
    assert_eq!(log.motions[1].spindle_on, Some(true));
    assert_eq!(lines(FANUC, "#3=500\nG4P#3\nM30\n"), ["D0.5 -"]);
}

#[test]
fn the_shared_macro_program_has_the_values_reckoned_by_hand() {
    let Some(source) = shared("five-axis-pairs/macro_b.nc") else {
        return;
    };
    let (_, log) = run_bytes(FANUC, &source, &Setup::default());
    let unexpected: Vec<_> = log
        .faults
        .iter()
        .filter(|fault| fault.kind != FaultKind::AmbiguousDecimal)
        .collect();
    assert!(unexpected.is_empty(), "{unexpected:?}");
    let got: Vec<_> = log.motions.iter().map(crate::support::line).collect();
    insta::assert_snapshot!(got.join("\n"));
}

/// G10 writes diameters along X of a lathe; whether the variables of the same registers are diameters too, and which is that of Z, is not taken
/// from a source.
#[test]
fn offsets_of_a_lathe_are_not_read_by_number() {
    for dialect in ["fanuc-30i-lathe-a", "haas-lathe"] {
        for variable in ["#5221", "#5222", "#5223"] {
            let source = format!("G10 L2 P1 X4. Z6.\nG54 G0 X50. Z5.\nG0 X[50.+{variable}]\nM30\n");
            assert_eq!(
                lines(dialect, &source).last().map(String::as_str),
                Some("R Z5"),
                "{dialect} {variable}"
            );
        }
        let written = lines(dialect, "G0 X50. Z5.\n#5221=4.\nG0 X40.\nM30\n");
        assert_eq!(written[1], "R -", "{dialect}: {written:?}");
    }
}
