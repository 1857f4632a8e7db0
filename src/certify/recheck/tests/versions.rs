//! Certificates of another version are refused, with the reason and what to do.
use super::{BEFORE, TURNS, prove, proved};
use crate::{Certificate, Outcome, recheck};
use trunnion_interp::Setup;

#[test]
fn a_certificate_of_another_version_is_refused_with_the_reason() {
    let certificate = proved(prove(BEFORE, BEFORE, &TURNS));
    assert_eq!(certificate.schema, "trunnion-certificate/2");
    let as_schema = |schema: &str| {
        let other = Certificate {
            schema: schema.into(),
            ..certificate.clone()
        };
        let read = Certificate::from_json(&other.to_json()).expect_err("another version");
        let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("built in");
        let machine = trunnion_machine::builtin("mikron-ucp710").expect("built in");
        let (text, setup) = (BEFORE.as_bytes(), Setup::default());
        let Outcome::Refuted(witness) = recheck(&other.sealed(), text, text, dialect, machine, &setup) else {
            panic!("accepted")
        };
        assert_eq!(witness.message, read);
        read
    };
    let older = as_schema("trunnion-certificate/1");
    assert!(older.contains("made by an older version"), "{older}");
    assert!(
        older.contains("trunnion fix BEFORE -o AFTER --certificate FILE"),
        "{older}"
    );
    let unknown = as_schema("trunnion-certificate/3");
    assert!(unknown.contains("\"trunnion-certificate/3\""), "{unknown}");
    assert!(!unknown.contains("older"), "{unknown}");
    // whatever else another version holds
    let fields_of_another_version = r#"{ "schema": "trunnion-certificate/1", "colour": "red" }"#;
    let told = Certificate::from_json(fields_of_another_version).expect_err("another version");
    assert_eq!(told, older);
    assert!(
        Certificate::from_json("{}")
            .expect_err("no schema")
            .contains("not a certificate")
    );
}
