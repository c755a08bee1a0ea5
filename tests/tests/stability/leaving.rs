//! Rays that leave a surface: they do not meet it again, and miss nothing that is
//! near it.

use super::asked::{Asked, GREY, assert_near, by_registers, direction, ray, scene_of, ulp};
use fastrand::Rng;
use lancer_kernel::lanes::Width;
use lancer_kernel::{Hit, KernelSettings, Prepared, SurfacePoint, Which};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Shape;

const SIZES: [f64; 5] = [0.0, 1e3, 1e6, 1e8, 1e10];

/// Points of the unit sphere at (s, s, s), met from outside.
fn hits(prepared: &Prepared, s: f64, count: usize) -> Vec<SurfacePoint<'_>> {
    let mut rng = Rng::with_seed(1);
    let centre = Point::new(s, s, s);
    let mut points = Vec::with_capacity(count);
    while points.len() < count {
        let from = centre + direction(&mut rng) * (1.5 + 20.0 * rng.f64());
        let target = centre + direction(&mut rng) * rng.f64();
        let ray = Ray::new(from, target - from);
        let Some(hit) = prepared.nearest(&ray, f64::INFINITY) else { continue };
        if hit.item == 0 {
            points.push(prepared.expand(&ray, &hit));
        }
    }
    points
}

/// One of the directions out of a surface.
fn outward(rng: &mut Rng, normal: &Vector) -> Vector {
    let way = direction(rng);
    if way.dot(normal) < 0.0 { -way } else { way }
}

/// No ray that leaves a sphere meets it again, with no smallest distance.
#[test]
fn h1_no_ray_meets_what_it_leaves() {
    for s in SIZES {
        let scene = scene_of([Shape::sphere([s; 3], 1.0, GREY)]);
        let prepared = Prepared::new(&scene);
        let points = hits(&prepared, s, 200_000);
        let mut rng = Rng::with_seed(2);
        let rays: Vec<Ray> =
            points.iter().map(|point| point.leave(outward(&mut rng, &point.normal))).collect();
        let again = |ray: &Ray| prepared.any(ray, f64::INFINITY, Which::All);
        assert_eq!(rays.iter().filter(|ray| again(ray)).count(), 0, "{s}");
        for lanes in Width::available() {
            let settings = KernelSettings { lanes, ..KernelSettings::default() };
            let prepared = Prepared::with(&scene, &settings);
            let mut again = vec![false; rays.len()];
            prepared.any_each(&rays, f64::INFINITY, Which::All, &mut again);
            assert!(!again.contains(&true), "{s}, {}", lanes.name());
            // With what is left out of registers where it is known what they leave.
            for outside in [None, Some(0)] {
                let met = by_registers(&prepared, lanes, (&rays, f64::INFINITY), outside);
                assert!(met.iter().all(Option::is_none), "{s}, {}", lanes.name());
            }
        }
    }
}

/// A shell at a gap of 20 units in the last place and more is met from everywhere
/// between it and the sphere, whichever of the two comes first.
#[test]
fn h1_what_is_near_is_met() {
    for s in SIZES {
        for gap in [20.0 * ulp(s + 1.0), 1e3 * ulp(s + 1.0), 1e-3] {
            let gap = gap.max(20.0 * ulp(s + 1.0));
            let ball = Shape::sphere([s; 3], 1.0, GREY);
            // Both are seen from outside of the ball alone.
            let alone = Prepared::new(&scene_of([ball.clone()]));
            let both = scene_of([ball, Shape::sphere([s; 3], 1.0 + gap, GREY)]);
            let points = hits(&alone, s, 10_000);
            let mut rng = Rng::with_seed(3);
            let rays: Vec<Ray> =
                points.iter().map(|point| point.leave(outward(&mut rng, &point.normal))).collect();
            for lanes in Width::available() {
                let settings = KernelSettings { lanes, ..KernelSettings::default() };
                let both = Prepared::with(&both, &settings);
                let mut met: Vec<Option<Hit>> = vec![None; rays.len()];
                both.nearest_each(&rays, f64::INFINITY, &mut met);
                let seen = met.iter().filter(|hit| hit.is_some_and(|hit| hit.item == 1)).count();
                assert_eq!(seen, rays.len(), "{s} {gap:e}, {}", lanes.name());
                let found = by_registers(&both, lanes, (&rays, f64::INFINITY), Some(0));
                assert_eq!(found, met, "{s} {gap:e}, {}", lanes.name());
            }
        }
    }
}

