use super::super::testing::{
    Double, Doubles, all, assert_sound, between, check_kept_in_box, check_leaving, check_pairs,
    check_scaling, direction, dot, doubles, minus, ray, ray_to, times, ts, worst_error,
};
use super::*;
use crate::primitive::Cell;
use fastrand::Rng;
use lancer_scene::{Colour, Position};

fn cone(base: ([f64; 3], f64), top: ([f64; 3], f64), open: bool) -> (Cone, Barrel) {
    let [base, top] = [base, top].map(|(p, r)| (Position::new(p).unwrap(), r));
    let cone = Cone::new(base, top, open).unwrap();
    (cone, Barrel::new(&cone))
}

fn along_z(from: f64, to: f64, radii: [f64; 2], open: bool) -> Barrel {
    cone(([0.0, 0.0, from], radii[0]), ([0.0, 0.0, to], radii[1]), open).1
}

/// Atlas C1.
#[test]
fn rays_nearly_along_the_axis() {
    let open = along_z(0.0, 1.0, [1.0, 1.0], true);
    let x = 1.0 - 1e-6;
    let found = ts(&open, &ray([x, 0.0, 0.0], [5e-6, 0.0, 1.0]));
    let expected = (1.0 - x) / 5e-6;
    assert_eq!(found.len(), 1);
    assert!((found[0] / expected - 1.0).abs() <= 2.0 * f64::EPSILON, "{found:?}");

    let endless = along_z(0.0, 1e160, [1.0, 1.0], true);
    for s in [1e-3, 1e-8, 1e-20, 1e-100, 1e-150] {
        let found = ts(&endless, &ray([0.5, 0.0, 0.0], [s, 0.0, 1.0]));
        assert_eq!(found.len(), 1, "{s}");
        assert!((found[0] * s / 0.5 - 1.0).abs() <= 2.0 * f64::EPSILON, "{s}: {found:?}");
    }
    for s in [1e-160, 1e-170, 1e-300, 1e-310] {
        for crossing in all(&endless, &ray([0.5, 0.0, 0.0], [s, 0.0, 1.0])) {
            let t = crossing.t * s / 0.5;
            assert!((t - 1.0).abs() < 1e-9, "{s}: {t}");
        }
    }
    let closed = along_z(0.0, 1.0, [1.0, 1.0], false);
    for zero in [0.0, -0.0] {
        for x in [0.0, 0.5, 1.0, -1.0] {
            let up = ray([x, 0.0, -3.0], [zero, -zero, 2.0]);
            let parts: Vec<u32> = all(&closed, &up).iter().map(|c| c.part).collect();
            assert_eq!((ts(&closed, &up), parts), (vec![1.5, 2.0], vec![BASE, TOP]));
            assert!(ts(&open, &up).is_empty());
        }
        assert!(ts(&closed, &ray([1.5, 0.0, -3.0], [zero, zero, 2.0])).is_empty());
    }
}

/// Atlas C2.
#[test]
fn a_hair_seen_from_afar() {
    let hair = along_z(-1.0, 1.0, [1e-4, 1e-4], false);
    for d in [100.0, 1e3, 1e4, 1e5] {
        let found = ts(&hair, &ray([-d, 0.5e-4, 0.0], [1.0, 0.0, 0.0]));
        let error = (found[0] - (d - 8.660_254_037_844_387e-5)).abs();
        assert!(error <= 2.0 * (f64::next_up(d) - d), "{d}: {error:e}");
        assert!(error < 1e-3 * 1e-4 || d > 1e4, "{d}: {error:e}");
    }
}

/// Atlas C4: x^2 + y^2 = z^2.
#[test]
fn rays_parallel_to_a_line_of_the_side() {
    let shape = along_z(100.0, 0.0, [100.0, 0.0], false);
    // It would meet the mirror image, at t = 2; it goes below the lid.
    assert!(ts(&shape, &ray([3.0, 0.0, 1.0], [-1.0, 0.0, -1.0])).is_empty());
    let found = ts(&shape, &ray([-3.0, 0.0, 1.0], [1.0, 0.0, 1.0]));
    assert_eq!(found, [1.0, 99.0]);
    // Both are rounded, so the expected values are for the direction as it is:
    // |(x, y)|^2 = z^2 with d = (s, 0, c), by the stable formula in doubles twice
    // as long.
    for exponent in [3, 6, 9, 12, 15] {
        let angle = std::f64::consts::FRAC_PI_4 + libm::pow(10.0, f64::from(-exponent));
        let d = [libm::cos(angle), 0.0, libm::sin(angle)];
        let [dx, dz, y, z] = [d[0], d[2], 3.0, 5.0].map(Double::from);
        let a = dx * dx - dz * dz;
        let b = Double::from(0.0) - dz * z;
        let c = y * y - z * z;
        let root = (b * b - a * c).sqrt();
        // b < 0 and both c / e and e / a are roots; the near one is c / e.
        let expected = (c / (root - b)).0;
        for sign in [1.0, -1.0] {
            let found = ts(&shape, &ray([0.0, 3.0, 5.0], d.map(|c| c * sign)));
            let near = found.iter().map(|t| t * sign).fold(f64::NAN, f64::min);
            let error = near / expected - 1.0;
            assert!(error.abs() <= 1e-13, "{exponent}: {near} {expected} {error:e}");
        }
        if exponent == 12 {
            assert!((expected + 2.262_741_699_797_77).abs() < 1e-11, "{expected}");
        }
    }
}

