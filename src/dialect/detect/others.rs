//! Signs of controls whose programs are recognised and not read. Each sign is something that only one control writes.
use super::text::{has, has_word, unnumbered, word, words};
use super::votes::Votes;

/// Signs in a line as it is written, in upper case.
pub(super) fn raw(line: &str, votes: &mut Votes) {
    klartext(line, votes);
    fagor(line, votes);
    marlin_comments(line, votes);
    if line.starts_with("//") {
        votes.add("wire-edm", 4, "a `//` comment");
    }
    if has_word(line, "WEDM") || line.contains("ACCUTEX") || line.starts_with("(EXTERNAL TEC") {
        votes.add("wire-edm", 12, "the conditions of a wire EDM");
    }
    let endings = [".MIN", ".SSB", ".SUB", ".LIB", ".MSB"];
    let is_name = line.starts_with('$') && endings.iter().any(|end| line.contains(end));
    if is_name {
        votes.add("okuma-osp", 12, "a file name $...MIN");
    }
}

/// Fagor: the first line of a program sent to a CNC 8055 is `%COMMENT,PERMISSIONS` with letters of MXHO, and its statements are in
/// parentheses; a CNC 8065 has instructions that begin with `#` and statements of the flow that begin with `$` (Fagor, CNC 8055 and
/// CNC 8065 programming manuals).
fn fagor(line: &str, votes: &mut Votes) {
    if let Some((name, permissions)) = line.strip_prefix('%').and_then(|rest| rest.split_once(',')) {
        let letters = permissions.trim_end().trim_end_matches([',', ' ']);
        let plain = !letters.is_empty() && letters.bytes().all(|b| matches!(b, b'M' | b'X' | b'H' | b'O' | b'-'));
        if plain && !name.trim().is_empty() && letters.contains(['M', 'X']) {
            votes.add("fagor", 20, "a header `%NAME,MX`");
        }
    }
    let text = unnumbered(line);
    let numbered = |start: &str| {
        let rest = text.strip_prefix(start);
        rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    for (start, weight) in [("(RPT N", 10), ("(P", 3), ("(CALL ", 3), ("(PCALL ", 10), ("(SUB ", 3)] {
        let statement = numbered(start) && (start != "(P" || text.contains('='));
        if statement {
            votes.add("fagor", weight, &format!("the statement {start}...)"));
        }
    }
    let compares = [" EQ ", " NE ", " GT ", " LT ", " GE ", " LE "];
    let condition = text.strip_prefix("(IF ").is_some_and(|rest| {
        let parameter = rest.starts_with('P') && rest[1..].starts_with(|c: char| c.is_ascii_digit());
        parameter && compares.iter().any(|compare| rest.contains(compare))
    });
    if condition {
        votes.add("fagor", 8, "the statement (IF ...)");
    }
    for name in [
        "#CS ",
        "#ACS ",
        "#TCAM ",
        "#RTCP ",
        "#TLC ",
        "#MSG ",
        "#MSG[",
        "#CALL ",
        "#PCALL ",
        "#HSC ",
        "#SLOPE ",
        "#TOOL AX",
        "$IF ",
        "$FOR ",
        "$WHILE ",
        "$ENDIF",
        "$ENDFOR",
        "$ENDWHILE",
        "$GOTO ",
    ] {
        if text.starts_with(name) {
            votes.add("fagor", 10, name.trim_end());
        }
    }
}

/// Signs in a line without comments, in upper case.
pub(super) fn code(code: &str, votes: &mut Votes) {
    // SINUMERIK, fundamentals: G291 changes to an ISO dialect
    if has(code, b'G', "291") {
        votes.add("sinumerik-iso", 12, "G291");
    }
    okuma(code, votes);
    centroid_and_eding(code, votes);
    wire(code, votes);
    marlin(code, votes);
}

pub(super) fn klartext(line: &str, votes: &mut Votes) {
    let text = unnumbered(line);
    for start in ["BEGIN PGM ", "END PGM "] {
        if text.starts_with(start) {
            votes.add("heidenhain-klartext", 40, start.trim_end());
        }
    }
    for start in [
        "TOOL CALL",
        "TOOL DEF",
        "BLK FORM",
        "CYCL DEF",
        "CYCL CALL",
        "CALL LBL",
        "CALL PGM",
        "TCH PROBE",
        "PLANE SPATIAL",
        "PLANE RESET",
        "FUNCTION TCPM",
        "APPR L",
        "APPR C",
        "DEP L",
        "DEP C",
        "FN 0:",
        "FN 9:",
        "FN 18:",
        "PATTERN DEF",
        "TRANS DATUM",
    ] {
        if text.starts_with(start) {
            votes.add("heidenhain-klartext", 10, start);
        }
    }
    if let Some(rest) = text.strip_prefix("LBL ") {
        let named = rest.starts_with('"') || rest.starts_with(|c: char| c.is_ascii_digit());
        if named {
            votes.add("heidenhain-klartext", 8, "LBL");
        }
    }
    let signed = |rest: &str| {
        let mut chars = rest.trim_start_matches('I').chars();
        matches!(chars.next(), Some('X' | 'Y' | 'Z' | 'A' | 'B' | 'C')) && matches!(chars.next(), Some('+' | '-'))
    };
    if ["L ", "LN ", "CC ", "C "]
        .iter()
        .any(|start| text.strip_prefix(start).is_some_and(|rest| signed(rest.trim_start())))
    {
        votes.add("heidenhain-klartext", 8, "an L, C or CC block");
    }
    // `40 L X+5 ...` without signs
    let plain = |rest: &str| {
        let mut chars = rest.trim_start().trim_start_matches('I').chars();
        matches!(chars.next(), Some('X' | 'Y' | 'Z')) && chars.next().is_some_and(|c| c.is_ascii_digit())
    };
    if ["L ", "LN ", "CC ", "CR "]
        .iter()
        .any(|start| text.strip_prefix(start).is_some_and(plain))
    {
        votes.add("heidenhain-klartext", 8, "an L, CR or CC block");
    }
    if has_word(text, "FMAX") {
        votes.add("heidenhain-klartext", 8, "FMAX");
    }
    // DIN/ISO: every block ends with an asterisk
    let ends = line.trim_end().strip_suffix('*').map(str::trim_end);
    if ends.is_some_and(|code| code.starts_with(['N', '%']) && code.len() > 3) {
        votes.add("heidenhain-iso", 20, "a block that ends with `*`");
    }
}

fn okuma(code: &str, votes: &mut Votes) {
    let code = code.strip_prefix('/').unwrap_or(code);
    if let Some(rest) = code.strip_prefix('O') {
        let name = rest.trim();
        let is_name = name.len() > 1
            && name.starts_with(|c: char| c.is_ascii_uppercase())
            && name.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit());
        // the name is at the start of the file, or of a subprogram in a library
        if is_name {
            votes.add("okuma-osp", if votes.line <= 5 { 10 } else { 4 }, "a program name O...");
        }
    }
    if code == "RTS" || unnumbered(code) == "RTS" || (code.starts_with('N') && code.ends_with(" RTS")) {
        votes.add("okuma-osp", 10, "RTS");
    }
    if code.starts_with("CALL O") || code.contains(" CALL O") {
        votes.add("okuma-osp", 10, "CALL O");
    }
    for name in [
        "NOEX", "MODIN", "MODOUT", "VSIOX", "VPVDX", "VTLCN", "VTLNN", "VDOUT[", "VUACM[", "VWKCC[", "VATOL", "VGCOD[",
    ] {
        if has_word(code, name) {
            votes.add("okuma-osp", 10, name);
        }
    }
    for axis in ["X", "Y", "Z", "A", "B", "C"] {
        if code.contains(&format!("VZOF{axis}[")) || code.contains(&format!("VETF{axis}[")) {
            votes.add("okuma-osp", 10, "VZOF");
        }
    }
    let common = code.match_indices("VC").any(|(at, _)| {
        let after = code[at + 2..].trim_start_matches(|c: char| c.is_ascii_digit());
        after.len() < code.len() - at - 2 && !code[..at].ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
    });
    if common {
        votes.add("okuma-osp", 8, "a variable VC");
    }
    if has(code, b'G', "15") && word(code, b'H') {
        votes.add("okuma-osp", 10, "G15 H");
    }
    if has(code, b'G', "116") && word(code, b'T') {
        votes.add("okuma-osp", 8, "G116 T");
    }
    // the turret, and the spindle at the side of the chuck
    for sign in ["G13", "G140", "G141"] {
        if unnumbered(code) == sign {
            votes.add("okuma-osp-lathe", 6, &format!("{sign} alone"));
        }
    }
    if code.contains("HP=") {
        votes.add("okuma-osp", 8, "HP=");
    }
    // IF [A EQ B] NSKIP, GOTO NSKIP, NSKIP: sequence names
    let named = |rest: &str| {
        let mut chars = rest.trim_start().chars();
        chars.next() == Some('N') && chars.next().is_some_and(|c| c.is_ascii_alphanumeric())
    };
    let jumps = code.find("IF").is_some_and(|at| {
        let rest = &code[at + 2..];
        rest.trim_start().starts_with('[') && rest.rfind(']').is_some_and(|end| named(&rest[end + 1..]))
    });
    if jumps || code.split_once("GOTO ").is_some_and(|(_, rest)| named(rest)) {
        votes.add("okuma-osp", 8, "a jump to a sequence name");
    }
    let label = code.split_whitespace().next().unwrap_or_default();
    if label.len() > 2 && label.starts_with('N') && label.as_bytes()[1].is_ascii_uppercase() && !label.ends_with(':') {
        let plain = label.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit());
        if plain && label[1..].bytes().any(|b| b.is_ascii_digit()) {
            votes.add("okuma-osp", 4, "a sequence name");
        }
        if plain && (label.starts_with("NLAP") || label.starts_with("NAT")) {
            votes.add("okuma-osp", 8, SEQUENCE_NAME);
            votes.add("okuma-osp-lathe", 4, SEQUENCE_NAME);
        }
    }
    // T with the offset twice: T010101
    if words(code)
        .any(|(letter, number)| letter == b'T' && number.len() == 6 && number.bytes().all(|b| b.is_ascii_digit()))
    {
        votes.add("okuma-osp-lathe", 4, "a T word of six digits");
    }
}

