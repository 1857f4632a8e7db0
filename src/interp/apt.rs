//! APT / CL records to motions.
