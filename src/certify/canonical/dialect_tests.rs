//! What counts of a dialect, in tables.
use crate::digest::dialect_digest;
use std::collections::BTreeSet;
use trunnion_dialect::Dialect;

/// Own tables that differ from the first in one letter, name, code, alarm or quirk.
#[test]
fn letters_names_and_codes_of_a_dialect_count() {
    let table = |more: &str| {
        let text = format!("name = \"mine\"\nextends = \"sinumerik-840d\"\n{more}");
        Dialect::from_table(&text, "mine.toml").expect("a table")
    };
    let tables = [
        "",
        "[roles]\nE = \"parameter\"\n",
        "[roles]\nE = \"feed\"\n",
        "[addresses]\nQQ = \"parameter\"\n",
        "[addresses]\nQQ = \"arc-radius\"\n",
        "[codes]\nG999 = { action = \"no-motion\", doc = \"Nothing\" }\n",
        "[codes]\nG999 = { action = \"rapid\", doc = \"Nothing\" }\n",
        "[codes]\nG999 = { action = \"no-motion\", words = [\"P\"], doc = \"Nothing\" }\n",
        "[quirks]\ndollar-commands = true\n",
        "[quirks]\ntool-change-stops-spindle = true\n",
        "[quirks]\nprogram-stop-stops-spindle = true\n",
        "[quirks]\nlength-after-return = \"cancelled-by-g28\"\n",
        "[quirks]\nlength-after-return = \"cancelled\"\n",
        "[quirks]\nlength-after-return = \"undeclared\"\n",
        "[quirks]\nlength-change = \"moves\"\n",
        "[quirks]\nlength-change = \"undeclared\"\n",
        "[quirks]\nskips-leader = true\n",
        "builder-codes = [\"M700\"]\n",
        "[alarms]\nunused-word = { number = \"A1\" }\n",
        "[codes]\nG999 = { action = \"no-motion\", group = \"motion\", doc = \"Nothing\" }\n",
    ];
    let digests: BTreeSet<_> = tables.iter().map(|more| dialect_digest(&table(more))).collect();
    assert_eq!(digests.len(), tables.len());
}
