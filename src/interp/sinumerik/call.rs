//! Subprograms: arguments, PROC, own variables, return.
use super::saved::Saved;
use crate::Sink;
use crate::flow::{Back, Running};
use crate::iso::Iso;
use crate::own::{Own, Scope, Sort, arguments, is_of_text};
use crate::{Fault, FaultKind, Refusal};
use trunnion_syntax::{Address, Block, BlockId, Item, Program, Value, Word};

/// Program levels of the control, the main program's among them (Programming Manual, 12/2019, p. 493).
const LEVELS: usize = 16;

/// One argument of a call.
#[derive(Clone, Debug, PartialEq)]
struct Argument {
    /// There is nothing between the commas.
    is_left_out: bool,
    /// `None`: it is not known.
    value: Option<f64>,
    /// The text that it is, if it is one that is known.
    text: Option<Box<str>>,
    /// The variable that it is, if it is one.
    variable: Option<Box<str>>,
}

/// What a call hands over.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct With {
    arguments: Vec<Argument>,
    /// By MCALL, after a motion.
    pub(super) is_modal: bool,
    /// By a path, or from outside of the control: where no file of that name is found, the program may be there.
    pub(crate) is_elsewhere: bool,
}

impl With {
    /// From the text between the brackets.
    pub(super) fn read(text: Option<&str>, own: &Own) -> Self {
        let read = |text: &str| Argument {
            is_left_out: text.is_empty(),
            value: own.value(text),
            text: own.text_argument(text),
            variable: is_variable(text).then(|| text.to_ascii_lowercase().into()),
        };
        let text = text.map(str::trim).filter(|text| !text.is_empty());
        let arguments = text.map_or_else(Vec::new, |text| arguments(text).into_iter().map(read).collect());
        Self {
            arguments,
            is_modal: false,
            is_elsewhere: false,
        }
    }
}

/// Why the control stops at the arguments of a call.
pub(super) fn stops(text: Option<&str>, own: &Own) -> Vec<FaultKind> {
    let text = text.unwrap_or_default();
    let unknown = |one: &&str| !one.is_empty() && own.value(one).is_none();
    arguments(text)
        .into_iter()
        .filter(unknown)
        .filter_map(|one| own.stops(one))
        .collect()
}

fn is_variable(text: &str) -> bool {
    let first = text.bytes().next();
    first.is_some_and(|byte| byte.is_ascii_alphabetic() || byte == b'_')
        && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// What is stored for a call.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    /// The caller's variables.
    scope: Scope,
    /// Parameters that are variables of the caller: name here, name there.
    references: Vec<(Box<str>, Box<str>)>,
    /// Parameters by value.
    parameters: Vec<(Box<str>, Sort)>,
    /// SAVE: what comes back at the return.
    saved: Option<Box<Saved>>,
    /// The caller is the subprogram of MCALL, or is called by it.
    in_modal: bool,
}

impl Level {
    /// The subprogram starts again; its parameters were handed over for the first run only.
    pub(crate) fn again(&mut self, own: &mut Own) {
        own.begin_scope();
        for (name, sort) in &self.parameters {
            own.declare(name, *sort, None);
        }
    }

    /// What SAVE brings back after each run.
    pub(crate) fn saved(&self) -> Option<Box<Saved>> {
        self.saved.clone()
    }
}

/// Why a further call is one too many.
pub(crate) fn too_deep(levels: usize, limit: usize) -> Option<FaultKind> {
    let limit = limit.min(LEVELS);
    (levels >= limit).then(|| FaultKind::Rejected {
        refusal: Refusal::Subprogram,
        message: format!("subprogram calls are nested deeper than {limit} levels: does a program call itself?"),
        alarm: None,
    })
}

/// A parameter that PROC declares.
struct Parameter {
    name: Box<str>,
    sort: Sort,
    /// The type and the first text, where it holds a text: `STRING[20]`.
    of_text: Option<(Box<str>, Option<Box<str>>)>,
    initial: Option<f64>,
    by_reference: bool,
    /// A field: the number of elements in each dimension, `None` where PROC leaves it open.
    sizes: Option<Vec<Option<usize>>>,
}

/// The PROC of a program: its parameters, and the words after them.
struct Proc {
    parameters: Vec<Parameter>,
    saves: bool,
}

