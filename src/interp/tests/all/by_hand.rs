//! Small programs with their motions, worked out by hand from what the control's manual says of each code.
#![expect(clippy::too_many_lines, reason = "tables of programs")]
use crate::support::lines;
/// Name, program, motions.
pub(crate) type Case = (&'static str, &'static str, &'static [&'static str]);

pub(crate) fn check(dialect: &str, cases: &[Case]) {
    let mut wrong = String::new();
    for (name, source, want) in cases {
        let got = lines(dialect, source);
        if got != *want {
            wrong += &format!("{name}\n  got  {got:?}\n  want {want:?}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn cycles_of_fanuc() {
    check(
        "fanuc-30i",
        &[
            (
                "G91: R from the initial level, Z from R, X from the hole before",
                "G0X0.Y0.Z10.\nG91G99G81X5.Z-6.R-8.K2F100.\nG80\n",
                &[
                    "R X0 Y0 Z10",
                    "R X5 Y0 Z10",
                    "R X5 Y0 Z2",
                    "L X5 Y0 Z-4 F100",
                    "R X5 Y0 Z2",
                    "R X10 Y0 Z2",
                    "L X10 Y0 Z-4 F100",
                    "R X10 Y0 Z2",
                ],
            ),
            (
                "G98: back to the level before the cycle, not to that of the last block",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.\nG98X5.\n",
                &[
                    "R X0 Y0 Z10",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-1 F100",
                    "R X0 Y0 Z1",
                    "R X5 Y0 Z1",
                    "L X5 Y0 Z-1 F100",
                    "R X5 Y0 Z10",
                ],
            ),
            (
                "K0 keeps the data, drills nothing",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.K0\nX5.\n",
                &[
                    "R X0 Y0 Z10",
                    "R X5 Y0 Z10",
                    "R X5 Y0 Z1",
                    "L X5 Y0 Z-1 F100",
                    "R X5 Y0 Z1",
                ],
            ),
            (
                "G0 ends a cycle",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.\nG0X5.\n",
                &[
                    "R X0 Y0 Z10",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-1 F100",
                    "R X0 Y0 Z1",
                    "R X5 Y0 Z1",
                ],
            ),
            (
                "behind G80 the motion code from before the cycle is in effect",
                "G1X0.Y0.Z10.F50.\nG99G81Z-1.R1.\nG80\nX5.\n",
                &[
                    "L X0 Y0 Z10 F50",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-1 F50",
                    "R X0 Y0 Z1",
                    "L X5 Y0 Z1 F50",
                ],
            ),
            (
                "a dwell drills nothing",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.K0\nG4X1.\nX5.\n",
                &[
                    "R X0 Y0 Z10",
                    "D1 X0 Y0 Z10",
                    "R X5 Y0 Z10",
                    "R X5 Y0 Z1",
                    "L X5 Y0 Z-1 F100",
                    "R X5 Y0 Z1",
                ],
            ),
            (
                "a block without X Y Z R drills nothing",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.\nM8\nF200.\nX5.\n",
                &[
                    "R X0 Y0 Z10",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-1 F100",
                    "R X0 Y0 Z1",
                    "R X5 Y0 Z1",
                    "L X5 Y0 Z-1 F200",
                    "R X5 Y0 Z1",
                ],
            ),
            (
                "Z alone drills again at the place, deeper",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.\nZ-2.\n",
                &[
                    "R X0 Y0 Z10",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-1 F100",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-2 F100",
                    "R X0 Y0 Z1",
                ],
            ),
            (
                "a new cycle keeps Z and R of the one before",
                "G0X0.Y0.Z10.\nG99G81Z-1.R1.F100.\nG85X5.\n",
                &[
                    "R X0 Y0 Z10",
                    "R X0 Y0 Z1",
                    "L X0 Y0 Z-1 F100",
                    "R X0 Y0 Z1",
                    "R X5 Y0 Z1",
                    "L X5 Y0 Z-1 F100",
                    "L X5 Y0 Z1 F100",
                ],
            ),
            (
                "inch",
                "G20G0X0.Y0.Z1.\nG99G81Z-1.R.1F10.\n",
                &["R X0 Y0 Z25.4", "R X0 Y0 Z2.54", "L X0 Y0 Z-25.4 F254", "R X0 Y0 Z2.54"],
            ),
        ],
    );
}

#[test]
fn cycles_of_haas() {
    check(
        "haas-ngc",
        &[
            (
                "six holes on a circle, the first at 30 deg",
                "G0X0.Y0.Z5.\nG81G99Z-1.R1.F100.L0\nG70I10.J30.L3\n",
                &[
                    "R X0 Y0 Z5",
                    "R X8.660254 Y5 Z5",
                    "R X8.660254 Y5 Z1",
                    "L X8.660254 Y5 Z-1 F100",
                    "R X8.660254 Y5 Z1",
                    "R X-8.660254 Y5 Z1",
                    "L X-8.660254 Y5 Z-1 F100",
                    "R X-8.660254 Y5 Z1",
                    "R X0 Y-10 Z1",
                    "L X0 Y-10 Z-1 F100",
                    "R X0 Y-10 Z1",
                ],
            ),
            (
                "two holes on an arc, 90 deg apart, clockwise",
                "G0X1.Y1.Z5.\nG81G98Z-1.R1.F100.L0\nG71I10.J0K-90.L2\n",
                &[
                    "R X1 Y1 Z5",
                    "R X11 Y1 Z5",
                    "R X11 Y1 Z1",
                    "L X11 Y1 Z-1 F100",
                    "R X11 Y1 Z5",
                    "R X1 Y-9 Z5",
                    "R X1 Y-9 Z1",
                    "L X1 Y-9 Z-1 F100",
                    "R X1 Y-9 Z5",
                ],
            ),
            (
                "two holes on a line; the first at the present place",
                "G0X1.Y1.Z5.\nG81G99Z-1.R1.F100.L0\nG72I10.J90.L2\n",
                &[
                    "R X1 Y1 Z5",
                    "R X1 Y1 Z1",
                    "L X1 Y1 Z-1 F100",
                    "R X1 Y1 Z1",
                    "R X1 Y11 Z1",
                    "L X1 Y11 Z-1 F100",
                    "R X1 Y11 Z1",
                ],
            ),
            (
                "scaling about a point",
                "G0X0.Y0.Z0.\nG51X10.Y10.P2.\nX15.Y10.\nG50\nX15.\n",
                &["R X0 Y0 Z0", "R X20 Y10 Z0", "R X15 Y10 Z0"],
            ),
            (
                "mirror image about X0",
                "G0X0.Y0.Z5.\nG101X0\nX3.Y2.\nG100X0\nX3.\n",
                &["R X0 Y0 Z5", "R X-3 Y2 Z5", "R X3 Y2 Z5"],
            ),
            ("G28 without axes: all at once", "G91G28\nM30\n", &["U -"]),
        ],
    );
}

#[test]
fn frames() {
    check(
        "fanuc-30i",
        &[
            (
                "rotation about a point",
                "G0X0.Y0.\nG68X10.Y0.R90.\nX20.Y0.\nG69\n",
                &["R X0 Y0", "R X10 Y10"],
            ),
            (
                "a rotated arc keeps its sense",
                "G0X10.Y0.Z0.\nG68X0.Y0.R90.\nG1X10.Y0.F50.\nG3X0.Y10.I-10.J0.\n",
                &["R X10 Y0 Z0", "L X0 Y10 Z0 F50", "A(0 0 0; 90) X-10 Y0 Z0 F50"],
            ),
            (
                "mirror image about X10: an arc turns the other way",
                "G0X0.Y0.Z0.\nG51.1X10.\nG1X0.Y0.F50.\nG2X10.Y10.R10.\n",
                &["R X0 Y0 Z0", "L X20 Y0 Z0 F50", "A(10 0 0; 90) X10 Y10 Z0 F50"],
            ),
            (
                "polar, absolute then incremental angle",
                "G0X0.Y0.\nG16\nX10.Y30.\nG91Y60.\nG90G15\n",
                &["R X0 Y0", "R X8.660254 Y5", "R X0 Y10"],
            ),
            (
                "G53 in machine coordinates",
                "G0X1.Y1.Z1.\nG53X-5.\n",
                &["R X1 Y1 Z1", "R X-5 Y1 Z1 machine"],
            ),
            (
                "where G91 G53 goes is not known",
                "G90G0X1.Y1.Z1.\nG91G53G0X-5.\n",
                &["R X1 Y1 Z1", "U Y1 Z1 machine"],
            ),
            (
                "rotation under G91 turns the increments",
                "G0X0.Y0.\nG68X0.Y0.R90.\nX5.Y0.\nG91X5.\n",
                &["R X0 Y0", "R X0 Y5", "R X0 Y10"],
            ),
            (
                "inch to mm in the middle",
                "G20G0X1.Y0.\nG21X1.\n",
                &["R X25.4 Y0", "R X1 Y0"],
            ),
        ],
    );
}

#[test]
fn macros() {
    check(
        "fanuc-30i",
        &[
            (
                "AND and OR rank with plus, MOD with times",
                "#1=7MOD4*2\n#2=1+6AND3\nG0X#1Y#2\n",
                &["R X6 Y3"],
            ),
            (
                "FIX and FUP go to and from zero",
                "#1=FIX[-1.5]\n#2=FUP[-1.5]\nG0X#1Y#2\n",
                &["R X-1 Y-2"],
            ),
            ("ROUND", "G0XROUND[1.5]YROUND[2.4]\n", &["R X2 Y2"]),
            (
                "a vacant variable is no word",
                "G0X5.Y5.\n#1=#0\nX#1Y7.\n",
                &["R X5 Y5", "R X5 Y7"],
            ),
            (
                "<vacant> equals zero in GE, not in EQ",
                "IF[#1EQ0]GOTO1\nIF[#1GE0]GOTO2\nG0X9.\nN1G0X1.\nM30\nN2G0X2.\nM30\n",
                &["R X2"],
            ),
            ("IF THEN", "#1=3\nIF[#1GT2]THEN#2=8\nG0X#2\n", &["R X8"]),
            (
                "WHILE with two levels",
                "#1=0\nWHILE[#1LT2]DO1\n#2=0\nWHILE[#2LT2]DO2\nG0X#1Y#2\n#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n",
                &["R X0 Y0", "R X0 Y1", "R X1 Y0", "R X1 Y1"],
            ),
            (
                "WHILE false at first skips",
                "#1=5\nWHILE[#1LT2]DO1\nG0X1.\nEND1\nG0X2.\nM30\n",
                &["R X2"],
            ),
            (
                "GOTO back finds the label in front",
                "#1=0\nN1#1=#1+1\nG0X#1\nIF[#1LT3]GOTO1\nM30\n",
                &["R X1", "R X2", "R X3"],
            ),
            ("computed GOTO", "#1=2\nGOTO#1\nN1G0X1.\nM30\nN2G0X2.\nM30\n", &["R X2"]),
            (
                "locals are the macro's own",
                "#1=5\nG65P1A2.\nG0Y#1\nM30\nO1\nG0X#1\n#1=9\nM99\n",
                &["R X2", "R X2 Y5"],
            ),
            (
                "M98 shares the locals",
                "#1=5\nM98P1\nG0Y#1\nM30\nO1\nG0X#1\n#1=9\nM99\n",
                &["R X5", "R X5 Y9"],
            ),
            (
                "M98 P with folded repeats",
                "G0X0.\nG91\nM98P30001\nM30\nO1\nX1.\nM99\n",
                &["R X0", "R X1", "R X2", "R X3"],
            ),
            (
                "G65 L repeats with the arguments anew",
                "G90G0X0.\nG65P1L2A1.\nM30\nO1\nG91G0X#1\n#1=5\nG90M99\n",
                &["R X0", "R X1", "R X2"],
            ),
            (
                "M99 P returns to a label",
                "G0X0.\nM98P1\nX1.\nN5X2.\nM30\nO1\nM99P5\n",
                &["R X0", "R X2"],
            ),
            (
                "by name",
                "M98<SUB-1>\nG65<SUB-1>A1.\nM30\nO<SUB-1>\nG0X#1Y1.\nM99\n",
                &["R Y1", "R X1 Y1"],
            ),
            (
                "I J K twice",
                "G65P1I1.J2.K3.I4.\nM30\nO1\nG0X#4Y#7\nM99\n",
                &["R X1 Y4"],
            ),
            (
                "letters",
                "G65P1A1.B2.C3.D4\nM30\nO1\nG0X#1Y#2Z#3\nX#7\nM99\n",
                &["R X1 Y2 Z3", "R X4 Y2 Z3"],
            ),
            ("indirect", "#5=7\n#7=3\nG0X##5\n#[#5+1]=4\nX#8\n", &["R X3", "R X4"]),
            (
                "position",
                "G0X1.Y2.Z3.\nX[#5001+#5002]\n",
                &["R X1 Y2 Z3", "R X3 Y2 Z3"],
            ),
            ("sign", "#1=2\nG0X-#1Y-[#1+1]\n", &["R X-2 Y-3"]),
            (
                "functions",
                "#1=SQRT[16]\n#2=ABS[-3]\nG0X[#1*COS[60]]Y[#2*SIN[30]]Z[ATAN[1]/[1]]\n",
                &["R X2 Y1.5 Z45"],
            ),
        ],
    );
    check(
        "haas-ngc",
        &[
            (
                "M97 calls a block of the program",
                "G0X0.\nM97P100L2\nM30\nN100G91X1.\nG90M99\n",
                &["R X0", "R X1", "R X2"],
            ),
            (
                "M98 with L",
                "G0X0.\nM98P1L3\nM30\nO1\nG91X1.\nG90M99\n",
                &["R X0", "R X1", "R X2", "R X3"],
            ),
            ("P is never folded", "M98P10001\nM30\nO10001\nG0X7.\nM99\n", &["R X7"]),
            ("G65", "G65P1X4.Z-1.\nM30\nO1\nG0X#24Z#26\nM99\n", &["R X4 Z-1"]),
            ("IF GOTO", "#1=1\nIF[#1EQ1]GOTO5\nG0X9.\nN5G0X5.\nM30\n", &["R X5"]),
            (
                "WHILE",
                "#1=0\nWHILE[#1LT2]DO1\n#1=#1+1\nG0X#1\nEND1\nM30\n",
                &["R X1", "R X2"],
            ),
            ("IF THEN", "#1=3\nIF[#1GT2]THEN#2=8\nG0X#2\nM30\n", &["R X8"]),
        ],
    );
}
