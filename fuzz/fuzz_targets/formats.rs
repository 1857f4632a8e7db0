//! Any bytes as each file beside a program: a machine, settings, a dialect table, a certificate, a surface, an STL, an INI file, a FreeCAD
//! machine. Each is read or refused; nothing panics.
#![no_main]
#![allow(dead_code)]
use libfuzzer_sys::fuzz_target;

#[path = "../targets.rs"]
mod targets;

fuzz_target!(|data: &[u8]| targets::formats(data));
