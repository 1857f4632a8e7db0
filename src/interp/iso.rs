//! ISO blocks to motions.
