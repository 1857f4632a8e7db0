//! The `[control]` part of a machine file: how the numerical control interpolates, picks postures and plans.
use crate::raw::{Number, RawControl, RawOrientation, RawRapid, RawTcpCodes, Word};
use crate::validate::{Fault, non_negative, positive};
use crate::{Axis, Control, RapidPath};
use trunnion_geometry::rad;
use trunnion_interp::TcpCodes;

/// Names that `family` may have (interface, section 7).
const FAMILIES: &[&str] = &[
    "generic",
    "iso-6983",
    "linuxcnc",
    "fanuc-30i",
    "haas-ngc",
    "sinumerik-840d",
    "heidenhain-klartext",
    "okuma-osp",
    "mitsubishi-m700",
    "grbl",
    "apt",
];

/// Checks the part and keeps what later floors read.
pub(crate) fn control(raw: &RawControl, axes: &[Axis]) -> Result<Control, Fault> {
    let family = one_of("family", raw.family.as_ref(), FAMILIES)?;
    let mut orientation = None;
    if let Some(tcp) = &raw.tcp {
        one_of("path", tcp.path.as_ref(), &["tip-linear"])?;
        one_of("feed", tcp.feed.as_ref(), &["tip"])?;
        orientation = tcp.orientation;
    }
    let mut control = Control {
        family: family.unwrap_or_else(|| "generic".to_owned()),
        tcp_great_circle: orientation == Some(RawOrientation::GreatCircle),
        tcp_declared: orientation.is_some(),
        rapid: match raw.rapid {
            None => RapidPath::Undeclared,
            Some(RawRapid::Synchronous) => RapidPath::Synchronous,
            Some(RawRapid::Dogleg) => RapidPath::Dogleg,
        },
        branch_rule: None,
        pole_cone: None,
        corner_model: None,
        block_time: None,
        tcp_codes: raw.tcp_codes.as_ref().map(tcp_codes).transpose()?,
    };
    if let Some(branch) = &raw.branch {
        control.branch_rule.clone_from(&branch.rule);
        for word in &branch.order {
            one_of("order", Some(word), &["move1", "move2", "abs1", "abs2"])?;
        }
        for (letter, range) in &branch.range {
            known_axis(letter, axes)?;
            let [min, max] = *range.get_ref();
            if !(min.is_finite() && max.is_finite() && min < max) {
                let message = format!("range [{min}, {max}]: the lower end must be below the upper one, both finite");
                return Err(Fault {
                    message,
                    span: range.span(),
                });
            }
        }
    }
    if let Some(pole) = &raw.pole {
        one_of("action", pole.action.as_ref(), &["through", "hold", "alarm"])?;
        control.pole_cone = non_negative("cone", pole.cone.as_ref())?.map(rad);
        passing_type(pole.passing_type.as_ref())?;
    }
    if let Some(corner) = &raw.corner {
        let models = ["axis-jump", "grbl", "klipper", "linuxcnc-g64", "exact-stop", "servo"];
        control.corner_model = one_of("model", corner.model.as_ref(), &models)?;
        for (letter, jump) in &corner.dv {
            known_axis(letter, axes)?;
            positive("dv", Some(jump))?;
        }
    }
    if let Some(planner) = &raw.planner {
        positive("lookahead", planner.lookahead.as_ref())?;
        non_negative("filter_time", planner.filter_time.as_ref())?;
        control.block_time = non_negative("block_time", planner.block_time.as_ref())?;
    }
    Ok(control)
}

/// Codes that switch the kinematics: each a G or M code with its number, in one of the two lists.
fn tcp_codes(raw: &RawTcpCodes) -> Result<TcpCodes, Fault> {
    let is_code =
        |code: &str| matches!(code.split_at_checked(1), Some(("G" | "M", number)) if number.parse::<u16>().is_ok());
    for word in raw.on.iter().chain(&raw.off) {
        if !is_code(word.get_ref()) {
            return Err(Fault {
                message: format!(
                    "{:?} is no code: write G or M and its number, as \"M428\"",
                    word.get_ref()
                ),
                span: word.span(),
            });
        }
    }
    if let Some(twice) = raw
        .off
        .iter()
        .find(|off| raw.on.iter().any(|on| on.get_ref() == off.get_ref()))
    {
        return Err(Fault {
            message: format!(
                "{:?} cannot switch tool centre point control both on and off",
                twice.get_ref()
            ),
            span: twice.span(),
        });
    }
    let names = |words: &[Word]| words.iter().map(|word| word.get_ref().clone()).collect();
    Ok(TcpCodes {
        on: names(&raw.on),
        off: names(&raw.off),
    })
}

/// The word, which must be one of the known ones.
fn one_of(name: &str, word: Option<&Word>, known: &[&str]) -> Result<Option<String>, Fault> {
    let Some(word) = word else { return Ok(None) };
    if known.contains(&word.get_ref().as_str()) {
        return Ok(Some(word.get_ref().clone()));
    }
    let message = format!("unknown {name} {:?}; known: {}", word.get_ref(), known.join(", "));
    Err(Fault {
        message,
        span: word.span(),
    })
}

fn known_axis(word: &Word, axes: &[Axis]) -> Result<(), Fault> {
    if axes.iter().any(|axis| word.get_ref().as_bytes() == [axis.letter]) {
        return Ok(());
    }
    Err(Fault {
        message: format!("{:?} is not an axis of this machine", word.get_ref()),
        span: word.span(),
    })
}

fn passing_type(number: Option<&Number>) -> Result<(), Fault> {
    match number {
        Some(number) if ![1.0, 2.0].contains(number.get_ref()) => Err(Fault {
            message: format!("passing_type = {}; 1 and 2 are known", number.get_ref()),
            span: number.span(),
        }),
        _ => Ok(()),
    }
}
