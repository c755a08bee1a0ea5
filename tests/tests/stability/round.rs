//! Cylinders and cones: along the axis, thin and far away, through rims, parallel
//! to a line of the side, and through the apex.

use super::asked::{Asked, GREY, Made, assert_near, ray, signs_of_zeros, ulp};
use super::films::{brightness, film};
use fastrand::Rng;
use lancer_kernel::Which;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Light, Scene, Shape};

fn open(shape: Made) -> Made {
    shape.map(Shape::without_lids)
}

/// Along z from the origin.
fn cylinder(length: f64, radius: f64) -> Made {
    Shape::cylinder([0.0; 3], [0.0, 0.0, length], radius, GREY)
}

#[test]
fn c1_nearly_along_the_axis() {
    let u = 0.5 * f64::EPSILON;
    for exponent in [-100, -40, 0, 40, 100] {
        let size = libm::scalbn(1.0, exponent);
        let pipe = Asked::one(open(cylinder(size, size)));
        let grazing = ray([(1.0 - 1e-6) * size, 0.0, 0.0], [5e-6 * size, 0.0, size]);
        // (1 - x) / d for the doubles x and d that are nearest to these.
        let expected = 0.200_000_000_005_751_13;
        assert_near(pipe.t(&grazing), expected, 4.0 * u * expected);
    }
    // So long that it is as good as infinite.
    let endless = Asked::one(open(cylinder(1e160, 1.0)));
    for s in [1e-3, 1e-8, 1e-10, 1e-20, 1e-50, 1e-100, 1e-150] {
        let t = endless.t(&ray([0.5, 0.0, 0.0], [s, 0.0, 1.0]));
        assert_near(t, 0.5 / s, 4.0 * u * (0.5 / s));
    }
    // Out of its end instead, which is open.
    for s in [1e-170, 1e-300, 5e-324, 0.0, -0.0] {
        assert_eq!(endless.t(&ray([0.5, 0.0, 0.0], [s, 0.0, 1.0])), None, "{s}");
    }
}

/// Exactly along the axis the side is never met, and lids are.
#[test]
fn c1_along_the_axis() {
    let (solid, pipe) = (Asked::one(cylinder(1.0, 1.0)), Asked::one(open(cylinder(1.0, 1.0))));
    for x in [0.0, 0.5, 1.0_f64.next_down(), 1.0] {
        for d in signs_of_zeros([0.0, 0.0, 1.0]) {
            assert_eq!(solid.ts(&ray([x, 0.0, -1.0], d)), [1.0, 2.0], "{x} {d:?}");
            assert!(pipe.line(&ray([x, 0.0, -1.0], d)).is_empty(), "{x} {d:?}");
        }
    }
    for d in signs_of_zeros([0.0, 0.0, -1.0]) {
        assert!(solid.line(&ray([1.0_f64.next_up(), 0.0, 9.0], d)).is_empty(), "{d:?}");
        assert!(pipe.line(&ray([1.0_f64.next_up(), 0.0, 9.0], d)).is_empty(), "{d:?}");
    }
}

#[test]
fn c2_a_hair_from_afar() {
    const RADIUS: f64 = 1e-4;
    for offset in [0.0, 1e3, 1e6] {
        let hair = Asked::one(Shape::cylinder(
            [offset, offset, offset - 1.0],
            [offset, offset, offset + 1.0],
            RADIUS,
            GREY,
        ));
        for d in [100.0, 1e3, 1e4, 1e5] {
            let eye = [offset - d, offset + 0.5e-4, offset];
            // What rounding has made of it is known exactly.
            let (back, aside) = (offset - eye[0], eye[1] - offset);
            let half = ((RADIUS - aside) * (RADIUS + aside)).sqrt();
            let expected = back - half;
            let t = hair.t(&ray(eye, [1.0, 0.0, 0.0]));
            assert_near(t, expected, 2.0 * ulp(d));
            if d <= 1e4 {
                assert_near(t, back - half, 1e-3 * RADIUS);
            }
        }
    }
    // The closed form at the origin.
    assert_near(Some((0.75e-8_f64).sqrt()), 8.660_254_037_844_386e-05, 1e-19);
}

/// Points of the circle of radius 65 with whole coordinates.
const ON_CIRCLE: [[i32; 2]; 8] =
    [[39, 52], [25, 60], [33, 56], [16, 63], [-39, 52], [-60, -25], [56, -33], [-16, -63]];

