//! The hierarchy of boxes: no hit is lost at corners, beside walls, among what is
//! the same, what is nested deeply and what has no end.

use super::asked::{Asked, GREY, Made, assert_near, ray, scene_of, signs_of_zeros};
use fastrand::Rng;
use lancer_kernel::{Hit, Prepared, Which};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Colour, Mesh, Shape, Surface};
use std::sync::Arc;
use std::time::Instant;

/// A box with corners that are multiples of 1/1024.
fn dyadic_box(rng: &mut Rng, thickness: i32) -> [[f64; 3]; 2] {
    let low: [i32; 3] = std::array::from_fn(|_| rng.i32(-1024..1024));
    let high = low.map(|c| c + 1 + rng.i32(0..thickness));
    [low, high].map(|corner| corner.map(|c| f64::from(c) / 1024.0))
}

/// Rays that go exactly through a corner of a box, among many boxes: each is held
/// against that one and reports it. Directions are whole, with zeros of both signs.
#[test]
fn v1_rays_through_corners() {
    for thickness in [1, 1024] {
        let mut rng = Rng::with_seed(1);
        for round in 0..40 {
            let boxes: Vec<_> = (0..200).map(|_| dyadic_box(&mut rng, thickness)).collect();
            let asked =
                Asked::new(boxes.iter().map(|[low, high]| Shape::cuboid(*low, *high, GREY)));
            for case in 0..5000 {
                let item = rng.usize(0..boxes.len());
                let corner: [f64; 3] = std::array::from_fn(|i| boxes[item][rng.usize(0..2)][i]);
                let zero = if rng.bool() { 0.0 } else { -0.0 };
                let d: [f64; 3] = std::array::from_fn(|_| f64::from(rng.i32(-64..=64)) + zero);
                if d == [0.0; 3] {
                    continue;
                }
                let origin: [f64; 3] = std::array::from_fn(|i| corner[i] - d[i] / 4.0);
                let ray = ray(origin, d);
                let found = if case % 100 == 0 {
                    asked.line(&ray)
                } else {
                    asked.prepared().all(&ray, (f64::NEG_INFINITY, f64::INFINITY), Which::All)
                };
                let own: Vec<&Hit> = found.iter().filter(|hit| hit.item as usize == item).collect();
                assert_eq!(own.len(), 2, "{round} {case}: {own:?} {ray:?} {:?}", boxes[item]);
                assert!(own.iter().any(|hit| hit.t == 0.25), "{own:?}");
                assert!(asked.prepared().any(&ray, 0.25_f64.next_up(), Which::All), "{ray:?}");
            }
        }
    }
}

fn colours(index: usize) -> Surface {
    let (_, colour) = Colour::NAMED[index % Colour::NAMED.len()];
    Surface::new(colour)
}

/// Every kind of shape, thrown into a cube.
fn mixed(rng: &mut Rng, index: usize) -> Made {
    let mut point = || -> [f64; 3] { std::array::from_fn(|_| 20.0 * rng.f64() - 10.0) };
    let (a, b, c, d) = (point(), point(), point(), point());
    let near = |p: [f64; 3]| std::array::from_fn(|i| a[i] + 0.1 * p[i]);
    let surface = colours(index);
    match index % 9 {
        0 => Shape::sphere(a, 0.05 + 0.08 * b[0].abs(), surface),
        1 => Shape::cuboid(a, near(b), surface),
        2 => Shape::triangle([a, near(b), near(c)], surface),
        3 => Shape::tetrahedron([a, near(b), near(c), near(d)], surface),
        4 => Shape::cylinder(a, near(b), 0.3, surface),
        5 => Shape::cone(a, near(b), 0.4, surface),
        6 => Shape::torus(a, b, [0.5, 0.2], surface),
        7 => Shape::disc(a, b, 0.5, surface),
        _ => Shape::rectangle(a, [b, c].map(|v| v.map(|x| 0.1 * x)), surface),
    }
}

/// The nearest of the hits with each shape by itself.
fn by_brute_force(alone: &[Prepared], ray: &Ray) -> Option<Hit> {
    let hits = (0..).zip(alone).filter_map(|(item, shape)| {
        shape.nearest(ray, f64::INFINITY).map(|hit| Hit { item, ..hit })
    });
    hits.reduce(|best, hit| if hit.t < best.t { hit } else { best })
}

