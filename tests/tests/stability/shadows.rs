//! H: what hides light, and what must not.

use crate::pictures::{
    FILM, assert_near, black, built, eye, file, floor, middle, mirror, power, scene, seen, shining,
    white,
};
use lancer_scene::{Camera, Light, Mesh, SceneBuilder, Shape};
use std::f64::consts::PI;
use std::sync::Arc;

/// Pass: exactly 0 at every height of at least 16 last places of the scene's size; the
/// disc is 2 wide, so that is 2^-47. (A ray leaves the floor by 16 last places of the
/// largest coordinate, 2^-48 here, and what is promised is 24.) Elsewhere the floor is fully lit where the disc is 9e-4 above it.
#[test]
fn h2_a_disc_shades_the_floor_that_it_nearly_touches() {
    for height in [1e-1, 1e-3, 9e-4, 1e-6, 1e-9, 1e-12, power(-47)] {
        // From between the two.
        let (disc, at) = (format!("z=\"{height:e}\""), format!("z=\"{:e}\"", height / 2.0));
        let changes = [("z=\"1e-6\"", disc.as_str()), ("z=\"5e-7\"", &at)];
        assert_eq!(middle(&file("contact_shadow", &changes)), 0.0, "{height}");
        // From above, in the strip of shadow beside it, where the sun is slanted.
        let beside = 1.0 + height / 8.0;
        let strip = |on: bool| {
            let mut strip = scene(eye([beside, 0.0, 1.0], [beside, 0.0, 0.0]), 0.0)
                .shape(floor(0.0, white()))
                .light(Light::sun([1.0, 0.0, -1.0], 1.0));
            if on {
                let up = [0.0, 0.0, 1.0];
                strip = strip.shape(Shape::disc([0.0, 0.0, height], up, 1.0, black()));
            }
            middle(&built(strip))
        };
        assert_eq!(strip(true), 0.0, "{height}");
        assert_near(strip(false), 0.5_f64.sqrt(), FILM, "without it");
    }
}

/// Pass: the outer face. The ball has a red one just inside, which shows where the
/// outer face is missed; elsewhere it is missed at 5e-5.
#[test]
fn h2_a_mirror_shows_the_outer_face_of_a_ball_on_it() {
    for gap in [1e-3, 5e-5, 1e-6, 1e-9, 1e-12, power(-48)] {
        let (centre, inside) = (format!("z=\"{}\"", 1.0 + gap), format!("size=\"{}\"", 1.0 - gap));
        let changes = [("z=\"1.00005\"", centre.as_str()), ("size=\"0.99995\"", &inside)];
        let film = seen(&file("ball_on_mirror", &changes)).film;
        for pixel in film.pixels() {
            assert_eq!(*pixel, [1.0; 3], "{gap}");
        }
    }
}

/// Pass: the first hit is where the ball begins. Elsewhere its far side is found from
/// 5e-5 before it.
#[test]
fn h2_an_eye_just_before_a_ball_sees_its_near_side() {
    for k in [4, 14, 20, 30, 40, 48] {
        let gap = power(-k);
        for shape in [
            Shape::sphere([0.0; 3], 1.0, white()),
            Shape::cube([0.0; 3], 2.0, white()),
            Shape::plane([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], white()),
            Shape::disc([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 1.0, white()),
            Shape::cylinder([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 1.0, white()),
        ] {
            let before = scene(eye([0.0, 0.0, 1.0 + gap], [0.0; 3]), 0.0).shape(shape);
            let layers = seen(&built(before)).layers.expect("asked for");
            assert_eq!(f64::from(layers.pixels()[0].ray_depth), gap, "2^-{k}");
        }
    }
}

/// A white floor under a lamp at height 1, seen from the side.
fn under_a_lamp() -> SceneBuilder {
    scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, white()))
        .light(Light::lamp([0.0, 0.0, 1.0], 1.0))
}

/// Pass: exact for occluders a relative 2^-50 before and behind the lamp.
#[test]
fn h3_only_what_is_before_the_lamp_hides_it() {
    let up = [0.0, 0.0, 1.0];
    let with = |z: f64, size: f64| {
        let disc = Shape::disc([0.0, 0.0, z], up, size, black());
        middle(&built(under_a_lamp().shape(disc)))
    };
    assert_eq!(with(1.0 - power(-50), 0.5), 0.0);
    assert_eq!(with(1.0 + power(-50), 0.5), 1.0);
    assert_eq!(with(1.0 - power(-30), power(-20)), 0.0);
    assert_eq!(with(1.0 + power(-30), 1.0), 1.0);
    // Behind the shaded point, as seen from the lamp.
    for z in [-1e-12, -1e-3, -1.0, -1e9] {
        assert_eq!(with(z, 1.0), 1.0, "{z}");
    }
    // The lamp in the disc itself: it shines on both sides, and nothing is hidden.
    assert_eq!(with(1.0, 0.5), 1.0);
}

/// The distance is 0 there, and so is the light; no NaN, and nothing is black that
/// should not be.
#[test]
fn h3_a_lamp_in_the_shaded_point_lights_nothing() {
    for light in [
        Light::lamp([0.0; 3], 1.0),
        Light::lamp([0.0; 3], 1e300),
        Light::spot([0.0; 3], [0.0, 0.0, 1.0], [10.0, 20.0], 1.0),
    ] {
        let on_floor = scene(Camera::new([0.0, 0.0, 1.0], [0.0; 3], 1.0, [3, 3]), 0.0)
            .shape(floor(0.0, white().emission([0.25; 3]).expect("in range")))
            .light(light);
        let film = seen(&built(on_floor)).film;
        assert!(film.pixels().iter().all(|pixel| *pixel == [0.25; 3]));
    }
}

