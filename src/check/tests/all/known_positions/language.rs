//! Random programs of each dialect: words whose values are known or not, and the codes that give coordinates their meaning.
use proptest::prelude::*;

/// A line of a program, or some that belong together.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) text: String,
    /// Axes that its words name, bits in the order of `AXIS_LETTERS`.
    pub(crate) axes: u16,
}

/// How words are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Words {
    /// `X1.`, `X#500`.
    Macro,
    /// `X1.`, `X=R1`, `X=IC(R1)`.
    Sinumerik,
    /// `X1.`, `X=VC1`.
    Okuma,
    /// `X+1`, `IX+Q1`.
    Klartext,
    /// Whole lines only.
    None,
}

#[derive(Debug)]
pub(crate) struct Language {
    pub(crate) dialect: &'static str,
    pub(crate) machines: &'static [&'static str],
    words: Words,
    /// Two variables that have no value.
    pub(crate) variables: [&'static str; 2],
    /// The first lines, and how all axes come to a known position: `A` and `C` stand for the rotary axes of the machine.
    pub(crate) head: &'static str,
    /// Codes in front of words of axes, with `|` between them; `?` is a value.
    moves: &'static str,
    /// Lines of their own, in the same form.
    codes: &'static str,
}

const FIVE_AXES: &[&str] = &["mikron-ucp710", "fork-head-ca"];
const LATHES: &[&str] = &["lathe-2axis", "mill-turn-bc"];

const MILL_HEAD: &str = "G21 G90 G94 G17\nG0 X1. Y2. Z50. A0. C0. F100.\n";
const LATHE_HEAD: &str = "G21 G99 G18\nG0 X60. Z5. F.1\n";
const MOVES: &str = "\
     ||G0|G1|G1|G53|G91|G90|G28|G30|G2 R60.|G2 R?|G3 I5. J3.|G3 I? J3.|G81 R2.|G81 R?|G1 ,C?|G1 ,R?|G31|G4|G83 R2. Q1.|G73 R2. Q1.|G53 G0|G91 G28";
const CODES: &str = "\
     G43 H1|G43 H1 Z?|G49|G43.4 H1|G43.5 H1|G43.4 H1 X? Y? Z?|G53.1|G54|G55|G68 X0. Y0. R?|G68 R30.|G69|\
     G68.2 X0. Y0. Z0. I? J? K?|G68.2 X? Y0. Z5. I0. J30. K0.|G68.2 X0. Y0. Z0. I90. J90. K0.|G52 X?|G52 X0. Y? Z?|G52 C?|\
     G92 X?|G92 Z? C?|G10 L2 P1 X?|G10 L2 P1 C?|G10 L20 P1 Z?|G50.1 X0.|G51.1 X?|G51.1 Y0.|G51 X0. Y0. P?|G50|G16|G15|G17|\
     G18|G19|G80|G90|G91|G98|G99|G41 D1|G40|G93|G20|G21|G7.1 C20.|G12.1|G13.1|G38.2 Z?|M6 T1|G65 P1|M98 P1|G254|G255|G234|\
     G92.1|G28.1|G73 X0. Y0. R?|G10 L2 P0 Z?|G53.6 H1|G28|G107 A0. R10.";
const LATHE_CODES: &str = "\
     G54|G55|G52 X?|G52 Z?|G92 X?|G50 X?|G50 S1000|G10 L2 P1 X?|T0101|T0202|T0100|G98|G99|G40|G41|G42|G20|G21|G96 S100|\
     G97 S500|G28 U0. W0.|G28 U?|G12.1|G13.1|G7.1 C20.|G80|G17|G18|G68.1 X0. Y0. R?|G69.1|M98 P1|G10 P1 X?";
const LATHE_MOVES: &str = "\
     ||G0|G1|G1|G53|G28|G2 R60.|G90|G94|G92 F1.|G32 F1.|G4|G77|G79|G91|G1 R?|G1 I?|G1 K?|G1 ,C?|G1 ,R?";
const SINUMERIK_MOVES: &str = "\
     ||G0|G1|G1|G53 G0|SUPA G0|G153 G0|G91|G90|G2 CR=60.|CIP I1=3. J1=4. K1=5.|CT|G75|G74|G4|G0 G40|G1 CHF=?|G1 RND=?|G1 CHR=?|G1 RNDM=?|G1 ANG=?";
