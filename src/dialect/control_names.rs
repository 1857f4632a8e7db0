//! Names by which people know controls, and the dialects for them.
use crate::{BUILTIN_NAMES, or_known};

/// Beginnings of names, in lower case without signs, and the dialect that reads the programs of these controls.
///
/// Sources: the titles of the manuals in docs/sources.md; "SINUMERIK 840D sl / 828D" share one programming manual.
const NAMES: &[(&str, &str)] = &[
    ("siemens", "sinumerik-840d"),
    ("sinumerik", "sinumerik-840d"),
    ("840d", "sinumerik-840d"),
    ("828d", "sinumerik-840d"),
    ("itnc", "heidenhain-klartext"),
    ("tnc", "heidenhain-klartext"),
    ("klartext", "heidenhain-klartext"),
    ("conversational", "heidenhain-klartext"),
    ("heidenhain", "heidenhain-klartext"),
    ("emc", "linuxcnc"),
    ("rs274", "linuxcnc"),
    ("osp", "okuma-osp"),
    ("cldata", "apt"),
];

/// Controls without a dialect of their own. A dialect of another control would misread some of their codes.
const NONE: &[(&str, &str)] = &[
    ("mach3", "Mach3"),
    ("mach4", "Mach4"),
    ("mazak", "Mazak"),
    ("mazatrol", "Mazak"),
    ("mitsubishi", "Mitsubishi"),
    ("brother", "Brother"),
    ("hurco", "Hurco"),
    ("fadal", "Fadal"),
    ("duet", "Duet"),
];

/// The end of a sentence about an unknown dialect: the one that was meant, or the list of all.
pub fn dialect_hint(wanted: &str) -> String {
    let plain: String = wanted.chars().filter(char::is_ascii_alphanumeric).collect();
    let plain = plain.to_ascii_lowercase();
    if let Some((_, name)) = NAMES.iter().find(|(part, _)| plain.starts_with(part)) {
        return format!("; did you mean `{name}`?");
    }
    if let Some((_, title)) = NONE.iter().find(|(part, _)| plain.starts_with(part)) {
        return format!(
            "; there is no dialect for {title}: `iso-6983` has the codes that most controls share, and a dialect table adds those of one control"
        );
    }
    or_known(wanted, BUILTIN_NAMES, "dialects")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_names_lead_to_the_dialect() {
        for (wanted, name) in [
            ("siemens", "sinumerik-840d"),
            ("Siemens 828D", "sinumerik-840d"),
            ("SINUMERIK", "sinumerik-840d"),
            ("heidenhain", "heidenhain-klartext"),
            ("iTNC-530", "heidenhain-klartext"),
            ("emc2", "linuxcnc"),
            ("okuma", "okuma-osp"),
            ("linuxcn", "linuxcnc"),
        ] {
            assert_eq!(dialect_hint(wanted), format!("; did you mean `{name}`?"), "{wanted}");
        }
        assert!(dialect_hint("mach3").contains("no dialect for Mach3: `iso-6983`"));
        assert!(dialect_hint("haas").contains("`haas-ngc` or `haas-lathe`"));
        assert!(dialect_hint("zzz").contains("; known dialects: iso-6983, "));
    }

    #[test]
    fn each_name_is_a_dialect() {
        assert!(NAMES.iter().all(|(_, name)| BUILTIN_NAMES.contains(name)));
    }
}
