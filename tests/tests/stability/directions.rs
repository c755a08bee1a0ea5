//! Directions of rays from the eye do not depend on where the eye is.

use super::films::bits;
use lancer_integrator::{RenderSettings, Rendered, engine_by_name, render};
use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};

fn rendered(s: f64) -> Rendered {
    let at = |x: f64, y: f64, z: f64| [s + x, s + y, s + z];
    let white = Surface::new(Colour::WHITE);
    let scene = Scene::builder()
        .camera(Camera::new([s; 3], at(1.0, 2.0, 2.0), 1.5, [96, 96]))
        .light(Light::sun([1.0, 1.0, 3.0], 0.9))
        // Distances are whole numbers, so that they are there at 2^52, too.
        .shape(Shape::sphere(at(1024.0, 2048.0, 2048.0), 1000.0, white.checker(Colour::RED)))
        .shape(Shape::sphere(at(1000.0, 1000.0, 2048.0), 300.0, white))
        .build()
        .expect("valid");
    let settings = RenderSettings { layers: true, ..RenderSettings::default() };
    let whitted = engine_by_name("whitted").expect("there is such an engine");
    render(&scene, whitted, &settings).expect("it renders")
}

/// The same pictures, distances and normals, to the last bit.
#[test]
fn k3_from_anywhere() {
    let first = rendered(0.0);
    let layers = first.layers.as_ref().expect("they were asked for").pixels();
    assert!(layers.iter().filter(|pixel| pixel.shape != 0).count() > 3000);
    for exponent in [10, 20, 30, 40, 45, 50, 52] {
        let moved = rendered(libm::scalbn(1.0, exponent));
        let there = moved.layers.as_ref().expect("they were asked for").pixels();
        assert_eq!(there, layers, "2^{exponent}");
        if exponent <= 40 {
            // Beyond, shadow rays start so far from a sphere that its shadow shows it.
            assert_eq!(bits(&moved.film), bits(&first.film), "2^{exponent}");
        }
    }
}
