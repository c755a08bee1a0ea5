//! Turned and mirrored, as a whole: all shapes in a group that is placed so, with the camera
//! and the lights.

use crate::{MESHES, SCENES, bits, differing, mirrored, picture, scene};
use lancer_math::{Placement, Vector};
use lancer_tests::moved::placed;

/// A group that stays where it is changes no bit, and one that is mirrored only what is left
/// and right: signs of coordinates change, and sums stay as they are.
#[test]
fn mirrors_change_no_bit() {
    for name in SCENES {
        let scene = scene(name);
        let expected = bits(&picture(&scene).film);
        let stands = picture(&placed(&scene, &Placement::IDENTITY).expect("it is in range"));
        assert!(bits(&stands.film) == expected, "{name} in a group");
        let mirrors = [[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [-1.0; 3]];
        for factors in if MESHES.contains(&name) { &mirrors[..1] } else { &mirrors[..] } {
            let mirror = Placement::scale(Vector::from(*factors)).expect("it is not flat");
            let found = picture(&placed(&scene, &mirror).expect("it is in range"));
            let back: Vec<_> = mirrored(&found.film).iter().map(|p| p.map(f32::to_bits)).collect();
            assert!(back == expected, "{name} mirrored by {factors:?}");
            assert!(bits(&found.film) != expected, "{name} is not symmetric");
        }
    }
}

/// Turns change the order of sums, or all numbers: rounding, which the film hides but for a
/// unit in its last place.
#[test]
fn turns_change_no_more_than_rounding_does() {
    for name in SCENES {
        let scene = scene(name);
        let expected = picture(&scene);
        for (axis, degrees) in
            [([0.0, 0.0, 1.0], 90.0), ([1.0, 1.0, 1.0], 120.0), ([1.0, -2.0, 0.7], 77.0)]
        {
            let turn = Placement::rotate(Vector::from(axis), degrees).expect("an axis");
            let found = picture(&placed(&scene, &turn).expect("it is in range"));
            let n = differing(found.film.pixels(), expected.film.pixels(), 3e-7);
            assert_eq!(n, 0, "{name} turned by {degrees} degrees");
        }
    }
}
