//! How coordinates are written.
use crate::Plane;

/// Plane, distance mode and unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates {
    plane: Plane,
    incremental: bool,
    arc_centre_absolute: bool,
    unit_programmed: bool,
    unit_mm: f64,
}

impl Coordinates {
    /// Absolute coordinates in mm, incremental arc centres.
    pub fn new(plane: Plane) -> Self {
        Self {
            plane,
            incremental: false,
            arc_centre_absolute: false,
            unit_programmed: false,
            unit_mm: 1.0,
        }
    }
    /// Plane.
    pub fn plane(&self) -> Plane {
        self.plane
    }
    /// G91.
    pub fn incremental(&self) -> bool {
        self.incremental
    }
    /// Arc centres are absolute.
    pub fn arc_centre_absolute(&self) -> bool {
        self.arc_centre_absolute
    }
    /// The program or the setup has set whether lengths are mm or inch.
    pub fn unit_programmed(&self) -> bool {
        self.unit_programmed
    }
    /// mm per programmed length unit: 1 or 25.4.
    pub fn unit_mm(&self) -> f64 {
        self.unit_mm
    }
    /// The programmed length unit is the inch.
    pub fn is_inch(&self) -> bool {
        self.unit_mm > 1.0
    }
    /// G17, G18, G19.
    pub fn set_plane(&mut self, plane: Plane) {
        self.plane = plane;
    }
    /// G90, G91.
    pub fn set_incremental(&mut self, on: bool) {
        self.incremental = on;
    }
    /// G90.1, G91.1.
    pub fn set_arc_centre_absolute(&mut self, on: bool) {
        self.arc_centre_absolute = on;
    }
    /// G20, G21, mm per unit; or the control's own unit, which no program has chosen.
    pub(super) fn set_unit(&mut self, unit_mm: f64, programmed: bool) {
        (self.unit_mm, self.unit_programmed) = (unit_mm, programmed);
    }
}
