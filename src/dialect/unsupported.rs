//! Controls whose programs are recognised and not read: they get one finding, and no guess.

/// A control whose programs are recognised and not read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unsupported {
    /// `okuma-osp`, a name like those of the built-in dialects.
    pub name: &'static str,
    /// For people.
    pub title: &'static str,
}

/// All of them.
pub const UNSUPPORTED: &[Unsupported] = &[
    Unsupported {
        name: "heidenhain-iso",
        title: "HEIDENHAIN DIN/ISO",
    },
    Unsupported {
        name: "okuma-osp-lathe",
        title: "Okuma OSP, lathe",
    },
    Unsupported {
        name: "centroid",
        title: "Centroid",
    },
    Unsupported {
        name: "eding",
        title: "Eding CNC",
    },
    Unsupported {
        name: "fagor",
        title: "Fagor",
    },
    Unsupported {
        name: "fadal",
        title: "Fadal CNC 88",
    },
    Unsupported {
        name: "acramatic",
        title: "Acramatic (Cincinnati)",
    },
    Unsupported {
        name: "num",
        title: "NUM (1020, 1040, 1060, Flexium)",
    },
    Unsupported {
        name: "brother",
        title: "Brother (CNC-B00, C00, D00)",
    },
    Unsupported {
        name: "isg",
        title: "an ISG kernel (Beckhoff and others)",
    },
    Unsupported {
        name: "planetcnc",
        title: "PlanetCNC",
    },
    Unsupported {
        name: "fluidnc",
        title: "FluidNC",
    },
    Unsupported {
        name: "sender-macro",
        title: "a sender (gSender, CNCjs), which works out the macro before grbl reads it",
    },
    Unsupported {
        name: "sinumerik-iso",
        title: "SINUMERIK in an ISO dialect (G291)",
    },
    Unsupported {
        name: "wire-edm",
        title: "wire EDM (Accutex, Agie, Charmilles, Fanuc, Sodick and the like)",
    },
    Unsupported {
        name: "apt-source",
        title: "APT source: a part program before the APT processor, whose CL data can be checked",
    },
    Unsupported {
        name: "marlin",
        title: "Marlin, RepRapFirmware and other 3D printers",
    },
];

/// The one with this name.
pub fn unsupported(name: &str) -> Option<&'static Unsupported> {
    UNSUPPORTED.iter().find(|control| control.name == name)
}
