//! Required surfaces on real machines.
mod saddle;
