//! Which tool is in use, and what is declared about it.
use crate::core::Report;
use crate::iso::Iso;
use crate::reported::Reported;
use crate::words::{WordValue, Words};
use crate::{LengthOf, Setup, Tool};
use std::collections::BTreeMap;
use std::sync::Arc;
use trunnion_dialect::ToolWord;
use trunnion_syntax::Program;

/// The tool that T has selected and M6 will load.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Chosen {
    /// No T yet.
    #[default]
    Nothing,
    Number(u32),
    Named(Arc<str>),
    /// T with a value that is not evaluated.
    Unread,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tools {
    prepared: Chosen,
    in_spindle: Chosen,
    /// APT: the tool shape that CUTTER gives.
    cutter: Option<Tool>,
    /// APT: a motion was made with it.
    cutter_used: bool,
    /// Tools of the setup; of a number that stands there twice the last.
    of_setup: Arc<BTreeMap<u32, Tool>>,
    /// Tools that the program's comments declare.
    declared: Arc<BTreeMap<u32, Tool>>,
    /// Tools that the program's blocks define (TOOL DEF of Klartext).
    defined: BTreeMap<u32, Tool>,
    directives_read: bool,
    lengths_reported: Reported,
}

/// Merges `over` into `under`: what `over` declares wins.
fn lay(over: Option<&Tool>, under: Tool) -> Tool {
    let Some(over) = over else { return under };
    // a shape and its diameter belong together
    let (shape, diameter_mm) = match over.shape {
        Some(shape) => (Some(shape), over.diameter_mm.or(under.diameter_mm)),
        None => (under.shape, over.diameter_mm.or(under.diameter_mm)),
    };
    Tool {
        number: under.number,
        shape,
        diameter_mm,
        length_mm: over.length_mm.or(under.length_mm),
        holder_mm: over.holder_mm.or(under.holder_mm),
    }
}