/// Rays of whole numbers through points of a rim. Whether the line goes into the
/// solid there is a question of signs.
#[test]
fn c3_rims_and_parity() {
    let top = [0.0, 0.0, 65.0];
    let solids = [
        ("cylinder", Shape::cylinder([0.0; 3], top, 65.0, GREY), 0, 65),
        ("cone", Shape::cone(top, [0.0; 3], 65.0, GREY), 1, 65),
        ("frustum", Shape::frustum(([0.0; 3], 130.0), (top, 65.0), GREY), -1, 65),
    ];
    for (name, shape, slope, rim) in solids {
        let solid = Asked::one(shape);
        let mut rng = Rng::with_seed(3);
        let (mut met, mut through) = (0, 0);
        for case in 0..330_000 {
            let [x, y] = ON_CIRCLE[rng.usize(0..8)];
            let mut whole = |n: i32| rng.i32(-n..=n);
            let d = [whole(9), whole(9), whole(9)];
            let steps = whole(100);
            let target = [x, y, rim];
            let origin: [i32; 3] = std::array::from_fn(|i| target[i] - steps * d[i]);
            let ray = ray(origin.map(f64::from), d.map(f64::from));
            let found = if case % 100 == 0 {
                solid.line(&ray)
            } else {
                let stretch = (f64::NEG_INFINITY, f64::INFINITY);
                solid.prepared().all(&ray, stretch, Which::All)
            };
            assert!(matches!(found.len(), 0 | 2), "{name} {case}: {found:?} {ray:?}");
            // Inside is below the lid, and where 65 times the distance from the side
            // shrinks.
            let outward = x * d[0] + y * d[1] - slope * 65 * d[2];
            let goes_through = (d[2] < 0 && outward < 0) || (d[2] > 0 && outward > 0);
            if goes_through {
                assert_eq!(found.len(), 2, "{name} {case}: {ray:?}");
                through += 1;
            }
            met += found.len();
            let [from, to] = &found[..] else { continue };
            assert!(from.t <= to.t, "{name} {case}: {found:?}");
            for t in [from.t, to.t] {
                let z = ray.at(t).z;
                let slack = 4.0 * ulp(65.0 + (ray.origin.z).abs());
                assert!((-slack..=65.0 + slack).contains(&z), "{name} {case}: {z} {ray:?}");
            }
            let middle = ray.at(0.5 * (from.t + to.t));
            let widest = match slope {
                0 => 65.0,
                1 => middle.z,
                _ => 130.0 - middle.z,
            };
            let slack = 1e-12 * (65.0 + ray.origin.coords.amax());
            assert!(libm::hypot(middle.x, middle.y) <= widest + slack, "{name} {case}: {middle}");
        }
        assert!(met > 200_000 && through > 50_000, "{name}: {met} {through}");
    }
}

/// From inside, one crossing is ahead.
#[test]
fn c3_from_inside_one_is_ahead() {
    let top = [0.0, 0.0, 65.0];
    for shape in
        [Shape::cylinder([0.0; 3], top, 65.0, GREY), Shape::cone(top, [0.0; 3], 65.0, GREY)]
    {
        let solid = Asked::one(shape);
        let mut rng = Rng::with_seed(33);
        for case in 0..20_000 {
            let [x, y] = ON_CIRCLE[rng.usize(0..8)];
            let mut half = || 0.5 * (2.0 * rng.f64() - 1.0);
            let origin = [20.0 * half(), 20.0 * half(), 50.0 + 20.0 * half()];
            let way = [x, y, 65].map(f64::from);
            let ray = ray(origin, std::array::from_fn(|i| way[i] - origin[i]));
            let ahead = solid.prepared().all(&ray, (0.0, f64::INFINITY), Which::All);
            assert_eq!(ahead.len(), 1, "{case}: {ahead:?} {ray:?}");
        }
    }
}

/// The cone x^2 + y^2 = z^2 up to z = 8.
fn cone() -> Made {
    Shape::cone([0.0, 0.0, 8.0], [0.0; 3], 8.0, GREY)
}

/// Parallel to a line of the side, a ray meets the mirror image alone, which is
/// not there.
#[test]
fn c4_parallel_to_the_side() {
    let cone = Asked::one(open(cone()));
    assert!(cone.line(&ray([3.0, 0.0, 1.0], [-1.0, 0.0, -1.0])).is_empty());
    // From inside it meets the side once: at (-1.6, 3, 3.4).
    let found = cone.ts(&ray([0.0, 3.0, 5.0], [-1.0, 0.0, -1.0]));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_near(Some(found[0]), 1.6, 1.6e-13);
}

/// In the side of a cylinder a ray is inside, in that of a cone it is not.
#[test]
fn along_the_side() {
    let cylinder = Asked::one(cylinder(1.0, 65.0));
    let cone = Asked::one(cone());
    for [x, y] in ON_CIRCLE.map(|p| p.map(f64::from)) {
        for d in signs_of_zeros([0.0, 0.0, 1.0]) {
            assert_eq!(cylinder.ts(&ray([x, y, -1.0], d)), [1.0, 2.0], "{x} {y}");
        }
        let along = ray([2.0 * x, 2.0 * y, 130.0], [-x, -y, -65.0]);
        assert!(cone.line(&along).is_empty(), "{x} {y}");
    }
}

