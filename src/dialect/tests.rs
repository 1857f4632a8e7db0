//! Tests of the tables and of what reads them.
mod controls;
mod detection;
mod hostile;
mod lathes;
mod tables;
