//! Times s: with the sizes of cells, the brightness of lamps (times s^2 where light falls off) and
//! absorption (divided by s), so that the picture is the same.

use crate::{MESHES, SCENES, bits, differing, picture, scene, seen};
use lancer_scene::{Light, Scene};
use lancer_tests::moved::scaled;

/// Every number of a scene times a power of two is exact, and so is every intermediate result,
/// as no constant of a length is added to or compared with any.
#[test]
fn powers_of_two_change_no_bit() {
    for name in SCENES {
        let scene = scene(name);
        let exponents: &[i32] = if MESHES.contains(&name) { &[-40] } else { &[-40, -7, 1, 40] };
        unchanged_by(name, &scene, exponents);
    }
}

/// Without falloff, brightness stays as it is.
#[test]
fn powers_of_two_change_no_bit_without_falloff() {
    for name in ["checkers", "glass", "spots"] {
        let mut scene = scene(name);
        scene.lights.iter_mut().for_each(|light| *light = Light::without_falloff(*light));
        unchanged_by(name, &scene, &[-40, -1, 40]);
    }
}

fn unchanged_by(name: &str, scene: &Scene, exponents: &[i32]) {
    let expected = picture(scene);
    for &exponent in exponents {
        let factor = libm::scalbn(1.0, exponent);
        let found = picture(&scaled(scene, factor).expect("it is in range"));
        assert!(bits(&found.film) == bits(&expected.film), "{name} times 2^{exponent}");
        assert!(seen(&found) == seen(&expected), "{name} times 2^{exponent}");
        assert_eq!(found.counts, expected.counts, "{name} times 2^{exponent}");
        let depths = |picture: &lancer_integrator::Rendered| -> Vec<f32> {
            let layers = picture.layers.as_ref().expect("they were asked for");
            layers.pixels().iter().map(|pixel| pixel.ray_depth).collect()
        };
        let times = depths(&expected).iter().map(|d| d * factor as f32).collect::<Vec<_>>();
        assert_eq!(depths(&found), times, "{name} times 2^{exponent}");
    }
}

/// Any other factor rounds each number of the scene once, to one part in 2^53. On smooth
/// surfaces that is far below what the film can hold: one unit in its last place, 2^-23 of the
/// value. A pixel could change over only if its ray passed a border within such a rounding, and
/// none does.
#[test]
fn other_factors_change_no_more_than_rounding_does() {
    for name in SCENES {
        let scene = scene(name);
        let expected = picture(&scene);
        let factors: &[f64] = if MESHES.contains(&name) { &[1e12] } else { &[1e-12, 0.1, 1e12] };
        for &factor in factors {
            let found = picture(&scaled(&scene, factor).expect("it is in range"));
            let n = differing(found.film.pixels(), expected.film.pixels(), 3e-7);
            assert_eq!(n, 0, "{name} times {factor:e}");
        }
    }
}
