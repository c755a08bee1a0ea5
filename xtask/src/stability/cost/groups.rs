//! Rays as the engine sends them: groups from tiles of a picture, with what Lancer leaves out for
//! each, and for the textbook only the shapes that the rays of the group do meet.

use super::listed::Book;
use lancer_kernel::lanes::{Lanes, Vectors};
use lancer_kernel::{Candidates, Goal, Hit, Prepared, Rays, SurfacePoint};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Light, Scene};
use std::collections::{BTreeMap, BTreeSet};

/// The side of a tile.
const SIDE: u32 = 16;

/// One tile in so many is looked at.
pub(super) const ONE_IN: u32 = 5;

/// Rays that are asked together; a multiple of eight.
pub(super) struct Group {
    numbers: [Vec<f64>; 6],
    /// The ball that each leaves from outside, or -1.
    outside: Vec<f64>,
    pub(super) among: Candidates,
    pub(super) book: Book,
}

impl Group {
    fn new(
        scene: &Scene,
        rays: &[(Ray, f64)],
        among: Candidates,
        hit: impl Fn(&Ray) -> Option<Hit>,
    ) -> Self {
        let items: BTreeSet<u32> =
            rays.iter().filter_map(|(ray, _)| Some(hit(ray)?.item)).collect();
        let book = Book::new(scene, items.into_iter());
        let mut group = Self { numbers: Default::default(), outside: Vec::new(), among, book };
        let last = rays.last().copied().into_iter().cycle();
        for (ray, outside) in rays.iter().copied().chain(last).take(rays.len().next_multiple_of(8))
        {
            let numbers = ray.origin.coords.iter().chain(ray.direction.iter());
            group.numbers.iter_mut().zip(numbers).for_each(|(list, number)| list.push(*number));
            group.outside.push(outside);
        }
        group
    }

    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.outside.len()
    }

    #[inline(always)]
    pub(super) fn rays<L: Lanes>(&self, lanes: L, at: usize) -> Rays<L> {
        let [x, y, z, dx, dy, dz] = &self.numbers;
        let origin = Vectors::load(lanes, [&x[at..], &y[at..], &z[at..]]);
        Rays::new(lanes, origin, Vectors::load(lanes, [&dx[at..], &dy[at..], &dz[at..]]))
    }

    #[inline(always)]
    pub(super) fn outside<L: Lanes>(&self, lanes: L, at: usize) -> Option<L::Real> {
        Some(lanes.load(&self.outside[at..]))
    }

    /// The ball that all leave from outside.
    #[inline(always)]
    pub(super) fn one_outside(&self) -> Option<u32> {
        (self.outside[0] >= 0.0).then_some(self.outside[0] as u32)
    }
}

