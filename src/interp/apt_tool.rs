//! APT tools: CUTTER, TLDATA and LOADTL.
use crate::apt::Apt;
use crate::apt::Args;
use crate::core::Report;
use crate::tools::Chosen;
use crate::{FaultKind, LengthOf, Tool, ToolShape};
use trunnion_syntax::{Program, TextRange};

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

impl Apt<'_> {
    /// CUTTER: the shape of the tool in use, or of the one that is loaded next.
    pub(crate) fn cutter(&mut self, args: &Args, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let numbers = args.numbers();
        let cutter = match numbers.first() {
            Some(&diameter) if !args.odd && args.words().is_empty() && diameter > 0.0 => {
                let diameter = diameter * unit;
                let shape = shape(numbers, diameter, unit);
                Some(Tool {
                    number: 0,
                    shape,
                    diameter_mm: Some(diameter),
                    length_mm: None,
                    holder_mm: None,
                })
            }
            _ => {
                let what = report.program.text(report.whole()).into_owned();
                report.fault(TextRange::default(), FaultKind::NotModelled { what });
                None
            }
        };
        self.core.tools.shape_by_cutter(cutter);
        self.core.merge_tool();
    }

    /// TLDATA/MILL,d,r,l,taper,tip of NX: the shape of the tool that is loaded next. Of other kinds the shape is not known.
    pub(crate) fn tool_data(&mut self, args: &Args, program: &Program) {
        let unit = self.core.state.coordinates.unit_mm();
        let is_mill = matches!(args.words(), [kind] if crate::apt::is(program, *kind, "MILL"));
        let tool = match args.numbers() {
            &[diameter, corner, _, taper, tip, ..] if is_mill && !args.odd && diameter > 0.0 => Some(Tool {
                number: 0,
                shape: shape(&[diameter, corner], diameter * unit, unit).filter(|_| taper == 0.0 && tip == 0.0),
                diameter_mm: Some(diameter * unit),
                length_mm: None,
                holder_mm: None,
            }),
            _ => None,
        };
        self.core.tools.shape_by_cutter(tool);
        self.core.merge_tool();
    }

    /// LOADTL/n[,LENGTH,l], LOAD/TOOL,n: a shape that an earlier tool has cut with is not this tool's.
    pub(crate) fn load_tool(&mut self, args: &Args, report: &mut Report<'_>) {
        let number = args.numbers().first().copied();
        let number = number
            .filter(|&n| !args.odd && n >= 0.0 && n.fract() == 0.0 && n <= f64::from(u32::MAX))
            .map(|n| n as u32);
        self.core.tools.end_cutter();
        self.core.forget_linear();
        self.core.relocate(None);
        self.core.tools.load(number.map_or(Chosen::Unread, Chosen::Number));
        self.core.state.tool.load(number);
        let of = LengthOf::Tool(number);
        self.core.merge_tool();
        if let Some(length) = args.after(report.program, "LENGTH") {
            let length = length * self.core.state.coordinates.unit_mm();
            self.core.state.tool.declare_length(length);
            self.core.state.length.set(Some(length), of);
            return;
        }
        let length = self.core.state.tool.own_length_mm();
        let name = self.core.tools.name();
        if length.is_none() && self.core.tools.first_report_of_length(&name) {
            report.fault(args.range, FaultKind::ToolLengthUnset { tool: name });
        }
        self.core.state.length.set_declared(length, of);
    }
}
