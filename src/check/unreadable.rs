//! Files that are not text.

/// How many bytes decide whether a file is UTF-16.
const LOOKED_AT: usize = 1024;

/// Whether a file is UTF-16: by its byte order mark, or because at its beginning each second byte is NUL and no other is.
pub(crate) fn is_utf16(source: &[u8]) -> bool {
    if source.starts_with(&[0xFF, 0xFE]) || source.starts_with(&[0xFE, 0xFF]) {
        return true;
    }
    let pairs = &source.as_chunks::<2>().0[..source.len().min(LOOKED_AT) / 2];
    let nul_is = |low: usize| pairs.iter().all(|pair| pair[low] != 0 && pair[1 - low] == 0);
    pairs.len() > 1 && (nul_is(0) || nul_is(1))
}
