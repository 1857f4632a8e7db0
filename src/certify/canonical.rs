//! The canonical encoding, version 1: one sequence of bytes for one value, whatever Rust calls its parts.
//!
//! Digests and seals of certificates are SHA-256 over these bytes, so they are a format, not an implementation detail:
//!
//! * A value is a marker (1 byte), the length of its content in bytes (8 bytes, big-endian), and its content.
//!
//!   | Marker | Value | Content |
//!   |---|---|---|
//!   | 0 | nothing, only in lists | none |
//!   | 1 | flag | 1 byte, 0 or 1 |
//!   | 2 | whole number, not negative | 8 bytes, big-endian |
//!   | 3 | number | IEEE 754 double, 8 bytes, big-endian; -0 is written as 0, every NaN as `7ff8000000000000` |
//!   | 4 | text | UTF-8, as it is, without normalisation |
//!   | 5 | list | how many (8 bytes, big-endian), then the values in order |
//!   | 6 | record | its fields, each a tag (2 bytes, big-endian, not 0) and a value; tags ascend. Pairs and triples have tags 1, 2, 3 |
//!   | 7 | variant | its tag (2 bytes, big-endian, not 0), then fields as in a record |
//!
//! * Tags are written by hand in this folder. They never follow from the order of a declaration and never from a name, so renaming or moving
//!   a field or a variant changes no byte. A tag is never used for a second meaning.
//! * A field without a value (`None`) is left out. A fact that is added later gets a new tag and is left out where it has the value with
//!   which all older versions ran: then old digests stay. Any other change of these bytes needs a new version of the certificate.
//! * -0 and 0 are one number here. No verdict depends on that: a re-check computes everything again from the inputs that it is given.

/// How the fields of a struct are encoded: each with its tag, and those that do not matter. All must be named.
macro_rules! record {
    ($struct:ty { $($field:ident = $tag:literal),+ $(,)? } $(without { $($left_out:ident),+ $(,)? })?) => {
        impl $crate::canonical::Encode for $struct {
            fn encode(&self, out: &mut $crate::canonical::CanonicalV1) {
                // no `..`: a new field does not compile until somebody decides whether it matters
                let Self { $($field,)+ $($($left_out: _,)+)? } = self;
                out.record(|fields| {
                    $(fields.field($tag, $field);)+
                });
            }
        }
    };
}

mod certificate;
mod dialect;
mod machine;
mod setup;
mod tags;

#[cfg(test)]
mod declared_tests;
#[cfg(test)]
mod dialect_tests;
#[cfg(test)]
mod golden_tests;
#[cfg(test)]
mod obstacle_tests;
#[cfg(test)]
mod tests;

use trunnion_geometry::Vec3;

/// Bits of the one NaN that is written.
const NAN: u64 = 0x7ff8_0000_0000_0000;

const NOTHING: u8 = 0;
const FLAG: u8 = 1;
const WHOLE: u8 = 2;
const NUMBER: u8 = 3;
const TEXT: u8 = 4;
const LIST: u8 = 5;
const RECORD: u8 = 6;
const VARIANT: u8 = 7;

/// Something with a canonical encoding.
pub(crate) trait Encode {
    /// Writes exactly one value.
    fn encode(&self, out: &mut CanonicalV1);
    /// Whether there is no value, so that its field is left out.
    fn is_nothing(&self) -> bool {
        false
    }
}

/// The bytes written so far.
#[derive(Default)]
pub(crate) struct CanonicalV1 {
    bytes: Vec<u8>,
    /// A number that is infinite or NaN is among them.
    not_finite: bool,
}

impl CanonicalV1 {
    /// The bytes of one value.
    pub(crate) fn bytes_of<T: Encode + ?Sized>(value: &T) -> Vec<u8> {
        let mut out = Self::default();
        value.encode(&mut out);
        out.bytes
    }

    /// Whether all numbers of a value are finite.
    pub(crate) fn is_finite<T: Encode + ?Sized>(value: &T) -> bool {
        let mut out = Self::default();
        value.encode(&mut out);
        !out.not_finite
    }

