//! Tests of the interpreter through its public interface.
mod cycles_oracle;
mod listing;
