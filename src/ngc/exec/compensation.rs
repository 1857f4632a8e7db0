//! The words of G40-G42.1; compensation itself is in `comp`.
use super::access;
use crate::{At, Block, Class, Engine, Error, Plane, Problem, Side, Sink, comp};

macro_rules! problems {
    ($($name:ident $message:literal $help:literal)*) => {
        $(const $name: Problem = Problem { class: Class::Compensation, message: $message, help: $help };)*
    };
}

problems! {
    WRONG_PLANE "Cutter radius compensation allowed only in XY, XZ planes" "Write G17 or G18 first."
    ALREADY_ON "Cannot turn cutter radius comp on when on" "Write G40 first."
    NO_D "{} with no D word" "Add D with the cutter's diameter."
    D_NOT_WHOLE "{} requires D word to be a whole number" "D is the number of a tool; a diameter needs G41.1 or G42.1."
    LATHE_TOOL "{} with lathe tool, but plane is not G18" "Write G18, or remove the orientation from the tool table."
    L_NOT_LATHE "{} with L word, but plane is not G18" "Remove L, or write G18 first."
}

/// G40, G41, G41.1, G42, G42.1.
pub(crate) fn run(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let Some(code) = block.g_code(7) else { return Ok(()) };
    if code == 400 {
        return comp::end(engine, block, at, sink);
    }
    let range = block.g_range(7);
    if !matches!(engine.state.plane, Plane::Xy | Plane::Xz) {
        return Err(Error::new(&WRONG_PLANE, range));
    }
    if engine.state.side != Side::Off {
        return Err(Error::new(&ALREADY_ON, range));
    }
    let side = if code < 420 { Side::Left } else { Side::Right };
    let (radius, orientation) = if code % 10 == 1 {
        by_diameter(engine, block)?
    } else {
        by_tool(engine, block)?
    };
    comp::begin(engine, side, radius, orientation, at, sink);
    engine.state.radius_given = code % 10 == 1;
    Ok(())
}

/// A problem that names the code.
fn named(problem: &'static Problem, block: &Block, range: trunnion_syntax::TextRange) -> Error {
    let code = block.g[7];
    let name = if code % 10 == 0 {
        format!("G{}", code / 10)
    } else {
        format!("G{}.{}", code / 10, code % 10)
    };
    Error::with(problem, range, problem.message.replace("{}", &name))
}

/// G41.1 and G42.1: D is a diameter in program units, L an orientation.
fn by_diameter(engine: &Engine, block: &Block) -> Result<(f64, i32), Error> {
    let Some(diameter) = block.word(b'D') else {
        return Err(named(&NO_D, block, block.g_range(7)));
    };
    let orientation = block.word(b'L').map_or(0, |l| l as i32);
    if block.has(b'L') && engine.state.plane != Plane::Xz {
        return Err(named(&L_NOT_LATHE, block, block.range_of(b'L')));
    }
    Ok((diameter / 2.0, orientation))
}

/// G41 and G42: the tool in the spindle, or tool D of the table.
fn by_tool(engine: &mut Engine, block: &Block) -> Result<(f64, i32), Error> {
    let row = match block.word(b'D') {
        None => 0,
        Some(d) => {
            let whole = d.round();
            if (d - whole).abs() > 0.0001 || whole < 0.0 {
                return Err(named(&D_NOT_WHOLE, block, block.range_of(b'D')));
            }
            if whole == 0.0 {
                0
            } else {
                engine.tool_row(whole as i32, block.range_of(b'D'))?
            }
        }
    };
    let Some(tool) = engine.state.tools.get(row) else {
        return Ok((0.0, 0));
    };
    // 9 is the middle of the edge, as of a mill
    if !matches!(tool.orientation, 0 | 9) && engine.state.plane != Plane::Xz {
        return Err(named(&LATHE_TOOL, block, block.g_range(7)));
    }
    let unit = access::unit_of(engine.setup.machine_units, engine.state.units);
    Ok((tool.diameter / 2.0 * unit, tool.orientation))
}