const SINUMERIK_CODES: &str = "\
     TRANS X=?|TRANS X=? Y=?|ATRANS Y=?|ATRANS C=?|TRANS|ROT Z=?|ROT X=90.|ROT X=?|AROT X=?|AROT RPL=?|ROT|SCALE X=?|\
     ASCALE Z=?|MIRROR X0|AMIRROR Y0|TRAORI|TRAORI|TRAFOOF|TRAFOOF|TOROT|TOROTOF|G54|G55|G500|G90|G91|G17|G18|G19|G40|D1|D0|\
     T1 M6|MCALL CYCLE81(5,0,2,?)|MCALL CYCLE81(50,?,2,-3)|MCALL|CYCLE800()|CYCLE800(0,\"\",0,57,0,0,0,?,0,0,0,0,0,1)|\
     CYCLE800(0,\"\",0,57,0,0,0,30,?,0,0,0,0,0)|CYCLE800(0,\"\",0,57,?,0,0,0,30,0,0,0,0,1)|\
     CYCLE800(0,\"\",0,57,0,0,0,90,0,0,?,0,0,1)|$P_UIFR[1,X,TR]=?|$P_UIFR[1,Z,RT]=?|G1 A3=0 B3=0 C3=1|G1 A3=? B3=0 C3=1|\
     ORIWKS|ORIMKS|CFTCP|G700|G710|G110 X=? Y=?|G111 X0 Y0|G1 AP=? RP=10.|G1 AP=30. RP=?|$P_PFRAME=CTRANS(X,?)|\
     $P_PFRAME=CTRANS(X,5):CROT(Z,?)|CYCLE81(5,0,2,?)|POT1(?)|STOPRE|TRANSMIT|TRACYL(?)|R3=?|X=R3";
const OKUMA_MOVES: &str = "\
     ||G0|G1|G1|G91|G90|G16 H0|G2 I5. J3.|G81 R2.|G30 P1|G4|G53";
const OKUMA_CODES: &str = "\
     G15 H1|G15 H2|G16 H1|G16 H0|G56 H1|G53|G169 H1|G169 H1|G170|G170|G11 X=? Y=?|G11 P=?|G11 X5. P=?|G10|G92 X=?|G90|G91|\
     G17|G18|G19|G80|G71 Z=?|M53|M54|G40|G41 D1|G116 T1|M6 T1|CALL O1|G20|G21|VC3=?|X=VC3|G62 X=?|G60";
const KLARTEXT_MOVES: &str = "\
     L|L|L|L|CR R+60 DR+|CT|M91|M92|M99|RR|R0|CYCL";
const KLARTEXT_CODES: &str = "\
     M128|M128|M129|M129|FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS|FUNCTION TCPM F TCP AXIS SPAT PATHCTRL VECTOR|\
     FUNCTION RESET TCPM|M126|M127|M130|L M140 MB?|L M140 MB MAX|PLANE SPATIAL SPA? SPB+0 SPC+0 STAY|\
     PLANE SPATIAL SPA+0 SPB? SPC+0 TURN FMAX|PLANE SPATIAL SPA+90 SPB+0 SPC+0 TURN FMAX|\
     PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY|PLANE SPATIAL SPA+0 SPB+30 SPC? MOVE DIST50 F500|PLANE AXIAL A? C+0 TURN FMAX|\
     PLANE RELATIVE SPB? STAY|PLANE RESET STAY|PLANE RESET TURN FMAX|PLANE EULER EULPR? EULNU+30 EULROT+0 STAY|\
     CYCL DEF 7.0 D\nCYCL DEF 7.1 X?|CYCL DEF 7.0 D\nCYCL DEF 7.1 IX?\nCYCL DEF 7.2 Z+5|CYCL DEF 7.0 D\nCYCL DEF 7.1 C?|\
     CYCL DEF 8.0 M\nCYCL DEF 8.1 X|CYCL DEF 8.0 M\nCYCL DEF 8.1|CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT?|\
     CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL?|CYCL DEF 26.0 S\nCYCL DEF 26.1 X? CCX+5|CYCL DEF 26.0 S\nCYCL DEF 26.1 X1.5 Y1.5 CCX? CCY+2|\
     CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y1|TRANS DATUM AXIS X? Z+3|TRANS DATUM RESET|\
     CYCL DEF 247 SET DATUM ~\nQ339=+1 ;DATUM NUMBER|CC X? Y+0|CC|LP PR? PA+30 F100|LP PR+10 IPA? F100|C X? Y+3 DR+|\
     CP IPA? IZ+2 DR+ F100|TOOL CALL 1 Z S1000|TOOL CALL 1 Z S1000 DL?|TOOL CALL 2 Y S1000|CYCL CALL|\
     LN X+1 Y? Z+3 NX+0 NY+0 NZ+1 TX+0 TY+0 TZ+1 F100|LN X+1 Y+2 Z+3 NX+0 NY+0 NZ+1 TX+0 TY? TZ+1 F100|Q3 = ?|L X+Q3 F100|\
     CALL LBL 7|CALL PGM NONE";
