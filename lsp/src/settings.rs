//! What the client wants: machine and dialect, from `initializationOptions` or `workspace/didChangeConfiguration`.
use serde_json::Value;
use trunnion_workspace::Overrides;

/// Reads `{ "machine": .., "dialect": .. }`, also inside `"trunnion"`; empty texts mean "not set".
pub(crate) fn overrides(value: &Value) -> Overrides {
    let own = value.get("trunnion").unwrap_or(value);
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
