//! What a proof leaves behind: digests of the inputs, the claim, and the numbers found.
use crate::Claim;
use serde::{Deserialize, Serialize};

/// Version of the certificate's shape.
pub const SCHEMA: &str = "trunnion-certificate/1";

/// A certificate (JSON). Every number in it is recomputed by `recheck`; one that differs is refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// [`SCHEMA`].
    pub schema: String,
    /// The claim.
    pub claim: Claim,
}
