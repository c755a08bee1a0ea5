//! The eye and what shines change places: as much light comes through either way.

use crate::rendered;
use fastrand::Rng;
use lancer_integrator::Whitted;
use lancer_math::{Placement, Point, Vector, unit};
use lancer_scene::{
    Camera, Colour, Group, InvalidField, Light, Scene, SceneBuilder, Shape, Surface,
};

/// The film holds 24 bits.
const ROUNDING: f64 = 3e-7;

fn xyz(p: Point) -> [f64; 3] {
    p.coords.into()
}

fn vector(rng: &mut Rng) -> Vector {
    Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0)
}

fn shining(radiance: f64) -> Result<Surface, InvalidField> {
    Surface::new(Colour::BLACK).emission([radiance; 3])
}

/// Glass, water and a denser glass with a gap between, each with its absorption, from above and
/// from below, at all angles up to 57 degrees. What goes to and fro between the faces counts,
/// so the pictures agree to what is not followed any more.
#[test]
fn layers_from_both_sides() {
    const CUTOFF: f64 = 1e-6;
    let layer = |from: f64, to: f64, ior: f64, absorption: f64| {
        let medium = Surface::glass(ior).and_then(|glass| glass.absorption([absorption, 0.0, 0.3]));
        Shape::cuboid([-1e3, -1e3, from], [1e3, 1e3, to], medium)
    };
    let seen = |eye: f64, lit: f64| {
        let scene = Scene::builder()
            .camera(Camera::new([0.0, 0.0, eye], [0.0, 0.0, lit], 14.0 * 3.0_f64.sqrt(), [24, 24]))
            .shape(layer(0.0, 1.0, 1.5, 0.3))
            .shape(layer(1.0, 1.5, 1.33, 0.9))
            .shape(layer(2.0, 2.5, 2.0, 0.1))
            .shape(Shape::plane([0.0, 0.0, lit], [0.0, 0.0, eye - lit], shining(1.0)))
            .build()
            .expect("it is valid");
        rendered(&scene, &Whitted::with_cutoff(CUTOFF).expect("it is in range")).film
    };
    let (above, below) = (seen(8.0, -6.0), seen(-6.0, 8.0));
    let mut least = f32::INFINITY;
    for (a, b) in above.pixels().iter().zip(below.pixels()) {
        least = least.min(a[0]);
        for (a, b) in a.iter().zip(b) {
            assert!((f64::from(a - b)).abs() <= 2.0 * CUTOFF + ROUNDING, "{a} {b}");
        }
    }
    assert!(least > 0.05 && least < 0.9 * above.pixel(12, 12)[0], "{least}");
}

/// Glass of every kind, some of it in a group, liquid in it, and panes.
fn glassware(builder: SceneBuilder) -> SceneBuilder {
    let glass = |ior| Surface::glass(ior).and_then(|glass| glass.absorption([0.2, 0.05, 0.4]));
    let pane = || Ok::<_, InvalidField>(Surface::glass(1.5)?.gloss(0.2)?.thin());
    let tilted = Placement::rotate(Vector::new(1.0, 0.5, -0.3), 40.0).expect("an axis");
    let inside = [
        Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.4], glass(1.4)),
        Shape::cone([1.0, 0.0, -1.0], [1.0, 1.0, 1.0], 0.7, glass(1.6)),
        Shape::disc([-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], 0.8, pane()),
    ];
    let inside = inside.into_iter().collect::<Result<_, _>>().expect("they are valid");
    let group = Group::new(None, inside, Vec::new()).expect("it is small");
    builder
        .shape(Shape::sphere([0.0, 0.0, 2.0], 1.2, glass(1.5)))
        .shape(Shape::sphere([0.0, 0.0, 2.0], 0.8, glass(1.33)))
        .shape(Shape::cuboid([-2.0, -2.0, -2.0], [-0.5, 0.0, 1.0], glass(1.7)))
        .shape(Shape::cylinder([0.0, -2.0, -2.0], [1.0, -2.0, 1.0], 0.8, glass(1.5)))
        .shape(Shape::rectangle([-3.0, 1.0, -3.0], [[6.0, 0.5, 0.0], [0.0, 0.5, 6.0]], pane()))
        .group(tilted.then(&Placement::translate(Vector::new(0.5, 1.0, -1.0))), group)
}

