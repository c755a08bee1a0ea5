//! Pictures of scenes, with every number of lanes.

use lancer_film::Film;
use lancer_integrator::{KernelSettings, RenderSettings, Width, engine_by_name, render};
use lancer_scene::Scene;

/// The film that an engine makes, the same with every number of lanes.
pub(crate) fn film(scene: &Scene, engine: &str) -> Film {
    let engine = engine_by_name(engine).expect("there is such an engine");
    let mut films = Width::available().into_iter().map(|lanes| {
        let kernel = KernelSettings { lanes, ..KernelSettings::default() };
        let settings = RenderSettings { kernel, ..RenderSettings::default() };
        render(scene, engine, &settings).unwrap_or_else(|e| panic!("{e}")).film
    });
    let first = films.next().expect("one lane is always there");
    for other in films {
        assert_eq!(bits(&other), bits(&first));
    }
    first
}

/// The pixels bit by bit.
pub(crate) fn bits(film: &Film) -> Vec<[u32; 3]> {
    film.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

/// The largest component.
pub(crate) fn brightness(pixel: [f32; 3]) -> f32 {
    pixel.into_iter().fold(0.0, f32::max)
}
