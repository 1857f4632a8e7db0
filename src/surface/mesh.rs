//! A required surface, prepared for nearest-point queries.
use crate::sheet::Sheet;
use core::cell::Cell;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::BvhNode;
use parry3d_f64::query::{PointQuery, PointQueryWithLocation};
use parry3d_f64::shape::TriMesh;
use trunnion_geometry::Vec3;

/// The most triangles that sheets are cut into, all together.
const MOST_TRIANGLES: usize = 1_500_000;

/// So many boxes are looked at for one point at the cost of one each.
const NEAR: u64 = 1000;

/// The cost of each further one: these are many and far apart in memory, and each is fetched from there.
const FAR_COST: u64 = 16;

/// A place on a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uv {
    /// Index of the sheet.
    pub sheet: usize,
    /// Parameters, 0..=1.
    pub u: f64,
    /// Parameters, 0..=1.
    pub v: f64,
}

/// The nearest point of a required surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// mm; the true surface is within [`Required::off`] of it.
    pub distance: f64,
    /// Point, mm.
    pub point: Vec3,
    /// Where on which sheet (not for an STL).
    pub uv: Option<Uv>,
}

/// A required surface.
pub struct Required {
    mesh: TriMesh,
    sheets: Vec<Sheet>,
    /// Sheet and parameters of each point of the mesh; empty for an STL.
    places: Vec<(usize, [f64; 2])>,
    /// How far the triangles may lie from the surface, mm: proven; 0 for an STL, which is its triangles.
    pub off: f64,
}

impl Required {
    /// Sheets, cut into triangles at most `tolerance` mm off.
    ///
    /// # Errors
    /// A sentence where the sheets have no area.
    pub fn from_sheets(sheets: Vec<Sheet>, tolerance: f64) -> Result<Self, String> {
        let (mut points, mut triangles, mut places, mut off) = (Vec::new(), Vec::new(), Vec::new(), 0.0_f64);
        let most = MOST_TRIANGLES / sheets.len().max(1);
        for (index, sheet) in sheets.iter().enumerate() {
            let cut = sheet.cut(tolerance, most.max(2));
            let base = points.len() as u32;
            points.extend(cut.points.iter().map(|(point, _)| to_parry(point)));
            places.extend(cut.points.iter().map(|(_, uv)| (index, *uv)));
            triangles.extend(cut.triangles.iter().map(|triangle| triangle.map(|i| i + base)));
            off = off.max(cut.off);
        }
        Self::built(points, triangles, sheets, places, off)
    }

    /// Triangles as they are.
    ///
    /// # Errors
    /// A sentence where there are none.
    pub fn from_triangles(points: &[Vec3], triangles: Vec<[u32; 3]>) -> Result<Self, String> {
        Self::built(
            points.iter().map(to_parry).collect(),
            triangles,
            Vec::new(),
            Vec::new(),
            0.0,
        )
    }

    fn built(
        points: Vec<Vector>,
        triangles: Vec<[u32; 3]>,
        sheets: Vec<Sheet>,
        places: Vec<(usize, [f64; 2])>,
        off: f64,
    ) -> Result<Self, String> {
        let mesh = TriMesh::new(points, triangles).map_err(|error| format!("the surface has no triangles: {error}"))?;
        Ok(Self {
            mesh,
            sheets,
            places,
            off,
        })
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.mesh.indices().len()
    }

    /// Its sheets; empty for an STL.
    pub fn sheets(&self) -> &[Sheet] {
        &self.sheets
    }

    /// Lowest and highest corner, mm.
    pub fn extent(&self) -> [Vec3; 2] {
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for point in self.mesh.vertices() {
            let point = from_parry(point);
            (low, high) = (low.inf(&point), high.sup(&point));
        }
        [low, high]
    }

    /// The nearest point.
    pub fn nearest(&self, point: &Vec3) -> Nearest {
        self.nearest_within(point, &Cell::new(u64::MAX)).unwrap_or(Nearest {
            distance: f64::NAN,
            point: *point,
            uv: None,
        })
    }