impl Tools {
    /// With what a setup declares.
    pub(crate) fn new(setup: &Setup) -> Self {
        let of_setup = setup.tools.iter().map(|tool| (tool.number, *tool)).collect();
        Self {
            of_setup: Arc::new(of_setup),
            ..Self::default()
        }
    }
    /// T has selected a tool.
    pub(crate) fn prepare(&mut self, chosen: Chosen) {
        self.prepared = chosen;
    }
    pub(crate) fn prepared(&self) -> &Chosen {
        &self.prepared
    }
    pub(crate) fn in_spindle(&self) -> &Chosen {
        &self.in_spindle
    }
    /// A tool is loaded into the spindle.
    pub(crate) fn load(&mut self, chosen: Chosen) {
        self.in_spindle = chosen;
    }
    /// The prepared tool is loaded into the spindle; returns whether there is one.
    pub(crate) fn load_prepared(&mut self) -> bool {
        let any = self.prepared != Chosen::Nothing;
        if any {
            self.in_spindle = self.prepared.clone();
        }
        any
    }
    /// A tool is selected that is not the one in the spindle.
    pub(crate) fn waits_for_change(&self) -> bool {
        self.prepared != Chosen::Nothing && self.prepared != self.in_spindle
    }
    /// CUTTER gives the shape of the tool.
    pub(crate) fn shape_by_cutter(&mut self, cutter: Option<Tool>) {
        (self.cutter, self.cutter_used) = (cutter, false);
    }
    /// A motion is made with the shape that CUTTER gave.
    pub(crate) fn use_cutter(&mut self) {
        self.cutter_used = true;
    }
    /// A shape that an earlier tool has cut with is not the next tool's.
    pub(crate) fn end_cutter(&mut self) {
        if std::mem::take(&mut self.cutter_used) {
            self.cutter = None;
        }
    }
    /// Reads the tools that the program's comments declare, once; returns whether this was the first time.
    pub(crate) fn read_directives(&mut self, program: &Program) -> bool {
        if std::mem::replace(&mut self.directives_read, true) {
            return false;
        }
        let directives = crate::directives(program).into_iter();
        let tools = directives.filter_map(|(_, directive)| match directive {
            crate::Directive::Tool(tool) => Some((tool.number, tool)),
            _ => None,
        });
        self.declared = Arc::new(tools.collect());
        true
    }
    /// Tools that the program's comments declare, by number.
    pub(crate) fn declared(&self) -> impl Iterator<Item = &Tool> {
        self.declared.values()
    }
    /// A block of the program defines a tool.
    pub(crate) fn define(&mut self, tool: Tool) {
        self.defined.insert(tool.number, tool);
    }
    /// How many entries a clone copies.
    pub(crate) fn copied(&self) -> usize {
        self.defined.len() + self.lengths_reported.copied()
    }
    /// Whether this is the first time that a length is found missing.
    pub(crate) fn first_report_of_length(&mut self, tool: &str) -> bool {
        self.lengths_reported.first(tool)
    }
    /// What is declared about the tool of a number, or the one in use, merged; `None` when nothing is declared and its number is unknown. In
    /// order of precedence: what blocks of the program define, number 0 of the setup (the tool in use whatever its number), APT CUTTER, the
    /// program's comments, the setup. A program that names no tool uses the only one that its comments declare.
    pub(crate) fn data(&self, number: Option<u32>) -> Option<Tool> {
        let declared = self.declared.as_ref();
        let only = || match declared.first_key_value() {
            Some((only, _)) if declared.len() == 1 && *only != 0 => Some(*only),
            _ => None,
        };
        let unnamed = self.in_spindle == Chosen::Nothing;
        let number = number.or_else(|| unnamed.then(only).flatten());
        let any = self.of_setup.get(&0);
        let any_declared = declared.get(&0);
        if number.is_none() && any.is_none() && any_declared.is_none() && self.cutter.is_none() {
            return None;
        }
        let empty = Tool {
            number: number.unwrap_or(0),
            shape: None,
            diameter_mm: None,
            length_mm: None,
            holder_mm: None,
        };
        let named = number.filter(|&number| number != 0);
        let merged = lay(named.and_then(|number| self.of_setup.get(&number)), empty);
        let merged = lay(named.and_then(|number| declared.get(&number)), merged);
        let merged = lay(any_declared, merged);
        let merged = lay(self.cutter.as_ref(), merged);
        let defined = named.and_then(|number| self.defined.get(&number));
        Some(lay(defined, lay(any, merged)))
    }
    /// The tool in use as it was written, for people; T where it is not known.
    pub(crate) fn name(&self) -> String {
        self.known_name().unwrap_or_else(|| "T".to_owned())
    }

    /// The tool in use as it was written, where it is known.
    pub(crate) fn known_name(&self) -> Option<String> {
        match &self.in_spindle {
            Chosen::Number(number) => Some(format!("T{number}")),
            Chosen::Named(name) => Some(name.to_string()),
            Chosen::Nothing | Chosen::Unread => None,
        }
    }
}

