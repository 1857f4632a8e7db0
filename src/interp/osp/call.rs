//! Subprograms: their arguments are local variables that RTS clears.
use crate::Argument;
use crate::flow::{Calling, With as FlowWith};
use crate::iso::Iso;
use crate::own::{Own, Scope, Sort};
use std::collections::HashSet;
use trunnion_flow::Key;

/// What a call hands over.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct With {
    /// Names in lower case; `None`: a value that is not known.
    pub(super) arguments: Vec<(Box<str>, Option<f64>)>,
    /// MODIN calls it.
    pub(super) modal: bool,
}

/// What is stored for a call.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    scope: Scope,
    written: HashSet<Box<str>>,
    arguments: Vec<(Box<str>, Option<f64>)>,
    in_modal: bool,
}

/// Declares the arguments of a call as local variables.
fn hand_over(own: &mut Own, arguments: &[(Box<str>, Option<f64>)]) {
    for (name, value) in arguments {
        own.declare(name, Sort::Real, *value);
    }
    own.task.written.clear();
    own.begin_block();
}

impl Level {
    /// The subprogram starts again. Whether its arguments have their first values then is not stated, so those that it has written are unknown.
    pub(crate) fn again(&mut self, own: &mut Own) {
        let written = std::mem::take(&mut own.task.written);
        own.begin_scope();
        let kept = |(name, value): &(Box<str>, Option<f64>)| (name.clone(), value.filter(|_| !written.contains(name)));
        self.arguments = self.arguments.iter().map(kept).collect();
        hand_over(own, &self.arguments);
    }
}

impl Iso<'_> {
    /// Gives a subprogram its arguments; returns what is kept for the caller.
    pub(crate) fn enter_task(&mut self, with: With) -> Level {
        let own = &mut self.memory.own;
        let scope = own.begin_scope();
        #[expect(clippy::disallowed_methods, reason = "they go into an ordered set")]
        let names = scope.sorts.keys().cloned().collect();
        own.task.outer.push(names);
        let level = Level {
            scope,
            written: std::mem::take(&mut own.task.written),
            arguments: with.arguments,
            in_modal: own.task.in_modal,
        };
        own.task.in_modal |= with.modal;
        hand_over(own, &level.arguments);
        level
    }

    /// A subprogram has returned: the caller's variables are back.
    pub(crate) fn leave_task(&mut self, level: Level) {
        let own = &mut self.memory.own;
        own.end_scope(level.scope);
        own.task.outer.pop();
        own.task.written = level.written;
        own.task.in_modal = level.in_modal;
        own.begin_block();
    }

    /// The call of MODIN that is in effect: what a program that is missing is called with.
    pub(crate) fn modal_task_data(&self) -> Vec<Argument> {
        let Some((calling, _)) = &self.memory.own.task.modal else {
            return Vec::new();
        };
        let program = match &calling.program {
            Key::Number(number) => number.to_string(),
            Key::Name(name) => name.to_string(),
        };
        let mut data = vec![Argument::text("MODIN", &program)];
        if let FlowWith::Task(with) = &calling.with {
            data.extend(with.arguments.iter().map(|(name, value)| match value {
                Some(value) => Argument::number(format!("MODIN {name}"), *value),
                None => Argument::text(format!("MODIN {name}"), "unknown"),
            }));
        }
        data
    }

    /// The call of MODIN after a block that has moved; else why it cannot be followed.
    pub(crate) fn modal_task(&self) -> Option<Result<Calling, String>> {
        if !self.memory.own.is_task {
            return self.modal_subprogram();
        }
        let task = &self.memory.own.task;
        let (calling, depth) = task.modal.as_ref().filter(|_| !task.in_modal)?;
        if *depth != task.outer.len() {
            return Some(Err(
                "whether MODIN of the calling program acts in a subprogram".to_owned()
            ));
        }
        Some(Ok(calling.clone()))
    }
}