/// The rays from the eye, to the lamps and off what mirrors.
pub(super) fn groups(
    scene: &Scene,
    prepared: &Prepared,
    [width, height]: [u32; 2],
) -> [Vec<Group>; 3] {
    let mut groups: [Vec<Group>; 3] = Default::default();
    let camera = &scene.camera;
    let (eye, target) = (camera.origin().get(), camera.target().get());
    let ahead = target - eye;
    let right = ahead.cross(&camera.up.get()).normalize();
    let up = right.cross(&ahead.normalize());
    let side = camera.plane_width() / f64::from(width);
    let way = |x: f64, y: f64| {
        let across = (x - f64::from(width) / 2.0) * side;
        let upward = (f64::from(height) / 2.0 - y) * side;
        (ahead + right * across + up * upward).normalize()
    };
    let tiles = (0..height / SIDE).flat_map(|y| (0..width / SIDE).map(move |x| (x, y)));
    for (left, top) in tiles.filter(|(x, y)| (x + 2 * y) % ONE_IN == 0) {
        let (left, top) = (f64::from(left * SIDE), f64::from(top * SIDE));
        let pixel = |i: u32| (left + f64::from(i % SIDE) + 0.5, top + f64::from(i / SIDE) + 0.5);
        let rays: Vec<(Ray, f64)> =
            (0..SIDE * SIDE).map(pixel).map(|(x, y)| (Ray::new(eye, way(x, y)), -1.0)).collect();
        let end = f64::from(SIDE);
        let corners =
            [(0.0, 0.0), (end, 0.0), (0.0, end), (end, end)].map(|(x, y)| way(left + x, top + y));
        let (axis, cosine) = cone(&corners);
        let among = prepared.candidates_in_cone(&eye, 0.0, &axis, cosine);
        let among = among.in_front(prepared, &eye, &corners);
        let nearest = |ray: &Ray| prepared.nearest(ray, f64::INFINITY);
        groups[0].push(Group::new(scene, &rays, among, nearest));
        let points: Vec<(Vector, SurfacePoint<'_>)> = rays
            .iter()
            .filter_map(|(ray, _)| Some((ray.direction, prepared.expand(ray, &nearest(ray)?))))
            .collect();
        groups[1].extend(to_lamps(scene, prepared, &points));
        groups[2].extend(mirrored(scene, prepared, &points));
    }
    groups
}

/// By the shape where they start, and by lamp.
fn to_lamps(
    scene: &Scene,
    prepared: &Prepared,
    points: &[(Vector, SurfacePoint<'_>)],
) -> Vec<Group> {
    let mut of_items: BTreeMap<u32, Vec<&SurfacePoint<'_>>> = BTreeMap::new();
    points.iter().for_each(|(_, point)| of_items.entry(point.item).or_default().push(point));
    let lamps = scene.lights.iter().filter_map(|light| match light {
        Light::Lamp { point, .. } => Some(point.get()),
        _ => None,
    });
    let mut groups = Vec::new();
    for (lamp, (item, points)) in lamps.flat_map(|lamp| of_items.iter().map(move |of| (lamp, of))) {
        let ball = is_ball(scene, *item);
        let lit =
            points.iter().filter(|point| !ball || point.normal.dot(&(lamp - point.point)) > 0.0);
        let outside = if ball { f64::from(*item) } else { -1.0 };
        let rays: Vec<(Ray, f64)> =
            lit.map(|point| (point.leave(lamp - point.point), outside)).collect();
        if rays.is_empty() {
            continue;
        }
        let (centre, radius) = around(&rays);
        let leaving = (!ball).then(|| {
            let normal = points[0].normal;
            (*item, if normal.dot(&rays[0].0.direction) < 0.0 { -normal } else { normal })
        });
        let goal = Goal::Point(lamp);
        let among = prepared.candidates_between(&centre, radius, &goal, leaving);
        groups.push(Group::new(scene, &rays, among, |ray| prepared.nearest(ray, 1.0)));
    }
    groups
}

fn mirrored(
    scene: &Scene,
    prepared: &Prepared,
    points: &[(Vector, SurfacePoint<'_>)],
) -> Option<Group> {
    let glossy = points.iter().filter(|(_, point)| point.surface.gloss.get() > 0.0);
    let rays: Vec<(Ray, f64)> = glossy
        .map(|(d, point)| {
            let way = d - point.normal * (2.0 * d.dot(&point.normal));
            let outside = if is_ball(scene, point.item) { f64::from(point.item) } else { -1.0 };
            (point.leave(way), outside)
        })
        .collect();
    let directions: Vec<Vector> = rays.iter().map(|(ray, _)| ray.direction).collect();
    rays.first()?;
    let (axis, cosine) = cone(&directions);
    let (centre, radius) = around(&rays);
    let among = prepared.candidates_in_cone(&centre, radius, &axis, cosine);
    Some(Group::new(scene, &rays, among, |ray| prepared.nearest(ray, f64::INFINITY)))
}

fn is_ball(scene: &Scene, item: u32) -> bool {
    matches!(scene.shapes[item as usize].geometry, lancer_scene::Geometry::Sphere(_))
}

/// An axis, and the least cosine of directions of length 1 with it, rounded down.
fn cone(directions: &[Vector]) -> (Vector, f64) {
    let axis = directions.iter().sum::<Vector>().normalize();
    let cosine = directions.iter().map(|d| d.dot(&axis)).fold(1.0, f64::min);
    (axis, cosine * (1.0 - 1e-12))
}

/// A ball that all start in.
fn around(rays: &[(Ray, f64)]) -> (Point, f64) {
    let (mut min, mut max) = (rays[0].0.origin.coords, rays[0].0.origin.coords);
    for (ray, _) in rays {
        (min, max) = (min.inf(&ray.origin.coords), max.sup(&ray.origin.coords));
    }
    (Point::from((min + max) / 2.0), (max - min).norm() / 2.0 * (1.0 + 1e-12))
}