/// Atlas C5.
#[test]
fn the_apex_has_a_normal() {
    for open in [false, true] {
        let shape = along_z(1.0, 0.0, [1.0, 0.0], open);
        for d in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.5, 0.3], [0.2, 0.1, -1.0]] {
            let through = Ray::new(Point::from(Vector::from(d) * -3.0), Vector::from(d));
            let list = all(&shape, &through);
            assert!(open || list.len().is_multiple_of(2), "{list:?}");
            for crossing in &list {
                assert_sound(&shape.contact(&through, crossing));
            }
        }
        let at = Crossing { t: 0.0, part: SIDE };
        let contact = shape.contact(&ray([0.0; 3], [0.0, 0.0, 1.0]), &at);
        let (outward, axis) = (shape.frame.first, Vector::z());
        assert_eq!(contact.point, Point::origin());
        assert!((contact.normal - (outward - axis) * 0.5_f64.sqrt()).amax() < 1e-15);
        // That of the side towards which the ray comes.
        let contact = shape.contact(&ray([0.0; 3], [3.0, -4.0, 1.0]), &at);
        let expected = Vector::new(-0.6, 0.8, -1.0) * 0.5_f64.sqrt();
        assert!((contact.normal - expected).amax() < 1e-15, "{}", contact.normal);
    }
}

/// Atlas C3: 0 or 2, and never outside the slab.
#[test]
fn rays_through_rims_meet_both_or_none() {
    let triples = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (0, 1, 1), (20, 21, 29)];
    for shape in [
        along_z(0.0, 1.0, [1.0, 1.0], false),
        along_z(0.0, 1.0, [1.0, 0.0], false),
        along_z(0.0, 1.0, [0.0, 1.0], false),
        along_z(0.0, 1.0, [1.0, 0.5], false),
    ] {
        let mut rng = Rng::with_seed(1);
        let rim = (0..250_000).map(|_| {
            let (a, b, c) = triples[rng.usize(0..triples.len())];
            let turn = [(a, b), (b, a), (-a, b), (a, -b), (-b, -a)][rng.usize(0..5)];
            let (x, y) = (f64::from(turn.0) / f64::from(c), f64::from(turn.1) / f64::from(c));
            let (z, r) = if rng.bool() { (0.0, 1.0) } else { (1.0, 1.0) };
            let wide = if shape.radii[0] < 1.0 && rng.bool() { shape.radii[0] } else { r };
            ray_to(&mut rng, &Point::new(x * wide, y * wide, z), 1.0)
        });
        let rays: Vec<Ray> = rim.collect();
        let met = check_pairs(&shape, rays.iter().copied());
        assert!(met > 50_000, "{met}");
        for ray in rays.iter().filter(|ray| ray.origin.coords.norm() < 10.0) {
            for crossing in all(&shape, ray) {
                let z = ray.at(crossing.t).z;
                assert!((-1e-14..=1.0 + 1e-14).contains(&z), "{z}");
            }
        }
    }
}

fn shapes() -> Vec<(Cone, Barrel)> {
    vec![
        cone(([0.0; 3], 1.0), ([0.0, 0.0, 1.0], 1.0), false),
        cone(([1.0, 2.0, 3.0], 0.5), ([2.0, -1.0, 3.5], 0.5), false),
        cone(([1.0, 2.0, 3.0], 0.0), ([2.0, -1.0, 3.5], 0.7), false),
        cone(([1.0, 2.0, 300.0], 2.0), ([2.0, -1.0, 303.5], 0.7), false),
        // A coin, a hair, a flat cone.
        cone(([5.0, 5.0, 0.0], 3.0), ([5.0, 5.001, 0.0], 3.0), false),
        cone(([0.0; 3], 1e-4), ([10.0, 7.0, 3.0], 2e-4), false),
        cone(([0.1, 0.1, 0.1], 5.0), ([0.1, 0.2, 0.11], 0.0), false),
    ]
}

