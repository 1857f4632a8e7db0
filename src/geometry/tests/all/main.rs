//! Tests of this floor.
mod routes;
