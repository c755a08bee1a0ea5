//! Spheres and planes in lanes: what Lancer asks of a scene that has few of them, and the same by
//! the textbook's forms with a fixed smallest distance, as fast as they go.

use lancer_integrator::KernelSettings;
use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors, Work};
use lancer_kernel::{Candidates, Prepared, Rays, Which};
use lancer_math::{Point, Ray, Vector, unit};
use lancer_scene::{Geometry, Light, Scene};

/// What is nearer than this the textbook does not meet.
const NEAREST: f64 = 1e-9;

/// The scene as the textbook has it.
pub(super) struct Book {
    /// Centres and squared radii.
    balls: Vec<(Point, f64)>,
    /// Normals, and their products with a point of the plane.
    planes: Vec<(Vector, f64)>,
}

impl Book {
    /// Of the spheres and planes that stand by themselves.
    pub(super) fn new(scene: &Scene) -> Self {
        let mut book = Self { balls: Vec::new(), planes: Vec::new() };
        for shape in &scene.shapes {
            match &shape.geometry {
                Geometry::Sphere(s) => book.balls.push((s.centre.get(), s.radius.get().powi(2))),
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

/// Rays side by side.
#[derive(Default)]
pub(super) struct Batch([Vec<f64>; 6]);

impl Batch {
    fn push(&mut self, ray: &Ray) {
        let numbers = ray.origin.coords.iter().chain(ray.direction.iter());
        self.0.iter_mut().zip(numbers).for_each(|(list, number)| list.push(*number));
    }

    pub(super) fn len(&self) -> usize {
        self.0[0].len()
    }

    #[inline(always)]
    fn rays<L: Lanes>(&self, lanes: L, at: usize) -> Rays<L> {
        let [x, y, z, dx, dy, dz] = self.0.each_ref().map(
            #[inline(always)]
            |list| &list[at..],
        );
        Rays::new(lanes, Vectors::load(lanes, [x, y, z]), Vectors::load(lanes, [dx, dy, dz]))
    }
}

/// Rays from the eye, to the lamps from where those arrive, and mirrored there; a multiple of
/// eight of each.
pub(super) fn batches(scene: &Scene, [width, height]: [u32; 2]) -> [Batch; 3] {
    let prepared = Prepared::with(scene, &KernelSettings::default());
    let mut batches: [Batch; 3] = Default::default();
    let camera = &scene.camera;
    let (eye, target) = (camera.origin().get(), camera.target().get());
    let ahead = target - eye;
    let right = ahead.cross(&camera.up.get()).normalize();
    let up = right.cross(&ahead.normalize());
    let side = camera.plane_width() / f64::from(width);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let across = (f64::from(x) + 0.5 - f64::from(width) / 2.0) * side;
        let upward = (f64::from(height) / 2.0 - f64::from(y) - 0.5) * side;
        let ray = Ray::new(eye, (ahead + right * across + up * upward).normalize());
        batches[0].push(&ray);
        let Some(hit) = prepared.nearest(&ray, f64::INFINITY) else { continue };
        let point = prepared.expand(&ray, &hit);
        for light in &scene.lights {
            if let Light::Lamp { point: lamp, .. } = light {
                batches[1].push(&point.leave(lamp.get() - point.point));
            }
        }
        let d = ray.direction;
        let mirrored = d - point.normal * (2.0 * d.dot(&point.normal));
        batches[2].push(&point.leave(mirrored));
    }
    for list in batches.iter_mut().flat_map(|batch| &mut batch.0) {
        list.truncate(list.len() / 8 * 8);
    }
    batches
}

/// Whose forms.
#[derive(Clone, Copy)]
pub(super) enum Forms<'a> {
    Textbook(&'a Book),
    Ours(&'a Prepared),
}

/// All rays of a batch: how many of them meet something.
pub(super) struct Ask<'a> {
    pub(super) forms: Forms<'a>,
    pub(super) batch: &'a Batch,
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
        for at in (0..self.batch.len()).step_by(L::WIDTH) {
            let rays = self.batch.rays(lanes, at);
            let among = (&Candidates::ALL, None);
            let mask = match (self.forms, self.any) {
                (Forms::Textbook(book), false) => book.nearest(&rays, lanes).lt(end),
                (Forms::Textbook(book), true) => book.any(&rays, lanes),
                (Forms::Ours(prepared), false) => {
                    let hits = prepared.nearest_in_lanes(
                        &rays,
                        f64::INFINITY,
                        all,
                        (&Candidates::ALL, None),
                    );
                    hits.t.lt(end)
                }
                (Forms::Ours(prepared), true) => {
                    prepared.any_in_lanes(&rays, 1.0, all, Which::All, among)
                }
            };
            met += mask.bits().count_ones();
        }
        met
    }
}
