//! Corrupts certificates and texts: every mutant must be refused.

use super::strategy_2::{ROWS, ball, certified, settings, sinumerik, smooth};
use serde_json::Value;
use trunnion::certify::{Certificate, Claim, Outcome, certify, recheck};
use trunnion::check::Settings;

/// Texts before and after, and the certificate of smooth-pole at 0.08 deg.
fn proof(settings: &Settings<'_>) -> (String, String, Certificate) {
    let before = sinumerik(ROWS);
    let (after, certificate) = certified(smooth(&before, settings, 0.08));
    (before, after, certificate)
}

fn again(certificate: &Certificate, before: &str, after: &str, settings: &Settings<'_>) -> Outcome {
    let machine = settings.machine.expect("a machine");
    recheck(
        certificate,
        before.as_bytes(),
        after.as_bytes(),
        settings.dialect,
        machine,
        &settings.setup,
    )
}

/// Paths of all leaves of a JSON value.
fn leaves(value: &Value, path: &str, out: &mut Vec<String>) {
    match value {
        Value::Object(map) => map
            .iter()
            .for_each(|(key, value)| leaves(value, &format!("{path}/{key}"), out)),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .for_each(|(i, value)| leaves(value, &format!("{path}/{i}"), out)),
        _ => out.push(path.to_owned()),
    }
}

/// Other values for a leaf, most of them hardly different.
fn mutants(value: &Value) -> Vec<Value> {
    match value {
        Value::Bool(value) => vec![Value::from(!value)],
        Value::String(text) => {
            let mut other = text.clone();
            let last = if other.pop() == Some('0') { '1' } else { '0' };
            other.push(last);
            vec![Value::from(other), Value::from(""), Value::Null]
        }
        Value::Number(number) if number.is_u64() => {
            let number = number.as_u64().expect("a whole number");
            vec![
                Value::from(number + 1),
                Value::from(number.wrapping_sub(1)),
                Value::from(-1),
            ]
        }
        Value::Number(number) => {
            let number = number.as_f64().expect("a number");
            let next = f64::from_bits(number.to_bits() + 1);
            vec![
                Value::from(next),
                Value::from(-number - 1.0),
                Value::from(number * 2.0 + 1.0),
                Value::from(1e300),
                Value::Null,
            ]
        }
        Value::Null | Value::Array(_) | Value::Object(_) => vec![Value::from(1)],
    }
}

#[test]
fn the_certificate_holds_and_survives_json() {
    let settings = settings("sinumerik-840d", ball());
    let (before, after, certificate) = proof(&settings);
    let read = Certificate::from_json(&certificate.to_json()).expect("JSON");
    assert_eq!(read, certificate);
    assert!(matches!(again(&read, &before, &after, &settings), Outcome::Proved(_)));
    assert_eq!(certificate.can_be_stored(), Ok(()));
    for number in [f64::NAN, f64::INFINITY] {
        let mut other = certificate.clone();
        other.changes[0].path_bound_mm = number;
        assert!(Certificate::from_json(&other.to_json()).is_err());
        let why = other.can_be_stored().expect_err("JSON has no such number");
        assert!(why.contains("not finite"), "{why}");
    }
}

#[test]
fn every_altered_field_is_refused() {
    let settings = settings("sinumerik-840d", ball());
    let (before, after, certificate) = proof(&settings);
    let whole: Value = serde_json::from_str(&certificate.to_json()).expect("JSON");
    let mut paths = Vec::new();
    leaves(&whole, "", &mut paths);
    assert!(paths.len() > 60, "the certificate has {} fields", paths.len());
    let mut mutants_tried = 0;
    for path in paths {
        for mutant in mutants(whole.pointer(&path).expect("the leaf")) {
            let mut altered = whole.clone();
            *altered.pointer_mut(&path).expect("the leaf") = mutant.clone();
            if altered == whole {
                continue;
            }
            mutants_tried += 1;
            // a value that no certificate can have is refused on reading
            let Ok(altered) = Certificate::from_json(&altered.to_string()) else {
                continue;
            };
            let outcome = again(&altered, &before, &after, &settings);
            assert!(!matches!(outcome, Outcome::Proved(_)), "{path} = {mutant} is accepted");
            if let Outcome::Refuted(witness) = outcome {
                assert!(!witness.message.is_empty());
            }
        }
    }
    assert!(mutants_tried > 200, "only {mutants_tried} mutants");
}

#[test]
fn the_refusal_names_the_field() {
    let settings = settings("sinumerik-840d", ball());
    let (before, after, mut certificate) = proof(&settings);
    certificate.rotary[0].step_after_deg = 1.0;
    let Outcome::Refuted(witness) = again(&certificate, &before, &after, &settings) else {
        panic!("accepted")
    };
    assert!(
        witness
            .message
            .starts_with("rotary[0].step_after_deg: the certificate says 1.0"),
        "{}",
        witness.message
    );
}

