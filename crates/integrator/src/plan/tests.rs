use super::*;
use crate::{RenderSettings, Rendered, Sampling, Whitted, render};
use lancer_scene::{Camera, Colour, InvalidField, Light, SceneBuilder, Shape, Surface};

fn white() -> Surface {
    Surface::new(Colour::WHITE)
}

/// A ball above a floor, seen from above it, and some lights.
fn room(lights: Vec<Result<Light, InvalidField>>, floor: Surface) -> SceneBuilder {
    let scene = Scene::builder()
        .camera(Camera::new([0.0, -6.0, 2.0], [0.0, -5.0, 1.7], 1.0, [48, 36]))
        .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], floor))
        .shape(Shape::sphere([0.3, 0.0, 1.0], 1.0, white().gloss(0.3)));
    lights.into_iter().fold(scene, SceneBuilder::light)
}

fn built(scene: SceneBuilder) -> Scene {
    scene.build().expect("valid")
}

fn reasons(scene: &Scene) -> Vec<(usize, Reason)> {
    let plan = Plan::new(scene, &Asked::default());
    plan.dropped.iter().map(|dropped| (dropped.light, dropped.why)).collect()
}

/// The scene as planned, and with nothing left out.
fn both(scene: &Scene, settings: &RenderSettings<'_>) -> [Rendered; 2] {
    [false, true].map(|full_model| {
        let settings = RenderSettings { full_model, ..*settings };
        render(scene, &Whitted::default(), &settings).expect("it is rendered")
    })
}

fn lamps() -> Vec<Result<Light, InvalidField>> {
    vec![
        Light::lamp([2.0, -3.0, 5.0], 20.0),
        Light::lamp([1.0, 1.0, -3.0], 900.0),
        Light::sun([0.2, 0.1, 1.0], 5.0),
        Light::lamp([1.0, -2.0, -1.0], 50.0).and_then(|lamp| lamp.with_radius(0.5)),
        Light::lamp([1.0, -2.0, 1.0], 0.0),
        Light::lamp([-2.0, -2.0, 3.0], 4.0).and_then(|lamp| lamp.with_radius(0.2)),
    ]
}

#[test]
fn lights_behind_the_floor_are_not_asked_and_no_bit_changes() {
    let scene = built(room(lamps(), white()));
    let behind = Reason::Behind(0);
    assert_eq!(reasons(&scene), [(1, behind), (2, behind), (3, behind), (4, Reason::NoLight)]);
    let sampling = Sampling { error: Some(0.004), ..Sampling::default() };
    for sampling in [None, Some(sampling)] {
        let [planned, full] = both(&scene, &RenderSettings { sampling, ..Default::default() });
        let pixels = |rendered: &Rendered| rendered.film.pixels().to_vec();
        assert!(pixels(&planned) == pixels(&full));
        assert!(planned.counts.shadow < full.counts.shadow);
    }
}

/// Each of them would be wrong.
#[test]
fn lights_that_may_be_seen_by_some_way_are_asked() {
    // A floor that lets light through.
    let glass = Surface::glass(1.5).expect("in range");
    assert_eq!(reasons(&built(room(lamps(), glass))), [(4, Reason::NoLight)]);
    // A ball that reaches through the floor, and a lamp in the very floor.
    let half = Light::lamp([0.0, -2.0, -0.1], 5.0).and_then(|lamp| lamp.with_radius(0.2));
    let within = Light::lamp([0.0, -2.0, 0.0], 5.0);
    let along = Light::sun([1.0, 0.0, 0.0], 1.0);
    assert_eq!(reasons(&built(room(vec![half, within, along], white()))), []);
    // Something with an end does not cut space in two.
    let disc = Shape::disc([0.0; 3], [0.0, 0.0, 1.0], 3.0, white());
    let scene = Scene::builder()
        .camera(Camera::new([0.0, -6.0, 2.0], [0.0, -5.0, 1.7], 1.0, [48, 36]))
        .light(Light::lamp([0.0, 0.0, -3.0], 900.0))
        .shape(disc);
    assert_eq!(reasons(&built(scene)), []);
    // An eye that is below the floor as well.
    let mut scene = built(room(lamps(), white()));
    let below = Camera::new([0.0, -6.0, -2.0], [0.0, -5.0, -1.7], 1.0, [48, 36]);
    scene.camera = below.expect("valid");
    assert!(reasons(&scene).contains(&(0, Reason::Behind(0))));
    assert!(!reasons(&scene).contains(&(1, Reason::Behind(0))));
}

fn dim(brightness: f64, count: usize) -> Scene {
    let mut lights = vec![Light::lamp([2.0, -3.0, 5.0], 20.0)];
    lights.extend((0..count).map(|k| Light::lamp([k as f64 * 0.1, 0.0, 12.0], brightness)));
    built(room(lights, white()))
}

#[test]
fn dim_lights_are_left_out_only_for_an_error_that_bears_them() {
    // The ball's top is 10 away: each adds 1e-6 at most.
    let scene = dim(1e-4, 3);
    let asked =
        |error, factor| Asked { error: Some(error), factor: Some(factor), ..Asked::default() };
    let plan = Plan::new(&scene, &asked(4e-5, 1.0));
    let numbers: Vec<_> = plan.dropped.iter().map(|dropped| dropped.light).collect();
    assert_eq!(numbers, [1, 2, 3]);
    assert!(plan.dropped.iter().all(|dropped| dropped.why == Reason::Dim));
    assert!((plan.most() / 3e-6 - 1.0).abs() < 0.01, "{}", plan.most());
    // Together they would be too much; shown brighter each; without an error any.
    assert_eq!(Plan::new(&scene, &asked(2.5e-5, 1.0)).dropped.len(), 2);
    assert_eq!(Plan::new(&scene, &asked(4e-5, 2.0)).dropped.len(), 2);
    assert!(Plan::new(&scene, &Asked { error: Some(1.0), ..Asked::default() }).dropped.is_empty());
    assert!(Plan::new(&scene, &Asked { full_model: true, ..asked(1.0, 1.0) }).dropped.is_empty());
}

/// No pixel is off by more than is stated, and some are by most of it.
#[test]
fn the_bound_for_dim_lights_holds() {
    let scene = dim(0.005, 40);
    let error = 0.05;
    let sampling = Sampling { samples: Some(1), error: Some(error), ..Sampling::default() };
    let stops = lancer_scene::Exposure::Stops(lancer_scene::Stops::default());
    let settings =
        RenderSettings { sampling: Some(sampling), exposure: Some(stops), ..Default::default() };
    let plan = settings.plan(&scene, &Whitted::default());
    assert_eq!(plan.dropped.len(), 40);
    let [planned, full] = both(&scene, &settings);
    let off = planned
        .film
        .pixels()
        .iter()
        .zip(full.film.pixels())
        .map(|(a, b)| (0..3).map(|i| f64::from((b[i] - a[i]).abs())).fold(0.0, f64::max));
    let worst = off.fold(0.0, f64::max);
    assert!(worst <= plan.most() && worst > 0.3 * plan.most(), "{worst} of {}", plan.most());
}