    /// A record with the fields that `fill` writes.
    pub(crate) fn record(&mut self, fill: impl FnOnce(&mut Fields<'_>)) {
        self.value(RECORD, |out| fill(&mut Fields { out, last: 0 }));
    }

    /// A variant of an enum, with the fields that `fill` writes.
    pub(crate) fn variant(&mut self, tag: u16, fill: impl FnOnce(&mut Fields<'_>)) {
        assert!(tag != 0, "tags begin with 1");
        self.value(VARIANT, |out| {
            out.bytes.extend(tag.to_be_bytes());
            fill(&mut Fields { out, last: 0 });
        });
    }

    /// Marker, length and content.
    fn value(&mut self, marker: u8, content: impl FnOnce(&mut Self)) {
        self.bytes.push(marker);
        let at = self.bytes.len();
        self.bytes.extend([0; 8]);
        content(self);
        let length = (self.bytes.len() - at - 8) as u64;
        self.bytes[at..at + 8].copy_from_slice(&length.to_be_bytes());
    }
}

/// The fields of a record or variant that is being written.
pub(crate) struct Fields<'a> {
    out: &'a mut CanonicalV1,
    /// The tag written last; 0 before the first.
    last: u16,
}

impl Fields<'_> {
    /// A field; it is left out where it has no value.
    ///
    /// # Panics
    /// If the tag is not larger than the one before: that is a mistake in the implementation, and would make two encodings of one value.
    pub(crate) fn field<T: Encode + ?Sized>(&mut self, tag: u16, value: &T) -> &mut Self {
        assert!(self.last < tag, "tag {tag} after {}", self.last);
        self.last = tag;
        if !value.is_nothing() {
            self.out.bytes.extend(tag.to_be_bytes());
            value.encode(self.out);
        }
        self
    }
}

impl Encode for bool {
    fn encode(&self, out: &mut CanonicalV1) {
        out.value(FLAG, |out| out.bytes.push(u8::from(*self)));
    }
}

macro_rules! whole_numbers {
    ($($type:ty)+) => {
        $(impl Encode for $type {
            fn encode(&self, out: &mut CanonicalV1) {
                u64::from(*self).encode(out);
            }
        })+
    };
}

whole_numbers!(u8 u16 u32);

impl Encode for u64 {
    fn encode(&self, out: &mut CanonicalV1) {
        out.value(WHOLE, |out| out.bytes.extend(self.to_be_bytes()));
    }
}

impl Encode for usize {
    fn encode(&self, out: &mut CanonicalV1) {
        (*self as u64).encode(out);
    }
}

impl Encode for f64 {
    fn encode(&self, out: &mut CanonicalV1) {
        out.not_finite |= !self.is_finite();
        let bits = match *self {
            value if value.is_nan() => NAN,
            // -0 too
            0.0 => 0,
            value => value.to_bits(),
        };
        out.value(NUMBER, |out| out.bytes.extend(bits.to_be_bytes()));
    }
}

impl Encode for str {
    fn encode(&self, out: &mut CanonicalV1) {
        out.value(TEXT, |out| out.bytes.extend(self.as_bytes()));
    }
}

impl Encode for String {
    fn encode(&self, out: &mut CanonicalV1) {
        self.as_str().encode(out);
    }
}

impl<T: Encode> Encode for [T] {
    fn encode(&self, out: &mut CanonicalV1) {
        out.value(LIST, |out| {
            out.bytes.extend((self.len() as u64).to_be_bytes());
            for item in self {
                item.encode(out);
            }
        });
    }
}

impl<T: Encode> Encode for Vec<T> {
    fn encode(&self, out: &mut CanonicalV1) {
        self.as_slice().encode(out);
    }
}

impl<T: Encode, const N: usize> Encode for [T; N] {
    fn encode(&self, out: &mut CanonicalV1) {
        self.as_slice().encode(out);
    }
}

impl<T: Encode + ?Sized> Encode for &T {
    fn encode(&self, out: &mut CanonicalV1) {
        (*self).encode(out);
    }
    fn is_nothing(&self) -> bool {
        (*self).is_nothing()
    }
}

impl<T: Encode> Encode for Option<T> {
    fn encode(&self, out: &mut CanonicalV1) {
        match self {
            Some(value) => value.encode(out),
            None => out.value(NOTHING, |_| {}),
        }
    }
    fn is_nothing(&self) -> bool {
        self.is_none()
    }
}

impl<A: Encode, B: Encode> Encode for (A, B) {
    fn encode(&self, out: &mut CanonicalV1) {
        out.record(|fields| {
            fields.field(1, &self.0).field(2, &self.1);
        });
    }
}

impl<A: Encode, B: Encode, C: Encode> Encode for (A, B, C) {
    fn encode(&self, out: &mut CanonicalV1) {
        out.record(|fields| {
            fields.field(1, &self.0).field(2, &self.1).field(3, &self.2);
        });
    }
}

/// X, Y, Z.
impl Encode for Vec3 {
    fn encode(&self, out: &mut CanonicalV1) {
        [self.x, self.y, self.z].encode(out);
    }
}