#[test]
fn h3_a_lamp_in_a_closed_opaque_solid_lights_nothing_outside() {
    for shape in [
        Shape::sphere([0.0, 0.0, 1.0], 1e-9, black()),
        Shape::sphere([0.0, 0.0, 1.0], 0.5, mirror(1.0)),
        Shape::cube([0.0, 0.0, 1.0], 0.5, black()),
        Shape::cylinder([0.0, 0.0, 0.5], [0.0, 0.0, 1.5], 0.1, black()),
        Shape::torus([0.0, 0.4, 1.0], [0.0, 0.0, 1.0], [0.4, 0.1], black()),
    ] {
        assert_eq!(middle(&built(under_a_lamp().shape(shape))), 0.0);
    }
    // Inside it does: a lamp 0.5 below the lid of a box.
    let inside = scene(eye([0.3, 0.1, 1.2], [0.0, 0.0, 1.5]), 0.0)
        .shape(Shape::cube([0.0, 0.0, 1.0], 1.0, white()))
        .light(Light::lamp([0.0, 0.0, 1.0], 1.0));
    assert_near(middle(&built(inside)), 4.0, FILM, "1 over the square of a half");
}

/// A regular prism with normals of the circle around it.
fn prism(sides: u32, turn: f64) -> Mesh {
    let (mut corners, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..sides {
        let angle = turn + 2.0 * PI * f64::from(i) / f64::from(sides);
        let (x, y) = (libm::cos(angle), libm::sin(angle));
        for z in [-1.0, 1.0] {
            corners.push([x, y, z]);
            normals.push([x as f32, y as f32, 0.0]);
        }
        let at = |step: u32, top: u32| 2 * ((i + step) % sides) + top;
        triangles.push([at(0, 0), at(1, 0), at(1, 1)]);
        triangles.push([at(0, 0), at(1, 1), at(0, 1)]);
    }
    let each = triangles.clone();
    Mesh::new(corners, triangles)
        .and_then(|mesh| mesh.with_normals(normals, Some(each)))
        .expect("valid")
}

/// Where a facet faces away from the light it is dark, though its normals still see
/// some. There is no remedy in this engine: shadows are those of the facets. Pass: the
/// brightness jumps from sin(pi/N), which proves that they are exact.
#[test]
fn h4_the_terminator_jumps_by_the_sine_of_half_a_facet() {
    for (sides, jump) in [(8, 0.382_683_4), (16, 0.195_090_3), (32, 0.098_017_1), (64, 0.049_067_7)]
    {
        // A facet that faces away from the light by a hair: at its border is a corner of
        // the prism. The sun shines along -x.
        let half = PI / f64::from(sides);
        let corner = PI / 2.0 - half + 1e-9;
        let mesh = Arc::new(prism(sides, corner));
        let brightness = |beside: f64| {
            let (sine, cosine) = (libm::sin(corner + beside), libm::cos(corner + beside));
            // On the chord, which is no farther from the corner's tangent than beside^2.
            let camera = eye([0.5 * cosine, 3.0 * sine, 0.1], [cosine, sine, 0.1]);
            let lit = scene(camera, 0.0)
                .shape(Shape::mesh(Arc::clone(&mesh), white()))
                .light(Light::sun([-1.0, 0.0, 0.0], 1.0));
            middle(&built(lit))
        };
        assert_near(brightness(-1e-5), jump, 0.01, "the last lit place");
        assert_eq!(brightness(1e-5), 0.0, "{sides}: the first dark one");
        // A smooth cylinder has no jump: it fades to nothing at 90 degrees.
        let ball = |angle: f64| {
            let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
            let base = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
            let camera = eye([0.0, 3.0, 0.1], [cosine, sine, 0.1]);
            let lit = scene(camera, 0.0)
                .shape(Shape::cylinder(base[0], base[1], 1.0, white()))
                .light(Light::sun([-1.0, 0.0, 0.0], 1.0));
            middle(&built(lit))
        };
        assert_near(ball(PI / 2.0 - half), jump, 1e-5, "the cosine");
        assert_near(ball(PI / 2.0 - 1e-6), 1e-6, 1e-3, "fades");
    }
}

/// Clear things far smaller than their distance to the floor: each sheet is there, and
/// only the part that it stops is missing.
#[test]
fn h2_sheets_near_a_floor_shade_it_as_often_as_they_are_there() {
    let half = black().transparency(0.5).expect("in range").thin();
    let half = lancer_scene::Surface { medium: lancer_scene::Medium::AIR, ..half };
    for gap in [1e-3, 1e-6, 1e-12] {
        let mut shaded = scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
            .shape(floor(0.0, white()))
            .light(Light::sun([0.0, 0.0, -1.0], 1.0));
        for i in 1..=3 {
            let centre = [0.0, 0.0, gap * f64::from(i)];
            shaded = shaded.shape(Shape::disc(centre, [0.0, 0.0, 1.0], 0.1, half));
        }
        // Seen through the three as well, as they are in the way of the eye.
        let seen = middle(&built(shaded));
        assert_eq!(seen, 0.125 * 0.125, "{gap}");
    }
    // Where nothing is in between the floor is as bright as it shines.
    assert_eq!(
        middle(&built(scene(eye([1.0; 3], [0.0; 3]), 0.0).shape(floor(0.0, shining(0.5))))),
        0.5
    );
}
