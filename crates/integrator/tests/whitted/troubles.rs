//! What is said about scenes that make no sense.

use crate::help::{FILM, assert_near, black, eye, floor, glass, grey, rendered, scene, shining};
use lancer_integrator::{Engine, Trouble, Troubles, Whitted};
use lancer_scene::{Camera, Group, SceneBuilder, Shape};

fn warnings(builder: SceneBuilder) -> Vec<String> {
    let warnings = Whitted::new().warnings(&builder.build().expect("valid"));
    warnings.into_iter().map(|warning| warning.message).collect()
}

/// A pane without an inside, of a medium: what leaves it was never in it.
#[test]
fn leaving_a_medium_never_entered_is_counted_with_its_first_pixel() {
    // It covers columns 2 to 4 of rows 3 and 4.
    let frame = Camera::new([0.0, 0.0, 5.0], [0.0; 3], 8.0, [8, 8]);
    let camera = frame.and_then(|camera| camera.orthographic(8.0));
    let seen = |normal: f64| {
        let sides = if normal > 0.0 {
            [[3.0, 0.0, 0.0], [0.0, 2.0, 0.0]]
        } else {
            [[0.0, 2.0, 0.0], [3.0, 0.0, 0.0]]
        };
        let pane = Shape::rectangle([-2.0, -1.0, 0.0], sides, glass(1.5));
        scene(camera.clone(), 1.0).shape(pane)
    };
    let left = rendered(seen(-1.0), Whitted::CUTOFF).counts.troubles;
    assert_eq!(left.media, Trouble { count: 6, first: Some((2, 3)) });
    assert_eq!(Troubles { media: Trouble::default(), ..left }, Troubles::default());
    // What enters it makes sense so far; that it is never left is known before.
    assert_eq!(rendered(seen(1.0), Whitted::CUTOFF).counts.troubles, Troubles::default());
    for normal in [1.0, -1.0] {
        let [warning] = &warnings(seen(normal))[..] else { panic!("one pane, one warning") };
        assert!(warning.contains("shape 1, a rectangle") && warning.contains("not closed"));
    }
}

#[test]
fn light_that_leaves_a_medium_never_entered_is_counted_too() {
    let shaded = scene(eye([1.0, 0.5, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, crate::help::white()))
        .shape(Shape::disc([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 1.0, glass(1.5)))
        .light(lancer_scene::Light::sun([0.0, 0.0, -1.0], 1.0));
    // From the ground up, against the light, it is entered; the other way it is
    // left. One of the two makes no sense.
    let other = scene(eye([1.0, 0.5, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, crate::help::white()))
        .shape(Shape::disc([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 1.0, glass(1.5)))
        .light(lancer_scene::Light::sun([0.0, 0.0, -1.0], 1.0));
    let counts = [shaded, other].map(|s| rendered(s, 1e-4).counts.troubles.media.count);
    assert_eq!(counts.iter().sum::<u64>(), 1, "{counts:?}");
}

#[test]
fn only_open_glass_is_warned_of() {
    let tube = |surface| {
        let tube = Shape::cylinder([0.0; 3], [0.0, 0.0, 1.0], 1.0, surface);
        tube.map(Shape::without_lids)
    };
    let all = |scene: SceneBuilder| warnings(scene).len();
    let empty = || scene(eye([0.0; 3], [1.0; 3]), 0.0);
    assert_eq!(all(empty().shape(tube(glass(1.5)))), 1);
    assert_eq!(all(empty().shape(tube(glass(1.5).thin()))), 0);
    assert_eq!(all(empty().shape(tube(black()))), 0);
    let lids = Shape::cylinder([0.0; 3], [0.0, 0.0, 1.0], 1.0, glass(1.5));
    assert_eq!(all(empty().shape(lids).shape(floor(0.0, glass(1.5)))), 0);
    // In a group, once for all its places.
    let shapes = vec![tube(glass(1.5)).expect("valid")];
    let group =
        std::sync::Arc::new(Group::new(Some("tube".into()), shapes, Vec::new()).expect("few"));
    let mut twice = empty();
    for x in [0.0, 5.0] {
        let place = lancer_math::Placement::translate(lancer_math::Vector::new(x, 0.0, 0.0));
        twice = twice.group(place, std::sync::Arc::clone(&group));
    }
    let [warning] = &warnings(twice)[..] else { panic!("one group, one warning") };
    assert!(warning.contains("`tube`"), "{warning}");
}

#[test]
fn a_camera_beyond_the_range_of_squares_is_warned_of() {
    assert_eq!(warnings(scene(eye([1e70; 3], [0.0; 3]), 0.0)).len(), 0);
    assert_eq!(warnings(scene(eye([1e80; 3], [0.0; 3]), 0.0)).len(), 1);
}

/// Radiance that single precision does not hold.
#[test]
fn pixels_that_are_not_finite_are_black_and_counted() {
    let camera = Camera::new([0.0, 0.0, 5.0], [0.0; 3], 2.0, [2, 2])
        .and_then(|camera| camera.orthographic(2.0));
    let bright = Shape::sphere([0.5, -0.5, 0.0], 0.25, shining([1.0, 1e39, 0.0]));
    let result = rendered(scene(camera, 0.5).shape(bright), Whitted::CUTOFF);
    assert_eq!(result.counts.troubles.not_finite, Trouble { count: 1, first: Some((1, 1)) });
    assert_eq!(result.film.pixels(), [[0.5; 3], [0.5; 3], [0.5; 3], [0.0; 3]]);
    // Nothing of something infinite is nothing, not NaN.
    let share = glass(1.5).absorption([1e308; 3]).expect("in range");
    let dark = scene(eye([0.0, 0.0, 1.0], [0.0; 3]), 1.0).shape(floor(0.0, share));
    assert_near(grey(dark), 0.04, FILM, "what it mirrors");
}

/// In a room of perfect mirrors a lossless ball splits rays for ever. It ends, and
/// says so.
#[test]
fn rays_that_split_for_ever_end() {
    let mirrored = scene(eye([1.5, 0.2, 0.1], [0.0, 0.1, 0.2]), 0.0)
        .shape(Shape::sphere([0.0; 3], 3.0, crate::help::mirror(1.0)))
        .shape(Shape::sphere([0.3, 0.0, 0.0], 0.8, glass(1.5)));
    let result = rendered(mirrored, Whitted::CUTOFF);
    assert!(result.counts.troubles.given_up.count > 0);
    assert_eq!(result.film.pixel(0, 0), [0.0; 3]);
}
