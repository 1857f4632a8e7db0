//! The certificate of a conversion: which motions belong together, under which terms, and what was found. Both texts are read again to make it and to
//! check it; the converter is not asked.
use super::{
    Ask, Assume, ConversionClaim, ConversionProof, Coolant, Part, Reading, Run, Terms, converted_on,
    holds_with_zeros_apart, read,
};
use crate::certificate::other_text;
use crate::digest::{dialect_digest, hex_sha256, machine_digest, setup_digest};
use crate::library::Recorder;
use crate::{NamedDigest, Outcome, TextDigest};
use core::fmt::Write;
use serde::{Deserialize, Serialize};
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_machine::Machine;

/// Schema of the certificate of a conversion.
pub const CONVERSION_SCHEMA: &str = "trunnion-conversion/1";

/// The certificate of a conversion (JSON). Every number in it is computed again when it is checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConversionCertificate {
    /// [`CONVERSION_SCHEMA`].
    pub schema: String,
    /// Version of the program that proved it.
    pub tool_version: String,
    /// The program before.
    pub before: Side,
    /// The program after.
    pub after: Side,
    /// Digest of tools, work offsets, bounds, parameters and variables of both runs, without what the target machine tells about its control.
    pub setup_sha256: String,
    /// The program after is read on its machine: its words are positions of the axes, or turn them. Else its words alone say where the tool is.
    pub read_on_machine: bool,
    /// Before the first block tool centre point control is on: the program is an excerpt.
    pub assumes_tcp: bool,
    /// Before the first block this feed is in effect, mm/min.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub assumes_feed_mm_min: Option<f64>,
    /// Codes that the user left out: the claim is not about them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dropped: Vec<String>,
    /// What codes of the builder of the target machine mean, as its post declares.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub own_codes: Vec<OwnCode>,
    /// Which motions belong together, in order.
    pub parts: Vec<Parts>,
    /// The claim.
    pub claim: ConversionClaim,
    /// What was found.
    pub proof: ConversionProof,
    /// SHA-256 of all above, as compact JSON.
    pub seal_sha256: String,
}

/// One of the two programs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Side {
    /// Its text.
    pub text: TextDigest,
    /// Its dialect.
    pub dialect: NamedDigest,
    /// Its machine. CL data have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine: Option<NamedDigest>,
    /// Programs that it called, by name, with the digest of their text, or `missing`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub library: Vec<NamedDigest>,
}

/// A code of the builder of a machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnCode {
    /// Its text: `M51`.
    pub code: String,
    /// What it asks for; none: it belongs to the header or footer of every program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub asks: Option<Meaning>,
}

/// What a code of the builder of a machine asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Meaning {
    /// Flood coolant.
    CoolantFlood,
    /// Mist.
    CoolantMist,
    /// Through the tool.
    CoolantThru,
    /// No longer through the tool.
    CoolantThruOff,
    /// Air.
    CoolantAir,
    /// All coolant off.
    CoolantOff,
    /// The program waits for the operator.
    Stop,
    /// The same where the switch is set.
    OptionalStop,
}

const MEANINGS: [(Meaning, Ask); 8] = [
    (Meaning::CoolantFlood, Ask::Coolant(Coolant::Flood)),
    (Meaning::CoolantMist, Ask::Coolant(Coolant::Mist)),
    (Meaning::CoolantThru, Ask::Coolant(Coolant::Thru)),
    (Meaning::CoolantThruOff, Ask::Coolant(Coolant::ThruOff)),
    (Meaning::CoolantAir, Ask::Coolant(Coolant::Air)),
    (Meaning::CoolantOff, Ask::Coolant(Coolant::Off)),
    (Meaning::Stop, Ask::Stop { optional: false }),
    (Meaning::OptionalStop, Ask::Stop { optional: true }),
];

/// The same part several times, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parts {
    /// How often.
    pub times: u32,
    /// What.
    pub part: Part,
}

