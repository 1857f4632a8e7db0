//! Digests of the inputs: SHA-256 over the canonical encoding of the facts that a proof depends on.
use crate::canonical::{CanonicalV1, Encode};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_machine::Machine;

/// The digested bytes begin with the schema and the kind, so that a digest of one kind never equals one of another kind or version.
const DIALECT: &[u8] = b"trunnion-certificate/2 dialect\0";
const MACHINE: &[u8] = b"trunnion-certificate/2 machine\0";
const SETUP: &[u8] = b"trunnion-certificate/2 setup\0";
const SEAL: &[u8] = b"trunnion-certificate/2 seal\0";

/// SHA-256 of a file's bytes, in lower case hexadecimal, as `sha256sum` prints it.
pub(crate) fn hex_sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Digest of what a dialect says: notation, letters, codes and quirks; not its prose.
pub(crate) fn dialect_digest(dialect: &Dialect) -> String {
    canonical(DIALECT, dialect)
}

/// Whether two machines are the same in all that a proof depends on.
pub fn same_machine(one: &Machine, other: &Machine) -> bool {
    machine_digest(one) == machine_digest(other)
}

/// Digest of a machine: chain, limits, speeds, control and thresholds; not its prose.
pub(crate) fn machine_digest(machine: &Machine) -> String {
    canonical(MACHINE, machine)
}

/// Digest of tools, work offsets, depth of calls, parameters of the control and variables; called programs are noted one by one. The bounds of
/// a run are not part of it.
pub(crate) fn setup_digest(setup: &Setup) -> String {
    canonical(SETUP, setup)
}

/// Digest of a certificate without its seal.
pub(crate) fn seal_digest(certificate: &crate::Certificate) -> String {
    canonical(SEAL, certificate)
}

/// Domain, then the canonical bytes.
fn canonical(domain: &[u8], value: &impl Encode) -> String {
    let digest = Sha256::new()
        .chain_update(domain)
        .chain_update(CanonicalV1::bytes_of(value));
    hex(&digest.finalize())
}

/// Lower case hexadecimal.
fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(64), |mut hex, byte| {
        // writing to a String cannot fail
        let _ = write!(hex, "{byte:02x}");
        hex
    })
}

#[cfg(test)]
mod tests {
    use super::hex_sha256;

    #[test]
    fn the_digest_of_nothing_is_the_published_one() {
        // FIPS 180-4, SHA-256 of the empty message
        assert_eq!(
            hex_sha256(b""),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"
        );
    }
}
