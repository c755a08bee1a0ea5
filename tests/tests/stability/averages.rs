//! Light of several samples in a pixel.

use super::pictures::{built, eye, scene, shining};
use lancer_integrator::{RenderSettings, Sampling, Strategy, Whitted, render};
use lancer_output::to_rgb8;
use lancer_scene::{Exposure, Shape, Stops};

/// A pixel of which one hundredth shows 100 and the rest 0.2: what is averaged is light, not
/// what is shown of it.
#[test]
fn a3_light_is_averaged_before_it_is_exposed_and_clipped() {
    // The pixel is one wide where the rectangle is.
    let spark =
        Shape::rectangle([0.13, -0.31, 0.0], [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0]], shining(100.0));
    let scene = built(scene(eye([0.0, 0.0, 1.0], [0.0; 3]), 0.2).shape(spark));
    let right = 0.01 * 100.0 + 0.99 * 0.2;
    // Four standard errors: of 65,536 places anywhere, and of a grid's cells, some 104 of which
    // are on a border.
    let of_samples = 99.8 * 0.0099_f64.sqrt() / 256.0 * 4.0;
    let of_cells = 99.8 * (104.0 * 0.25_f64).sqrt() / 65_536.0 * 4.0;
    for strategy in Strategy::ALL {
        for (stops, seed) in [(0.0, 1), (-3.0, 2)] {
            let sampling = Sampling {
                strategy: *strategy,
                seed,
                samples: Some(65_536),
                ..Sampling::default()
            };
            let settings = RenderSettings {
                exposure: Stops::new(stops).ok().map(Exposure::Stops),
                sampling: Some(sampling),
                ..RenderSettings::default()
            };
            let film = render(&scene, &Whitted::new(), &settings).expect("it renders").film;
            let found = f64::from(film.pixel(0, 0)[0]);
            let most = if *strategy == Strategy::Random { of_samples } else { of_cells };
            assert!((found - right).abs() <= most, "{strategy:?}: {found} is not {right}");
            // Clipped first, it would be 0.208 and so grey; exposed first, darker by far.
            let shown = to_rgb8(&film).expect("it can be shown").get_pixel(0, 0).0[0];
            let expected = if stops == 0.0 { 255 } else { 108 };
            assert!(shown.abs_diff(expected) <= 8, "{strategy:?}: {shown} is not {expected}");
        }
    }
}