/// What a conversion is certified with.
#[derive(Clone, Copy)]
pub struct Conversion<'a> {
    /// Text before and after.
    pub texts: [&'a [u8]; 2],
    /// Their dialects.
    pub dialects: [&'a Dialect; 2],
    /// The machines that they are for.
    pub machines: [Option<&'a Machine>; 2],
    /// Tools, offsets, bounds of the program before.
    pub setup: &'a Setup,
}

/// What the converter says about a conversion: nothing of it is believed, but that the user wants it so.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Told {
    /// The program after is read on its machine.
    pub read_on_machine: bool,
    /// The state at the start of the program before.
    pub assume: Assume,
    /// Codes that the user leaves out.
    pub dropped: Vec<String>,
    /// What own codes of the target mean.
    pub own_codes: Vec<(String, Option<Ask>)>,
    /// Which motions belong together.
    pub parts: Vec<Part>,
}

/// Nothing of a program is left unread.
fn read_whole(reading: &Reading, which: &str) -> Result<(), Outcome> {
    if reading.given_up.is_some() {
        let why = format!("the {which} program has more motions than are held (`held` of [limits] in trunnion.toml)");
        return Err(Outcome::unknown(why));
    }
    if !reading.program.errors().is_empty() {
        let why = format!("the text of the {which} program is not understood");
        return Err(Outcome::unknown(why));
    }
    Ok(())
}

/// Reads both texts and proves the claim.
///
/// # Errors
/// Refuted with a witness, or unknown with the reason.
pub fn certify_conversion(
    conversion: &Conversion<'_>,
    told: &Told,
    claim: &ConversionClaim,
) -> Result<ConversionCertificate, Outcome> {
    let own_codes = told.own_codes.iter().map(own_code).collect::<Result<Vec<_>, _>>()?;
    let (before_setup, before_library) = Recorder::wrap(conversion.setup);
    let mut setup = conversion.setup.clone();
    Machine::tell(conversion.machines[1], &mut setup.control);
    let (after_setup, after_library) = Recorder::wrap(&setup);
    let [before_machine, after_machine] = conversion.machines;
    let after_machine = after_machine.filter(|_| told.read_on_machine);
    let before_run = Run {
        text: conversion.texts[0],
        dialect: conversion.dialects[0],
        machine: before_machine,
        setup: &before_setup,
        assume: told.assume,
    };
    let after_run = Run {
        text: conversion.texts[1],
        dialect: conversion.dialects[1],
        machine: after_machine,
        setup: &after_setup,
        assume: Assume::default(),
    };
    let (before, after) = (read(&before_run), read(&after_run));
    read_whole(&before, "original")?;
    read_whole(&after, "converted")?;
    let terms = Terms {
        dropped: &told.dropped,
        meanings: &told.own_codes,
    };
    let before_machine = before_machine.filter(|_| conversion.dialects[0].lex.format != trunnion_syntax::Format::Apt);
    let proof = converted_on(
        (&before, before_machine),
        (&after, after_machine),
        &told.parts,
        claim,
        &terms,
    )?;
    holds_with_zeros_apart(
        [(&before, &before_run), (&after, &after_run)],
        &told.parts,
        claim,
        &terms,
    )?;
    let side = |index: usize, machine: Option<&Machine>, library: Option<std::sync::Arc<Recorder>>| Side {
        text: TextDigest::of(conversion.texts[index]),
        dialect: NamedDigest {
            name: conversion.dialects[index].name.clone(),
            sha256: dialect_digest(conversion.dialects[index]),
        },
        machine: machine.map(|machine| NamedDigest {
            name: machine.id.clone(),
            sha256: machine_digest(machine),
        }),
        library: library.map_or_else(Vec::new, |library| library.loaded()),
    };
    let mut certificate = ConversionCertificate {
        schema: CONVERSION_SCHEMA.into(),
        tool_version: env!("CARGO_PKG_VERSION").into(),
        before: side(0, conversion.machines[0], before_library),
        after: side(1, conversion.machines[1], after_library),
        setup_sha256: setup_digest(conversion.setup),
        read_on_machine: told.read_on_machine,
        assumes_tcp: told.assume.tcp,
        assumes_feed_mm_min: told.assume.feed_mm_min,
        dropped: told.dropped.clone(),
        own_codes,
        parts: in_runs(&told.parts),
        claim: *claim,
        proof,
        seal_sha256: String::new(),
    };
    certificate.seal_sha256 = certificate.seal();
    Ok(certificate)
}

impl ConversionCertificate {
    /// As JSON, indented, with a line end.
    pub fn to_json(&self) -> String {
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }

    /// Whether a JSON text says that it is the certificate of a conversion.
    pub fn is_one(json: &str) -> bool {
        #[derive(Deserialize)]
        struct Header {
            schema: String,
        }
        serde_json::from_str::<Header>(json).is_ok_and(|header| header.schema == CONVERSION_SCHEMA)
    }

    /// Reads JSON. `Err` says what is wrong and where.
    pub fn from_json(json: &str) -> Result<Self, String> {
        serde_json::from_str(json).map_err(|error| format!("not the certificate of a conversion: {error}"))
    }

    fn seal(&self) -> String {
        let unsealed = Self {
            seal_sha256: String::new(),
            ..self.clone()
        };
        hex_sha256(&serde_json::to_vec(&unsealed).unwrap_or_default())
    }

    /// Proves it again. The machines, dialects and settings are those of the one who asks; they must be those of the certificate.
    ///
    /// # Errors
    /// Refuted: the certificate is not about these inputs, was changed, or does not hold; or unknown.
    pub fn recheck(&self, conversion: &Conversion<'_>) -> Result<Self, Outcome> {
        let refuse = |what: String| Err(Outcome::refuted(what));
        if self.schema != CONVERSION_SCHEMA || self.seal() != self.seal_sha256 {
            return refuse("seal_sha256: the certificate was changed after it was made".to_owned());
        }
        if let Some(why) = other_text([&self.before.text, &self.after.text], conversion.texts) {
            return refuse(why);
        }
        let motions = self.proof.motions_before.saturating_add(self.proof.motions_after);
        let parts = self.parts.iter().map(|part| u64::from(part.times)).sum::<u64>();
        let most = conversion.setup.limits.held.saturating_mul(2);
        if parts > motions || parts > most {
            return refuse(format!("it pairs {parts} parts, more than both programs have motions"));
        }
        let told = Told {
            read_on_machine: self.read_on_machine,
            assume: Assume {
                tcp: self.assumes_tcp,
                feed_mm_min: self.assumes_feed_mm_min,
            },
            dropped: self.dropped.clone(),
            own_codes: self.own_codes.iter().map(OwnCode::told).collect(),
            parts: self
                .parts
                .iter()
                .flat_map(|part| core::iter::repeat_n(part.part, part.times as usize))
                .collect(),
        };
        let fresh = Self {
            tool_version: self.tool_version.clone(),
            ..certify_conversion(conversion, &told, &self.claim)?
        };
        let fresh = Self {
            seal_sha256: fresh.seal(),
            ..fresh
        };
        let as_value = |certificate: &Self| serde_json::to_value(certificate).unwrap_or_default();
        match crate::difference::differ(&as_value(self), &as_value(&fresh), "") {
            Some(what) => refuse(what),
            None if fresh == *self => Ok(fresh),
            None => refuse("the certificate differs from the proof".to_owned()),
        }
    }

    /// One line for people.
    pub fn summary(&self) -> String {
        let (proof, claim) = (&self.proof, &self.claim);
        let mut text = format!(
            "the same motions in {} as in {}: {} motions of {}; ends within {:.6} mm and {:.6} deg ({} mm and {} deg are claimed), paths of cuts within {:.6} mm \
             ({} mm are claimed)",
            self.after.dialect.name,
            self.before.dialect.name,
            proof.motions_after,
            proof.motions_before,
            proof.end_mm,
            proof.end_deg,
            short(claim.end_mm),
            short(claim.end_deg),
            proof.path_mm,
            short(claim.path_mm)
        );
        let mut add = |what: &str, names: Vec<&str>| {
            if !names.is_empty() {
                let _ = write!(text, "; {what} {}", names.join(", "));
            }
        };
        add(
            "left out by the user:",
            self.dropped.iter().map(String::as_str).collect(),
        );
        add(
            "what these codes do is taken from the post:",
            self.own_codes.iter().map(|own| own.code.as_str()).collect(),
        );
        text
    }
}

/// A claimed bound for people: at most six decimals.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

impl OwnCode {
    fn told(&self) -> (String, Option<Ask>) {
        let ask = |wanted: Meaning| {
            let known = MEANINGS.into_iter().find(|(meaning, _)| *meaning == wanted);
            known.map(|(_, ask)| ask)
        };
        (self.code.clone(), self.asks.and_then(ask))
    }
}

fn own_code((code, ask): &(String, Option<Ask>)) -> Result<OwnCode, Outcome> {
    let code = code.clone();
    let Some(ask) = ask else {
        return Ok(OwnCode { code, asks: None });
    };
    let known = MEANINGS.into_iter().find(|(_, known)| known == ask);
    match known {
        Some((meaning, _)) => Ok(OwnCode {
            code,
            asks: Some(meaning),
        }),
        None => Err(Outcome::unknown(format!("a certificate cannot say what {code} means"))),
    }
}

fn in_runs(parts: &[Part]) -> Vec<Parts> {
    let same = parts.chunk_by(|a, b| a == b);
    same.map(|run| Parts {
        times: run.len() as u32,
        part: run[0],
    })
    .collect()
}
