//! Signs of controls of small machines and of kernels that other makers build on: ISG (Beckhoff and others), PlanetCNC, FluidNC,
//! RepRapFirmware, and macros that a sender (gSender, CNCjs) works out before grbl sees them.
use super::text::unnumbered;
use super::votes::Votes;

/// Signs in a line as it is written, in upper case.
pub(super) fn raw(line: &str, votes: &mut Votes) {
    isg(line, votes);
    rep_rap(line, votes);
    for start in ["(DLGNAME", "(DLG,", "(DLGSHOW"] {
        if line.contains(start) {
            votes.add("planetcnc", 12, start);
        }
    }
    for start in ["$SD/RUN=", "$LOCALFS/RUN=", "$SD/SHOW", "$LOCALFS/SHOW"] {
        if line.starts_with(start) {
            votes.add("fluidnc", 20, start);
        }
    }
    // `%SAFE_Z = global.safeZ || -5`; a Fanuc or Fagor has a name without a value there
    let assigns = line.strip_prefix('%').and_then(|rest| rest.split_once('='));
    if assigns.is_some_and(|(name, _)| is_name(name.trim()) && !name.trim().starts_with("_N_")) || line == "%WAIT" {
        votes.add("sender-macro", 20, "a variable %NAME =");
    }
}

/// Whether a text is a name: letters, digits and underscores.
fn is_name(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_uppercase() || first == '_')
        && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// ISG kernel: local subprograms begin with `%L NAME` and are called with `LL NAME`; variables are V.L., V.P., V.G. and V.A. names, which
/// are declared between #VAR and #ENDVAR (ISG-CNC programming manual; Beckhoff TF5200).
fn isg(line: &str, votes: &mut Votes) {
    let text = unnumbered(line);
    for start in ["%L ", "LL "] {
        if text.strip_prefix(start).is_some_and(|rest| is_name(rest.trim())) {
            votes.add("isg", 12, start.trim_end());
        }
    }
    for start in ["#VAR", "#ENDVAR", "#TRAFO ON", "#TRAFO OFF", "#KIN ID"] {
        if text.starts_with(start) {
            votes.add("isg", 12, start);
        }
    }
    for name in ["V.L.", "V.P.", "V.S."] {
        let at = text.find(name);
        if at.is_some_and(|at| !text[..at].ends_with(|before: char| before.is_ascii_alphanumeric() || before == '.')) {
            votes.add("isg", 6, &format!("a variable {name}"));
        }
    }
}

/// RepRapFirmware: statements with expressions in braces, and its own M codes with texts (Duet3D, GCode meta commands).
fn rep_rap(line: &str, votes: &mut Votes) {
    for start in [
        "VAR ",
        "GLOBAL ",
        "SET VAR.",
        "SET GLOBAL.",
        "WHILE {",
        "IF {",
        "ELIF ",
        "ABORT \"",
        "ECHO \"",
    ] {
        let assigns = !matches!(start, "VAR " | "GLOBAL ") || line.contains('=');
        if line.starts_with(start) && assigns {
            votes.add("marlin", 10, start.trim_end());
        }
    }
    for part in ["{GLOBAL.", "{VAR.", "{MOVE.", "{SENSORS."] {
        if line.contains(part) {
            votes.add("marlin", 10, part);
        }
    }
    for start in ["M291 P\"", "M98 P\"", "M291 S", "M558 "] {
        if line.starts_with(start) {
            votes.add("marlin", 8, start.trim_end_matches('"').trim_end());
        }
    }
}