/// A matte patch faces a lamp; then lamp and patch change places. Light goes straight through
/// (tinted shadows), so nothing but the product of what is left along the way is compared, and
/// it is so to the rounding of the film.
#[test]
fn lamps_and_patches() {
    let lit = |lamp: Point, patch: Point| {
        let way = lamp - patch;
        let normal = unit(way).expect("they are apart");
        let side = normal.cross(&vector(&mut Rng::with_seed(0)));
        let eye = patch + normal * 1e-4 + side * 1e-4;
        let white = Surface::new(Colour::WHITE);
        let builder = Scene::builder()
            .camera(Camera::new(xyz(eye), xyz(patch), 1e-6, [1, 1]))
            .light(Light::lamp(xyz(lamp), way.norm_squared()))
            .shape(Shape::disc(xyz(patch), normal.into(), 1e-3, white));
        let scene = glassware(builder).build().expect("it is valid");
        rendered(&scene, &Whitted::new()).film.pixel(0, 0)
    };
    let mut tinted = 0;
    for seed in 0..150 {
        let rng = &mut Rng::with_seed(seed);
        let way = unit(vector(rng)).expect("it is not zero") * 6.0;
        let (a, b) = (Point::from(way), Point::from(vector(rng) * 2.0 - way));
        let (there, back) = (lit(a, b), lit(b, a));
        for (there, back) in there.iter().zip(back) {
            let difference = f64::from(there - back).abs();
            assert!(difference <= ROUNDING * f64::from(back), "seed {seed}: {there} {back}");
        }
        tinted += usize::from(there[0] > 0.0 && there[0] < 0.8);
    }
    assert!(tinted > 50, "{tinted}");
}

/// Two mirrors and a pane between the eye and a ball that shines; then the eye looks from
/// where the ball was. The ball is in the direction of its image of images.
#[test]
fn mirrors_and_panes() {
    let mirrors = [
        (Point::origin(), Vector::new(0.0, 0.0, 1.0), 0.7),
        (Point::new(5.0, 0.0, 0.0), Vector::new(-1.0, 0.1, 0.05), 0.45),
    ];
    let pane = (Point::new(2.0, 0.5, 1.0), Vector::new(0.3, 0.2, -1.0));
    let image = |p: Point, (at, normal, _): (Point, Vector, f64)| {
        p - normal * (2.0 * normal.dot(&(p - at)) / normal.norm_squared())
    };
    let seen = |eye: Point, ball: Point, aim: Point| {
        let builder = Scene::builder().camera(Camera::new(xyz(eye), xyz(aim), 1e-6, [1, 1]));
        let thin = Surface::glass(1.6).map(Surface::thin);
        let builder = builder
            .shape(Shape::sphere(xyz(ball), 0.05, shining(1.0)))
            .shape(Shape::disc(xyz(pane.0), pane.1.into(), 2.0, thin));
        let builder = mirrors.into_iter().fold(builder, |builder, (at, normal, gloss)| {
            let mirror = Surface::new(Colour::BLACK).gloss(gloss);
            builder.shape(Shape::plane(xyz(at), normal.into(), mirror))
        });
        rendered(&builder.build().expect("it is valid"), &Whitted::new()).film.pixel(0, 0)[0]
    };
    let above = |p: Point, (at, normal, _): (Point, Vector, f64)| normal.dot(&(p - at));
    let (mut clear, mut through) = (0, 0);
    for seed in 0..400 {
        let rng = &mut Rng::with_seed(seed);
        let mut place = || Point::new(0.0, 0.0, 2.2) + vector(rng) * 2.0;
        let (a, b) = (place(), place());
        let aim = image(image(b, mirrors[1]), mirrors[0]);
        // Where the way there meets the first mirror, and the way back the second one: in
        // front of the other, or there is no such way.
        let meets = |from: Point, to: Point, mirror| {
            let (h, k) = (above(from, mirror), above(to, mirror));
            from + (to - from) * (h / (h - k))
        };
        let first = meets(a, aim, mirrors[0]);
        let second = meets(b, image(first, mirrors[1]), mirrors[1]);
        // A pane through the ball would be on one way alone.
        let is_apart = |p: Point| pane.1.dot(&(p - pane.0)).abs() > 0.1;
        let is_way = above(first, mirrors[1]) > 0.0 && above(second, mirrors[0]) > 0.0;
        if !(is_way && is_apart(a) && is_apart(b)) {
            continue;
        }
        let there = seen(a, b, aim);
        let back = seen(b, a, image(image(a, mirrors[0]), mirrors[1]));
        let difference = f64::from(there - back).abs();
        assert!(difference <= ROUNDING && there > 0.0, "seed {seed}: {there} {back}");
        clear += usize::from((f64::from(there) - 0.7 * 0.45).abs() < ROUNDING);
        through += usize::from(there > 0.0 && there < 0.7 * 0.44);
    }
    assert!(clear > 10 && through > 10, "{clear} {through}");
}