/// At points inside, on the side, on lids and rims, and on the axis.
fn rays(cone: &Cone, seed: u64, count: usize) -> impl Iterator<Item = Ray> {
    let mut rng = Rng::with_seed(seed);
    let axis = cone.top() - cone.base();
    let frame = Frame::new(axis.normalize());
    let (base, radii) = (cone.base(), [cone.base_radius(), cone.top_radius()]);
    (0..count).map(move |_| {
        let height = [0.0, 1.0, rng.f64(), rng.f64()][rng.usize(0..4)];
        let radius = radii[0] + (radii[1] - radii[0]) * height;
        let reach = [0.0, 1.0, rng.f64(), 1.0 + 1e-12][rng.usize(0..4)];
        let (s, c) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
        let aside = frame.first * c + frame.second * s;
        let target = base + axis * height + aside * (radius * reach);
        ray_to(&mut rng, &target, axis.norm() + radius)
    })
}

#[test]
fn crossings_come_in_pairs_and_contacts_are_on_the_surface() {
    for (cone, shape) in shapes() {
        let met = check_pairs(&shape, rays(&cone, 1, 100_000));
        assert!(met > 40_000, "{met} {shape:?}");
        // In arithmetic of twice the length, from the scene's own numbers.
        let axis = between(&cone.top(), &cone.base());
        let length = dot(axis, axis).sqrt();
        let [r, s] = [cone.base_radius(), cone.top_radius()].map(Double::from);
        let slope = (s - r) / length;
        let (worst, count) = worst_error(&shape, rays(&cone, 2, 100_000), |p, part| {
            let w = between(p, &cone.base());
            let z = dot(w, axis) / length;
            let distance = (dot(w, w) - z * z).sqrt();
            let off_side =
                (distance - (r + slope * z)) / (Double::from(1.0) + slope * slope).sqrt();
            match part {
                SIDE => {
                    let beyond = (-z.0).max((z - length).0).max(0.0);
                    off_side.0.abs() + beyond
                }
                BASE => z.0.abs() + (distance - r).0.max(0.0),
                _ => (z - length).0.abs() + (distance - s).0.max(0.0),
            }
        });
        assert!(worst <= 1.0 && count > 80_000, "{worst} of {count} {shape:?}");
    }
}

#[test]
fn rays_leave_the_surface_they_start_from() {
    for (cone, shape) in shapes() {
        let mut rng = Rng::with_seed(11);
        let mut aim = Rng::with_seed(12);
        let axis = cone.top() - cone.base();
        let rays = (0..30_000).map(|_| {
            let target = cone.base() + axis * (0.1 + 0.8 * aim.f64());
            let way = direction(&mut aim);
            Ray::new(target - way * (2.0 * aim.f64()), way)
        });
        let wrong = check_leaving(&shape, true, &mut rng, rays);
        assert_eq!(wrong, 0, "{shape:?}");
    }
}

