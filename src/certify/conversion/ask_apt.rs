//! What an APT record asks for beside motions.
use super::ask::{Ask, Coolant, Found, Why};
use super::ask_iso::plain;
use trunnion_syntax::{AptArg, Block, Record, TextRange};

/// Records that motions, tools and feeds of the run hold, or that only say how the motions are meant.
const HELD: &[&str] = &[
    "GOTO", "GODLTA", "FROM", "RAPID", "CIRCLE", "DELAY", "FEDRAT", "UNITS", "UNIT", "MULTAX", "TLAXIS", "CUTTER",
    "TLDATA", "CUTCOM", "CSYS", "MSYS", "TRANS", "ORIGIN", "TRACUT", "END", "FINI", "LOADTL", "LOAD", "TOOLNO",
    "INDIRV", "TLON", "AUTOPS", "REWIND",
];

/// Records for people, for other programs or for the listing: no control reads them. Names of planes and tolerances are used by records
/// that are not modelled.
const IDLE: &[&str] = &[
    "PPRINT",
    "REMARK",
    "TITLES",
    "PARTNO",
    "DISPLY",
    "INTOL",
    "OUTTOL",
    "TOLER",
    "THICK",
    "CLPRNT",
    "NOPOST",
    "NOPLOT",
    "PPTOL",
    "LEADER",
    "SEQNO",
    "STEP",
    "MOVETO",
    "SYN",
    "PRINT",
    "SELECT",
    "SELCTL",
    "MACHIN",
    "MFGNO",
    "FEATNO",
    "TRNTYP",
    "SETUP",
    "CSI_SET_FLUTE_LENGTH",
    "CSI_SET_EXTENSION_LENGTH",
    "STOCK",
    "TOOL PATH",
    "END-OF-PATH",
    "PAINT",
    "CONTACT",
    "CLEARP",
    "CLRSRF",
];

/// What a record asks for.
pub(super) fn record_asks(block: &Block<'_>) -> Found {
    let mut found = Found::default();
    let Some(record) = block.record() else { return found };
    let major = block.program().text(record.major).to_ascii_uppercase();
    let (range, text) = (record.range, plain(&block.program().text(record.range)));
    match major.as_str() {
        "SPINDL" => spindle(&record, &text, &mut found),
        "COOLNT" => found.asks.push((range, coolant(&record, &text))),
        "STOP" | "OPSTOP" => found.asks.push((
            range,
            Ask::Stop {
                optional: major == "OPSTOP",
            },
        )),
        "AUXFUN" => match number(&record) {
            Some(number) => auxiliary(number, range, text, &mut found),
            None => found.own(range, major, text, Why::Machine),
        },
        "CYCLE" if ["OFF", "ON", "INIT"].iter().any(|word| has(&record, word)) => {}
        // the run gives the motions of these, or says why it cannot
        "CYCLE"
            if ["DRILL", "FACE", "CSINK", "DEEP", "DEEP2", "BRKCHP", "BRKCHP2", "REAM"]
                .iter()
                .any(|word| has(&record, word)) => {}
        "CYCLE" if has(&record, "TAP") => found.own(range, major, text, Why::Synchronised),
        "CYCLE" => found.own(range, major, text, Why::Motion),
        // declared a remark by the user, or refused by the run
        "INSERT" => found.own(range, major, text, Why::Machine),
        held if HELD.contains(&held) => {}
        idle if IDLE.contains(&idle) => found.asks.push((range, Ask::Idle(idle.to_owned()))),
        "OPSKIP" => found.own(range, major, text, Why::Switch),
        "MAXRPM" => found.own(range, major, text, Why::SpindleLimit),
        "COUPLE" | "PITCH" | "THREAD" | "TURN" => found.own(range, major, text, Why::Synchronised),
        _ => found.own(range, major, text, Why::Machine),
    }
    found
}

/// AUXFUN: the M code of that number, those below 31 as ISO 6983-1 has them. Motions hold whether and how the spindle turns.
fn auxiliary(number: u32, range: TextRange, text: String, found: &mut Found) {
    let ask = match number {
        0 | 1 => Ask::Stop { optional: number == 1 },
        2 | 30 => Ask::Idle(text),
        3 | 4 => {
            found.counter_clockwise = Some(number == 4);
            return;
        }
        5 => return,
        7 => Ask::Coolant(Coolant::Mist),
        8 => Ask::Coolant(Coolant::Flood),
        9 => Ask::Coolant(Coolant::Off),
        _ => Ask::Auxiliary(number),
    };
    found.asks.push((range, ask));
}

fn spindle(record: &Record<'_>, text: &str, found: &mut Found) {
    if has(record, "CCLW") {
        found.counter_clockwise = Some(true);
    } else if has(record, "CLW") {
        found.counter_clockwise = Some(false);
    }
    for arg in record.args() {
        let AptArg::Word(range) = arg else { continue };
        let word = record.program.text(range).to_ascii_uppercase();
        let why = match word.as_str() {
            "RPM" | "CLW" | "CCLW" | "ON" | "OFF" => continue,
            "ORIENT" => Why::Oriented,
            "SFM" | "SMM" => Why::SurfaceSpeed,
            "MAXRPM" => Why::SpindleLimit,
            _ => Why::Machine,
        };
        found.own(record.range, "SPINDL", text, why);
        return;
    }
}

fn coolant(record: &Record<'_>, text: &str) -> Ask {
    let kinds = [
        ("OFF", Coolant::Off),
        ("MIST", Coolant::Mist),
        ("THRU", Coolant::Thru),
        ("AIR", Coolant::Air),
        ("FLOOD", Coolant::Flood),
        ("ON", Coolant::Flood),
    ];
    match kinds.iter().find(|(word, _)| has(record, word)) {
        Some((_, coolant)) => Ask::Coolant(*coolant),
        None => Ask::Own(super::Own {
            name: "COOLNT".to_owned(),
            text: text.to_owned(),
            why: Why::Machine,
        }),
    }
}

fn number(record: &Record<'_>) -> Option<u32> {
    let integer = record.args().find_map(|arg| match arg {
        AptArg::Number(number, _) => number.to_integer(),
        _ => None,
    })?;
    u32::try_from(integer).ok()
}

fn has(record: &Record<'_>, word: &str) -> bool {
    record.args().any(|arg| match arg {
        AptArg::Word(range) => record.program.text(range).eq_ignore_ascii_case(word),
        _ => false,
    })
}