/// A whole scene is met as its shapes are one by one, bit for bit.
fn check_brute_force(shapes: Vec<Made>, rays: impl Iterator<Item = Ray>) -> usize {
    let alone: Vec<_> =
        shapes.iter().map(|shape| Prepared::new(&scene_of(vec![shape.clone()]))).collect();
    let asked = Asked::new(shapes);
    let rays: Vec<Ray> = rays.collect();
    let mut met = 0;
    for (ray, hit) in rays.iter().zip(asked.nearest_each(&rays, f64::INFINITY)) {
        assert_eq!(hit, by_brute_force(&alone, ray), "{ray:?}");
        met += usize::from(hit.is_some());
    }
    met
}

/// Between points of a cube, along axes as often, with whole and fractional
/// coordinates.
fn rays(seed: u64, count: usize, size: f64) -> impl Iterator<Item = Ray> {
    let mut rng = Rng::with_seed(seed);
    (0..count).map(move |case| {
        let mut point = || Point::from(Vector::from_fn(|_, _| size * (2.0 * rng.f64() - 1.0)));
        let (origin, target) = (point(), point());
        let mut way = target - origin;
        for axis in 0..3 {
            if rng.u8(0..6) == 0 {
                way[axis] = if case % 2 == 0 { 0.0 } else { -0.0 };
            }
        }
        Ray::new(origin, if way == Vector::zeros() { Vector::z() } else { way })
    })
}

#[test]
fn v1_as_by_brute_force() {
    for (seed, count, rays_of_it) in [(1, 3, 40_000), (2, 40, 40_000), (3, 400, 20_000)] {
        let mut rng = Rng::with_seed(seed);
        let shapes = (0..count).map(|i| mixed(&mut rng, i)).collect();
        let met = check_brute_force(shapes, rays(seed, rays_of_it, 12.0));
        assert!(count < 400 || met > 2000, "{met}");
    }
}

/// Rays of all lengths meet the same, and what is no ray meets nothing.
#[test]
fn v1_lengths_and_what_is_no_ray() {
    let mut rng = Rng::with_seed(11);
    let asked = Asked::new((0..100).map(|i| mixed(&mut rng, i)));
    let usual: Vec<Ray> = rays(12, 2000, 12.0).collect();
    let expected = asked.nearest_each(&usual, f64::INFINITY);
    assert!(expected.iter().flatten().count() > 100);
    for exponent in [-300, -100, 100, 300] {
        let length = libm::scalbn(1.0, exponent);
        let scaled: Vec<Ray> =
            usual.iter().map(|ray| Ray::new(ray.origin, ray.direction * length)).collect();
        for (found, expected) in asked.nearest_each(&scaled, f64::INFINITY).iter().zip(&expected) {
            let back = found.map(|hit| Hit { t: hit.t * length, ..hit });
            assert_eq!(back, *expected, "2^{exponent}");
        }
    }
    let mut none = Vec::new();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for ray in &usual[..60] {
            for axis in 0..3 {
                let (mut from, mut along) = (*ray, *ray);
                from.origin[axis] = bad;
                along.direction[axis] = bad;
                none.extend([from, along]);
            }
        }
    }
    none.extend(usual[..60].iter().map(|ray| Ray::new(ray.origin, Vector::zeros())));
    none.extend(usual[..60].iter().map(|ray| Ray::new(ray.origin, -Vector::zeros())));
    assert!(asked.nearest_each(&none, f64::INFINITY).iter().all(Option::is_none));
}

/// A wall a hundredth beside the ray's plane does not end a box that it is in.
#[test]
fn v2_no_clamped_inverses() {
    for scale in [-100, -40, 0, 40, 100] {
        let place = |v: [f64; 3]| v.map(|c| libm::scalbn(c, scale));
        for z in [8e4, 8.4e4, 1e5, 1e6, 1e9, 1e15] {
            let wall = [place([-1.0, -1.0, z]), place([0.01, 1.0, z + 1.0])];
            // Alone, as many, and as a mesh, whose boxes are what matters.
            let slab = |_| Shape::cuboid(wall[0], wall[1], GREY);
            let [[x0, y0, z0], [x1, y1, _]] = wall;
            let corners = vec![[x0, y0, z0], [x1, y0, z0], [x1, y1, z0], [x0, y1, z0]];
            let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("valid");
            let mesh = Shape::mesh(Arc::new(mesh), GREY);
            let shapes: [Asked; 3] =
                [Asked::one(slab(0)), Asked::new((0..40).map(slab)), Asked::one(mesh)];
            for asked in shapes {
                for d in signs_of_zeros(place([0.0, 0.0, 1.0])) {
                    assert_eq!(asked.t(&ray([0.0; 3], d)), Some(z), "{z} {d:?}");
                    // On the very wall, too, which belongs to the box.
                    let on_wall = ray(place([0.01 - 1e-5, 1.0 - 1e-5, 0.0]), d);
                    assert_eq!(asked.t(&on_wall), Some(z), "{z} {d:?}");
                }
            }
        }
    }
}

