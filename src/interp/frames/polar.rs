//! G16: the plane's first coordinate is a radius from the zero point, its second an angle.
use crate::arc::plane_axes;
use crate::words::Words;
use crate::{ModalState, Position};
use trunnion_geometry::math::sin_cos;

/// What was given last; `None`: unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Polar {
    radius: Option<f64>,
    degrees: Option<f64>,
}

impl Polar {
    /// The last radius and angle, NaN where unknown.
    pub(crate) fn last(&self) -> [f64; 2] {
        [self.radius, self.degrees].map(|value| value.unwrap_or(f64::NAN))
    }
    /// Puts the position that the words give into `end`. An incremental radius starts from the present position, which makes a new
    /// centre; that is not followed.
    pub(crate) fn place(&mut self, words: &Words, state: &ModalState, end: &mut Position) {
        let [a, b, _] = plane_axes(state.coordinates.plane());
        let said = words.axes.given | words.axes.unread;
        if said & ((1 << a) | (1 << b)) == 0 {
            return;
        }
        if said & (1 << a) != 0 {
            let radius = words.axes.get(a).filter(|_| !state.coordinates.incremental());
            self.radius = radius.map(|radius| radius * state.coordinates.unit_mm());
        }
        if said & (1 << b) != 0 {
            self.degrees = match (words.axes.get(b), state.coordinates.incremental()) {
                (Some(angle), true) => self.degrees.map(|degrees| degrees + angle),
                (angle, _) => angle,
            };
        }
        if let (Some(radius), Some(degrees)) = (self.radius, self.degrees) {
            let (sin, cos) = sin_cos(degrees.to_radians());
            end.set(a, radius * cos);
            end.set(b, radius * sin);
        } else {
            end.forget(a);
            end.forget(b);
        }
    }
}
