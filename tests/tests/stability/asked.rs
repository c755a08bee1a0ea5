//! Shapes that are asked in every way that there is: by one ray and by a batch,
//! with every number of lanes, alone and by whole registers.

use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors, Width, Work, dispatch};
use lancer_kernel::{Candidates, Hit, KernelSettings, Prepared, Rays, SurfacePoint, Which};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Colour, InvalidField, Scene, SceneBuilder, Shape, Surface};

/// Matte grey.
pub(crate) const GREY: Surface = Surface::new(Colour::GREY);

/// A shape as constructors return it.
pub(crate) type Made = Result<Shape, InvalidField>;

/// A scene of nothing but shapes.
pub(crate) fn scene_of(shapes: impl IntoIterator<Item = Made>) -> Scene {
    let camera = Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]);
    let builder = Scene::builder().camera(camera);
    shapes.into_iter().fold(builder, SceneBuilder::shape).build().expect("valid")
}

/// Shapes made ready for each number of lanes.
pub(crate) struct Asked {
    by_width: Vec<(Width, Prepared)>,
}

impl Asked {
    /// These shapes.
    pub(crate) fn new(shapes: impl IntoIterator<Item = Made>) -> Self {
        Self::of(&scene_of(shapes))
    }

    /// One shape.
    pub(crate) fn one(shape: Made) -> Self {
        Self::new([shape])
    }

    /// The shapes of a scene.
    pub(crate) fn of(scene: &Scene) -> Self {
        let with = |lanes| KernelSettings { lanes, ..KernelSettings::default() };
        let by_width = Width::available().into_iter();
        Self { by_width: by_width.map(|w| (w, Prepared::with(scene, &with(w)))).collect() }
    }

    /// With the widest lanes.
    pub(crate) fn prepared(&self) -> &Prepared {
        &self
            .by_width
            .iter()
            .find(|(width, _)| width.name() == Width::best().name())
            .expect("there")
            .1
    }

    /// The nearest hit of each ray with 0 < t < `t_max`: the same from each way to
    /// ask for it, and what the list of all begins with.
    pub(crate) fn nearest_each(&self, rays: &[Ray], t_max: f64) -> Vec<Option<Hit>> {
        let first = &self.by_width[0].1;
        let expected: Vec<_> = rays.iter().map(|ray| first.nearest(ray, t_max)).collect();
        for (width, prepared) in &self.by_width {
            let (mut hits, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
            prepared.nearest_each(rays, t_max, &mut hits);
            prepared.any_each(rays, t_max, Which::All, &mut any);
            for (chunk, ray) in rays.iter().enumerate() {
                let (case, name) = (&expected[chunk], width.name());
                assert_eq!(hits[chunk], *case, "a batch, {name}, {ray:?}");
                assert_eq!(any[chunk], case.is_some(), "any of a batch, {name}, {ray:?}");
                assert_eq!(prepared.nearest(ray, t_max), *case, "{name}, {ray:?}");
                assert_eq!(prepared.any(ray, t_max, Which::All), case.is_some(), "{name}, {ray:?}");
                let all = prepared.all(ray, (0.0, t_max), Which::All);
                // Of an item that is touched, both crossings are nearest.
                let place = |hit: &Hit| (hit.t, hit.item);
                assert_eq!(all.first().map(place), case.as_ref().map(place), "{name}, {ray:?}");
            }
            let found = by_registers(prepared, *width, (rays, t_max), None);
            assert_eq!(found, expected, "registers, {}", width.name());
        }
        expected
    }

    /// The nearest hit of a ray that has no end.
    pub(crate) fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.nearest_each(&[*ray], f64::INFINITY)[0]
    }

    /// Where that is.
    pub(crate) fn t(&self, ray: &Ray) -> Option<f64> {
        self.nearest(ray).map(|hit| hit.t)
    }

    /// All crossings of a ray's line, those behind its origin included.
    pub(crate) fn line(&self, ray: &Ray) -> Vec<Hit> {
        let stretch = (f64::NEG_INFINITY, f64::INFINITY);
        let list = self.by_width[0].1.all(ray, stretch, Which::All);
        for (width, prepared) in &self.by_width {
            assert_eq!(prepared.all(ray, stretch, Which::All), list, "{}, {ray:?}", width.name());
        }
        self.nearest(ray);
        list
    }