/// A habit of programs for lathes, which some for machining centres have too.
pub(super) const SEQUENCE_NAME: &str = "a sequence name NLAP or NAT";

/// Whether only an Okuma for turning has what is in a line: limits of the spindle, turrets, sides, driven tools, LAP (NC-PB/gEdit, syntax-okuma.md).
pub(super) fn okuma_turns(code: &str) -> bool {
    let g = [
        "13", "14", "96", "101", "102", "103", "110", "111", "136", "137", "138", "140", "141", "180", "181", "182",
        "183", "184", "185", "186", "187", "188", "189",
    ];
    let m = ["109", "110", "146", "147"];
    let limit = has(code, b'G', "50") && word(code, b'S');
    let lap = ["85", "86", "87", "88"].iter().any(|number| {
        has(code, b'G', number)
            && code
                .split_whitespace()
                .skip(1)
                .any(|part| part.starts_with('N') && !part.starts_with("NOEX"))
    });
    let steps = ["73", "74"].iter().any(|number| has(code, b'G', number)) && word(code, b'D');
    let thread = ["71", "72"].iter().any(|number| has(code, b'G', number)) && word(code, b'X') && word(code, b'Z');
    // T010101, T0101, T1212
    let turret = words(code).any(|(letter, number)| {
        let pair = number.len() == 4 && (number.starts_with('0') || number[..2] == number[2..]);
        letter == b'T'
            && (pair || number.len() == 6)
            && number.bytes().all(|b| b.is_ascii_digit())
            && !has(code, b'M', "6")
    });
    let coded = g.iter().any(|number| has(code, b'G', number)) || m.iter().any(|number| has(code, b'M', number));
    coded || limit || lap || steps || thread || turret || has_word(code, "SB")
}

