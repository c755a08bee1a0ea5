//! Spheres and planes in lanes: what Lancer asks of a scene that has few of them, and the same by
//! the textbook's forms with a fixed smallest distance, as fast as they go.

use super::groups::Group;
use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors, Work};
use lancer_kernel::{Prepared, Rays, Which};
use lancer_math::{Point, Vector, unit};
use lancer_scene::{Geometry, Scene};

/// What is nearer than this the textbook does not meet.
const NEAREST: f64 = 1e-9;

/// Shapes as the textbook has them.
#[derive(Debug, Default)]
pub(super) struct Book {
    /// Centres and squared radii.
    balls: Vec<(Point, f64)>,
    /// Normals, and their products with a point of the plane.
    planes: Vec<(Vector, f64)>,
}

impl Book {
    /// Of some of the spheres and planes that stand by themselves.
    pub(super) fn new(scene: &Scene, items: impl Iterator<Item = u32>) -> Self {
        let mut book = Self::default();
        for item in items {
            match &scene.shapes[item as usize].geometry {
                Geometry::Sphere(sphere) => {
                    let radius = sphere.radius.get();
                    book.balls.push((sphere.centre.get(), radius * radius));
                }
                Geometry::Plane(plane) => {
                    let normal = unit(plane.normal.get()).expect("it is not zero");
                    book.planes.push((normal, normal.dot(&plane.origin.get().coords)));
                }
                _ => {}
            }
        }
        book
    }

    #[inline(always)]
    fn nearest<L: Lanes>(&self, rays: &Rays<L>, lanes: L) -> L::Real {
        let least = lanes.splat(NEAREST);
        let mut best = lanes.splat(f64::INFINITY);
        for (normal, k) in &self.planes {
            let normal = Vectors::splat(lanes, normal);
            let t = (lanes.splat(*k) - normal.dot(&rays.origin)) / normal.dot(&rays.direction);
            best = (t.gt(least) & t.lt(best)).select(t, best);
        }
        let inverse = lanes.splat(1.0) / rays.direction.norm_squared();
        for (centre, squared) in &self.balls {
            let (b, under_root) = roots(rays, lanes, centre, *squared);
            let meets = under_root.ge(lanes.splat(0.0));
            if meets.any() {
                let root = under_root.sqrt();
                let (near, far) = ((-b - root) * inverse, (root - b) * inverse);
                let t = near.gt(least).select(near, far);
                best = (meets & t.gt(least) & t.lt(best)).select(t, best);
            }
        }
        best
    }

    /// Before t = 1.
    #[inline(always)]
    fn any<L: Lanes>(&self, rays: &Rays<L>, lanes: L) -> L::Mask {
        let mut met = lanes.mask(0);
        for (normal, k) in &self.planes {
            let normal = Vectors::splat(lanes, normal);
            let ahead = lanes.splat(*k) - normal.dot(&rays.origin);
            let slope = normal.dot(&rays.direction);
            let product = ahead * slope;
            let squared = slope * slope;
            met = met | (product.gt(squared * NEAREST) & product.lt(squared));
        }
        let squared_way = rays.direction.norm_squared();
        let least = squared_way * NEAREST;
        for (centre, squared) in &self.balls {
            let (b, under_root) = roots(rays, lanes, centre, *squared);
            let meets = under_root.ge(lanes.splat(0.0));
            if meets.any() {
                let root = under_root.sqrt();
                let (near, far) = (-b - root, root - b);
                let within =
                    (near.gt(least) & near.lt(squared_way)) | (far.gt(least) & far.lt(squared_way));
                met = met | (meets & within);
            }
        }
        met
    }
}

/// Half of the linear term of the quadratic, and what is under its root.
#[inline(always)]
fn roots<L: Lanes>(rays: &Rays<L>, lanes: L, centre: &Point, squared: f64) -> (L::Real, L::Real) {
    let from_centre = rays.origin - Vectors::splat_point(lanes, centre);
    let b = from_centre.dot(&rays.direction);
    let c = from_centre.norm_squared() - squared;
    (b, b * b - rays.direction.norm_squared() * c)
}

/// How often each group is asked, so that it is near at hand as in the engine, where it has just
/// been made.
pub(super) const REPEATS: usize = 8;

/// All rays of groups, each [`REPEATS`] times: how many of them meet something.
pub(super) struct Ask<'a> {
    pub(super) groups: &'a [Group],
    /// Lancer's, or the textbook's forms.
    pub(super) ours: Option<&'a Prepared>,
    /// Whether there is something before t = 1, instead of what is nearest.
    pub(super) any: bool,
}

impl Work for Ask<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u32 {
        let all = lanes.first(L::WIDTH);
        let end = lanes.splat(f64::INFINITY);
        let mut met = 0;
        for group in self.groups.iter().flat_map(
            #[inline(always)]
            |group| std::iter::repeat_n(group, REPEATS),
        ) {
            let group = std::hint::black_box(group);
            let one = group.one_outside();
            for at in (0..group.len()).step_by(L::WIDTH) {
                let rays = group.rays(lanes, at);
                let mask = match (self.ours, self.any) {
                    (None, false) => group.book.nearest(&rays, lanes).lt(end),
                    (None, true) => group.book.any(&rays, lanes),
                    (Some(prepared), false) => {
                        let among = (&group.among, group.outside(lanes, at));
                        prepared.nearest_in_lanes(&rays, f64::INFINITY, all, among).t.lt(end)
                    }
                    (Some(prepared), true) => {
                        let among = (&group.among, one);
                        prepared.any_in_lanes(&rays, 1.0, all, Which::All, among)
                    }
                };
                met += mask.bits().count_ones();
            }
        }
        met
    }
}
