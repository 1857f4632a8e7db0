//! G5, G5.1 and G5.2-G5.3: splines of the XY plane as NURBS.
//!
//! A cubic or quadratic spline is a Bezier curve (its control points by Bezier's definition, all weights 1, clamped knots); G5.2 lists
//! control points with weights, order L, knots uniform and clamped at both ends (Piegl, Tiller: The NURBS Book, 2.2 and 4.2).
use super::{Work, problems};
use crate::{Canon, Error, FeedMode, Pose, Side, exec};
use std::sync::Arc;

/// What is kept between the lines of splines.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spline {
    /// Control points of G5.2 so far: x, y, weight.
    points: Vec<[f64; 3]>,
    order: u32,
    /// A control point was refused.
    incomplete: bool,
    /// Where the last G5 ended and the direction in which it arrived: minus its P and Q.
    tail: Option<(Pose, [f64; 2])>,
}

impl Spline {
    /// The control points so far.
    pub(crate) fn points(&self) -> &[[f64; 3]] {
        &self.points
    }
}

/// What G5 and G5.1 need. Motion codes of splines do not stay in effect.
fn check(work: &mut Work<'_>) -> Result<(), Error> {
    let block = work.block;
    let state = &work.engine.state;
    if state.side != Side::Off {
        return Err(work.refuse(&problems::SPLINE_COMPENSATED));
    }
    match state.feed_mode {
        FeedMode::InverseTime if !block.has(b'F') => return Err(work.refuse(&problems::SPLINE_INVERSE)),
        FeedMode::PerMinute if state.feed_rate == 0.0 => return Err(work.refuse(&problems::SPLINE_FEED)),
        // observed: under G95 no rate is required
        _ => {}
    }
    if state.plane != crate::Plane::Xy {
        return Err(work.refuse(&problems::SPLINE_PLANE));
    }
    if let Some(&letter) = b"ZABC".iter().find(|&&letter| block.has(letter)) {
        return Err(Error::new(&problems::SPLINE_AXES, block.range_of(letter)));
    }
    Ok(())
}

/// Emits a Bezier curve by its control points, weights 1.
fn bezier(work: &mut Work<'_>, points: &[[f64; 2]], end: Pose) -> Result<(), Error> {
    if !work.engine.spline.points.is_empty() {
        return Err(work.refuse(&problems::OPEN));
    }
    let order = points.len();
    let mut knots = vec![0.0; order];
    knots.resize(2 * order, 1.0);
    // the motion code in effect stays
    work.engine.state.current = end;
    work.emit(Canon::Nurbs {
        order: order as u32,
        points: points.iter().map(|point| [point[0], point[1], 1.0]).collect(),
        knots: Arc::from(knots),
        end,
    });
    Ok(())
}

/// G5.
pub(super) fn cubic(work: &mut Work<'_>) -> Result<(), Error> {
    check(work)?;
    let block = work.block;
    if block.has(b'I') != block.has(b'J') {
        return Err(work.refuse(&problems::IJ_BOTH_G5));
    }
    let (Some(p), Some(q)) = (block.word(b'P'), block.word(b'Q')) else {
        return Err(work.refuse(&problems::PQ_G5));
    };
    let start = work.engine.state.current;
    let tail = work.engine.spline.tail.filter(|(end, _)| *end == start);
    let [i, j] = match (block.word(b'I'), block.word(b'J')) {
        (Some(i), Some(j)) => [i, j],
        _ => tail.map_or([0.0; 2], |(_, tangent)| tangent),
    };
    let end = exec::end_of(&work.engine.state, block)?;
    let points = [
        [start[0], start[1]],
        [start[0] + i, start[1] + j],
        [end[0] + p, end[1] + q],
        [end[0], end[1]],
    ];
    bezier(work, &points, end)?;
    work.engine.spline.tail = Some((end, [-p, -q]));
    Ok(())
}

