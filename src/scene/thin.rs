//! Fewer vertices for the same picture: a level of detail.
use crate::scene::{Kind, Scene, Vertex};

/// How far apart vertices must lie at the first try, as a share of the scene's diagonal.
const FIRST: f64 = 1e-4;
/// So many times the distance is doubled.
const TRIES: u32 = 24;
/// The tool axis may turn by so much between two vertices that are kept, as a chord of the unit sphere: 6 deg.
const TURNED: f64 = 0.1;

/// At most about `most` vertices of a scene, in order, and how far a vertex that was left out lies from one that was kept at most, mm.
///
/// Kept are both ends of each strand, changes between rapid and feed, and what `keep` asks for by line (from 1), as long as all that fits into
/// `most`. A scene that fits is kept whole: 0 mm.
pub fn thin(scene: &Scene, most: usize, keep: impl Fn(u32) -> bool) -> (Vec<Vertex>, f64) {
    if scene.vertices.len() <= most {
        return (scene.vertices.clone(), 0.0);
    }
    let extent = scene.extent().map_or(1.0, |(low, high)| (high - low).norm());
    let mut apart = (extent * FIRST).max(1e-6);
    let mut kept = Vec::new();
    for attempt in 0..TRIES {
        // what is asked for gives way where it is most of the scene
        let asked = attempt < TRIES / 2;
        kept = pass(&scene.vertices, apart, |line| asked && keep(line), most);
        if kept.len() <= most {
            break;
        }
        apart *= 2.0;
    }
    if kept.len() > most {
        // strands of two vertices each: whole strands are left out, evenly
        let every = kept.len().div_ceil(most.max(1));
        let mut strand = 0;
        kept.retain(|vertex| {
            strand += usize::from(vertex.kind == Kind::Start);
            strand % every == 0
        });
        return (kept, f64::INFINITY);
    }
    (kept, apart)
}

/// Vertices farther than `apart` from the one kept before. Gives up early beyond `most`.
fn pass(vertices: &[Vertex], apart: f64, keep: impl Fn(u32) -> bool, most: usize) -> Vec<Vertex> {
    let mut kept: Vec<Vertex> = Vec::with_capacity(most.min(vertices.len()) + 1);
    for (index, vertex) in vertices.iter().enumerate() {
        if kept.len() > most {
            return kept;
        }
        let next = vertices.get(index + 1);
        let ends = next.is_none_or(|next| next.kind == Kind::Start || next.kind != vertex.kind);
        let far = kept
            .last()
            .is_none_or(|last| (vertex.tip - last.tip).norm() > apart || (vertex.axis - last.axis).norm() > TURNED);
        if ends || far || vertex.kind == Kind::Start || keep(vertex.line) {
            kept.push(*vertex);
        }
    }
    kept
}
