//! Shapes that no ray reaches, and spots that light nothing: where the rules apply, and where they must not.

use super::*;
use crate::{RenderSettings, Whitted, render};
use lancer_math::{Placement, Vector};
use lancer_scene::{Camera, Colour, Group, Light, SceneBuilder, Shape, Surface};
use std::sync::Arc;

fn white() -> Surface {
    Surface::new(Colour::WHITE)
}

fn mirror() -> Surface {
    white().gloss(0.8).expect("in range")
}

fn ball(at: [f64; 3], surface: Surface) -> Shape {
    Shape::sphere(at, 0.5, surface).expect("valid")
}

/// A wall in view and a lamp above the eye, which is at the origin and looks along y.
fn scene(shapes: Vec<Shape>, light: Light) -> SceneBuilder {
    let wall = Shape::rectangle([-9.0, 8.0, -9.0], [[18.0, 0.0, 0.0], [0.0, 0.0, 18.0]], white());
    let scene = Scene::builder()
        .camera(Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [32, 32]))
        .light(Ok::<_, lancer_scene::InvalidField>(light))
        .shape(wall);
    shapes
        .into_iter()
        .fold(scene, |scene, shape| scene.shape(Ok::<_, lancer_scene::InvalidField>(shape)))
}

fn lamp() -> Light {
    Light::lamp([0.0, 0.0, 3.0], 50.0).expect("valid")
}

/// The numbers of shapes that are left out; pictures are the same, and when the seen ones are left out as
/// well they would not be.
fn absent(scene: SceneBuilder) -> Vec<usize> {
    of_built(&scene.build().expect("valid"))
}

fn of_built(scene: &Scene) -> Vec<usize> {
    let engine = Whitted::default();
    let plan = Plan::new(scene, &Asked::default());
    let [planned, full] = [false, true].map(|full_model| {
        let settings = RenderSettings { full_model, layers: true, ..RenderSettings::default() };
        render(scene, &engine, &settings).expect("it is rendered")
    });
    assert_eq!(planned.film.pixels(), full.film.pixels());
    let layers =
        [&planned, &full].map(|rendered| rendered.layers.as_ref().expect("asked for").pixels());
    assert_eq!(layers[0], layers[1]);
    (0..scene.shapes.len()).filter(|number| plan.absent.has_shape(*number)).collect()
}

#[test]
fn what_is_behind_the_eye_is_left_out() {
    let shapes = vec![ball([0.0, -5.0, 0.0], white()), ball([0.0, 5.0, 0.0], white())];
    assert_eq!(absent(scene(shapes, lamp())), [1]);
}

/// It hides the lamp from the wall.
#[test]
fn what_throws_a_shadow_into_view_is_there() {
    let behind = Light::lamp([0.0, -8.0, 6.0], 50.0).expect("valid");
    let shapes = vec![ball([0.0, -4.0, 3.5], white()), ball([0.0, -4.0, -3.5], white())];
    assert_eq!(absent(scene(shapes.clone(), behind)), [2]);
    let sun = Light::sun([0.0, 1.0, -0.8], 1.0).expect("valid");
    assert_eq!(absent(scene(shapes, sun)), [2]);
}

#[test]
fn what_mirrors_and_glass_may_show_is_there() {
    let behind = ball([0.0, -5.0, 0.0], white());
    let glass = Surface::glass(1.5).expect("in range");
    for look in [mirror(), glass] {
        assert_eq!(
            absent(scene(vec![ball([0.0, 5.0, 0.0], look), behind.clone()], lamp())),
            [0; 0]
        );
        // One that is not seen itself shows nothing.
        let unseen = vec![ball([0.0, -9.0, 0.0], look), behind.clone()];
        assert_eq!(absent(scene(unseen, lamp())), [1, 2]);
    }
}

/// A flat mirror shows what is in its image of the view, and nothing else.
#[test]
fn flat_mirrors_show_a_part() {
    let sheet = |side: f64| {
        Shape::rectangle(
            [-side, 5.0, -side],
            [[2.0 * side, 0.0, 0.0], [0.0, 0.0, 2.0 * side]],
            mirror(),
        )
        .expect("valid")
    };
    let (seen, aside) = (ball([0.0, -5.0, 0.0], white()), ball([20.0, -5.0, 0.0], white()));
    let shapes = vec![sheet(1.0), seen.clone(), aside.clone()];
    assert_eq!(absent(scene(shapes.clone(), lamp())), [3]);
    // Two in one plane are as one; in two planes they show one another.
    let disc = Shape::disc([2.0, 5.0, 0.0], [0.0, 1.0, 0.0], 0.5, mirror()).expect("valid");
    assert_eq!(absent(scene([shapes.clone(), vec![disc]].concat(), lamp())), [3]);
    let turned = Shape::disc([2.0, 5.0, 0.0], [0.5, 1.0, 0.0], 0.5, mirror()).expect("valid");
    assert_eq!(absent(scene([shapes, vec![turned]].concat(), lamp())), [0; 0]);
    // A mirror that only the mirror shows.
    let other = ball([0.0, -5.0, 0.0], mirror());
    assert_eq!(absent(scene(vec![sheet(1.0), other, aside], lamp())), [0; 0]);
}

