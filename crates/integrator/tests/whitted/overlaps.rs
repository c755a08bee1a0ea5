//! Whose medium it is where solids overlap: that of the higher priority; of the
//! same, of the smaller volume; of the same again, of the later one.

use crate::help::{
    FILM, assert_near, black, eye, floor, glass, grey_with, largest_difference, picture, pixel,
    rendered, scene, shining, smoke,
};
use lancer_integrator::Whitted;
use lancer_math::{Placement, Vector};
use lancer_scene::{Camera, Group, InvalidField, SceneBuilder, Shape, Surface};

/// Along x, from far.
fn along() -> SceneBuilder {
    scene(eye([-9.0, 0.0, 0.0], [0.0; 3]), 1.0)
}

/// A box along x, so wide.
fn stretch(from: f64, to: f64, half: f64, surface: Surface) -> Result<Shape, InvalidField> {
    Shape::cuboid([from, -half, -half], [to, half, half], surface)
}

/// Takes away red, or green.
fn red() -> Surface {
    smoke([0.25, 0.0, 0.0])
}

fn green() -> Surface {
    smoke([0.0, 0.25, 0.0])
}

/// That the way was so long in each of the two.
#[track_caller]
fn assert_lengths(found: [f64; 3], lengths: [f64; 2], what: &str) {
    for i in 0..2 {
        assert_near(found[i], libm::exp(-0.25 * lengths[i]), 3e-7, what);
    }
    assert_eq!(found[2], 1.0);
}

#[test]
fn of_equal_solids_the_later_one_has_what_they_share() {
    let (a, b) = (|s| stretch(0.0, 2.0, 1.0, s), |s| stretch(1.0, 3.0, 1.0, s));
    let seen = |first, second| pixel(along().shape(first).shape(second));
    assert_lengths(seen(a(red()), b(green())), [1.0, 2.0], "red first");
    assert_lengths(seen(b(green()), a(red())), [2.0, 1.0], "green first");
    assert_lengths(seen(a(red().priority(1)), b(green())), [2.0, 1.0], "red above");
    assert_lengths(seen(b(green().priority(7)), a(red().priority(3))), [1.0, 2.0], "green above");
    assert_lengths(seen(b(green()), a(red().priority(-1))), [1.0, 2.0], "red below");
}

#[test]
fn of_the_same_priority_the_smaller_solid_has_it() {
    let (a, b) = (|s| stretch(0.0, 2.0, 0.5, s), |s| stretch(1.0, 3.0, 1.0, s));
    let seen = |first, second| pixel(along().shape(first).shape(second));
    assert_lengths(seen(a(red()), b(green())), [2.0, 1.0], "the smaller first");
    assert_lengths(seen(b(green()), a(red())), [2.0, 1.0], "the smaller last");
    assert_lengths(seen(a(red()), b(green().priority(1))), [1.0, 2.0], "the larger above");
    // One in the other, and one in what has no end.
    let inside = |s| Shape::sphere([1.0, 0.0, 0.0], 0.5, s);
    assert_lengths(seen(inside(green()), a(red())), [1.0, 1.0], "a ball in a box");
    assert_lengths(seen(a(red()), inside(green())), [1.0, 1.0], "a ball in a box");
    let sea = |s| Shape::plane([1.5, 0.0, 0.0], [-1.0, 0.0, 0.0], s);
    let end = || Shape::plane([4.0, 0.0, 0.0], [1.0, 0.0, 0.0], shining([1.0; 3]));
    let seen = pixel(along().shape(sea(green())).shape(a(red())).shape(end()));
    assert_lengths(seen, [2.0, 2.0], "a box half in a sea");
}

/// The size that counts is that in the scene.
#[test]
fn groups_change_the_size() {
    let ball = |s: Surface, scale: f64| {
        let shape = Shape::sphere([0.0; 3], 1.0, s).expect("valid");
        let placement = Placement::scale(Vector::repeat(scale)).expect("it has an inverse");
        (placement, Group::new(None, vec![shape], Vec::new()).expect("few"))
    };
    for (large, small) in [(2.0, 0.5), (3.0, 1.0)] {
        for small_first in [true, false] {
            let ((p, outer), (q, inner)) = (ball(red(), large), ball(green(), small));
            let seen = if small_first {
                along().group(q, inner).group(p, outer)
            } else {
                along().group(p, outer).group(q, inner)
            };
            let lengths = [2.0 * (large - small), 2.0 * small];
            assert_lengths(pixel(seen), lengths, "a small ball in a large one");
        }
    }
}

