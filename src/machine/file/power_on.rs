//! `[control] power_on`: G codes in effect at power-on.
use crate::file::raw::Word;
use crate::file::validate::Fault;
use trunnion_dialect::Dialect;

/// G codes in effect at power-on, which the control must know; `dialect`: that of its family.
pub(super) fn power_on(words: &[Word], dialect: Option<&Dialect>) -> Result<Vec<String>, Fault> {
    for word in words {
        if !is_g_code(word.get_ref()) {
            let message = format!(
                "{:?} is not a G code: write G and its number, for example \"G17\"",
                word.get_ref()
            );
            return Err(Fault {
                message,
                span: word.span(),
            });
        }
        trunnion_dialect::known_at_power_on(word.get_ref(), dialect).map_err(|message| Fault {
            message,
            span: word.span(),
        })?;
    }
    Ok(words.iter().map(|word| word.get_ref().clone()).collect())
}

/// `G17`, `G5.1`.
fn is_g_code(code: &str) -> bool {
    code.strip_prefix('G').is_some_and(|number| {
        number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.') && number.parse::<f64>().is_ok()
    })
}
