//! A scene with everything in it, and what must not change its picture.

use crate::help::{black, floor, glass, mirror, scene, shining, smoke, white};
use lancer_integrator::{RenderSettings, Rendered, Whitted, render};
use lancer_math::{Placement, Vector};
use lancer_scene::{Camera, Colour, Group, Light, Mesh, Scene, Shape, Surface};
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Every kind of shape, light and surface.
fn everything() -> Scene {
    let glossy = Surface::new(Colour::ORANGE).gloss(0.3).expect("in range");
    let tinted = glass(1.5).absorption([0.1, 0.5, 1.0]).expect("in range");
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.3, 1.0]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mesh = Mesh::new(corners.to_vec(), triangles).expect("valid");
    let things = vec![
        Shape::sphere([0.0, 0.0, 0.5], 0.5, tinted).expect("valid"),
        Shape::torus([0.0, 0.0, 0.5], [1.0, 0.0, 1.0], [0.9, 0.15], glossy).expect("valid"),
    ];
    let things = Arc::new(Group::new(Some("things".into()), things, Vec::new()).expect("few"));
    let turned = Placement::rotate(Vector::new(0.2, 0.3, 1.0), 40.0).expect("an axis");
    let flat = Placement::scale(Vector::new(1.0, 1.5, 0.6)).expect("it has an inverse");
    scene(Camera::new([0.5, -7.0, 3.0], [0.0, 0.0, 0.7], 6.0, [70, 50]), 0.2)
        .shape(floor(0.0, white().checker(Colour::BROWN)))
        .shape(Shape::plane([0.0, 5.0, 0.0], [0.0, -1.0, 0.1], mirror(0.7)))
        .shape(Shape::sphere([-1.5, 0.5, 0.8], 0.8, mirror(0.9)))
        .shape(Shape::cuboid([1.0, -1.0, 0.0], [2.0, 0.0, 1.3], tinted))
        .shape(Shape::sphere([1.5, -0.5, 0.7], 0.4, glass(1.33)))
        .shape(Shape::cylinder([-0.6, -1.5, 0.0], [-0.4, -1.5, 0.9], 0.3, glossy))
        .shape(Shape::cone([0.4, -2.0, 0.0], [0.4, -2.0, 0.8], 0.3, glass(1.2)))
        .shape(Shape::disc([0.0, 1.0, 2.0], [0.1, 1.0, 0.2], 0.7, glass(1.5).thin()))
        .shape(Shape::triangle([[-3.0, 2.0, 0.1], [-2.0, 2.0, 0.1], [-2.5, 2.0, 1.5]], glossy))
        .shape(Shape::rectangle([2.2, 1.0, 0.2], [[1.0, 0.0, 0.0], [0.0, 0.3, 1.0]], glossy))
        .shape(Shape::tetrahedron(corners, smoke([0.5, 0.1, 0.0])))
        .shape(Shape::mesh(Arc::new(mesh), shining([0.3, 0.2, 0.1])))
        .shape(Shape::sphere([0.0, -1.0, 4.0], 0.2, black()))
        .group(turned.then(&Placement::translate(Vector::new(0.0, 3.0, 0.0))), Arc::clone(&things))
        .group(flat.then(&Placement::translate(Vector::new(-2.5, -1.5, 0.0))), things)
        .light(Light::lamp([-3.0, -4.0, 5.0], 20.0))
        .light(Light::sun([0.5, 0.8, -1.0], 0.4))
        .light(Light::spot([2.0, -3.0, 4.0], [-0.3, 0.6, -1.0], [15.0, 30.0], 15.0))
        .light(Light::lamp([0.0, 0.0, 9.0], 0.1).map(Light::without_falloff))
        .build()
        .expect("valid")
}

fn by_threads(scene: &Scene, threads: usize) -> Rendered {
    let settings = RenderSettings {
        layers: true,
        for_display: true,
        threads: NonZeroUsize::new(threads),
        ..RenderSettings::default()
    };
    render(scene, &Whitted::new(), &settings).expect("it renders")
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let scene = everything();
    let one = by_threads(&scene, 1);
    for threads in [2, 3, 7] {
        let more = by_threads(&scene, threads);
        assert_eq!(more.threads, threads);
        assert_eq!(more.film, one.film);
        assert_eq!(more.layers, one.layers);
        assert_eq!(more.counts, one.counts);
    }
    // Else this would show little.
    let counts = one.counts;
    assert_eq!(counts.primary, 70 * 50);
    assert!(counts.reflected > 1000 && counts.transmitted > 1000 && counts.shadow > 10_000);
    assert!(one.film.pixels().iter().flatten().all(|v| v.is_finite() && *v >= 0.0));
}

/// A picture is the same whether other pixels are asked for or not.
#[test]
fn a_part_of_the_frame_is_a_part_of_its_picture() {
    let scene = everything();
    let whole = by_threads(&scene, 2);
    let window = lancer_film::Window { x: 11, y: 7, width: 40, height: 29 };
    let settings =
        RenderSettings { window: Some(window), layers: true, ..RenderSettings::default() };
    let part = render(&scene, &Whitted::new(), &settings).expect("it renders");
    let layers = [&part, &whole].map(|r| r.layers.as_ref().expect("asked for"));
    for (x, y) in (7..36).flat_map(|y| (11..51).map(move |x| (x, y))) {
        assert_eq!(part.film.pixel(x, y), whole.film.pixel(x, y));
        assert_eq!(layers[0].pixel(x, y), layers[1].pixel(x, y));
    }
    assert_eq!(part.counts.primary, 40 * 29);
}

/// The order of shapes decides where they are at the very same distance, and
/// nothing else.
#[test]
fn the_order_of_shapes_changes_no_more_than_rounding() {
    let scene = everything();
    let mut other = scene.clone();
    other.shapes.reverse();
    other.groups.reverse();
    other.lights.reverse();
    let (a, b) = (by_threads(&scene, 2), by_threads(&other, 2));
    let pairs = a.film.pixels().iter().flatten().zip(b.film.pixels().iter().flatten());
    let differing = pairs.filter(|(a, b)| (**a - **b).abs() > 1e-4).count();
    assert_eq!(differing, 0);
}
