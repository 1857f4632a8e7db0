//! T, M6, M61, tool offsets (G43, G43.1, G43.2, G49) and the tool table (G10 L0, L1, L10, L11).
use super::{access, checks::WHOLE, frame, problems};
use crate::state::said;
use crate::{At, Block, Canon, Engine, Error, Pose, Side, Sink, SpindleTurn, Start, ToolEntry};
use std::sync::Arc;
use trunnion_syntax::TextRange;

/// Coordinate system 9 (G59.3), which G10 L11 measures in.
const FIXTURE_SYSTEM: i32 = 9;

impl Engine {
    /// The row of a tool in the table; row 0 is the spindle.
    pub(crate) fn tool_row(&mut self, number: i32, range: TextRange) -> Result<usize, Error> {
        if self
            .state
            .tools
            .spindle()
            .is_some_and(|row| self.changes_places() && row.number == number)
        {
            return Ok(0);
        }
        let is_it = |row: &ToolEntry| row.number == number && *row != ToolEntry::NOBODY;
        match self.state.tools.row_of(number) {
            Some(row) => Ok(row),
            // a row without P is nowhere else
            None if number > 0
                && self.setup.tools.spindle.is_some()
                && self.state.tools.spindle().is_some_and(is_it) =>
            {
                Ok(0)
            }
            None if self.setup.any_tool => {
                let entry = ToolEntry {
                    number,
                    pocket: number,
                    ..ToolEntry::default()
                };
                Ok(Arc::make_mut(&mut self.state.tools).push(entry))
            }
            None => {
                let text = problems::TOOL_MISSING.message.replace("{}", &number.to_string());
                Err(Error::with(&problems::TOOL_MISSING, range, text))
            }
        }
    }
    /// Whether a change puts the old tool into the new one's row: `rs274` copies the new one, and forgets the old.
    fn changes_places(&self) -> bool {
        self.setup.random_tool_changer() && self.setup.start == Start::Unknown
    }
    /// A row's offset in program units.
    fn tool_row_offset(&self, row: usize) -> Pose {
        let entry = self.state.tools.get(row).copied().unwrap_or_default();
        self.entry_offset(&entry)
    }
    fn entry_offset(&self, entry: &ToolEntry) -> Pose {
        let unit = self.stored_unit();
        std::array::from_fn(|axis| entry.offset[axis] * access::scale(axis, unit))
    }
    fn write_tool_row(&mut self, row: usize, entry: ToolEntry) {
        Arc::make_mut(&mut self.state.tools).set(row, entry);
    }
    /// The tool of row 0 is what is in the spindle: its parameters follow (5400-5413, units of the table).
    fn spindle_tool_changed(&mut self) {
        let Some(tool) = self.state.tools.spindle().copied() else {
            return;
        };
        self.state.tool = tool.number;
        self.set_parameter(5400, f64::from(tool.number));
        for (axis, value) in tool.offset.into_iter().enumerate() {
            self.set_parameter(5401 + axis, value);
        }
        self.set_parameter(5410, tool.diameter);
        self.set_parameter(5411, tool.front_angle);
        self.set_parameter(5412, tool.back_angle);
        self.set_parameter(5413, f64::from(tool.orientation));
    }
}

/// At the start of a program.
pub(crate) fn start(engine: &mut Engine) {
    engine.spindle_tool_changed();
    if engine.setup.start == Start::Unknown {
        // some tool is in the spindle
        for number in 5400..=5413 {
            engine.set_parameter(number, f64::NAN);
        }
    }
}

/// T.
pub(crate) fn select(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(number) = block.word(b'T') else { return Ok(()) };
    let number = number.round() as i32;
    let range = block.range_of(b'T');
    if number < 0 {
        return Err(Error::new(&problems::TOOL_NEGATIVE, range));
    }
    let row = if number == 0 {
        0
    } else {
        engine.tool_row(number, range)?
    };
    engine.state.selected_tool = number;
    engine.state.selected_row = row as i32;
    engine.state.said |= said::SELECTED;
    engine.emit(Canon::SelectTool(number), at, sink);
    Ok(())
}

