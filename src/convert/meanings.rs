//! What a post declares about codes that its dialect leaves to the machine builder: `coolant-thru = "M51"`.
use crate::Post;
use crate::template::fill;
use trunnion_certify::conversion::{Ask, Coolant, asked_in};
use trunnion_dialect::Dialect;

impl Post {
    /// What the codes of its own in its templates mean, by the text of the code: a request, or none, for codes of the header or footer.
    pub(crate) fn meanings(&self, dialect: &Dialect) -> Vec<(String, Option<Ask>)> {
        let mut all = Vec::new();
        for (key, template) in &self.templates {
            let meaning = match key.as_str() {
                "coolant-flood" => Some(Ask::Coolant(Coolant::Flood)),
                "coolant-mist" => Some(Ask::Coolant(Coolant::Mist)),
                "coolant-thru" => Some(Ask::Coolant(Coolant::Thru)),
                "coolant-thru-off" => Some(Ask::Coolant(Coolant::ThruOff)),
                "coolant-air" => Some(Ask::Coolant(Coolant::Air)),
                "coolant-off" => Some(Ask::Coolant(Coolant::Off)),
                "stop" => Some(Ask::Stop { optional: false }),
                "optional-stop" => Some(Ask::Stop { optional: true }),
                "auxiliary" | "comment" | "message" => continue,
                _ => None,
            };
            let text = fill(template, |name| {
                Some(if name == "title" { String::new() } else { "1".to_owned() })
            });
            for ask in asked_in(text.unwrap_or_default().as_bytes(), dialect) {
                if let Ask::Own(own) = ask
                    && (meaning.is_some() || is_code(&own.text))
                {
                    all.push((own.text, meaning.clone()));
                }
            }
        }
        all
    }
}

/// A G or M code: coordinates and words that a template fills in are none.
fn is_code(text: &str) -> bool {
    let number = text.strip_prefix(['G', 'M']).unwrap_or_default();
    !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
}
