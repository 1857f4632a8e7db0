//! What is run.
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_machine::Machine;
use trunnion_syntax::Program;

/// A program with everything it is run with.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    /// The program.
    pub program: &'a Program,
    /// Its dialect.
    pub dialect: &'a Dialect,
    /// Tools, offsets, parameters of the control, called programs.
    pub setup: &'a Setup,
    /// The machine; without one, programmed coordinates are compared.
    pub machine: Option<&'a Machine>,
}
