//! APT tools: CUTTER and LOADTL.
use crate::apt::Args;
use crate::memory::Chosen;
use crate::run::{Interpreter, Report};
use crate::{FaultKind, LengthOf, Tool, ToolShape};
use trunnion_syntax::TextRange;

/// Two lengths of a tool that are written with this difference are the same, mm.
const SAME: f64 = 1e-4;

/// The shape that CUTTER/d,r,e,f,a,b,h says: e and f place the corner's centre, a and b are cone angles. Only shapes whose
/// corner joins side and tip are ball, flat or bull.
fn shape(numbers: &[f64], diameter: f64, unit: f64) -> Option<ToolShape> {
    let number = |at: usize| numbers.get(at).copied();
    let corner = number(1).unwrap_or(0.0) * unit;
    let straight = number(4).unwrap_or(0.0) == 0.0 && number(5).unwrap_or(0.0) == 0.0;
    let beside = number(2).is_none_or(|e| e == 0.0 || (e * unit - (diameter / 2.0 - corner)).abs() <= SAME);
    let above = number(3).is_none_or(|f| f == 0.0 || (f * unit - corner).abs() <= SAME);
    if !straight || !beside || !above || corner < 0.0 || corner > diameter / 2.0 + SAME {
        return None;
    }
    Some(if corner == 0.0 {
        ToolShape::Flat
    } else if (2.0 * corner - diameter).abs() <= SAME {
        ToolShape::Ball
    } else {
        ToolShape::Bull(corner)
    })
}

impl Interpreter<'_> {
    /// CUTTER: the shape of the tool in use, or of the one that is loaded next.
    pub(crate) fn cutter(&mut self, args: &Args, report: &mut Report<'_>) {
        let unit = self.state.length_unit_mm;
        let numbers = args.numbers();
        self.memory.cutter = match numbers.first() {
            Some(&diameter) if !args.odd && args.words().is_empty() && diameter > 0.0 => {
                let diameter = diameter * unit;
                let shape = shape(numbers, diameter, unit);
                Some(Tool {
                    number: 0,
                    shape,
                    diameter_mm: Some(diameter),
                    length_mm: None,
                })
            }
            _ => {
                let what = report.program.text(report.whole()).into_owned();
                report.fault(TextRange::default(), FaultKind::NotModelled { what });
                None
            }
        };
        self.memory.cutter_used = false;
        self.merge_tool();
    }

    /// LOADTL/n[,LENGTH,l], LOAD/TOOL,n: a shape that an earlier tool has cut with is not this tool's.
    pub(crate) fn load_tool(&mut self, args: &Args, report: &mut Report<'_>) {
        let number = args.numbers().first().copied();
        let number = number
            .filter(|&n| !args.odd && n >= 0.0 && n.fract() == 0.0 && n <= f64::from(u32::MAX))
            .map(|n| n as u32);
        if std::mem::take(&mut self.memory.cutter_used) {
            self.memory.cutter = None;
        }
        self.forget_linear();
        self.memory.in_spindle = number.map_or(Chosen::Unread, Chosen::Number);
        self.state.tool = number;
        self.state.length_of = LengthOf::Tool(number);
        self.merge_tool();
        if let Some(length) = args.after(report.program, "LENGTH") {
            let length = length * self.state.length_unit_mm;
            if let Some(tool) = &mut self.state.tool_data {
                tool.length_mm = Some(length);
            }
            self.state.tool_length_mm = Some(length);
            return;
        }
        let length = self.state.tool_data.and_then(|tool| tool.length_mm);
        let name = self.tool_name();
        if length.is_none() && self.memory.length_is_news(&name) {
            report.fault(args.range, FaultKind::ToolLengthUnset { tool: name });
        }
        self.state.tool_length_mm = Some(length.unwrap_or(0.0));
    }
}
