//! What the tests of whole pictures share.

use lancer_integrator::{
    Engine, Plan, RayCounts, RenderSettings, Rendered, Troubles, Whitted, engine_by_name, render,
};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{
    Camera, Colour, CustomShape, InvalidField, Scene, SceneBuilder, Shape, Spectrum, Surface,
};
use lancer_tests::paths::{files_with_extension, scenes, stem};
use std::sync::{Arc, Mutex};

/// The last place of a film's single precision, as a fraction.
pub(crate) const FILM: f64 = 1.2e-7;

/// 2^-53, half the last place of a double.
pub(crate) const U: f64 = 1.110_223_024_625_156_5e-16;

/// 2^k, exactly.
pub(crate) fn power(k: i32) -> f64 {
    libm::ldexp(1.0, k)
}

/// The text of a scene in `scenes/stability`, with some of it replaced. What is to
/// be replaced must be there.
pub(crate) fn text(name: &str, changes: &[(&str, &str)]) -> String {
    let path = scenes().join("stability").join(format!("{name}.xml"));
    let mut text = std::fs::read_to_string(&path)
        .unwrap_or_else(|e| panic!("cannot read {}: {e}", path.display()));
    for (from, to) in changes {
        assert!(text.contains(from), "{name} has no {from}");
        text = text.replace(from, to);
    }
    text
}

/// A scene of that text.
pub(crate) fn parsed(text: &str) -> Scene {
    let parsed = lancer_xml::parse(text.as_bytes(), &lancer_xml::Options::default());
    parsed.into_result().unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A scene in `scenes/stability`, with some of its text replaced.
pub(crate) fn file(name: &str, changes: &[(&str, &str)]) -> Scene {
    parsed(&text(name, changes))
}

/// The picture of a scene by that engine, with first hits if it is `whitted`.
pub(crate) fn by(engine: &str, scene: &Scene) -> Rendered {
    let engine = engine_by_name(engine).expect("there is such an engine");
    rendered(scene, engine)
}

fn rendered(scene: &Scene, engine: &dyn Engine) -> Rendered {
    let layers = engine.name() == "whitted";
    let settings = RenderSettings { layers, for_display: true, ..RenderSettings::default() };
    render(scene, engine, &settings).unwrap_or_else(|e| panic!("{e}"))
}

/// The picture of a scene in which nothing goes wrong, with a cutoff.
pub(crate) fn seen_with(scene: &Scene, cutoff: f64) -> Rendered {
    let rendered = rendered(scene, &Whitted::with_cutoff(cutoff).expect("in range"));
    assert_eq!(rendered.counts.troubles, Troubles::default());
    assert!(rendered.film.pixels().as_flattened().iter().all(|v| v.is_finite()));
    rendered
}

/// The same with the usual cutoff.
pub(crate) fn seen(scene: &Scene) -> Rendered {
    seen_with(scene, Whitted::CUTOFF)
}

/// The value of the middle pixel, all of whose components are alike.
pub(crate) fn middle(scene: &Scene) -> f64 {
    middle_with(scene, Whitted::CUTOFF)
}

/// The same with a cutoff.
pub(crate) fn middle_with(scene: &Scene, cutoff: f64) -> f64 {
    let film = seen_with(scene, cutoff).film;
    let size = film.frame();
    let [red, green, blue] = film.pixel(size.width / 2, size.height / 2);
    assert!(red == green && green == blue, "({red}, {green}, {blue})");
    f64::from(red)
}

/// Parts of scenes that are described in Rust.
pub(crate) fn built(builder: SceneBuilder) -> Scene {
    builder.build().unwrap_or_else(|e| panic!("{e}"))
}

/// A scene with that camera and a grey background.
pub(crate) fn scene(camera: Result<Camera, InvalidField>, background: f64) -> SceneBuilder {
    Scene::builder().camera(camera).background(Spectrum::new([background; 3]))
}

/// A camera of one pixel.
pub(crate) fn eye(from: [f64; 3], at: [f64; 3]) -> Result<Camera, InvalidField> {
    Camera::new(from, at, 1.0, [1, 1])
}

/// A camera of one pixel with y upward that looks straight down at z = 0, along a ray
/// whose coordinates are exact.
pub(crate) fn down_at(x: f64, y: f64) -> Result<Camera, InvalidField> {
    Camera::new([x, y, 1.0], [x, y, 0.0], 1.0, [1, 1])
}

pub(crate) fn white() -> Surface {
    Surface::new(Colour::WHITE)
}

pub(crate) fn black() -> Surface {
    Surface::new(Colour::BLACK)
}

pub(crate) fn glass(ior: f64) -> Surface {
    Surface::glass(ior).expect("in range")
}

/// Black, but shining.
pub(crate) fn shining(radiance: f64) -> Surface {
    black().emission([radiance; 3]).expect("in range")
}

/// Black between mirroring so much.
pub(crate) fn mirror(gloss: f64) -> Surface {
    black().gloss(gloss).expect("in range")
}

/// An infinite plane at that height; what is below is its inside.
pub(crate) fn floor(height: f64, surface: Surface) -> Result<Shape, InvalidField> {
    Shape::plane([0.0, 0.0, height], [0.0, 0.0, 1.0], surface)
}

/// Fails where `found` differs from `expected` by more than that fraction of it, or
/// is no number.
#[track_caller]
pub(crate) fn assert_near(found: f64, expected: f64, fraction: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= fraction * expected.abs(), "{what}: {found} is not {expected}");
}

