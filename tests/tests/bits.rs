//! The same bits for every number of lanes, every number of threads, and whatever is
//! left out because it cannot matter.

use lancer_film::Layers;
use lancer_integrator::{
    Culling, Engine, KernelSettings, RenderSettings, Width, engine_by_name, render,
};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::golden::{self, Golden};
use std::num::NonZeroUsize;

/// One picture must be cut into several strips for every number of threads, and have
/// tiles that are not whole.
const MOST_SIDES: [u32; 2] = [75, 55];

/// A golden's scene, no larger than that, and its engine.
fn small(golden: &Golden) -> (Scene, &'static dyn Engine) {
    let mut scene = golden.scene().unwrap_or_else(|e| panic!("{e}"));
    let [width, height] = MOST_SIDES;
    let side = |own: PixelCount, most| PixelCount::new(own.get().min(most)).expect("it is above 0");
    scene.camera.px_width = side(scene.camera.px_width, width);
    scene.camera.px_height = side(scene.camera.px_height, height);
    (scene, engine_by_name(golden.engine()).expect("there is such an engine"))
}

fn goldens() -> Vec<Golden> {
    golden::all().unwrap_or_else(|problems| panic!("{}", problems[0]))
}

/// A hash of every bit of the film, of how it is shown, and of its layers if the engine
/// has any; with the rays that were followed, which are as fixed.
fn hash(scene: &Scene, engine: &dyn Engine, threads: usize, kernel: KernelSettings) -> u64 {
    let settings = RenderSettings {
        threads: NonZeroUsize::new(threads),
        for_display: true,
        layers: engine.name() == "whitted",
        kernel,
        ..RenderSettings::default()
    };
    let rendered = render(scene, engine, &settings).unwrap_or_else(|e| panic!("{e}"));
    let mut hash = Fnv::new();
    for v in rendered.film.pixels().as_flattened() {
        hash.add(u64::from(v.to_bits()));
    }
    hash.add(rendered.film.stops().map_or(0, f64::to_bits));
    hash.add(rendered.film.frame_peak().map_or(0, |peak| u64::from(peak.to_bits())));
    for pixel in rendered.layers.iter().flat_map(Layers::pixels) {
        let depths = [pixel.axis_depth, pixel.ray_depth];
        for v in depths.iter().chain(&pixel.normal).chain(&pixel.albedo) {
            hash.add(u64::from(v.to_bits()));
        }
        hash.add(u64::from(pixel.shape) << 32 | u64::from(pixel.instance));
    }
    let counts = &rendered.counts;
    for count in [counts.primary, counts.reflected, counts.transmitted, counts.shadow] {
        hash.add(count);
    }
    hash.0
}

/// Fowler, Noll and Vo's hash 1a, a word at a time.
struct Fnv(u64);

impl Fnv {
    const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3).rotate_left(29);
    }
}

#[test]
fn one_hash_for_every_width_and_number_of_threads() {
    for golden in goldens() {
        let (scene, engine) = small(&golden);
        let scalar = KernelSettings { lanes: Width::SCALAR, ..KernelSettings::default() };
        let expected = hash(&scene, engine, 1, scalar);
        for lanes in Width::available() {
            let kernel = KernelSettings { lanes, ..KernelSettings::default() };
            for threads in [1, 2, 3, 7] {
                let found = hash(&scene, engine, threads, kernel);
                let (name, lanes) = (&golden.name, lanes.name());
                assert_eq!(found, expected, "{name}, lanes {lanes}, {threads} threads");
            }
        }
    }
}

#[test]
fn what_is_left_out_changes_no_bit() {
    let mut seen = 0;
    for golden in goldens() {
        let scenes = ["readme", "default", "mirror_corridor", "instances", "meshes", "glass"];
        if !scenes.contains(&golden.scene_name().as_str()) {
            continue;
        }
        seen += 1;
        let (scene, engine) = small(&golden);
        let nothing = KernelSettings { culling: Culling::NONE, ..KernelSettings::default() };
        let expected = hash(&scene, engine, 2, nothing);
        let each = Culling::without_each().into_iter();
        for (without, culling) in each.chain([("nothing", Culling::ALL)]) {
            let kernel = KernelSettings { culling, ..KernelSettings::default() };
            let found = hash(&scene, engine, 2, kernel);
            assert_eq!(found, expected, "{}: everything but {without}", golden.name);
        }
    }
    assert!(seen >= 5, "the scenes are found by their names");
}

/// The hash is no constant: another scene or engine changes it.
#[test]
fn different_pictures_have_different_hashes() {
    let goldens = goldens();
    let mut hashes: Vec<_> = goldens
        .iter()
        .map(|golden| {
            let (scene, engine) = small(golden);
            hash(&scene, engine, 1, KernelSettings::default())
        })
        .collect();
    hashes.sort_unstable();
    hashes.dedup();
    assert_eq!(hashes.len(), goldens.len());
}
