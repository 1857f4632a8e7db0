//! Conversions: to each control and back, between machines, refusals, properties.
mod code;
mod support;
