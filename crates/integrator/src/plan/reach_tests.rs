//! Shapes that no ray reaches, and spots that light nothing: where the rules apply, and where they must not.

use super::*;
use crate::{RenderSettings, Whitted, render};
use lancer_math::{Placement, Vector};
use lancer_scene::{Camera, Colour, Group, InvalidField, Light, SceneBuilder, Shape, Surface};
use std::sync::Arc;

/// As builders take it.
fn valid<T>(part: T) -> Result<T, InvalidField> {
    Ok(part)
}

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
        .light(valid(light))
        .shape(wall);
    shapes.into_iter().fold(scene, |scene, shape| scene.shape(valid(shape)))
}

fn lamp() -> Light {
    Light::lamp([0.0, 0.0, 3.0], 50.0).expect("valid")
}

/// The numbers of shapes that are left out; pictures are the same.
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
    assert!(planned.film.pixels() == full.film.pixels(), "the pictures are not the same");
    let layers =
        [&planned, &full].map(|rendered| rendered.layers.as_ref().expect("asked for").pixels());
    assert!(layers[0] == layers[1], "the layers are not the same");
    (0..scene.shapes.len()).filter(|number| plan.absent.has_shape(*number)).collect()
}

/// Whether the picture would be another one without a shape.
fn matters(scene: SceneBuilder, shape: usize) -> bool {
    let scene = scene.build().expect("valid");
    let mut marks = vec![false; scene.shapes.len()];
    marks[shape] = true;
    let full = Plan::full(&lancer_kernel::KernelSettings::default());
    let without = Plan { absent: Absent::new(marks, vec![]), ..full.clone() };
    let [with, without] = [full, without].map(|plan| {
        let engine = Whitted::default();
        let tracer = crate::Engine::prepare(&engine, &scene, &plan);
        let mut counts = crate::RayCounts::default();
        let places = (0..32).flat_map(|y| (0..32).map(move |x| (x, y)));
        places.map(|(x, y)| tracer.pixel(x, y, &mut counts)).collect::<Vec<_>>()
    });
    with != without
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
    assert!(matters(scene(shapes.clone(), behind), 1));
    let sun = Light::sun([0.0, 1.0, -0.55], 1.0).expect("valid");
    assert_eq!(absent(scene(shapes.clone(), sun)), [2]);
    assert!(matters(scene(shapes, sun), 1));
}

#[test]
fn what_mirrors_and_glass_may_show_is_there() {
    // So near that it shows in some pixels.
    let behind = || ball([0.0, -1.2, 0.0], white());
    let glass = Surface::glass(1.5).expect("in range");
    for look in [mirror(), glass] {
        let shown = || scene(vec![ball([0.0, 2.0, 0.0], look), behind()], lamp());
        assert!(matters(shown(), 2));
        assert_eq!(absent(shown()), [0; 0]);
        // One that is not seen itself shows nothing.
        let unseen = vec![ball([0.0, -9.0, 0.0], look), behind()];
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
    assert!(matters(scene(shapes.clone(), lamp()), 2));
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
    assert_eq!(Plan::new(&built, &Asked::default()).absent.groups().collect::<Vec<_>>(), [0, 2]);
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

/// Straight at the middle of what is lit, and at corners of boxes around it, where rounding alone would say
/// on which side of the beam they are.
#[test]
fn spots_that_are_aimed_at_what_is_seen_are_asked() {
    for [x, y, z] in [[0.0, 0.0, 3.0], [0.0, -6.0, 8.0], [0.0, -3.0, 6.0], [1.0, 2.0, 7.0]] {
        for at in [[0.0, 5.0, 0.0], [0.0, 5.0, 0.5], [0.5, 6.0, 1.0]] {
            for corner in [0.0, 0.5] {
                let axis = [at[0] - x + corner, at[1] - y - corner, at[2] - z + corner];
                let light = Light::spot([x, y, z], axis, [10.0, 20.0], 50.0).expect("valid");
                let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [32, 32]);
                let scene = Scene::builder().camera(camera).shape(valid(ball(at, white())));
                assert!(!aside(scene.light(valid(light))));
            }
        }
    }
}

/// Near its centre a spot is brighter than any number, and outside of its beam dark all the same.
#[test]
fn what_is_infinitely_bright_is_dark_outside_of_its_beam() {
    let spot = Light::spot([0.0, 7.5, 0.0], [0.0, -1.0, 0.0], [10.0, 20.0], 1e308).expect("valid");
    assert!(aside(scene(vec![], lamp()).light(valid(spot))));
}

/// How far a floor is known, and so what is crossed together with a box on it, depends on how large the
/// scene is, with what is behind the floor.
#[test]
fn what_is_left_out_counts_for_rounding() {
    let glass = Surface::glass(1.5).expect("in range");
    let floor = Shape::plane([1e6, 0.0, 0.0], [0.0, 0.0, 1.0], white()).expect("valid");
    let slab = Shape::cuboid([-1.0, 4.0, 1e-9], [1.0, 6.0, 2.0], glass).expect("valid");
    let below = Shape::sphere([0.0, 0.0, -2e6], 1e6, white()).expect("valid");
    let built = |shape: Shape| {
        let mut scene = Scene::builder();
        let camera = Camera::new([0.0, 0.0, 3.0], [0.0, 1.0, 2.4], 1.0, [32, 32]);
        let light = Light::lamp([0.0, 0.0, 3.0], 50.0).expect("valid");
        scene = scene.camera(camera).light(valid(light));
        for shape in [floor.clone(), slab.clone(), shape] {
            scene = scene.shape(valid(shape));
        }
        scene
    };
    assert_eq!(absent(built(below.clone())), [2]);
    // In a group too.
    let group = Arc::new(Group::new(None, vec![below], vec![]).expect("small"));
    let scene = built(ball([0.0, 5.0, -4.0], white())).group(Placement::IDENTITY, group).build();
    let scene = scene.expect("valid");
    assert_eq!(of_built(&scene), [2]);
    assert_eq!(Plan::new(&scene, &Asked::default()).absent.groups().collect::<Vec<_>>(), [0]);
}

/// Where the directions of a view are no numbers, nothing is known of what it sees.
#[test]
fn views_beyond_the_range_of_numbers_leave_nothing_out() {
    let camera = Camera::new([0.0; 3], [0.0, 1e-200, 0.0], 1e-200, [32, 32]).expect("valid");
    let camera = camera.aperture(0.1).and_then(|camera| camera.focus(5.0)).expect("in range");
    let sun = Light::sun([0.0, 1.0, 0.0], 1.0).expect("valid");
    let mut built = scene(vec![ball([0.0, 5.0, 0.0], white())], sun).build().expect("valid");
    built.camera = camera;
    assert_eq!(of_built(&built), [0; 0]);
}

/// A point of a plane that is far away says less of where the plane is than one near by.
#[test]
fn mirrors_that_are_not_surely_in_one_plane_are_not_taken_for_it() {
    let disc = Shape::disc([0.0, 4.91, 0.0], [0.0, 1.0, 0.0], 0.1, mirror()).expect("valid");
    let plane = Shape::plane([1e12, 5.0, 0.0], [0.0, 1.0, 0.0], mirror()).expect("valid");
    let shapes =
        vec![disc, plane, ball([0.0, -5.0, 0.0], white()), ball([99.0, -5.0, 0.0], white())];
    assert_eq!(absent(scene(shapes, lamp())), [0], "the wall is behind it");
}
