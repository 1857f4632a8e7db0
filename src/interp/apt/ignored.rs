//! Records that are known and that nothing here reads.
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::{Format, Program, TextRange};

/// Records of one major word that are not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IgnoredRecords {
    /// The major word, in upper case.
    pub name: String,
    /// The first of them.
    pub first: TextRange,
    /// How many there are.
    pub count: u32,
}

/// Records without a motion that are read, that report themselves, or that are texts and names for people.
const READ: [&str; 18] = [
    "AUXFUN",
    "CUTTER",
    "TLDATA",
    "CSYS",
    "MSYS",
    "TRNTYP",
    "COOLNT",
    "INSERT",
    "PARTNO",
    "PPRINT",
    "REMARK",
    "TITLES",
    "DISPLY",
    "LETTER",
    "TOOL PATH",
    "END-OF-PATH",
    "MFGNO",
    "FEATNO",
];

/// The records of an APT / CL program that are recognised and not read, each major word once, in the order of their first.
pub fn ignored_records(program: &Program, dialect: &Dialect) -> Vec<IgnoredRecords> {
    let mut found: Vec<IgnoredRecords> = Vec::new();
    if program.options().format != Format::Apt {
        return found;
    }
    for record in program.blocks().filter_map(|block| block.record()) {
        let name = program.text(record.major).to_ascii_uppercase();
        if let Some(known) = found.iter_mut().find(|known| known.name == name) {
            known.count += 1;
            continue;
        }
        let ignored = dialect.name(&name).is_some_and(|code| code.action == Action::NoMotion);
        if ignored && !READ.contains(&name.as_str()) {
            found.push(IgnoredRecords {
                name,
                first: record.range,
                count: 1,
            });
        }
    }
    found
}