/// Whether only an Okuma for milling has what is in a line.
pub(super) fn okuma_mills(code: &str) -> bool {
    let drills = (81..=89).any(|number| has(code, b'G', &number.to_string())) && word(code, b'R');
    drills || has(code, b'G', "56") && word(code, b'H') || ["169", "116"].iter().any(|number| has(code, b'G', number))
}

fn centroid_and_eding(code: &str, votes: &mut Votes) {
    if (code.contains("||") || code.contains("&&")) && !code.starts_with('%') {
        votes.add("centroid", 6, "|| or &&");
    }
    if code.starts_with("IF ") && code.contains(" THEN ") && !code.starts_with("IF [") {
        votes.add("centroid", 5, "IF without brackets");
    }
    for number in ["200", "223", "224", "225"] {
        if has(code, b'M', number) && code.contains('"') {
            votes.add("centroid", 10, "a message with M200 or M223 to M225");
        }
    }
    let is_system = |digits: &str| digits.len() == 5 && digits.starts_with(['2', '3', '5']);
    let variable = code.match_indices('#').any(|(at, _)| {
        let rest = &code[at + 1..];
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        is_system(&rest[..end])
    });
    if variable {
        votes.add("centroid", 5, "a variable of five digits");
    }
    for name in [
        "DLGMSG",
        "ERRMSG",
        "WARNMSG",
        "LOGMSG",
        "GOSUB",
        "LOGFILE",
        "TCAGUARD",
        "ZEROSETTOOLLENGTH",
    ] {
        if code.starts_with(name) {
            votes.add("eding", 12, name);
        }
    }
    if code.strip_prefix("SUB ").is_some_and(|name| !name.contains(['(', ','])) {
        votes.add("eding", 8, "SUB");
    }
    if code == "ENDSUB" {
        votes.add("eding", 8, "ENDSUB");
    }
    if code.starts_with("MSG \"") {
        votes.add("eding", 6, "MSG");
    }
}

