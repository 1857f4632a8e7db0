//! `[[obstacle]]`, in a machine file and in `trunnion.toml` alike.
use crate::file::raw::{Number, Word};
use crate::file::validate::{Fault, finite, letter};
use crate::{Footprint, Machine, MachineError, Obstacle, ObstacleKind};
use serde::Deserialize;
use toml::Spanned;
use trunnion_geometry::plane::{Point, Polygon, PolygonFault};

/// An obstacle as written, mm: `polygon` with `z`, `box`, or `cylinder`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RawObstacle {
    name: Option<Word>,
    axis: Option<Word>,
    polygon: Option<Spanned<Vec<Spanned<[f64; 2]>>>>,
    z: Option<Spanned<[f64; 2]>>,
    #[serde(rename = "box")]
    cuboid: Option<Spanned<[[f64; 3]; 2]>>,
    cylinder: Option<Spanned<RawCylinder>>,
    #[serde(default)]
    part: bool,
}

/// An upright cylinder.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCylinder {
    centre: Spanned<[f64; 2]>,
    radius: Number,
    z: Spanned<[f64; 2]>,
}

/// The obstacles of a file; they move with axes that the machine must have.
pub(crate) fn obstacles(raw: &[Spanned<RawObstacle>], machine: &Machine) -> Result<Vec<Obstacle>, Fault> {
    let mut all = Vec::new();
    for entry in raw {
        let obstacle = obstacle(entry, &all)?;
        if let (Some(written), None) = (&entry.get_ref().axis, obstacle.frame(machine)) {
            return Err(fault(
                written,
                format!("this machine has no axis {}", written.get_ref()),
            ));
        }
        all.push(obstacle);
    }
    Ok(all)
}

