//! Certificates that were made before: the golden one re-checks, one of the first version is refused with what to do.
use crate::cli::tools::{status, str, text, trunnion};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A file in `tests/golden`; its README says when the files may change.
fn golden(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/golden")
        .join(name);
    str(&path).to_owned()
}

/// Re-checks a certificate of the golden programs: exit status, standard output, standard error.
fn recheck(certificate: &str) -> (i32, String, String) {
    let output = trunnion(&[
        "certify",
        &golden("before.nc"),
        &golden("after.nc"),
        "--certificate",
        certificate,
    ]);
    (status(&output), text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_golden_certificate_rechecks() {
    let (status, said, wrong) = recheck(&golden("certificate.json"));
    assert_eq!(status, 0, "{said}{wrong}");
    assert!(said.starts_with("PROVED same ball centre"), "{said}");
}

#[test]
fn fix_makes_the_golden_certificate_again() {
    let folder = TempDir::new().expect("works");
    let [made, after] = ["made.json", "after.nc"].map(|name| folder.path().join(name));
    let output = trunnion(&[
        "fix",
        &golden("before.nc"),
        "--rewrite",
        "smooth-pole",
        "--tolerance-deg",
        "0.08",
        "-o",
        str(&after),
        "--certificate",
        str(&made),
    ]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let read = |path: &str| fs::read_to_string(path).expect("readable");
    // the golden program is older than the comment that records what was turned
    let comment = " (trunnion: turned 0.08)";
    assert_eq!(read(str(&after)).replacen(comment, "", 1), read(&golden("after.nc")));
    let rest = |path: &str| {
        let mut value: serde_json::Value = serde_json::from_str(&read(path)).expect("JSON");
        for key in ["after", "seal_sha256"] {
            value[key].take();
        }
        value
    };
    assert_eq!(rest(str(&made)), rest(&golden("certificate.json")));
}

#[test]
fn a_golden_certificate_with_another_digest_or_seal_is_refused() {
    let folder = TempDir::new().expect("works");
    let certificate = fs::read_to_string(golden("certificate.json")).expect("readable");
    let value: serde_json::Value = serde_json::from_str(&certificate).expect("JSON");
    for (key, why) in [
        ("/dialect/sha256", "another dialect"),
        ("/machine/sha256", "another machine"),
        ("/setup_sha256", "other tools"),
        ("/seal_sha256", "seal_sha256"),
    ] {
        let digest = value.pointer(key).and_then(|digest| digest.as_str()).expect("a digest");
        let other = folder.path().join("other.json");
        fs::write(&other, certificate.replace(digest, &"0".repeat(64))).expect("writable");
        let (status, said, _) = recheck(str(&other));
        assert_eq!(status, 1, "{key}");
        assert!(said.starts_with("REFUTED") && said.contains(why), "{key}: {said}");
    }
}

#[test]
fn a_certificate_of_the_first_version_is_refused_with_what_to_do() {
    // made by the last program that wrote the first version
    let (status, said, wrong) = recheck(&golden("certificate-1.json"));
    assert_eq!((status, said.as_str()), (2, ""), "{wrong}");
    let words = wrong.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("made by an older version of trunnion"), "{wrong}");
    assert!(
        words.contains("trunnion fix BEFORE -o AFTER --certificate FILE"),
        "{wrong}"
    );
}

#[test]
fn a_certificate_of_an_unknown_schema_is_refused_by_name() {
    let folder = TempDir::new().expect("works");
    let other = folder.path().join("other.json");
    fs::write(&other, r#"{ "schema": "somebody-elses/7" }"#).expect("writable");
    let (status, said, wrong) = recheck(str(&other));
    assert_eq!((status, said.as_str()), (2, ""), "{wrong}");
    assert!(wrong.contains("somebody-elses/7"), "{wrong}");
}
