//! What a proof records: digests of the inputs, the claim, and the numbers found.
use crate::Claim;
use crate::digest::{hex_sha256, seal_digest};
use core::fmt::Write;
use serde::{Deserialize, Serialize};

/// Version of the certificate: of its JSON and of the canonical encoding that its digests and its seal are made from.
pub const SCHEMA: &str = "trunnion-certificate/2";

/// The first version, whose digests were made from text that changed whenever a field was renamed.
const SCHEMA_1: &str = "trunnion-certificate/1";

/// A certificate (JSON). Every number in it is recomputed by `recheck`; one that differs is refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that proved it.
    pub tool_version: String,
    /// The text before.
    pub before: TextDigest,
    /// The text after.
    pub after: TextDigest,
    /// The dialect: name, and digest of what it says about letters and codes.
    pub dialect: NamedDigest,
    /// The dialect of the text after, where it is another one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after_dialect: Option<NamedDigest>,
    /// The machine: id, and digest of its chain, limits, speeds and control.
    pub machine: NamedDigest,
    /// Digest of tools, work offsets and bounds the programs were run with, declarations outside the texts.
    pub setup_sha256: String,
    /// Programs that were called, by name, with the digest of their text, or `missing`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub library: Vec<NamedDigest>,
    /// The claim.
    pub claim: Claim,
    /// How the texts differ.
    pub text: TextChange,
    /// How many motions.
    pub motions: MotionCounts,
    /// The worst of every number of `changes`.
    pub worst: WorstChanges,
    /// What the rotary axes do, before and after, workpiece side first.
    pub rotary: Vec<RotaryChange>,
    /// What the postures cost, where the claim is that no others cost less.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub postures: Option<PostureCosts>,
    /// The runs of rapid motions that differ, where the claim is that they are clear of obstacles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rapids: Option<RapidChanges>,
    /// Each motion that differs.
    pub changes: Vec<MotionChange>,
    /// SHA-256 of the canonical encoding of all fields above, so that an altered claim is noticed too.
    pub seal_sha256: String,
}

/// A text's digest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextDigest {
    /// Lower case hexadecimal.
    pub sha256: String,
    /// Length in bytes.
    pub bytes: u64,
}

impl TextDigest {
    /// That of a text.
    pub(crate) fn of(text: &[u8]) -> Self {
        Self {
            sha256: hex_sha256(text),
            bytes: text.len() as u64,
        }
    }
}

/// What is wrong where a certificate was made for other programs than these, and what to do.
pub(crate) fn other_text([before, after]: [&TextDigest; 2], texts: [&[u8]; 2]) -> Option<String> {
    if *before != TextDigest::of(texts[0]) {
        return Some(
            "the certificate was made for another original program: the SHA-256 values differ; name the program that it was made for, \
             or make a new certificate"
                .to_owned(),
        );
    }
    (*after != TextDigest::of(texts[1])).then(|| {
        "the certificate was made for another changed program: the SHA-256 values differ; the program was edited since, or the command that \
         writes both was stopped between them: run that command again, it writes both"
            .to_owned()
    })
}

/// A name and the digest of its contents.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedDigest {
    /// The name.
    pub name: String,
    /// Lower case hexadecimal.
    pub sha256: String,
}

/// How two texts differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextChange {
    /// Numbers of coordinate words that differ.
    pub numbers_changed: u64,
    /// Coordinate words that are new.
    pub words_inserted: u64,
    /// Bytes that were replaced in the text before.
    pub bytes_changed: u64,
    /// Whether all else is the same byte for byte; if not, the three counts are 0.
    pub rest_identical: bool,
}

/// How many motions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionCounts {
    /// In each of the programs.
    pub total: u64,
    /// That differ.
    pub changed: u64,
    /// Whose position is unknown in both, but which are programmed alike from a like state.
    pub unknown: u64,
    /// With another feed or spindle speed (0 in a rewrite).
    pub process_changed: u64,
}

/// A worst value and where it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worst {
    /// The value.
    pub value: f64,
    /// Index of the motion, from 0; of the first one if all are 0.
    pub motion: u64,
    /// Line in the program after, from 1; 0 when there is no motion.
    pub line: u32,
}

