//! Transparent triangles and meshes: found again where they were found first,
//! whatever their size, and left on the side to which a ray goes.

use crate::help::{glass, rendered, scene};
use lancer_integrator::{Trouble, Whitted};
use lancer_math::{Placement, Vector};
use lancer_scene::{Camera, Colour, Group, InvalidField, Light, Mesh, Shape, Surface};
use std::sync::Arc;

fn camera() -> Result<Camera, InvalidField> {
    Camera::new([3.0, -7.0, 4.0], [0.1, 0.2, 0.3], 5.0, [60, 45])
}

/// A crossing may be beyond the flat box around its triangle, by rounding; it is
/// there all the same.
#[test]
fn a_large_sheet_halves_what_is_behind_it() {
    let half = Surface::new(Colour::BLACK).transparency(0.5).expect("in range").thin();
    let half = Surface { medium: glass(1.0).medium, ..half };
    for size in [1.0, 1e3, 1e6, 1e9] {
        let corners = [[-size, -size, 0.0], [size, -size, 0.0], [0.0, 2.0 * size, 0.0]];
        let triangle = Shape::triangle(corners, half);
        let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).expect("valid");
        for shape in [triangle, Shape::mesh(Arc::new(mesh), half)] {
            let film = rendered(scene(camera(), 1.0).shape(shape), Whitted::CUTOFF).film;
            for pixel in film.pixels() {
                assert!([[0.5; 3], [1.0; 3]].contains(pixel), "{size}: {pixel:?}");
            }
            assert!(film.pixels().contains(&[0.5; 3]), "{size}");
        }
    }
}

/// Of two boxes that touch, the one is described where it is, the other a
/// thousand units away and moved: its coordinates are known less well.
#[test]
fn faces_touch_even_if_one_is_known_less_well() {
    let lamp = || Light::lamp([3.0, -4.0, 6.0], 30.0);
    let below = || Shape::cuboid([-1.0, -1.0, 0.0], [1.0, 1.0, 0.7], glass(1.5));
    let floor = || {
        let checker = Surface::new(Colour::WHITE).checker(Colour::RED);
        Shape::plane([0.0, 0.0, -0.5], [0.0, 0.0, 1.0], checker)
    };
    let plain = Shape::cuboid([-1.0, -1.0, 0.7], [1.0, 1.0, 1.2], glass(1.333));
    let plain = scene(camera(), 0.3).light(lamp()).shape(floor()).shape(below()).shape(plain);
    let plain = rendered(plain, Whitted::CUTOFF);
    for away in [1000.1, 123_456.7] {
        let far = Shape::cuboid([-1.0, -1.0, 0.7 + away], [1.0, 1.0, 1.2 + away], glass(1.333));
        let group = Group::new(None, vec![far.expect("valid")], Vec::new()).expect("small");
        let moved = scene(camera(), 0.3)
            .light(lamp())
            .shape(floor())
            .shape(below())
            .group(Placement::translate(Vector::new(0.0, 0.0, -away)), group);
        let moved = rendered(moved, Whitted::CUTOFF);
        assert_eq!(moved.counts.troubles.media, Trouble::default());
        let off = plain
            .film
            .pixels()
            .iter()
            .zip(moved.film.pixels())
            .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 1e-3));
        // The borders of cells, where a hair decides.
        assert!(off.count() <= 5, "{away}");
    }
}

/// Rays are bent by the normals at the corners, and still go through the
/// triangles that they meet.
#[test]
fn a_smooth_ball_of_glass_keeps_its_media() {
    let (mut corners, mut triangles) = (vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], Vec::new());
    let (rings, steps) = (7_u32, 12_u32);
    for ring in 1..=rings {
        let (s, c) = lancer_math::sin_cos_degrees(180.0 * f64::from(ring) / f64::from(rings + 1));
        for step in 0..steps {
            let (y, x) = lancer_math::sin_cos_degrees(30.0 * f64::from(step));
            corners.push([s * x, s * y, c]);
        }
    }
    let at = |ring: u32, step: u32| 2 + ring * steps + step % steps;
    for step in 0..steps {
        triangles.push([0, at(0, step), at(0, step + 1)]);
        triangles.push([1, at(rings - 1, step + 1), at(rings - 1, step)]);
        for ring in 0..rings - 1 {
            let (a, b) = (at(ring, step), at(ring, step + 1));
            let (c, d) = (at(ring + 1, step), at(ring + 1, step + 1));
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    let mesh = Mesh::new(corners, triangles).expect("valid").with_smooth_normals();
    assert!(mesh.is_closed() && mesh.signed_volume() > 0.0);
    let camera = Camera::new([0.0, -4.0, 0.5], [0.0; 3], 2.5, [40, 40]);
    let ball = Shape::mesh(Arc::new(mesh), glass(1.5));
    let result = rendered(scene(camera, 1.0).shape(ball), 1e-3);
    assert_eq!(result.counts.troubles.media, Trouble::default());
}