#[test]
fn three_may_overlap_and_the_eye_may_be_in_all_of_them() {
    let shapes = || {
        [
            stretch(-4.0, 4.0, 3.0, smoke([0.25, 0.0, 0.0])),
            stretch(-2.0, 3.0, 2.0, smoke([0.0, 0.25, 0.0])),
            stretch(-1.0, 2.0, 1.0, smoke([0.0, 0.0, 0.25])),
        ]
    };
    for (from, lengths) in [(-9.0, [3.0, 2.0, 3.0]), (0.0, [1.0, 1.0, 2.0])] {
        let mut seen = scene(eye([from, 0.0, 0.0], [from + 1.0, 0.0, 0.0]), 1.0);
        for shape in shapes() {
            seen = seen.shape(shape);
        }
        for (found, length) in pixel(seen).into_iter().zip(lengths) {
            assert_near(found, libm::exp(-0.25 * length), 3e-7, "three in one another");
        }
    }
}

/// Two solids with all faces together: the one that outranks the other is there
/// alone.
#[test]
fn solids_in_the_same_place_are_one() {
    let camera = || Camera::new([0.0, -5.0, 1.0], [0.0; 3], 2.5, [24, 24]);
    let ball = |n: f64| Shape::sphere([0.1, 0.2, 0.3], 1.0, glass(n));
    let ground = || floor(-1.0, black().checker(lancer_scene::Colour::WHITE));
    let light = lancer_scene::Light::sun([0.2, 0.3, -1.0], 1.0);
    let scene = || scene(camera(), 0.25).shape(ground()).light(light.clone());
    let alone = picture(scene().shape(ball(1.5)), Whitted::CUTOFF);
    let last = picture(scene().shape(ball(1.33)).shape(ball(1.5)), Whitted::CUTOFF);
    assert!(largest_difference(&alone, &last) <= 1e-6, "the later one");
    let above = Shape::sphere([0.1, 0.2, 0.3], 1.0, glass(1.5).priority(1));
    let above = picture(scene().shape(above).shape(ball(1.33)), Whitted::CUTOFF);
    assert!(largest_difference(&alone, &above) <= 1e-6, "the one with priority");
}

#[test]
fn an_open_surface_may_cut_a_solid() {
    let ball = || Shape::sphere([0.0; 3], 2.0, smoke([0.25, 0.0, 0.0]));
    let lid = |surface| Shape::disc([0.5, 0.0, 0.0], [1.0, 0.0, 0.0], 9.0, surface);
    // Opaque: seen through what is before it.
    let cut = along().shape(ball()).shape(lid(shining([1.0; 3])));
    assert_lengths(pixel(cut), [2.5, 0.0], "up to the lid");
    // Clear, of the medium around it: as if it were not there.
    let sheet = glass(1.0).thin();
    assert_lengths(pixel(along().shape(ball()).shape(lid(sheet))), [4.0, 0.0], "through a sheet");
    // A mirror sends it back through the same medium.
    let back = pixel(along().shape(ball()).shape(lid(crate::help::mirror(1.0))));
    assert_lengths(back, [5.0, 0.0], "to the mirror and back");
    // A sheet of glass in glass mirrors nothing.
    let dense = Shape::sphere([0.0; 3], 2.0, glass(1.5));
    let inside = scene(eye([0.0; 3], [1.0, 0.0, 0.0]), 1.0).shape(dense);
    let seen = inside.clone().shape(lid(glass(1.5).thin()));
    let counts = |scene| rendered(scene, 1e-6).counts;
    assert_eq!(counts(seen.clone()).reflected, counts(inside).reflected);
    assert_near(grey_with(seen, 1e-8), 1.0, FILM, "all of it");
}