impl Proc {
    /// The PROC of the program that begins at a block: its first statement.
    fn of(program: &Program, start: u32, own: &Own) -> Option<Self> {
        for at in start..program.block_count() as u32 {
            let block = program.block(BlockId(at));
            let number = block.number();
            let first = block.items().find(|item| match item {
                Item::Comment(_) | Item::Percent(_) | Item::Skip(..) => false,
                Item::Word(word) => Some(word.range) != number,
                _ => true,
            });
            match first {
                None => {}
                Some(Item::Call(call)) if program.bytes(call.name).eq_ignore_ascii_case(b"PROC") => {
                    let rest = call.arguments.map(|range| program.text(range).into_owned());
                    return Some(Self::read(&rest.unwrap_or_default(), own));
                }
                Some(_) => return None,
            }
        }
        None
    }

    /// Everything after PROC: `GROOVE(REAL XBOT, INT N=1, VAR REAL OUT) SAVE`.
    fn read(text: &str, own: &Own) -> Self {
        let text = text.split(';').next().unwrap_or_default();
        let (inside, behind) = match (text.find('('), text.rfind(')')) {
            (Some(open), Some(close)) if open < close => (&text[open + 1..close], &text[close + 1..]),
            _ => ("", text),
        };
        let saves = behind.split_whitespace().any(|word| word.eq_ignore_ascii_case("SAVE"));
        let declared = arguments(inside).into_iter().filter(|text| !text.is_empty());
        let parameters = declared.map(|text| {
            let (left, initial) = match text.split_once('=') {
                Some((left, value)) => (left, own.value(value)),
                None => (text, Some(0.0)),
            };
            let mut words: Vec<&str> = left.split_whitespace().collect();
            let by_reference = words.first().is_some_and(|word| word.eq_ignore_ascii_case("VAR"));
            if by_reference {
                words.remove(0);
            }
            let kind = words.first().and_then(|word| Sort::named(word)).unwrap_or(Sort::Other);
            let of_text = words
                .first()
                .filter(|word| is_of_text(word) && words.len() == 2 && !words[1].contains('['));
            let first = match text.split_once('=') {
                Some((_, value)) => own.text_argument(value),
                None => Some("".into()),
            };
            let of_text = of_text.map(|kind| ((*kind).into(), first));
            let (name, sizes) = match words.concat().split_once('[') {
                Some((_, index)) if of_text.is_none() => {
                    let name = words.get(1).copied().unwrap_or_default();
                    let index = index.strip_suffix(']').unwrap_or_default();
                    let size = |text: &str| own.value(text).map(|size| size as usize);
                    (name, Some(arguments(index).into_iter().map(size).collect()))
                }
                _ => (words.last().copied().unwrap_or_default(), None),
            };
            let stem = name.split('[').next().unwrap_or_default();
            Parameter {
                name: stem.to_ascii_lowercase().into(),
                sort: kind,
                of_text,
                initial,
                by_reference,
                sizes,
            }
        });
        Self {
            parameters: parameters.collect(),
            saves,
        }
    }
}

/// The parameters of a PROC that nothing calls: the caller, which is not here, gives their values.
pub(crate) fn declare_parameters(own: &mut Own, text: &str) {
    for parameter in Proc::read(text, own).parameters {
        own.declare(&parameter.name, parameter.sort, None);
    }
}

/// A variable that two parameters stand for: each would see what the other writes.
fn handed_over_twice<'a>(parameters: &[Parameter], arguments: &'a [Argument]) -> Option<&'a str> {
    let by_reference = parameters
        .iter()
        .zip(arguments)
        .filter(|(parameter, _)| parameter.by_reference);
    let mut names: Vec<&str> = by_reference
        .filter_map(|(_, argument)| argument.variable.as_deref())
        .collect();
    names.sort_unstable();
    names.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

