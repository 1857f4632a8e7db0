//! Tests of the interpreter through its public interface.
mod blocks_oracle;
mod cycles_oracle;
mod definitions;
mod flow_oracle;
mod flow_run;
mod listing;
mod setup_files;
mod unknown_start;
