//! Which tool is in use, and what is declared about it.
use crate::memory::Chosen;
use crate::run::{Interpreter, Report};
use crate::words::{Said, Words};
use crate::{LengthOf, Setup, Tool};
use trunnion_syntax::Program;

/// Lays `over` on `under`: what it declares counts.
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
    }
}

fn numbered(tools: &[Tool], number: u32) -> Option<&Tool> {
    tools.iter().rev().find(|tool| tool.number == number)
}

impl Interpreter<'_> {
    /// What is declared about the tool in use, merged; `None` when nothing is declared and its number is not known. In order of
    /// weight: number 0 of the setup (the tool in use whatever its number), APT CUTTER, the program's comments, the setup.
    /// A program that names no tool uses the only one that its comments declare.
    pub fn tool(&self) -> Option<Tool> {
        self.state.tool_data
    }

    /// The program's own declarations count for the whole program, wherever they are.
    pub(crate) fn declare(&mut self, program: &Program) {
        self.memory.directives_read = true;
        self.memory.declared = crate::directives(program)
            .into_iter()
            .filter_map(|(_, directive)| {
                if let crate::Directive::Tool(tool) = directive {
                    Some(tool)
                } else {
                    None
                }
            })
            .collect();
        self.merge_tool();
    }

    /// What is declared about the tool of a number, or the one in use.
    pub(crate) fn tool_of(&self, number: Option<u32>) -> Option<Tool> {
        let setup: &Setup = &self.setup;
        let declared = &self.memory.declared;
        let unnamed = self.memory.in_spindle == Chosen::Nothing;
        let number = number.or_else(|| match &declared[..] {
            [only] if unnamed && only.number != 0 => Some(only.number),
            _ => None,
        });
        let any = numbered(&setup.tools, 0);
        let any_declared = numbered(declared, 0);
        if number.is_none() && any.is_none() && any_declared.is_none() && self.memory.cutter.is_none() {
            return None;
        }
        let empty = Tool {
            number: number.unwrap_or(0),
            shape: None,
            diameter_mm: None,
            length_mm: None,
        };
        let named = |tools| {
            number
                .filter(|&number| number != 0)
                .and_then(|number| numbered(tools, number))
        };
        let merged = lay(named(&setup.tools), empty);
        let merged = lay(named(declared), merged);
        let merged = lay(any_declared, merged);
        let merged = lay(self.memory.cutter.as_ref(), merged);
        Some(lay(any, merged))
    }

    /// To be called whenever the tool in use or what is declared about it changes.
    pub(crate) fn merge_tool(&mut self) {
        self.state.tool_data = self.tool_of(self.state.tool);
    }

    /// The tool in use as it was written, for people.
    pub(crate) fn tool_name(&self) -> String {
        match &self.memory.in_spindle {
            Chosen::Number(number) => format!("T{number}"),
            Chosen::Named(name) => name.to_string(),
            Chosen::Nothing | Chosen::Unread => "T".to_owned(),
        }
    }

    /// The tool of a T word: T0102 of a lathe is tool 1 with offset 2.
    fn tool_number(&self, number: u32) -> u32 {
        self.dialect.quirks.tool_word.tool(number)
    }

    pub(crate) fn tool_word(&mut self, words: &Words, report: &mut Report<'_>) {
        let chosen = match words.tool {
            Said::Nothing => return,
            Said::Name(range) => {
                let text = report.program.text(range);
                Chosen::Named(text.trim_matches('"').into())
            }
            Said::Number(_) => words
                .tool
                .index()
                .map_or(Chosen::Unread, |number| Chosen::Number(self.tool_number(number))),
            Said::Unread => Chosen::Unread,
        };
        self.state.tool_prepared = if let Chosen::Number(number) = chosen {
            Some(number)
        } else {
            None
        };
        self.memory.prepared = chosen;
        if self.dialect.quirks.tool_word.changes() {
            self.change_tool(report);
        }
    }

    /// Puts the chosen tool into the spindle. The change may move the machine, so X Y Z are not known after it; rotary axes stay.
    pub(crate) fn change_tool(&mut self, report: &mut Report<'_>) {
        self.forget_linear();
        self.tcp_at_tool_change(report);
        if self.memory.prepared == Chosen::Nothing {
            return;
        }
        self.memory.in_spindle = self.memory.prepared.clone();
        self.state.tool = self.state.tool_prepared;
        self.merge_tool();
        let edge = match (self.dialect.quirks.edge_at_tool_change, self.memory.edge) {
            (true, edge) => Some(edge.filter(|&edge| edge != 0).unwrap_or(1)),
            (false, edge) => edge,
        };
        // an empty spindle has no length
        match (edge, &self.memory.in_spindle) {
            (None, _) => {}
            (Some(_), Chosen::Number(0)) => self.set_length(None, LengthOf::Nothing),
            (edge, _) => self.edge_length(edge, report.whole(), report),
        }
    }
}
