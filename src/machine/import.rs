//! Machine files from files of other programs: what those contain becomes a machine file with its sources, what they do not contain is
//! listed and never guessed. An axis with something unknown gets the key `unknown`, and the file does not load until it is filled in.
mod draft;
mod freecad;
mod hal;
mod ini;
mod linuxcnc;
mod modules;

pub use freecad::import_freecad;
pub use linuxcnc::import_linuxcnc;

/// A machine file made from another file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Imported {
    /// The text of the machine file.
    pub toml: String,
    /// What the source does not contain or what was assumed, one sentence each.
    pub open: Vec<String>,
}

/// The beginning of a text of the file, as a message quotes it.
fn short(text: &str) -> String {
    const MOST: usize = 60;
    let mut short: String = text.chars().take(MOST).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod bounds_tests;
#[cfg(test)]
mod tests;
