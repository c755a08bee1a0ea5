//! Every way on which the kernel can be asked: ray by ray, in batches and in
//! registers, with each number of lanes, with shortcuts and without, and shape by
//! shape. All of them have to answer the same, to the last bit.

use super::case::Case;
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, Vectors, Width, Work, dispatch};
use lancer_kernel::{Candidates, Culling, Goal, Hit, KernelSettings, Prepared, Rays, Which};
use lancer_math::{Point, Ray, Vector, unit};
use lancer_scene::{Geometry, Mesh, Scene, Shape};
use std::sync::Arc;

/// Of so many rays one is held against every triangle of a mesh.
const SCANNED: usize = 32;

/// A number of lanes, with the scene prepared for it.
#[derive(Debug)]
struct Way {
    width: Width,
    prepared: Prepared,
}

/// One thing by itself, and what its hits are called in the scene.
#[derive(Debug)]
struct Alone {
    item: u32,
    /// The triangle of a mesh.
    part: Option<u32>,
    prepared: Prepared,
}

/// A scene, prepared in all ways.
#[derive(Debug)]
pub(crate) struct Paths {
    ways: Vec<Way>,
    /// With all shortcuts off.
    plain: Prepared,
    shapes: Vec<Alone>,
    triangles: Vec<Alone>,
}

/// A ray that another path has another answer for.
#[derive(Debug)]
pub(crate) struct Disagreement {
    pub(crate) ray: usize,
    pub(crate) what: String,
}

/// A ray, and the closed item whose outside it leaves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asking {
    pub(crate) ray: Ray,
    pub(crate) outside: Option<u32>,
}

fn prepare(scene: &Scene, lanes: Width, culling: Culling) -> Prepared {
    Prepared::with(scene, &KernelSettings { lanes, culling })
}

/// Each triangle of a mesh as a mesh.
fn split(mesh: &Mesh) -> impl Iterator<Item = Mesh> {
    (0..mesh.triangle_count()).map(|triangle| {
        let corners = mesh.corners(triangle).map(|corner| [corner.x, corner.y, corner.z]);
        Mesh::new(corners.into(), vec![[0, 1, 2]]).expect("a triangle")
    })
}

impl Paths {
    pub(crate) fn new(case: &Case) -> Self {
        let way = |width| Way { width, prepared: prepare(&case.scene, width, Culling::ALL) };
        let ways = Width::available().into_iter().map(way).collect();
        let (mut shapes, mut triangles) = (Vec::new(), Vec::new());
        for item in 0..case.item_count() {
            let shape = &case.subject(item).shape;
            let alone = |part, shape| {
                let prepared = prepare(&case.alone(item, shape), Width::SCALAR, Culling::NONE);
                Alone { item, part, prepared }
            };
            shapes.push(alone(None, shape.clone()));
            if let Geometry::Mesh(mesh) = &shape.geometry {
                triangles.extend((0..).zip(split(mesh)).map(|(part, mesh)| {
                    let shape = Shape::mesh(Arc::new(mesh), shape.surface).expect("a shape");
                    alone(Some(part), shape)
                }));
            }
        }
        let plain = prepare(&case.scene, Width::best(), Culling::NONE);
        Self { ways, plain, shapes, triangles }
    }

    /// Asks all paths what these rays meet.
    pub(crate) fn ask(
        &self,
        case: &Case,
        asked: &[Asking],
        found: &mut Vec<Disagreement>,
    ) -> Vec<Option<Hit>> {
        let rays: Vec<Ray> = asked.iter().map(|asked| asked.ray).collect();
        let hits: Vec<_> =
            rays.iter().map(|ray| case.prepared.nearest(ray, f64::INFINITY)).collect();
        // So that for some of them what is met is too far.
        let t_max = hits.iter().flatten().map(|hit| 1.5 * hit.t).next().unwrap_or(1.0);
        let answers: Vec<_> = rays
            .iter()
            .zip(&hits)
            .map(|(ray, hit)| Answers::of(&case.prepared, ray, hit))
            .collect();
        for (turn, way) in self.ways.iter().enumerate() {
            way.one_by_one(&rays, &hits, &answers, t_max, found);
            in_batches(&way.prepared, way.width.name(), &rays, &hits, t_max, found);
            let work = InRegisters {
                prepared: &way.prepared,
                asked,
                hits: &hits,
                turn,
                turns: self.ways.len(),
            };
            let differ = dispatch(way.width, work);
            found.extend(differ.into_iter().map(|(ray, what)| {
                let what = format!("in registers of {}, {what}", way.width.name());
                Disagreement { ray, what }
            }));
        }
        in_batches(&self.plain, "no shortcuts", &rays, &hits, t_max, found);
        for (i, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
            by_scan(&self.shapes, i, ray, *hit, found);
            if i.is_multiple_of(SCANNED) && self.is_of_meshes() {
                by_scan(&self.triangles, i, ray, *hit, found);
            }
        }
        hits
    }