#[test]
fn what_is_behind_an_opaque_plane_is_left_out_whatever_is_seen() {
    let floor = |surface| Shape::plane([0.0, 0.0, -2.0], [0.0, 0.1, 1.0], surface).expect("valid");
    let shapes = |surface| {
        let shown = ball([0.0, 5.0, 0.0], mirror());
        vec![
            shown,
            floor(surface),
            ball([0.0, 5.0, -4.0], white()),
            ball([0.0, 5.0, -2.6], white()),
        ]
    };
    assert_eq!(absent(scene(shapes(white()), lamp())), [3]);
    assert_eq!(absent(scene(shapes(mirror()), lamp())), [3]);
    assert_eq!(absent(scene(shapes(Surface::glass(1.3).expect("in range")), lamp())), [0; 0]);
}

#[test]
fn parallel_rays_and_lenses_see_more() {
    let with = |shape: Shape, change: &dyn Fn(Camera) -> Camera| {
        let behind = ball([0.0, -5.0, 0.0], white());
        let mut scene = scene(vec![behind, shape], lamp()).build().expect("valid");
        scene.camera = change(scene.camera);
        of_built(&scene)
    };
    let beside = || ball([2.0, 5.0, 0.0], white());
    let wide = |width: f64| move |camera: Camera| camera.orthographic(width).expect("in range");
    assert_eq!(with(beside(), &wide(2.0)), [1, 2]);
    assert_eq!(with(beside(), &wide(4.0)), [1]);
    let near = || ball([1.5, 0.8, 0.0], white());
    let lens = |camera: Camera| camera.aperture(4.0).expect("in range");
    assert_eq!(with(near(), &|camera| camera), [1, 2]);
    assert_eq!(with(near(), &lens), [1]);
}

#[test]
fn groups_are_left_out_and_others_keep_their_numbers() {
    let group = |shapes| Arc::new(Group::new(None, shapes, vec![]).expect("small"));
    let (one, two) = (group(vec![ball([0.0; 3], white())]), group(vec![ball([0.0; 3], mirror())]));
    let at = |y: f64| Placement::translate(Vector::new(0.0, y, 0.0));
    let built = scene(vec![], lamp())
        .group(at(-9.0), Arc::clone(&one))
        .group(at(5.0), Arc::clone(&one))
        .group(at(-5.0), two)
        .group(at(6.0), one)
        .build()
        .expect("valid");
    assert_eq!(of_built(&built), [0; 0]);
    assert_eq!(Plan::new(&built, &Asked::default()).absent.groups, [true, false, true, false]);
}

fn aside(scene: SceneBuilder) -> bool {
    let scene = scene.build().expect("valid");
    let plan = Plan::new(&scene, &Asked::default());
    of_built(&scene);
    plan.dropped.iter().any(|dropped| dropped.why == Reason::Aside)
}

#[test]
fn spots_that_meet_nothing_in_view_are_not_asked() {
    let spot = |axis| Light::spot([0.0, 0.0, 3.0], axis, [10.0, 20.0], 50.0).expect("valid");
    let shapes = || vec![ball([0.0, -5.0, 3.0], white())];
    let (to_wall, to_ball, to_sky) = ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -0.2, 1.0]);
    assert!(!aside(scene(shapes(), spot(to_wall))));
    assert!(aside(scene(shapes(), spot(to_ball))) && aside(scene(shapes(), spot(to_sky))));
    // The ball is seen by a mirror.
    let with_mirror = [shapes(), vec![ball([0.0, 5.0, 0.0], mirror())]].concat();
    assert!(!aside(scene(with_mirror.clone(), spot(to_ball))));
    assert!(aside(scene(with_mirror, spot(to_sky))));
    // A plane has no end: half the directions lead to it, and a few more with an angle.
    let floor = Shape::plane([0.0, 0.0, -2.0], [0.0, 0.0, 1.0], white()).expect("valid");
    let ahead = |tilt: f64| spot([0.0, -1.0, tilt]);
    assert!(!aside(scene(vec![floor.clone()], ahead(0.2))));
    assert!(aside(scene(vec![floor], ahead(0.5))));
}
