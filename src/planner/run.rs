//! From one stop to the next.
use crate::passes::Passes;
use crate::section::Section;
use crate::{Piece, Ramp};
use core::ops::Range;

/// The pieces between two stops.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// In order.
    pub pieces: Vec<Piece>,
    /// Blocks that the control looks ahead; `None`: all.
    pub lookahead: Option<u32>,
    /// Length of the control's own filter, s.
    pub filter: f64,
    /// The filter of long sections.
    pub long: Option<Long>,
    /// Where these are not the first pieces after the stop: how they begin.
    pub begun: Option<Begun>,
}

/// From a number of motions on, the filter of a section is not searched but given, so that it can be planned before its end is known.
#[derive(Clone, Copy, Debug)]
pub struct Long {
    /// From so many motions between two planned stops on.
    pub motions: u32,
    /// The length of the filter that limits the jerk, s.
    pub filter: f64,
}

/// How the rest of a run begins whose first pieces are planned already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Begun {
    /// Optimistic and planned speed, mm/s.
    pub speeds: [f64; 2],
    /// The length of the filter that limits the jerk of the section that has begun, s; `None` where a section begins.
    pub filter: Option<f64>,
}

/// What limits the jerk of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Smooth {
    /// A filter of this length, s. At a stop it is part of the piece's time.
    Filter(f64),
    /// It is part of one move in closed form: how long that accelerates evenly, and how long its acceleration changes, s.
    OneMove([f64; 2]),
}

/// What a run takes: one entry for each piece.
#[derive(Clone, Debug, Default)]
pub struct Planned {
    /// Each piece as planned.
    pub ramps: Vec<Ramp>,
    /// Planned and optimistic time of each piece, s.
    pub seconds: Vec<[f64; 2]>,
    /// What limits its jerk.
    pub smooth: Vec<Smooth>,
}

impl Run {
    /// Plans it. It ends with a stop, and begins with one where nothing is planned yet.
    pub fn plan(&self) -> Planned {
        let mut planned = Planned::default();
        if self.pieces.is_empty() {
            return planned;
        }
        let optimistic = self.free().ramps();
        for range in self.sections() {
            self.section(range.clone()).plan(&optimistic[range], &mut planned);
        }
        planned
    }

    /// The pieces with all of the acceleration for either purpose.
    fn free(&self) -> Passes<'_> {
        let level = |piece: &Piece| [piece.optimistic.cap, piece.optimistic.acceleration];
        Passes {
            pieces: &self.pieces,
            levels: self.pieces.iter().map(level).collect(),
            side: 0,
            lookahead: None,
            first: self.begun.map_or(0.0, |begun| begun.speeds[0]),
        }
    }

    /// The pieces between planned stops.
    fn sections(&self) -> impl Iterator<Item = Range<usize>> {
        let mut from = 0;
        core::iter::from_fn(move || {
            let rest = self.pieces.get(from + 1..)?;
            let stop = rest.iter().position(|piece| piece.entry[1] <= 0.0);
            let to = stop.map_or(self.pieces.len(), |stop| from + 1 + stop);
            Some(core::mem::replace(&mut from, to)..to)
        })
    }

    fn section(&self, range: Range<usize>) -> Section<'_> {
        let begun = self.begun.filter(|begun| range.start == 0 && begun.filter.is_some());
        let mut section = Section {
            pieces: &self.pieces[range],
            lookahead: self.lookahead,
            own_filter: self.filter,
            filter: begun.and_then(|begun| begun.filter),
            begins: begun.map(|begun| begun.speeds[1]),
        };
        if section.filter.is_none() {
            let long = self.long.filter(|long| section.motions() >= long.motions);
            section.filter = long.map(|long| long.filter);
        }
        section
    }

    /// How many pieces are planned as they will be whatever follows, up to `most`, and how the rest begins: before it lies a planned stop, or in a
    /// section whose filter is given a corner from which the control could even stop within what it knows. `None` where there is no such place.
    pub(crate) fn settled(&self, most: usize) -> Option<(usize, Begun)> {
        let free = self.free();
        let open = self.sections().last()?;
        let (first, section) = (open.start, self.section(open));
        let given = section.filter.map(|filter| (filter, section.passes(filter)));
        let inside = given.as_ref().map(|(_, passes)| passes.settled());
        let outside = free.settled();
        let begins = |index: usize| self.pieces[index - 1].motion != self.pieces[index].motion;
        let (mut index, mut seen) = (self.pieces.len(), 0);
        loop {
            index = index.checked_sub(1).filter(|index| *index > 0)?;
            if !begins(index) {
                continue;
            }
            seen += 1;
            let looked = self.lookahead.is_none_or(|blocks| seen > blocks);
            if !(looked && index <= most && outside[index]) {
                continue;
            }
            let free = free.speeds()[index];
            if self.pieces[index].entry[1] <= 0.0 {
                let speeds = [free, 0.0];
                return Some((index, Begun { speeds, filter: None }));
            }
            let Some(within) = index.checked_sub(first) else {
                continue;
            };
            if let Some(((filter, passes), settled)) = given.as_ref().zip(inside.as_ref())
                && settled[within]
            {
                let speeds = [free, passes.speeds()[within]];
                let filter = Some(*filter);
                return Some((index, Begun { speeds, filter }));
            }
        }
    }
}