fn wire(code: &str, votes: &mut Votes) {
    let mut parts = code.splitn(2, '=');
    let (name, rest) = (parts.next().unwrap_or_default().trim(), parts.next());
    let condition = name.len() >= 4 && name.starts_with(['E', 'C']) && name[1..].bytes().all(|b| b.is_ascii_digit());
    if condition && rest.is_some_and(|rest| rest.split_whitespace().count() >= 3) {
        votes.add("wire-edm", 15, "a table of cutting conditions");
    }
    let offset = name.len() >= 2 && name.starts_with('H') && name[1..].bytes().all(|b| b.is_ascii_digit());
    if offset && rest.is_some() {
        votes.add("wire-edm", 5, "an offset H1=");
    }
    let bare = code.len() >= 2 && code.starts_with(['E', 'C']) && code[1..].bytes().all(|b| b.is_ascii_digit());
    if bare {
        votes.add("wire-edm", 5, "a condition alone in its line");
    }
    for name in ["TEC,", "WIR,", "CLE,", "HPA,", "CCF,", "RSA,", "PRF,", "TNL", "GLU"] {
        if unnumbered(code).starts_with(name) {
            votes.add("wire-edm", 10, name);
        }
    }
    let thread = ["84", "85", "90", "91", "94"]
        .iter()
        .any(|number| has(code, b'T', number));
    if thread && !word(code, b'M') && !word(code, b'X') && code.len() <= 8 {
        votes.add("wire-edm", 5, "a machine function T84 to T94");
    }
    // conical cutting
    let cone = ["51", "52"].iter().any(|number| has(code, b'G', number)) && word(code, b'A') && !word(code, b'X');
    if cone {
        votes.add("wire-edm", 6, "the taper G51 or G52 A");
    }
    for (alone, weight) in [("G38", 5), ("G39", 3)] {
        if unnumbered(code) == alone {
            votes.add("wire-edm", weight, &format!("{alone} alone"));
        }
    }
    if has(code, b'G', "38") && word(code, b'D') {
        votes.add("wire-edm", 8, "G38 D");
    }
}

fn marlin_comments(line: &str, votes: &mut Votes) {
    for start in [";FLAVOR:", ";LAYER:", ";TYPE:", ";LAYER_CHANGE", ";LAYER_COUNT"] {
        if line.starts_with(start) {
            votes.add("marlin", 10, start);
        }
    }
}

fn marlin(code: &str, votes: &mut Votes) {
    if has(code, b'G', "92") && words(code).any(|(letter, number)| letter == b'E' && !number.is_empty()) {
        votes.add("marlin", 10, "G92 E");
    }
    for number in ["104", "109", "140"] {
        if has(code, b'M', number) && word(code, b'S') {
            votes.add("marlin", 8, &format!("M{number} S"));
        }
    }
    let extrudes =
        (has(code, b'G', "1") || has(code, b'G', "0")) && word(code, b'E') && (word(code, b'X') || word(code, b'F'));
    if extrudes && !word(code, b'P') {
        votes.add("marlin", 8, "G1 with E");
    }
    for number in ["82", "83", "107"] {
        if code == format!("M{number}") {
            votes.add("marlin", 3, &format!("M{number} alone"));
        }
    }
}
