//! Any bytes as each file beside a program: a machine, settings, a dialect table, a certificate, a surface, an STL, an INI file, a FreeCAD
//! machine. Each is read or refused; nothing panics.
#![no_main]
use libfuzzer_sys::fuzz_target;
use trunnion_certify::Certificate;
use trunnion_check::Config;
use trunnion_dialect::Dialect;

fuzz_target!(|data: &[u8]| {
    let Some((&format, bytes)) = data.split_first() else { return };
    if format % 8 == 5 {
        let _ = trunnion_surface::required_stl(bytes);
        return;
    }
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match format % 8 {
        0 => drop(trunnion_machine::load("m", text)),
        1 => drop(Config::parse(text)),
        2 => drop(Dialect::from_table(text, "t")),
        3 => drop(Certificate::from_json(text)),
        4 => drop(trunnion_surface::required(text, false, 0.001)),
        6 => drop(trunnion_machine::import_linuxcnc("m.ini", text, &[])),
        _ => drop(trunnion_machine::import_freecad("m.fcm", text)),
    }
});
