//! Every form of an ISO block, with its items by hand.
use crate::show::{CORE, FANUC, NGC, SINUMERIK, errors, items, program};
use trunnion_syntax::LexOptions;

/// Checks rows of options, source, items, problems.
fn check(rows: &[(LexOptions, &str, &str, &str)]) {
    for &(options, source, expected, problems) in rows {
        let program = program(source, options);
        assert_eq!(items(&program), expected, "items of {source:?}");
        assert_eq!(errors(&program), problems, "problems of {source:?}");
    }
}

#[test]
fn words() {
    check(&[
        (CORE, "G1X1Y2", "G=1 X=1 Y=2", ""),
        (CORE, "N10 G01 X1.5 Y-.5 Z+3.", "N=10 G=1 X=1.5 Y=-0.5 Z=3.", ""),
        (CORE, "g1 x-0.25\ty10", "G=1 X=-0.25 Y=10", ""),
        (CORE, "G0  X  16.339  Y -25.409", "G=0 X=16.339 Y=-25.409", ""),
        (CORE, "G59.1", "G=59.1", ""),
        (CORE, "@1.5 ^33", "@=1.5 ^=33", ""),
        (CORE, "M3 $0 S100", "M=3 $=0 S=100", ""),
        (CORE, "", "", ""),
        (CORE, "\n\n", " | ", ""),
        (CORE, "G1\r\nX2\rX3\n", "G=1 | X=2 | X=3", ""),
        (CORE, "\u{feff}G1", "G=1", ""),
        (
            CORE,
            "X5\u{feff}",
            "X=5 other[\u{feff}]",
            "UnexpectedCharacter[\u{feff}]",
        ),
        (CORE, "G1 X1 \u{1a}", "G=1 X=1", ""),
    ]);
}

#[test]
fn subprograms_with_a_number_may_have_arguments() {
    check(&[
        (SINUMERIK, "L140(1)", "call:L140(1)", ""),
        (SINUMERIK, "N10 L140 (1,R2) ", "N=10 call:L140(1,R2)", ""),
        (SINUMERIK, "L140 P2", "L=140 P=2", ""),
        (CORE, "L140(1)", "L=140 comment[1]", ""),
    ]);
}

#[test]
fn broken_words() {
    check(&[
        (CORE, "X", "X=?", "WordWithoutValue[X]"),
        (CORE, "G1 X Y2", "G=1 X=? Y=2", "WordWithoutValue[X]"),
        (CORE, "X1.2.3 Y1", "X=!1.2.3 Y=1", "BadNumber[1.2.3]"),
        (CORE, "X1..2", "X=!1..2", "BadNumber[1..2]"),
        (CORE, "X. Y5", "X=!. Y=5", "BadNumber[.]"),
        (CORE, "X- Y5", "X=!- Y=5", "BadNumber[-]"),
        (CORE, "X--5 Y5", "X=!--5 Y=5", "BadNumber[--5]"),
        (
            CORE,
            "X12345678901234567890",
            "X=!12345678901234567890",
            "BadNumber[12345678901234567890]",
        ),
        (CORE, "X1.0000000000000000000000", "X=1.", ""),
        (CORE, "X1,5 Y2", "X=!1,5 Y=2", "DecimalComma[1,5]"),
        (CORE, "X=1,5 Y2", "X=!1,5 Y=2", "DecimalComma[1,5]"),
        (CORE, "X1 2 Y3", "X=!1 2 Y=3", "BlankInNumber[1 2]"),
        (CORE, "X- 5 Y3", "X=!- 5 Y=3", "BlankInNumber[- 5]"),
        (NGC, "X1 2 Y3", "X=12 Y=3", ""),
        (NGC, "g0x +0. 12 34y 7", "G=0 X=0.1234 Y=7", ""),
        (NGC, "X - 5", "X=-5", ""),
        (CORE, "5 X1", "other[5] X=1", "NumberWithoutLetter[5]"),
        (CORE, "-5,5 X1", "other[-5,5] X=1", "NumberWithoutLetter[-5,5]"),
        (CORE, "X1 ! Y2", "X=1 other[!] Y=2", "UnexpectedCharacter[!]"),
        (CORE, "X1 ä~& Y2", "X=1 other[ä~&] Y=2", "UnexpectedCharacter[ä~&]"),
        (CORE, "X1 *** Y2", "X=1 other[***] Y=2", "UnexpectedCharacter[***]"),
        (CORE, "X1]", "X=1 other[]]", "UnbalancedBracket[]]"),
        (CORE, "X1)", "X=1 other[)]", "UnbalancedBracket[)]"),
        (CORE, "X1 [2]", "X=1 other[[2]]", "UnexpectedCharacter[[]"),
        (CORE, "X1, Y2", "X=1 <, Y>=2", ""),
        (
            CORE,
            "X1 , 5",
            "X=1 other[,] other[5]",
            "UnexpectedCharacter[,] NumberWithoutLetter[5]",
        ),
    ]);
}

