//! Names of variables: short ones need no memory of their own and are compared as a few machine words.
use core::fmt;
use core::ops::Deref;

/// Bytes of a name that is stored inline; the last byte is its length.
const SHORT: usize = 23;

/// The name of a variable as formulas use it: without its signs, blanks removed, in lower case.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Name {
    short: [u8; SHORT + 1],
    /// A name that is longer, or has letters beyond ASCII.
    long: Option<Box<str>>,
}

impl Name {
    /// A name from its text.
    #[inline]
    pub fn new(text: &str) -> Self {
        let mut short = [0; SHORT + 1];
        if text.len() > SHORT || !text.is_ascii() {
            return Self {
                short,
                long: Some(text.into()),
            };
        }
        short[..text.len()].copy_from_slice(text.as_bytes());
        short[SHORT] = text.len() as u8;
        Self { short, long: None }
    }

    /// The digits of a number.
    pub fn number(number: u32) -> Self {
        let mut short = [0; SHORT + 1];
        let mut digits = [0; 10];
        let (mut rest, mut from) = (number, digits.len());
        while rest > 0 || from == digits.len() {
            from -= 1;
            digits[from] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        let length = digits.len() - from;
        short[..length].copy_from_slice(&digits[from..]);
        short[SHORT] = length as u8;
        Self { short, long: None }
    }

    /// The first bytes of `text` up to `end` as a name in lower case, where they are letters, digits and `_`, and not many; how many they are.
    #[inline]
    pub fn before(text: &[u8], end: u8) -> Option<(Self, usize)> {
        let mut short = [0; SHORT + 1];
        for (length, &byte) in text.iter().enumerate() {
            if byte == end {
                short[SHORT] = length as u8;
                return Some((Self { short, long: None }, length));
            }
            if length == SHORT || !(byte.is_ascii_alphanumeric() || byte == b'_') {
                return None;
            }
            short[length] = byte.to_ascii_lowercase();
        }
        None
    }

    /// Whether both are equal; most that are not differ in their first bytes.
    #[inline]
    pub fn is(&self, other: &Self) -> bool {
        let words = |name: &Self| {
            let [a, b, c] = [0, 8, 16].map(|at| {
                let bytes = name.short[at..at + 8].first_chunk::<8>();
                bytes.map_or(0, |bytes| u64::from_ne_bytes(*bytes))
            });
            (a, b, c)
        };
        let (one, two) = (words(self), words(other));
        one.0 == two.0 && one.1 == two.1 && one.2 == two.2 && self.long == other.long
    }

    /// Whether it begins with this ASCII sign.
    #[inline]
    pub fn begins_with(&self, sign: u8) -> bool {
        match &self.long {
            Some(long) => long.as_bytes().first() == Some(&sign),
            None => self.short[0] == sign,
        }
    }

    /// Its bytes.
    #[inline]
    pub fn as_bytes(&self) -> &[u8] {
        match &self.long {
            Some(long) => long.as_bytes(),
            None => &self.short[..usize::from(self.short[SHORT])],
        }
    }
}

impl Deref for Name {
    type Target = str;
    fn deref(&self) -> &str {
        match &self.long {
            Some(long) => long,
            // what is stored inline is ASCII
            None => core::str::from_utf8(self.as_bytes()).unwrap_or_default(),
        }
    }
}

impl From<&str> for Name {
    fn from(text: &str) -> Self {
        Self::new(text)
    }
}

impl fmt::Debug for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::Name;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_name_is_its_text(one in "[a-z_0-9\u{e4}\0]{0,30}", other in "[a-z_0-9\u{e4}\0]{0,3}", number: u32) {
            prop_assert_eq!(&*Name::new(&one), one.as_str());
            prop_assert_eq!(Name::new(&one) == Name::new(&other), one == other);
            prop_assert_eq!(Name::new(&one).is(&Name::new(&other)), one == other);
            prop_assert_eq!(Name::number(number), Name::new(&number.to_string()));
            prop_assert!(Name::new(&one).is(&Name::new(&one)));
            prop_assert_eq!(Name::new(&one).begins_with(b'_'), one.starts_with('_'));
            let cut = Name::before(format!("{one}>").as_bytes(), b'>');
            let plain = one.len() <= 23 && one.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
            prop_assert_eq!(cut.map(|(name, length)| (name.to_string(), length)), plain.then(|| (one.clone(), one.len())));
        }
    }
}
