//! The name of a work offset, small enough to be copied with each motion.

/// Most bytes of a name that are kept: `G54.1 P300` has 10.
const MOST: usize = 15;

/// `G54`; empty where no work offset was selected.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
pub(crate) struct OffsetName {
    bytes: [u8; MOST],
    length: u8,
}

impl OffsetName {
    /// Of a name; what is longer than a name of any control is cut.
    pub(crate) fn new(name: &str) -> Self {
        let mut end = name.len().min(MOST);
        while !name.is_char_boundary(end) {
            end -= 1;
        }
        let mut bytes = [0; MOST];
        bytes[..end].copy_from_slice(&name.as_bytes()[..end]);
        Self {
            bytes,
            length: end as u8,
        }
    }

    /// The name.
    pub(crate) fn as_str(&self) -> &str {
        core::str::from_utf8(&self.bytes[..usize::from(self.length)]).unwrap_or_default()
    }
}

impl core::fmt::Debug for OffsetName {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.as_str())
    }
}
