//! The first field in which two certificates differ.
use crate::Certificate;
use serde_json::Value;

/// Name of the first field that differs, with both values; `None` when all are equal. Numbers must be equal exactly: JSON holds
/// the shortest text that reads back as the same double.
pub(crate) fn first_difference(given: &Certificate, fresh: &Certificate) -> Option<String> {
    if given == fresh {
        return None;
    }
    let as_value = |certificate: &Certificate| serde_json::to_value(certificate).unwrap_or_default();
    let (mut given_value, mut fresh_value) = (as_value(given), as_value(fresh));
    // the seal covers all other fields, so it is named only if nothing else is wrong
    let seals = [&mut given_value, &mut fresh_value].map(|value| value["seal_sha256"].take());
    let found = differ(&given_value, &fresh_value, "").or_else(|| {
        (seals[0] != seals[1]).then(|| {
            "seal_sha256: the certificate was changed after it was made (its claim or version is not the sealed one)".into()
        })
    });
    Some(found.unwrap_or_else(|| "the certificate differs from the proof".into()))
}

/// The first place in which two values differ, with both.
pub(crate) fn differ(given: &Value, fresh: &Value, path: &str) -> Option<String> {
    match (given, fresh) {
        (Value::Object(a), Value::Object(b)) => a.iter().find_map(|(key, value)| {
            let path = if path.is_empty() {
                key.clone()
            } else {
                format!("{path}.{key}")
            };
            differ(value, b.get(key)?, &path)
        }),
        (Value::Array(a), Value::Array(b)) if a.len() != b.len() => Some(format!(
            "{path}: the certificate has {} entries, the proof has {}",
            a.len(),
            b.len()
        )),
        (Value::Array(a), Value::Array(b)) => a
            .iter()
            .zip(b)
            .enumerate()
            .find_map(|(i, (a, b))| differ(a, b, &format!("{path}[{i}]"))),
        _ if given == fresh => None,
        _ => Some(format!("{path}: the certificate says {given}, the proof gives {fresh}")),
    }
}