#[test]
fn comments() {
    check(&[
        (
            CORE,
            "G1 (rough) X1 ; rest (x",
            "G=1 comment[rough] X=1 comment[ rest (x]",
            "",
        ),
        (CORE, "X1(a)Y2", "X=1 comment[a] Y=2", ""),
        (CORE, "/* start\nX1 */ X2\nX3", "comment[ start\nX1 ] X=2 | X=3", ""),
        (CORE, "G1 /**/ X2", "G=1 comment[] X=2", ""),
        (
            CORE,
            "G1 (open\nX2",
            "G=1 comment[open] | X=2",
            "UnclosedComment[(open]",
        ),
        (
            CORE,
            "G1 /* open\nX2",
            "G=1 comment[ open\nX2]",
            "UnclosedComment[/* open\nX2]",
        ),
        (CORE, "/*/ X2", "comment[/ X2]", "UnclosedComment[/*/ X2]"),
        (
            CORE,
            "(a (b) cc) X1",
            "comment[a (b] call:cc other[)] X=1",
            "NestedComment[(]",
        ),
        (CORE, "( commi;ent)", "comment[ commi;ent]", ""),
        (CORE, "; (x", "comment[ (x]", ""),
        (FANUC, "G1 X1 ;", "G=1 X=1", ""),
        (FANUC, "G1 ; X1", "G=1 comment[ X1]", "UnexpectedCharacter[;]"),
        (
            FANUC,
            "/* start */ G1",
            "comment[ start ] G=1",
            "UnexpectedCharacter[/*]",
        ),
        (
            FANUC,
            "/* start\nG1",
            "comment[ start] | G=1",
            "UnexpectedCharacter[/*] UnclosedComment[/* start]",
        ),
        (CORE, "X[1 (one) + 2]", "X={[1 (one) + 2]}", ""),
        (CORE, "(\u{fc}ber)", "comment[\u{fc}ber]", ""),
    ]);
    let inside = program("X[1 (one) + 2] (two)", CORE);
    let all: Vec<_> = inside
        .blocks()
        .flat_map(|block| block.comments())
        .map(|each| inside.text(each.inner))
        .collect();
    assert_eq!(all, ["one", "two"]);
}

#[test]
fn marks() {
    check(&[
        (CORE, "%", "percent[%]", ""),
        (
            CORE,
            "%_N_2.5D-PART_MPF ; c",
            "percent[%_N_2.5D-PART_MPF] comment[ c]",
            "",
        ),
        (CORE, "% MPF 100", "percent[% MPF 100]", ""),
        (CORE, "M30 %", "M=30 percent[%]", ""),
        (CORE, "M30 % X5", "M=30 percent[%] X=5", "UnexpectedCharacter[%]"),
        (CORE, "/N60 G0", "skip1[/] N=60 G=0", ""),
        (CORE, " /3 N70 G0", "skip3[/3] N=70 G=0", ""),
        (CORE, "/0G0", "skip0[/0] G=0", ""),
        (CORE, "N10 /2 X5", "N=10 other[/2] X=5", ""),
        (CORE, "X1 / Y5", "X=1 other[/] Y=5", ""),
        (CORE, ":100 G1", "label[:100] G=1", ""),
        (CORE, "O1000 (part)", "O=1000 comment[part]", ""),
        (SINUMERIK, "LAST_CUT:", "label[LAST_CUT:]", ""),
        (SINUMERIK, "N120 _MM1: G1 Z10", "N=120 label[_MM1:] G=1 Z=10", ""),
        (SINUMERIK, "LBL1: X5", "label[LBL1:] X=5", ""),
        (SINUMERIK, "GOTO1=5 DO2=6", "<GOTO1>=5 <DO2>=6", ""),
        (CORE, "G1 X5*57", "G=1 X=5 other[*57]", ""),
        (
            CORE,
            "X1 : 5",
            "X=1 other[:] other[5]",
            "UnexpectedCharacter[:] NumberWithoutLetter[5]",
        ),
    ]);
}

