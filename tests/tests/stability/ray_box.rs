//! Boxes and tetrahedra: rays in faces, along edges and through corners, signs
//! of zero, thin boxes. What is decided is compared with whole numbers.

use super::asked::{Asked, GREY, assert_near, ray, signs_of_zeros};
use fastrand::Rng;
use lancer_kernel::{Prepared, Which};
use lancer_math::{Point, Vector};
use lancer_scene::Shape;

fn cuboid(from: [f64; 3], to: [f64; 3]) -> Asked {
    Asked::one(Shape::cuboid(from, to, GREY))
}

/// Edges and faces belong to the box, with all signs of zeros.
#[test]
fn b1_rays_in_a_face() {
    for (exponent, offset) in [(-40, 0.0), (0, 0.0), (40, 0.0), (0, 1e3), (0, 1e9)] {
        let place = |v: [f64; 3]| v.map(|c| libm::scalbn(c, exponent) + offset);
        let unit = cuboid(place([0.0; 3]), place([1.0; 3]));
        let way = [0.0, 0.0, libm::scalbn(1.0, exponent)];
        for origin in [[0.0, 0.5, -1.0], [1.0, 0.5, -1.0], [0.0, 0.0, -1.0], [1.0, 1.0, -1.0]] {
            for d in signs_of_zeros(way) {
                for o in signs_of_zeros(place(origin)) {
                    assert_eq!(unit.ts(&ray(o, d)), [1.0, 2.0], "{o:?} {d:?}");
                }
            }
        }
        for d in signs_of_zeros(way) {
            assert!(unit.line(&ray(place([2.0, 0.5, -1.0]), d)).is_empty());
            assert!(unit.line(&ray(place([-1.0, 0.5, -1.0]), d)).is_empty());
        }
    }
}

#[test]
fn b2_negative_zeros() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    for way in [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]] {
        let origin = way.map(|c| 0.5 - 1.5 * c);
        for d in signs_of_zeros(way) {
            assert_eq!(unit.ts(&ray(origin, d)), [1.0, 2.0], "{d:?}");
            let back = d.map(|c| -c);
            assert_eq!(unit.ts(&ray(origin, back)), [-2.0, -1.0], "{d:?}");
        }
    }
    for bad in [[0.0; 3], [-0.0; 3], [0.0, f64::NAN, 1.0], [f64::NAN; 3]] {
        assert!(unit.nearest(&ray([0.5, 0.5, -1.0], bad)).is_none(), "{bad:?}");
        assert!(unit.nearest(&ray(bad.map(|c| c / 0.0), [0.0, 0.0, 1.0])).is_none(), "{bad:?}");
    }
}

/// The normal is that of the face by which the ray came in.
#[test]
fn b3_thin_boxes() {
    for exponent in [-300, -40, 0, 40, 300] {
        let size = |v: [f64; 3]| v.map(|c| libm::scalbn(c, exponent));
        for half in [1e-3, 1e-6, 1e-12, 1e-100] {
            let thin = cuboid(size([-1.0, -half, -1.0]), size([1.0, half, 1.0]));
            for x in [0.0, 0.999_95, 1.0_f64.next_down(), 1.0] {
                let down = ray(size([x, 2.0 * half, 0.0]), size([0.0, -half, 0.0]));
                let point = thin.point(&down).expect("it is ahead");
                assert_eq!(point.normal, Vector::y(), "{half} {x}");
                assert_eq!(point.point, Point::from(size([x, half, 0.0])), "{half} {x}");
                assert_eq!(thin.ts(&down), [1.0, 3.0], "{half} {x}");
            }
        }
    }
    // One without thickness is refused.
    assert!(Shape::cuboid([0.0; 3], [1.0, 0.0, 1.0], GREY).is_err());
}

/// From inside one face is ahead; an eye in a face does not see that face.
#[test]
fn b3_from_inside_and_from_a_face() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    assert_near(unit.t(&ray([0.25, 0.5, 0.5], [1.0, 0.0, 0.0])), 0.75, 0.0);
    assert_near(unit.t(&ray([0.25, 0.5, 0.5], [-1.0, 0.0, 0.0])), 0.25, 0.0);
    for d in signs_of_zeros([1.0, 0.0, 0.0]) {
        assert_eq!(unit.t(&ray([0.0, 0.5, 0.5], d)), Some(1.0));
        assert_eq!(unit.t(&ray([1.0, 0.5, 0.5], d)), None);
        assert_eq!(unit.ts(&ray([1.0, 0.5, 0.5], d)), [-1.0, 0.0]);
    }
}

/// The interval of a line between planes, each as a x + b y + c z <= k with whole
/// numbers: whether any of it is left, and whether more than a point.
fn rational(o: [i128; 3], d: [i128; 3], planes: &[([i128; 3], i128)]) -> (bool, bool) {
    let dot = |n: [i128; 3], v: [i128; 3]| n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    // Quotients with denominators above 0; infinite at first.
    let (mut from, mut to) = ((-1, 0), (1, 0));
    for &(normal, k) in planes {
        let (room, speed) = (k - dot(normal, o), dot(normal, d));
        if speed > 0 {
            if room * to.1 < to.0 * speed {
                to = (room, speed);
            }
        } else if speed < 0 {
            if -room * from.1 > from.0 * -speed {
                from = (-room, -speed);
            }
        } else if room < 0 {
            return (false, false);
        }
    }
    let (a, b) = (from.0 * to.1, to.0 * from.1);
    (d != [0; 3] && a <= b, d != [0; 3] && a < b)
}

