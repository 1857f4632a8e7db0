//! A dialect that somebody declares, and what the text says against it.
use super::seen::{Seen, share_a_language};
use super::{CONTENT_BYTES, Detected, Foreign, Surroundings, core_dialect, extension, foreign, named, owner};

/// The dialect with this name, declared for `reason`. A text that is plainly no program is none whatever is declared. Where the text has
/// clear signs of a control with another language, the reason says so and is not certain: a wrong declaration gives findings that mean nothing.
pub fn declared(name: &str, reason: &str, source: &[u8], file_name: Option<&str>) -> Option<Detected> {
    let mut detected = named(name, reason.to_owned(), true)?;
    let head = &source[..source.len().min(CONTENT_BYTES)];
    let text = String::from_utf8_lossy(head).to_ascii_uppercase();
    if let Some(what) = foreign::plainly_none(&text) {
        return Some(Detected {
            dialect: core_dialect(),
            reason: format!("{reason}; content: {what}"),
            certain: true,
            foreign: Some(Foreign::NotAProgram(what)),
        });
    }
    // an extension of the declared control speaks for it
    let owner = file_name.and_then(extension).and_then(|extension| owner(&extension));
    let found = Seen::of(&text).decide(owner, Surroundings::default());
    if let Some(found) = found.filter(|found| found.certain) {
        let other = match found.foreign {
            Some(Foreign::Control(control)) => control.name,
            _ => &found.dialect.name,
        };
        if !share_a_language(name, other) {
            let sign = found.reason.trim_start_matches("content: ");
            detected.reason = format!("{reason}; the text looks like {other}: {sign}");
            detected.certain = false;
        }
    }
    Some(detected)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FANUC: &str =
        "%\nO0001 (PART)\nG21 G17 G40 G49 G80 G90\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z10.\nG1 Z-1. F100.\nM30\n%\n";
    const SINUMERIK: &str = "N10 TRAORI\nN20 G1 X1 Y2 A3=0 B3=0 C3=1 F1000\nN30 R1=R2+1\nN40 MSG(\"side\")\nN50 M30\n";

    fn reason(name: &str, text: &str) -> (String, bool) {
        let found = declared(name, "trunnion.toml", text.as_bytes(), None).expect("known");
        assert_eq!((found.dialect.name.as_str(), found.foreign), (name, None));
        (found.reason, found.certain)
    }

    #[test]
    fn clear_signs_of_another_language_are_said() {
        let (said, certain) = reason("sinumerik-840d", FANUC);
        assert!(
            said.starts_with("trunnion.toml; the text looks like fanuc-30i: "),
            "{said}"
        );
        assert!(said.contains(" on line ") && !certain, "{said}");
        let (said, certain) = reason("fanuc-30i", SINUMERIK);
        assert!(said.contains("looks like sinumerik-840d: ") && !certain, "{said}");
    }

    #[test]
    fn one_language_and_weak_signs_say_nothing() {
        let plain = || ("trunnion.toml".to_owned(), true);
        for name in ["fanuc-30i", "haas-ngc", "haas-lathe", "fanuc-30i-lathe-b"] {
            assert_eq!(reason(name, FANUC), plain(), "{name}");
        }
        for name in ["linuxcnc", "sinumerik-840d", "heidenhain-klartext", "okuma-osp", "apt"] {
            assert_eq!(reason(name, "G21 G90\nG0 X1 Y2\nG1 X3 F100\nM30\n"), plain(), "{name}");
        }
        // LinuxCNC reads subprograms in the form of a Fanuc
        let found = |name| declared("linuxcnc", "x", b"O1000\nG21 G90\nG0 X1\nM99\n", Some(name)).expect("known");
        assert!(found("a.ngc").certain, "{:?}", found("a.ngc"));
        assert!(
            found("a.nc").reason.contains("looks like fanuc-30i"),
            "{:?}",
            found("a.nc")
        );
    }

    #[test]
    fn prose_is_no_program_whatever_is_declared() {
        let prose = "# The clamp of job 12\n\nThis folder holds the programs of the clamp.\nRun them in the order of their names, please.\n\
                     The first one cuts the pocket on the upper side.\n";
        for name in crate::BUILTIN_NAMES {
            let found = declared(name, "trunnion.toml", prose.as_bytes(), None).expect("known");
            assert!(
                matches!(found.foreign, Some(Foreign::NotAProgram(_))),
                "{name}: {found:?}"
            );
            // a program whose lines are not those of the dialect is still read
            for program in [
                FANUC,
                SINUMERIK,
                "LBL 1\nFN 0: Q1 = +1\nCALL LBL 2\n",
                "PARTNO / A\nLOADTL / 1\nFINI\n",
            ] {
                assert_eq!(
                    declared(name, "x", program.as_bytes(), None).expect("known").foreign,
                    None,
                    "{name}"
                );
            }
        }
    }
}
