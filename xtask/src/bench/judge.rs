//! Hit for hit: where two programs see different triangles, and how near an
//! edge that is.

use super::embree::Found;
use lancer_kernel::Hit;
use lancer_math::Ray;
use lancer_scene::Mesh;

/// Hits whose rays pass an edge of one of the triangles nearer than so many
/// roundings of single precision may be of either side, and those nearer to
/// one another may be in either order.
const ROUNDINGS: f64 = 16.0;

/// How the hits of the same rays differ.
#[derive(Debug, Default)]
pub(super) struct Judgement {
    pub(super) rays: usize,
    /// Another triangle, or none.
    pub(super) differing: usize,
    /// Of those, rays that pass an edge within rounding.
    pub(super) at_edges: usize,
    /// Of the others, hits that are at the same distance within rounding.
    pub(super) at_same_distance: usize,
    /// Of all that differ, those where only we see something, and only they.
    pub(super) ours_alone: usize,
    pub(super) theirs_alone: usize,
    /// Of what neither explains, the farthest from an edge, in roundings.
    pub(super) farthest: f64,
}

impl Judgement {
    pub(super) fn new(mesh: &Mesh, rays: &[Ray], ours: &[Option<Hit>], theirs: &[Found]) -> Self {
        let mut all = Self { rays: rays.len(), ..Self::default() };
        for ((ray, ours), theirs) in rays.iter().zip(ours).zip(theirs) {
            let ours = ours.map(|hit| (hit.t, hit.part));
            let theirs = theirs.map(|(t, triangle)| (f64::from(t), triangle));
            if ours.map(|hit| hit.1) != theirs.map(|hit| hit.1) {
                all.differ(mesh, ray, ours, theirs);
            }
        }
        all
    }

    fn differ(
        &mut self,
        mesh: &Mesh,
        ray: &Ray,
        ours: Option<(f64, u32)>,
        theirs: Option<(f64, u32)>,
    ) {
        self.differing += 1;
        self.ours_alone += usize::from(theirs.is_none());
        self.theirs_alone += usize::from(ours.is_none());
        let hits = [ours, theirs];
        let hits = || hits.iter().flatten();
        let to_edge = hits().map(|hit| to_edge(mesh, hit.1, ray)).fold(f64::INFINITY, f64::min);
        let reach = hits().map(|hit| hit.0).fold(ray.origin.coords.amax(), f64::max);
        let rounding = reach * f64::from(f32::EPSILON) / 2.0;
        if to_edge <= ROUNDINGS * rounding {
            self.at_edges += 1;
        } else if let (Some(a), Some(b)) = (ours, theirs)
            && (a.0 - b.0).abs() <= ROUNDINGS * rounding
        {
            self.at_same_distance += 1;
        } else {
            self.farthest = self.farthest.max(to_edge / rounding);
        }
    }

    pub(super) fn unexplained(&self) -> usize {
        self.differing - self.at_edges - self.at_same_distance
    }
}

/// How far the ray passes from the nearest of the lines through a triangle's
/// edges.
fn to_edge(mesh: &Mesh, triangle: u32, ray: &Ray) -> f64 {
    let corners = mesh.corners(triangle as usize);
    let distance = |k: usize| {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let across = ray.direction.cross(&(b - a));
        ((ray.origin - a).dot(&across) / across.norm()).abs()
    };
    // Of a ray along an edge the distance is not a number: then others decide.
    (0..3).map(distance).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_math::{Point, Vector};

    fn judged(x: f64, ours: Option<u32>, theirs: Option<(f32, u32)>) -> Judgement {
        let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let mesh = Mesh::new(corners, vec![[0, 1, 2], [1, 3, 2]]).expect("valid");
        let ray = Ray::new(Point::new(x, 0.25, 1.0), -Vector::z());
        let ours = ours.map(|part| Hit { t: 1.0, item: 0, part });
        Judgement::new(&mesh, &[ray], &[ours], &[theirs])
    }

    #[test]
    fn the_same_triangle_is_no_difference() {
        assert_eq!(judged(0.2, Some(0), Some((1.0, 0))).differing, 0);
        assert_eq!(judged(2.0, None, None).differing, 0);
    }

    #[test]
    fn edges_explain_what_is_near_them() {
        let near = judged(0.75 + 1e-7, Some(1), Some((1.0, 0)));
        assert_eq!((near.differing, near.at_edges, near.unexplained()), (1, 1, 0));
        let miss = judged(1e-7, Some(0), None);
        assert_eq!((miss.at_edges, miss.ours_alone, miss.theirs_alone), (1, 1, 0));
        let far = judged(0.2, Some(0), None);
        assert_eq!((far.at_edges, far.unexplained()), (0, 1));
        assert!(far.farthest > 1e6, "{}", far.farthest);
    }

    #[test]
    fn the_same_distance_explains_sheets_upon_one_another() {
        let same = judged(0.2, Some(0), Some((1.0, 1)));
        assert_eq!((same.at_same_distance, same.unexplained()), (1, 0));
        assert_eq!(judged(0.2, Some(0), Some((1.1, 1))).unexplained(), 1);
    }
}