    /// Whether there is nothing but meshes, so that all their triangles are all
    /// there is.
    fn is_of_meshes(&self) -> bool {
        let has_triangles = |shape: &Alone| self.triangles.iter().any(|t| t.item == shape.item);
        !self.triangles.is_empty() && self.shapes.iter().all(has_triangles)
    }
}

fn note(found: &mut Vec<Disagreement>, ray: usize, what: impl FnOnce() -> String, same: bool) {
    if !same {
        found.push(Disagreement { ray, what: what() });
    }
}

/// What `all` and `expand` say of a ray.
#[derive(Debug, PartialEq)]
struct Answers {
    all: Vec<Hit>,
    point: Option<Met>,
}

/// All of a surface point but how it looks.
#[derive(Debug, PartialEq)]
struct Met {
    point: Point,
    error: f64,
    normals: [Vector; 2],
    albedo: [f64; 3],
    names: [u32; 2],
}

impl Answers {
    fn of(prepared: &Prepared, ray: &Ray, hit: &Option<Hit>) -> Self {
        let all = prepared.all(ray, (f64::NEG_INFINITY, f64::INFINITY), Which::All);
        let point = hit.as_ref().map(|hit| {
            let s = prepared.expand(ray, hit);
            let (normals, names) = ([s.normal, s.shading], [s.shape, s.item]);
            Met { point: s.point, error: s.error, normals, albedo: s.albedo, names }
        });
        Self { all, point }
    }
}

impl Way {
    /// `nearest`, `any`, `all` and `expand`.
    fn one_by_one(
        &self,
        rays: &[Ray],
        hits: &[Option<Hit>],
        answers: &[Answers],
        t_max: f64,
        found: &mut Vec<Disagreement>,
    ) {
        let (prepared, name) = (&self.prepared, self.width.name());
        for (i, ((ray, hit), expected)) in rays.iter().zip(hits).zip(answers).enumerate() {
            let nearest = prepared.nearest(ray, f64::INFINITY);
            note(found, i, || format!("{name}: {nearest:?}, not {hit:?}"), nearest == *hit);
            let any = prepared.any(ray, t_max, Which::All);
            let same = any == hit.is_some_and(|hit| hit.t < t_max);
            note(found, i, || format!("{name}: any up to {t_max:e}: {any}"), same);
            let own = Answers::of(prepared, ray, hit);
            note(found, i, || format!("{name}: {own:?}, not {expected:?}"), own == *expected);
        }
    }
}

/// `nearest_each` and `any_each`.
fn in_batches(
    prepared: &Prepared,
    name: &str,
    rays: &[Ray],
    hits: &[Option<Hit>],
    t_max: f64,
    found: &mut Vec<Disagreement>,
) {
    let mut nearest = vec![None; rays.len()];
    let mut any = vec![false; rays.len()];
    for t_max in [t_max, f64::INFINITY] {
        prepared.nearest_each(rays, t_max, &mut nearest);
        prepared.any_each(rays, t_max, Which::All, &mut any);
        for (i, hit) in hits.iter().enumerate() {
            let (hit, nearest, any) = (hit.filter(|hit| hit.t < t_max), nearest[i], any[i]);
            let what = || format!("batch of {name} up to {t_max:e}: {nearest:?}, not {hit:?}");
            note(found, i, what, nearest == hit);
            let what = || format!("batch of {name}: any up to {t_max:e}: {any}");
            note(found, i, what, any == hit.is_some());
        }
    }
}

/// The nearest of what each shape has alone.
fn by_scan(shapes: &[Alone], i: usize, ray: &Ray, hit: Option<Hit>, found: &mut Vec<Disagreement>) {
    let mut nearest: Option<Hit> = None;
    for shape in shapes {
        let met = shape.prepared.nearest(ray, f64::INFINITY);
        let met =
            met.map(|met| Hit { item: shape.item, part: shape.part.unwrap_or(met.part), ..met });
        let is_nearer =
            |met: &Hit| nearest.is_none_or(|n| (met.t, met.item, met.part) < (n.t, n.item, n.part));
        nearest = met.filter(is_nearer).or(nearest);
    }
    if nearest != hit {
        let what = format!("shape by shape: {nearest:?}, not {hit:?}");
        found.push(Disagreement { ray: i, what });
    }
}

/// `nearest_in_lanes` and its like, for rays side by side and for each alone with what
/// it may meet.
struct InRegisters<'a> {
    prepared: &'a Prepared,
    asked: &'a [Asking],
    hits: &'a [Option<Hit>],
    /// Of so many rays this one is asked by itself, too; the others are with other
    /// numbers of lanes.
    turn: usize,
    turns: usize,
}

