//! The arguments of CYCLE800.
use crate::own::arguments;
use trunnion_syntax::{Block, Item};

/// The arguments of a call of CYCLE800.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SwivelCall {
    pub(super) retracts: bool,
    pub(super) adds: bool,
    pub(super) holds_tip: bool,
    pub(super) before: [f64; 3],
    /// Axis and degrees.
    pub(super) turns: [(usize, f64); 3],
    pub(super) behind: [f64; 3],
    pub(super) direction: i32,
}

impl SwivelCall {
    /// `None` for what is not modelled: a mode other than axis by axis, values that are not known.
    pub(super) fn read(text: &str, own: impl Fn(&str) -> Option<f64>) -> Option<Self> {
        let values = arguments(inside(text)?);
        let number = |at: usize| match values.get(at).copied().unwrap_or_default() {
            "" => Some(0.0),
            value => number(value, &own),
        };
        let whole = |at: usize| {
            number(at)
                .filter(|value| value.fract() == 0.0 && value.abs() < 1e9)
                .map(|v| v as i64)
        };
        let three = |at: usize| Some([number(at)?, number(at + 1)?, number(at + 2)?]);
        if values.len() > 16 {
            return None;
        }
        let (state, mode) = (whole(2)?, whole(3)?);
        let retract = whole(0)?;
        let (adds, holds) = (state % 10, state / 10 % 10);
        let direction = i32::try_from(whole(13)?)
            .ok()
            .filter(|direction| (-1..=1).contains(direction))?;
        if !is_known_state(state, direction != 0) || !RETRACTS.contains(&retract) {
            return None;
        }
        let angles = three(7)?;
        let axes = order(mode).or_else(|| (angles == [0.0; 3] && (0..=255).contains(&mode)).then_some([0, 1, 2]))?;
        Some(Self {
            retracts: retract != 0,
            adds: adds == 1,
            holds_tip: holds == 1,
            before: three(4)?,
            turns: [0, 1, 2].map(|index| (axes[index], angles[index])),
            behind: three(10)?,
            direction,
        })
    }
}

/// Values of _FR: no retract, Z, Z then X and Y, along the tool up to the limit, along the tool by a length (SINUMERIK Operate, operating
/// manual: swivelling).
const RETRACTS: [i64; 5] = [0, 1, 2, 4, 5];

/// Whether a source says what every digit of _ST does. Units: a new plane or one that adds; tens: the tip is held. The digits from 10000 on
/// belong to the choice of the axis to which the direction refers (SINUMERIK 828D, operating manual, 01/2015, p. 559; NC-PB/NCXchange): without
/// a direction they choose nothing. With one, posts write 200000, and the axis is an assumption of its own. `turns`: a direction is given.
fn is_known_state(state: i64, turns: bool) -> bool {
    let (high, low) = (state / 10_000, state % 10_000);
    let chooses = matches!(high, 0 | 20) || !turns && (0..100).contains(&high);
    chooses && matches!(low % 10, 0 | 1) && matches!(low / 10, 0 | 1)
}

/// Why a call is not modelled: bits 7 and 6 of its mode say how its angles are meant (SINUMERIK Operate, operating manual: swivelling).
pub(super) fn why_not_read(text: &str, own: impl Fn(&str) -> Option<f64>) -> &'static str {
    let values = inside(text).map(arguments).unwrap_or_default();
    let at = |place: usize| match values.get(place).copied().unwrap_or_default() {
        "" => Some(0),
        value => number(value, &own)
            .filter(|value| value.fract() == 0.0)
            .map(|value| value as i64),
    };
    match at(3).map(|mode| mode >> 6) {
        Some(3) => {
            "with positions of the rotary axes: the control works out the plane, whose X and Y are not taken from a source"
        }
        Some(2) => "with projection angles: how the third one turns the plane is not taken from a source",
        Some(1) => "with solid angles: about which axes they turn is not taken from a source",
        _ if at(2).is_some_and(|state| !is_known_state(state, at(13) != Some(0))) => {
            "with a digit of _ST that no source explains"
        }
        _ if at(0).is_some_and(|retract| !RETRACTS.contains(&retract)) => "with a value of _FR that no source explains",
        _ => "with an argument that is not known or not modelled",
    }
}

/// What is between the brackets of a call.
fn inside(text: &str) -> Option<&str> {
    text.split_once('(')?.1.trim_end().strip_suffix(')')
}

/// An argument: a number, or an expression of the program's variables.
fn number(text: &str, own: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let written = text.parse::<f64>().ok();
    written.or_else(|| own(text)).filter(|value| value.is_finite())
}

/// Whether a call ends the swivelled plane: it stands alone, its brackets are empty, or its data record is "0" (Sinumerik 840D sl
/// Programming Manual, Cycles). `Some(true)`: it may retract or turn the axes first.
pub(super) fn deselects(text: &str, with_arguments: bool, own: impl Fn(&str) -> Option<f64>) -> Option<bool> {
    if !with_arguments {
        return Some(false);
    }
    let values = arguments(inside(text)?);
    if values.iter().all(|value| value.is_empty()) {
        return Some(false);
    }
    let is_none = values.get(1)?.trim_matches('"').trim() == "0";
    is_none.then(|| may_move(text, true, own))
}