#[test]
fn open_ones_have_a_side_alone() {
    let tube = along_z(0.0, 2.0, [1.0, 1.0], true);
    assert_eq!(ts(&tube, &ray([-3.0, 0.0, 1.0], [1.0, 0.0, 0.0])), [2.0, 4.0]);
    assert_eq!(ts(&tube, &ray([-1.5, 0.0, -1.0], [1.0, 0.0, 1.0])), [2.5]);
    assert!(ts(&tube, &ray([0.0, 0.0, -1.0], [0.0, 0.1, 1.0])).is_empty());
    assert!(!tube.contains(&Point::new(0.0, 0.0, 1.0)));
    let inside = ray([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
    let contact = tube.contact(&inside, &tube.nearest(&inside, 9.0).unwrap());
    assert_eq!(contact.normal, Vector::y());
}

#[test]
fn volumes_and_boxes() {
    let pi = std::f64::consts::PI;
    assert!((along_z(1.0, 3.0, [2.0, 2.0], false).volume() - 8.0 * pi).abs() < 1e-13);
    assert!((along_z(1.0, 4.0, [2.0, 0.0], false).volume() - 4.0 * pi).abs() < 1e-13);
    let (_, shape) = cone(([1.0, 1.0, 1.0], 2.0), ([4.0, 5.0, 1.0], 1.0), false);
    let bounds = shape.bounds().unwrap();
    // The axis is (0.6, 0.8, 0), so the circles reach 0.8 and 0.6 of their radii.
    let expected = [[1.0 - 1.6, 1.0 - 1.2, -1.0], [4.0 + 0.8, 5.0 + 0.6, 3.0]].map(Point::from);
    assert!((bounds.min - expected[0]).amax() < 1e-13, "{bounds:?}");
    assert!((bounds.max - expected[1]).amax() < 1e-13, "{bounds:?}");
}

#[test]
fn checkers_go_along_and_around() {
    let mut checker = Checker::new(Colour::RED);
    checker.length = lancer_scene::Length::new(0.5).unwrap();
    for top in [1.0, 0.25] {
        let shape = along_z(0.0, 1.0, [1.0, top], false);
        // The first axis is z x X = Y.
        for (x, y, z, expected) in [
            (-0.1, 1.0, 0.2, Cell::First),
            (0.1, 1.0, 0.2, Cell::Second),
            (-0.1, 1.0, 0.7, Cell::Second),
            (-0.7, 0.7, 0.2, Cell::Second),
        ] {
            let from = ray([9.0 * x, 9.0 * y, z], [-x, -y, 0.0]);
            let crossing = shape.nearest(&from, 100.0).unwrap();
            let contact = shape.contact(&from, &crossing);
            assert_eq!(
                shape.square(&contact, crossing.part, &checker).cell,
                expected,
                "{x} {y} {z}"
            );
        }
        for (x, y, expected) in [(-0.01, 0.2, Cell::First), (-0.01, 0.8, Cell::Second)] {
            let from = ray([x, y, -9.0], [0.0, 0.0, 1.0]);
            let crossing = shape.nearest(&from, 100.0).unwrap();
            let contact = shape.contact(&from, &crossing);
            assert_eq!((contact.normal, crossing.part), (-Vector::z(), BASE));
            assert_eq!(shape.square(&contact, BASE, &checker).cell, expected, "{x} {y}");
        }
    }
}

#[test]
fn a_tip_seen_from_afar_is_met_on_the_surface() {
    let shape = along_z(-1.0, 0.0, [0.25, 0.0], true);
    for (x, k) in [0.0, 1e-300, 1e-12].iter().flat_map(|x| (0..40).map(move |k| (*x, k))) {
        let from = ray([x, 0.0, 1e6 + 1e4 * f64::from(k) / 7.0], [0.0, 0.0, -1.0]);
        let t = from.origin.z + 1e-9 * f64::from(k);
        let contact = shape.contact(&from, &Crossing { t, part: SIDE });
        let p = contact.point;
        let off = libm::hypot(p.x, p.y) + 0.25 * p.z;
        assert!(off.abs() <= contact.error, "{off:e} {contact:?}");
    }
}

#[test]
fn scaled_by_powers_of_two_the_bits_are_the_same() {
    for (given, _) in shapes() {
        let rays: Vec<Ray> = rays(&given, 3, 2000).collect();
        check_scaling(
            |k| {
                let place = |p: Point| [p.x * k, p.y * k, p.z * k];
                let base = (place(given.base()), given.base_radius() * k);
                Box::new(cone(base, (place(given.top()), given.top_radius() * k), false).1)
            },
            &rays,
        );
    }
}

/// Rays that touch a wide side, all across the axis: whatever the roundings, what they meet
/// is where they touch.
#[test]
fn tangents_are_met_where_they_touch() {
    let (radius, length) = (20.814_201_940_521_116, 0.188_782_616_030_521_04);
    let mut rng = Rng::with_seed(4);
    let mut met = 0;
    for widening in [0.0, 4.121_515_447_4e-5, 3.0] {
        let shape = along_z(0.0, length, [radius, radius + widening], true);
        for _ in 0..100_000 {
            let z = length * rng.f64();
            let aside = radius + widening * z / length;
            let aside = aside * (1.0 + f64::EPSILON * f64::from(rng.i8(-3..=3)));
            let from = ray([100.0 + rng.f64(), aside, z], [-0.003, 0.0, 0.0]);
            for crossing in all(&shape, &from) {
                met += 1;
                let x = from.at(crossing.t).x;
                assert!(x.abs() < 1e-5, "{x:e} {from:?}");
            }
        }
    }
    assert!(met > 1000, "{met}");
}

/// How far off crossings of the side are at most, against the side, in units in the last
/// place of the lengths along the ray: the distance of the exact place, by Newton's
/// method in arithmetic of twice the length.
fn worst_crossing(given: &Cone, shape: &Barrel, rays: impl Iterator<Item = Ray>) -> (f64, usize) {
    let axis = between(&given.top(), &given.base());
    let length = dot(axis, axis).sqrt();
    let [r, s] = [given.base_radius(), given.top_radius()].map(Double::from);
    let slope = (s - r) / length;
    let (mut worst, mut count) = (0.0_f64, 0);
    for ray in rays {
        let d = doubles(&ray.direction);
        for crossing in all(shape, &ray).iter().filter(|crossing| crossing.part == SIDE) {
            let t = Double::from(crossing.t);
            let from_base = between(&ray.origin, &given.base());
            let w: Doubles = std::array::from_fn(|i| from_base[i] + d[i] * t);
            let z = dot(w, axis) / length;
            let across = minus(w, times(axis, z / length));
            let distance = dot(across, across).sqrt();
            let off = (distance - (r + slope * z)) / (Double::from(1.0) + slope * slope).sqrt();
            let reach = ray.origin.coords.norm() + crossing.t.abs() * ray.direction.norm();
            let size = given.base().coords.norm() + shape.size;
            worst = worst.max(off.0.abs() / ((reach + size) * f64::EPSILON));
            count += 1;
        }
    }
    (worst, count)
}

/// From up to a dozen sizes away, past the tip or the narrow end: what is lost in the
/// distance must not be lost in the place.
#[test]
fn narrow_ends_are_met_where_they_are_from_afar() {
    let base = [0.855_279_259_390_105_5, 0.397_230_597_990_113_4, -0.676_141_028_767_421_9];
    let top = [35.281_075_622_808_01, -45.340_312_059_963_04, 31.968_616_761_185_306];
    let steep = cone((base, 93.485_181_736_087_92), (top, 0.0), true);
    // b cancels to a fiftieth of its terms.
    let one = ray(
        [-213.711_441_448_369_44, 218.125_728_847_180_27, 188.928_787_740_083_2],
        [110.418_464_756_988_17, -103.031_883_026_682_15, -74.510_271_074_390_9],
    );
    let (worst, count) = worst_crossing(&steep.0, &steep.1, std::iter::once(one));
    assert!(worst <= 1.0 && count == 1, "{worst}");
    for (given, shape) in [
        steep,
        cone(([0.0; 3], 45.0), ([0.0, 39.0, 0.0], 0.0125), true),
        cone(([1.0, 2.0, 3.0], 0.0), ([2.0, -1.0, 3.5], 0.7), false),
        cone(([0.0; 3], 1.0), ([3.0, 1.0, 2.0], 1.0), false),
    ] {
        let mut rng = Rng::with_seed(21);
        let rays = (0..100_000).map(|_| {
            let beside = direction(&mut rng) * (shape.size * libm::exp10(-3.0 * rng.f64()));
            let back = direction(&mut rng) * (shape.size * libm::exp10(2.0 * rng.f64() - 1.0));
            Ray::new(shape.narrow + beside + back, -back * libm::exp10(rng.f64()))
        });
        let (worst, count) = worst_crossing(&given, &shape, rays);
        assert!(worst <= 1.5 && count > 10_000, "{worst} of {count} {shape:?}");
    }
}

/// A side that is nearly a lid ends where it crosses the other, which may be far beside
/// the rim.
#[test]
fn flat_ones_end_in_their_box() {
    for (base, top, radii) in [
        (
            [16.301_669_972_673_19, 3.224_443_685_715_265, -6.594_415_241_345_313],
            [16.253_106_956_960_632, 3.264_139_674_486_240_8, -6.552_470_827_802_378],
            [13.122_089_830_181_201, 92.556_540_115_552_68],
        ),
        ([0.0; 3], [1e-9, 2e-9, 1e-9], [1.0, 0.0]),
        ([100.0, 0.0, 5.0], [100.0, 1e-4, 5.0], [0.5, 10.0]),
    ] {
        for open in [false, true] {
            let (given, shape) = cone((base, radii[0]), (top, radii[1]), open);
            let mut rng = Rng::with_seed(22);
            let rays = (0..50_000).map(|_| {
                let end = if radii[0] > radii[1] { given.base() } else { given.top() };
                // Where the rim touches a face of the box.
                let face = Vector::ith(rng.usize(0..3), 1.0);
                let out = unit(face - shape.axis * shape.axis.dot(&face)).unwrap_or(face);
                let out = if rng.bool() { out } else { -out };
                ray_to(&mut rng, &(end + out * shape.radii[1]), shape.size)
            });
            let met = check_kept_in_box(&shape, rays);
            assert!(met > 10_000, "{met} {shape:?}");
        }
    }
}
