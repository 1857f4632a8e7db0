//! `[control] power_on`: G codes in effect at power-on.
use crate::file::raw::Word;
use crate::file::validate::Fault;

/// The codes, which the control must know; `family`: its kind.
pub(super) fn power_on(words: Option<&[Word]>, family: &str) -> Result<Option<Vec<String>>, Fault> {
    let Some(words) = words else { return Ok(None) };
    let dialect = trunnion_dialect::builtin(family);
    let code = |word: &Word| {
        let message = if is_g_code(word.get_ref()) {
            trunnion_dialect::known_at_power_on(word.get_ref(), dialect).err()
        } else {
            Some(format!(
                "{:?} is not a G code: write G and its number, for example \"G17\"",
                word.get_ref()
            ))
        };
        match message {
            None => Ok(word.get_ref().clone()),
            Some(message) => Err(Fault {
                message,
                span: word.span(),
            }),
        }
    };
    words.iter().map(code).collect::<Result<_, _>>().map(Some)
}

/// `G17`, `G5.1`.
fn is_g_code(code: &str) -> bool {
    code.strip_prefix('G').is_some_and(|number| {
        number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') && number.parse::<f64>().is_ok()
    })
}