#[test]
fn assignments() {
    check(&[
        (SINUMERIK, "A=10 C=-.5", "A=10 C=-0.5", ""),
        (SINUMERIK, "A3=0.5 B3 = 0 C3=+1.", "A[3]=0.5 B[3]=0 C[3]=1.", ""),
        (SINUMERIK, "X=R1+2 Y=R10", "X={R1+2} Y={R10}", ""),
        (SINUMERIK, "G2 X1 CR=5. TURN=3", "G=2 X=1 <CR>=5. <TURN>=3", ""),
        (SINUMERIK, "C=DC(90) B=ACP( -.5 )", "C=DC(90) B=ACP(-0.5)", ""),
        (SINUMERIK, "C=DC(R1) B=IC(5)*2", "C={DC(R1)} B={IC(5)*2}", ""),
        (SINUMERIK, "T=\"DRILL\" D1", "T=\"DRILL\" D=1", ""),
        (
            SINUMERIK,
            "T2=\"PARTOFF\" M1=4 S1=900",
            "T[2]=\"PARTOFF\" M[1]=4 S[1]=900",
            "",
        ),
        (SINUMERIK, "R1=5 R2=-5", "R[1]=5 R[2]=-5", ""),
        (SINUMERIK, "R7=R4-1", "R[7]={R4-1}", ""),
        (
            SINUMERIK,
            "R6=360./R3 R9=R1*COS(R8)",
            "R[6]={360./R3} R[9]={R1*COS(R8)}",
            "",
        ),
        (SINUMERIK, "R99999=1", "<R99999>=1", ""),
        (SINUMERIK, "R[R2+1]=3", "<R[R2+1]>=3", ""),
        (SINUMERIK, "VAR5[R2]=R2*2", "<VAR5[R2]>={R2*2}", ""),
        (SINUMERIK, "H2[1]=5", "<H2[1]>=5", ""),
        (SINUMERIK, "N10 Q1[2, 2] = R2", "N=10 <Q1[2, 2]>={R2}", ""),
        (
            SINUMERIK,
            "MX1=5 _X_HOME=0 SPOS[1]=90",
            "<MX1>=5 <_X_HOME>=0 <SPOS[1]>=90",
            "",
        ),
        (SINUMERIK, "_X=$P_AXN1", "<_X>={$P_AXN1}", ""),
        (SINUMERIK, "R1=1.5EX-3 R2='HFF'", "R[1]={1.5EX-3} R[2]={'HFF'}", ""),
        (
            SINUMERIK,
            "X=-R1 Y=NOT R2 AND 1 Z=3",
            "X={-R1} Y={NOT R2 AND 1} Z=3",
            "",
        ),
        (SINUMERIK, "R1=5==R2", "R[1]={5==R2}", ""),
        (CORE, "#1=5 #2 = #1+1.5 #3=-2", "<#1>=5 <#2>={#1+1.5} <#3>=-2", ""),
        (CORE, "#<name> = [#1 * 2] (c)", "<#<name>>={[#1 * 2]} comment[c]", ""),
        (
            CORE,
            "#149=#[FUP[#[ROUND[#148]]]]",
            "<#149>={#[FUP[#[ROUND[#148]]]]}",
            "",
        ),
        (CORE, "##1=5 #[#1+2]=6", "<##1>=5 <#[#1+2]>=6", ""),
        (CORE, "X= Y2", "X=? Y=2", "MissingValue[=]"),
        (
            CORE,
            "X= Y=2 R1=R2=3",
            "X=? Y=2 R[1]=? R[2]=3",
            "MissingValue[=] MissingValue[=]",
        ),
        (CORE, "X=Y2 R1 = R2 + R3", "X={Y2} R[1]={R2 + R3}", ""),
        (CORE, "X=", "X=?", "MissingValue[=]"),
        (CORE, "#1=#2+", "<#1>={#2+}", "MissingValue[+]"),
        (CORE, "#1=--", "<#1>={--}", "MissingValue[-]"),
        (CORE, "#1=[#2+]", "<#1>={[#2+]}", "MissingValue[+]"),
        (CORE, "#1=[]", "<#1>={[]}", "MissingValue[[]"),
        (
            CORE,
            "#1=[#2+[3] (c)",
            "<#1>={[#2+[3]} comment[c]",
            "UnbalancedBracket[[]",
        ),
        (CORE, "#1=[1)] X2", "<#1>={[1)]} X=2", "UnbalancedBracket[)]"),
        (CORE, "#=5", "<#>=5", "MissingValue[#]"),
        (CORE, "#1 X5", "other[#1] X=5", "UnexpectedCharacter[#1]"),
        (SINUMERIK, "T=\"DRILL", "T=\"DRILL", "UnclosedText[\"DRILL]"),
    ]);
}