/// Made ready in less than a second.
fn prepared_soon(shapes: Vec<Made>, name: &str) -> Prepared {
    let scene = scene_of(shapes);
    // Others may be at work on the machine: one time of five is enough.
    for _ in 0..5 {
        let begun = Instant::now();
        let prepared = Prepared::new(&scene);
        if begun.elapsed().as_secs_f64() < 1.0 {
            return prepared;
        }
    }
    panic!("{name}: it took more than a second each time")
}

#[test]
fn v3_all_in_one_place() {
    let same = (0..10_000).map(|i| Shape::sphere([1.0, 2.0, 3.0], 0.5, colours(i))).collect();
    let same = prepared_soon(same, "identical spheres");
    let at = ray([1.0, 2.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(same.nearest(&at, 9.0), Some(Hit { t: 2.5, item: 0, part: 0 }));
    assert_eq!(same.all(&at, (0.0, 9.0), Which::All).len(), 20_000);

    let radius = |i: usize| 1.0 + (i * 7919 % 10_000) as f64;
    let shells = (0..10_000).map(|i| Shape::sphere([0.0; 3], radius(i), GREY)).collect();
    let shells = prepared_soon(shells, "concentric spheres");
    let out = ray([0.0; 3], [0.0, 0.0, 1.0]);
    assert_eq!(shells.nearest(&out, f64::INFINITY), Some(Hit { t: 1.0, item: 0, part: 0 }));
    let all = shells.all(&out, (0.0, f64::INFINITY), Which::All);
    assert!(all.len() == 10_000 && all.iter().zip(1..).all(|(hit, k)| hit.t == f64::from(k)));

    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2]; 70_000]).expect("valid");
    let copies = vec![Shape::mesh(Arc::new(mesh), GREY)];
    let copies = prepared_soon(copies, "one triangle many times");
    let at = ray([0.25, 0.25, 1.0], [0.0, 0.0, -1.0]);
    assert_eq!(copies.nearest(&at, 9.0), Some(Hit { t: 1.0, item: 0, part: 0 }));
    assert_eq!(copies.all(&at, (0.0, 9.0), Which::All).len(), 70_000);
}

/// Each box half as large as the last one, as often as there are powers of two.
#[test]
fn v3_deep_chains() {
    let side = |k: i32| libm::scalbn(1.0, -k);
    let chain: Vec<Made> = (0..1000)
        .map(|k| Shape::cuboid([side(k + 1); 3], [side(k); 3], colours(k as usize)))
        .collect();
    let chain = prepared_soon(chain, "chain of boxes");
    for k in [0, 1, 10, 100, 400] {
        let middle = 0.75 * side(k);
        let at = ray([middle, middle, -side(k)], [0.0, 0.0, side(k)]);
        let expected = Hit { t: 1.5, item: k as u32, part: 4 };
        assert_eq!(chain.nearest(&at, f64::INFINITY), Some(expected), "{k}");
    }
    // Corner to corner: all of them.
    let through = chain.all(&ray([2.0; 3], [-1.0; 3]), (0.0, f64::INFINITY), Which::All);
    assert!(through.len() >= 1000, "{}", through.len());
}

/// Of equal shapes the first is seen, whatever else is there and however it is sorted.
#[test]
fn v3_ties() {
    let mut rng = Rng::with_seed(33);
    for count in [2_usize, 5, 30, 300] {
        for _ in 0..20 {
            let mut order: Vec<usize> = (0..count).collect();
            rng.shuffle(&mut order);
            // Pairs of the same.
            let shape = |i: usize| {
                let mut own = Rng::with_seed(i as u64 / 2);
                mixed(&mut own, i / 2)
            };
            let asked = Asked::new(order.iter().map(|&i| shape(i)));
            let rays: Vec<Ray> = rays(rng.u64(..), 200, 12.0).collect();
            for (ray, hit) in rays.iter().zip(asked.nearest_each(&rays, f64::INFINITY)) {
                let Some(hit) = hit else { continue };
                let seen = order[hit.item as usize];
                let other = order.iter().position(|i| *i == (seen ^ 1));
                assert!(other.is_none_or(|other| other > hit.item as usize), "{ray:?}");
            }
        }
    }
}

