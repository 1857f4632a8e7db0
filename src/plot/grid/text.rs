//! Texts on a field and beside it.
use super::Panel;
use crate::canvas::{INK, PlotError, anchored, px};
use crate::labels::Wish;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

impl Panel<'_> {
    /// A text that may be outside the field.
    pub(crate) fn write_outside(&self, (x, y): (f64, f64), text: &str, (h, v): (HPos, VPos)) -> Result<(), PlotError> {
        let style = anchored(13.0, h, v).color(&INK);
        self.around
            .draw(&Text::new(text.to_owned(), self.beside((x, y)), style))?;
        Ok(())
    }

    /// A text in its own style.
    pub(crate) fn write(&self, (x, y): (f64, f64), text: &str, style: TextStyle<'static>) -> Result<(), PlotError> {
        let p = self.at(x, y);
        if self.holds(p) {
            self.area.draw(&Text::new(text.to_owned(), Self::whole(p), style))?;
        }
        Ok(())
    }

    /// A text anchored so many pixels from a position, moved so far that it lies on the field.
    pub(crate) fn write_inside(
        &self,
        (x, y): (f64, f64),
        off: (f64, f64),
        text: &str,
        (size, h, v): (f64, HPos, VPos),
    ) -> Result<(), PlotError> {
        let p = self.at(x, y);
        let (wide, tall) = (
            f64::from(px(0.56 * size)) * text.chars().count() as f64,
            f64::from(px(1.1 * size)),
        );
        let [left, right] = match h {
            HPos::Left => [0.0, wide],
            HPos::Center => [0.5 * wide, 0.5 * wide],
            HPos::Right => [wide, 0.0],
        };
        let [above, below] = match v {
            VPos::Top => [0.0, tall],
            VPos::Center => [0.5 * tall, 0.5 * tall],
            VPos::Bottom => [tall, 0.0],
        };
        let at = (
            (p.0 + f64::from(px(off.0))).min(self.width - right).max(left),
            (p.1 + f64::from(px(off.1))).min(self.height - below).max(above),
        );
        let style = anchored(size, h, v).color(&INK);
        self.area.draw(&Text::new(text.to_owned(), Self::whole(at), style))?;
        Ok(())
    }

    /// A text next to a position, where it covers no other one: if not at the side that is asked for, at another. Left out where there
    /// is no room, and outside of the field. `symbol`: the radius of what stands at the position, pixels.
    pub(crate) fn text(
        &self,
        (x, y): (f64, f64),
        text: &str,
        colour: RGBColor,
        side: (HPos, VPos),
        symbol: f64,
    ) -> Result<(), PlotError> {
        let p = self.at(x, y);
        if !self.holds(p) {
            return Ok(());
        }
        let wish = Wish {
            point: p,
            side,
            off: f64::from(px(symbol + 4.0)),
            size: (f64::from(px(7.2)) * text.chars().count() as f64, f64::from(px(15.0))),
        };
        let Some(((h, v), from)) = self.labels.take(&wish, (self.width, self.height)) else {
            return Ok(());
        };
        let style = anchored(13.0, h, v).color(&colour);
        let at = Self::whole((from, p.1));
        self.area.draw(&Text::new(text.to_owned(), at, style))?;
        Ok(())
    }

    /// No text that asks for a free place covers what is drawn there with this radius.
    pub(crate) fn keep_free(&self, (x, y): (f64, f64), pixels: f64) {
        let (p, radius) = (self.at(x, y), f64::from(px(pixels)));
        self.labels
            .keep_free([p.0 - radius, p.1 - radius, p.0 + radius, p.1 + radius]);
    }

    /// A text in the upper right corner.
    pub(crate) fn note(&self, text: &str) -> Result<(), PlotError> {
        let at = Self::whole((self.width - f64::from(px(6.0)), f64::from(px(4.0))));
        let style = anchored(13.0, HPos::Right, VPos::Top).color(&INK);
        self.area.draw(&Text::new(text.to_owned(), at, style))?;
        Ok(())
    }
}