#[test]
fn letters_with_expressions() {
    check(&[
        (CORE, "X#1 Y-#2 Z #13", "X={#1} Y={-#2} Z={#13}", ""),
        (CORE, "X[1+2]Y[-#2]F[20/3.14]", "X={[1+2]} Y={[-#2]} F={[20/3.14]}", ""),
        (CORE, "G1X[#<a> - 1]Z5", "G=1 X={[#<a> - 1]} Z=5", ""),
        (CORE, "x#<_ini[vars]x> y##2", "X={#<_ini[vars]x>} Y={##2}", ""),
        (
            CORE,
            "X sqrt[2] Y-sin[30] Z EXISTS[#1]",
            "X={sqrt[2]} Y={-sin[30]} Z={EXISTS[#1]}",
            "",
        ),
        (CORE, "X ATAN[1]/[2] Y1", "X={ATAN[1]/[2]} Y=1", ""),
        (CORE, "XSIN[30]", "X={SIN[30]}", ""),
        (CORE, "T#3 ^[360/17]", "T={#3} ^={[360/17]}", ""),
        (CORE, "X50.,R5. ,C#1", "X=50. <,R>=5. <,C>={#1}", ""),
        (CORE, "X[1", "X={[1}", "UnbalancedBracket[[]"),
        (CORE, "X#", "X={#}", "MissingValue[#]"),
        (SINUMERIK, "L\"SUB\"", "L=\"SUB\"", ""),
    ]);
}

#[test]
fn o_words() {
    check(&[
        (CORE, "o100 sub", "O=100 call:sub", ""),
        (
            CORE,
            "O<slot-0> call [1] [#2] (c)",
            "O={<slot-0>} call:call([1] [#2]) comment[c]",
            "",
        ),
        (CORE, "o#<sub> call", "O={#<sub>} call:call", ""),
        (CORE, "O[#2 * 10] call", "O={[#2 * 10]} call:call", ""),
        (CORE, "o1 if [#1 GT 0] AND [#2]", "O=1 call:if([#1 GT 0] AND [#2])", ""),
        (CORE, "o1000 endsub [4712]", "O=1000 call:endsub([4712])", ""),
        (CORE, "O1call", "O=1 call:call", ""),
    ]);
}

