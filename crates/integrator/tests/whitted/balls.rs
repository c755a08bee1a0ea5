//! Lamps that are balls: their light and their soft shadows, against closed forms and
//! against sums over the part of the lamp that is seen.

use crate::help::{FILM, assert_near, black, eye, floor, grey, scene, shining, smoke, white};
use crate::samples::{Mean, mean};
use lancer_scene::{InvalidField, Light, SceneBuilder, Shape};
use std::f64::consts::PI;

type Point = [f64; 3];

const SAMPLES: u32 = 8192;

fn ball(at: Point, brightness: f64, radius: f64) -> Result<Light, InvalidField> {
    Light::lamp(at, brightness).and_then(|lamp| lamp.with_radius(radius))
}

/// A white floor, seen at the origin from the side, in that light.
fn floor_lit_by(light: Result<Light, InvalidField>) -> SceneBuilder {
    scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0).shape(floor(0.0, white())).light(light)
}

fn disc(centre: Point, radius: f64) -> Result<Shape, InvalidField> {
    Shape::disc(centre, [0.0, 0.0, 1.0], radius, black())
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether a ray from the origin meets a disc whose normal is upward.
fn meets_disc(direction: Point, centre: Point, radius: f64) -> bool {
    let t = centre[2] / direction[2];
    let [x, y] = [0, 1].map(|i| t * direction[i] - centre[i]);
    t > 0.0 && x * x + y * y < radius * radius
}

/// Whether one of length 1 meets a sphere that the origin is not in.
fn meets_sphere(direction: Point, centre: Point, radius: f64) -> bool {
    let along = dot(direction, centre);
    along > 0.0 && dot(centre, centre) - along * along < radius * radius
}

/// The radiance of the floor at the origin by the parts of a lamp that is outside: the mean of
/// what `left` leaves of each direction, times the cosine, over rings and sectors around the way
/// to the lamp's centre.
fn by_parts(at: Point, brightness: f64, radius: f64, left: impl Fn(Point) -> f64) -> f64 {
    let distance = dot(at, at).sqrt();
    let axis = at.map(|c| c / distance);
    let across = if axis[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let cross = |a: Point, b: Point| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let u = cross(axis, across);
    let u = u.map(|c| c / dot(u, u).sqrt());
    let v = cross(axis, u);
    let sine = radius / distance;
    let (rings, sectors) = (600, 1200);
    let mut sum = 0.0;
    for ring in 0..rings {
        // In equal steps of the squared sine, whose steps times 1 / (2 cos) are solid angles.
        let square = sine * sine * (f64::from(ring) + 0.5) / f64::from(rings);
        let (s, c) = (square.sqrt(), (1.0 - square).sqrt());
        for sector in 0..sectors {
            let angle = 2.0 * PI * (f64::from(sector) + 0.5) / f64::from(sectors);
            let (a, b) = (s * libm::cos(angle), s * libm::sin(angle));
            let direction = [0, 1, 2].map(|i| axis[i] * c + u[i] * a + v[i] * b);
            if direction[2] > 0.0 {
                sum += direction[2] / (2.0 * c) * left(direction);
            }
        }
    }
    // Of radiance brightness / (pi radius^2), and the floor shows 1 / pi of what it gets times pi.
    let solid_angle = 2.0 * PI * sine * sine / f64::from(rings * sectors);
    brightness / (PI * radius * radius) * sum * solid_angle
}

fn shadowed(light: Result<Light, InvalidField>, by: Result<Shape, InvalidField>) -> Mean {
    mean(floor_lit_by(light).shape(by), SAMPLES)
}

#[test]
fn h5_a_lamp_that_nothing_hides_is_as_its_centre_to_the_bit() {
    for at in [[0.0, 0.0, 1.0], [3.0, -2.0, 1.5], [-1e4, 0.0, 2e4]] {
        let distance = dot(at, at).sqrt();
        let point = grey(floor_lit_by(Light::lamp(at, 0.75 * distance)));
        for size in [1e-9, 1e-5, 0.1, 0.4] {
            let lamp = || ball(at, 0.75 * distance, size * at[2]);
            assert_eq!(grey(floor_lit_by(lamp())), point, "{at:?} {size}");
            // Something far away is no reason to look.
            let behind = floor_lit_by(lamp()).shape(Shape::sphere([0.0, 0.0, -5.0], 1.0, black()));
            let mean = mean(behind, 64);
            assert_eq!((mean.value, mean.within), (point, 0.0), "{at:?} {size}");
        }
        let point = grey(floor_lit_by(Light::lamp(at, 0.75).map(Light::without_falloff)));
        let lamp = ball(at, 0.75, 0.3).map(Light::without_falloff);
        assert_eq!(grey(floor_lit_by(lamp)), point, "{at:?}");
    }
}

/// What the horizon halves has a form of its own.
#[test]
fn a_lamp_half_below_the_horizon_and_one_around_the_point() {
    for radius in [1e-6, 0.01, 0.3, 0.9, 0.999] {
        let found = grey(floor_lit_by(ball([1.0, 0.0, 0.0], PI * radius * radius, radius)));
        let expected = libm::asin(radius) - radius * (1.0 - radius * radius).sqrt();
        // Of a small one the difference has few digits left.
        let expected = if radius < 1e-3 { 2.0 / 3.0 * radius * radius * radius } else { expected };
        assert_near(found, expected, FILM, "half of a lamp");
    }
    let around = || ball([0.5, 0.0, -0.25], 8.0, 2.0);
    assert_eq!(grey(floor_lit_by(around())), 2.0);
    assert_eq!(grey(floor_lit_by(around().map(Light::without_falloff))), 8.0);
    // A lid on a cone of directions.
    let lid = shadowed(around(), disc([0.0, 0.0, 0.5], 0.5));
    lid.assert_is(2.0 * (1.0 - 0.5), "under a lid inside of the lamp");
    // Of whatever is beyond the lamp's surface, nothing.
    assert_eq!(shadowed(around(), disc([0.0, 0.0, 3.0], 9.0)).value, 2.0);
}

#[test]
fn a3_shadows_on_the_axis() {
    // What is left of the lamp's disc, by the squares of sines.
    for (radius, size) in [(0.05, 0.05), (0.1, 0.04), (0.3, 0.1), (0.7, 0.4), (0.7, 0.65)] {
        let lamp = || ball([0.0, 0.0, 1.0], 3.0, radius);
        let full = radius * radius;
        // At half the height, or brought nearer to be before the lamp: a disc by its tangent, a
        // sphere by its sine.
        let by_disc = size * size / (size * size + 0.25);
        let by_sphere = 4.0 * size * size;
        let left = |hidden: f64| (1.0 - hidden / full).max(0.0) * 3.0;
        let found = shadowed(lamp(), disc([0.0, 0.0, 0.2], 0.4 * size));
        found.assert_is(left(by_disc), "a disc");
        assert_eq!(found.within == 0.0, by_disc >= full, "umbra has no noise");
        if size < 0.5 {
            let found = shadowed(lamp(), Shape::sphere([0.0, 0.0, 0.2], 0.4 * size, black()));
            found.assert_is(left(by_sphere), "a sphere");
            assert_eq!(found.within == 0.0, by_sphere >= full, "umbra has no noise");
        }
    }
}

#[test]
fn a3_shadows_off_the_axis() {
    let lamps = [
        ([0.5, 0.2, 1.0], 0.3),
        ([-0.7, 0.1, 0.8], 0.6),
        ([1.0, 0.0, 0.1], 0.4),
        ([0.3, 1.0, -0.2], 0.5),
        ([0.0, -1.0, 0.001], 0.05),
    ];
    for (at, radius) in lamps {
        let lamp = || ball(at, 2.0, radius);
        // Between the floor and the lamp, to one side of its middle.
        let centre = [0.25 * at[0], 0.25 * at[1], 0.25 * (at[2] + 0.5 * radius)];
        let size = 0.15 * radius;
        let found = shadowed(lamp(), disc(centre, size));
        let expected =
            by_parts(at, 2.0, radius, |d| if meets_disc(d, centre, size) { 0.0 } else { 1.0 });
        // Sums have 1e-3 of a part's edge.
        let with_sum =
            |found: &Mean| Mean { value: found.value, within: found.within + 2e-3 * expected };
        with_sum(&found).assert_is(expected, "a disc");
        let expected =
            by_parts(at, 2.0, radius, |d| if meets_sphere(d, centre, size) { 0.0 } else { 1.0 });
        let found = shadowed(lamp(), Shape::sphere(centre, size, black()));
        with_sum(&found).assert_is(expected, "a sphere");
        assert!(found.within > 0.0);
    }
}

/// Something transparent takes of each ray what it takes.
#[test]
fn light_of_a_ball_goes_through_what_is_clear() {
    let smoke = smoke([2.0; 3]);
    let slab = Shape::cuboid([-9.0, -9.0, 0.3], [9.0, 9.0, 0.5], smoke);
    let at = [0.4, 0.0, 1.6];
    let found = shadowed(ball(at, 2.0, 0.4), slab);
    let expected = by_parts(at, 2.0, 0.4, |d| libm::exp(-2.0 * 0.2 / d[2]));
    found.assert_is(expected, "smoke");
    assert!(found.within > 0.0 && found.within < 0.02);
}

/// The beam goes by the direction from the centre.
#[test]
fn a_spot_may_be_a_ball() {
    for (height, falloff) in [(1.0, true), (0.3, true), (-0.1, false)] {
        let spot = |radius: f64| {
            let spot = Light::spot([1.0, 0.0, height], [-1.0, 0.1, 0.0], [10.0, 60.0], 2.0);
            let spot = spot.and_then(|spot| spot.with_radius(radius));
            if falloff { spot } else { spot.map(Light::without_falloff) }
        };
        let lamp = |radius: f64| {
            let lamp = ball([1.0, 0.0, height], 2.0, radius);
            if falloff { lamp } else { lamp.map(Light::without_falloff) }
        };
        let share = grey(floor_lit_by(spot(0.4))) / grey(floor_lit_by(lamp(0.4)));
        let axis = [-1.0, 0.1, 0.0].map(|c| c / 1.01_f64.sqrt());
        let way = [-1.0, 0.0, -height].map(|c| c / (1.0 + height * height).sqrt());
        let cosine = dot(axis, way);
        let [inner, outer] = [10.0_f64, 60.0].map(|degrees| libm::cos(degrees.to_radians()));
        let s = ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0);
        assert_near(share, s * s * (3.0 - 2.0 * s), 3.0 * FILM, "the share of the beam");
    }
}

/// Lamps are not seen, neither straight nor in mirrors, and what is inside is lit from all sides.
#[test]
fn a_ball_lamp_is_not_seen() {
    let lamp = || ball([0.0, 0.0, 2.0], 5.0, 0.5);
    let view = scene(eye([0.0, -3.0, 2.0], [0.0, 0.0, 2.0]), 0.25).light(lamp());
    assert_eq!(grey(view.clone()), 0.25);
    let bulb = Shape::sphere([0.0, 0.0, 2.0], 0.25, white());
    assert_eq!(grey(view.clone().shape(bulb)), 5.0 / 0.25);
    // In a closed body it lights nothing outside.
    let lit = view.shape(Shape::sphere([0.0, 0.0, 2.0], 0.75, shining([0.5; 3])));
    assert_eq!(grey(lit.shape(floor(0.0, white()))), 0.5);
    let outside = floor_lit_by(lamp()).shape(Shape::sphere([0.0, 0.0, 2.0], 0.75, black()));
    assert_eq!(grey(outside), 0.0);
}