/// The worst changes over all motions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorstChanges {
    /// Shift of the claimed point (ball's centre or tip) at block ends, mm.
    pub point_shift_mm: Worst,
    /// Shift of the tip at block ends, mm.
    pub tip_shift_mm: Worst,
    /// Turn of the tool axis about the part at block ends, deg.
    pub axis_change_deg: Worst,
    /// Proven bound on how far the claimed point's paths lie apart at any moment, mm.
    pub path_bound_mm: Worst,
    /// Proven bound on the angle between the tool axes at any moment, deg.
    pub path_axis_bound_deg: Worst,
    /// Forward kinematics of the joints against the programmed tip, both programs, mm.
    pub forward_residual_mm: Worst,
    /// Forward kinematics of the joints against the programmed tool axis, both programs, deg.
    pub forward_residual_deg: Worst,
}

/// What one rotary axis does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotaryChange {
    /// Letter.
    pub axis: String,
    /// Largest step of one motion before, deg.
    pub step_before_deg: f64,
    /// Largest step of one motion after, deg.
    pub step_after_deg: f64,
    /// Sum of all steps before, deg.
    pub travel_before_deg: f64,
    /// Sum of all steps after, deg.
    pub travel_after_deg: f64,
}

/// What the sequence of postures costs, in the unit of the claim's cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PostureCosts {
    /// Positions of the rotary axes one after the other.
    pub stations: u64,
    /// Changes of posture before.
    pub switches_before: u64,
    /// Changes of posture after.
    pub switches_after: u64,
    /// Cost before.
    pub before: f64,
    /// Cost after, which is the least: of the exact angles, before rounding to the digits of the program.
    pub after: f64,
}

/// Runs of rapid motions that differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RapidChanges {
    /// How many.
    pub runs: u64,
    /// Motions in them before.
    pub motions_before: u64,
    /// Motions in them after.
    pub motions_after: u64,
    /// Length of the tip's path in them before, mm.
    pub length_before_mm: f64,
    /// Length after, mm.
    pub length_after_mm: f64,
    /// The smallest horizontal distance of the tool from an obstacle in them after, mm; none where it always passes above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_distance_mm: Option<f64>,
    /// Line in the program after with that distance, from 1; 0 where there is none.
    pub line: u32,
}

/// One motion that differs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionChange {
    /// Index of the motion, from 0.
    pub motion: u64,
    /// Line in the program after, from 1.
    pub line: u32,
    /// Shift of the claimed point at the block's end, mm.
    pub point_shift_mm: f64,
    /// Shift of the tip at the block's end, mm.
    pub tip_shift_mm: f64,
    /// Turn of the tool axis about the part at the block's end, deg.
    pub axis_change_deg: f64,
    /// After minus before at the block's end, each rotary axis, deg.
    pub rotary_change_deg: Vec<f64>,
    /// Largest distance found between the two paths of the claimed point, mm.
    pub path_sampled_mm: f64,
    /// Proven bound on that distance at any moment of the block, mm.
    pub path_bound_mm: f64,
    /// Proven bound on the angle between the tool axes at any moment of the block, deg.
    pub path_axis_bound_deg: f64,
}

impl Certificate {
    /// As JSON, indented, with a line end.
    pub fn to_json(&self) -> String {
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }

    /// Reads JSON. `Err` says what is wrong and where (line and column), or which other version it is and what to do about it.
    pub fn from_json(json: &str) -> Result<Self, String> {
        /// All that certificates of every version have in common.
        #[derive(Deserialize)]
        struct Header {
            schema: String,
        }
        let wrong = |error: serde_json::Error| format!("not a certificate: {error}");
        // the version first: fields of another one would be called unknown or missing
        let header: Header = serde_json::from_str(json).map_err(wrong)?;
        other_schema(&header.schema).map_or(Ok(()), Err)?;
        serde_json::from_str(json).map_err(wrong)
    }

    /// Whether [`Self::from_json`] gives back what [`Self::to_json`] writes: JSON has all but numbers that are not finite.
    ///
    /// # Errors
    /// Why not.
    pub fn can_be_stored(&self) -> Result<(), String> {
        if crate::canonical::CanonicalV1::is_finite(self) {
            Ok(())
        } else {
            Err("the certificate cannot be stored without loss: a number in it is not finite".into())
        }
    }