    /// Where those are.
    pub(crate) fn ts(&self, ray: &Ray) -> Vec<f64> {
        self.line(ray).iter().map(|hit| hit.t).collect()
    }

    /// The point of the nearest hit.
    pub(crate) fn point(&self, ray: &Ray) -> Option<SurfacePoint<'_>> {
        self.nearest(ray).map(|hit| self.prepared().expand(ray, &hit))
    }
}

/// The nearest hits with 0 < t < `t_max` of rays, found by whole registers of them. If all
/// leave the outside of an item, that is `outside`.
pub(crate) fn by_registers(
    prepared: &Prepared,
    width: Width,
    (rays, t_max): (&[Ray], f64),
    outside: Option<u32>,
) -> Vec<Option<Hit>> {
    dispatch(width, Registers { prepared, rays, t_max, outside })
}

struct Registers<'a> {
    prepared: &'a Prepared,
    rays: &'a [Ray],
    t_max: f64,
    outside: Option<u32>,
}

impl Work for Registers<'_> {
    type Output = Vec<Option<Hit>>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Vec<Option<Hit>> {
        let mut hits = Vec::with_capacity(self.rays.len());
        for chunk in self.rays.chunks(L::WIDTH) {
            let mut rows = [[0.0; 8]; 6];
            for (k, ray) in chunk.iter().enumerate() {
                for axis in 0..3 {
                    rows[axis][k] = ray.origin[axis];
                    rows[axis + 3][k] = ray.direction[axis];
                }
            }
            let [ox, oy, oz, dx, dy, dz] = &rows;
            let origin = Vectors::load(lanes, [ox, oy, oz]);
            let rays = Rays::new(lanes, origin, Vectors::load(lanes, [dx, dy, dz]));
            let asked = lanes.first(chunk.len());
            let (t_max, all) = (self.t_max, &Candidates::ALL);
            let items = self.outside.map(|item| lanes.splat(f64::from(item)));
            let found = self.prepared.nearest_in_lanes(&rays, t_max, asked, (all, items));
            let among = (all, self.outside);
            let any = self.prepared.any_in_lanes(&rays, t_max, asked, Which::All, among);
            let (mut t, mut item, mut part) = ([0.0; 8], [0.0; 8], [0.0; 8]);
            found.t.store(&mut t);
            found.item.store(&mut item);
            found.part.store(&mut part);
            for k in 0..chunk.len() {
                let hit = Hit { t: t[k], item: item[k] as u32, part: part[k] as u32 };
                assert_eq!(any.bits() >> k & 1 != 0, item[k] >= 0.0, "{:?}", chunk[k]);
                hits.push((item[k] >= 0.0).then_some(hit));
            }
        }
        hits
    }
}

/// The ray from `origin` along `direction`.
pub(crate) fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray::new(Point::from(origin), Vector::from(direction))
}

/// One of all directions, of length 1.
pub(crate) fn direction(rng: &mut fastrand::Rng) -> Vector {
    loop {
        let v = Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
        if (0.01..=1.0).contains(&v.norm_squared())
            && let Some(v) = lancer_math::unit(v)
        {
            return v;
        }
    }
}

/// A unit in the last place of a number.
pub(crate) fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

/// All ways to give the zeros of three numbers a sign.
pub(crate) fn signs_of_zeros(c: [f64; 3]) -> impl Iterator<Item = [f64; 3]> {
    (0..8_u32).map(move |bits| {
        std::array::from_fn(|i| if bits >> i & 1 == 1 && c[i] == 0.0 { -c[i] } else { c[i] })
    })
}

/// Whether `found` is there and within `bound` of `expected`.
#[track_caller]
pub(crate) fn assert_near(found: Option<f64>, expected: f64, bound: f64) {
    let found = found.unwrap_or_else(|| panic!("no hit, expected {expected:?}"));
    // Not for what is no number either.
    let near = (found - expected).abs() <= bound;
    assert!(near, "{found:?}, expected {expected:?} within {bound:e}");
}
