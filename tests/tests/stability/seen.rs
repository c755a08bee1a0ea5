//! Shapes of which a picture shows whether they are met: far ones, tiny ones, and a
//! point without a normal.

use crate::pictures::{built, file, floor, scene, seen, shining};
use lancer_scene::{Camera, Shape};

/// No largest distance: a ball that covers the same angle looks the same however far it
/// is. Elsewhere there is nothing beyond 1e7.
#[test]
fn p3_what_is_far_away_is_seen() {
    let near = seen(&file("far_objects", &[]));
    let lit = |rendered: &lancer_integrator::Rendered| {
        rendered.film.pixels().iter().filter(|pixel| pixel[0] > 0.0).count()
    };
    // tan b = tan asin 0.2 = 1/sqrt(24), in a picture of 48 x 48 pixels that is 0.72 wide.
    let area = std::f64::consts::PI / 24.0 / (0.72 * 0.72) * 48.0 * 48.0;
    assert!((lit(&near) as f64 / area - 1.0).abs() < 0.02, "{} {area}", lit(&near));
    for exponent in [7, 8, 12, 40, 70] {
        let (centre, radius) =
            (format!("y=\"1e{exponent}\""), format!("size=\"2e{}\"", exponent - 1));
        let far = file("far_objects", &[("y=\"10\"", &centre), ("size=\"2\"", &radius)]);
        assert_eq!(lit(&seen(&far)), lit(&near), "1e{exponent}");
    }
    for distance in [1.01e7, 1e12, 1e60] {
        let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [1, 1]);
        let wall = Shape::plane([0.0, distance, 0.0], [0.0, 1.0, 0.0], shining(1.0));
        let ahead = seen(&built(scene(camera, 0.0).shape(wall).shape(floor(-1.0, shining(0.5)))));
        assert_eq!(ahead.film.pixel(0, 0), [1.0; 3], "{distance}");
    }
}

/// Radii down to the smallest numbers cover the same part of a picture. Elsewhere a part
/// of 1e-10 / r^2 is missing, and all of it at 1e-5.
#[test]
fn s6_tiny_and_huge_balls_cover_the_same_part() {
    let lit = |radius: f64| {
        let camera = Camera::new([0.0, -2.0 * radius, 0.0], [0.0; 3], 1.0, [65, 65])
            .and_then(|camera| camera.orthographic(4.0 * radius));
        let ball = Shape::sphere([0.0; 3], radius, shining(1.0));
        let film = seen(&built(scene(camera, 0.0).shape(ball))).film;
        film.pixels().iter().filter(|pixel| pixel[0] > 0.0).count()
    };
    let expected = lit(1.0);
    let area = std::f64::consts::PI / 16.0 * 65.0 * 65.0;
    assert!((expected as f64 / area - 1.0).abs() < 0.02, "{expected} {area}");
    for radius in [1e-3, 3e-5, 1e-5, 1e-9, 1e-30, 1e-70, 1e30, 1e70] {
        assert_eq!(lit(radius), expected, "{radius}");
    }
}

/// At an apex the gradient is nothing. Pass: finite values, and a pixel between the
/// darkest and the brightest of its neighbours. Elsewhere it is 1.0 among 0.3586.
#[test]
fn c5_a_ray_through_an_apex_is_lit_as_its_neighbours_are() {
    let rendered = seen(&file("cone_apex", &[]));
    // The light is frontal and the side as steep as the cone is slender.
    let around = 0.3 / 1.09_f64.sqrt();
    for (x, y) in (11..=13).flat_map(|y| (11..=13).map(move |x| (x, y))) {
        let value = f64::from(rendered.film.pixel(x, y)[0]);
        assert!((value - around).abs() <= 1.0 / 255.0, "{x} {y}: {value} {around}");
    }
    let apex = rendered.layers.expect("asked for").pixels()[12 * 25 + 12];
    let [x, y, z] = apex.normal.map(f64::from);
    assert!((x * x + y * y + z * z - 1.0).abs() < 1e-6, "{:?}", apex.normal);
    assert_eq!(apex.ray_depth, 5.0);
}