/// The same for every kind of shape: what leaves does not come back at once, also at
/// flat angles.
#[test]
fn h1_other_shapes() {
    for s in [0.0, 1e3, 1e6, 1e8] {
        let at = |x: f64, y: f64, z: f64| [s + x, s + y, s + z];
        let convex = [
            Shape::plane([s; 3], [1.0, 2.0, 2.0], GREY),
            Shape::cuboid(at(-1.0, -1.0, -1.0), at(1.0, 1.0, 1.0), GREY),
            Shape::cylinder(at(-1.0, 0.0, 0.0), at(1.0, 0.5, 0.25), 1.0, GREY),
            Shape::cone(at(-1.0, 0.0, 0.0), at(1.0, 0.5, 0.25), 1.0, GREY),
            Shape::disc([s; 3], [1.0, -2.0, 0.5], 1.0, GREY),
            Shape::triangle([at(-1.0, -1.0, 0.0), at(1.0, -1.0, 0.5), at(0.0, 1.0, 0.25)], GREY),
            Shape::tetrahedron(
                [at(-1.0, -1.0, 0.0), at(1.0, -1.0, 0.5), at(0.0, 1.0, 0.25), at(0.0, 0.0, 1.0)],
                GREY,
            ),
        ];
        for shape in convex {
            let prepared = Prepared::new(&scene_of([shape]));
            let mut rng = Rng::with_seed(4);
            let centre = Point::new(s, s, s);
            let mut left = 0;
            for _ in 0..10_000 {
                let from = centre + direction(&mut rng) * (2.0 + 20.0 * rng.f64());
                let target = centre + direction(&mut rng) * rng.f64();
                let ray = Ray::new(from, target - from);
                let Some(hit) = prepared.nearest(&ray, f64::INFINITY) else { continue };
                let point = prepared.expand(&ray, &hit);
                let facing = if ray.direction.dot(&point.normal) > 0.0 { -1.0 } else { 1.0 };
                let out = outward(&mut rng, &(point.normal * facing));
                // Nearly along the surface as often.
                let flat = out - point.normal * out.dot(&point.normal);
                let bit = libm::scalbn(1.0, -rng.i32(0..40));
                for way in [out, flat + point.normal * (facing * bit)] {
                    let again = prepared.nearest(&point.leave(way), f64::INFINITY);
                    assert!(again.is_none(), "{s}: {again:?} {ray:?} {point:?}");
                }
                left += 1;
            }
            assert!(left > 1000, "{left}");
        }
    }
}

/// The floor below a disc is in its shadow at every height, in the middle and near the
/// rim, to and fro.
#[test]
fn h2_contact_shadows() {
    for exponent in [-40, 0, 40] {
        let size = libm::scalbn(1.0, exponent);
        for g in [1e-1, 1e-3, 9e-4, 1e-6, 1e-9, 1e-12, 16.0 * ulp(2.0)] {
            let floor = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], GREY);
            let disc = Shape::disc([0.0, 0.0, g * size], [0.0, 0.0, 1.0], size, GREY);
            let asked = Asked::new([floor, disc]);
            let mut rng = Rng::with_seed(2);
            for case in 0..500 {
                let [x, y] = [0, 1].map(|_| 0.99 * (2.0 * rng.f64() - 1.0) * 0.7);
                let target = [x * size, y * size, 0.0];
                // From beside and below the disc, nearly along the floor.
                let eye = [(x + 3.0) * size, y * size, 0.5 * g * size];
                let flat = ray(eye, std::array::from_fn(|i| target[i] - eye[i]));
                let point = asked.point(&flat).expect("the floor is there");
                assert_eq!(point.item, 0, "{g:e} {case}");
                let up = asked.nearest(&point.leave(Vector::z())).expect("the disc is there");
                assert_eq!(up.item, 1, "{g:e} {case}");
                let above = asked.point(&ray([x * size, y * size, size], [0.0, 0.0, -size]));
                let down = asked.nearest(&above.expect("the disc").leave(-Vector::z()));
                assert_eq!(down.map(|hit| hit.item), Some(0), "{g:e} {case}");
            }
        }
    }
}

/// A mirror below a ball shows the ball's nearer side.
#[test]
fn h2_ball_above_a_mirror() {
    for g in [1e-1, 1e-3, 5e-5, 1e-6, 1e-9, 1e-12, 16.0 * ulp(2.0)] {
        let ball = Shape::sphere([0.0, 0.0, 1.0 + g], 1.0, GREY);
        let height = 1.0 + g - 1.0;
        let mirror = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], GREY);
        let asked = Asked::new([ball, mirror]);
        let below = asked.prepared().all(
            &ray([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]),
            (0.0, 1.0 + 0.5 * height),
            Which::All,
        );
        assert_eq!(below.iter().map(|hit| hit.item).collect::<Vec<_>>(), [1], "{g:e}");
        let point = asked.prepared().expand(&ray([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]), &below[0]);
        for (x, y) in [(0.0, 0.0), (0.1, 0.0), (0.05, -0.2)] {
            let up = point.leave(Vector::new(x, y, 1.0));
            let seen = asked.point(&up).expect("the ball is there");
            assert_eq!(seen.item, 0, "{g:e}");
            // Its outer face: the normal is towards the ray.
            assert!(seen.normal.dot(&up.direction) < 0.0, "{g:e}: {}", seen.normal);
            assert!(seen.point.z < 0.5, "{g:e}: {}", seen.point);
        }
    }
}

/// A ray that starts just before a sphere meets it there.
#[test]
fn h2_starting_before_a_sphere() {
    for s in SIZES {
        let asked = Asked::one(Shape::sphere([s, s, s], 1.0, GREY));
        for gap in [5e-5, 1e-9, 1e-12, 16.0 * ulp(s + 1.0), ulp(s + 1.0)] {
            // What it is after rounding.
            let gap = gap.max(ulp(s + 1.0));
            let start = s - 1.0 - gap;
            let expected = (s - start) - 1.0;
            let found = asked.ts(&ray([s, s, start], [0.0, 0.0, 1.0]));
            assert_eq!(found.len(), 2, "{s} {gap:e}: {found:?}");
            assert_near(Some(found[0]), expected, 2.0 * ulp(expected));
            assert_near(Some(found[1]), expected + 2.0, 2.0 * ulp(2.0));
        }
    }
}