impl Iso<'_> {
    pub(crate) fn tool_word(&mut self, words: &Words, report: &mut Report<'_>) {
        let chosen = match words.tool {
            WordValue::Nothing => return,
            WordValue::Name(range) => {
                let text = report.program.text(range);
                Chosen::Named(text.trim_matches('"').into())
            }
            WordValue::Number(_) => words.tool.index().map_or(Chosen::Unread, |number| {
                Chosen::Number(self.core.dialect.quirks.tool_word.tool(number))
            }),
            WordValue::Unread => Chosen::Unread,
        };
        self.core.state.tool.prepare(if let Chosen::Number(number) = chosen {
            Some(number)
        } else {
            None
        });
        self.core.tools.prepare(chosen);
        if self.core.dialect.quirks.tool_word.changes() {
            self.change_tool(words, report);
        }
        if self.core.dialect.quirks.tool_word == ToolWord::ChangesWithOffset {
            self.turret_offset(words, report);
        }
    }

    /// Puts the chosen tool into the spindle. The change may move the machine, so X Y Z are not known after it; rotary axes stay.
    pub(crate) fn change_tool(&mut self, words: &Words, report: &mut Report<'_>) {
        // where the block moves too, the order of both is not known
        let declared = self.core.setup.control.tool_change;
        let declared = declared.filter(|_| !words.axes.any() && !self.core.state.tool_axis.tcp());
        self.core.relocate(declared.as_ref());
        match declared {
            Some(place) => self.stands_at(&place),
            None => self.core.forget_linear(),
        }
        self.memory.length_open = None;
        self.memory.cycle.tapped = false;
        self.tcp_at_tool_change(report);
        // a turret that T turns does not concern the spindle
        if self.core.dialect.quirks.tool_change_stops_spindle {
            self.core.state.spindle.switch(false);
        } else if !self.core.dialect.quirks.tool_word.changes() {
            self.core.state.spindle.leave_to_machine();
        }
        if !self.core.tools.load_prepared() {
            return;
        }
        self.core.state.tool.load(self.core.state.tool.prepared());
        self.core.merge_tool();
        let edge = match (self.core.dialect.quirks.edge_at_tool_change, self.memory.edge) {
            (true, edge) => Some(edge.filter(|&edge| edge != 0).unwrap_or(1)),
            (false, edge) => edge,
        };
        // an empty spindle has no length
        match (edge, self.core.tools.in_spindle()) {
            (None, _) => {}
            (Some(_), Chosen::Number(0)) => self.set_length(None, LengthOf::Nothing),
            (edge, _) => self.edge_length(edge, report.whole(), report),
        }
    }

    /// The offset that the last two digits of T name: it shifts X and Z (FANUC B-64114EN/01, p. 194: the offset vector of the tool). It lies in the
    /// control: the setup declares it, unless the program writes it. 00 is none.
    fn turret_offset(&mut self, words: &Words, report: &mut Report<'_>) {
        let number = words
            .tool
            .index()
            .and_then(|number| self.core.dialect.quirks.tool_word.offset(number));
        let before = self.core.state.length.of();
        if number == Some(0) {
            self.set_length(None, LengthOf::Nothing);
        } else {
            let of = LengthOf::Offset(number);
            let written = number.is_some_and(|number| self.tool_offset(number).is_some());
            let declared = number.and_then(|number| self.core.setup.tool_offsets.get(number));
            let declared = declared.filter(|_| !written);
            self.turret_shifts(declared.unwrap_or_default());
            if declared.is_some() {
                self.set_length(Some(0.0), of);
            } else {
                let key = number.map_or_else(|| "offset".to_owned(), |number| format!("offset {number}"));
                self.take_length(None, (&key, of), report.whole(), report);
            }
        }
        if before != self.core.state.length.of() {
            // the axes stand still, or travel the change of length, which is unknown
            self.core.forget_linear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tool(number: u32, length_mm: f64) -> Tool {
        Tool {
            number,
            shape: None,
            diameter_mm: None,
            length_mm: Some(length_mm),
            holder_mm: None,
        }
    }

    #[test]
    fn a_prepared_tool_waits_until_it_is_loaded() {
        let mut tools = Tools::default();
        assert!(!tools.load_prepared() && !tools.waits_for_change());
        tools.prepare(Chosen::Number(3));
        assert!(tools.waits_for_change());
        assert_eq!(tools.name(), "T");
        assert!(tools.load_prepared() && !tools.waits_for_change());
        assert_eq!(tools.name(), "T3");
    }

    #[test]
    fn the_tool_in_use_whatever_its_number_outweighs_the_numbered_one() {
        let mut setup = Setup {
            tools: vec![tool(3, 80.0)],
            ..Setup::default()
        };
        let length = |setup: &Setup, number| Tools::new(setup).data(number).and_then(|tool| tool.length_mm);
        assert_eq!(length(&setup, Some(4)), None);
        assert_eq!(length(&setup, Some(3)), Some(80.0));
        setup.tools.push(tool(0, 120.0));
        assert_eq!(length(&setup, Some(3)), Some(120.0));
        assert_eq!(Tools::default().data(None), None);
    }

    #[test]
    fn a_cutter_that_has_cut_ends_with_its_tool() {
        let mut tools = Tools::default();
        tools.shape_by_cutter(Some(tool(0, 1.0)));
        tools.end_cutter();
        assert!(tools.data(None).is_some(), "it is for the tool that is loaded next");
        tools.use_cutter();
        tools.end_cutter();
        assert_eq!(tools.data(None), None);
    }
}
