//! Tool nose radius compensation on lathes: the centre of the nose runs next to the programmed path, and motions move the imaginary tip,
//! which lies beside that centre. Source: Fanuc Series 30i operator's manual, overview of tool nose radius compensation.
use super::Stage;
use super::element::Point;
use crate::codes::Found;
use crate::core::Report;
use crate::iso::Iso;
use crate::{Beside, Nose, ToolShape};

/// What is said where the nose is not declared.
pub(super) const UNDECLARED: &str = "tool nose radius compensation: the nose of the tool is not declared, and the programmed path is used instead (`[[tool]]` with `shape = \"turning\"`, `nose_radius` in mm and `tip_direction` from 0 to 9)";

/// From the centre of the nose to the imaginary tip, Z and X, mm.
fn to_tip(nose: Nose) -> Option<Point> {
    let way = match nose.tip {
        0 | 9 => [0.0, 0.0],
        1 => [1.0, 1.0],
        2 => [-1.0, 1.0],
        3 => [-1.0, -1.0],
        4 => [1.0, -1.0],
        5 => [1.0, 0.0],
        6 => [0.0, 1.0],
        7 => [-1.0, 0.0],
        8 => [0.0, -1.0],
        _ => return None,
    };
    Some(way.map(|way: f64| way * nose.radius_mm))
}

impl Iso<'_> {
    /// The declared nose of the tool in use, where G41 and G42 are those of a lathe.
    pub(super) fn nose(&self, found: &Found<'_>) -> Option<Nose> {
        let turns = self.core.dialect.quirks.diameter && matches!(found.code.id.as_str(), "G41" | "G42");
        match self.core.state.tool.data().and_then(|tool| tool.shape) {
            Some(ToolShape::Turning(nose)) if turns => Some(nose),
            _ => None,
        }
    }

    /// G41 or G42 with this nose; `sides`: the code in effect before, and this one.
    pub(super) fn compensate_nose(&mut self, nose: Nose, [before, side]: [u8; 2], report: &mut Report<'_>) {
        let tip = to_tip(nose);
        if before != 0 {
            let compensation = &self.memory.compensation;
            if before != side || tip != Some(compensation.tip) || nose.radius_mm != compensation.radius {
                self.lose("its side or its tool changes", report);
            }
            return;
        }
        self.core.state.beside = Beside::Computed;
        let compensation = &mut self.memory.compensation;
        let Some(tip) = tip.filter(|_| nose.radius_mm > 0.0) else {
            compensation.stage = Stage::Off;
            return;
        };
        compensation.stage = Stage::Start;
        compensation.side = if side == 41 { 1.0 } else { -1.0 };
        (compensation.radius, compensation.tip) = (nose.radius_mm, tip);
    }
}