/// Whether MCALL is in the block of a call.
pub(super) fn follows_modal_call(block: &Block<'_>) -> bool {
    block.items().any(|item| match item {
        Item::Call(call) => block.program().bytes(call.name).eq_ignore_ascii_case(b"MCALL"),
        _ => false,
    })
}

/// Whether a call may move axes: it retracts or has a direction, as far as that is known.
pub(super) fn may_move(text: &str, with_arguments: bool, own: impl Fn(&str) -> Option<f64>) -> bool {
    let values = inside(text)
        .filter(|_| with_arguments)
        .map(arguments)
        .unwrap_or_default();
    let still = |at: usize| match values.get(at).copied().unwrap_or_default() {
        "" => true,
        value => number(value, &own) == Some(0.0),
    };
    !(still(0) && still(13))
}

/// The axes of a mode that turns axis by axis, two bits each from the lowest: 1 X, 2 Y, 3 Z, each once (57 is X Y Z, 27 Z Y X).
fn order(mode: i64) -> Option<[usize; 3]> {
    let axis = |shift: u32| usize::try_from((mode >> shift) & 3).ok()?.checked_sub(1);
    let axes = [axis(0)?, axis(2)?, axis(4)?];
    let all = axes.iter().fold(0, |mask, axis| mask | 1 << axis) == 0b111;
    ((0..64).contains(&mode) && all).then_some(axes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_name_the_order_of_axes() {
        for (mode, axes) in [
            (57, [0, 1, 2]),
            (45, [0, 2, 1]),
            (54, [1, 0, 2]),
            (30, [1, 2, 0]),
            (39, [2, 0, 1]),
            (27, [2, 1, 0]),
        ] {
            assert_eq!(order(mode), Some(axes), "{mode}");
        }
        for mode in [0, 21, 58, 64 + 57, 192, -7] {
            assert_eq!(order(mode), None, "{mode}");
        }
    }

    #[test]
    fn calls_are_read_or_not_modelled() {
        let own = |text: &str| (text == "R2").then_some(15.0);
        let call =
            SwivelCall::read("CYCLE800(2,\"TISCH\",200001,54,35,-24,0,7,0,0,0,0,0,1,,1)", own).expect("modelled");
        assert!(call.adds && call.retracts && !call.holds_tip);
        assert_eq!((call.before, call.direction), ([35.0, -24.0, 0.0], 1));
        assert_eq!(call.turns, [(1, 7.0), (0, 0.0), (2, 0.0)]);
        let expression = SwivelCall::read("CYCLE800(0,\"\",0,57,0,0,0,R2,0,0)", own).expect("modelled");
        assert_eq!(expression.turns[0], (0, 15.0));
        for text in [
            "CYCLE800(0,\"\",0,192,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",0,57,R1,0,0,10,20,0)",
            "CYCLE800(0,\"\",200,57,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",2,57,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",20,57,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",1000,57,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",10000,57,0,0,0,10,20,0,0,0,0,1)",
            "CYCLE800(0,\"\",220000,57,0,0,0,10,20,0,0,0,0,1)",
            "CYCLE800(0,\"\",100000,57,0,0,0,10,20,0,0,0,0,1)",
            "CYCLE800(0,\"\",1200000,57,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",-1,57,0,0,0,10,20,0)",
            "CYCLE800(3,\"\",0,57,0,0,0,10,20,0)",
            "CYCLE800(12,\"\",0,57,0,0,0,10,20,0)",
            "CYCLE800(-1,\"\",0,57,0,0,0,10,20,0)",
            "CYCLE800(0,\"\",0,57,0,0,0,10,20,0,0,0,0,2)",
        ] {
            assert_eq!(SwivelCall::read(text, own), None, "{text}");
        }
        for (text, why) in [
            ("CYCLE800(0,\"\",220000,57,0,0,0,10,20,0,0,0,0,-1)", "digit of _ST"),
            ("CYCLE800(3,\"\",0,57,0,0,0,10,20,0)", "value of _FR"),
            ("CYCLE800(0,\"\",0,192,0,0,0,10,20,0)", "positions of the rotary axes"),
            ("CYCLE800(0,\"\",0,57,R1,0,0,10,20,0)", "not known or not modelled"),
        ] {
            assert!(
                why_not_read(text, own).contains(why),
                "{text}: {}",
                why_not_read(text, own)
            );
        }
        for (state, tip) in [("0", false), ("10", true), ("200010", true), ("220000", false)] {
            let text = format!("CYCLE800(1,\"\",{state},57,0,0,0,10,20,0)");
            assert_eq!(
                SwivelCall::read(&text, own).map(|call| call.holds_tip),
                Some(tip),
                "{state}"
            );
        }
    }

    #[test]
    fn an_empty_call_and_the_record_0_end_the_plane() {
        let own = |_: &str| None;
        for (text, with_arguments, ends) in [
            ("CYCLE800", false, Some(false)),
            ("CYCLE800()", true, Some(false)),
            ("CYCLE800(0,\"0\",200000,57,0,0,0,0,0,0,0,0,0,0,0)", true, Some(false)),
            ("CYCLE800(2,\"0\",200000,57,0,0,0,0,0,0,0,0,0,1,,1)", true, Some(true)),
            ("CYCLE800(R1,\"0\")", true, Some(true)),
            ("CYCLE800(2,\"TISCH\",200000,57)", true, None),
        ] {
            assert_eq!(deselects(text, with_arguments, own), ends, "{text}");
        }
    }
}
