//! Digests of the inputs: only facts that a proof depends on, written in one canonical form.
use sha2::{Digest, Sha256};
use std::fmt::Write;
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_machine::Machine;

/// SHA-256 in lower case hexadecimal.
pub(crate) fn hex_sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .fold(String::with_capacity(64), |mut hex, byte| {
            // writing to a String cannot fail
            let _ = write!(hex, "{byte:02x}");
            hex
        })
}

/// Digest of what a dialect says: notation, letters, codes and quirks; not its prose.
pub(crate) fn dialect_digest(dialect: &Dialect) -> String {
    let mut facts = format!(
        "{}\n{:?}\n{:?}\n{:?}\n",
        dialect.name, dialect.lex, dialect.arc_tolerance_mm, dialect.quirks
    );
    for letter in b'A'..=b'Z' {
        let _ = writeln!(facts, "{} {:?}", char::from(letter), dialect.role(letter));
    }
    for code in dialect.codes() {
        let _ = writeln!(facts, "{:?} {} {:?} {:?}", code.kind, code.id, code.group, code.action);
    }
    hex_sha256(facts.as_bytes())
}

/// Digest of a machine: chain, limits, speeds, control; not its thresholds and prose.
pub(crate) fn machine_digest(machine: &Machine) -> String {
    let mut facts = format!("{}\n{:?} {:?}\n", machine.id, machine.tool_axis, machine.gauge_point);
    let _ = writeln!(
        facts,
        "{} great circle {}",
        machine.control.family, machine.control.tcp_great_circle
    );
    // thresholds of rules decide nothing here, but the pole cone bounds windows, and all of it is the model of the control
    let _ = writeln!(facts, "{:?} {:?}", machine.control, machine.tolerances);
    for axis in &machine.axes {
        let _ = writeln!(facts, "{axis:?}");
        let _ = writeln!(
            facts,
            "{} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
            char::from(axis.letter),
            axis.kind,
            axis.side,
            axis.direction,
            axis.point,
            axis.sign,
            axis.limits,
            axis.max_speed,
            axis.max_acceleration
        );
    }
    hex_sha256(facts.as_bytes())
}

/// Digest of tools, work offsets, bounds and parameters of the control; called programs are noted one by one.
pub(crate) fn setup_digest(setup: &Setup) -> String {
    let facts = format!(
        "{:?}\n{:?}\n{:?}\n{:?}",
        setup.tools, setup.work_offsets, setup.limits, setup.control
    );
    hex_sha256(facts.as_bytes())
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
