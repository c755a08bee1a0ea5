//! Planes: grazing rays, what is behind, and planes far from the origin.

use super::asked::{Asked, GREY, assert_near, ray, signs_of_zeros};
use lancer_kernel::Which;
use lancer_scene::Shape;

fn plane(origin: [f64; 3], normal: [f64; 3]) -> Asked {
    Asked::one(Shape::plane(origin, normal, GREY))
}

/// However flat the ray, it meets the plane where it must.
#[test]
fn p1_grazing() {
    let u = 0.5 * f64::EPSILON;
    for exponent in [-300, -40, 0, 40] {
        let size = libm::scalbn(1.0, exponent);
        for length in [1.0, -3.0, 1e-200, 1e200] {
            let floor = plane([0.0; 3], [0.0, length, 0.0]);
            for (h, s) in [(1e-5, 5e-11), (1.0, 1e-9), (1.0, 1e-12), (1.0, 1e-300)] {
                // The quotient of the doubles that these are, correctly rounded.
                let expected: f64 = h / s;
                let t = floor.t(&ray([0.0, h * size, 0.0], [size, -s * size, 0.0]));
                // Subnormal slopes have fewer digits, and are other numbers then.
                if s * size >= f64::MIN_POSITIVE {
                    assert_near(t, expected, 2.0 * u * expected);
                }
            }
        }
    }
}

#[test]
fn p1_parallel_and_in_the_plane() {
    for normal in signs_of_zeros([0.0, 1.0, 0.0]) {
        let floor = plane([0.0; 3], normal);
        for height in [1.0, 1e-300, 0.0, -0.0, -1.0] {
            for d in signs_of_zeros([1.0, 0.0, 0.0]).chain(signs_of_zeros([-1.0, 0.0, 3.0])) {
                for o in signs_of_zeros([0.0, height, 0.0]) {
                    assert!(floor.line(&ray(o, d)).is_empty(), "{normal:?} {o:?} {d:?}");
                }
            }
        }
    }
    let floor = plane([0.0; 3], [0.0, 1.0, 0.0]);
    for d in [[0.0; 3], [f64::NAN, -1.0, 0.0], [0.0, f64::NAN, 0.0], [0.0, f64::NEG_INFINITY, 0.0]]
    {
        assert!(floor.nearest(&ray([0.0, 1.0, 0.0], d)).is_none(), "{d:?}");
    }
}

/// A plane is nowhere but ahead, and it is there from both sides.
#[test]
fn p2_behind_and_from_the_back() {
    let floor = Shape::plane([0.0; 3], [0.0, 0.0, 1.0], GREY);
    let ball = Shape::sphere([0.0, 4.0, 1.0], 1.0, GREY);
    let both = Asked::new([floor.clone(), ball]);
    let floor = Asked::one(floor);
    for i in -50..=50 {
        for j in -50..=50 {
            let [x, y] = [i, j].map(|k| f64::from(k) * 0.01);
            // (a) Away from the plane.
            let away = ray([0.0, 0.0, -1.0], [x, 1.0, -0.51 + y]);
            assert!(floor.nearest(&away).is_none(), "{away:?}");
            // (b) From below, a ball stands above the floor: it is hidden.
            let up = ray([0.0, 0.0, -1.0], [x, 1.0, 0.51 + y]);
            assert_eq!(both.nearest(&up).map(|hit| hit.item), Some(0), "{up:?}");
        }
    }
    // (c) A point and a lamp below the floor.
    let from = ray([0.0, 9.5, -5.5], [0.0, -4.5, -14.5]);
    assert!(!floor.prepared().any(&from, 1.0, Which::All));
    assert!(floor.nearest(&from).is_none());
}

/// Far from the origin the difference is taken first, so nothing is lost.
#[test]
fn p3_oblique_and_far() {
    for s in [0.0, 1e3, 1e8, 1e12, 1e15] {
        let oblique = plane([s; 3], [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]);
        let third = 1.0 / 3.0;
        let way = [-2.0 * third, -third, -2.0 * third];
        // (2, 1, 2) off the plane, towards it.
        let t = oblique.t(&ray([s + 2.0, s + 1.0, s + 2.0], way));
        assert_near(t, 3.0, 1e-13);
    }
}

#[test]
fn p3_there_is_no_largest_distance() {
    for distance in [1.01e7, 1e12, 1e100, 1e300, f64::MAX] {
        let wall = plane([0.0, 0.0, distance], [0.0, 0.0, -1.0]);
        assert_eq!(wall.t(&ray([0.0; 3], [0.0, 0.0, 1.0])), Some(distance));
        let ball = Asked::one(Shape::sphere([0.0, 0.0, distance], distance / 4.0, GREY));
        if distance < 1e150 {
            let expected = 0.75 * distance;
            assert_near(ball.t(&ray([0.0; 3], [0.0, 0.0, 1.0])), expected, 1e-15 * distance);
        }
    }
}
