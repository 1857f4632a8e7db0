//! Floor 0: expressions of RS274/NGC and of Fanuc's Macro B: compiled once, evaluated many times.
