//! What the client wants: machine and dialect, what is shown between the lines, from `initializationOptions` or
//! `workspace/didChangeConfiguration`.
use serde_json::Value;
use trunnion_workspace::Overrides;

/// What is shown in addition to the text; each can be switched off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shown {
    /// Values of expressions: `trunnion.hints.values`.
    pub(crate) values: bool,
    /// What is in effect where a tool begins: `trunnion.hints.modal`.
    pub(crate) modal: bool,
    /// The time of an operation above it: `trunnion.codeLens`.
    pub(crate) lens: bool,
    /// The client has the commands of the VS Code extension: `commands`.
    pub(crate) commands: bool,
    /// Findings are sent without being asked for: not with `trunnion.diagnosticMode` `pull`.
    pub(crate) push: bool,
}

impl Default for Shown {
    fn default() -> Self {
        Self {
            values: true,
            modal: true,
            lens: true,
            commands: false,
            push: true,
        }
    }
}

fn own(value: &Value) -> &Value {
    value.get("trunnion").unwrap_or(value)
}

/// Reads `{ "machine": .., "dialect": .. }`, also inside `"trunnion"`; empty texts mean "not set".
pub(crate) fn overrides(value: &Value) -> Overrides {
    let own = own(value);
    let text = |key: &str| {
        let text = own.get(key).and_then(Value::as_str).map(str::trim);
        text.filter(|t| !t.is_empty()).map(str::to_owned)
    };
    Overrides {
        machine: text("machine"),
        dialect: text("dialect"),
        tool: text("tool"),
        ..Overrides::default()
    }
}

/// Reads `{ "hints": { "values": .., "modal": .. }, "codeLens": .., "diagnosticMode": .., "commands": .. }`; what is missing is on, but for the commands.
pub(crate) fn shown(value: &Value) -> Shown {
    let own = own(value);
    let on = |value: Option<&Value>| value.and_then(Value::as_bool).unwrap_or(true);
    let hint = |key: &str| on(own.get("hints").and_then(|hints| hints.get(key)));
    Shown {
        values: hint("values"),
        modal: hint("modal"),
        lens: on(own.get("codeLens")),
        commands: own.get("commands").and_then(Value::as_bool).unwrap_or(false),
        push: own.get("diagnosticMode").and_then(Value::as_str) != Some("pull"),
    }
}