#[test]
fn unknown_missing_and_added_fields_are_refused() {
    let settings = settings("sinumerik-840d", ball());
    let (_, _, certificate) = proof(&settings);
    let mut whole: Value = serde_json::from_str(&certificate.to_json()).expect("JSON");
    whole["extra"] = Value::from(1);
    let error = Certificate::from_json(&whole.to_string()).expect_err("an unknown field");
    assert!(error.contains("extra"), "{error}");
    let object = whole.as_object_mut().expect("an object");
    object.remove("extra");
    object.remove("worst");
    assert!(
        Certificate::from_json(&whole.to_string())
            .expect_err("a missing field")
            .contains("worst")
    );
    assert!(Certificate::from_json("{").is_err());
}

#[test]
fn every_altered_byte_of_the_texts_is_refused() {
    let settings = settings("sinumerik-840d", ball());
    let (before, after, certificate) = proof(&settings);
    for (name, text) in [("before", &before), ("after", &after)] {
        for at in (0..text.len()).step_by(3) {
            let mut altered = text.clone().into_bytes();
            altered[at] = if altered[at] == b'1' { b'2' } else { b'1' };
            let altered = String::from_utf8(altered).expect("ASCII");
            let outcome = if name == "before" {
                again(&certificate, &altered, &after, &settings)
            } else {
                again(&certificate, &before, &altered, &settings)
            };
            assert!(!matches!(outcome, Outcome::Proved(_)), "byte {at} of the text {name}");
        }
    }
}

#[test]
fn a_text_that_breaks_the_claim_is_not_certified() {
    let settings = settings("sinumerik-840d", ball());
    let (before, after, certificate) = proof(&settings);
    let prove = |after: &str, claim: &Claim| {
        let machine = settings.machine.expect("a machine");
        certify(
            before.as_bytes(),
            after.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
            claim,
        )
    };
    assert!(matches!(prove(&after, &certificate.claim), Outcome::Proved(_)));
    for (what, altered) in [
        ("another feed", after.replace("F2000", "F2001")),
        ("a comment", after.replace("guide vane", "guide fane")),
        ("a rapid", after.replace("N2930 G1", "N2930 G0")),
        ("a number too far off", after.replace("Z59.93222", "Z59.94222")),
        ("another A", after.replace("A1.047", "A1.247")),
        ("a missing block", after.replace("N2920", ";N2920")),
        ("a blank", after.replace("N2950 G1", "N2950  G1")),
        ("spindle off", after.replace("M3", "M5")),
        ("no TCP", after.replace("TRAORI", "TRAFOOF")),
    ] {
        assert_ne!(altered, after, "{what}");
        assert!(
            !matches!(prove(&altered, &certificate.claim), Outcome::Proved(_)),
            "{what} is certified"
        );
    }
    let narrow = Claim::SameBallCentre {
        ball_radius_mm: 5.0,
        tolerance_mm: 0.001,
        tolerance_deg: 0.06,
    };
    assert!(
        matches!(prove(&after, &narrow), Outcome::Refuted(_)),
        "the axis turns by 0.067 deg"
    );
    let thick = Claim::SameBallCentre {
        ball_radius_mm: 6.0,
        tolerance_mm: 0.1,
        tolerance_deg: 0.08,
    };
    assert!(
        matches!(prove(&after, &thick), Outcome::Refuted(_)),
        "the declared ball is another one"
    );
    let nonsense = Claim::SameBallCentre {
        ball_radius_mm: 5.0,
        tolerance_mm: f64::NAN,
        tolerance_deg: 0.08,
    };
    assert!(!matches!(prove(&after, &nonsense), Outcome::Proved(_)));
}

#[test]
fn the_same_tool_path_is_proved_or_refuted_with_a_witness() {
    let mut settings = settings("sinumerik-840d", ball());
    // how far the paths are apart near the pole depends on where A is zero
    settings.setup.work_offsets.push(trunnion::interp::WorkOffset {
        name: trunnion::interp::UNNAMED_ZERO.to_owned(),
        values: [0.0; 9],
    });
    let before = sinumerik(ROWS);
    let machine = settings.machine.expect("a machine");
    let compare = |after: &str, tolerance_mm: f64, tolerance_deg: f64| {
        // C turns otherwise near the pole, so the programs are not the same in everything: the path is
        let claim = Claim::SamePath {
            tolerance_mm,
            tolerance_deg,
        };
        certify(
            before.as_bytes(),
            after.as_bytes(),
            settings.dialect,
            machine,
            &settings.setup,
            &claim,
        )
    };
    let other_layout = before
        .replace("N29", "N39")
        .replace(" G1 ", " G01 ")
        .replace("; guide vane\n", "");
    assert!(matches!(compare(&other_layout, 1e-9, 1e-9), Outcome::Proved(_)));
    let (after, _) = certified(smooth(&before, &settings, 0.08));
    let Outcome::Refuted(witness) = compare(&after, 1e-4, 1e-4) else {
        panic!("not refuted")
    };
    assert_eq!(witness.line, Some(6));
    // between block ends the tool axis of the original swings wide, so the tolerance that holds at the ends does not hold there
    assert!(matches!(compare(&after, 0.02, 0.08), Outcome::Refuted(_)));
    let outcome = compare(&after, 0.02, 1.0);
    assert!(matches!(outcome, Outcome::Proved(_)), "{outcome:?}");
    let shorter = before.replace("N2950", ";N2950");
    assert!(matches!(compare(&shorter, 1.0, 1.0), Outcome::Refuted(_)));
}
