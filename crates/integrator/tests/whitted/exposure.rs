//! How bright a picture is shown.

use crate::help::{scene, shining};
use lancer_film::Window;
use lancer_integrator::{RenderSettings, Rendered, Whitted, render};
use lancer_scene::{Camera, Exposure, InvalidField, Scene, Shape, Stops};

/// 20 x 20 pixels, each 1 wide, of a background of 1/4.
fn camera() -> Result<Camera, InvalidField> {
    Camera::new([0.0, 0.0, 5.0], [0.0; 3], 1.0, [20, 20])
        .and_then(|camera| camera.orthographic(20.0))
}

/// With the right half 4 times as bright, and one pixel a million times.
fn halves(camera: Result<Camera, InvalidField>) -> Scene {
    let bright = Shape::cuboid([0.0, -10.0, -1.0], [10.0, 10.0, 0.0], shining([0.5, 1.0, 0.5]));
    let lamp = Shape::sphere([-4.5, 4.5, 1.0], 0.25, shining([1e6; 3]));
    scene(camera, 0.25).shape(bright).shape(lamp).build().expect("valid")
}

fn shown(scene: &Scene, settings: &RenderSettings<'_>) -> Rendered {
    render(scene, &Whitted::new(), settings).expect("it renders")
}

const LEFT: Window = Window { x: 0, y: 10, width: 10, height: 10 };

#[test]
fn automatic_exposure_makes_white_of_what_99_of_100_do_not_exceed() {
    let scene = halves(camera());
    let whole = shown(&scene, &RenderSettings::default());
    // 199 pixels of 1/4 and one lamp on the left, 200 of 1 on the right.
    assert_eq!(whole.film.stops(), Some(0.0));
    assert_eq!(whole.film.pixel(5, 5)[0], 1e6, "the lamp is there");
}

#[test]
fn automatic_exposure_looks_at_the_whole_frame_for_a_part_too() {
    let scene = halves(camera());
    let settings = RenderSettings { for_display: true, ..RenderSettings::default() };
    let whole = shown(&scene, &settings);
    let part = shown(&scene, &RenderSettings { window: Some(LEFT), ..settings });
    // The part by itself has nothing above 1/4, which would be 2 stops.
    assert_eq!(part.film.stops(), whole.film.stops());
    assert_eq!(part.film.stops(), Some(0.0));
    assert!(part.film.pixels().iter().all(|pixel| *pixel == [0.25; 3]));
    // For a file of radiance nobody asks, and the rest need not be rendered.
    let linear = shown(&scene, &RenderSettings { window: Some(LEFT), ..RenderSettings::default() });
    assert_eq!(linear.film.stops(), None);
    assert_eq!(linear.counts.primary, 100);
    assert_eq!(linear.film.pixels(), part.film.pixels());
}

#[test]
fn exposure_changes_what_is_shown_and_not_what_is_there() {
    let fixed = halves(camera().and_then(|camera| camera.stops(-1.5)));
    let automatic = halves(camera());
    let settings = RenderSettings { for_display: true, ..RenderSettings::default() };
    let film = shown(&fixed, &settings).film;
    assert_eq!(film.stops(), Some(-1.5));
    assert_eq!(film.pixels(), shown(&automatic, &settings).film.pixels());
    // What the caller says goes before what the camera says, both ways.
    let three = Exposure::Stops(Stops::new(3.0).expect("in range"));
    let said = |exposure| RenderSettings { exposure: Some(exposure), ..settings };
    assert_eq!(shown(&fixed, &said(three)).film.stops(), Some(3.0));
    assert_eq!(shown(&fixed, &said(Exposure::Auto)).film.stops(), Some(0.0));
    // A part, with a number that needs no other pixel.
    let part = RenderSettings { window: Some(LEFT), ..said(three) };
    let part = shown(&automatic, &part);
    assert_eq!((part.film.stops(), part.counts.primary), (Some(3.0), 100));
}

/// Whoever gives back the number that was found gets the same.
#[test]
fn the_number_of_automatic_exposure_can_be_given_back() {
    for background in [1e-6, 0.03, 0.7, 1.0, 5.5, 3e9] {
        let scene = scene(camera(), background).build().expect("valid");
        let settings = RenderSettings { for_display: true, ..RenderSettings::default() };
        let automatic = shown(&scene, &settings).film;
        let stops = automatic.stops().expect("the whole frame is there");
        // White is reached to a 64th of a stop, and not passed.
        let white = f64::from(background as f32) * libm::exp2(stops);
        assert!(white <= 1.0 && white > libm::exp2(-1.0 / 64.0), "{background}: {white}");
        let text = stops.to_string();
        let back = Stops::new(text.parse().expect("a number")).expect("in range");
        let given = RenderSettings { exposure: Some(Exposure::Stops(back)), ..settings };
        assert_eq!(shown(&scene, &given).film, automatic, "{background}");
    }
}

#[test]
fn a_black_picture_is_shown_as_it_is() {
    let scene = scene(camera(), 0.0).build().expect("valid");
    assert_eq!(shown(&scene, &RenderSettings::default()).film.stops(), Some(0.0));
}