/// What a line of whole numbers meets: two crossings if more than a point of it
/// is inside; two or none if it touches.
fn check(asked: &Asked, planes: &[([i128; 3], i128)], corners: &[[i128; 3]], seed: u64) {
    let prepared: &Prepared = asked.prepared();
    let mut rng = Rng::with_seed(seed);
    let (mut met, mut touched) = (0, 0);
    for case in 0..500_000 {
        let mut whole = |n: i32| i128::from(rng.i32(-n..=n));
        let d = [whole(1000), whole(1000), whole(1000)].map(|c| if c % 5 == 0 { 0 } else { c });
        let steps = whole(1000);
        // At corners and at edges, and perhaps a bit past.
        let pick = |k: i128| corners[k.unsigned_abs() as usize % corners.len()];
        let (a, b, along) = (pick(whole(1000)), pick(whole(1000)), whole(4) + 4);
        let past = if whole(9) == 0 { [whole(1), whole(1), whole(1)] } else { [0; 3] };
        let o: [i128; 3] =
            std::array::from_fn(|i| 8 * a[i] + (b[i] - a[i]) * along - steps * d[i] + past[i]);
        let ray = ray(o.map(|c| c as f64), d.map(|c| c as f64));
        let found = if case % 100 == 0 {
            asked.line(&ray)
        } else {
            prepared.all(&ray, (f64::NEG_INFINITY, f64::INFINITY), Which::All)
        };
        let (may, must) = rational(o, d, planes);
        let fine = found.len() == 2 && may || found.is_empty() && !must;
        assert!(fine, "{case}: {found:?} {may} {must} {ray:?}");
        met += usize::from(must);
        touched += usize::from(may && !must);
    }
    assert!(met > 100_000 && touched > 10_000, "{met} {touched}");
}

/// Eight times the whole numbers that are given.
fn times_8(corner: [i128; 3]) -> [f64; 3] {
    corner.map(|c| (8 * c) as f64)
}

#[test]
fn b3_boxes_are_decided_as_by_whole_numbers() {
    for (min, max) in [([-3, 1, -10], [5, 2, 7]), ([-1, 0, -1], [1, 1000, 1])] {
        let planes: Vec<_> = (0..3)
            .flat_map(|axis| {
                let mut normal = [0; 3];
                normal[axis] = 1;
                [(normal, 8 * max[axis]), (normal.map(|c: i128| -c), -8 * min[axis])]
            })
            .collect();
        let corners: Vec<[i128; 3]> = (0..8)
            .map(|bits| std::array::from_fn(|i| if bits >> i & 1 == 1 { max[i] } else { min[i] }))
            .collect();
        check(&cuboid(times_8(min), times_8(max)), &planes, &corners, 3);
    }
}

#[test]
fn b3_tetrahedra_are_decided_as_by_whole_numbers() {
    for corners in [
        [[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]],
        [[-7, 3, 2], [11, -5, 4], [0, 13, -6], [3, 1, 17]],
        [[0, 0, 0], [1000, 1, 0], [0, 1, 1], [500, 1, 2]],
    ] {
        let minus =
            |a: [i128; 3], b: [i128; 3]| -> [i128; 3] { std::array::from_fn(|i| a[i] - b[i]) };
        let planes: Vec<_> = (0..4)
            .map(|out| {
                let [a, b, c] = [1, 2, 3].map(|k| corners[(out + k) % 4]);
                let (u, v) = (minus(b, a), minus(c, a));
                let normal: [i128; 3] = std::array::from_fn(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    u[j] * v[k] - u[k] * v[j]
                });
                let dot = |p: [i128; 3]| (0..3).map(|i| normal[i] * p[i]).sum::<i128>();
                let sign = if dot(minus(corners[out], a)) > 0 { -1 } else { 1 };
                (normal.map(|c| sign * c), 8 * sign * dot(a))
            })
            .collect();
        let shape = Shape::tetrahedron(corners.map(times_8), GREY);
        check(&Asked::one(shape), &planes, &corners, 4);
    }
}

/// Along an edge and in a face a ray is inside, to and fro.
#[test]
fn along_edges() {
    let unit = cuboid([0.0; 3], [1.0; 3]);
    let solid = Asked::one(Shape::tetrahedron(
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        GREY,
    ));
    for axis in 0..3 {
        let mut way = [0.0; 3];
        way[axis] = 1.0;
        for d in signs_of_zeros(way) {
            for (sign, expected) in [(1.0, [1.0, 2.0]), (-1.0, [-2.0, -1.0])] {
                let (o, d) = (way.map(|c| -c), d.map(|c| c * sign));
                assert_eq!(unit.ts(&ray(o, d)), expected, "{d:?}");
                assert_eq!(solid.ts(&ray(o, d)), expected, "{d:?}");
            }
        }
    }
    // The oblique edge of the tetrahedron.
    assert_eq!(solid.ts(&ray([2.0, -1.0, 0.0], [-1.0, 1.0, 0.0])), [1.0, 2.0]);
}
