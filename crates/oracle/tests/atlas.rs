//! Known failures of numerical methods, against closed forms.

use lancer_math::{Point, Ray, Vector};
use lancer_oracle::{Crossings, Line, Passage, Space, crossings};
use lancer_scene::{Colour, InvalidField, Shape, Surface};

fn meet(shape: Result<Shape, InvalidField>, origin: [f64; 3], direction: [f64; 3]) -> Crossings {
    let shape = shape.expect("a valid shape");
    let ray = Ray::new(Point::from(origin), Vector::from(direction));
    crossings(&shape.geometry, &Space::world(), &Line::from(&ray), 300)
}

fn places(found: &Crossings) -> Vec<f64> {
    found.list.iter().map(|crossing| crossing.t.to_f64()).collect()
}

fn red() -> Surface {
    Surface::new(Colour::RED)
}

fn sphere(centre: [f64; 3], radius: f64) -> Result<Shape, InvalidField> {
    Shape::sphere(centre, radius, red())
}

#[test]
fn s1_small_spheres_far_away() {
    for distance in [1e3, 1e5, 1e7, 1e8, 1e9] {
        let found = meet(sphere([0.0; 3], 1.0), [0.9, 0.0, -distance], [0.0, 0.0, 1.0]);
        assert_eq!(found.list.len(), 2);
        assert_eq!(found.list[0].t.to_f64(), distance - 0.435_889_894_354_067_3);
        assert_eq!(found.list[0].passage, Passage::Enters);
    }
    let found = meet(sphere([0.0; 3], 0.1), [-1e7, 0.095, 0.0], [1.0, 0.0, 0.0]);
    assert_eq!(found.list[0].t.to_f64(), 9_999_999.968_775_01);
}

#[test]
fn s2_standing_on_a_planet() {
    let (sine, cosine) = (0.034_899_496_702_500_97, 0.999_390_827_019_095_8);
    let found = meet(sphere([0.0; 3], 6.371e6), [0.0, 6.371e6 + 1.7, 0.0], [cosine, -sine, 0.0]);
    assert!((found.list[0].t.to_f64() / 48.716_634_703_613_64 - 1.0).abs() < 1e-14);
}

#[test]
fn s3_the_eye_at_the_origin_of_a_huge_sphere() {
    let found = meet(sphere([0.0, -1e10, 0.0], 1e10), [0.0, 0.001, 0.0], [1.0, -1.0, 0.0]);
    assert!((found.list[0].t.to_f64() / 0.001_000_000_000_000_05 - 1.0).abs() < 1e-15);
}

#[test]
fn s4_tangents_are_exact() {
    let found = meet(sphere([0.0; 3], 5.0), [-2.0, -11.0, 0.0], [3.0, 4.0, 0.0]);
    assert_eq!(places(&found), [2.0]);
    assert_eq!(found.list[0].passage, Passage::Touches);
    assert_eq!(found.margin, 0.0);
}

#[test]
fn p1_grazing_planes() {
    let plane = || Shape::plane([0.0; 3], [0.0, 1.0, 0.0], red());
    for (height, slope) in [(1e-5, 5e-11), (1.0, 1e-9), (1.0, 1e-12), (1.0, 1e-300)] {
        let found = meet(plane(), [0.0, height, 0.0], [1.0, -slope, 0.0]);
        assert!((found.list[0].t.to_f64() / (height / slope) - 1.0).abs() < 1e-15);
    }
    for zero in [0.0, -0.0] {
        assert!(meet(plane(), [0.0, 1.0, 0.0], [1.0, zero, 0.0]).list.is_empty());
        assert!(meet(plane(), [0.0; 3], [1.0, zero, 0.0]).list.is_empty());
    }
}

#[test]
fn c1_along_the_axis_of_a_tube() {
    let tube = || Shape::cylinder([0.0; 3], [0.0, 0.0, 1.0], 1.0, red()).map(Shape::without_lids);
    let found = meet(tube(), [1.0 - 1e-6, 0.0, 0.0], [5e-6, 0.0, 1.0]);
    assert_eq!(found.list.len(), 1);
    assert!((found.list[0].point.to_f64()[2] - 0.2).abs() < 1e-10);
    assert!(meet(tube(), [0.5, 0.0, -1.0], [0.0, 0.0, 1.0]).list.is_empty());
    let solid = Shape::cylinder([0.0; 3], [0.0, 0.0, 1.0], 1.0, red());
    assert_eq!(places(&meet(solid, [0.5, 0.0, -1.0], [0.0, 0.0, 1.0])), [1.0, 2.0]);
}