/// M6, M61.
pub(crate) fn change(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let range = block.m_range(6);
    match block.m[6] {
        6 => {
            if engine.state.side != Side::Off {
                return Err(Error::new(&problems::TOOL_COMPENSATION, range));
            }
            engine.emit(Canon::StartChange, at, sink);
            engine.state.said |= said::SPINDLE;
            for spindle in 0..engine.setup.spindles() {
                engine.state.turning[spindle] = 0;
                engine.emit(Canon::Spindle(spindle as i32, SpindleTurn::Stop), at, sink);
            }
            engine.state.spindle_row_before = engine.state.tools.spindle().copied();
            put_in_spindle(engine, engine.state.selected_row);
            let tool = engine.state.selected_tool.max(0);
            let row = engine.state.selected_row;
            engine.emit(Canon::ChangeTool { tool, row }, at, sink);
            forget_place(engine);
        }
        61 => {
            // rounded as the control rounds: half to even
            let number = block.word(b'Q').map(f64::round_ties_even);
            let Some(number) = number.filter(|&number| number >= 0.0 || number.is_nan()) else {
                return Err(Error::new(&problems::M61_Q, range));
            };
            let tool = number as i32;
            // rs274 continues from the position that it has emitted last, which is not where compensation is
            if engine.state.side != Side::Off {
                return Err(Error::new(&problems::TOOL_NUMBER_COMPENSATION, range));
            }
            let row = if tool == 0 {
                0
            } else {
                engine.tool_row(tool, block.range_of(b'Q'))? as i32
            };
            if engine.setup.start == Start::Unknown {
                put_in_spindle(engine, row);
            }
            engine.state.current_row = row;
            engine.emit(Canon::ChangeToolNumber { tool, row }, at, sink);
        }
        _ => return Ok(()),
    }
    engine.state.said |= said::TOOL;
    let pocket = engine.state.spindle_pocket;
    Arc::make_mut(&mut engine.state.tools).set_pocket_of_spindle(pocket);
    Ok(())
}

/// The change may move the machine: in a check X Y Z U V W are unknown after it, also for a motion of the same block. A
/// position that the INI file gives to the changer is a known one only with that file.
fn forget_place(engine: &mut Engine) {
    if engine.setup.start != crate::Start::Unknown {
        return;
    }
    for axis in [0, 1, 2, 6, 7, 8] {
        engine.state.current[axis] = f64::NAN;
        engine.state.compensated[axis] = f64::NAN;
    }
}

/// Without random tool changer a row is copied to the spindle's row; with it the two change places. `rs274` leaves the spindle's row as
/// it is for T0; on a machine the spindle is empty after it.
fn put_in_spindle(engine: &mut Engine, row: i32) {
    engine.state.current_row = row;
    if row == 0 && engine.setup.start == Start::Unknown && !engine.setup.random_tool_changer() {
        engine.write_tool_row(0, ToolEntry::default());
        engine.spindle_tool_changed();
    }
    let Some(row) = usize::try_from(row).ok().filter(|&row| row > 0) else {
        return;
    };
    let Some(entry) = engine.state.tools.get(row).copied() else {
        return;
    };
    if engine.changes_places() {
        let old = engine.state.tools.spindle().copied().unwrap_or_default();
        engine.write_tool_row(row, old);
        engine.state.current_row = 0;
    }
    engine.write_tool_row(0, entry);
    engine.state.spindle_pocket = entry.pocket;
    engine.spindle_tool_changed();
}

/// G43, G43.1, G43.2, G49.
pub(crate) fn length(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(8) else { return Ok(()) };
    let range = block.g_range(8);
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::LENGTH_COMPENSATION, range));
    }
    let h = block.word(b'H').map(|h| h.round() as i32);
    let given = block.given & crate::block::AXES != 0;
    let changes = matches!(block.m[6], 6 | 61);
    engine.state.length_of = match code {
        490 => None,
        430 => Some(h.unwrap_or(0)),
        _ => Some(-1),
    };
    engine.state.said |= said::LENGTH;
    engine.state.length_added = h.filter(|_| code == 432);
    let offset = match code {
        490 => [0.0; 9],
        430 => {
            let row = match h {
                // observed of the random changer alone
                Some(0) if engine.setup.random_tool_changer() && engine.setup.start == Start::Zero => {
                    usize::try_from(engine.state.current_row).unwrap_or(0)
                }
                // the tool that this block puts into the spindle
                None if changes && engine.setup.start == Start::Zero => {
                    usize::try_from(engine.state.current_row).unwrap_or(0)
                }
                None => 0,
                Some(0) => {
                    spindle_row_offset(engine, block, at, sink);
                    return Ok(());
                }
                Some(number) => engine.tool_row(number, block.range_of(b'H'))?,
            };
            engine.tool_row_offset(row)
        }
        431 => engine.over(block, engine.state.tool_offset),
        _ => {
            if h.is_none() && !given {
                return Err(Error::new(&problems::H_OR_AXES, range));
            }
            if h.is_some() && given {
                return Err(Error::new(&problems::H_AND_AXES, range));
            }
            if h == Some(0) {
                spindle_row_offset(engine, block, at, sink);
                return Ok(());
            }
            // with axis words the control searches for a tool with its internal number for "no H", and never finds it
            let row = engine.tool_row(h.unwrap_or(-1), if h.is_some() { block.range_of(b'H') } else { range })?;
            frame::sum(&engine.state.tool_offset, &engine.tool_row_offset(row))
        }
    };
    frame::change_tool_offset(&mut engine.state, offset);
    engine.emit(Canon::ToolOffset(offset), at, sink);
    Ok(())
}