#[test]
fn names() {
    check(&[
        (SINUMERIK, "TRAORI", "call:TRAORI", ""),
        (
            SINUMERIK,
            "CYCLE800(1,\"X\",,2) X1",
            "call:CYCLE800(1,\"X\",,2) X=1",
            "",
        ),
        (SINUMERIK, "CYCLE800()", "call:CYCLE800()", ""),
        (
            SINUMERIK,
            "MCALL CYCLE81 (52,(1+2),)",
            "call:MCALL call:CYCLE81(52,(1+2),)",
            "",
        ),
        (SINUMERIK, "MSG(\"a;b\") ;c", "call:MSG(\"a;b\") comment[c]", ""),
        (SINUMERIK, "CYCLE81(1,2", "call:CYCLE81(1,2)", "UnbalancedBracket[(]"),
        (SINUMERIK, "CALL \"PROBE\" X1", "call:CALL(\"PROBE\") X=1", ""),
        (SINUMERIK, "G0 SUPA Z=_Z_HOME D0", "G=0 call:SUPA Z={_Z_HOME} D=0", ""),
        (
            SINUMERIK,
            "DEF REAL A_B=1, C_D=2 ; x",
            "call:DEF(REAL A_B=1, C_D=2) comment[ x]",
            "",
        ),
        (
            SINUMERIK,
            "PROC GROOVE(REAL XBOT, INT P)",
            "call:PROC(GROOVE(REAL XBOT, INT P))",
            "",
        ),
        (SINUMERIK, "FOR R1=1 TO 20", "call:FOR(R1=1 TO 20)", ""),
        (
            SINUMERIK,
            "IF XNOW<=XBOT GOTOF LAST_CUT",
            "call:IF(XNOW<=XBOT) call:GOTOF(LAST_CUT)",
            "",
        ),
        (SINUMERIK, "IF (TYPTH)", "call:IF((TYPTH))", ""),
        (SINUMERIK, "WHILE R7<R3", "call:WHILE(R7<R3)", ""),
        (CORE, "IF[#150 EQ 2]GOTO900", "call:IF([#150 EQ 2]) call:GOTO(900)", ""),
        (CORE, "WHILE[#150 LT 2]DO1", "call:WHILE([#150 LT 2]) call:DO(1)", ""),
        (CORE, "IF[#1EQ0]THEN#2=5", "call:IF([#1EQ0]) call:THEN <#2>=5", ""),
        (SINUMERIK, "GOTOF \"L_\"<<R1 X5", "call:GOTOF(\"L_\"<<R1) X=5", ""),
        (SINUMERIK, "GOTOF PLACE<<NR X5", "call:GOTOF(PLACE<<NR) X=5", ""),
        (SINUMERIK, "PO[]=(2,1)", "<PO[]>={(2,1)}", ""),
        (SINUMERIK, "X=GE Y=LT Z=OR1", "X={GE} Y={LT} Z={OR1}", ""),
        (
            SINUMERIK,
            "IF (R1==5) OR (R2==6) GOTOF X_1",
            "call:IF((R1==5) OR (R2==6)) call:GOTOF(X_1)",
            "",
        ),
        (SINUMERIK, "$TC_DP1[1,1]=120", "<$TC_DP1[1,1]>=120", ""),
        (CORE, "END1", "call:END(1)", ""),
        (CORE, "GOTO 100", "call:GOTO(100)", ""),
        (CORE, "GOTO100", "call:GOTO(100)", ""),
        (CORE, "GOTO[#1+1]", "call:GOTO([#1+1])", ""),
        (CORE, "GOTO N100", "call:GOTO(N100)", ""),
        (CORE, "DPRNT[X#500[53]]", "call:DPRNT([X#500[53]])", ""),
        (CORE, "CYCLE800 (comment)", "call:CYCLE800 comment[comment]", ""),
        (SINUMERIK, "N10G18G90G95 DIAMON", "N=10 G=18 G=90 G=95 call:DIAMON", ""),
        (
            SINUMERIK,
            "ID=1 WHENEVER $AA_IM[X]>5 DO M3",
            "<ID>=1 call:WHENEVER($AA_IM[X]>5) call:DO M=3",
            "",
        ),
    ]);
}

#[test]
fn block_numbers_are_found_behind_block_delete() {
    let program = program("/2 N2930 G1\n(c) N5.5\nG1 N10\nNX5\n\n", CORE);
    let numbers: Vec<_> = program
        .blocks()
        .map(|block| block.number().map(|range| program.text(range)))
        .collect();
    assert_eq!(numbers, [Some("N2930".into()), Some("N5.5".into()), None, None, None]);
}