const APT_CODES: &str = "\
     GOTO/1,2,3,0,0,1|GOTO/4,2,3|GOTO/4,2,3,0.6,0,0.8|GOTO/P1|GOTO/1,1|GODLTA/1,2,3|GODLTA/P1|FROM/0,0,50|GOHOME|GO/TO,L1|\
     RAPID|CYCLE/DRILL,5,MMPM,2|CYCLE/OFF|TRACUT/1,0,0,5,0,1,0,0,0,0,1,0|TRACUT/NOMORE|INDEX/1|CALL/M1|LOADTL/1|MULTAX/OFF|\
     MULTAX/ON|ROTABL/45,AAXIS|ROTHED/30|MOVARC/0,0,50,0,0,1,5,ANGLE,90";

const fn mill(dialect: &'static str, variables: [&'static str; 2]) -> Language {
    Language {
        dialect,
        machines: FIVE_AXES,
        words: Words::Macro,
        variables,
        head: MILL_HEAD,
        moves: MOVES,
        codes: CODES,
    }
}

const fn lathe(dialect: &'static str) -> Language {
    Language {
        dialect,
        machines: LATHES,
        words: Words::Macro,
        variables: ["#500", "#501"],
        head: LATHE_HEAD,
        moves: LATHE_MOVES,
        codes: LATHE_CODES,
    }
}

pub(crate) const LANGUAGES: &[Language] = &[
    mill("iso-6983", ["#500", "#501"]),
    mill("linuxcnc", ["#5161", "#5162"]),
    mill("fanuc-30i", ["#500", "#501"]),
    mill("haas-ngc", ["#500", "#501"]),
    mill("grbl", ["#500", "#501"]),
    lathe("fanuc-30i-lathe-a"),
    lathe("fanuc-30i-lathe-b"),
    lathe("fanuc-30i-lathe-c"),
    lathe("haas-lathe"),
    Language {
        dialect: "sinumerik-840d",
        machines: FIVE_AXES,
        words: Words::Sinumerik,
        variables: ["R1", "R2"],
        head: MILL_HEAD,
        moves: SINUMERIK_MOVES,
        codes: SINUMERIK_CODES,
    },
    Language {
        dialect: "okuma-osp",
        machines: FIVE_AXES,
        words: Words::Okuma,
        variables: ["VC1", "VC2"],
        head: "G15 H1\nG90 G94 G17\nG0 X1. Y2. Z50. A0. C0. F100.\n",
        moves: OKUMA_MOVES,
        codes: OKUMA_CODES,
    },
    Language {
        dialect: "heidenhain-klartext",
        machines: FIVE_AXES,
        words: Words::Klartext,
        variables: ["Q1", "Q2"],
        head: "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 F500\nL X+1 Y+2 Z+50 A+0 C+0 R0 FMAX\n",
        moves: KLARTEXT_MOVES,
        codes: KLARTEXT_CODES,
    },
    Language {
        dialect: "apt",
        machines: FIVE_AXES,
        words: Words::None,
        variables: ["", ""],
        head: "UNITS/MM\nMULTAX/ON\nCUTTER/10\nSPINDL/ON\nRAPID\nGOTO/1,2,50,0,0,1\nFEDRAT/100,MMPM\n",
        moves: "",
        codes: APT_CODES,
    },
];

/// A value that is written as a number, or one of the two variables.
fn value(language: &'static Language) -> impl Strategy<Value = String> {
    let plain = prop::sample::select(vec!["5", "-3.5", "0", "30", "12.25", "90"]);
    let variable = prop::sample::select(language.variables.to_vec());
    (0..3_u8, plain, variable).prop_map(|(kind, plain, variable)| match kind {
        0 if language.words != Words::None => variable.to_owned(),
        _ if plain.contains('.') || language.words == Words::Klartext => plain.to_owned(),
        _ => format!("{plain}."),
    })
}