/// A shape that no ray meets and that remembers all rays that might have.
#[derive(Debug, Clone, Default)]
struct Witness {
    rays: Arc<Mutex<Vec<Ray>>>,
}

impl CustomShape for Witness {
    fn name(&self) -> &str {
        "witness"
    }

    fn nearest(&self, ray: &Ray) -> Option<f64> {
        self.rays.lock().expect("no thread has failed").push(*ray);
        None
    }

    fn normal(&self, _point: &Point) -> Vector {
        Vector::z()
    }
}

/// All rays that are followed for a pixel, the eye's own first, the ones that matter
/// most before the others.
pub(crate) fn rays_of(builder: SceneBuilder, (x, y): (u32, u32)) -> Vec<Ray> {
    let witness = Witness::default();
    let scene = built(builder.shape(Shape::custom(witness.clone(), black())));
    let settings = RenderSettings::default().kernel;
    let _ = Whitted::new().prepare(&scene, &Plan::full(&settings)).pixel(
        x,
        y,
        &mut RayCounts::default(),
    );
    let mut rays = witness.rays.lock().expect("no thread has failed").clone();
    // It is asked again where surfaces are crossed.
    rays.dedup();
    rays
}

/// The same for a picture of one pixel.
pub(crate) fn rays(builder: SceneBuilder) -> Vec<Ray> {
    rays_of(builder, (0, 0))
}

/// The 8-bit codes of a picture, as a PNG holds them.
pub(crate) fn codes(rendered: &Rendered) -> Vec<u8> {
    let image = lancer_output::to_rgb8(&rendered.film).unwrap_or_else(|e| panic!("{e}"));
    image.into_raw()
}

/// How many pixels of two pictures differ by more than so many of 255 levels.
pub(crate) fn differing(a: &Rendered, b: &Rendered, levels: u8) -> usize {
    let (a, b) = (codes(a), codes(b));
    assert_eq!(a.len(), b.len());
    let far = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > levels);
    a.chunks_exact(3).zip(b.chunks_exact(3)).filter(|pair| far(*pair)).count()
}

/// The bits of a film.
pub(crate) fn bits(rendered: &Rendered) -> Vec<u32> {
    rendered.film.pixels().as_flattened().iter().map(|v| v.to_bits()).collect()
}

/// Each scene of the folder is valid and is in the table that says what it shows.
#[test]
fn each_scene_is_listed() {
    let folder = scenes().join("stability");
    let table = std::fs::read_to_string(folder.join("README.md")).expect("it is there");
    let files = files_with_extension(&folder, "xml");
    assert!(files.len() >= 15, "they are found");
    for path in files {
        let name = stem(&path);
        let _ = file(&name, &[]);
        assert!(table.contains(&format!("[{name}]({name}.xml)")), "{name}");
    }
}