/// That ray turned a little. The roots of the quadratic with the rounded sine and
/// cosine of 45 degrees and so many radians, from 60 digits.
#[test]
fn c4_nearly_parallel_to_the_side() {
    const TURNED: [(f64, f64, f64); 14] = [
        (0.707_813_534_296_521_8, 0.706_399_320_969_850_9, 2.263_557_190_650_716),
        (0.706_399_320_969_850_9, 0.707_813_534_296_521_8, 2.261_928_015_516_851_5),
        (0.707_107_488_292_975_2, 0.707_106_074_079_412_8, 2.262_742_514_384_867),
        (0.707_106_074_079_412_8, 0.707_107_488_292_975_2, 2.262_740_885_210_843_3),
        (0.707_106_781_893_654_3, 0.707_106_780_479_440_8, 2.262_741_700_611_539),
        (0.707_106_780_479_440_8, 0.707_106_781_893_654_3, 2.262_741_698_982_365),
        (0.707_106_781_187_254_7, 0.707_106_781_185_840_5, 2.262_741_699_797_766_5),
        (0.707_106_781_185_840_5, 0.707_106_781_187_254_7, 2.262_741_699_796_137),
        (0.707_106_781_186_618_2, 0.707_106_781_186_476_9, 2.262_741_699_797_033_3),
        (0.707_106_781_186_476_9, 0.707_106_781_186_618_2, 2.262_741_699_796_871),
        (0.707_106_781_186_554_6, 0.707_106_781_186_540_5, 2.262_741_699_796_96),
        (0.707_106_781_186_540_5, 0.707_106_781_186_554_6, 2.262_741_699_796_944),
        (0.707_106_781_186_548_2, 0.707_106_781_186_546_8, 2.262_741_699_796_953),
        (0.707_106_781_186_546_8, 0.707_106_781_186_548_2, 2.262_741_699_796_951),
    ];
    for exponent in [-100, -40, 0, 40, 100] {
        let size = libm::scalbn(1.0, exponent);
        let shape = Shape::cone([0.0, 0.0, 8.0 * size], [0.0; 3], 8.0 * size, GREY);
        let cone = Asked::one(shape);
        for (x, z, expected) in TURNED {
            let t = cone.t(&ray([0.0, 3.0 * size, 5.0 * size], [-x * size, 0.0, -z * size]));
            assert_near(t, expected, 1e-13 * expected);
        }
    }
}

/// At the apex the normal is one of those around it, whatever way the ray comes.
#[test]
fn c5_apex() {
    let cone = Asked::one(cone());
    let mut rng = Rng::with_seed(5);
    for case in 0..2000 {
        let way = match case {
            0 => Vector::z(),
            1 => Vector::x(),
            _ => Vector::from_fn(|_, _| f64::from(rng.i32(-9..=9))),
        };
        let ray = Ray::new(Point::from(way * -3.0), way);
        let Some(point) = cone.point(&ray) else { continue };
        let slope = point.normal.z;
        assert!((point.normal.norm() - 1.0).abs() < 1e-15 && point.point.coords.amax() < 1e300);
        if point.point == Point::origin() {
            // As on the side: by 45 degrees away from the axis.
            assert!((slope + 0.5_f64.sqrt()).abs() < 1e-15, "{way}: {}", point.normal);
        }
    }
}

/// From in front, by parallel rays of which the middle one goes exactly through the
/// apex: it is as bright as the eight around it.
#[test]
fn c5_apex_in_a_picture() {
    for (sun, base) in [([0.0, 0.0, 1.0], 1.0), ([0.3, -0.2, 1.0], 1.0), ([0.5, 0.5, 1.0], 4.0)] {
        let camera = Camera::new([0.0, 0.0, -5.0], [0.0; 3], 1.0, [9, 9]);
        let scene = Scene::builder()
            .camera(camera.and_then(|camera| camera.orthographic(1.5)))
            .light(Light::sun(sun, 0.8))
            .shape(Shape::cone([0.0, 0.0, 1.0], [0.0; 3], base, GREY))
            .build()
            .expect("valid");
        let film = film(&scene, "whitted");
        let at = |x, y| brightness(film.pixel(x, y));
        let around: Vec<f32> = (3..6)
            .flat_map(|x| (3..6).map(move |y| (x, y)))
            .filter(|place| *place != (4, 4))
            .map(|(x, y)| at(x, y))
            .collect();
        let (least, most) =
            around.iter().fold((f32::MAX, 0.0_f32), |(a, b), v| (a.min(*v), b.max(*v)));
        let apex = at(4, 4);
        assert!(most > 0.0 && around.iter().all(|v| v.is_finite()), "{around:?}");
        let slack = 1.0 / 255.0;
        assert!(apex >= least - slack && apex <= most + slack, "{apex} among {around:?}");
    }
}
