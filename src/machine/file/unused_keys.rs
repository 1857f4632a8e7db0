//! What a machine file may declare although nothing uses it yet: read, checked and listed.
use crate::file::raw::{RawAxis, RawMachine};

/// One sentence for each declaration that no formula and no rule uses.
pub(crate) fn not_used(raw: &RawMachine) -> Vec<String> {
    let mut out = Vec::new();
    for axis in raw.axis.get_ref() {
        of_axis(axis.get_ref(), &mut out);
    }
    if !raw.body.is_empty() {
        out.push("[[body]]: clearance between bodies is not checked".to_owned());
    }
    let tolerances = &raw.tolerances;
    if tolerances.collision_near.is_some() {
        out.push("tolerance collision_near: clearance between bodies is not checked".to_owned());
    }
    out
}

/// Those that could change a verdict of the present rules.
pub(crate) fn not_judged(raw: &RawMachine) -> Vec<String> {
    let decisive = ["limit_margin of"];
    let mut all = not_used(raw);
    all.retain(|text| decisive.iter().any(|start| text.starts_with(start)));
    all
}

fn of_axis(axis: &RawAxis, out: &mut Vec<String>) {
    let letter = axis.letter.get_ref();
    let mut say = |set: bool, text: String| {
        if set {
            out.push(text);
        }
    };
    say(
        axis.spindle,
        format!("spindle of {letter}: its speeds as a spindle are not judged"),
    );
    say(
        axis.limit_margin.is_some(),
        format!("limit_margin of {letter}: only the limits themselves are judged"),
    );
    let uncertainty = &axis.uncertainty;
    say(
        uncertainty.point.is_some() || uncertainty.dir_arcsec.is_some(),
        format!(
            "uncertainty of {letter}: `machine show` and pivot-uncertainty show its effect on the tip; all other bounds are for the axis as declared"
        ),
    );
    say(
        axis.resolution.is_some(),
        format!("resolution of {letter}: axis positions are not rounded to it"),
    );
}