#[test]
fn c2_a_hair_seen_from_afar() {
    for distance in [100.0, 1e3, 1e4, 1e5] {
        let hair = Shape::cylinder([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 1e-4, red());
        let found = meet(hair, [-distance, 0.5e-4, 0.0], [1.0, 0.0, 0.0]);
        assert_eq!(found.list[0].t.to_f64(), distance - 8.660_254_037_844_387e-5);
    }
}

#[test]
fn c4_parallel_to_a_generator_of_a_cone() {
    // The part of x^2 + y^2 = z^2 with z from 0 to 10.
    let cone = || Shape::cone([0.0, 0.0, 10.0], [0.0; 3], 10.0, red()).map(Shape::without_lids);
    // It would meet the other nappe at z = -1.
    assert!(meet(cone(), [3.0, 0.0, 1.0], [-1.0, 0.0, -1.0]).list.is_empty());
    // 2 t^2 = (t + 1)^2 has no other root than this with z above 0.
    assert_eq!(places(&meet(cone(), [-3.0, 0.0, 1.0], [1.0, 0.0, 1.0])), [1.0]);
}

#[test]
fn c7_tangents_of_a_torus() {
    let ring = || Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.25], red());
    let along_x = [1.0, 0.0, 0.0];
    let found = meet(ring(), [-3.0, 0.3, 0.25], along_x);
    let root = 0.91_f64.sqrt();
    assert_eq!(found.list.len(), 2);
    for (crossing, x) in found.list.iter().zip([-root, root]) {
        assert_eq!(crossing.passage, Passage::Touches);
        assert!((crossing.point.to_f64()[0] - x).abs() < 1e-15);
        assert!(crossing.normal.to_f64()[2] > 0.999_999);
    }
    assert!(found.margin < 1e-30);
    for (e, x) in [(1e-6, -0.954_680_424_093), (1e-7, -0.954_173_602_418)] {
        let found = meet(ring(), [-3.0, 0.3, 0.25 - e], along_x);
        assert_eq!(found.list.len(), 4);
        assert!((found.list[0].point.to_f64()[0] - x).abs() < 1e-11);
    }
    assert!(meet(ring(), [-3.0, 0.3, 0.25 + 1e-12], along_x).list.is_empty());
    assert_eq!(meet(ring(), [-3.0, 0.3, 0.25 - 1e-12], along_x).list.len(), 4);
    assert_eq!(places(&meet(ring(), [-3.0, 0.0, 0.0], along_x)), [1.75, 2.25, 3.75, 4.25]);
    let horn = Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.0, 1.0], red());
    assert_eq!(places(&meet(horn, [-3.0, 0.0, 0.0], along_x)), [1.0, 3.0, 5.0]);
}

#[test]
fn c6_tori_from_afar() {
    let ring = Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.25], red());
    let direction = [-3.0, -2.0, -6.0].map(|c| c / 7.0);
    let origin = [0.9, 0.1, 0.05];
    let origin: Vec<f64> = origin.iter().zip(direction).map(|(p, d)| p - 1e4 * d).collect();
    let found = meet(ring, [origin[0], origin[1], origin[2]], direction);
    let expected = [9_999.767_097_997_942, 10_000.233_973_236_463];
    assert_eq!(found.list.len(), 2);
    for (crossing, t) in found.list.iter().zip(expected) {
        assert!((crossing.t.to_f64() - t).abs() < 1e-11);
    }
}

#[test]
fn b1_along_faces_of_a_box() {
    let cube = || Shape::cuboid([0.0; 3], [1.0; 3], red());
    for origin in [[0.0, 0.5, -1.0], [1.0, 0.5, -1.0], [0.0, 0.0, -1.0]] {
        for zero in [0.0, -0.0] {
            assert_eq!(places(&meet(cube(), origin, [zero, zero, 1.0])), [1.0, 2.0]);
        }
    }
    assert!(meet(cube(), [2.0, 0.5, -1.0], [0.0, 0.0, 1.0]).list.is_empty());
    let thin = Shape::cuboid([-1.0, -1e-6, -1.0], [1.0, 1e-6, 1.0], red());
    let found = meet(thin, [0.999_95, 1.0, 0.0], [0.0, -1.0, 0.0]);
    assert_eq!(found.list[0].normal.to_f64(), [0.0, 1.0, 0.0]);
}