/// The order of the shapes does not matter to where they are met.
#[test]
fn v3_shuffled() {
    let mut rng = Rng::with_seed(34);
    let shapes: Vec<Made> = (0..400).map(|i| mixed(&mut rng, i)).collect();
    let rays: Vec<Ray> = rays(35, 3000, 12.0).collect();
    let expected = Asked::new(shapes.clone()).nearest_each(&rays, f64::INFINITY);
    assert!(expected.iter().flatten().count() > 300);
    for _ in 0..5 {
        let mut order: Vec<usize> = (0..shapes.len()).collect();
        rng.shuffle(&mut order);
        let shuffled = order.iter().map(|&i| shapes[i].clone());
        let found = Asked::new(shuffled).nearest_each(&rays, f64::INFINITY);
        for (found, expected) in found.iter().zip(&expected) {
            let back = found.map(|hit| Hit { item: order[hit.item as usize] as u32, ..hit });
            assert_eq!(back, *expected);
        }
    }
}

#[test]
fn v4_without_end_and_huge() {
    let mut rng = Rng::with_seed(4);
    let mut shapes: Vec<Made> = (0..30).map(|i| mixed(&mut rng, i)).collect();
    shapes.push(Shape::plane([0.0, 0.0, -11.0], [0.1, 0.0, 1.0], GREY));
    shapes.push(Shape::cuboid([-1.7e308; 3], [1.7e308; 3], GREY));
    shapes.push(Shape::sphere([0.0, 0.0, 1e12 + 20.0], 1e12, GREY));
    shapes.push(Shape::sphere([3.0, -3.0, 3.0], 1e-6, GREY));
    shapes.push(Shape::plane([0.0, 30.0, 0.0], [0.0, 1.0, 0.0], GREY));
    // At the small one, too.
    let target = Point::new(3.0, -3.0, 3.0);
    let mut aim = Rng::with_seed(5);
    let at_it = (0..2000).map(move |_| {
        let origin = Vector::from_fn(|_, _| 24.0 * aim.f64() - 12.0);
        let aside = Vector::from_fn(|_, _| 2e-6 * (aim.f64() - 0.5));
        Ray::new(Point::from(origin), target + aside - Point::from(origin))
    });
    let met = check_brute_force(shapes, rays(6, 3000, 12.0).chain(at_it));
    // From inside of the largest box, unless it is too many directions away.
    assert!(met > 4900, "{met}");

    // From inside of the largest box that there is.
    let huge = Asked::one(Shape::cuboid([-1.7e308; 3], [1.7e308; 3], GREY));
    assert_near(huge.t(&ray([0.0; 3], [0.0, 1.7e308, 0.0])), 1.0, 1e-15);
    for d in signs_of_zeros([1.0, 0.0, 0.0]) {
        assert_eq!(huge.t(&ray([0.0; 3], d)), Some(1.7e308));
    }
}

/// Bounds that single precision does not hold are rounded outward: what is at their
/// very edge is met.
#[test]
fn v4_bounds_are_rounded_outward() {
    let mut rng = Rng::with_seed(40);
    let flat: Vec<[f64; 3]> = (0..300).map(|_| std::array::from_fn(|_| 0.1 + rng.f64())).collect();
    let size = 1e-9;
    let boxes: Vec<Made> =
        flat.iter().map(|p| Shape::cuboid(*p, p.map(|c| c + size), GREY)).collect();
    let asked = Asked::new(boxes);
    for (item, p) in (0..).zip(&flat) {
        let high = p.map(|c| c + size);
        for axis in 0..3 {
            for corner in [p, &high] {
                let mut origin = *corner;
                origin[axis] = -1.0;
                let mut way = [0.0; 3];
                way[axis] = 1.0;
                let found = asked.line(&ray(origin, way));
                assert!(found.iter().any(|hit| hit.item == item), "{item} {axis}: {corner:?}");
            }
        }
    }
}