/// H0 of G43 and G43.2: the row of the spindle as it was before a change in the same block, which the control takes over after the
/// block. A check does not rely on that row.
fn spindle_row_offset(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) {
    let before = engine.state.spindle_row_before.filter(|_| block.m[6] == 6);
    let row = match before {
        Some(_) if engine.setup.start == Start::Unknown => [f64::NAN; 9],
        Some(entry) => engine.entry_offset(&entry),
        None => engine.tool_row_offset(0),
    };
    let offset = if block.g_code(8) == Some(432) {
        frame::sum(&engine.state.tool_offset, &row)
    } else {
        row
    };
    frame::change_tool_offset(&mut engine.state, offset);
    engine.emit(Canon::ToolOffset(offset), at, sink);
}

/// G10 L0, L1, L10, L11.
pub(crate) fn table(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let l = block.word(b'L').unwrap_or(0.0) as i32;
    if l == 0 {
        return reload(engine, block, at, sink);
    }
    let number = block.word(b'P').unwrap_or(0.0).round() as i32;
    let row = engine.tool_row(number, block.range_of(b'P'))?;
    let unit = engine.stored_unit();
    let stored = engine.tool_row_offset(row);
    let offset = match l {
        1 => engine.over(block, stored),
        _ => offset_of_position(engine, block, &stored, l == 11),
    };
    let mut entry = engine.state.tools.get(row).copied().unwrap_or_default();
    entry.offset = std::array::from_fn(|axis| {
        // untouched values stay as they were written in the table
        if offset[axis] == stored[axis] {
            entry.offset[axis]
        } else {
            offset[axis] / access::scale(axis, unit)
        }
    });
    if let Some(radius) = block.word(b'R') {
        entry.diameter = 2.0 * radius / unit;
    }
    entry.front_angle = block.word(b'I').unwrap_or(entry.front_angle);
    entry.back_angle = block.word(b'J').unwrap_or(entry.back_angle);
    // the control marks an absent Q by -1
    if let Some(orientation) = block.word(b'Q').filter(|&q| q != -1.0) {
        let whole = orientation.round();
        if orientation < 0.0 || (orientation - whole).abs() > WHOLE {
            return Err(Error::new(&problems::G10_Q, block.range_of(b'Q')));
        }
        if !(0.0..=9.0).contains(&whole) {
            return Err(Error::new(&problems::G10_ORIENTATION, block.range_of(b'Q')));
        }
        entry.orientation = whole as i32;
    }
    engine.write_tool_row(row, entry);
    engine.emit(Canon::SetToolEntry(row as i32, entry), at, sink);
    if !engine.setup.random_tool_changer() && row as i32 == engine.state.current_row {
        engine.write_tool_row(0, entry);
        engine.emit(Canon::SetToolEntry(0, entry), at, sink);
    }
    if row == 0 || row as i32 == engine.state.current_row {
        engine.spindle_tool_changed();
    }
    Ok(())
}

/// The offset with which the tool is at the programmed coordinates (L10), or at those of G59.3 without G92 (L11).
fn offset_of_position(engine: &Engine, block: &Block, stored: &Pose, fixture: bool) -> Pose {
    let state = &engine.state;
    let machine = frame::to_machine(state, &state.current);
    let mut with = state.clone();
    // what the parameters say now, also where a program has written them
    let index = if fixture { FIXTURE_SYSTEM } else { state.origin_index };
    (with.origin_offset, with.rotation_xy) = engine.stored_origin(index);
    with.axis_offset = if fixture { [0.0; 9] } else { engine.stored_axis_offset() };
    with.tool_offset = *stored;
    let here = frame::to_program(&with, &machine);
    let wanted = engine.over(block, here);
    with.tool_offset = [0.0; 9];
    let offset = frame::difference(&machine, &frame::to_machine(&with, &wanted));
    let turned = with.rotation_xy != 0.0 && (block.has(b'X') || block.has(b'Y'));
    std::array::from_fn(|axis| {
        let changes = block.has(super::ends::AXES[axis]) || (turned && axis < 2);
        if changes { offset[axis] } else { stored[axis] }
    })
}

/// G10 L0: the table is read again; refused while a tool is in the spindle.
fn reload(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if engine.state.side != Side::Off {
        return Err(Error::new(&problems::TOOL_NUMBER_COMPENSATION, block.g_range(0)));
    }
    let tool = engine.state.tools.spindle().map_or(0, |row| row.number);
    if tool > 0 {
        let text = problems::G10_LOADED.message.replace("{}", &tool.to_string());
        return Err(Error::with(&problems::G10_LOADED, block.g_range(0), text));
    }
    if engine.setup.start == Start::Unknown {
        engine.state.tools = engine.setup.tool_rows();
    } else {
        // `rs274` reads no file: it takes the rows again as they are
        let pocket = engine.state.spindle_pocket;
        Arc::make_mut(&mut engine.state.tools).set_pocket_of_spindle(pocket);
    }
    engine.emit(Canon::ReloadTools, at, sink);
    Ok(())
}