    /// One line for people: what is proved, with the worst numbers.
    pub fn summary(&self) -> String {
        let (mm, degrees) = self.claim.tolerances();
        if let Claim::RefittedPath { tolerance_mm, source } = self.claim {
            let near = match source {
                crate::RefitSource::Points => "the points of the original program are",
                crate::RefitSource::Chords => "the two paths are",
            };
            return format!(
                "the same but for the path, which is refitted: {near} within {tolerance_mm} mm, in order (found: {:.6} mm, at line {}); {} of {} \
                 motions take the place of others",
                self.worst.point_shift_mm.value,
                self.worst.point_shift_mm.line,
                self.motions.changed,
                self.motions.total
            );
        }
        let claim = match self.claim {
            Claim::SamePoses { .. } => "same poses at all block ends",
            Claim::LeastPostures { .. } => "same poses at all block ends, by the cheapest postures",
            Claim::SameBallCentre { .. } => "same ball centre at all block ends",
            Claim::ClearRapids { .. } => "the same but for rapids, which keep clear of the obstacles",
            Claim::AdaptedFeed { .. } => {
                "the same but for feeds, which keep the axes within their speeds: path, spindle, tool and all else"
            }
            Claim::InsertedPoints { .. } => {
                "the same, with points put in that keep the tip near the programmed segments"
            }
            Claim::InsertedRetracts { .. } => {
                "the same, but the tool leaves the part and comes back in another posture, clear of the obstacles"
            }
            Claim::SameProgrammedCentre { .. } => {
                "same programmed point, declared to be the ball's centre, at all block ends"
            }
            Claim::SameToolPath { .. } => "the same at every moment: path, feed, spindle, tool and all else",
            Claim::RefittedPath { .. } => "a refitted path",
            Claim::SamePath { .. } => "the same tool path; feed, spindle and all else are not compared",
        };
        let worst = &self.worst;
        let motions = &self.motions;
        let mut text = format!(
            "{claim} within {mm} mm and {degrees} deg: {} of {} motions differ",
            motions.changed, motions.total
        );
        if motions.unknown < motions.total || motions.total == 0 {
            let _ = write!(
                text,
                "; shift at block ends {:.6} mm, tool axis {:.6} deg; paths at most {:.6} mm and {:.6} deg apart",
                worst.point_shift_mm.value,
                worst.axis_change_deg.value,
                worst.path_bound_mm.value,
                worst.path_axis_bound_deg.value
            );
        }
        if motions.unknown > 0 {
            let _ = write!(
                text,
                "; {} of {} motions have unknown positions, which both programs program alike: their shift is not measured",
                motions.unknown, motions.total
            );
        }
        if let (Some(rapids), Claim::ClearRapids { clearance_mm, .. }) = (&self.rapids, &self.claim) {
            let near = rapids.least_distance_mm.map_or("always above them".to_owned(), |mm| {
                format!("nearest {mm:.6} mm at line {}", rapids.line)
            });
            let _ = write!(
                text,
                "; {} runs of rapids: {:.6} mm instead of {:.6} mm, at least {clearance_mm} mm from the obstacles ({near})",
                rapids.runs, rapids.length_after_mm, rapids.length_before_mm
            );
        }
        if self.motions.process_changed > 0 {
            text.push_str("; feed or spindle speed differ");
        }
        text
    }

    /// The certificate with its seal.
    pub(crate) fn sealed(mut self) -> Self {
        self.seal_sha256 = self.seal();
        self
    }

    /// What the seal must be.
    pub(crate) fn seal(&self) -> String {
        seal_digest(self)
    }
}

/// Why a certificate with this schema cannot be checked; `None`: it can.
pub(crate) fn other_schema(schema: &str) -> Option<String> {
    match schema {
        SCHEMA => None,
        SCHEMA_1 => Some(format!(
            "this certificate was made by an older version of trunnion (schema \"{SCHEMA_1}\"), whose digests this version cannot check; make a new \
             one from the original program: `trunnion fix BEFORE -o AFTER --certificate FILE`, with the same machine, tools and rewrite"
        )),
        _ => Some(format!(
            "certificate schema is {}, and this version of trunnion reads only \"{SCHEMA}\"",
            serde_json::Value::from(schema)
        )),
    }
}
