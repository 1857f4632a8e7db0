//! Laying out in tests.
use trunnion_dialect::{Dialect, builtin};
use trunnion_interp::Setup;
use trunnion_layout::{Layout, Style, layout};
use trunnion_syntax::{Program, parse};

pub(crate) fn dialect(name: &str) -> &'static Dialect {
    builtin(name).unwrap_or_else(|| panic!("no dialect {name}"))
}

pub(crate) fn program(text: &[u8], dialect: &Dialect) -> Program {
    parse(text.to_vec(), dialect.lex)
}

/// The text laid out; as it is where there is nothing to do.
pub(crate) fn laid_with(text: &[u8], name: &str, style: &Style) -> Vec<u8> {
    let dialect = dialect(name);
    match layout(&program(text, dialect), dialect, &Setup::default(), style) {
        Layout::Unchanged => text.to_vec(),
        Layout::Changed(text) => text,
        Layout::Refused(why) => panic!("{why:?} in {:?}", String::from_utf8_lossy(text)),
    }
}

pub(crate) fn laid(text: &str, name: &str) -> String {
    String::from_utf8(laid_with(text.as_bytes(), name, &Style::default())).expect("UTF-8 stays UTF-8")
}
