//! Cases in which more than one answer could be defended, and the one that is given,
//! as the documentation of `lancer_kernel` has it. Tangents, the apex of a cone and
//! rays along edges and axes are with their shapes.

use super::asked::{Asked, GREY, direction, ray, signs_of_zeros, ulp};
use fastrand::Rng;
use lancer_kernel::Which;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Shape;

/// Of faces in one place the nearer one is met, and the first of those that are as
/// near: always the first where both are planes across an axis or faces of boxes.
/// Discs and rectangles may be a few units in the last place off.
#[test]
fn coincident_faces() {
    let flat = [[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let shapes = [
        Shape::plane([0.0, 0.0, 0.3], [0.0, 0.0, 1.0], GREY),
        Shape::cuboid([-2.0, -2.0, -1.0], [2.0, 2.0, 0.3], GREY),
        Shape::disc([0.0, 0.0, 0.3], [0.0, 0.0, 1.0], 2.0, GREY),
        Shape::rectangle([-2.0, -2.0, 0.3], flat, GREY),
        Shape::plane([9.0, -7.0, 0.3], [0.0, 0.0, -2.0], GREY),
    ];
    let mut rng = Rng::with_seed(1);
    let rays: Vec<Ray> = (0..2000)
        .map(|_| {
            let [x, y, u, v] = [0; 4].map(|_| 2.0 * rng.f64() - 1.0);
            Ray::new(
                Point::new(3.0 * u, 3.0 * v, 2.0 + rng.f64()),
                Vector::new(x - 3.0 * u, y - 3.0 * v, -2.2),
            )
        })
        .collect();
    // The planes and the box.
    let is_exact = |shape: usize| matches!(shape, 0 | 1 | 4);
    for first in 0..shapes.len() {
        for second in (0..shapes.len()).filter(|second| *second != first) {
            let asked = Asked::new([shapes[first].clone(), shapes[second].clone()]);
            for (ray, hit) in rays.iter().zip(asked.nearest_each(&rays, f64::INFINITY)) {
                let hit = hit.expect("it is below");
                let all = asked.prepared().all(ray, (0.0, 9.0), Which::All);
                let of = |item| all.iter().find(|hit| hit.item == item).map(|hit| hit.t);
                let (Some(a), Some(b)) = (of(0), of(1)) else { continue };
                if is_exact(first) && is_exact(second) {
                    assert_eq!((hit.item, a), (0, b), "{first} {second}: {ray:?}");
                }
                assert!((a - b).abs() <= 4.0 * ulp(a), "{first} {second}: {a} {b}");
                assert_eq!(hit.item, u32::from(b < a), "{first} {second}: {ray:?}");
            }
        }
    }
}

/// The same shape twice: the first, for every kind and every ray.
#[test]
fn coincident_shapes() {
    let shapes = [
        Shape::sphere([0.1, 0.2, 0.3], 1.0, GREY),
        Shape::cuboid([-0.7, -0.8, -0.9], [0.6, 0.5, 0.4], GREY),
        Shape::tetrahedron(
            [[1.0, 0.1, 0.0], [-1.0, 0.3, 0.2], [0.0, 1.0, -0.4], [0.1, 0.2, 1.1]],
            GREY,
        ),
        Shape::cylinder([0.1, 0.0, -0.7], [0.3, 0.1, 0.8], 0.6, GREY),
        Shape::cone([0.1, 0.0, -0.7], [0.3, 0.1, 0.8], 0.6, GREY),
        Shape::torus([0.0; 3], [0.1, 0.2, 1.0], [0.8, 0.3], GREY),
        Shape::triangle([[-1.0, -1.0, 0.1], [1.0, -1.0, 0.2], [0.0, 1.0, 0.3]], GREY),
        Shape::plane([0.1, 0.2, 0.3], [0.3, 0.4, 0.5], GREY),
    ];
    let mut rng = Rng::with_seed(2);
    let rays: Vec<Ray> = (0..1000)
        .map(|_| {
            let origin = Point::from(direction(&mut rng) * 3.0);
            Ray::new(origin, Point::from(direction(&mut rng) * 0.8) - origin)
        })
        .collect();
    for shape in shapes {
        let once = Asked::one(shape.clone()).nearest_each(&rays, f64::INFINITY);
        let twice = Asked::new([shape.clone(), shape]).nearest_each(&rays, f64::INFINITY);
        assert_eq!(once, twice);
        assert!(once.iter().flatten().count() > 100);
    }
}

/// Where a ball rests on a floor, the floor is in its shadow right up to the point
/// where they touch.
#[test]
fn touching_solids() {
    for exponent in [-40, 0, 40] {
        let size = libm::scalbn(1.0, exponent);
        let floor = Shape::plane([0.0; 3], [0.0, 0.0, size], GREY);
        let asked = Asked::new([floor, Shape::sphere([0.0, 0.0, size], size, GREY)]);
        for x in [0.0, 1e-300, 1e-17, 1e-12, 1e-9, 3e-8, 1e-7, 1e-5, 1e-3, 0.5, 0.999] {
            // From below, where the floor is first, and as first as the ball.
            let up = ray([x * size, 0.0, -size], [0.0, 0.0, size]);
            let point = asked.point(&up).expect("the floor is there");
            assert_eq!(point.item, 0, "{x}");
            for way in [Vector::z(), Vector::new(-x, 0.0, 1.0), Vector::new(0.0, 0.01 * x, 1.0)] {
                let hidden = asked.nearest(&point.leave(way));
                assert_eq!(hidden.map(|hit| hit.item), Some(1), "{x} {way}");
            }
            // The ball's underside is in the shadow of the floor.
            let inside = ray([x * size, 0.0, size], [0.0, 0.0, -size]);
            let bottom = asked.prepared().all(&inside, (0.0, f64::INFINITY), Which::All);
            let of_ball = bottom.iter().find(|hit| hit.item == 1).expect("it is closed");
            let point = asked.prepared().expand(&inside, of_ball);
            let below = asked.nearest(&point.leave(-Vector::z()));
            // Where the gap is less than three bounds, the ray may start beyond the floor.
            let gap = point.point.z;
            assert!(below.is_some_and(|hit| hit.item == 0) || gap <= 3.0 * point.error, "{x}");
        }
    }
    // Balls that touch: along the line of their centres each crossing is there.
    let pair = [Shape::sphere([0.0; 3], 1.0, GREY), Shape::sphere([3.0, 0.0, 0.0], 2.0, GREY)];
    let asked = Asked::new(pair);
    let through = asked.line(&ray([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
    let found: Vec<_> = through.iter().map(|hit| (hit.t, hit.item)).collect();
    assert_eq!(found, [(4.0, 0), (6.0, 0), (6.0, 1), (10.0, 1)]);
}

/// An eye exactly on a surface does not see it there: only what is ahead, 0 < t.
#[test]
fn an_eye_on_a_surface() {
    let top = [0.0, 0.0, 65.0];
    // A closed shape, a point of its surface, a direction out of it; all in whole numbers.
    let cases = [
        (Shape::sphere([0.0; 3], 65.0, GREY), [39.0, 52.0, 0.0], [3.0, 4.0, 0.0]),
        (Shape::sphere([0.0; 3], 65.0, GREY), [-25.0, 0.0, 60.0], [-5.0, 1.0, 12.0]),
        (Shape::cuboid([-1.0; 3], [1.0; 3], GREY), [1.0, 0.5, 0.25], [1.0, 2.0, 3.0]),
        (Shape::cuboid([-1.0; 3], [1.0; 3], GREY), [1.0, 1.0, 1.0], [1.0, 2.0, 3.0]),
        (Shape::cylinder([0.0; 3], top, 65.0, GREY), [39.0, 52.0, 5.0], [3.0, 4.0, 1.0]),
        (Shape::cylinder([0.0; 3], top, 65.0, GREY), [9.0, 5.0, 65.0], [3.0, 4.0, 1.0]),
        (Shape::cone(top, [0.0; 3], 65.0, GREY), [0.0, 0.0, 0.0], [0.0, 1.0, -2.0]),
        (Shape::cone(top, [0.0; 3], 65.0, GREY), [9.0, 5.0, 65.0], [3.0, 4.0, 1.0]),
        (
            Shape::tetrahedron([[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]], GREY),
            [1.0, 1.0, 2.0],
            [1.0, 1.0, 1.0],
        ),
    ];
    for (shape, at, out) in cases {
        let asked = Asked::one(shape);
        assert_eq!(asked.t(&ray(at, out)), None, "{at:?} {out:?}");
        let inward = ray(at, out.map(|c| -c));
        let found = asked.ts(&inward);
        assert_eq!(found.len(), 2, "{at:?}: {found:?}");
        assert!(found[0] == 0.0 && found[1] > 1e-3, "{at:?}: {found:?}");
        assert_eq!(asked.t(&inward), Some(found[1]), "{at:?}");
    }
    for flat in [
        Shape::plane([0.0; 3], [1.0, 2.0, 2.0], GREY),
        Shape::disc([0.0; 3], [1.0, 2.0, 2.0], 9.0, GREY),
        Shape::triangle([[2.0, -1.0, 0.0], [-2.0, 0.0, 1.0], [0.0, 1.0, -1.0]], GREY),
        Shape::rectangle([-2.0, 0.0, 1.0], [[4.0, -2.0, 0.0], [0.0, 1.0, -1.0]], GREY),
    ] {
        let asked = Asked::one(flat);
        for d in signs_of_zeros([1.0, 0.0, 0.0]).chain(signs_of_zeros([0.0, -3.0, 1.0])) {
            for d in [d, d.map(|c| -c)] {
                assert_eq!(asked.t(&ray([0.0; 3], d)), None, "{d:?}");
            }
        }
    }
}