/// A value where Klartext wants a sign.
fn signed(language: &Language, value: &str) -> String {
    let sign = language.words == Words::Klartext && !value.starts_with('-');
    if sign { format!("+{value}") } else { value.to_owned() }
}

fn word(language: &'static Language) -> impl Strategy<Value = (char, String)> {
    let letters: &[char] = match language.words {
        Words::Macro if language.head == LATHE_HEAD => &['X', 'Z', 'X', 'Z', 'U', 'W', 'C'],
        _ => &['X', 'Y', 'Z', 'X', 'Y', 'Z', 'A', 'C'],
    };
    (prop::sample::select(letters.to_vec()), value(language), 0..8_u8).prop_map(move |(letter, value, kind)| {
        let text = match language.words {
            Words::Macro | Words::None => format!(" {letter}{value}"),
            Words::Okuma => format!(" {letter}={value}"),
            Words::Klartext if kind == 0 => format!(" I{letter}{}", signed(language, &value)),
            Words::Klartext => format!(" {letter}{}", signed(language, &value)),
            Words::Sinumerik => match kind {
                0 => format!(" {letter}=IC({value})"),
                1 => format!(" {letter}=AC({value})"),
                2 if letter == 'C' => format!(" {letter}=DC({value})"),
                3 if letter == 'C' => format!(" {letter}=ACP({value})"),
                _ => format!(" {letter}={value}"),
            },
        };
        (letter, text)
    })
}

/// The axis that a letter moves.
fn axis(language: &Language, letter: char) -> u16 {
    let dialect = trunnion_dialect::builtin(language.dialect).expect("built in");
    let increment = dialect.role(letter as u8) == Some(trunnion_dialect::Role::Increment);
    let letter = match letter {
        'U' if increment => 'X',
        'W' if increment => 'Z',
        other => other,
    };
    let at = trunnion_interp::AXIS_LETTERS
        .iter()
        .position(|axis| char::from(*axis) == letter);
    at.map_or(0, |at| 1 << at)
}

/// A code and words of axes.
fn moving(language: &'static Language) -> impl Strategy<Value = Line> {
    let code = prop::sample::select(items(language.moves));
    let words = prop::collection::vec(word(language), 1..4);
    (code, words, value(language), value(language)).prop_map(move |(code, mut words, a, b)| {
        let code = filled(language, code, [a, b]);
        let mut seen = 0;
        words.retain(|(letter, _)| {
            let bit = axis(language, *letter);
            let new = seen & bit == 0;
            seen |= bit;
            new
        });
        let all: String = words.iter().map(|(_, text)| text.as_str()).collect();
        let text = match (language.words, code.as_str()) {
            (Words::Klartext, "M91" | "M92" | "M99" | "RR" | "R0") => format!("L{all} F100 {code}\n"),
            (Words::Klartext, "CYCL") => format!("CYCL CALL POS{all}\n"),
            (Words::Klartext, code) => match code.split_once(' ') {
                Some((code, rest)) => format!("{code}{all} {rest} F100\n"),
                None => format!("{code}{all} F100\n"),
            },
            (_, code) => format!("{code}{all}\n"),
        };
        Line { text, axes: seen }
    })
}

/// The items of a table.
fn items(table: &'static str) -> Vec<&'static str> {
    table.split('|').collect()
}

/// A code with its values.
fn filled(language: &Language, code: &str, values: impl IntoIterator<Item = String>) -> String {
    let mut values = values.into_iter();
    let mut text = String::new();
    for letter in code.chars() {
        match letter {
            '?' => text.push_str(&signed(language, &values.next().unwrap_or_else(|| "1".into()))),
            other => text.push(other),
        }
    }
    text
}

/// A line of codes.
fn coded(language: &'static Language) -> impl Strategy<Value = Line> {
    let code = prop::sample::select(items(language.codes));
    (code, value(language), value(language), value(language)).prop_map(move |(code, a, b, c)| Line {
        text: filled(language, code, [a, b, c]) + "\n",
        axes: if code == "GOTO/P1" { 0b111 } else { 0 },
    })
}

/// The lines of a program.
pub(crate) fn body(language: &'static Language) -> impl Strategy<Value = Vec<Line>> {
    let line = if language.moves.is_empty() {
        coded(language).boxed()
    } else {
        prop_oneof![moving(language), coded(language)].boxed()
    };
    prop::collection::vec(line, 1..7).prop_map(move |lines| {
        let head = Line {
            text: language.head.to_owned(),
            axes: 0,
        };
        std::iter::once(head).chain(lines).collect()
    })
}