/// G5.1.
pub(super) fn quadratic(work: &mut Work<'_>) -> Result<(), Error> {
    check(work)?;
    let (Some(i), Some(j)) = (work.block.word(b'I'), work.block.word(b'J')) else {
        return Err(work.refuse(&problems::IJ_G5_1));
    };
    let start = work.engine.state.current;
    let end = exec::end_of(&work.engine.state, work.block)?;
    let points = [[start[0], start[1]], [start[0] + i, start[1] + j], [end[0], end[1]]];
    bezier(work, &points, end)
}

/// G5.2 and the lines after it: one control point.
pub(super) fn point(work: &mut Work<'_>) -> Result<(), Error> {
    let result = add_point(work);
    work.engine.spline.incomplete |= result.is_err();
    result
}

fn add_point(work: &mut Work<'_>) -> Result<(), Error> {
    let block = work.block;
    let continued = work.engine.state.motion == 52;
    if !continued {
        work.engine.spline.points.clear();
        work.engine.spline.order = 3;
    }
    if let Some(order) = block.word(b'L') {
        // observed: the last one above 3 is used
        let order = order as u32;
        if order > 3 {
            work.engine.spline.order = order;
        }
    }
    let both = block.has(b'X') && block.has(b'Y');
    let one = block.has(b'X') != block.has(b'Y');
    if one {
        return Err(work.refuse(&problems::NURBS_POINT));
    }
    // observed: under G93 and G95 none is required
    let state = &work.engine.state;
    if state.feed_mode == FeedMode::PerMinute && state.feed_rate == 0.0 {
        return Err(work.refuse(&problems::NURBS_FEED));
    }
    // the first line may leave P out (the control marks that by -1), and takes any other one
    let absent = if continued { -1.0 } else { 1.0 };
    let weight = block
        .word(b'P')
        .filter(|&weight| continued || weight != -1.0)
        .unwrap_or(absent);
    if continued && weight <= 0.0 {
        let range = if block.has(b'P') {
            block.range_of(b'P')
        } else {
            block.range
        };
        return Err(Error::new(&problems::NURBS_WEIGHT, range));
    }
    if continued && !both {
        return Err(work.refuse(&problems::NURBS_FIRST));
    }
    if work.engine.state.side != Side::Off {
        return Err(work.refuse(&problems::NURBS_COMPENSATED));
    }
    let start = work.engine.state.current;
    if !continued {
        let weight = if both { 1.0 } else { weight };
        work.engine.spline.points.push([start[0], start[1], weight]);
    }
    if both {
        // in incremental mode all points are measured from the start of the curve
        let end = exec::end_of(&work.engine.state, block)?;
        work.engine.spline.points.push([end[0], end[1], weight]);
    }
    work.engine.state.motion = 52;
    Ok(())
}

/// G5.3: the curve is complete.
pub(super) fn finish(work: &mut Work<'_>) -> Result<(), Error> {
    if work.engine.state.motion != 52 {
        return Err(work.refuse(&problems::NURBS_START));
    }
    let spline = std::mem::take(&mut work.engine.spline);
    if spline.incomplete {
        work.engine.state.motion = 800;
        return Err(work.refuse(&problems::INCOMPLETE));
    }
    let count = spline.points.len();
    if count < spline.order as usize {
        let text = problems::NURBS_POINTS.message.replace("{}", &spline.order.to_string());
        return Err(Error::with(&problems::NURBS_POINTS, work.code_range(), text));
    }
    let mut end = work.engine.state.current;
    if let Some(last) = spline.points.last() {
        (end[0], end[1]) = (last[0], last[1]);
    }
    work.engine.state.current = end;
    work.engine.state.motion = -1;
    work.emit(Canon::Nurbs {
        order: spline.order,
        knots: clamped(count, spline.order as usize),
        points: Arc::from(spline.points),
        end,
    });
    Ok(())
}

/// Uniform knots, clamped at both ends: `order` times 0, 1, 2, ..., `order` times the last.
fn clamped(count: usize, order: usize) -> Arc<[f64]> {
    let last = (count + 1 - order) as f64;
    (0..count + order)
        .map(|place| (place as f64 + 1.0 - order as f64).clamp(0.0, last))
        .collect()
}