impl RawObstacle {
    /// Checks the obstacles of a settings file. Whether a machine has the axes that they name is not known here: the bytes of each axis in the file
    /// are returned with it.
    ///
    /// # Errors
    /// What is wrong, and its bytes in the file.
    pub fn check_all(raw: &[Spanned<Self>]) -> Result<Vec<(Obstacle, core::ops::Range<usize>)>, MachineError> {
        let mut all: Vec<Obstacle> = Vec::new();
        let mut places = Vec::new();
        for entry in raw {
            let obstacle = obstacle(entry, &all).map_err(|fault| MachineError {
                message: fault.message,
                span: Some(fault.span),
            })?;
            places.push(
                entry
                    .get_ref()
                    .axis
                    .as_ref()
                    .map_or_else(|| entry.span(), Spanned::span),
            );
            all.push(obstacle);
        }
        Ok(all.into_iter().zip(places).collect())
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OneObstacle {
    obstacle: Spanned<RawObstacle>,
}

impl Obstacle {
    /// Reads the keys of an `[[obstacle]]` that stand in one line: `name = "clamp", box = [[0, 0, 0], [40, 20, 30]]`. `known`: obstacles declared before.
    /// Whether a machine has its axis is not known here.
    ///
    /// # Errors
    /// What is wrong.
    pub fn from_line(keys: &str, known: &[Self]) -> Result<Self, String> {
        let one: OneObstacle =
            toml::from_str(&format!("obstacle = {{ {keys} }}")).map_err(|error| error.message().to_owned())?;
        obstacle(&one.obstacle, known).map_err(|fault| fault.message)
    }
}

/// Most obstacles of a machine with its settings: each motion is judged against each obstacle, and ways round them are searched through all of their corners.
pub const MOST_OBSTACLES: usize = 1000;

fn fault<T>(place: &Spanned<T>, message: impl Into<String>) -> Fault {
    Fault {
        message: message.into(),
        span: place.span(),
    }
}

fn obstacle(entry: &Spanned<RawObstacle>, known: &[Obstacle]) -> Result<Obstacle, Fault> {
    let raw = entry.get_ref();
    if known.len() >= MOST_OBSTACLES {
        return Err(fault(
            entry,
            format!("more than {MOST_OBSTACLES} obstacles are declared; put those that stand together in one polygon"),
        ));
    }
    let name = match &raw.name {
        None => format!("obstacle {}", known.len() + 1),
        Some(name) if name.get_ref().trim().is_empty() => {
            return Err(fault(name, "the name is empty; leave the key out, or write a name"));
        }
        Some(name) => name.get_ref().clone(),
    };
    if let Some(written) = &raw.name
        && known.iter().any(|other| other.name == name)
    {
        return Err(fault(written, format!("obstacle {name:?} is declared twice")));
    }
    let (footprint, [bottom, top]) = shape(entry)?;
    Ok(Obstacle {
        name,
        axis: raw.axis.as_ref().map(letter).transpose()?,
        footprint,
        bottom,
        top,
        kind: if raw.part {
            ObstacleKind::Part
        } else {
            ObstacleKind::Body
        },
    })
}

/// Outline and heights.
fn shape(entry: &Spanned<RawObstacle>) -> Result<(Footprint, [f64; 2]), Fault> {
    let raw = entry.get_ref();
    match (&raw.polygon, &raw.cuboid, &raw.cylinder) {
        (Some(polygon), None, None) => {
            let Some(z) = &raw.z else {
                return Err(fault(polygon, "`polygon` needs its heights: `z = [bottom, top]` in mm"));
            };
            Ok((outline(polygon)?, heights(z)?))
        }
        (None, Some(cuboid), None) => {
            no_heights(raw)?;
            let [[x0, y0, z0], [x1, y1, z1]] = *cuboid.get_ref();
            let ordered = [(x0, x1), (y0, y1), (z0, z1)]
                .iter()
                .all(|(low, high)| low < high && plain(*low) && plain(*high));
            if !ordered {
                return Err(fault(
                    cuboid,
                    "`box` must be [[xmin, ymin, zmin], [xmax, ymax, zmax]] in mm, each minimum below its maximum",
                ));
            }
            let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(Point::from);
            let polygon = Polygon::new(&corners).map_err(|_| fault(cuboid, "`box` has no area"))?;
            Ok((Footprint::Polygon(polygon), [z0, z1]))
        }
        (None, None, Some(cylinder)) => {
            no_heights(raw)?;
            let cylinder = cylinder.get_ref();
            let centre = *cylinder.centre.get_ref();
            if !centre.iter().all(|value| plain(*value)) {
                return Err(fault(&cylinder.centre, "`centre` must be two numbers in mm: [x, y]"));
            }
            let radius = finite("radius", &cylinder.radius)?;
            if radius <= 0.0 {
                return Err(fault(
                    &cylinder.radius,
                    format!("radius = {radius} must be greater than zero"),
                ));
            }
            let centre = Point::from(centre);
            Ok((Footprint::Circle { centre, radius }, heights(&cylinder.z)?))
        }
        _ => Err(fault(
            entry,
            "an obstacle has one shape: `polygon = [[x, y], ...]` with `z = [bottom, top]`, `box = [[xmin, ymin, zmin], [xmax, ymax, zmax]]` or \
             `cylinder = { centre = [x, y], radius = r, z = [bottom, top] }`",
        )),
    }
}

/// A number of sensible size.
fn plain(value: f64) -> bool {
    value.is_finite() && value.abs() <= 1e9
}

/// `z` belongs to a polygon.
fn no_heights(raw: &RawObstacle) -> Result<(), Fault> {
    raw.z.as_ref().map_or(Ok(()), |z| {
        Err(fault(
            z,
            "`z` belongs to `polygon`; a box has its heights in its corners, a cylinder has its own `z`",
        ))
    })
}

fn heights(z: &Spanned<[f64; 2]>) -> Result<[f64; 2], Fault> {
    let [bottom, top] = *z.get_ref();
    if plain(bottom) && plain(top) && bottom < top {
        return Ok([bottom, top]);
    }
    Err(fault(
        z,
        format!("z = [{bottom}, {top}]: write [bottom, top] in mm, the bottom below the top"),
    ))
}

fn outline(polygon: &Spanned<Vec<Spanned<[f64; 2]>>>) -> Result<Footprint, Fault> {
    let corners = polygon.get_ref();
    if let Some(wrong) = corners
        .iter()
        .find(|corner| !corner.get_ref().iter().all(|value| plain(*value)))
    {
        return Err(fault(wrong, "a corner must be two numbers in mm: [x, y]"));
    }
    let points: Vec<Point> = corners.iter().map(|corner| Point::from(*corner.get_ref())).collect();
    let built = Polygon::new(&points).map_err(|why| match why {
        PolygonFault::NotFinite(_) => fault(polygon, "a corner is not a number"),
        PolygonFault::NoArea => fault(
            polygon,
            "the polygon has no area: at least three corners that are not on one line are needed",
        ),
    })?;
    Ok(Footprint::Polygon(built))
}