impl Work for InRegisters<'_> {
    type Output = Vec<(usize, String)>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Self::Output {
        let mut differ = Vec::new();
        for (chunk, asked) in self.asked.chunks(L::WIDTH).enumerate() {
            let first = chunk * L::WIDTH;
            let rays = side_by_side(lanes, asked);
            let valid = lanes.first(asked.len());
            let everything = (&Candidates::ALL, None);
            let hits = self.prepared.nearest_in_lanes(&rays, f64::INFINITY, valid, everything);
            let outside = outside_of(asked);
            let outside = (&Candidates::ALL, Some(lanes.load(&outside)));
            let leaving = self.prepared.nearest_in_lanes(&rays, f64::INFINITY, valid, outside);
            let any = self.prepared.any_in_lanes(
                &rays,
                f64::INFINITY,
                valid,
                Which::All,
                (&Candidates::ALL, None),
            );
            for (k, asked) in asked.iter().enumerate() {
                let i = first + k;
                let hit = self.hits[i];
                let found = [&hits, &leaving]
                    .map(|hits| hit_of(hits.t.lane(k), hits.item.lane(k), hits.part.lane(k)));
                if found != [hit; 2] {
                    differ.push((i, format!("{found:?} twice, not {hit:?}")));
                }
                if (any.bits() >> k & 1 != 0) != hit.is_some() {
                    differ.push((i, format!("any is not {}", hit.is_some())));
                }
                if i % self.turns == self.turn {
                    self.alone(lanes, i, asked, &mut differ);
                }
            }
        }
        differ
    }
}

/// As it comes from a register.
fn hit_of(t: f64, item: f64, part: f64) -> Option<Hit> {
    (item >= 0.0).then_some(Hit { t, item: item as u32, part: part as u32 })
}

#[inline(always)]
fn side_by_side<L: Lanes>(lanes: L, asked: &[Asking]) -> Rays<L> {
    let mut at = [[0.0; MOST]; 6];
    for k in 0..MOST {
        let ray = &asked[k.min(asked.len() - 1)].ray;
        for axis in 0..3 {
            at[axis][k] = ray.origin[axis];
            at[axis + 3][k] = ray.direction[axis];
        }
    }
    let [x, y, z, dx, dy, dz] = &at;
    Rays::new(lanes, Vectors::load(lanes, [x, y, z]), Vectors::load(lanes, [dx, dy, dz]))
}

fn outside_of(asked: &[Asking]) -> [f64; MOST] {
    std::array::from_fn(|k| match asked.get(k).and_then(|asked| asked.outside) {
        Some(item) => f64::from(item),
        None => -1.0,
    })
}

impl InRegisters<'_> {
    /// One ray with what it may meet, and the point that it meets.
    #[inline(always)]
    fn alone<L: Lanes>(
        &self,
        lanes: L,
        i: usize,
        asked: &Asking,
        differ: &mut Vec<(usize, String)>,
    ) {
        let (prepared, ray, hit) = (self.prepared, &asked.ray, self.hits[i]);
        let (rays, one) = (Rays::splat(lanes, ray), lanes.first(1));
        if let Some(axis) = unit(ray.direction) {
            let among = prepared.candidates_in_cone(&ray.origin, 0.0, &axis, 1.0);
            let found = prepared.nearest_in_lanes(&rays, f64::INFINITY, one, (&among, None));
            let found = hit_of(found.t.lane(0), found.item.lane(0), found.part.lane(0));
            if found != hit {
                differ.push((i, format!("{found:?} in its cone, not {hit:?}")));
            }
        }
        let goal = Goal::Direction(ray.direction);
        let among = prepared.candidates_between(&ray.origin, 0.0, &goal, None);
        let with = (&among, asked.outside);
        let any = prepared.any_in_lanes(&rays, f64::INFINITY, one, Which::All, with);
        if any.any() != hit.is_some() {
            differ.push((i, format!("any in that direction is not {}", hit.is_some())));
        }
        let Some(hit) = hit else { return };
        // Beyond what it meets, and short of it.
        for by in [2.0, 0.5] {
            let goal = ray.at(by * hit.t);
            let to_goal = Ray::new(ray.origin, goal - ray.origin);
            let among = prepared.candidates_between(&ray.origin, 0.0, &Goal::Point(goal), None);
            let rays = Rays::splat(lanes, &to_goal);
            let with = (&among, None);
            let any = prepared.any_in_lanes(&rays, 1.0, one, Which::All, with).any();
            let expected = prepared.any(&to_goal, 1.0, Which::All);
            if any != expected {
                differ.push((i, format!("any before {goal:?} is not {expected}")));
            }
        }
        if let Some(shape) = prepared.shape_in_lanes(hit.item) {
            let points = shape.points(&rays, lanes.splat(hit.t));
            let point: Point = points.point.lane(0).into();
            let (error, normal): (f64, Vector) = (points.error.lane(0), points.normal.lane(0));
            let alone = prepared.expand(ray, &hit);
            if (point, error, normal) != (alone.point, alone.error, alone.normal) {
                differ.push((i, format!("{point:?}, {error:e}, {normal:?}, not {alone:?}")));
            }
        }
    }
}
