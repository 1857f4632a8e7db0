//! Where texts stand on a field: none covers another one or runs off the field.
use core::cell::RefCell;
use plotters::style::text_anchor::{HPos, VPos};

/// Left, top, right, bottom.
type Place = [f64; 4];

/// The texts of a field so far.
#[derive(Default)]
pub(crate) struct Labels(RefCell<Vec<Place>>);

/// A text that wants a place next to a point.
pub(crate) struct Wish {
    pub(crate) point: (f64, f64),
    /// The side of the point where it stands best.
    pub(crate) side: (HPos, VPos),
    /// Distance across from the point: a symbol stands there.
    pub(crate) off: f64,
    /// Width and height of the text.
    pub(crate) size: (f64, f64),
}

impl Labels {
    /// No text stands there.
    pub(crate) fn keep_free(&self, place: Place) {
        self.0.borrow_mut().push(place);
    }

    /// Takes a place on a field of this size: at the side that is asked for, else at another one. The side, and where the text is anchored across; `None`
    /// where there is no room.
    pub(crate) fn take(&self, wish: &Wish, field: (f64, f64)) -> Option<((HPos, VPos), f64)> {
        let (h, v) = wish.side;
        let across = match h {
            HPos::Left => HPos::Right,
            HPos::Right => HPos::Left,
            HPos::Center => HPos::Center,
        };
        let up = match v {
            VPos::Top => VPos::Bottom,
            VPos::Bottom => VPos::Top,
            VPos::Center => VPos::Center,
        };
        let mut taken = self.0.borrow_mut();
        let is_free = |of: &Place| {
            let inside = of[0] >= 0.0 && of[1] >= 0.0 && of[2] <= field.0 && of[3] <= field.1;
            let apart =
                |other: &Place| of[2] <= other[0] || other[2] <= of[0] || of[3] <= other[1] || other[3] <= of[1];
            inside && taken.iter().all(apart)
        };
        let sides = [(h, v), (h, up), (across, v), (across, up)];
        let (side, anchor, place) = sides
            .into_iter()
            .map(|side| wish.at(side))
            .find(|(_, _, place)| is_free(place))?;
        taken.push(place);
        Some((side, anchor))
    }
}

impl Wish {
    fn at(&self, side: (HPos, VPos)) -> ((HPos, VPos), f64, Place) {
        let ((x, y), (width, height)) = (self.point, self.size);
        let (left, anchor) = match side.0 {
            HPos::Left => (x + self.off, x + self.off),
            HPos::Right => (x - self.off - width, x - self.off),
            HPos::Center => (x - 0.5 * width, x),
        };
        let top = match side.1 {
            VPos::Top => y,
            VPos::Center => y - 0.5 * height,
            VPos::Bottom => y - height,
        };
        (side, anchor, [left, top, left + width, top + height])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_give_way_to_each_other_and_stay_on_the_field() {
        let labels = Labels::default();
        let take = |x: f64, y: f64| {
            let wish = Wish {
                point: (x, y),
                side: (HPos::Right, VPos::Bottom),
                off: 5.0,
                size: (40.0, 10.0),
            };
            labels
                .take(&wish, (200.0, 100.0))
                .map(|((h, v), _)| (matches!(h, HPos::Right), matches!(v, VPos::Bottom)))
        };
        assert_eq!(take(100.0, 50.0), Some((true, true)));
        // the same place again: below, then at the other side, then nowhere
        assert_eq!(take(100.0, 50.0), Some((true, false)));
        assert_eq!(take(100.0, 50.0), Some((false, true)));
        assert_eq!(take(100.0, 50.0), Some((false, false)));
        assert_eq!(take(100.0, 50.0), None);
        // at the edges
        assert_eq!(take(3.0, 80.0), Some((false, true)));
        assert_eq!(take(199.0, 4.0), Some((true, false)));
    }
}
