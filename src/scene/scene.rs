//! The vertices of a run.
use trunnion_geometry::Vec3;
use trunnion_machine::Joints;

/// What moves the tool to a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The first vertex of a strand: nothing is drawn to it.
    Start,
    /// Rapid.
    Rapid,
    /// Feed.
    Feed,
}

/// The tool at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Tip in programmed coordinates, mm.
    pub tip: Vec3,
    /// Unit tool axis in the workpiece frame.
    pub axis: Vec3,
    /// Time since the first vertex, s; not a number after a motion whose time is not known.
    pub time: f64,
    /// Proven bound of the tip's deviation from the programmed segment in the block that leads here, mm; not a number where none is known.
    pub deviation: f64,
    /// Highest tip feed that the axes allow in that block, mm/min; not a number where none is known.
    pub feed_limit: f64,
    /// Programmed feed in that block, mm/min; not a number where there is none.
    pub feed: f64,
    /// Posture: +1, -1, 0 at the pole; `None` where the machine has none or it is not known.
    pub posture: Option<i8>,
    /// Line of the block, from 1.
    pub line: u32,
    /// What leads here.
    pub kind: Kind,
    /// It is the end of its block.
    pub ends_block: bool,
    /// Joints in chain order, mm or rad; not numbers where they are not known.
    pub joints: Joints,
}

/// A run.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Vertices in the order of the run.
    pub vertices: Vec<Vertex>,
    /// Motions that are not drawn because their path is not known.
    pub unknown: usize,
    /// The first line that is drawn by the ends of its blocks alone, because the scene holds as many vertices as are kept.
    pub coarse_from: Option<u32>,
}

impl Scene {
    /// Lowest and highest tip coordinates of the feed motions (of all motions where there are none), mm; `None` without vertices.
    pub fn extent(&self) -> Option<(Vec3, Vec3)> {
        let feeds = || self.vertices.iter().filter(|vertex| vertex.kind == Kind::Feed);
        let chosen: Box<dyn Iterator<Item = &Vertex>> = if feeds().next().is_some() {
            Box::new(feeds())
        } else {
            Box::new(self.vertices.iter())
        };
        chosen.fold(None, |extent, vertex| {
            let (low, high) = extent.unwrap_or((vertex.tip, vertex.tip));
            Some((low.inf(&vertex.tip), high.sup(&vertex.tip)))
        })
    }
}