impl Iso<'_> {
    /// Gives a subprogram its parameters; returns what is kept for the caller. Else why the call cannot be followed.
    pub(crate) fn enter_subprogram(
        &mut self,
        with: With,
        (file, start): (u16, u32),
        running: &Running<'_>,
    ) -> Result<Box<Level>, String> {
        let called = self.flow.trail.as_ref().and_then(|trail| trail.library.file(file));
        let program = called.as_ref().map_or(running.main, |called| &called.program);
        let own = &mut self.memory.own;
        let proc = Proc::of(program, start, own);
        let has_proc = proc.is_some();
        let (parameters, saves) = proc.map_or((Vec::new(), false), |proc| (proc.parameters, proc.saves));
        let given = with.arguments.len();
        if given > parameters.len() {
            let (arguments, them) = if given == 1 {
                ("argument", "it")
            } else {
                ("arguments", "them")
            };
            let declares = if has_proc {
                format!("whose PROC declares {}", parameters.len())
            } else {
                format!("that has no PROC to take {them}")
            };
            return Err(format!("{given} {arguments} for a subprogram {declares}"));
        }
        if let Some(twice) = handed_over_twice(&parameters, &with.arguments) {
            return Err(format!(
                "`{twice}` is handed over to two parameters with VAR: what one writes, the other reads"
            ));
        }
        let saved = saves.then(|| self.saved());
        let own = &mut self.memory.own;
        let scope = own.begin_scope();
        let in_modal = own.in_modal;
        own.in_modal |= with.is_modal;
        own.levels += 1;
        let mut level = Level {
            in_modal,
            scope,
            references: Vec::new(),
            parameters: Vec::new(),
            saved,
        };
        let mut given = with.arguments.into_iter();
        for parameter in parameters {
            let argument = given.next();
            let written = argument.as_ref().filter(|argument| !argument.is_left_out);
            let value = written.map_or(parameter.initial, |argument| argument.value);
            let variable = argument.as_ref().and_then(|argument| argument.variable.clone());
            let sort = if let Some(sizes) = &parameter.sizes {
                own.declare(&parameter.name, Sort::Other, None);
                if let Some(variable) = &variable {
                    own.copy_field(&level.scope, variable, (&parameter.name, parameter.sort, sizes));
                }
                Sort::Other
            } else {
                own.declare(&parameter.name, parameter.sort, value);
                if let Some((kind, first)) = &parameter.of_text {
                    let text = written.map_or(first, |argument| &argument.text);
                    own.hand_text(kind, &parameter.name, text.as_deref());
                }
                parameter.sort
            };
            if let (true, Some(variable)) = (parameter.by_reference, variable) {
                level.references.push((parameter.name.clone(), variable));
            }
            level.parameters.push((parameter.name, sort));
        }
        own.begin_block();
        Ok(Box::new(level))
    }

    /// A subprogram has returned: the caller's variables are back, and what SAVE keeps; a fault where that is not known.
    pub(crate) fn leave_subprogram(&mut self, level: Level, block: BlockId) -> Option<FaultKind> {
        let own = &mut self.memory.own;
        let used = own.end_scope(level.scope);
        own.levels = own.levels.saturating_sub(1);
        own.in_modal = level.in_modal;
        for (here, there) in &level.references {
            if !own.copy_back(&used, here, there) && !own.copy_text_back(&used, here, there) {
                own.assign(there, used.value(here));
            }
        }
        own.begin_block();
        let saved = level.saved?;
        self.bring_back(&saved, block)
    }

    /// RET or M17 of the main program.
    pub(crate) fn leave_main_program(&mut self, back: &Back, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        // without a program end of its own the file is a subprogram that is run alone
        let ends = |block: Block<'_>| {
            let is_end = |word: Word| {
                let number = match word.value {
                    Value::Number(number) => number.to_f64(),
                    _ => return false,
                };
                word.address == Address::Letter(b'M') && (number == 2.0 || number == 30.0)
            };
            block.words().any(is_end)
        };
        if running.program().blocks().any(ends) {
            let name = running.program().text(back.range).trim().to_ascii_uppercase();
            let what = format!("{name} in the main program: taken as its end");
            self.tell_of_flow(running, from, (back.range, FaultKind::NotModelled { what }), sink);
        }
        self.stop();
    }

    /// A subprogram ends without M17 or RET.
    pub(crate) fn subprogram_runs_out(&mut self, main: &Program, sink: &mut impl Sink) {
        let Some(trail) = &self.flow.trail else { return };
        let (place, called) = (trail.course.place(), trail.called());
        let running = Running {
            main,
            called: called.as_deref(),
        };
        let last = self
            .flow
            .next
            .min(running.program().block_count() as u32)
            .saturating_sub(1);
        let range = running.program().block(BlockId(last)).range();
        if self.core.dialect.quirks.user_task() {
            let what = "a subprogram that ends without RTS".to_owned();
            self.tell_of_flow(&running, last, (range, FaultKind::NotDecided { what }), sink);
            return self.stop();
        }
        let what = "a subprogram that ends without M17 or RET: taken as its return".to_owned();
        if place.file == 0 {
            sink.fault(Fault {
                place: None,
                block: BlockId(last),
                range,
                kind: FaultKind::NotModelled { what },
            });
        } else {
            self.tell_of_flow(&running, last, (range, FaultKind::NotModelled { what }), sink);
        }
        self.leave(Back { label: None, range }, &running, last, sink);
    }
}
