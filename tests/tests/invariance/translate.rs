//! Elsewhere: how far from the world's origin a scene may stand.

use crate::{PIXELS, SCENES, differing, picture, scene, seen};
use lancer_math::Vector;
use lancer_tests::moved::{snapped, translated};

/// The scenes are 4 to 30 across. Their coordinates are first made multiples of 2^-12, so that
/// they are exact wherever they are moved to, and whatever differs is the product's doing: the
/// points that rays leave from are rounded to the coordinates' last place, u = 2^-52 of the
/// distance T, once at each surface. What leaves a flat surface there is off by u; each curved
/// or refracting one magnifies that, by ten or so. So a component is off by at most
/// 100 u from smooth surfaces to smooth surfaces, and the more pixels go beyond that,
/// because what they see in glass has a border there, the larger u is.
#[test]
fn far_from_the_origin_only_points_that_rays_leave_from_are_rounded() {
    let pixels = (PIXELS[0] * PIXELS[1]) as usize;
    for name in SCENES {
        let scene = snapped(&scene(name), libm::scalbn(1.0, -12)).expect("it is in range");
        let expected = picture(&scene);
        for (exponent, beyond, by_a_level) in [(20, 0, 0), (27, 30, 0), (33, 50, 6)] {
            let far = libm::scalbn(1.0, exponent);
            let offset = Vector::new(far, -far, far);
            let found = picture(&translated(&scene, offset).expect("it is in range"));
            let count =
                |tolerance| differing(found.film.pixels(), expected.film.pixels(), tolerance);
            let place = format!("{name} at 2^{exponent}");
            let n = count(3e-7 + 100.0 * far * f64::EPSILON);
            assert!(n <= beyond, "{place}: {n} of {pixels} pixels beyond 100 u");
            let n = count(1.0 / 255.0);
            assert!(n <= by_a_level, "{place}: {n} of {pixels} pixels differ by a level");
            // What the eye sees first has the coordinates as they are.
            let shapes = |picture| seen(picture).iter().map(|p| p.instance).collect::<Vec<_>>();
            assert_eq!(shapes(&found), shapes(&expected), "{place}");
        }
    }
}
