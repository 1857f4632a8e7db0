//! What the formulas of both grammars are worth.
mod hostile;
mod macro_b;
mod properties;
mod rs274;
mod support;