    /// The nearest point; `None` where more boxes about triangles have to be looked at than are `left`, or where `point` is not a place. Each box takes
    /// one, and from [`NEAR`] on [`FAR_COST`].
    pub(crate) fn nearest_within(&self, point: &Vec3, left: &Cell<u64>) -> Option<Nearest> {
        let target = to_parry(point);
        let looked = Cell::new(0_u64);
        let far = |node: &BvhNode, _: f64| match left.get() {
            // nothing more is looked at
            0 => f64::MAX,
            some => {
                looked.set(looked.get() + 1);
                let cost = if looked.get() > NEAR { FAR_COST } else { 1 };
                left.set(some.saturating_sub(cost));
                node.aabb().distance_to_local_point(target, true)
            }
        };
        let triangle = |index: u32, _: f64| {
            let shape = self.mesh.triangle(index);
            let (found, location) = shape.project_local_point_and_get_location(target, false);
            Some(((found.point - target).length(), (found.point, location)))
        };
        let found = self.mesh.bvh().find_best(f64::MAX, far, triangle);
        let (triangle, (_, (near, location))) = found.filter(|_| left.get() > 0)?;
        let near = from_parry(&near);
        let weights = location.barycentric_coordinates();
        let uv = weights.filter(|_| !self.places.is_empty()).map(|weights| {
            let corners = self.mesh.indices()[triangle as usize].map(|i| self.places[i as usize]);
            let mix = |k: usize| corners.iter().zip(weights).map(|(corner, w)| corner.1[k] * w).sum();
            Uv {
                sheet: corners[0].0,
                u: mix(0),
                v: mix(1),
            }
        });
        Some(Nearest {
            distance: (near - point).norm(),
            point: near,
            uv,
        })
    }
}

fn to_parry(v: &Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn from_parry(v: &Vector) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::Patch;
    use trunnion_pieces::{saddle_net, saddle_point};

    #[test]
    fn the_nearest_point_of_the_saddle_is_its_foot() {
        let required = Required::from_sheets(vec![Sheet::Patch(Patch::new(saddle_net()))], 1e-3).expect("a surface");
        assert!(required.off <= 1e-3 && required.triangles() > 1000);
        for (u, v, height) in [(0.2, 0.6, 1.0), (0.5, 0.5, -0.5), (0.71, 0.33, 0.0)] {
            let (foot, normal) = saddle_point(u, v);
            let found = required.nearest(&(foot + normal * height));
            assert!(
                (found.distance - f64::abs(height)).abs() <= required.off + 1e-9,
                "{found:?}"
            );
            let uv = found.uv.expect("on a sheet");
            assert!((uv.u - u).abs() < 1e-3 && (uv.v - v).abs() < 1e-3, "{uv:?}");
        }
    }

    /// For a point in the boxes about many triangles all of them are looked at, and no more than may be.
    #[test]
    fn no_more_boxes_are_looked_at_than_may_be() {
        let fan = |count: u32| {
            let mut points = vec![Vec3::zeros()];
            points.extend((0..=count).map(|index| Vec3::new(50.0, f64::from(index) * 50.0 / f64::from(count), 0.0)));
            let triangles = (1..=count).map(|index| [0, index, index + 1]).collect();
            Required::from_triangles(&points, triangles).expect("a surface")
        };
        let required = fan(600);
        let aside = Vec3::new(10.0, 30.0, 0.0);
        let left = Cell::new(u64::MAX);
        let found = required.nearest_within(&aside, &left).expect("enough");
        let looked = u64::MAX - left.get();
        assert!((found.distance - 200.0_f64.sqrt()).abs() < 1e-9, "{found:?}");
        assert!((300..=NEAR).contains(&looked), "{looked}");
        for most in [0, 1, 10, looked] {
            let left = Cell::new(most);
            assert_eq!(required.nearest_within(&aside, &left), None, "{most}");
            assert_eq!(left.get(), 0);
        }
        let left = Cell::new(looked + 1);
        assert_eq!(required.nearest_within(&aside, &left), Some(found));
        // ten times as many boxes cost more than ten times as much
        let left = Cell::new(u64::MAX);
        assert!(fan(6000).nearest_within(&aside, &left).is_some());
        assert!(u64::MAX - left.get() > 50 * looked, "{}", u64::MAX - left.get());
        let off = Vec3::new(f64::NAN, 0.0, 0.0);
        assert!(required.nearest(&off).distance.is_nan());
    }

    #[test]
    fn triangles_are_taken_as_they_are() {
        let points = [Vec3::zeros(), Vec3::x() * 10.0, Vec3::y() * 10.0];
        let required = Required::from_triangles(&points, vec![[0, 1, 2]]).expect("a surface");
        let found = required.nearest(&Vec3::new(2.0, 2.0, 3.0));
        assert_eq!((found.distance, found.uv, required.off), (3.0, None, 0.0));
        assert!(Required::from_triangles(&points, Vec::new()).is_err());
        assert_eq!(required.extent(), [Vec3::zeros(), Vec3::new(10.0, 10.0, 0.0)]);
    }
}
