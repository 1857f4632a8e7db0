//! Floor 2: what a LinuxCNC program does, to the letter: bytes to canonical calls, or to the error the control gives.
